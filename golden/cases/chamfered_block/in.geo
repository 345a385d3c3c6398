SetFactory("OpenCASCADE");

// Two edges with chamfers, one at 45 degrees and one at a small angle; a shallow crease is no boundary.
p = newp;
Point(p) = {0, 0, 0};
Point(p + 1) = {14, 0, 0};
Point(p + 2) = {14, 0, 5};
Point(p + 3) = {12, 0, 7};
Point(p + 4) = {6, 0, 7.5};
Point(p + 5) = {0, 0, 5};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p + 3};
Line(c + 3) = {p + 3, p + 4};
Line(c + 4) = {p + 4, p + 5};
Line(c + 5) = {p + 5, p};
Curve Loop(c + 6) = {c : c + 5};
s = news;
Plane Surface(s) = {c + 6};
body[] = Extrude {0, 8, 0} { Surface{s}; };

Mesh.CharacteristicLengthMax = 1.3;
