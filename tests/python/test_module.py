"""The Python module: python3 -m unittest, with the folder of the module in PYTHONPATH."""
import doctest
import inspect
import json
import os
import pathlib
import tempfile
import threading
import time
import traceback
import types
import unittest
import warnings

import numpy as np

import unilateral

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"

STRING = {
    "title": "A string under a ceiling",
    "mesh": {"box": [[0], [1]], "cells": 64},
    "model": {"kind": "membrane", "load": 1},
    "boundary": {"all": 0},
    "constraint": {"upper": 1 / 18},
}


class TestCase(unittest.TestCase):
    def test_is_a_file(self):
        case = unilateral.Case.load(EXAMPLES / "membrane-over-ball.toml", {"mesh.refine": 2})
        self.assertEqual(case.dimension, 2)
        self.assertIn("refine = 2", case.toml)

    def test_that_no_text_can_hold(self):
        itself = {}
        itself["mesh"] = itself
        deep = []
        for _ in range(100000):
            deep = [deep]
        for content, message in ((itself, "may hold itself"), ({"mesh": {"box": deep}}, "at more than 200 levels"),
                                 ({"model": {"load": 10**30}}, "too large for a case; give it as a float")):
            with self.assertRaisesRegex(ValueError, message):
                unilateral.Case(content)

    def test_functions_return_real_numbers(self):
        for function, name in ((lambda x: None, "NoneType"), (lambda x: x[:, 0] * 1j, "ndarray")):
            case = unilateral.Case({**STRING, "model": {"kind": "membrane", "load": function}})
            with self.assertRaisesRegex(TypeError, "array of real numbers, one for each point, not " + name):
                case.solve()

    def test_is_a_dict(self):
        case = unilateral.Case(STRING)
        self.assertEqual(case.title, "A string under a ceiling")
        self.assertEqual(case.part_names, ["left", "right"])

    def test_with_other_settings(self):
        case = unilateral.Case(STRING).with_settings({"model.load": 2.5, "output.probes": np.array([0.25, 0.5])})
        self.assertIn("load = 2.5", case.toml)
        self.assertIn("probes = [[0.25], [0.5]]", case.toml)

    def test_that_is_wrong_says_all_mistakes(self):
        with self.assertRaises(unilateral.InputError) as caught:
            unilateral.Case({**STRING, "model": {"kind": "membrane", "lod": 1}, "boundary": {"top": 0}})
        self.assertIn("case['model']['lod']: error: unknown key 'lod' in [model]; did you mean 'load'", str(caught.exception))
        self.assertIn("top", str(caught.exception))
        messages = caught.exception.messages
        self.assertEqual(len(messages), 2)
        self.assertEqual(messages[0]["name"], "unknown-key")
        self.assertEqual(messages[0]["file"], "case['model']['lod']")
        self.assertIsInstance(caught.exception, ValueError)

    def test_with_settings_says_mistakes_by_their_keys(self):
        case = unilateral.Case({**STRING, "constraint": [{"upper": 1 / 18}, {"lower": -1}]})
        with self.assertRaises(unilateral.InputError) as caught:
            case.with_settings({"parameters.a": 1}).with_settings({"boundary.top": 0})
        self.assertIn("boundary.top", str(caught.exception))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            unilateral.Case(membrane({"box": [[0, 0], [1, 1]], "cells": 4}, -0.01)).with_settings({"model.load": -8}).solve()
        self.assertTrue(caught)
        self.assertIn("case['constraint']", str(caught[0].message))

    def test_holds_no_other_objects(self):
        with self.assertRaises(TypeError):
            unilateral.Case({**STRING, "title": object()})


