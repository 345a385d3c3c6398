SetFactory("OpenCASCADE");

// Two cylinders of the same radius: their curves cross at two points.
Cylinder(1) = {0, 0, -7, 0, 0, 14, 3};
Cylinder(2) = {-7, 0, 0, 14, 0, 0, 3};
BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

Mesh.CharacteristicLengthMax = 1.2;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 16;
