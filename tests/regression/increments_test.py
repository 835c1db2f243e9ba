"""Automatic increments: few where nothing depends on the path, more where states change, the same in every unit."""
import csv
import json
import subprocess
import sys
import unittest

import numpy as np
import support
from support import ROOT, SANITIZED, scabo, summary_of

sys.path.insert(0, str(ROOT / "python" / "scabo"))
from plot import vtu  # noqa: E402  (its readers need NumPy alone)

# A block pressed on a rigid floor and pushed to and fro; lengths in `length` m, forces in N.
MODEL = """
scabo: 1
analysis: {{plane: strain, thickness: {thickness}}}
materials: {{steel: {{young: {young}, poisson: 0.3}}}}
bodies:
  block:
    material: steel
    shape: {{rectangle: {{corner: [0, 0], size: [{width}, {height}]}}}}
    mesh: {{size: {size}}}
  floor: {{rigid: true, shape: {{rectangle: {{corner: [{left}, {left}], size: [{floor}, {height}]}}}}}}
supports: [{{on: floor, fix: [x, y]}}{stop}]
loads:
  down: {{on: block.top, pressure: {pressure}}}
  push: {{on: block.left, traction: [{traction}, 0]}}
contacts: {{joint: {{between: [block.bottom, floor.top], friction: {friction}}}}}
steps:
  - {{name: press, increments: {increments}, loads: {{down: 1}}}}
  - {{name: push, increments: {increments}, loads: {{push: 1}}}}
  - {{name: pull, increments: {increments}, loads: {{push: -1}}}}
  - {{name: again, increments: {increments}, loads: {{push: 1}}}}
"""


def model(increments, friction=0.5, length=1.0):
    stop = "" if friction else ", {on: block.bottom_right, fix: x}"
    return MODEL.format(increments=increments, friction=friction, stop=stop, thickness=1 / length, width=0.04 / length,
                        height=0.01 / length, left=-0.01 / length, floor=0.06 / length, size=0.001 / length,
                        young=210e9 * length**2, pressure=100e6 * length**2, traction=150e6 * length**2)


