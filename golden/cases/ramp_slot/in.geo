SetFactory("OpenCASCADE");

// A box with an inclined slot: the side faces of the slot are triangles.
Box(1) = {0, 0, 0, 12, 8, 6};
p = newp;
Point(p) = {3, 2.5, 6.5};
Point(p + 1) = {13, 2.5, 6.5};
Point(p + 2) = {13, 2.5, 2};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p};
Curve Loop(c + 3) = {c : c + 2};
s = news;
Plane Surface(s) = {c + 3};
slot[] = Extrude {0, 3, 0} { Surface{s}; };

BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{slot[1]}; Delete; };

Mesh.CharacteristicLengthMax = 1.0;
