SetFactory("OpenCASCADE");

// Where two balls meet: a sharp rim.
Sphere(1) = {0, 0, -3, 5};
Sphere(2) = {0, 0, 3, 5};
BooleanIntersection(20) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

Mesh.CharacteristicLengthMax = 0.6;
