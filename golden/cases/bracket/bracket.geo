// A mounting bracket in millimetres: two plates at a right angle with a fillet between them, a gusset whose slope is exactly
// 45 degrees, a chamfer, rounded corners, two bolt holes, and a boss with a bore. The six labels of a polycube have to
// stand for faces that lie along no axis here. Made for polylab, same licence.
//
// To remake the surface mesh (gmsh 4.8):   gmsh bracket.geo -2 -format mesh -o bracket.mesh
SetFactory("OpenCASCADE");

length = 80;      // of the base plate, along X
width = 44;       // of both plates, along Y
height = 62;      // of the upright plate, along Z
plate = 8;        // thickness of both
fillet = 5;       // radius between the plates
gusset = 28;      // both legs of the stiffening rib
rib = 6;          // its thickness
chamfer = 4;      // at the far end of the base plate
corner = 10;      // radius of the upper corners of the upright plate
bolt = 4;         // radius of the two holes of the base plate
boss = 11;        // radius, standing out of the upright plate by
outward = 6;
bore = 6;         // radius of the hole through boss and plate
bore_z = 45;      // its height

middle = width / 2;
Box(1) = {0, 0, 0, length, width, plate};
Box(2) = {0, 0, 0, plate, width, height};
Cylinder(3) = {-outward, middle, bore_z, outward + plate, 0, 0, boss};

// The fillet: a square bar less a cylinder that touches both plates.
Box(4) = {plate, 0, plate, fillet, width, fillet};
Cylinder(5) = {plate + fillet, -1, plate + fillet, 0, width + 2, 0, fillet};
BooleanDifference(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };

// The gusset: a right triangle with equal legs in the XZ plane, extruded along Y.
p = newp;
Point(p) = {plate, middle - rib / 2, plate};
Point(p + 1) = {plate + gusset, middle - rib / 2, plate};
Point(p + 2) = {plate, middle - rib / 2, plate + gusset};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p};
l = newll;
Curve Loop(l) = {c, c + 1, c + 2};
s = news;
Plane Surface(s) = {l};
prism[] = Extrude {0, rib, 0} { Surface{s}; };

BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{2, 3, 6, prism[1]}; Delete; };

// What is cut away: the holes, the bore, the chamfer, the corners.
Cylinder(21) = {length - 18, 11, -1, 0, 0, plate + 2, bolt};
Cylinder(22) = {length - 18, width - 11, -1, 0, 0, plate + 2, bolt};
Cylinder(23) = {-outward - 1, middle, bore_z, outward + plate + 2, 0, 0, bore};
p = newp;
Point(p) = {length - chamfer, 0, plate};
Point(p + 1) = {length, 0, plate - chamfer};
Point(p + 2) = {length, 0, plate};
c = newc;
Line(c) = {p, p + 1};
Line(c + 1) = {p + 1, p + 2};
Line(c + 2) = {p + 2, p};
l = newll;
Curve Loop(l) = {c, c + 1, c + 2};
s = news;
Plane Surface(s) = {l};
wedge[] = Extrude {0, width, 0} { Surface{s}; };
Box(31) = {0, 0, height - corner, plate, corner, corner};
Cylinder(32) = {-1, corner, height - corner, plate + 2, 0, 0, corner};
BooleanDifference(33) = { Volume{31}; Delete; }{ Volume{32}; Delete; };
Box(34) = {0, width - corner, height - corner, plate, corner, corner};
Cylinder(35) = {-1, width - corner, height - corner, plate + 2, 0, 0, corner};
BooleanDifference(36) = { Volume{34}; Delete; }{ Volume{35}; Delete; };
BooleanDifference(40) = { Volume{20}; Delete; }{ Volume{21, 22, 23, wedge[1], 33, 36}; Delete; };

Mesh.CharacteristicLengthMax = 4.2;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 20;
