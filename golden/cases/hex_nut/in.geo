SetFactory("OpenCASCADE");

// A hexagonal nut, chamfered by a cone.
n = 6;
p = newp;
For i In {0 : n - 1}
    Point(p + i) = {6 * Cos(i * Pi / 3), 6 * Sin(i * Pi / 3), 0};
EndFor
c = newc;
For i In {0 : n - 1}
    Line(c + i) = {p + i, p + (i + 1) % n};
EndFor
Curve Loop(c + n) = {c : c + n - 1};
s = news;
Plane Surface(s) = {c + n};
nut[] = Extrude {0, 0, 4} { Surface{s}; };
Cone(50) = {0, 0, -4, 0, 0, 8, 11, 5.2};
Cylinder(51) = {0, 0, -1, 0, 0, 6, 3};
BooleanIntersection(60) = { Volume{nut[1]}; Delete; }{ Volume{50}; Delete; };
BooleanDifference(61) = { Volume{60}; Delete; }{ Volume{51}; Delete; };

Mesh.CharacteristicLengthMax = 1.2;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 14;
