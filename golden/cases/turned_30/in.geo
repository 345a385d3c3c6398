SetFactory("OpenCASCADE");

// An angle bracket with a hole, turned by 30 degrees around Z and by 30 around X.
Box(1) = {0, 0, 0, 12, 8, 2};
Box(2) = {0, 0, 0, 2, 8, 10};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {7, 4, -1, 0, 0, 4, 2};
BooleanDifference(20) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
Rotate {{0, 0, 1}, {0, 0, 0}, Pi / 6} { Volume{20}; }
Rotate {{1, 0, 0}, {0, 0, 0}, Pi / 6} { Volume{20}; }

Mesh.CharacteristicLengthMax = 1.4;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 12;
