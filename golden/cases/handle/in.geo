SetFactory("OpenCASCADE");

// Half a ring on a plate.
Box(1) = {-8, -3, -2, 16, 6, 2};
Torus(2) = {0, 0, 0, 5, 1.4, 2 * Pi};
Rotate {{1, 0, 0}, {0, 0, 0}, Pi / 2} { Volume{2}; }
Box(3) = {-9, -4, -9, 18, 8, 8};
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{4}; Delete; };

Mesh.CharacteristicLengthMax = 1.4;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 12;
