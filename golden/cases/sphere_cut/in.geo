SetFactory("OpenCASCADE");

// A ball with a flat and a corner cut out.
Sphere(1) = {0, 0, 0, 5};
Box(2) = {0, 0, 0, 6, 6, 6};
Box(3) = {-6, -6, -6, 12, 12, 2.5};
BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };

Mesh.CharacteristicLengthMax = 1.0;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 14;
