#!/usr/bin/env python3
"""Writes reports made of synthetic data, to look at the page and to test it without the C++ program.

    python3 make_sample.py FOLDER       (default: a new temporary folder, whose name is printed)

Each file follows the contract in ../README.md: the same HTML, JSON and Content-Security-Policy that the program writes.
"""
import base64
import hashlib
import html
import json
import math
import pathlib
import struct
import sys
import tempfile

page = pathlib.Path(__file__).resolve().parent.parent
nan = math.nan


def packed(code, values):
    values = list(values)
    return base64.b64encode(struct.pack(f"<{len(values)}{code}", *values)).decode()


def floats(values):
    return packed("f", values)


def integers(values):
    return packed("I", values)


def field(name, values, components=1):
    finite = [v for v in values if math.isfinite(v)]
    return {"name": name, "components": components, "values": floats(values), "min": min(finite, default=0.0), "max": max(finite, default=0.0)}


def grid(nx, ny, low, high):
    """Points, triangles and edges of the cells of a rectangle."""
    points = [
        (low[0] + (high[0] - low[0]) * i / nx, low[1] + (high[1] - low[1]) * j / ny, 0.0) for j in range(ny + 1) for i in range(nx + 1)
    ]
    at = lambda i, j: j * (nx + 1) + i
    triangles, lines = [], []
    for j in range(ny):
        for i in range(nx):
            triangles += [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)]
    for j in range(ny + 1):
        for i in range(nx):
            lines += [at(i, j), at(i + 1, j)]
    for i in range(nx + 1):
        for j in range(ny):
            lines += [at(i, j), at(i, j + 1)]
    return points, triangles, lines


def flat(points):
    return [c for p in points for c in p]


def membrane(n=100, height=0.0, decimated=None):
    """A membrane over a ball whose centre is at z = height."""
    points, triangles, lines = grid(n, n, (-2, -2), (2, 2))
    ball = lambda r: height + math.sqrt(1 - r * r) if r < 1 else -1.0
    # where the membrane leaves the ball: value and slope of A log(2/r) agree with the ball's
    low, high = 1e-6, 1 - 1e-9
    for _ in range(80):
        a = (low + high) / 2
        if height + math.sqrt(1 - a * a) - a * a / math.sqrt(1 - a * a) * math.log(2 / a) > 0:
            low = a
        else:
            high = a
    factor = a * a / math.sqrt(1 - a * a)
    u, lower, pressure = [], [], []
    for x, y, _ in points:
        r = math.hypot(x, y)
        lower.append(ball(r))
        u.append(ball(r) if r <= a else factor * math.log(2 / r))
        s = 1 - r * r
        pressure.append((2 - r * r) / s**1.5 if r <= a else 0.0)
    cells = [sum(u[triangles[t + k]] for k in range(3)) ** 2 / 9 for t in range(0, len(triangles), 3)]
    return {
        "dimension": 2,
        "vector": False,
        "axisymmetric": False,
        "points": floats(flat(points)),
        "triangles": integers(triangles),
        "lines": integers(lines),
        "fields": [field("u", u), field("contact_pressure", pressure), field("lower", lower)],
        "cell_fields": [{"name": "indicator", "values": floats(cells), "min": min(cells), "max": max(cells)}],
        "cloud": {
            "points": floats(flat(points)),
            "pressure": floats(pressure),
            "gap": floats(a - b for a, b in zip(u, lower)),
            "penetration": floats(0.0 for _ in u),
            "active": packed("B", (int(p > 0) for p in pressure)),
            "direction": None,
            "u_along": None,
        },
        "decimated": decimated,
    }


