#!/usr/bin/env python3
"""Makes rough-surface.asc, an ESRI ASCII grid (see README.md). Not part of build or tests.

    ./make_rough_surface.py > rough-surface.asc
"""
import math
import random

# Heights in micrometres on 65 x 65 points of a square of 10 mm: many waves of random direction and phase, wavelengths of 1.25 mm to
# 10 mm, amplitudes in proportion to wavelength^0.8, as on a self-affine surface.
SIZE, SIDE, HURST, WAVES, RMS = 65, 10.0, 0.8, 300, 60.0

chance = random.Random(1980)
waves = []
for _ in range(WAVES):
    wavelength = 1.25 * 8 ** chance.random()
    angle, phase = 2 * math.pi * chance.random(), 2 * math.pi * chance.random()
    k = 2 * math.pi / wavelength
    waves.append((k * math.cos(angle), k * math.sin(angle), phase, wavelength**HURST))
step = SIDE / (SIZE - 1)
heights = [
    [sum(a * math.cos(kx * step * i + ky * step * j + phase) for kx, ky, phase, a in waves) for i in range(SIZE)]
    for j in reversed(range(SIZE))  # the first row is the one with the largest y
]
flat = [h for row in heights for h in row]
mean = sum(flat) / len(flat)
rms = math.sqrt(sum((h - mean) ** 2 for h in flat) / len(flat))
lowest = min(flat)
print(f"ncols {SIZE}\nnrows {SIZE}\nxllcenter 0\nyllcenter 0\ncellsize {step}\nNODATA_value -9999")
for row in heights:
    print(" ".join(f"{(h - lowest) * RMS / rms:.1f}" for h in row))
