// An angle bracket, millimetres: a foot 70 x 40 x 8 with a bolt hole, a web 8 thick and 60 high, a fillet between them.
// Parts: foot (rests on the ground), bolt (ring under the washer), hole (its wall), load (upper end of the web). Region: bracket.
SetFactory("OpenCASCADE");

length = 70; width = 40; height = 60; thickness = 8; fillet = 8;
bolt_x = 42; hole = 11 / 2; washer = 20 / 2;

// The profile in the plane y = 0, pulled along y.
Point(1) = {0, 0, 0};
Point(2) = {length, 0, 0};
Point(3) = {length, 0, thickness};
Point(4) = {thickness + fillet, 0, thickness};
Point(5) = {thickness + fillet, 0, thickness + fillet};
Point(6) = {thickness, 0, thickness + fillet};
Point(7) = {thickness, 0, height};
Point(8) = {0, 0, height};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Circle(4) = {4, 5, 6};
Line(5) = {6, 7};
Line(6) = {7, 8};
Line(7) = {8, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7};
Plane Surface(1) = {1};
Extrude {0, width, 0} { Surface{1}; }

// The hole, and the ring of the washer drawn on the foot.
Cylinder(10) = {bolt_x, width / 2, -1, 0, 0, thickness + 2, hole};
BooleanDifference{ Volume{1}; Delete; }{ Volume{10}; Delete; }
Disk(100) = {bolt_x, width / 2, thickness, washer};
BooleanFragments{ Volume{1}; Delete; }{ Surface{100}; Delete; }
Recursive Delete { Surface{:}; }

d = 0.01;
foot() = Surface In BoundingBox{-d, -d, -d, length + d, width + d, d};
load() = Surface In BoundingBox{-d, -d, height - d, thickness + d, width + d, height + d};
bolt() = Surface In BoundingBox{bolt_x - washer - d, width / 2 - washer - d, thickness - d, bolt_x + washer + d, width / 2 + washer + d, thickness + d};
wall() = Surface In BoundingBox{bolt_x - hole - d, width / 2 - hole - d, -d, bolt_x + hole + d, width / 2 + hole + d, thickness + d};
Physical Surface("foot") = foot();
Physical Surface("load") = load();
Physical Surface("bolt") = bolt();
Physical Surface("hole") = wall();
Physical Volume("bracket") = Volume{:};

Mesh.MeshSizeMax = 4;
Mesh.MeshSizeFromCurvature = 24;     // cells on a full circle
Mesh.MeshSizeMin = 1.4;
Mesh.Optimize = 1;
