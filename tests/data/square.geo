// Unit square, sides named; the lower left quarter is the region "corner". `interface` is a named curve inside the domain.
Point(1) = {0, 0, 0, 0.25}; Point(2) = {0.5, 0, 0, 0.25}; Point(3) = {1, 0, 0, 0.25};
Point(4) = {1, 1, 0, 0.25}; Point(5) = {0, 1, 0, 0.25}; Point(6) = {0, 0.5, 0, 0.25}; Point(7) = {0.5, 0.5, 0, 0.25};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Line(7) = {2, 7}; Line(8) = {7, 6};
Curve Loop(1) = {1, 7, 8, 6};
Curve Loop(2) = {2, 3, 4, 5, -8, -7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Physical Curve("left") = {5, 6};
Physical Curve("right") = {3};
Physical Curve("bottom") = {1, 2};
Physical Curve("interface") = {7, 8};
Physical Surface("corner") = {1};
Physical Surface("rest") = {2};
