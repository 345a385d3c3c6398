SetFactory("OpenCASCADE");

// A block with fillets and a pocket.
Box(1) = {0, 0, 0, 14, 10, 6};
Fillet{1}{ 1, 3, 5, 7 }{ 2 }
Box(2) = {4, 3, 3, 6, 4, 4};
BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

Mesh.CharacteristicLengthMax = 1.4;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 16;
