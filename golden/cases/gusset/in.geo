SetFactory("OpenCASCADE");

// Two plates at a right angle with a triangular rib between them.
Box(1) = {0, 0, 0, 12, 8, 1.5};
Box(2) = {0, 0, 0, 1.5, 8, 10};
p = newp;
Point(p) = {1.5, 3, 1.5};
Point(p + 1) = {9, 3, 1.5};
Point(p + 2) = {1.5, 3, 8};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p};
Curve Loop(c + 3) = {c : c + 2};
s = news;
Plane Surface(s) = {c + 3};
rib[] = Extrude {0, 2, 0} { Surface{s}; };

BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{2, rib[1]}; Delete; };

Mesh.CharacteristicLengthMax = 1.2;
