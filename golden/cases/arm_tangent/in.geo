SetFactory("OpenCASCADE");

// A straight arm whose top is tangent to a boss that lies on its side.
Box(1) = {0, 0, 0, 16, 4, 5};
Cylinder(2) = {16, -1, 1, 0, 6, 0, 4};
BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

Mesh.CharacteristicLengthMax = 1.3;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 16;
