SetFactory("OpenCASCADE");

// A door-stop with a hole through its slope.
p = newp;
Point(p) = {0, 0, 0};
Point(p + 1) = {14, 0, 0};
Point(p + 2) = {0, 0, 6};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p};
Curve Loop(c + 3) = {c : c + 2};
s = news;
Plane Surface(s) = {c + 3};
stop[] = Extrude {0, 6, 0} { Surface{s}; };

Cylinder(50) = {4, 3, -1, 0, 0, 10, 1.3};
BooleanDifference(60) = { Volume{stop[1]}; Delete; }{ Volume{50}; Delete; };

Mesh.CharacteristicLengthMax = 1.1;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 12;
