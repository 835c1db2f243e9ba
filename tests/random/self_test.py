"""The tests of random models notice what is wrong: models that differ a little, and turned ones that are turned back."""
import copy
import math
import pathlib
import sys
import tempfile
import unittest

import compare
import dress
import outcome
from change import Change, changed
from dice import Dice
from twins import finer, reordered

PROGRAM = None
BLOCKS = {
    "scabo": 1,
    "materials": {"stone": {"young": 1e10, "poisson": 0.2, "density": 2000.0}},
    "bodies": {"lower": {"material": "stone", "shape": {"rectangle": {"corner": [0.0, 0.0], "size": [2.0, 1.0]}}, "mesh": {"size": 0.25}},
               "upper": {"material": "stone", "shape": {"rectangle": {"corner": [0.5, 1.0], "size": [1.0, 1.0]}}, "mesh": {"size": 0.25}}},
    "supports": [{"on": "lower.bottom", "fix": ["x", "y"], "name": "ground"}],
    "loads": {"weight": {"gravity": [0.0, -10.0]}, "push": {"on": "upper.left", "traction": [5000.0, 0.0]}},
    "contacts": {"joint": {"between": ["lower.top", "upper.bottom"], "friction": 0.5}},
}


class Comparison(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="scabo_random_")
        self.addCleanup(holder.cleanup)
        self.path = pathlib.Path(holder.name) / "model.yaml"

    def solve(self, model, change=Change(), base=BLOCKS):
        outcome.write(model, self.path)
        return outcome.run(PROGRAM, self.path, change, base)

    def of(self, strict=True, change=Change(), **changes):
        """What differs between the blocks and themselves with some sections changed."""
        return compare.differences(self.solve(BLOCKS), self.solve({**copy.deepcopy(BLOCKS), **changes}, change), strict)

    def test_twins_agree(self):
        for change in (Change(1000.0, 1.0), Change(0.1, 2.5), Change(angle=33, centre=(1, -2)), Change(quarters=1), Change(quarters=3)):
            self.assertEqual(compare.differences(self.solve(BLOCKS), self.solve(changed(BLOCKS, change), change), True), [])
        self.assertEqual(compare.differences(self.solve(BLOCKS), self.solve(reordered(BLOCKS, Dice(1))), True), [])
        self.assertEqual(compare.differences(self.solve(BLOCKS), self.solve(finer(BLOCKS)), False), [])

    def test_a_load_that_differs_by_a_millionth(self):
        found = self.of(loads={**BLOCKS["loads"], "push": {"on": "upper.left", "traction": [5000.005, 0.0]}})
        self.assertTrue(any("tangential force" in text for text in found), found)

    def test_a_load_that_differs_by_a_tenth_on_a_finer_mesh(self):
        found = self.of(strict=False, loads={**BLOCKS["loads"], "weight": {"gravity": [0.0, -13.0]}})
        self.assertTrue(any("normal force" in text for text in found), found)

    def test_a_corner_of_tied_bodies_that_two_supports_hold(self):
        """The sum of their reactions is compared: the one that is listed first gets what the corner carries."""
        right = {**BLOCKS["bodies"]["lower"], "shape": {"rectangle": {"corner": [2.0, 0.0], "size": [1.0, 1.0]}}}
        model = {**BLOCKS, "bodies": {**BLOCKS["bodies"], "right": right}, "ties": {"joined": {"between": ["lower.right", "right.left"]}},
                 "supports": BLOCKS["supports"] + [{"on": "right.bottom", "fix": ["x", "y"], "name": "beside"}]}
        supports = model["supports"]
        for base, agree in ((model, True), ({**model, "ties": {}}, False)):
            one, other = (self.solve({**model, "supports": order}, base=base) for order in (supports, supports[::-1]))
            self.assertEqual(compare.differences(one, other, True) == [], agree)

    def test_pressure_that_is_distributed_otherwise(self):
        found = self.of(bodies={**BLOCKS["bodies"], "upper": {**BLOCKS["bodies"]["upper"], "mesh": {"size": 0.25, "order": 4}}})
        self.assertTrue(any("pairs of" in text for text in found), found)

    def test_another_status(self):
        found = self.of(contacts={"joint": {**BLOCKS["contacts"]["joint"], "friction": 0.1}})
        self.assertEqual(found, ["status solved and mechanism"])

    def test_forces_in_units_that_are_not_those_of_the_model(self):
        self.assertTrue(self.of(change=Change(1.0, 1.0 + 1e-6)))


class ChangeAndBack(unittest.TestCase):
    def test_all_that_a_model_says(self):
        """A third of a turn three times, and units back again, give every number of 300 models."""
        for seed in range(1, 301):
            model = dress.model(seed)[1]
            polygons = changed(model, Change(angle=120.0, centre=(0.3, 0.7)))
            made = polygons
            for _ in range(3):
                made = changed(made, Change(angle=120.0, centre=(0.3, 0.7)))
            self.agree(polygons, made, f"seed {seed}")
            self.agree(model, changed(changed(model, Change(1000.0, 0.5)), Change(1e-3, 2.0)), f"seed {seed}")

    def agree(self, one, other, path):
        if isinstance(one, dict):
            self.assertEqual(one.keys(), other.keys(), path)
            for key in one:
                self.agree(one[key], other[key], f"{path}.{key}")
        elif isinstance(one, (list, tuple)):
            self.assertEqual(len(one), len(other), path)
            for i, (a, b) in enumerate(zip(one, other)):
                self.agree(a, b, f"{path}.{i}")
        elif isinstance(one, float) or isinstance(other, float):
            a, b = (math.fmod(value, 360) if path.endswith("angle") else value for value in (one, other))
            self.assertAlmostEqual(a, b, delta=1e-9 * max(1, abs(a)), msg=path)
        else:
            self.assertEqual(one, other, path)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
