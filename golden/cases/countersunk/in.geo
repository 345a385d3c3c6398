SetFactory("OpenCASCADE");

// A plate with countersunk holes.
Box(1) = {0, 0, 0, 16, 9, 3};
Cylinder(2) = {4, 4.5, -1, 0, 0, 5, 1.2};
Cone(3) = {4, 4.5, 1, 0, 0, 2, 1.2, 3};
Cylinder(4) = {11.5, 4.5, -1, 0, 0, 5, 1.5};
Cone(5) = {11.5, 4.5, 1.5, 0, 0, 1.5, 1.5, 3.5};
BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{2 : 5}; Delete; };

Mesh.CharacteristicLengthMax = 1.3;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 14;
