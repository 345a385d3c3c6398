SetFactory("OpenCASCADE");

// A cone alone, steeper than 45 degrees.
Cone(1) = {0, 0, 0, 0, 0, 8, 4, 0};

Mesh.CharacteristicLengthMax = 0.9;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 20;
