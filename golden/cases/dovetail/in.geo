SetFactory("OpenCASCADE");

// A dovetail slot: its sides lean over the floor.
p = newp;
Point(p) = {0, 0, 0};
Point(p + 1) = {14, 0, 0};
Point(p + 2) = {14, 0, 7};
Point(p + 3) = {9, 0, 7};
Point(p + 4) = {11, 0, 3};
Point(p + 5) = {3, 0, 3};
Point(p + 6) = {5, 0, 7};
Point(p + 7) = {0, 0, 7};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p + 3};
Line(c + 3) = {p + 3, p + 4};
Line(c + 4) = {p + 4, p + 5};
Line(c + 5) = {p + 5, p + 6};
Line(c + 6) = {p + 6, p + 7};
Line(c + 7) = {p + 7, p};
Curve Loop(c + 8) = {c : c + 7};
s = news;
Plane Surface(s) = {c + 8};
body[] = Extrude {0, 8, 0} { Surface{s}; };

Mesh.CharacteristicLengthMax = 1.3;
