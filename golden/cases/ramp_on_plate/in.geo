SetFactory("OpenCASCADE");

// A plate with a ramp: its side faces are triangles whose tips lie on the plate.
Box(1) = {0, 0, 0, 16, 8, 2};
p = newp;
Point(p) = {3, 2, 2};
Point(p + 1) = {13, 2, 2};
Point(p + 2) = {13, 2, 6};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p};
Curve Loop(c + 3) = {c : c + 2};
s = news;
Plane Surface(s) = {c + 3};
ramp[] = Extrude {0, 4, 0} { Surface{s}; };

BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{ramp[1]}; Delete; };

Mesh.CharacteristicLengthMax = 1.1;
