SetFactory("OpenCASCADE");

// A block with a hole drilled at an angle.
Box(1) = {-5, -5, -4, 10, 10, 8};
Cylinder(2) = {-6, -4, -9, 12, 8, 18, 2};
BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

Mesh.CharacteristicLengthMax = 1.3;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 16;
