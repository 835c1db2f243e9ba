"""A dam with joints on massless rock under a synthetic motion of the ground, the section of examples/28_koyna with large elements, in twins: other
units, turned, mirrored, bodies in another order, results at other times, and in two halves. Crest, slips, opening and heat agree to 1e-8."""
import csv
import math

import support
from support import scabo

DURATION, STEP = 0.8, 4e-3
COLUMNS = ("crest.u1", "lift.u1", "lift.u2", "base.u1", "base.u2", "shear", "heat")


class DamTwins(support.InTemporaryDirectory):
    def history(self, name, metre=1.0, side=1, degrees=0, reverse=False, duration=DURATION, since=0.0, increments=20, restart=None):
        """Rows of history.csv in metres and newtons. Lengths of the model are in 1/`metre` m, masses in kg; side -1: mirrored; all turned by
        `degrees`; the ground moves as from time `since` on."""
        cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))

        def turned(x, y, factor=metre):
            return [factor * (side * x * cos - y * sin), factor * (side * x * sin + y * cos)]

        def points(*vertices):
            return [turned(*vertex) for vertex in (vertices if side > 0 else vertices[::-1])]

        def mesh(size):
            return f"mesh: {{size: {size * metre!r}}}"

        force = metre  # kg m/s2 in those of the model
        names = "names: {base: edge_1, lift: edge_3, face: edge_4}" if side > 0 else "names: {base: edge_3, lift: edge_1, face: edge_4}"
        above = "names: {lift: edge_1, face: edge_4}" if side > 0 else "names: {lift: edge_3, face: edge_4}"
        bodies = [
            f"rock: {{material: rock, shape: {{polygon: {{vertices: {points((-70, -70), (140, -70), (140, 0), (-70, 0))}}}}}, {mesh(16)}}}",
            f"lower: {{material: concrete, shape: {{polygon: {{vertices: {points((0, 0), (70, 0), (19.25, 66.5), (0, 66.5))}, {names}}}}}, {mesh(8)}}}",
            f"upper: {{material: concrete, shape: {{polygon: {{vertices: {points((0, 66.5), (19.25, 66.5), (14.8, 103), (0, 103))}, {above}}}}}, {mesh(8)}}}"]
        bottom = "edge_1" if side > 0 else "edge_3"
        heel, crest = ("vertex_1", "vertex_4") if side > 0 else ("vertex_4", "vertex_1")  # both at x = 0, below and above
        top = "edge_3" if side > 0 else "edge_1"
        times = [0.02 * i for i in range(51)]
        quake = [[[t - since, a] for t, a in zip(times, along)]
                 for along in zip(*(turned(4.0 * math.sin(6 * math.pi * t) * min(1.0, 4 * t), 0.0) for t in times))]
        up = turned(0, 1, 1)
        water = f"water: {{level: {91.75 * metre!r}, unit_weight: {9810 * force / metre**3!r}, up: {up}}}"
        added = f"level: {91.75 * metre!r}, bottom: 0, density: {1000 / metre**3!r}, up: {up}"
        elastic = f"young: {31.027e9 * force / metre**2!r}, poisson: 0.2"
        rest = "" if restart else "{name: rest}, "
        model = self.directory / f"{name}.yaml"
        model.write_text(f"""scabo: 1
analysis: {{plane: stress, thickness: {metre!r}}}
materials:
  concrete: {{{elastic}, density: {2643 / metre**3!r}, damping: {{ratio: 0.05, between: [3, 16]}}}}
  rock: {{{elastic}, density: 0}}
bodies:
  {(chr(10) + "  ").join(bodies[::-1] if reverse else bodies)}
supports: [{{on: rock.{bottom}, fix: [x, y]}}]
loads:
  weight: {{gravity: {turned(0, -9.81)}}}
  water: {{on: lower.face, {water}}}
  water_above: {{on: upper.face, {water}}}
added_mass: [{{on: lower.face, {added}}}, {{on: upper.face, {added}}}]
contacts:
  base: {{between: [rock.{top}, lower.base], friction: 1.0}}
  lift: {{between: [lower.lift, upper.lift], friction: 0.7}}
curves: {{x: {{table: {quake[0]}}}, y: {{table: {quake[1]}}}}}
steps: [{rest}{{name: shake, dynamic: {{duration: {duration}, step: {STEP}, ground: {{x: x, y: y}}}}, increments: {increments}}}]
{f"restart: {restart}.results" if restart else ""}
solver: {{halvings: 1}}
output:
  fields: []
  points: [{{at: {turned(0, 0)}, body: rock, name: foot}}]
  history:
    crest: {{displacement: upper.{crest}, axes: {degrees}}}
    lift: {{displacement: upper.{heel}, relative_to: lower.{crest}, axes: {degrees}}}
    base: {{displacement: lower.{heel}, relative_to: foot, axes: {degrees}}}
    shear: base.tangential_force
    heat: friction_energy
""", encoding="utf-8")
        run = scabo("run", model, "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(model.with_suffix(".results") / "history.csv", newline="", encoding="utf-8") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        unit = {"shear": side * force, "heat": force * metre, "lift.u2": metre, "base.u2": metre}
        return [{column: row[column] / unit.get(column, side * metre) for column in COLUMNS} for row in rows]

    def agree(self, rows, others):
        for column in COLUMNS:
            largest = max(abs(row[column]) for row in rows)
            for row, other in zip(rows, others, strict=True):
                self.assertAlmostEqual(other[column], row[column], delta=1e-8 * largest, msg=column)

    def test_twins(self):
        one = self.history("one")
        for column, least in (("heat", 1e4), ("lift.u1", 1e-3), ("lift.u2", 1e-4)):  # its joints slide and open
            self.assertGreater(max(abs(row[column]) for row in one), least, column)
        self.agree(one, self.history("millimetres", metre=1000.0))
        self.agree(one, self.history("turned", degrees=35))
        self.agree(one, self.history("mirrored", side=-1))
        self.agree(one, self.history("both", metre=39.37, side=-1, degrees=-100))
        self.agree(one, self.history("reversed", reverse=True))
        self.agree(one[::2], self.history("fewer", increments=10))
        first = self.history("first", duration=DURATION / 2, increments=10)
        self.agree(one, first + self.history("second", duration=DURATION / 2, increments=10, since=DURATION / 2, restart="first"))


class ElCentro(support.InTemporaryDirectory):
    """The first three seconds of the table in examples/28_koyna/README.md, by the recorded motion."""

    def test_the_dam_under_a_recorded_motion(self):
        run = scabo("run", support.ROOT / "examples" / "28_koyna" / "model.yaml", "-o", self.directory / "results", "--quiet",
                    "--set", "curves={pulse: {record: {file: elcentro.AT2, baseline: line}}}", "--set", "steps.1.dynamic.duration=3",
                    "--set", "steps.1.increments=150")
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(self.directory / "results" / "history.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertAlmostEqual(max(float(row["crest"]) for row in rows), 0.1173, delta=0.001)
        self.assertAlmostEqual(min(float(row["crest"]) for row in rows), -0.0676, delta=0.001)
        self.assertAlmostEqual(max(float(row["lift.uy"]) for row in rows), 0.0347, delta=0.001)
        self.assertAlmostEqual(max(float(row["toe.uy"]) for row in rows), 0.0308, delta=0.001)


if __name__ == "__main__":
    support.main()
