#!/usr/bin/env python3
"""Makes dome.stl (see README.md). Not part of build or tests.

    ./make_dome.py > dome.stl
"""
import math

# A cap of a sphere of radius 50 mm with its summit at the origin, over the disc of radius 15 mm, in facets: rings 1 mm apart, 32 to a
# circle. The normals point up, out of the solid dome.
RADIUS, REACH, RINGS, SECTORS = 50.0, 15.0, 15, 32


def corner(ring, sector):
    r, angle = REACH * ring / RINGS, 2 * math.pi * (sector % SECTORS) / SECTORS
    return (r * math.cos(angle), r * math.sin(angle), math.sqrt(RADIUS**2 - r * r) - RADIUS)


def facet(a, b, c):
    u, v = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    size = math.sqrt(sum(x * x for x in n))
    print("facet normal " + " ".join(f"{x / size:.4f}" for x in n) + "\nouter loop")
    for p in (a, b, c):
        print("vertex " + " ".join(f"{x:.4f}" for x in p))
    print("endloop\nendfacet")


print("solid dome")
for s in range(SECTORS):
    facet(corner(0, 0), corner(1, s), corner(1, s + 1))
    for r in range(1, RINGS):
        facet(corner(r, s), corner(r + 1, s), corner(r + 1, s + 1))
        facet(corner(r, s), corner(r + 1, s + 1), corner(r, s + 1))
print("endsolid dome")
