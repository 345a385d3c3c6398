SetFactory("OpenCASCADE");

// A cylinder with a slanted end, lying askew.
Cylinder(1) = {0, 0, 0, 0, 0, 14, 4};
Box(2) = {-10, -10, 0, 20, 20, 10};
Rotate {{1, 1, 0}, {0, 0, 0}, Pi / 7} { Volume{2}; }
Translate {0, 0, 10} { Volume{2}; }
BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

Mesh.CharacteristicLengthMax = 1.2;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 16;
