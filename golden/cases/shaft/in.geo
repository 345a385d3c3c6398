SetFactory("OpenCASCADE");

// A stepped shaft with a keyway and a conical end.
Cylinder(1) = {0, 0, 0, 6, 0, 0, 4};
Cylinder(2) = {6, 0, 0, 7, 0, 0, 2.5};
Cone(3) = {13, 0, 0, 3, 0, 0, 2.5, 1};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Box(5) = {7.5, -0.75, 1.5, 4, 1.5, 3};
BooleanDifference(20) = { Volume{4}; Delete; }{ Volume{5}; Delete; };

Mesh.CharacteristicLengthMax = 1.2;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 14;
