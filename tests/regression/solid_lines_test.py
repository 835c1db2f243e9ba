"""Values along lines in space: closed forms of pure bending and of a tube under pressure, lines.csv of a run that is resumed; pictures and tables of `scabo plot`."""
import csv
import filecmp
import sys
import unittest

import support
from solids import HEAD, interrupt
from support import scabo

# Held by six components at three corners, so that its stress is that of beams.
BENDING = """materials: {m: {young: 1e9, poisson: 0}}
bodies: {beam: {material: m, shape: {box: {corner: [0, 0, 0], size: [3, 0.5, 1]}}, mesh: {size: 0.5}}}
supports:
  - {on: {body: beam, point: [left, front, bottom]}, fix: [x, y, z]}
  - {on: {body: beam, point: [right, front, bottom]}, fix: [y, z]}
  - {on: {body: beam, point: [left, back, bottom]}, fix: z}
loads:
  one: {on: beam.right, traction: {formula: ["1e4 * (z - 0.5)", 0, 0]}}
  other: {on: beam.left, traction: {formula: ["-1e4 * (z - 0.5)", 0, 0]}}
output: {lines: [{from: [1.1, 0.2, 0], to: [1.1, 0.2, 1], points: 21, name: across}, {from: [0, 0, 1], to: [3, 0.5, 1]}]}
"""
BLOCKS = """materials: {m: {young: 1e9, poisson: 0}}
bodies:
  lower: {material: m, shape: {box: {corner: [0, 0, 0], size: [2, 1, 1]}}, mesh: {size: 0.5}}
  upper: {material: m, shape: {box: {corner: [0, 0, 1], size: [2, 1, 1]}}, mesh: {size: 0.4}}
supports: [{on: lower.bottom, fix: [x, y, z]}, {on: upper.left, fix: x}, {on: upper.front, fix: y}]
loads: {press: {on: upper.top, pressure: 1e6}}
contacts: {joint: {between: [lower.top, upper.bottom], friction: 0.3}}
"""


def table(file):
    with open(file, encoding="utf-8", newline="") as opened:
        return list(csv.DictReader(opened))


