SetFactory("OpenCASCADE");

// Shallow grooves of triangular section that cross: their creases are lost.
Box(1) = {-8, -8, -4, 16, 16, 4};
p = newp;
Point(p) = {-2, -9, 0.25};
Point(p + 1) = {0, -9, -1.5};
Point(p + 2) = {2, -9, 0.25};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p};
Curve Loop(c + 3) = {c : c + 2};
s = news;
Plane Surface(s) = {c + 3};
a[] = Extrude {0, 18, 0} { Surface{s}; };
p = newp;
Point(p) = {-9, -2, 0.25};
Point(p + 1) = {-9, 0, -1.5};
Point(p + 2) = {-9, 2, 0.25};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p};
Curve Loop(c + 3) = {c : c + 2};
s = news;
Plane Surface(s) = {c + 3};
b[] = Extrude {18, 0, 0} { Surface{s}; };

Rotate {{0, 0, 1}, {0, 0, 0}, Pi / 9} { Volume{a[1], b[1]}; }
BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{a[1], b[1]}; Delete; };

Mesh.CharacteristicLengthMax = 1.6;