class Increments(support.InTemporaryDirectory):
    def solve(self, text, *settings):
        path = self.directory / "model.yaml"
        path.write_text(text, encoding="utf-8")
        run = scabo("run", path, "--quiet", *(word for setting in settings for word in ("--set", setting)))
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return summary_of(self.directory / "model.results")["increments"]

    def ends(self, increments, step):
        return [increment["reached"] for increment in increments if increment["step"] == step]

    def test_without_friction_increments_grow_to_the_largest(self):
        increments = self.solve(model("auto", friction=0))
        # By (7.4), sizes 0.1, 0.2, 0.25; the remaining 0.45 in halves.
        for reached, end in zip(self.ends(increments, 1), [0.1, 0.3, 0.55, 0.775, 1.0], strict=True):
            self.assertAlmostEqual(reached, end, places=12)
        for step in (2, 3, 4):  # what an increment costs does not count
            self.assertEqual(self.ends(increments, step), self.ends(increments, 1))

    def test_fields_of_the_last_equilibrium_before_a_limit_are_always_written(self):
        text = model(1).split("  - {name: push")[0] + "  - {name: push, limit: {of: push}}\noutput: {every: 100}\n"
        increments = self.solve(text)
        results = self.directory / "model.results"
        self.assertIn(f"fields_{len(increments):04d}.vtu", (results / "fields.pvd").read_text(encoding="utf-8"))
        self.assertTrue((results / "mechanism.vtu").is_file())
        limit = summary_of(results)["limit"]
        self.assertLessEqual(limit["solved"] * 150e6 * 0.01, 0.5 * 100e6 * 0.04 * (1 + 1e-9))  # T = mu N
        self.assertGreaterEqual(limit["beyond"] * 150e6 * 0.01, 0.5 * 100e6 * 0.04 * (1 - 1e-9))

    def test_fields_of_steps_in_time_have_velocities_and_true_times(self):
        """A bar that flies and a rigid block that turns, without any force; the step at rest before has the velocity 0."""
        self.solve("""scabo: 1
analysis: {plane: strain}
materials: {rubber: {young: 5e6, poisson: 0.45, density: 1100}}
bodies:
  bar: {material: rubber, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {kind: fem, size: 0.5}}
  block: {rigid: true, density: 1000, shape: {rectangle: {corner: [4, 0], size: [2, 1]}}}
  wall: {rigid: true, shape: {rectangle: {corner: [-3, 0], size: [1, 1]}}}
supports: [{on: wall, fix: [x, y]}]
initial: [{on: bar, velocity: [2, 1]}, {on: block, velocity: [0, 3], rotation: 0.5}]
steps: [{dynamic: {duration: 0.02, step: 1e-3}, increments: 4}]
""", "analysis.type=dynamic")
        results = self.directory / "model.results"
        for (time, name), end in zip(vtu.read_collection(results / "fields.pvd"), (0.005, 0.01, 0.015, 0.02), strict=True):
            self.assertAlmostEqual(float(time), end, delta=1e-12)
            mesh = vtu.read_grid(results / name, dimension=3)
            velocity, body = mesh.point_data["velocity"], mesh.point_data["body"]
            self.assertLess(abs(velocity[body == 1] - [2, 1, 0]).max(), 1e-9)
            arm = mesh.points[body == 2] - [5, 0.5, 0]
            turning = [0, 3, 0] + 0.5 * np.column_stack([-arm[:, 1], arm[:, 0], 0 * arm[:, 0]])
            self.assertLess(abs(velocity[body == 2] - turning).max(), 1e-9)
            self.assertEqual(abs(velocity[body == 3]).max(), 0.0)
        self.solve(model(1))
        self.assertNotIn("velocity", vtu.read_grid(results / "fields_0001.vtu").point_data)

    def test_stresses_of_a_history_are_those_of_the_point_and_their_extremes_have_times(self):
        kinds = ("stress_xx", "stress_yy", "stress_xy", "stress_zz", "principal_1", "principal_2", "principal_3", "von_mises")
        self.solve("""scabo: 1
analysis: {plane: strain}
materials: {rubber: {young: 1e6, poisson: 0.3, density: 1000}}
bodies: {block: {material: rubber, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 0.25}}}
supports: [{on: block.bottom, fix: [x, y]}]
curves: {quake: {sine: {amplitude: 5, periods: 2}}}
steps: [{name: shake, dynamic: {duration: 0.4, step: 2e-3, ground: {x: quake}}, increments: 20}]
output: {fields: [], points: [{at: [0.1, 0.2], name: foot}], history: {%s, corner: block.top_left.von_mises}}
""" % ", ".join(f"{kind}: foot.{kind}" for kind in kinds))
        results = self.directory / "model.results"
        points, history = (list(csv.DictReader((results / name).read_text(encoding="utf-8").splitlines())) for name in ("points.csv", "history.csv"))
        extremes = summary_of(results)["history"]
        for kind in kinds:
            values = [float(row[kind]) for row in history]
            self.assertEqual(values, [float(row[kind]) for row in points])
            self.assertGreater(max(map(abs, values)), 0.0)
            self.assertEqual(extremes[kind]["max"], max(values))
            self.assertAlmostEqual(extremes[kind]["max_time"], float(history[values.index(max(values))]["time"]))
        self.assertGreater(float(history[-1]["corner"]), 0.0)

    def test_where_states_change_there_are_more(self):
        increments = self.solve(model("auto"))
        self.assertEqual(len(self.ends(increments, 1)), 5)  # all stick
        self.assertGreaterEqual(len(self.ends(increments, 3)), 10)  # slip turns and spreads
        self.assertLess(len(increments), 100)
        for step in (1, 2, 3, 4):
            ends = self.ends(increments, step)
            self.assertEqual(ends[-1], 1.0)
            self.assertEqual(ends, sorted(set(ends)))
        for before, after in zip(increments, increments[1:]):
            reached = after["reached"] - (before["reached"] if before["step"] == after["step"] else 0)
            self.assertLessEqual(reached, 0.25 + 1e-12)

    def test_factors_are_those_that_were_reached(self):
        for increment in self.solve(model("auto")):
            if increment["step"] == 3:
                self.assertAlmostEqual(increment["factors"]["push"], 1 - 2 * increment["reached"], places=12)

    @unittest.skipIf(SANITIZED, "numbers")
    def test_totals_are_those_of_many_fixed_increments(self):
        fixed = self.solve(model(100))
        work = {increment["step"]: increment["energy"] for increment in fixed if increment["reached"] == 1}
        deviations = []
        for increments in ("auto", "{largest: 0.05}", "{first: 0.02, largest: 0.02}"):
            result = self.solve(model(increments))
            ends = {increment["step"]: increment["energy"] for increment in result if increment["reached"] == 1}
            for step in (1, 2, 3, 4):
                self.assertAlmostEqual(ends[step]["external"] / work[step]["external"], 1, delta=4e-3)
            deviations.append(abs(ends[4]["friction"] / work[4]["friction"] - 1))
        self.assertLess(max(deviations), 1e-3)  # friction's work is that of its bound, also in large increments
        self.assertLess(deviations[2], 0.5 * deviations[1])

    def test_units_do_not_matter(self):
        metres, millimetres = (self.solve(model("auto", length=length)) for length in (1.0, 1e-3))
        self.assertEqual([(i["step"], i["increment"]) for i in metres], [(i["step"], i["increment"]) for i in millimetres])
        for one, other in zip(metres, millimetres):
            self.assertAlmostEqual(one["reached"], other["reached"], places=12)

    def test_limits_are_kept(self):
        increments = self.solve(model("{first: 0.03, largest: 0.04, smallest: 0.02}"))
        for step in (1, 2, 3, 4):
            ends = [0.0, *self.ends(increments, step)]
            sizes = [after - before for before, after in zip(ends, ends[1:])]
            self.assertAlmostEqual(sizes[0], 0.03, places=12)
            self.assertLessEqual(max(sizes), 0.04 + 1e-12)
            self.assertGreaterEqual(min(sizes[:-1]), 0.02 - 1e-12)

    def test_an_attempt_that_fails_is_halved_down_to_the_smallest(self):
        path = self.directory / "model.yaml"
        path.write_text(model("{first: 0.25, smallest: 0.05}").replace("traction: [150000000.0", "traction: [900e6"),
                        encoding="utf-8")
        run = scabo("run", path, "--quiet")
        self.assertEqual(run.returncode, 2)  # the block is pushed away
        last = summary_of(self.directory / "model.results")["increments"][-1]
        self.assertFalse(last["converged"])

    def test_all_meshes_of_an_error_estimate_have_the_same(self):
        plain = self.solve(model("auto"))
        estimated = self.solve(model("auto") + "output: {error: true}\n")
        self.assertEqual([i["reached"] for i in plain], [i["reached"] for i in estimated])
        self.assertTrue(all(increment["error"] for increment in estimated))

    def test_log_and_check_name_them(self):
        self.solve(model("{largest: 0.2}"))
        log = (self.directory / "model.results" / "log.txt").read_text(encoding="utf-8")
        self.assertIn("step press, increment 2, 30 % of the step: down = 0.3", log)
        check = scabo("check", self.directory / "model.yaml")
        self.assertIn("auto, 0.0001 to 0.2 of the step", check.stdout)