class Lines(support.InTemporaryDirectory):
    def solve(self, text):
        (self.directory / "model.yaml").write_text(HEAD + text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.directory / "results"

    def plot(self, *words, status=0):
        done = scabo("plot", self.directory / "results", *words, SCABO_PYTHON=sys.executable)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stderr

    def test_pure_bending(self):
        """Stress is linear over the height, and the deflection that of a constant curvature, M / EI."""
        for kind in ("tetrahedra", "hexahedra"):
            rows = table(self.solve(BENDING.replace("{size: 0.5}", f"{{size: 0.5, kind: {kind}}}")) / "lines.csv")
            across = [row for row in rows if row["name"] == "across"]
            self.assertEqual([float(row["distance"]) for row in across], [k / 20 for k in range(21)])
            for row in across:
                z = float(row["z"])
                self.assertAlmostEqual(float(row["stress_xx"]), 1e4 * (z - 0.5), delta=1e-9 * 5e3)
                self.assertAlmostEqual(float(row["von_mises"]), abs(1e4 * (z - 0.5)), delta=1e-9 * 5e3)
            top = [row for row in rows if row["name"] == "line_2"]
            self.assertEqual(len(top), 101)
            for row in top:  # u_z = -(M / EI) (x^2 - 3 x) / 2, the moment pulls the upper side
                x = float(row["x"])
                self.assertAlmostEqual(float(row["uz"]), -1e-5 * x * (x - 3) / 2, delta=1e-9 * 1.2e-5)

    def test_a_tube_under_pressure(self):
        """Lame: the hoop stress along a radius."""
        rows = table(self.solve("""materials: {m: {young: 1e9, poisson: 0.3}}
bodies: {tube: {material: m, shape: {tube: {from: [0, 0, 0], to: [0, 0, 0.25], inner: 1, outer: 2}}, mesh: {size: 0.25, kind: hexahedra}}}
supports: [{on: tube.bottom, fix: z}, {on: tube.top, fix: z}, {on: {body: tube, at: [1, 0, 0]}, fix: y}, {on: {body: tube, at: [-1, 0, 0]}, fix: y}, {on: {body: tube, at: [0, 1, 0]}, fix: x}]
loads: {inside: {on: tube.inside, pressure: 3e6}}
output: {lines: [{from: [1, 0, 0.1], to: [2, 0, 0.1], points: 11}]}
""") / "lines.csv")
        for row in rows:
            r = float(row["x"])
            self.assertAlmostEqual(float(row["stress_yy"]), 1e6 * (1 + 4 / r**2), delta=0.01 * 5e6)
            self.assertAlmostEqual(float(row["stress_xx"]), 1e6 * (1 - 4 / r**2), delta=0.02 * 5e6)

    def test_a_resumed_run_has_the_same_bits(self):
        model = HEAD + BLOCKS + "steps: [{name: press, increments: 40}]\noutput: {lines: [{from: [0.1, 0.2, 0], to: [0.3, 0.9, 2]}]}\n"
        for name in ("whole", "part"):
            (self.directory / f"{name}.yaml").write_text(model, encoding="utf-8")
        self.assertEqual(scabo("run", self.directory / "whole.yaml", "-o", self.directory / "whole", "--quiet").returncode, 0)
        interrupt(self, self.directory / "part.yaml", self.directory / "part")
        self.assertEqual(scabo("resume", self.directory / "part", "--quiet").returncode, 0)
        self.assertTrue(filecmp.cmp(self.directory / "whole" / "lines.csv", self.directory / "part" / "lines.csv", shallow=False))
        rows = table(self.directory / "whole" / "lines.csv")
        self.assertEqual({(row["body"]) for row in rows}, {"lower", "upper"})
        self.assertEqual(len([row for row in rows if row["increment"] == "40"]), 102)  # the point on the joint has two rows

    def test_pictures_and_tables(self):
        """A line that the run does not have agrees with one that it has."""
        results = self.solve(BENDING)
        self.plot()
        self.assertTrue((self.directory / "results.lines.png").exists())
        self.plot("--what", "lines", "--along", "1.1,0.2,0,1.1,0.2,1", "--component", "xx,uz", "-o", self.directory / "along.csv")
        rows = table(self.directory / "along.csv")
        self.assertEqual((len(rows), list(rows[0])), (201, ["name", "distance", "x", "y", "z", "xx", "uz"]))
        for row in rows:
            self.assertAlmostEqual(float(row["xx"]), 1e4 * (float(row["z"]) - 0.5), delta=1e-6 * 5e3)  # fields have single precision
        self.plot("--what", "lines", "-o", self.directory / "both.csv")
        self.assertEqual(len(table(self.directory / "both.csv")), 122)
        self.plot("--what", "lines", "--along=-1,0.2,0.5,4,0.2,0.5", "-o", self.directory / "along.pdf")
        for words, why in ((["--what", "lines", "--along", "1,2,3"], "give both ends of a line"), (["--along", "0,0,0,1,1,1"], "--what lines or --what contact"),
                           (["--what", "lines", "--along", "9,9,9,8,8,8"], "the line meets no body"), (["--what", "lines", "--component", "zx"], "along a line there are von_mises"),
                           (["--what", "stress", "--along", "0,0,0,1,1,1"], "no meaning for --what stress"), (["--what", "stress", "-o", "a.csv"], "must end in .png")):
            self.assertIn(why, self.plot(*words, status=1))
        self.assertTrue(results.exists())

    def test_along_a_contact(self):
        """A uniform pressure, on a line that leaves the face."""
        self.solve(BLOCKS)
        self.plot("--what", "contact", "--along=-0.5,0.3,5,1.5,0.6,5", "-o", self.directory / "along.csv")
        rows = table(self.directory / "along.csv")
        self.assertEqual(len(rows), 151)  # of 201 those over the face
        self.assertAlmostEqual(float(rows[0]["distance"]), 0.25 * (2**2 + 0.3**2)**0.5, delta=1e-9)
        for row in rows:
            self.assertAlmostEqual(float(row["pressure"]), 1e6, delta=1)
            self.assertEqual(row["state"], "stick")
        self.plot("--what", "contact", "--along", "0,0.5,1,2,0.5,1", "-o", self.directory / "along.png")
        self.assertTrue((self.directory / "along.png").exists())
        self.assertIn("no lines.csv", self.plot("--what", "lines", status=1))


if __name__ == "__main__":
    support.main()
