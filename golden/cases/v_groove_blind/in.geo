SetFactory("OpenCASCADE");

// A shallow groove of triangular section that ends inside the plate's top.
Box(1) = {0, 0, 0, 14, 9, 4};
p = newp;
Point(p) = {4, -1, 4.5};
Point(p + 1) = {7, -1, 2.4};
Point(p + 2) = {10, -1, 4.5};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p};
Curve Loop(c + 3) = {c : c + 2};
s = news;
Plane Surface(s) = {c + 3};
groove[] = Extrude {0, 6.5, 0} { Surface{s}; };

BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{groove[1]}; Delete; };

Mesh.CharacteristicLengthMax = 1.0;
