SetFactory("OpenCASCADE");

// A pipe that turns by 90 degrees, with straight ends.
Disk(1) = {0, 0, 0, 3};
Disk(2) = {0, 0, 0, 2};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
a[] = Extrude {0, 0, 6} { Surface{3}; };
b[] = Extrude {{0, 1, 0}, {8, 0, 6}, Pi / 2} { Surface{a[0]}; };
c[] = Extrude {6, 0, 0} { Surface{b[0]}; };
BooleanUnion(20) = { Volume{a[1]}; Delete; }{ Volume{b[1], c[1]}; Delete; };

Mesh.CharacteristicLengthMax = 1.5;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 16;
