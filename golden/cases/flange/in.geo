SetFactory("OpenCASCADE");

// A flange with a collar and six bolt holes.
Cylinder(1) = {0, 0, 0, 0, 0, 2, 8};
Cylinder(2) = {0, 0, 0, 0, 0, 8, 4};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0, 0, -1, 0, 0, 10, 2.5};
For i In {0 : 5}
    Cylinder(10 + i) = {6 * Cos(i * Pi / 3), 6 * Sin(i * Pi / 3), -1, 0, 0, 4, 0.8};
EndFor
BooleanDifference(20) = { Volume{3}; Delete; }{ Volume{4, 10 : 15}; Delete; };

Mesh.CharacteristicLengthMax = 1.7;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 10;
