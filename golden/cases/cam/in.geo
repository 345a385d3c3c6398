SetFactory("OpenCASCADE");

// Two discs joined by tangents, with a bore.
r = 6;
q = 3;
d = 8;
sx = (r - q) / d;
cx = Sqrt(1 - sx * sx);
p = newp;
Point(p) = {r * sx, 0, r * cx};
Point(p + 1) = {d + q * sx, 0, q * cx};
Point(p + 2) = {d + q * sx, 0, -q * cx};
Point(p + 3) = {r * sx, 0, -r * cx};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p + 3};
Line(c + 3) = {p + 3, p};
Curve Loop(c + 4) = {c : c + 3};
s = news;
Plane Surface(s) = {c + 4};
web[] = Extrude {0, 3, 0} { Surface{s}; };

Cylinder(50) = {0, 0, 0, 0, 3, 0, r};
Cylinder(51) = {d, 0, 0, 0, 3, 0, q};
Cylinder(52) = {0, -1, 0, 0, 5, 0, 2};
BooleanUnion(60) = { Volume{web[1]}; Delete; }{ Volume{50, 51}; Delete; };
BooleanDifference(61) = { Volume{60}; Delete; }{ Volume{52}; Delete; };

Mesh.CharacteristicLengthMax = 1.3;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 16;
