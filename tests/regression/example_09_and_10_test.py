"""The checked numbers of examples/09_plate_with_hole and 10_culvert."""
import csv
import json
import subprocess
import sys
import unittest

import support
from support import ROOT, scabo, summary_of

EXAMPLES = ROOT / "examples"


class Examples(support.InTemporaryDirectory):
    FOLDER = PICTURE = ""

    def check(self):
        return json.loads((EXAMPLES / self.FOLDER / "check.json").read_text(encoding="utf-8"))

    def solve(self, *settings):
        arguments = [word for setting in settings for word in ("--set", setting)]
        run = scabo("run", EXAMPLES / self.FOLDER / "model.yaml", "-o", self.directory / "results", "--quiet", *arguments)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
        return summary_of(self.directory / "results")

    def draw(self):
        run = subprocess.run([sys.executable, EXAMPLES / self.FOLDER / "figures.py", "--scabo", support.SCABO, "-o", self.directory],
                             cwd=self.directory, text=True, capture_output=True, timeout=support.PATIENCE)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue((self.directory / self.PICTURE).read_bytes().startswith(b"\x89PNG"))
        self.assertTrue((EXAMPLES / self.FOLDER / "figures" / self.PICTURE).exists(), "the README shows it")


class PlateWithHole(Examples):
    FOLDER, PICTURE = "09_plate_with_hole", "plate_with_hole.png"

    def test_the_stress_at_the_hole_is_howlands(self):
        check = self.check()
        for kind in ("polygons", "quadtree"):
            with self.subTest(kind=kind):
                self.solve(f"bodies.plate.mesh.kind={kind}")
                with open(self.directory / "results" / "points.csv", newline="", encoding="utf-8") as file:
                    factor = float(next(csv.DictReader(file))["stress_xx"]) / 100e6
                self.assertAlmostEqual(factor / check["howland"], 1.0, delta=check["relative_tolerance_of_howland"])
                self.assertAlmostEqual(factor / check["converged"], 1.0, delta=check["relative_tolerance"])

    def test_figures_are_drawn(self):
        self.draw()


class Culvert(Examples):
    FOLDER, PICTURE = "10_culvert", "culvert.png"

    def test_weight_traffic_and_pressure(self):
        check = self.check()
        for kind in ("quadtree", "polygons"):
            with self.subTest(kind=kind):
                summary = self.solve(f"bodies.ground.mesh.kind={kind}")
                for increment, base in zip(summary["increments"], check["base"], strict=True):
                    self.assertAlmostEqual(increment["reactions"]["ground.base"][1] / base, 1.0,
                                           delta=check["relative_tolerance_of_base"])
                if kind == "quadtree":
                    pressure = summary["increments"][-1]["contacts"]["wall"]["max_pressure"]
                    self.assertAlmostEqual(pressure / check["pressure"], 1.0, delta=check["relative_tolerance_of_pressure"])

    def test_figures_are_drawn(self):
        self.draw()


if __name__ == "__main__":
    support.main()
