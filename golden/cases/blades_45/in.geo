SetFactory("OpenCASCADE");

// A hub along X with four blades around it, each turned by 45 degrees around its own radius.
Cylinder(1) = {-4, 0, 0, 8, 0, 0, 3};
For i In {0 : 3}
    Box(10 + i) = {-2.5, -0.5, 1, 5, 1, 9};
    Rotate {{0, 0, 1}, {0, 0, 0}, Pi / 4} { Volume{10 + i}; }
    Rotate {{1, 0, 0}, {0, 0, 0}, i * Pi / 2} { Volume{10 + i}; }
EndFor
BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{10 : 13}; Delete; };

Mesh.CharacteristicLengthMax = 1.2;
