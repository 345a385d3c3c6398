SetFactory("OpenCASCADE");

// A tapered arm between two bosses, its sides tangent to them.
r = 5;
q = 2.5;
d = 16;
sx = (r - q) / d;
cx = Sqrt(1 - sx * sx);
p = newp;
Point(p) = {r * sx, r * cx, 0};
Point(p + 1) = {d + q * sx, q * cx, 0};
Point(p + 2) = {d + q * sx, -q * cx, 0};
Point(p + 3) = {r * sx, -r * cx, 0};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p + 3};
Line(c + 3) = {p + 3, p};
Curve Loop(c + 4) = {c : c + 3};
s = news;
Plane Surface(s) = {c + 4};
arm[] = Extrude {0, 0, 3} { Surface{s}; };

Cylinder(50) = {0, 0, 0, 0, 0, 6, r};
Cylinder(51) = {d, 0, 0, 0, 0, 5, q};
Cylinder(52) = {0, 0, -1, 0, 0, 8, 2.5};
BooleanUnion(60) = { Volume{arm[1]}; Delete; }{ Volume{50, 51}; Delete; };
BooleanDifference(61) = { Volume{60}; Delete; }{ Volume{52}; Delete; };

Mesh.CharacteristicLengthMax = 1.5;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 16;
