SetFactory("OpenCASCADE");

// A thin plate with holes.
Box(1) = {0, 0, 0, 30, 20, 1};
For i In {0 : 2}
    For j In {0 : 1}
        Cylinder(10 + 2 * i + j) = {6 + 9 * i, 6 + 8 * j, -1, 0, 0, 3, 1.5 + 0.5 * i};
    EndFor
EndFor
BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{10 : 15}; Delete; };

Mesh.CharacteristicLengthMax = 2.8;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 12;
