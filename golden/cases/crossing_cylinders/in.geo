SetFactory("OpenCASCADE");

// Three cylinders of different radii that cross.
Cylinder(1) = {0, 0, -8, 0, 0, 16, 3};
Cylinder(2) = {-8, 0, 0, 16, 0, 0, 2};
Cylinder(3) = {0, 0, 0, 0, 9, 0, 2.5};
BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };

Mesh.CharacteristicLengthMax = 1.3;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 16;
