SetFactory("OpenCASCADE");

// A frustum with a conical bore.
Cone(1) = {0, 0, 0, 8, 0, 0, 5, 2};
Cone(2) = {-1, 0, 0, 10, 0, 0, 4, 0.8};
BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

Mesh.CharacteristicLengthMax = 1.0;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 16;
