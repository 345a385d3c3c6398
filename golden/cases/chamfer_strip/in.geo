SetFactory("OpenCASCADE");

// A tilted strip along a pillar: chamfers at 30 degrees that run out.
Box(1) = {0, 0, 0, 10, 8, 12};
Box(2) = {-3, -6, -6, 6, 20, 12};
Rotate {{0, 1, 0}, {0, 0, 0}, Pi / 6} { Volume{2}; }
Rotate {{1, 0, 0}, {0, 0, 0}, Pi / 12} { Volume{2}; }
Translate {10, 0, 10} { Volume{2}; }
BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

Mesh.CharacteristicLengthMax = 1.3;
