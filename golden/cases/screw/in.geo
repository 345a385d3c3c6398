SetFactory("OpenCASCADE");

// A thread-like ridge: blades along a helix on a shaft.
Cylinder(1) = {0, 0, -2, 0, 0, 12, 2};
For i In {0 : 7}
    Box(10 + i) = {0, -1.6, -0.5, 4, 3.2, 1};
    Rotate {{1, 0, 0}, {0, 0, 0}, Pi / 8} { Volume{10 + i}; }
    Rotate {{0, 0, 1}, {0, 0, 0}, i * Pi / 4} { Volume{10 + i}; }
    Translate {0, 0, i * 1.1} { Volume{10 + i}; }
EndFor
BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{10 : 17}; Delete; };

Mesh.CharacteristicLengthMax = 1.0;