def pushed_block(increments, friction=0.3, length=1.0, strength=""):
    """A block under 10 MPa that is pushed by 10 MPa on half as long a side: it slides at twice its friction."""
    return f"""
scabo: 1
analysis: {{thickness: {1 / length}}}
materials: {{steel: {{young: {210e9 * length**2}, poisson: 0.3}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [{-1 / length}, {-1 / length}], size: [{4 / length}, {1 / length}]}}}}}}
  block:
    material: steel
    shape: {{rectangle: {{corner: [0, 0], size: [{2 / length}, {1 / length}]}}}}
    mesh: {{size: {0.1 / length}}}
supports: [{{on: floor, fix: [x, y]}}]
loads:
  down: {{on: block.top, pressure: {10e6 * length**2}}}
  push: {{on: block.left, traction: [{10e6 * length**2}, 0]}}
contacts: {{base: {{between: [floor.top, block.bottom], friction: {friction}{strength}}}}}
steps:
  - {{name: down, loads: {{down: 1}}}}
  - {{name: push, increments: {increments}}}
"""


class AtALimit(support.InTemporaryDirectory):
    """Automatic increments close in on the load that can be carried."""

    def run_model(self, text):
        path = self.directory / "model.yaml"
        path.write_text(text, encoding="utf-8")
        run = scabo("run", path, "--quiet")
        return run.returncode, summary_of(self.directory / "model.results")

    def last_factor(self, text):
        status, summary = self.run_model(text)
        self.assertEqual((status, summary["status"]), (2, "mechanism"))
        self.assertEqual(next(iter(summary["mechanism"]["bodies"])), "block")
        return [i["factors"]["push"] for i in summary["increments"] if i["converged"]][-1]

    def test_of_a_block_that_slides(self):
        for friction in (0.3, 0.15, 0.0):
            with self.subTest(friction=friction):
                limit = 2 * friction
                factor = self.last_factor(pushed_block("{largest: 0.25, smallest: 1e-6}", friction))
                self.assertLessEqual(factor, limit * (1 + 1e-9))
                self.assertLess(limit - factor, 1.001e-6)

    def test_as_near_as_the_smallest_increment(self):
        for smallest in (1e-2, 1e-4):
            factor = self.last_factor(pushed_block(f"{{smallest: {smallest}}}"))
            self.assertLess(0.6 - factor, 1.001 * smallest)

    def test_in_other_units(self):
        metres, millimetres = (self.last_factor(pushed_block("auto", length=length)) for length in (1.0, 1e-3))
        self.assertAlmostEqual(metres, millimetres, places=9)

    def test_loads_of_which_any_part_is_too_much_are_told_at_once(self):
        text = pushed_block("auto", 0.4).replace("  - {name: down, loads: {down: 1}}\n", "")
        status, summary = self.run_model(text)
        self.assertEqual((status, summary["status"]), (2, "mechanism"))
        self.assertFalse(any(increment["converged"] for increment in summary["increments"]))


class Plan(support.InTemporaryDirectory):
    def test_one_line_for_a_small_model(self):
        check = scabo("check", support.BEAM)
        self.assertRegex(check.stdout, r"32 contact pairs; about \d+ MB of memory, less than a second\n\n")

    @unittest.skipIf(SANITIZED, "sanitizers reserve more address space than any limit")
    def test_a_model_that_does_not_fit_is_refused_before_the_work(self):
        settings = [word for body in ("lower", "upper") for word in
                    ("--set", f"bodies.{body}.mesh={{size: 0.012, kind: quadtree}}")]
        command = 'ulimit -v 1200000; exec "$0" run "$@"'
        run = subprocess.run(["bash", "-c", command, support.SCABO, support.BEAM, "-q", "-o", self.directory / "out", *settings],
                             capture_output=True, text=True, timeout=support.PATIENCE)
        self.assertEqual(run.returncode, 3)
        self.assertRegex(run.stderr, r"^scabo: not enough memory.*coarser.*\n$")
        summary = json.loads((self.directory / "out" / "summary.json").read_text())
        self.assertEqual(summary["status"], "failed")


if __name__ == "__main__":
    support.main()
