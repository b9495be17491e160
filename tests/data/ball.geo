// A ball of about 700 tetrahedra.
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 1};
Mesh.MeshSizeMax = 0.45;
Physical Surface("rim") = {1};
Physical Volume("body") = {1};
