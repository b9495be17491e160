#!/usr/bin/env python3
"""One part, one mesh, one penalty parameter: CalculiX and Unilateral side by side. Needs ccx and gmsh, and only Python's own library.

    ./compare.py                     both programs, quadratic tetrahedra
    ./compare.py --element P1        linear ones
    ./compare.py --scale 0.6         a finer mesh (factor on Gmsh's cell sizes)
    ./compare.py --only calculix     one of them
"""
import argparse
import json
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import time
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
WORK = HERE / "work"


# --- the mesh -------------------------------------------------------------------------------------------------------------------------


def read_msh(path):
    """Nodes {tag: point} and elements {(dimension, physical name): [tags of the corners]} of a Gmsh 4.1 text file."""
    words = iter(path.read_text().split("\n"))
    names, entities, nodes, groups = {}, {}, {}, {}
    for line in words:
        if line == "$PhysicalNames":
            for _ in range(int(next(words))):
                dimension, tag, name = next(words).split(maxsplit=2)
                names[int(dimension), int(tag)] = name.strip('"')
        elif line == "$Entities":
            for dimension, count in enumerate(map(int, next(words).split())):
                for _ in range(count):
                    entry = next(words).split()
                    first = 4 if dimension == 0 else 7
                    tags = entry[first + 1 : first + 1 + int(entry[first])]
                    entities[dimension, int(entry[0])] = [names[dimension, int(t)] for t in tags if (dimension, int(t)) in names]
        elif line == "$Nodes":
            for _ in range(int(next(words).split()[0])):
                count = int(next(words).split()[3])
                tags = [int(next(words)) for _ in range(count)]
                for tag in tags:
                    nodes[tag] = tuple(map(float, next(words).split()[:3]))
        elif line == "$Elements":
            for _ in range(int(next(words).split()[0])):
                dimension, entity, _, count = map(int, next(words).split())
                for _ in range(count):
                    corners = list(map(int, next(words).split()))[1:]
                    for name in entities[dimension, entity]:
                        groups.setdefault((dimension, name), []).append(corners)
    return nodes, groups


def difference(a, b):
    return [a[i] - b[i] for i in range(3)]


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


class Part:
    """The mesh with the nodes that the element needs: those of the corners, and for P2 the midpoints of straight edges."""

    def __init__(self, path, element):
        self.nodes, groups = read_msh(path)
        self.quadratic = element == "P2"
        self.middle = {}
        (_, tetrahedra), = [(k, v) for k, v in groups.items() if k[0] == 3]
        self.cells, self.face_of = [], {}
        for number, corners in enumerate(tetrahedra, start=1):
            a, b, c, d = (self.nodes[t] for t in corners)
            if sum(x * y for x, y in zip(cross(difference(b, a), difference(c, a)), difference(d, a))) < 0:
                corners[1], corners[2] = corners[2], corners[1]
            a, b, c, d = corners
            edges = [(a, b), (b, c), (c, a), (a, d), (b, d), (c, d)] if self.quadratic else []
            self.cells.append(corners + [self.midpoint(*edge) for edge in edges])
            # The faces of C3D4 and C3D10 as CalculiX numbers them.
            for face, triangle in enumerate(((a, b, c), (a, d, b), (b, d, c), (c, d, a)), start=1):
                self.face_of[frozenset(triangle)] = (number, face)
        self.parts = {name: triangles for (dimension, name), triangles in groups.items() if dimension == 2}

    def midpoint(self, a, b):
        key = (min(a, b), max(a, b))
        if key not in self.middle:
            self.middle[key] = max(self.nodes) + 1 if not self.middle else self.middle_next
            self.middle_next = self.middle[key] + 1
            self.nodes[self.middle[key]] = tuple((self.nodes[a][i] + self.nodes[b][i]) / 2 for i in range(3))
        return self.middle[key]

    def triangle_nodes(self, triangle):
        a, b, c = triangle
        return [a, b, c] + ([self.midpoint(a, b), self.midpoint(b, c), self.midpoint(c, a)] if self.quadratic else [])

    def part_nodes(self, part):
        return sorted({node for triangle in self.parts[part] for node in self.triangle_nodes(triangle)})

    def loads(self, part, pressure, traction):
        """Nodal forces of a constant stress vector: a third of the area at each corner for P1, at each midpoint for P2."""
        forces = {}
        for triangle in self.parts[part]:
            a, b, c = (self.nodes[t] for t in triangle)
            area_vector = [x / 2 for x in cross(difference(b, a), difference(c, a))]
            opposite, = [t for t in self.cells[self.face_of[frozenset(triangle)][0] - 1][:4] if t not in triangle]
            if sum(x * y for x, y in zip(area_vector, difference(self.nodes[opposite], a))) > 0:
                area_vector = [-x for x in area_vector]
            area = math.sqrt(sum(x * x for x in area_vector))
            for node in self.triangle_nodes(triangle)[-3:]:
                force = forces.setdefault(node, [0.0, 0.0, 0.0])
                for i in range(3):
                    force[i] += (traction[i] * area - pressure * area_vector[i]) / 3
        return forces

    def node_at(self, point):
        return min(self.nodes, key=lambda t: math.dist(self.nodes[t], point))


