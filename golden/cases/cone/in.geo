SetFactory("OpenCASCADE");

// A cone with an apex on a square plate.
Box(1) = {-5, -5, 0, 10, 10, 2};
Cone(2) = {0, 0, 2, 0, 0, 9, 3.5, 0};
BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

Mesh.CharacteristicLengthMax = 1.1;
