SetFactory("OpenCASCADE");

// Twelve teeth with slanted flanks and a bore.
n = 12;
Cylinder(1) = {0, 0, 0, 0, 0, 3, 8};
For i In {0 : n - 1}
    p = newp;
    Point(p) = {7.5, -1.3, 0};
    Point(p + 1) = {10, -0.6, 0};
    Point(p + 2) = {10, 0.6, 0};
    Point(p + 3) = {7.5, 1.3, 0};
    c = newc;
    Line(c) = {p, p + 1};
    Line(c + 1) = {p + 1, p + 2};
    Line(c + 2) = {p + 2, p + 3};
    Line(c + 3) = {p + 3, p};
    Curve Loop(c + 4) = {c : c + 3};
    s = news;
    Plane Surface(s) = {c + 4};
    tooth[] = Extrude {0, 0, 3} { Surface{s}; };
    Rotate {{0, 0, 1}, {0, 0, 0}, i * 2 * Pi / n} { Volume{tooth[1]}; }
    teeth[i] = tooth[1];
EndFor
Cylinder(100) = {0, 0, -1, 0, 0, 5, 3};
BooleanUnion(200) = { Volume{1}; Delete; }{ Volume{teeth[]}; Delete; };
BooleanDifference(201) = { Volume{200}; Delete; }{ Volume{100}; Delete; };

Mesh.CharacteristicLengthMax = 1.5;
