SetFactory("OpenCASCADE");

// Every edge of a block rounded.
Box(1) = {0, 0, 0, 12, 9, 6};
Fillet{1}{ 1 : 12 }{ 2 }

Mesh.CharacteristicLengthMax = 1.3;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 16;
