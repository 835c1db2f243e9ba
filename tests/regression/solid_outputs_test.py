"""What `output` of models in space asks for: values at points and resultants over sections, against closed forms and statics."""
import csv
import math
import unittest

import support
from support import scabo, summary_of

E, NU, A, B = 210e9, 0.3, -2e6, 5e6  # stress zz = A + B x
SIZE = (1.0, 0.8, 0.5)
ABOUT = (0.2, 0.1, 0.7)


def exact(x, y, z):
    stress = A + B * x
    return (-B * z * z / (2 * E) - NU / E * (A * x + B * (x * x - y * y) / 2), -NU / E * stress * y, stress * z / E)


MODEL = f"""scabo: 1
analysis: {{space: true}}
materials: {{steel: {{young: {E}, poisson: {NU}}}}}
bodies:
  block: {{material: steel, shape: {{box: {{corner: [0, 0, 0], size: [1, 0.8, 0.5]}}}}, mesh: {{size: 0.3}}}}
supports:
  - on: block.bottom
    name: ground
    displacement: {{formula: ["{-NU / E} * ({A} * x + {B} * (x * x - y * y) / 2)", "{-NU / E} * ({A} + {B} * x) * y", "0"]}}
loads:
  pull: {{on: block.top, traction: {{formula: [null, null, "{A} + {B} * x"]}}}}
output:
  points: [[0.3, 0.4, 0.2], {{at: [0.87, 0.13, 0.41], name: tip, body: block}}]
  history:
    level: {{section: {{point: [0, 0, 0.2], normal: [0, 0, 3], about: [0.2, 0.1, 0.7]}}}}
    oblique: {{section: {{point: [0.5, 0.4, 0.25], normal: [0.1, -0.2, 1], about: [0.2, 0.1, 0.7], body: block}}}}
    down: {{section: {{point: [0, 0, 0.2], normal: [0, 0, -1]}}}}
steps: [{{name: pull, increments: 2}}]
"""

BOLT = """scabo: 1
analysis: {space: true}
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies:
  ring: {material: steel, shape: {tube: {from: [0, 0, 0], to: [0, 0, 0.05], inner: 9e-3, outer: 20e-3}}, mesh: {size: 0.008}}
  bolt:
    material: steel
    shape: {cylinder: {from: [0, 0, 0], to: [0, 0, 0.05], radius: 8e-3}}
    mesh: {size: 4e-3}
    preload: {cut: {point: [0, 0, 0.025], normal: [0, 0, 1]}, force: 50e3}
  head: {rigid: true, shape: {cylinder: {from: [0, 0, 0.05], to: [0, 0, 0.06], radius: 13e-3}}, mesh: {size: 0.01}}
  nut: {rigid: true, shape: {cylinder: {from: [0, 0, -0.01], to: [0, 0, 0], radius: 13e-3}}, mesh: {size: 0.01}}
supports:
  - {on: nut, fix: [x, y, z]}
contacts:
  under_head: {between: [ring.top, head.bottom], friction: 0.2}
  on_nut: {between: [nut.top, ring.bottom], friction: 0.2}
ties:
  to_head: {between: [bolt.top, head.bottom]}
  to_nut: {between: [nut.top, bolt.bottom]}
output:
  history:
    bolt: {section: {point: [0, 0, 0.0201], normal: [0, 0, 1], body: bolt}}
    cut: {section: {point: [0, 0, 0.0251], normal: [0, 0, 1], body: bolt}}
    ring: {section: {point: [0, 0, 0.0301], normal: [0, 0, 1], body: ring}}
"""