# --- CalculiX -------------------------------------------------------------------------------------------------------------------------


def rows(numbers, width=8):
    numbers = list(numbers)
    return "\n".join(", ".join(map(str, numbers[i : i + width])) for i in range(0, len(numbers), width))


def write_inp(path, case, part, solver):
    """The case for CalculiX: the part, and a plate that does not move, of one hexahedron, whose top is the plane."""
    model, constraint = case["model"], case["constraint"]
    plane = constraint["gap"]["plane"]
    if plane["normal"] != [0, 0, 1]:
        sys.exit("compare.py knows planes of normal [0, 0, 1] only")
    level = plane["point"][2]
    low, high = ([pick(p[i] for p in part.nodes.values()) for i in range(3)] for pick in (min, max))
    margin = 0.2 * max(high[i] - low[i] for i in range(2))
    first = max(part.nodes) + 1
    corners = [(low[0] - margin, low[1] - margin), (high[0] + margin, low[1] - margin)]
    corners += [(high[0] + margin, high[1] + margin), (low[0] - margin, high[1] + margin)]
    plate = [(x, y, z) for z in (level - margin, level) for x, y in corners]
    kind = "C3D10" if part.quadratic else "C3D4"

    text = ["*NODE, NSET=PART"]
    text += [f"{tag}, {x:.16g}, {y:.16g}, {z:.16g}" for tag, (x, y, z) in part.nodes.items()]
    text += ["*NODE, NSET=PLATE"] + [f"{first + i}, {x:.16g}, {y:.16g}, {z:.16g}" for i, (x, y, z) in enumerate(plate)]
    text += [f"*ELEMENT, TYPE={kind}, ELSET=PART"]
    text += [f"{number}, " + ", ".join(map(str, cell)) for number, cell in enumerate(part.cells, start=1)]
    text += ["*ELEMENT, TYPE=C3D8, ELSET=PLATE", f"{len(part.cells) + 1}, " + ", ".join(str(first + i) for i in range(8))]
    text += ["*MATERIAL, NAME=M", "*ELASTIC", f"{model['young']}, {model['poisson']}"]
    text += ["*SOLID SECTION, ELSET=PART, MATERIAL=M", "*SOLID SECTION, ELSET=PLATE, MATERIAL=M"]
    text += ["*SURFACE, NAME=FOOT, TYPE=ELEMENT"]
    text += ["{}, S{}".format(*part.face_of[frozenset(triangle)]) for triangle in part.parts[constraint["on"]]]
    text += ["*SURFACE, NAME=GROUND, TYPE=ELEMENT", f"{len(part.cells) + 1}, S2"]
    # No friction is the default. Linear: pressure = penetration/epsilon.
    text += ["*SURFACE INTERACTION, NAME=TOUCH", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{1 / case['method']['epsilon']:.10g}"]
    text += ["*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE", "FOOT, GROUND"]
    text += ["*BOUNDARY", "PLATE, 1, 3, 0"]
    loads = {}
    for name, condition in case["boundary"].items():
        fixed = [axis for axis in "xyz" if condition.get(axis) == 0]
        text += [f"{node}, {'xyz'.index(axis) + 1}, {'xyz'.index(axis) + 1}, 0" for node in part.part_nodes(name) for axis in fixed]
        if "pressure" in condition or "traction" in condition:
            for node, force in part.loads(name, condition.get("pressure", 0), condition.get("traction", [0, 0, 0])).items():
                loads[node] = [p + q for p, q in zip(loads.get(node, (0, 0, 0)), force)]
    probes = [part.node_at(point) for point in case["output"]["probes"]]
    text += ["*NSET, NSET=PROBES", rows(sorted(set(probes)))]
    text += ["*STEP", f"*STATIC, SOLVER={solver}", "1, 1", "*CLOAD"]
    text += [f"{node}, {i + 1}, {force[i]:.16g}" for node, force in loads.items() for i in range(3) if force[i] != 0]
    text += ["*NODE PRINT, NSET=PROBES", "U", "*NODE PRINT, NSET=PLATE, TOTALS=ONLY", "RF", "*END STEP"]
    path.write_text("\n".join(text) + "\n")
    return probes, [sum(force[i] for force in loads.values()) for i in range(3)]


def read_dat(path):
    """Displacements {node: vector} and the sum of the reactions of the plate, at the end of the step."""
    displacements, total, reading = {}, None, None
    for line in path.read_text().split("\n"):
        low = line.lower()
        if "displacements" in low:
            reading, displacements = "u", {}
        elif "total force" in low:
            reading = "rf"
        elif line.strip():
            numbers = [float(w) for w in re.findall(r"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?", line)]
            if reading == "u":
                displacements[int(numbers[0])] = numbers[1:4]
            elif reading == "rf":
                total = numbers[-3:]
    if total is None:
        raise RuntimeError(f"{path} holds no reaction forces; see {path.with_suffix('.log')}")
    return displacements, total


def run_calculix(case, element, repeat, solver):
    part = Part(HERE / "part.msh", element)
    probes, applied = write_inp(WORK / "part.inp", case, part, solver)
    seconds = []
    for _ in range(repeat):
        start = time.perf_counter()
        with open(WORK / "part.log", "w") as log:
            code = subprocess.run(["ccx", "-i", "part"], cwd=WORK, stdout=log, stderr=subprocess.STDOUT,
                                  env=os.environ | {"OMP_NUM_THREADS": "1", "CCX_NPROC_EQUATION_SOLVER": "1"}).returncode
        seconds.append(time.perf_counter() - start)
        if code != 0 or "Job finished" not in (WORK / "part.log").read_text():
            sys.exit(f"ccx failed; see {WORK / 'part.log'}")
    displacements, reaction = read_dat(WORK / "part.dat")
    unknowns = 3 * len(part.nodes)
    return {"u": [displacements[node] for node in probes], "force": [-x for x in reaction], "seconds": statistics.median(seconds),
            "size": f"{len(part.cells)} tetrahedra, {unknowns} displacements", "applied": applied}


# --- Unilateral -----------------------------------------------------------------------------------------------------------------------


def run_unilateral(program, element, repeat):
    seconds = []
    for _ in range(repeat):
        start = time.perf_counter()
        code = subprocess.run([program, "run", HERE / "part.toml", "-q", "-o", WORK / "unilateral.out", "--set", f"model.element={element}"],
                              env=os.environ | {"OMP_NUM_THREADS": "1", "DEAL_II_NUM_THREADS": "1"}).returncode
        seconds.append(time.perf_counter() - start)
        if code != 0:
            sys.exit(f"unilateral ended with code {code}; see {WORK / 'unilateral.out'}")
    results = json.loads((WORK / "unilateral.out" / "results.json").read_text())
    return {"u": [probe["value"] for probe in results["solution"]["probes"]], "force": results["constraint"][0]["contact_force"],
            "seconds": statistics.median(seconds), "size": f"{results['mesh']['n_cells']} tetrahedra, {results['space']['n_dofs']} displacements",
            "penalty_error_bound": results.get("certificate", {}).get("penalty_error_bound")}


# --- the table ------------------------------------------------------------------------------------------------------------------------


def table(case, found):
    programs = list(found)
    print(f"{'':34}" + "".join(f"{name:>16}" for name in programs) + (f"{'difference':>14}" if len(programs) == 2 else ""))

    def line(label, values, scale):
        values = [v + 0.0 for v in values]
        text = f"{label:34}" + "".join(f"{v:16.8g}" for v in values)
        print(text + (f"{abs(values[0] - values[1]) / scale:14.2e}" if len(values) == 2 else ""))

    largest = max(math.hypot(*u) for u in found[programs[0]]["u"])
    for i, point in enumerate(case["output"]["probes"]):
        for c in range(3):
            line(f"u_{'xyz'[c]} at {tuple(point)}", [found[name]["u"][i][c] for name in programs], largest)
    line("contact force, z", [abs(found[name]["force"][2]) for name in programs], abs(found[programs[0]]["force"][2]))
    print(f"{'seconds (median)':34}" + "".join(f"{found[name]['seconds']:16.2f}" for name in programs))
    print("\nDifferences of displacements are relative to the largest displacement at the points.")
    for name in programs:
        print(f"{name}: {found[name]['size']}")
    if "calculix" in found:
        print("applied force: {:.6g} {:.6g} {:.6g}".format(*found["calculix"]["applied"]))
    bound = found.get("unilateral", {}).get("penalty_error_bound")
    if bound is not None:
        print(f"certified error of the penalty (energy norm): {bound:.3g}")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--element", choices=["P1", "P2"])
    options.add_argument("--scale", type=float, default=1.0)
    options.add_argument("--only", choices=["calculix", "unilateral"])
    options.add_argument("--calculix-solver", default="SPOOLES", help="or ITERATIVE CHOLESKY, ITERATIVE SCALING")
    options.add_argument("--repeat", type=int, default=3)
    options.add_argument("--unilateral", default=str(ROOT / "build" / "unilateral"), metavar="PROGRAM")
    given = options.parse_args()

    for program in ("gmsh", "ccx"):
        if not shutil.which(program):
            sys.exit(f"{program} is missing: apt-get install calculix-ccx gmsh")
    case = tomllib.loads((HERE / "part.toml").read_text())
    element = given.element or case["model"]["element"]
    WORK.mkdir(exist_ok=True)
    subprocess.run(["gmsh", "-3", "-v", "2", "-format", "msh41", "-clscale", str(given.scale),
                    ROOT / "examples" / "data" / "bracket.geo", "-o", HERE / "part.msh"], check=True)
    found = {}
    if given.only != "unilateral":
        found["calculix"] = run_calculix(case, element, given.repeat, given.calculix_solver)
    if given.only != "calculix":
        found["unilateral"] = run_unilateral(given.unilateral, element, given.repeat)
    table(case, found)


if __name__ == "__main__":
    main()
