SetFactory("OpenCASCADE");

// A block with a pyramid on it and a pyramidal pocket.
Box(1) = {0, 0, 0, 14, 8, 4};
Macro Spire
    p = newp;
    Point(p) = {x - 2, y - 2, z};
    Point(p + 1) = {x + 2, y - 2, z};
    Point(p + 2) = {x + 2, y + 2, z};
    Point(p + 3) = {x - 2, y + 2, z};
    Point(p + 4) = {x, y, z + h};
    c = newc;
    For i In {0 : 3}
        Line(c + i) = {p + i, p + (i + 1) % 4};
        Line(c + 4 + i) = {p + i, p + 4};
    EndFor
    l = newll;
    Curve Loop(l) = {c : c + 3};
    s = news;
    Plane Surface(s) = {l};
    For i In {0 : 3}
        Curve Loop(l + 1 + i) = {c + i, c + 4 + (i + 1) % 4, -(c + 4 + i)};
        Plane Surface(s + 1 + i) = {l + 1 + i};
    EndFor
    Surface Loop(t) = {s : s + 4};
    Volume(t) = {t};
Return
x = 4; y = 4; z = 4; h = 5; t = 101;
Call Spire;
x = 10; y = 4; z = 4; h = -3; t = 102;
Call Spire;
BooleanUnion(110) = { Volume{1}; Delete; }{ Volume{101}; Delete; };
BooleanDifference(111) = { Volume{110}; Delete; }{ Volume{102}; Delete; };

Mesh.CharacteristicLengthMax = 1.0;
