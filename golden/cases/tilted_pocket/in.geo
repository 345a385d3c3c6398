SetFactory("OpenCASCADE");

// A block with a pocket that was milled askew.
Box(1) = {0, 0, 0, 12, 10, 7};
Box(2) = {3, 3, 3, 6, 4, 8};
Rotate {{0, 0, 1}, {6, 5, 5}, Pi / 5} { Volume{2}; }
Rotate {{1, 0, 0}, {6, 5, 5}, Pi / 9} { Volume{2}; }
BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

Mesh.CharacteristicLengthMax = 1.3;