class TestResult(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = unilateral.Case(STRING).solve()

    def test_numbers_are_those_of_results_json(self):
        results = self.result.results
        self.assertTrue(self.result.converged)
        self.assertEqual(results["status"], "converged")
        self.assertAlmostEqual(results["constraint"][0]["total_contact_force"], 1 / 3, delta=0.02)

    def test_arrays(self):
        r = self.result
        self.assertEqual(r.points.shape, (65, 3))
        self.assertEqual(r.cells.shape, (64, 2))
        self.assertEqual(r.solution.shape, (65,))
        self.assertEqual(r.pressure.shape, (65,))
        self.assertAlmostEqual(r.solution.max(), 1 / 18, delta=1e-4)
        self.assertEqual(r.contact["pressure"].max(), r.results["constraint"][0]["max_contact_pressure"])
        self.assertEqual(len(r.contact_points), r.results["constraint"][0]["n_points"])
        weighted = (r.contact["pressure"] * r.contact["weight"]).sum()
        self.assertAlmostEqual(weighted, r.results["constraint"][0]["total_contact_force"], places=12)

    def test_arrays_are_views(self):
        self.assertFalse(self.result.solution.flags.owndata)
        with self.assertRaises(ValueError):
            self.result.solution[0] = 1
        solution = unilateral.Case(STRING).solve().solution  # outlives its result
        self.assertTrue(np.isfinite(solution).all())

    def test_of_a_body(self):
        r = unilateral.Case.load(EXAMPLES / "block-patch.toml").solve()
        self.assertEqual(r.solution.shape, (len(r.points), 3))
        self.assertIn("von_mises", r.fields)
        self.assertIn("direction", r.contact)

    def test_total_force_is_met_on_every_mesh(self):
        for element in ("Q1", "P1", "P2"):
            for refine in (0, 1):
                r = unilateral.Case({
                    "mesh": {"shell": {"center": [0, 0], "inner": 1, "outer": 2}, "refine": refine},
                    "model": {"kind": "elasticity", "element": element, "young": 10, "poisson": 0.3},
                    "boundary": {"inner": "clamped", "outer": {"force": [0.5, -2]}},
                    "constraint": {"on": "outer", "gap": 100},
                }).solve()
                np.testing.assert_allclose(r.results["balance"]["load"], [0.5, -2], rtol=1e-12)

    def test_shows_itself(self):
        self.assertIn("A string under a ceiling", self.result.to_html())
        self.assertTrue(self.result.to_svg().startswith("<svg"))
        self.assertTrue(self.result._repr_html_().startswith("<iframe"))

    def test_can_be_saved(self):
        with tempfile.TemporaryDirectory() as folder:
            self.result.save(os.path.join(folder, "a.out"))
            with open(os.path.join(folder, "a.out", "results.json"), encoding="utf-8") as file:
                self.assertEqual(json.load(file)["solution"], self.result.results["solution"])

    def test_progress(self):
        levels = []
        unilateral.Case({**STRING, "mesh": {"box": [[0], [1]], "cells": 4, "refine": 3}}).solve(progress=levels.append)
        self.assertEqual([level["level"] for level in levels], [0, 1, 2, 3])

    def test_interrupt(self):
        import signal
        import threading

        case = unilateral.Case.load(EXAMPLES / "membrane-over-ball.toml", {"mesh.refine": 9})
        threading.Timer(0.5, lambda: signal.raise_signal(signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            case.solve()

    def test_many_solutions_cost_little(self):
        case = unilateral.Case(STRING)
        case.solve()
        begin = time.perf_counter()
        inside = sum(case.solve().results["timing"]["total"] for _ in range(20))
        self.assertLess((time.perf_counter() - begin - inside) / 20, 0.05)  # 0.2 ms on a machine that does nothing else


def square(n, triangles=False, z=False):
    """n x n cells of the unit square: points, cells in VTK's order, facets of the bottom side."""
    x = np.linspace(0, 1, n + 1)
    points = np.array([[a, b] for b in x for a in x])
    if z:
        points = np.column_stack([points, np.zeros(len(points))])
    corner = np.array([j * (n + 1) + i for j in range(n) for i in range(n)])
    quadrilaterals = np.column_stack([corner, corner + 1, corner + n + 2, corner + n + 1])
    cells = np.vstack([quadrilaterals[:, [0, 1, 2]], quadrilaterals[:, [0, 2, 3]]]) if triangles else quadrilaterals
    bottom = np.column_stack([np.arange(n), np.arange(1, n + 1)])
    return points, cells, bottom


def membrane(mesh, lower, **model):
    return {"mesh": mesh, "model": {"kind": "membrane", "load": -4, **model}, "boundary": {"all": 0}, "constraint": {"lower": lower}}


BOX = {"box": [[0, 0], [1, 1]], "cells": 8}


class TestFunctions(unittest.TestCase):
    def assert_same(self, one, other):
        self.assertAlmostEqual(one.results["solution"]["energy"], other.results["solution"]["energy"], delta=1e-9)
        self.assertAlmostEqual(one.results["constraint"][0]["total_contact_force"],
                               other.results["constraint"][0]["total_contact_force"], delta=1e-8)

    def test_callable_gives_what_its_expression_gives(self):
        given = unilateral.Case(membrane({**BOX, "refine": 1}, lambda x: -0.1 - 0.1 * x[:, 0],
                                         stiffness=lambda x: 1 + x[:, 1], load=lambda x: -4 - x[:, 0] * x[:, 1])).solve()
        text = unilateral.Case(membrane({**BOX, "refine": 1}, "-0.1 - 0.1*x", stiffness="1 + y", load="-4 - x*y")).solve()
        self.assertTrue(given.converged)
        self.assert_same(given, text)

    def test_callable_in_one_and_three_dimensions_and_of_bodies(self):
        given = unilateral.Case({**STRING, "constraint": {"upper": lambda x: 0.05 + 0.01 * x[:, 0]}}).solve()
        self.assert_same(given, unilateral.Case({**STRING, "constraint": {"upper": "0.05 + 0.01*x"}}).solve())
        body = {"mesh": {"box": [[0, 0, 0], [1, 1, 1]], "cells": 2}, "model": {"kind": "elasticity", "young": 10, "poisson": 0.3},
                "boundary": {"top": {"traction": [0, -1, 0]}, "left": {"x": 0}, "back": {"z": 0}}}
        body["constraint"] = {"on": "bottom", "gap": "0.01*x"}
        text = unilateral.Case(body).solve()
        body["constraint"] = {"on": "bottom", "gap": lambda x: 0.01 * x[:, 0]}
        body["boundary"]["top"] = {"traction": [0, lambda x: -np.ones(len(x)), 0]}
        self.assert_same(unilateral.Case(body).solve(), text)

    def test_callables_are_called_in_bulk(self):
        sizes = []

        def called(points):
            sizes.append(len(points))
            return 1 + points[:, 0]

        model = {"load": lambda x: -4 * called(x), "stiffness": called}
        r = unilateral.Case(membrane({**BOX, "refine": 3}, lambda x: -0.1 * called(x), **model)).solve()
        n_cells = r.results["mesh"]["n_cells"]
        self.assertEqual(n_cells, 4096)
        self.assertGreater(max(sizes), 5 * n_cells)
        # The bound of the total error looks at one cell after the other.
        self.assertLess(len(sizes), 10 * n_cells)

    def test_one_number_for_all_points_is_enough(self):
        self.assert_same(unilateral.Case(membrane(BOX, lambda x: -0.1)).solve(), unilateral.Case(membrane(BOX, -0.1)).solve())

    def test_exception_of_a_callable_is_raised_with_its_traceback(self):
        def obstacle(points):
            raise ZeroDivisionError("no such obstacle")

        try:
            unilateral.Case(membrane(BOX, obstacle)).solve()
            self.fail("nothing was raised")
        except ZeroDivisionError as e:
            self.assertIn("obstacle", [frame.name for frame in traceback.extract_tb(e.__traceback__)])

    def test_callable_that_returns_no_numbers(self):
        with self.assertRaises(TypeError) as caught:
            unilateral.Case(membrane(BOX, lambda x: "low")).solve()
        self.assertIn("must return an array of real numbers", str(caught.exception))
        with self.assertRaises(ValueError) as caught:
            unilateral.Case(membrane(BOX, lambda x: x)).solve()
        self.assertIn("must return an array of", str(caught.exception))
        with self.assertRaises(unilateral.InputError) as caught:
            unilateral.Case(membrane(BOX, lambda x: np.full(len(x), np.nan))).solve()
        self.assertIn("the Python function", str(caught.exception))
        self.assertIn("case['constraint']['lower']: error:", str(caught.exception))

    def test_settings_may_hold_functions(self):
        case = unilateral.Case(membrane(BOX, -0.1)).with_settings({"constraint.lower": lambda x: -0.05 + 0 * x[:, 0]})
        case = case.with_settings({"model.load": lambda x: -8 + 0 * x[:, 0]})  # the first one is kept
        self.assert_same(case.solve(), unilateral.Case(membrane(BOX, -0.05, load=-8)).solve())
        self.assertIn("given = 0", case.toml)

    def test_text_of_a_case_with_functions_cannot_be_read_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.toml"
            path.write_text(unilateral.Case(membrane(BOX, lambda x: -0.1)).toml, encoding="utf-8")
            with self.assertRaises(unilateral.InputError) as caught:
                unilateral.Case.load(path)
        self.assertIn("given-by-program", str(caught.exception))

    def test_samples_of_a_grid(self):
        x = (np.arange(64) + 0.5) / 64
        samples = -0.1 - 0.1 * np.tile(x, (64, 1))
        given = unilateral.Case(membrane(BOX, {"array": samples, "extent": [[0, 0], [1, 1]]})).solve()
        text = unilateral.Case(membrane(BOX, "-0.1 - 0.1*min(max(x, 1/128), 127/128)")).solve()
        self.assert_same(given, text)
        # The first row is the top one.
        up = unilateral.Case(membrane(BOX, {"array": samples.T[::-1], "extent": [[0, 0], [1, 1]]})).solve()
        np.testing.assert_allclose(up.fields["lower"], -0.1 - 0.1 * np.clip(up.points[:, 1], 1 / 128, 127 / 128), atol=1e-12)
        line = unilateral.Case({**STRING, "constraint": {"upper": {"array": np.full(10, 0.05), "extent": [[0], [1]]}}}).solve()
        self.assertAlmostEqual(line.solution.max(), 0.05, delta=1e-5)

    def test_samples_that_do_not_fit(self):
        for bad in ({"array": np.zeros((2, 2))}, {"array": np.zeros((2, 2)), "extent": [[0, 0], [0, 1]]},
                    {"array": np.zeros((2, 2)), "extend": [[0, 0], [1, 1]]}, {"values": np.zeros(4)}):
            with self.assertRaises(ValueError):
                unilateral.Case(membrane(BOX, bad))
        with self.assertRaises(unilateral.InputError):  # a function of x alone
            unilateral.Case(membrane(BOX, {"array": np.zeros(4), "extent": [[0], [1]]}))


class TestMeshes(unittest.TestCase):
    def test_by_arrays_is_that_of_the_box(self):
        box = unilateral.Case(membrane(BOX, -0.1)).solve()
        for z in (False, True):
            points, cells, _ = square(8, z=z)
            given = unilateral.Case(membrane({"points": points, "cells": cells}, -0.1)).solve()
            self.assertAlmostEqual(given.results["solution"]["energy"], box.results["solution"]["energy"], delta=1e-12)

    def test_of_every_kind_of_cell(self):
        points, cells, _ = square(4, triangles=True)
        r = unilateral.Case(membrane({"points": points, "cells": cells, "refine": 1}, -0.1, element="P1")).solve()
        self.assertEqual(r.results["mesh"]["n_cells"], 128)
        r = unilateral.Case({**STRING, "mesh": {"points": np.linspace(0, 1, 65)[:, None], "cells": [[i, i + 1] for i in range(64)],
                                                "parts": {"left": [0], "right": [[64]]}}}).solve()
        self.assertAlmostEqual(r.results["constraint"][0]["total_contact_force"], 1 / 3, delta=0.02)
        corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
        hexahedron = [[0, 1, 3, 2, 4, 5, 7, 6]]
        tetrahedra = [[0, 1, 3, 7], [0, 1, 5, 7], [0, 2, 3, 7], [0, 2, 6, 7], [0, 4, 5, 7], [0, 4, 6, 7]]
        for cells, element in ((hexahedron, "Q1"), (tetrahedra, "P1")):
            r = unilateral.Case(membrane({"points": corners, "cells": cells, "refine": 2}, -0.1, element=element)).solve()
            self.assertEqual(r.results["mesh"]["n_cells"], len(cells) * 64)

    def test_names_parts_and_regions(self):
        points, cells, bottom = square(8)
        mesh = {"points": points, "cells": cells, "parts": {"bottom": bottom, "top": lambda x: x[:, 1] == 1, "left": "x == 0"},
                "regions": {"stiff": lambda x: x[:, 0] > 0.5, "first": [0, 1]}}
        case = unilateral.Case({"mesh": mesh, "model": {"kind": "membrane", "load": -1},
                                "material": [{"region": "stiff", "stiffness": 10}],
                                "boundary": {"bottom": 0, "top": 1, "left": "free", "boundary": "free"},
                                "constraint": {"lower": -10}})
        self.assertEqual(case.part_names, ["bottom", "boundary", "top", "left"])
        self.assertEqual(sorted(case.region_names), ["domain", "first", "stiff"])
        r = case.solve()
        self.assertAlmostEqual(r.solution[r.points[:, 1] == 1].min(), 1)
        self.assertEqual(len(np.unique(r.cell_fields["region"])), 3)
        measures = {part["part"]: part["measure"] for part in case.check()["mesh"]["boundary"]}
        self.assertAlmostEqual(measures["bottom"], 1)
        self.assertAlmostEqual(measures["boundary"], 1)

    def test_carries_nodal_values(self):
        points, cells, _ = square(8)
        points = np.vstack([points, [[5, 5]]])  # of no cell
        case = unilateral.Case(membrane({"points": points, "cells": cells, "refine": 1}, {"values": -0.1 - 0.1 * points[:, 0]}))
        text = unilateral.Case(membrane({**BOX, "refine": 1}, "-0.1 - 0.1*x")).solve()
        given = case.solve()
        self.assertAlmostEqual(given.results["solution"]["energy"], text.results["solution"]["energy"], delta=1e-9)
        other = case.with_settings({"constraint.lower": {"values": np.full(len(points), -0.05)}}).solve()
        self.assertAlmostEqual(other.fields["lower"].max(), -0.05)
        # Values on a mesh of their own.
        r = unilateral.Case(membrane(BOX, {"points": [[0, 0], [1, 0], [1, 1], [0, 1]], "cells": [[0, 1, 2], [0, 2, 3]],
                                           "values": [-0.1, -0.2, -0.2, -0.1]})).solve()
        np.testing.assert_allclose(r.fields["lower"], -0.1 - 0.1 * r.points[:, 0], atol=1e-12)

    def test_that_is_wrong(self):
        points, cells, _ = square(2)
        for bad, text in (({"points": points}, "cells"), ({"points": points, "cells": cells + 100}, "counted from 0"),
                          ({"points": points, "cells": cells[:, :2]}, "corners"),
                          ({"points": points, "cells": cells, "parts": {"a": [[0, 1, 2]]}}, "part 'a'"),
                          ({"points": points, "cells": cells, "regions": {"a": [99]}}, "region 'a'"),
                          ({"points": points, "cells": cells, "cell": 1}, "unknown key 'cell'")):
            with self.assertRaises(ValueError) as caught:
                unilateral.Case(membrane(bad, -0.1))
            self.assertIn(text, str(caught.exception))

    def meshio_like(self):
        points, cells, bottom = square(8, triangles=True, z=True)
        return types.SimpleNamespace(
            points=points,
            cells=[types.SimpleNamespace(type="line", data=bottom), types.SimpleNamespace(type="triangle", data=cells)],
            cell_data={"gmsh:physical": [np.full(len(bottom), 1), np.where(np.arange(len(cells)) < 8, 7, 2)]},
            field_data={"foot": np.array([1, 1]), "inside": np.array([2, 2])}, cell_sets={})

    def check_meshio(self, mesh):
        case = unilateral.Case({"mesh": {"meshio": mesh, "refine": 1}, "model": {"kind": "membrane", "load": -4, "element": "P1"},
                                "boundary": {"foot": 0, "boundary": "free"}, "constraint": {"lower": -0.1}})
        self.assertEqual(case.part_names, ["foot", "boundary"])
        self.assertEqual(sorted(case.region_names), ["7", "inside"])
        self.assertEqual(case.solve().results["mesh"]["n_cells"], 512)
        self.assertEqual(unilateral.Case({"mesh": mesh, "model": {"kind": "membrane", "element": "P1", "load": 1},
                                          "boundary": {"all": 0}, "constraint": {"upper": 1}}).dimension, 2)

    def test_of_an_object_like_those_of_meshio(self):
        self.check_meshio(self.meshio_like())

    def test_of_meshio(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("meshio is not there")
        like = self.meshio_like()
        self.check_meshio(meshio.Mesh(like.points, [(block.type, block.data) for block in like.cells], cell_data=like.cell_data,
                                      field_data=like.field_data))


class TestStudies(unittest.TestCase):
    def test_are_those_of_the_program(self):
        case = unilateral.Case(STRING)
        self.assertEqual(case.check()["mesh"]["parts"], ["left", "right"])
        self.assertEqual(case.infsup(levels=2)["rows"][0]["nullity"], 0)
        study = case.study_epsilon([1e-3, 1e-4, 1e-5])
        self.assertEqual([row["epsilon"] for row in study["rows"]], [1e-3, 1e-4, 1e-5])
        self.assertTrue(study["holds"]["theorem2"])
        self.assertEqual(len(case.study_mesh(levels=3)["rows"]), 3)
        self.assertEqual([row["rule"] for row in case.study_quadrature(["nodal", "gauss(2)"])["rows"]], ["nodal", "gauss(2)"])
        with self.assertRaises(ValueError):
            case.study_epsilon([0])

    def test_certificate_and_estimate(self):
        r = unilateral.Case(STRING).solve()
        self.assertEqual(r.certificate, r.results["certificate"])
        self.assertTrue(r.estimate["guaranteed"])


class TestThreads(unittest.TestCase):
    LARGE = {"mesh.refine": 9}

    def run_in_thread(self, action):
        outcome = []

        def run():
            try:
                outcome.append(action())
            except BaseException as e:
                outcome.append(e)

        thread = threading.Thread(target=run)
        thread.start()
        return thread, outcome

    def test_stop(self):
        case = unilateral.Case.load(EXAMPLES / "membrane-over-ball.toml", self.LARGE)
        stop = threading.Event()
        thread, outcome = self.run_in_thread(lambda: case.solve(stop=stop.is_set))
        time.sleep(0.3)  # the GIL is free
        stop.set()
        thread.join(60)
        self.assertIsInstance(outcome[0], KeyboardInterrupt)

    def test_exception_set_for_the_thread(self):
        import ctypes

        case = unilateral.Case.load(EXAMPLES / "membrane-over-ball.toml", self.LARGE)
        thread, outcome = self.run_in_thread(case.solve)
        time.sleep(0.3)
        ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident), ctypes.py_object(KeyboardInterrupt))
        thread.join(60)
        self.assertIsInstance(outcome[0], KeyboardInterrupt)

    def test_exception_of_progress(self):
        def progress(level):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            unilateral.Case(STRING).solve(progress=progress)


class TestDocumentation(unittest.TestCase):
    def test_examples_in_docstrings(self):
        parser, runner, count = doctest.DocTestParser(), doctest.DocTestRunner(), 0
        objects = {"unilateral": unilateral}
        for kind in (unilateral.Case, unilateral.Result):
            objects[kind.__name__] = kind
            objects.update((f"{kind.__name__}.{name}", member) for name, member in vars(kind).items())
        for name, member in objects.items():
            test = parser.get_doctest(inspect.getdoc(member) or "", {}, name, None, 0)
            count += len(test.examples)
            runner.run(test)
        self.assertGreater(count, 10)
        self.assertEqual(runner.failures, 0)

    def test_stubs_name_everything_there_is(self):
        stubs = (pathlib.Path(__file__).resolve().parents[2] / "python" / "unilateral.pyi").read_text(encoding="utf-8")
        for kind in (unilateral.Case, unilateral.Result):
            for name in vars(kind):
                if not name.startswith("_") or name == "_repr_html_":
                    self.assertIn(f"def {name}(", stubs)


class TestGallery(unittest.TestCase):
    def test_pictures_and_force(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("matplotlib is not there")
        import runpy

        gallery = runpy.run_path(str(EXAMPLES / "python" / "gallery.py"))
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.assertLess(gallery["main"](folder), 1e-3)
            for name in ("membrane.png", "mesh.png", "load.png"):
                self.assertGreater((pathlib.Path(folder) / name).stat().st_size, 5000)


if __name__ == "__main__":
    warnings.simplefilter("error")
    unittest.main()
