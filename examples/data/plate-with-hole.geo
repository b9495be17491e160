// A plate 2 x 1 with a round hole of radius 0.2 at (0.6, 0.5) in its left half; the right half is a second material.
// Regions: soft (left), hard (right). Parts: left right bottom top hole.
// plate-with-hole.msh is made of this by: gmsh -2 -format msh41 plate-with-hole.geo
h = 0.06;
Mesh.MeshSizeMax = h;

Point(1) = {0, 0, 0, h};
Point(2) = {1.2, 0, 0, h};
Point(3) = {2, 0, 0, h};
Point(4) = {2, 1, 0, h};
Point(5) = {1.2, 1, 0, h};
Point(6) = {0, 1, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {2, 5};

Point(10) = {0.6, 0.5, 0, h / 2};
Point(11) = {0.8, 0.5, 0, h / 2};
Point(12) = {0.6, 0.7, 0, h / 2};
Point(13) = {0.4, 0.5, 0, h / 2};
Point(14) = {0.6, 0.3, 0, h / 2};
Circle(11) = {11, 10, 12};
Circle(12) = {12, 10, 13};
Circle(13) = {13, 10, 14};
Circle(14) = {14, 10, 11};

Curve Loop(1) = {1, 7, 5, 6};
Curve Loop(2) = {11, 12, 13, 14};
Curve Loop(3) = {2, 3, 4, -7};
Plane Surface(1) = {1, 2};
Plane Surface(2) = {3};

Physical Curve("left") = {6};
Physical Curve("right") = {3};
Physical Curve("bottom") = {1, 2};
Physical Curve("top") = {4, 5};
Physical Curve("hole") = {11, 12, 13, 14};
Physical Surface("soft") = {1};
Physical Surface("hard") = {2};
