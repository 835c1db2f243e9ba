"""Friction that differs along two directions of a face: forces on an ellipse, slip along its normal, against closed forms."""
import csv
import math
import unittest

import support
from solids import HEAD
from support import scabo, summary_of

N, ALONG, ACROSS = 1e4, 0.3, 0.6


def axes(degrees):
    """The direction, and the one across it."""
    a = math.radians(degrees)
    return (math.cos(a), math.sin(a)), (-math.sin(a), math.cos(a))


class Ellipse(support.InTemporaryDirectory):
    def run_model(self, text, status=0):
        (self.directory / "model.yaml").write_text(HEAD + text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, status, done.stderr)
        return summary_of(self.directory / "results")

    def test_a_block_that_is_driven(self):
        """Sliding along v it needs N (mu_1^2 v_1, mu_2^2 v_2) / sqrt(mu_1^2 v_1^2 + mu_2^2 v_2^2): the side with the multipliers and the units change nothing."""
        for degrees, drive, sides, unit in ((0, (1, 0), "[table.top, block.bottom]", 1.0), (0, (1, 1), "[block.bottom, table.top]", 1.0),
                                            (35, (0.4, -1), "[table.top, block.bottom]", 1.0), (-70, (1, 0.2), "[block.bottom, table.top]", 1e3)):
            with self.subTest(degrees=degrees, drive=drive, unit=unit):
                first, second = axes(degrees)
                m = unit  # lengths are in 1 / unit of a metre
                summary = self.run_model(f"""materials: {{m: {{young: {1e9 / m**2!r}, poisson: 0}}}}
bodies:
  table: {{rigid: true, shape: {{box: {{corner: [{-m}, {-m}, {-m}], size: [{4 * m}, {4 * m}, {m}]}}}}, mesh: {{size: {2 * m}}}}}
  block: {{material: m, shape: {{box: {{corner: [0, 0, 0], size: [{m}, {m}, {0.5 * m}]}}}}, mesh: {{size: {0.5 * m}}}}}
  plate: {{rigid: true, shape: {{box: {{corner: [0, 0, {0.5 * m}], size: [{m}, {m}, {0.2 * m}]}}}}, mesh: {{size: {m}}}}}
supports:
  - {{on: table, fix: [x, y, z]}}
  - {{on: plate, displacement: [{0.04 * m * drive[0]!r}, {0.04 * m * drive[1]!r}, null], rotation: [0, 0, 0], name: ram}}
loads: {{press: {{on: plate, force: [0, 0, {-N}]}}}}
contacts: {{joint: {{between: {sides}, friction: {{direction: [{first[0]!r}, {first[1]!r}, 0.5], along: {ALONG}, across: {ACROSS}}}}}}}
ties: {{glue: {{between: [block.top, plate.bottom]}}}}
steps: [{{name: press, loads: {{press: 1, ram: 0}}}}, {{name: slide, increments: 4, loads: {{ram: 1}}}}]
""")
                v = [sum(a * b for a, b in zip(drive, axis)) for axis in (first, second)]
                size = math.hypot(ALONG * v[0], ACROSS * v[1])
                parts = [N * ALONG**2 * v[0] / size, N * ACROSS**2 * v[1] / size]
                needed = [parts[0] * a + parts[1] * b for a, b in zip(first, second)]
                before, last = summary["increments"][-2:]
                for k in range(2):
                    self.assertAlmostEqual(last["reactions"]["ram"][k], needed[k], delta=1e-8 * N)
                self.assertAlmostEqual(last["energy"]["friction"] - before["energy"]["friction"], N * size * 0.01 * m, delta=1e-8 * N * m)
                with open(self.directory / "results" / "contact.csv", encoding="utf-8", newline="") as file:
                    rows = [row for row in csv.DictReader(file) if row["contact"] == "joint"]
                sense = 1.0 if sides.startswith("[table") else -1.0  # of the second side
                for row in rows:
                    if row["step"] == "2" and row["increment"] == "4":
                        slips = [float(other[f"slip_{axis}"]) for other in rows if other["pair"] == row["pair"] and other["step"] == "2" and other["increment"] == "3" for axis in "xy"]
                        for k, axis in enumerate("xy"):
                            self.assertAlmostEqual(float(row[f"slip_{axis}"]) - slips[k], sense * 0.01 * m * drive[k], delta=1e-10 * m)

    def test_the_largest_force(self):
        """Under a force at an angle: N / sqrt(cos^2 / mu_1^2 + sin^2 / mu_2^2); beyond it the block slides along the normal of the ellipse there."""
        for degrees, angle in ((0, 0), (0, 40), (25, 100)):
            first, second = axes(degrees)
            f = axes(degrees + angle)[0]
            c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
            most = N / math.hypot(c / ALONG, s / ACROSS)
            for part, status in ((0.999, 0), (1.001, 2)):
                summary = self.run_model(f"""materials: {{m: {{young: 1e9, poisson: 0}}}}
bodies:
  table: {{rigid: true, shape: {{box: {{corner: [-1, -1, -1], size: [4, 4, 1]}}}}, mesh: {{size: 2}}}}
  block: {{material: m, shape: {{box: {{corner: [0, 0, 0], size: [1, 1, 0.5]}}}}, mesh: {{size: 0.5}}}}
supports: [{{on: table, fix: [x, y, z]}}]
loads:
  press: {{on: block.top, pressure: {N}}}
  push: {{on: block.top, force: [{part * most * f[0]!r}, {part * most * f[1]!r}, 0], at: [0.5, 0.5, 0]}}
contacts: {{joint: {{between: [table.top, block.bottom], friction: {{direction: [{first[0]!r}, {first[1]!r}, 0], along: {ALONG}, across: {ACROSS}}}}}}}
""", status)
            motion = summary["mechanism"]["bodies"]["block"]["displacement"]
            normal = [c / ALONG**2 * a + s / ACROSS**2 * b for a, b in zip(first, second)]
            size = math.hypot(*normal)
            for k in range(2):
                self.assertAlmostEqual(motion[k], normal[k] / size, delta=0.05)


if __name__ == "__main__":
    support.main()
