SetFactory("OpenCASCADE");

// A ball on a conical stem.
Sphere(1) = {0, 0, 9, 3.5};
Cone(2) = {0, 0, 0, 0, 0, 9, 3.5, 1.2};
Box(3) = {-5, -5, -2, 10, 10, 2};
BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };

Mesh.CharacteristicLengthMax = 1.3;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 14;
