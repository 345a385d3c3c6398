SetFactory("OpenCASCADE");

// Three blades at 120 degrees, pitched by 30 degrees.
Cylinder(1) = {-3, 0, 0, 6, 0, 0, 2.5};
For i In {0 : 2}
    Box(10 + i) = {-2.5, -0.4, 1, 5, 0.8, 9};
    Rotate {{0, 0, 1}, {0, 0, 0}, Pi / 6} { Volume{10 + i}; }
    Rotate {{1, 0, 0}, {0, 0, 0}, i * 2 * Pi / 3} { Volume{10 + i}; }
EndFor
BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{10 : 12}; Delete; };

Mesh.CharacteristicLengthMax = 1.0;
