"""The Python module: python3 -m unittest, with the folder of the module in PYTHONPATH."""
import json
import os
import pathlib
import tempfile
import time
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
        self.assertIn("did you mean 'load'", str(caught.exception))
        self.assertIn("top", str(caught.exception))
        self.assertIsInstance(caught.exception, ValueError)

    def test_holds_no_functions(self):
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
        self.assertLess((time.perf_counter() - begin - inside) / 20, 0.05)


if __name__ == "__main__":
    warnings.simplefilter("error")
    unittest.main()
