SetFactory("OpenCASCADE");

// A cylinder that stands on a slope.
p = newp;
Point(p) = {0, 0, 0};
Point(p + 1) = {14, 0, 0};
Point(p + 2) = {14, 0, 7};
Point(p + 3) = {0, 0, 2};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p + 3};
Line(c + 3) = {p + 3, p};
Curve Loop(c + 4) = {c : c + 3};
s = news;
Plane Surface(s) = {c + 4};
ramp[] = Extrude {0, 9, 0} { Surface{s}; };

Cylinder(50) = {6, 4.5, 3, -2, 0, 6, 2.2};
BooleanUnion(60) = { Volume{ramp[1]}; Delete; }{ Volume{50}; Delete; };

Mesh.CharacteristicLengthMax = 1.2;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 14;
