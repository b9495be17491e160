"""Pictures of three problems by matplotlib: functions and meshes of NumPy in, arrays out.

    PYTHONPATH=build python3 examples/python/gallery.py [FOLDER]

needs matplotlib (python3-matplotlib) and leaves membrane.png, mesh.png and load.png in FOLDER, by default the current one.
"""
import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.tri import Triangulation

import unilateral


def triangles_of(result):
    """The linear cells of a 2-D result as triangles."""
    cells = result.cells
    if cells.shape[1] == 4:
        cells = np.vstack([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])
    return Triangulation(result.points[:, 0], result.points[:, 1], cells)


def membrane_over_dunes():
    """An obstacle that is a function of Python: called for many points at once."""
    def dunes(x):
        return -0.25 + 0.12 * np.sin(5 * x[:, 0]) * np.cos(4 * x[:, 1] + x[:, 0])

    return unilateral.Case({
        "title": "Membrane over dunes",
        "mesh": {"box": [[0, 0], [2, 1]], "cells": [16, 8], "refine": 3},
        "model": {"kind": "membrane", "load": -4},
        "boundary": {"all": 0},
        "constraint": {"lower": dunes},
    }).solve()


def ring_of_triangles(n=48, m=10):
    """A mesh by arrays: a ring, its inner rim held, with a ceiling given at the nodes."""
    angle, radius = np.meshgrid(2 * np.pi * np.arange(n) / n, np.linspace(0.3, 1, m + 1))
    points = np.column_stack([(radius * np.cos(angle)).ravel(), (radius * np.sin(angle)).ravel()])
    i, j = np.meshgrid(np.arange(n), np.arange(m))
    a, b = (j * n + i).ravel(), (j * n + (i + 1) % n).ravel()
    cells = np.vstack([np.column_stack([a, b, b + n]), np.column_stack([a, b + n, a + n])])
    rim = np.column_stack([np.arange(n), (np.arange(n) + 1) % n])
    return unilateral.Case({
        "title": "Ring under a slanted ceiling",
        "mesh": {"points": points, "cells": cells, "parts": {"inside": rim}, "refine": 1},
        "model": {"kind": "membrane", "element": "P1", "load": 2},
        "boundary": {"inside": 0, "boundary": "free"},
        "constraint": {"upper": {"values": 0.25 + 0.1 * points[:, 0]}},
    }).solve()


def force_over_load(loads=np.linspace(0.2, 3, 15)):
    """A string under a ceiling: the contact force over the load, many solutions of one case."""
    case = unilateral.Case({
        "mesh": {"box": [[0], [1]], "cells": 256},
        "model": {"kind": "membrane", "load": 1},
        "boundary": {"all": 0},
        "constraint": {"upper": 1 / 18},
    })
    return loads, np.array([
        case.with_settings({"model.load": float(f)}).solve().results["constraint"][0]["total_contact_force"] for f in loads])


def show(result, field, title, file):
    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    triangles = triangles_of(result)
    filled = axes.tripcolor(triangles, result.fields[field], shading="gouraud", cmap="viridis")
    axes.tricontour(triangles, result.fields["u"], colors="white", linewidths=0.6)
    axes.set_aspect("equal")
    axes.set_title(title)
    figure.colorbar(filled, label=field)
    figure.savefig(file, dpi=110)
    plt.close(figure)


def main(folder="."):
    folder = pathlib.Path(folder)
    membrane = membrane_over_dunes()
    show(membrane, "contact_pressure", f"Contact force {membrane.results['constraint'][0]['total_contact_force']:.4g}", folder / "membrane.png")
    ring = ring_of_triangles()
    show(ring, "contact_pressure", "A mesh by arrays", folder / "mesh.png")

    loads, forces = force_over_load()
    # The string touches the ceiling where the load is above 8/18 = 4/9; then two arcs of length sqrt(2 s / f) are free.
    exact = np.where(loads > 4 / 9, loads * (1 - 2 * np.sqrt(2 / 18 / loads)), 0)
    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    axes.plot(loads, exact, label="exact")
    axes.plot(loads, forces, "o", label="computed")
    axes.set_xlabel("load")
    axes.set_ylabel("contact force")
    axes.legend()
    figure.savefig(folder / "load.png", dpi=110)
    print(f"largest difference of the contact force to the exact one: {np.abs(forces - exact).max():.2g}")
    return np.abs(forces - exact).max()


if __name__ == "__main__":
    main(*sys.argv[1:])