class Outputs(support.InTemporaryDirectory):
    def solve(self, text, status=0):
        (self.directory / "model.yaml").write_text(text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def rows(self, name):
        with open(self.directory / "results" / name, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def test_a_stress_that_is_linear_is_integrated_exactly(self):
        self.solve(MODEL)
        self.solve(MODEL)  # results of an earlier run are replaced
        first, last = self.rows("history.csv")
        self.assertEqual((first["increment"], first["time"], last["time"]), ("1", "0.5", "1"))
        reaction = summary_of(self.directory / "results")["increments"][-1]["reactions"]["ground"]
        area = SIZE[0] * SIZE[1]
        force = area * (A + B / 2)
        # int (x - c) x (0, 0, A + B x) dA
        mean_x = 0.8 * (A / 2 + B / 3)
        moment = (force * (0.4 - ABOUT[1]), -(mean_x - ABOUT[0] * force), 0.0)
        for name in ("level", "oblique"):
            for row, factor in ((first, 0.5), (last, 1.0)):
                of = {column: float(row[f"{name}.{column}"]) for column in
                      ("normal", "force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z")}
                for axis, value in zip("xyz", (0.0, 0.0, force)):
                    self.assertAlmostEqual(of[f"force_{axis}"], factor * value, delta=1e-9 * abs(force))
                for axis, value in zip("xyz", moment):
                    self.assertAlmostEqual(of[f"moment_{axis}"], factor * value, delta=1e-9 * abs(force))
        self.assertAlmostEqual(float(last["oblique.normal"]), force / math.sqrt(1.05), delta=1e-9 * abs(force))
        self.assertAlmostEqual(float(last["level.force_z"]), -reaction[2], delta=1e-9 * abs(force))
        # What the part below exerts on the part above; about the centroid, bending about y alone is left.
        self.assertAlmostEqual(float(last["down.force_z"]), -force, delta=1e-9 * abs(force))
        self.assertAlmostEqual(float(last["down.normal"]), force, delta=1e-9 * abs(force))
        self.assertAlmostEqual(float(last["down.moment_y"]), B * 0.8 / 12, delta=1e-9 * abs(force))
        self.assertAlmostEqual(float(last["down.moment_x"]), 0.0, delta=1e-9 * abs(force))

    def test_points_have_the_values_of_the_closed_form(self):
        self.solve(MODEL)
        rows = self.rows("points.csv")
        self.assertEqual([(row["increment"], row["name"], row["body"]) for row in rows],
                         [(k, name, "block") for k in "12" for name in ("point_1", "tip")])
        for row in rows:
            factor = 0.5 * int(row["increment"])
            x, y, z = (float(row[axis]) for axis in "xyz")
            for axis, value in zip("xyz", exact(x, y, z)):
                self.assertAlmostEqual(float(row[f"u{axis}"]), factor * value, delta=1e-9 * B / E)
            stress = factor * (A + B * x)
            for name in ("xx", "yy", "zz", "xy", "yz", "xz"):
                self.assertAlmostEqual(float(row[f"stress_{name}"]), stress if name == "zz" else 0.0, delta=1e-9 * B)
            self.assertAlmostEqual(float(row["von_mises"]), abs(stress), delta=1e-9 * B)
            self.assertAlmostEqual(float(row["principal_1"]), max(stress, 0.0), delta=1e-9 * B)

    def test_a_bolt_and_what_it_presses_are_in_balance(self):
        self.solve(BOLT)
        last, = self.rows("history.csv")
        for name, force in (("bolt", 50e3), ("cut", 50e3), ("ring", -50e3)):
            self.assertAlmostEqual(float(last[f"{name}.normal"]), force, delta=0.01 * 50e3)
            for axis in "xy":
                self.assertAlmostEqual(float(last[f"{name}.force_{axis}"]), 0.0, delta=0.01 * 50e3)

    numbers = """scabo: 1
analysis: {space: true}
materials: {m: {young: 1e9, poisson: 0}}
bodies:
  block: {material: m, shape: {box: {corner: [0, 0, 0], size: [2, 1, 1]}}, mesh: {size: 0.5}}
  table: {rigid: true, shape: {box: {corner: [-1, -1, -1], size: [4, 3, 1]}}, mesh: {size: 2}}
supports: [{on: table, fix: [x, y, z], name: ground}]
springs: [{on: block.right, k_n: 1e7, k_t: 1e7, name: wall}]
loads: {press: {on: block.top, traction: [2e4, -1e4, -1e5]}}
contacts: {joint: {between: [table.top, block.bottom], friction: 0.4, cohesion: 1e5, about: [1, 0.5, 0]}}
output:
  history:
    cut: {section: {point: [0, 0, 0.5], normal: [0, 0, 1], body: block}}
    push: joint.tangential_force_x
    all: joint.force_z
    turn: joint.moment_y
    peak: joint.max_pressure
    held: joint.stick
    lost: joint.broken
    ground: ground.reaction_y
    tip: ground.moment_x
    wall: wall.reaction_x
    work: external_energy
steps: [{name: press, increments: 2}]
"""

    def test_a_history_has_the_numbers_of_the_summary(self):
        self.solve(self.numbers)
        increments = summary_of(self.directory / "results")["increments"]
        for row, increment in zip(self.rows("history.csv"), increments, strict=True):
            joint, ground = increment["contacts"]["joint"], increment["reactions"]["ground"]
            for name, value in (("push", joint["tangential_force"][0]), ("all", joint["normal_force"][2] + joint["tangential_force"][2]),
                                ("turn", joint["moment"][1]), ("peak", joint["max_pressure"]), ("held", joint["stick"]), ("lost", joint["broken"]),
                                ("ground", ground[1]), ("tip", increment["moments"]["ground"][0]), ("wall", increment["springs"]["wall"][0]),
                                ("work", increment["energy"]["external"])):
                self.assertEqual(float(row[name]), value, name)
            self.assertAlmostEqual(float(row["cut.normal"]), -1e5 * int(row["increment"]), delta=0.02 * 1e5)  # the wall takes some of it
            self.assertGreater(abs(float(row["wall"])), 1)
            self.assertGreater(float(row["work"]), 0)

    def test_a_sweep_varies_values(self):
        """A table of friction and pressure: what slides is told as it is."""
        (self.directory / "model.yaml").write_text(self.numbers.replace("cohesion: 1e5, ", "")
                                                   .replace("    lost: joint.broken\n", "").replace("springs:", "springs: []\n#").replace("    wall: wall.reaction_x\n", ""), encoding="utf-8")
        command = ("sweep", self.directory / "model.yaml", "-o", self.directory / "sweep", "--vary", "contacts.joint.friction=0.1,0.3",
                   "--vary", "materials.m.young=1e9,2e9", "--quiet", "-j", "1")
        done = scabo(*command)
        self.assertEqual(done.returncode, 2, done.stderr)
        with open(self.directory / "sweep" / "sweep.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([(row["contacts.joint.friction"], row["materials.m.young"], row["status"]) for row in rows],
                         [("0.1", "1e9", "mechanism"), ("0.1", "2e9", "mechanism"), ("0.3", "1e9", "solved"), ("0.3", "2e9", "solved")])
        for row in rows[2:]:
            last = summary_of(self.directory / "sweep" / f"point_{int(row['point']):03d}")["increments"][-1]
            self.assertEqual([float(row[f"ground.reaction_{axis}"]) for axis in "xyz"], last["reactions"]["ground"])
            self.assertEqual([float(row[f"joint.normal_force_{axis}"]) for axis in "xyz"], last["contacts"]["joint"]["normal_force"])
            self.assertEqual(float(row["energy.elastic"]), last["energy"]["elastic"])
        before = (self.directory / "sweep" / "sweep.csv").read_bytes()
        self.assertEqual(scabo(*command).returncode, 2)  # all of it is there
        self.assertEqual((self.directory / "sweep" / "sweep.csv").read_bytes(), before)

    def test_mistakes_that_only_the_mesh_shows(self):
        for part, by, message in (
                ("[0.3, 0.4, 0.2]", "[0.3, 0.4, 0.51]", r"output.points.0: the point \(0.3, 0.4, 0.51\) lies in no body: move it"),
                ("[0.87, 0.13, 0.41]", "[1.87, 0.13, 0.41]", r"lies outside of body 'block': move it"),
                ("point: [0, 0, 0.2], normal: [0, 0, 3]", "point: [0, 0, 0.6], normal: [0, 0, 3]",
                 r"output.history.level.section: the plane of section 'level' cuts no elastic body: move its 'point'")):
            (self.directory / "model.yaml").write_text(MODEL.replace(part, by), encoding="utf-8")
            for command in ("check", "run"):
                done = scabo(command, self.directory / "model.yaml")
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, message)


if __name__ == "__main__":
    support.main()