def block():
    """The surface of a block that is pressed down on slightly arched ground."""
    size, cells = (2.0, 1.0, 0.8), (40, 20, 16)
    points, index, triangles, lines = [], {}, [], set()

    def vertex(key):
        if key not in index:
            index[key] = len(points)
            points.append(tuple(size[c] * key[c] / cells[c] for c in range(3)))
        return index[key]

    for axis in range(3):
        p, q = [c for c in range(3) if c != axis]
        for end in (0, cells[axis]):
            for i in range(cells[p]):
                for j in range(cells[q]):
                    corner = []
                    for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        key = [0, 0, 0]
                        key[axis], key[p], key[q] = end, i + di, j + dj
                        corner.append(vertex(tuple(key)))
                    a, b, c, d = corner
                    triangles += [a, b, c, a, c, d]
                    for e in ((a, b), (b, c), (c, d), (d, a)):
                        lines.add((min(e), max(e)))
    ground = lambda x, y: -0.0012 * ((x - 1.0) ** 2 + 0.4 * (y - 0.5) ** 2)
    sunk = -0.0004

    def displacement(x, y, z):
        bottom = max(sunk * (1 + 0.3 * (x - 1)), ground(x, y))
        bulge = 0.0006 * math.sin(math.pi * z / 0.8)
        return (bulge * (x - 1), bulge * (y - 0.5), bottom - 0.0012 * z * (1 + 0.3 * math.cos(3 * x)))

    u, von_mises, pressure = [], [], []
    for x, y, z in points:
        u += displacement(x, y, z)
        p = 60 * max(0.0, ground(x, y) - sunk * (1 + 0.3 * (x - 1))) / 0.0004 if z == 0 else (nan if z > 0.4 else 0.0)
        pressure.append(p)
        von_mises.append(40 + 30 * math.cos(2 * x) * math.sin(3 * y) + (80 * (1 - z)) * math.exp(-4 * ((x - 1) ** 2 + (y - 0.5) ** 2)))
    bottom = [k for k, p in enumerate(points) if p[2] == 0]
    return {
        "dimension": 3,
        "vector": True,
        "axisymmetric": False,
        "points": floats(flat(points)),
        "triangles": integers(triangles),
        "lines": integers(c for e in sorted(lines) for c in e),
        "fields": [field("u", u, 3), field("von_mises", von_mises), field("contact_pressure", pressure)],
        "cell_fields": [],
        "cloud": {
            "points": floats(flat(points[k] for k in bottom)),
            "pressure": floats(pressure[k] for k in bottom),
            "gap": floats(u[3 * k + 2] - ground(*points[k][:2]) for k in bottom),
            "penetration": floats(0.0 for _ in bottom),
            "active": packed("B", (int(pressure[k] > 0) for k in bottom)),
            "direction": floats(flat((0.0, 0.0, -1.0) for _ in bottom)),
            "u_along": floats(-u[3 * k + 2] for k in bottom),
        },
        "decimated": {"from": 524288, "to": len(triangles) // 3},
    }


def beam():
    """A plane body, long and low, between a floor and nothing."""
    points, triangles, lines = grid(80, 16, (0, 0), (3, 0.5))
    floor = lambda x: -0.02 - 0.03 * (x - 1.6) ** 2
    u, stress, pressure = [], [], []
    for x, y, _ in points:
        sag = max(-0.012 * x * x, floor(x)) if x > 0 else 0.0
        slope = -0.024 * x if -0.012 * x * x > floor(x) else -0.06 * (x - 1.6)
        u += [-slope * (y - 0.25) * 0.5, sag, 0.0]
        stress.append(200 * abs(y - 0.25) * (1 + math.cos(2 * x)) + 5)
        pressure.append(12 * (1 - ((x - 1.5) / 0.6) ** 2) if y == 0 and sag == floor(x) and abs(x - 1.5) < 0.6 else 0.0)
    bottom = [k for k, p in enumerate(points) if p[1] == 0]
    return {
        "dimension": 2,
        "vector": True,
        "axisymmetric": False,
        "points": floats(flat(points)),
        "triangles": integers(triangles),
        "lines": integers(lines),
        "fields": [field("u", u, 3), field("von_mises", stress), field("contact_pressure", pressure)],
        "cell_fields": [],
        "cloud": {
            "points": floats(flat(points[k] for k in bottom)),
            "pressure": floats(pressure[k] for k in bottom),
            "gap": floats(u[3 * k + 1] - floor(points[k][0]) for k in bottom),
            "penetration": floats(0.0 for _ in bottom),
            "active": packed("B", (int(pressure[k] > 0) for k in bottom)),
            "direction": floats(flat((0.0, -1.0, 0.0) for _ in bottom)),
            "u_along": floats(-u[3 * k + 1] for k in bottom),
        },
        "decimated": None,
    }


def string():
    """A string that is pulled against a ceiling."""
    n = 200
    x = [i / n for i in range(n + 1)]
    free = [2 * s * (1 - s) for s in x]
    upper = [0.3 + 0.1 * (s - 0.5) for s in x]
    u = [min(a, b) for a, b in zip(free, upper)]
    pressure = [4.0 if a > b else 0.0 for a, b in zip(free, upper)]
    return {
        "dimension": 1,
        "vector": False,
        "axisymmetric": False,
        "points": floats(flat((s, 0.0, 0.0) for s in x)),
        "triangles": "",
        "lines": integers(c for i in range(n) for c in (i, i + 1)),
        "fields": [field("u", u), field("contact_pressure", pressure), field("upper", upper)],
        "cell_fields": [],
        "cloud": None,
        "decimated": None,
    }


def static_plot(title):
    curve = " ".join(f"{60 + 5 * i},{150 - 110 * math.sin(i / 32):.1f}" for i in range(101))
    marks = "".join(f'<circle class="marker series-1" cx="{60 + 50 * i}" cy="{170 - 12 * i}" r="4"/>' for i in range(11))
    ticks = "".join(
        f'<line class="grid" x1="{60 + 100 * i}" y1="20" x2="{60 + 100 * i}" y2="180"/>'
        f'<text class="tick" x="{60 + 100 * i}" y="198" text-anchor="middle" font-size="12">{i}</text>'
        for i in range(6)
    )
    return (
        f'<svg viewBox="0 0 600 230" role="img" aria-label="{html.escape(title)}">{ticks}'
        f'<path class="axis" d="M60,20V180H560"/><polyline class="line series-0" points="{curve}"/>'
        f'<polyline class="line series-1" points="60,170 560,50"/>{marks}<path class="slope" d="M300,90h100v-40z"/>'
        f'<text class="slope" x="410" y="75" font-size="12">1</text>'
        f'<text class="label" x="310" y="220" text-anchor="middle" font-size="13">level</text>'
        f'<g class="legend"><text x="80" y="36" font-size="12" class="series-0">residual</text></g></svg>'
    )


def escaped_json(value):
    text = json.dumps(value, allow_nan=False)
    for character in "<>&\u2028\u2029":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return text


def report(title, subtitle, kind, runs, steps=None):
    script = (page / "dist/report.js").read_text()
    style = (page / "dist/report.css").read_text()
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    policy = f"default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; script-src 'sha256-{digest}'"
    escape = html.escape
    figures = "".join(
        f'<figure class="viewer" data-run="{k}">{static_plot(run["title"])}<figcaption>{escape(run["title"])}: static picture.</figcaption></figure>'
        f'<figure class="section-plot" data-run="{k}">{static_plot("section")}<figcaption>Section of {escape(run["title"])}.</figcaption></figure>'
        for k, run in enumerate(runs)
        if kind != "sweep" or k == len(runs) - 1  # as the program does: pictures of every step would be a large page
    )
    verdict = "".join(
        f'<tr class="{state}"><th scope="row">{what}</th><td class="number">{number}</td><td class="threshold">{threshold}</td><td class="next">{advice}</td></tr>'
        for state, what, number, threshold, advice in (
            ("good", "Solver", "6.3e-10", "&lt; 1e-8", ""),
            ("good", "Penetration", "3.7e-07", "&lt; 1e-3", "deepest in 1 % of the size of a cell"),
            ("warn", "Error of the mesh", "3.4 %", "&lt; 1 %", "refine the mesh once more: <code>--set mesh.refine=6</code>"),
            ("bad", "Certificate", "0.12", "&lt; 0.01", "the bound does not hold: choose a smaller epsilon"),
        )
    )
    numbers = "".join(
        f"<tr><td>{k}</td><td>{4**k * 64}</td><td>{(2**(k+3)+1)**2}</td><td>{3+k}</td><td>{5 * 10.0**(-10-k):.1e}</td><td>{0.01 * 4**k:.2f} s</td><td>membrane over a ball</td></tr>"
        for k in range(6)
    )
    table = (
        '<div class="scroll"><table class="numbers"><thead><tr><th>level</th><th>cells</th><th>unknowns</th><th>Newton</th><th>residual</th><th>time</th>'
        f"<th>remark</th></tr></thead><tbody>{numbers}</tbody></table></div>"
    )
    data_uri = "data:text/plain;base64," + base64.b64encode(b"hello").decode()
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}"><title>{escape(title)}</title><style>{style}</style></head><body>
<header><h1>{escape(title)}</h1><p class="subtitle">{escape(subtitle)}</p></header>
<nav aria-label="Sections"><a href="#verdict">Verdict</a><a href="#picture">Picture</a><a href="#contact">Contact</a><a href="#convergence">Convergence</a><a href="#case">Case</a><a href="#log">Log</a><a href="#downloads">Downloads</a></nav>
<main><section id="verdict"><h2>Verdict</h2><table class="verdict"><tbody>{verdict}</tbody></table></section>
<section id="picture"><h2>Picture</h2>{figures}</section>
<section id="contact"><h2>Contact</h2><p>The force between the body and the obstacle is 4.27.</p>{table}</section>
<section id="convergence"><h2>Convergence</h2><figure class="plot">{static_plot("convergence")}<figcaption>Residual over the steps.</figcaption></figure></section>
<section id="case"><h2>Case</h2><details><summary>case.toml with defaults</summary><pre>mesh.box = [[0, 0], [2, 1]]
model.kind = "membrane"</pre></details></section>
<section id="log"><h2>Log</h2><details><summary>run.log</summary><pre>level 0: {escape(title)}</pre></details></section>
<section id="downloads"><h2>Downloads</h2><ul><li><a download="results.json" href="{data_uri}">results.json</a></li><li><a download="case.toml" href="{data_uri}">case.toml</a></li></ul></section>
</main><script type="application/json" id="data">{escaped_json({"format": 1, "kind": kind, "steps": steps, "runs": runs})}</script><script>{script}</script></body></html>
"""


def run(name, title, scene):
    return {"name": name, "title": title, "scene": scene}


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp(prefix="unilateral-report-"))
    folder.mkdir(parents=True, exist_ok=True)
    hostile = """</script><script>window.broken=1</script><img src=x onerror="window.broken=1">'"`&amp;"""
    spoiled = membrane(12)
    spoiled["fields"].append(field(hostile, [float(i) for i in range(169)]))
    damaged = membrane(4)
    damaged["triangles"] = integers([0, 1, 99999])
    heights = [-0.6, -0.4, -0.2, 0.0, 0.2]
    pages = {
        "membrane": ("Membrane over a ball", "membrane-over-ball.out · converged", "run", [run("membrane.out", "Membrane over a ball", membrane())], None),
        "block": ("Block on arched ground", "block.out · converged", "run", [run("block.out", "Block on arched ground", block())], None),
        "beam": ("Beam on a floor", "beam.out · converged", "run", [run("beam.out", "Beam on a floor", beam())], None),
        "string": ("String under a ceiling", "string.out · converged", "run", [run("string.out", "String under a ceiling", string())], None),
        "sweep": (
            "Ball pushed upwards",
            "sweep of 5",
            "sweep",
            [run(f"step-{k}.out", f"height = {h}", membrane(40, h)) for k, h in enumerate(heights)],
            [f"height = {h}" for h in heights],
        ),
        "comparison": (
            "Two meshes",
            "coarse.out against fine.out",
            "comparison",
            [run("coarse.out", "coarse", membrane(10)), run("fine.out", "fine", membrane(60))],
            None,
        ),
        "hostile": (
            hostile,
            hostile,
            "comparison",
            [run(hostile, hostile, spoiled), run("none", "no scene", None), run("damaged", f"damaged {hostile}", damaged)],
            None,
        ),
    }
    for name, (title, subtitle, kind, runs, steps) in pages.items():
        (folder / f"{name}.html").write_text(report(title, subtitle, kind, runs, steps), encoding="utf-8", newline="")
    print(folder)


if __name__ == "__main__":
    main()
