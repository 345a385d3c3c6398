SetFactory("OpenCASCADE");

// A square bar along no axis through a block.
Box(1) = {-4, -4, -4, 8, 8, 8};
Box(2) = {-1.5, -1.5, -9, 3, 3, 18};
Rotate {{1, 0, 0}, {0, 0, 0}, Pi / 5} { Volume{2}; }
Rotate {{0, 0, 1}, {0, 0, 0}, Pi / 7} { Volume{2}; }
BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

Mesh.CharacteristicLengthMax = 1.3;
