SetFactory("OpenCASCADE");

// Three legs that spread from one block.
Box(1) = {-2, -2, 8, 4, 4, 3};
For i In {0 : 2}
    Box(10 + i) = {-1, -1, -2, 2, 2, 12};
    Rotate {{0, 1, 0}, {0, 0, 9.5}, Pi / 6} { Volume{10 + i}; }
    Rotate {{0, 0, 1}, {0, 0, 0}, i * 2 * Pi / 3 + Pi / 12} { Volume{10 + i}; }
EndFor
BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{10 : 12}; Delete; };

Mesh.CharacteristicLengthMax = 1.1;
