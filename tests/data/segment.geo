// The interval [1, 3] in two regions, its ends named.
Point(1) = {1, 0, 0, 0.25}; Point(2) = {2, 0, 0, 0.25}; Point(3) = {3, 0, 0, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3};
Physical Point("start") = {1};
Physical Point("end") = {3};
Physical Curve("fine") = {1};
Physical Curve("coarse") = {2};
