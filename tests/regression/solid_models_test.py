"""Models in space from the command line, against closed forms, plane models and bodies of revolution: examples/35_ball_on_block, loads
and rigid bodies."""
import json
import math
import resource
import shutil
import signal
import subprocess
import unittest

import support
from solids import arrays_of, interrupt
from support import ROOT, certificate_of, rows_of, scabo, summary_of

EXAMPLE = ROOT / "examples" / "30_blocks_in_space"


@unittest.skipIf(support.SANITIZED, "numbers")
class BallOnBlock(support.InTemporaryDirectory):
    """Hertz: pressure, force and radius of the contact of a ball and a half space."""
    example = ROOT / "examples" / "35_ball_on_block"

    def test_pressure_and_radius_are_those_of_hertz(self):
        check = json.loads((self.example / "check.json").read_text(encoding="utf-8"))
        done = scabo("run", self.example / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        increment, = summary_of(self.directory / "results")["increments"]
        self.assertLessEqual(certificate_of(increment), 1e-10)
        force = check["normal_force"]
        self.assertAlmostEqual(increment["contacts"]["joint"]["normal_force"][2], force, delta=1e-3 * force)
        self.assertAlmostEqual(increment["reactions"]["ground"][2], increment["contacts"]["joint"]["normal_force"][2], delta=1e-3 * force)
        tolerance, p0, a = check["relative_tolerance"], check["largest_pressure"], check["contact_radius"]  # a is six elements
        self.assertAlmostEqual(increment["contacts"]["joint"]["max_pressure"], p0, delta=tolerance * p0)
        rows = rows_of(self.directory / "results")
        closed = sum(float(row["area"]) for row in rows if row["state"] != "open")
        self.assertAlmostEqual(math.sqrt(4 * closed / math.pi), a, delta=check["relative_tolerance_of_the_radius"] * a)
        inner = [row for row in rows if math.hypot(float(row["x"]), float(row["y"])) < 0.85 * a]
        self.assertGreater(len(inner), 10)
        for row in inner:
            r = math.hypot(float(row["x"]), float(row["y"]))
            self.assertAlmostEqual(float(row["pressure"]), p0 * math.sqrt(1 - (r / a) ** 2), delta=0.02 * p0)
        done = scabo("run", self.example / "model.yaml", "-o", self.directory / "coarse", "--quiet", "--set", "parameters.fine=0.6e-3")
        self.assertEqual(done.returncode, 0, done.stderr)
        coarse = summary_of(self.directory / "coarse")["increments"][0]["contacts"]["joint"]["max_pressure"]
        self.assertLess(abs(increment["contacts"]["joint"]["max_pressure"] - p0), 0.55 * abs(coarse - p0))  # of first order, or higher


class Loads(support.InTemporaryDirectory):
    """Loads, rigid bodies and curves: closed forms, and the balance of forces and moments."""
    head = """scabo: 1
analysis: {space: true}
materials: {steel: {young: 200e3, poisson: 0.3, density: 8e-9, expansion: 1.2e-5}, cork: {young: 100, poisson: 0}}
bodies:
"""
    cube = "  cube: {material: steel, shape: {box: {corner: [0, 0, 0], size: [10, 10, 10]}}, mesh: {size: 5}}\n"

    def solve(self, text, *settings):
        (self.directory / "model.yaml").write_text(self.head + text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet", *settings)
        self.assertEqual(done.returncode, 0, done.stderr)
        increments = summary_of(self.directory / "results")["increments"]
        for increment in increments:
            self.assertLessEqual(certificate_of(increment), 1e-10)
        return increments

    def assert_vector(self, one, other, scale):
        for a, b in zip(one, other, strict=True):
            self.assertAlmostEqual(a, b, delta=1e-9 * scale)

    def heated(self, *held):
        supports = "".join(f"  - {{on: cube.{face}, fix: {axis}, name: {face}}}\n" for face, axis in
                           (("left", "x"), ("right", "x"), ("front", "y"), ("back", "y"), ("bottom", "z"), ("top", "z")) if face in held)
        increment, = self.solve(self.cube + "supports:\n" + supports + "loads: {summer: {temperature: 50}}\n")
        return increment, arrays_of(self.directory / "results" / "fields_0001.vtu")

    def test_a_free_body_expands_without_stress(self):
        increment, arrays = self.heated("left", "front", "bottom")
        self.assertAlmostEqual(increment["energy"]["elastic"], 0, delta=1e-9)
        self.assertLess(max(map(abs, arrays["stress"])), 1e-6)
        for x, u in zip(arrays["Points"], arrays["displacement"], strict=True):
            self.assertAlmostEqual(u, 1.2e-5 * 50 * x, delta=1e-12)

    def test_a_held_body_has_the_stress_of_its_expansion(self):
        stress = 200e3 * 1.2e-5 * 50
        increment, arrays = self.heated("left", "right", "front", "bottom")
        self.assert_vector(increment["reactions"]["right"], [-100 * stress, 0, 0], 100 * stress)
        self.assertAlmostEqual(increment["energy"]["elastic"], 1000 * stress**2 / 2 / 200e3, delta=1e-8 * stress)
        increment, arrays = self.heated("left", "right", "front", "back", "bottom", "top")
        self.assert_vector(increment["reactions"]["top"], [0, 0, -100 * stress / 0.4], 100 * stress)
        for k, value in enumerate(arrays["stress"]):
            self.assertAlmostEqual(value, -stress / 0.4 if k % 6 < 3 else 0, delta=1e-4)

    def test_forces_and_moments_balance(self):
        """Of a stack under every kind of load, on a tie, and with its contact sides swapped."""
        text = self.cube + """  base: {material: steel, shape: {box: {corner: [-3, -2, -6], size: [17, 15, 6]}}, mesh: {size: 4}}
supports:
  - {on: base.bottom, displacement: {formula: ["1e-4 * y", "1e-4 * x", 0]}, name: ground}
loads:
  press: {on: cube.top, force: [30, -20, -4000]}
  bend: {on: cube.top, moment: [500, -700, 300]}
  water: {on: cube.left, pressure: {formula: "2 * (10 - z)"}}
  wind: {on: cube.back, traction: {formula: ["0.1 * z", null, "0.02 * x"]}}
  weight: {on: cube, gravity: [0, 0, -9810]}
contacts:
  joint: {between: SIDES, friction: 0.6, about: [5, 5, 0]}
"""
        weight = 8e-9 * 1000 * 9810
        force = [30 + 1000 + 50, -20, -4000 + 10 - weight]
        # Moments of the loads about (5, 5, 0); water: 1000 at z = 10/3; wind along x: 50 at y = 10, z = 20/3; along z: 10 at x = 20/3, y = 10.
        moment = [500 + 200 + 10 * 5, -700 + 300 + 1000 * 10 / 3 + 50 * 20 / 3 - 10 * 5 / 3, 300 - 50 * 5]
        for sides, sign in (("[base.top, cube.bottom]", 1), ("[cube.bottom, base.top]", -1)):
            increment, = self.solve(text.replace("SIDES", sides))
            joint = increment["contacts"]["joint"]
            self.assert_vector([n + t for n, t in zip(joint["normal_force"], joint["tangential_force"])], [-sign * f for f in force], 4000)
            self.assert_vector(joint["moment"], [-sign * m for m in moment], 4e4)
            self.assert_vector(increment["reactions"]["ground"], [-f for f in force], 4000)
            x, y, z = force
            about_origin = [moment[0] + 5 * z, moment[1] - 5 * z, moment[2] + 5 * y - 5 * x]
            self.assert_vector(increment["moments"]["ground"], [-m for m in about_origin], 4e4)

    def test_a_press_fit_has_the_pressure_of_lame(self):
        """Interference of a bush in a ring, both kept from moving along the axis, that grows over a step."""
        tubes = """  ring: {material: steel, shape: {tube: {from: [0, 0, 0], to: [0, 0, 0.4], inner: 1.5, outer: 2}}, mesh: {size: 0.2}}
  bush: {material: steel, shape: {tube: {from: [0, 0, 0], to: [0, 0, 0.4], inner: 1, outer: 1.5}}, mesh: {size: 0.25}}
supports:
""" + "".join(f"  - {{on: {body}.{face}, fix: z}}\n" for body in ("ring", "bush") for face in ("bottom", "top"))
        increments = self.solve(tubes + """contacts:
  joint: {between: [ring.inside, bush.outside], friction: 0.2, gap: -1e-3, fit_in: fit}
steps: [{name: rest}, {name: fit, increments: 2}]
""")
        a, b, c, E, nu = 1, 1.5, 2, 200e3, 0.3
        ring = b * (1 + nu) / E * ((1 - 2 * nu) * b**2 + c**2) / (c**2 - b**2)
        bush = b * (1 + nu) / E * ((1 - 2 * nu) * b**2 + a**2) / (b**2 - a**2)
        self.assertEqual(increments[0]["contacts"]["joint"]["max_pressure"], 0)
        for number, part in ((1, 0.5), (2, 1)):
            rows = [row for row in rows_of(self.directory / "results") if (row["step"], row["increment"]) == ("2", str(number))]
            mean = sum(float(row["normal_force"]) for row in rows) / sum(float(row["area"]) for row in rows)
            self.assertAlmostEqual(mean, part * 1e-3 / (ring + bush), delta=5e-3 * mean)

    def test_a_rigid_plate_that_turns_bends_a_bar(self):
        """Poisson's ratio 0, tied at both ends: M = E I angle / length."""
        increment, = self.solve("""  bar: {material: cork, shape: {box: {corner: [0, 0, 0], size: [2, 1, 4]}}, mesh: {size: 1}}
  floor: {rigid: true, shape: {box: {corner: [-1, -1, -1], size: [4, 3, 1]}}, mesh: {size: 2}}
  lid: {rigid: true, shape: {box: {corner: [-1, -1, 4], size: [4, 3, 1]}}, mesh: {size: 3}}
supports:
  - {on: floor, fix: [x, y, z], name: floor}
  - {on: lid, rotation: [0, 0.02, null], at: [1, 0.5, 4], name: lid}
ties:
  below: {between: [floor.top, bar.bottom]}
  above: {between: [bar.top, lid.bottom]}
""")
        moment = 100 * (1 * 2**3 / 12) * 0.02 / 4
        self.assert_vector(increment["reactions"]["lid"], [0, 0, 0], moment)
        self.assert_vector(increment["moments"]["lid"], [0, moment, 0], moment)
        self.assert_vector(increment["moments"]["floor"], [0, -moment, 0], moment)
        self.assertAlmostEqual(increment["energy"]["elastic"], moment * 0.02 / 2, delta=1e-9 * moment)
        self.assertAlmostEqual(increment["energy"]["external"], moment * 0.02 / 2, delta=1e-9 * moment)

    def test_a_free_rigid_punch_is_in_balance(self):
        """Pressed beside its middle; turned (x -> y -> z -> x) it is the same."""
        model = """  block: {material: steel, shape: {box: {corner: BASE, size: SIZE}}, mesh: {size: 3}}
  punch: {rigid: true, density: 8e-9, shape: {cylinder: {from: FROM, to: TO, radius: 3}}, mesh: {size: 2}}
supports: [{on: block.FACE, fix: [x, y, z], name: ground}]
loads:
  press: {on: punch, force: FORCE}
  tilt: {on: punch, moment: MOMENT}
  weight: {on: punch, gravity: GRAVITY}
contacts: {joint: {between: [block.UPPER, punch.bottom], friction: 0.5}}
"""
        def turned(vector, turns):
            return vector if turns == 0 else turned([vector[2], *vector[:2]], turns - 1)
        results = []
        for turns in (0, 1):
            text = model
            for name, value in (("BASE", [-8, -7, -6]), ("SIZE", [16, 15, 6]), ("FROM", [0.5, 0, 0]), ("TO", [0.5, 0, 4]), ("FORCE", [30, 20, -900]),
                                ("MOMENT", [200, -300, 100]), ("GRAVITY", [0, 0, -9810])):
                text = text.replace(name, str(turned(value, turns)))
            increment, = self.solve(text.replace("FACE", ["bottom", "left"][turns]).replace("UPPER", ["top", "right"][turns]))
            results.append(increment)
        one, other = results
        joint = one["contacts"]["joint"]
        force = [n + t for n, t in zip(joint["normal_force"], joint["tangential_force"])]
        weight = force[2] - 900
        self.assert_vector(force[:2], [-30, -20], 900)
        self.assertAlmostEqual(weight, 8e-9 * 9810 * math.pi * 9 * 4, delta=0.01 * weight)
        z = -900 - weight
        # About the origin; force and moment act at the centroid (0.5, 0, 2).
        moment = [200 - 2 * 20, -300 + 2 * 30 - 0.5 * z, 100 + 0.5 * 20]
        self.assert_vector(joint["moment"], [-m for m in moment], 2e3)
        self.assert_vector(one["moments"]["ground"], [-m for m in moment], 2e3)
        for name in ("normal_force", "tangential_force", "moment"):
            self.assert_vector(turned(joint[name], 1), other["contacts"]["joint"][name], 2e3)

    def test_what_only_the_mesh_shows_is_refused(self):
        lid = "  lid: {rigid: true, shape: {box: {corner: [0, 0, 10], size: [10, 10, 1]}}, mesh: {size: 5}}\n"
        base = self.cube + lid + "contacts:\n  joint: {between: [cube.top, lid.bottom], friction: 0}\nsupports:\n  - {on: cube.bottom, fix: [x, y, z]}\n"
        for text, why in (("  - {on: lid, fix: [x, y]}\n  - {on: lid, fix: x}\n", r":12:10: supports.2.on: support 'support_3' holds the displacement along x of body 'lid', as does support 'support_2'"),
                          ("  - {on: lid, rotation: [0, 0, 0], at: [0, 0, 9]}\n  - {on: lid, displacement: [null, null, 0], rotation: [null, null, null]}\n", r":12:10: supports.2.on: support 'support_3' and support 'support_2' hold body 'lid' at two points: give both the same 'at'"),
                          ("loads: {push: {on: cube.left, pressure: {formula: \"sqrt(-1 - y)\"}}}\n", r":11:20: loads.push.on: the formula of load 'push' has no value at \(0, "),
                          ("  - {on: cube.top, displacement: {formula: [null, null, \"ln(x)\"]}}\n", r":11:10: supports.1.on: the formula of the displacement along z has no value at \(0, ")):
            with self.subTest(text=text):
                (self.directory / "model.yaml").write_text(self.head + base + text, encoding="utf-8")
                done = scabo("check", self.directory / "model.yaml")
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertRegex(done.stderr, why)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_a_factor_follows_a_curve_in_cycles(self):
        increments = self.solve(self.cube + """supports:
  - {on: cube.bottom, fix: [x, y, z], name: ground}
loads: {push: {on: cube.top, traction: [1, 0, 0]}}
curves: {back_and_forth: {table: [[0, 0], [1, 1], [3, -1], [4, 0]]}}
steps: [{name: shake, increments: 2, cycles: 2, loads: {push: back_and_forth}}]
""")
        self.assertEqual([of["reached"] for of in increments], [0.25, 0.5, 0.75, 1] * 2)
        self.assertEqual([round(of["factors"]["push"], 12) for of in increments], [1, 0, -1, 0] * 2)
        for of in increments:
            self.assert_vector(of["reactions"]["ground"], [-100 * of["factors"]["push"], 0, 0], 100)

    def test_an_increment_that_the_disk_does_not_hold_is_taken_back(self):
        limit = 60 * 1024
        def limited():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        done = subprocess.run([support.SCABO, "run", EXAMPLE / "model.yaml", "-q", "-o", self.directory / "results", "--set", "steps.1.increments=60"],
                              capture_output=True, text=True, timeout=support.PATIENCE, preexec_fn=limited)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r"^scabo: cannot write .*: File too large\n$")
        summary = summary_of(self.directory / "results")
        self.assertEqual(summary["status"], "failed")
        self.assertEqual(summary["warnings"], [])
        finished = len(summary["increments"])
        self.assertGreater(finished, 2)
        self.assertEqual(len(list((self.directory / "results").glob("fields_*.vtu"))), finished)
        rows = rows_of(self.directory / "results")
        self.assertEqual(len(rows), 9 * finished)


class Bolts(support.InTemporaryDirectory):
    """A bolt between two rigid plates that press two columns together; Poisson's ratio 0, so that all stresses are uniform."""
    head = """scabo: 1
analysis: {space: true}
materials: {steel: {young: 200e3, poisson: 0}}
bodies:
  left: {material: steel, shape: {box: {corner: [-30, 0, 0], size: [15, 10, 20]}}, mesh: {size: 5}}
  right: {material: steel, shape: {box: {corner: [15, 0, 0], size: [15, 10, 20]}}, mesh: {size: 5}}
  head: {rigid: true, shape: {box: {corner: [-30, 0, 20], size: [60, 10, 5]}}, mesh: {size: 20}}
  nut: {rigid: true, shape: {box: {corner: [-30, 0, -5], size: [60, 10, 5]}}, mesh: {size: 20}}
  shank:
    material: steel
    shape: {box: {corner: [-5, 0, 0], size: [10, 10, 20]}}
    mesh: {size: 5}
    preload: PRELOAD
supports:
  - {on: nut, fix: [x, y, z], name: ground}
loads:
  pull: {on: head, force: [0, 0, 5e3]}
contacts:
  left_head: {between: [left.top, head.bottom], friction: 0.2}
  left_nut: {between: [nut.top, left.bottom], friction: 0.2}
  right_head: {between: [right.top, head.bottom], friction: 0.2}
  right_nut: {between: [nut.top, right.bottom], friction: 0.2}
ties:
  to_head: {between: [shank.top, head.bottom]}
  to_nut: {between: [nut.top, shank.bottom]}
steps:
  - {name: rest, loads: {pull: 0}}
  - {name: tighten, increments: 2, loads: {pull: 0}}
  - {name: load, loads: {pull: 1}}
  - {name: off, loads: {pull: 8}}
"""
    bolt, columns = 200e3 * 100 / 20, 200e3 * 300 / 20  # stiffness of the shank, of what it presses together
    cut = "cut: {point: [0, 0, 8], normal: [0, 0, 3]}"

    def solve(self, preload, *settings):
        model = self.directory / "model.yaml"
        model.write_text(self.head.replace("PRELOAD", preload), encoding="utf-8")
        done = scabo("run", model, "-o", self.directory / "results", "--quiet", *settings)
        self.assertEqual(done.returncode, 0, done.stderr)
        return summary_of(self.directory / "results")["increments"]

    def check(self, increments, force):
        shortening = force * (1 / self.bolt + 1 / self.columns)
        tensions = (0, force / 2, force, force + 5e3 * self.bolt / (self.bolt + self.columns), 40e3)
        for increment, tension, s in zip(increments, tensions, (0, shortening / 2) + 3 * (shortening,), strict=True):
            self.assertLessEqual(certificate_of(increment), 1e-10)
            made = increment["preloads"]["shank"]
            self.assertAlmostEqual(made["force"], tension, delta=1e-9 * force)
            self.assertAlmostEqual(made["shortening"], s, delta=1e-9 * shortening)
            pressed = tension - 5e3 * increment["factors"]["pull"]
            for side in ("left", "right"):
                self.assertAlmostEqual(increment["contacts"][f"{side}_head"]["normal_force"][2], 0.5 * pressed, delta=1e-9 * force)
        for increment in increments[:4]:  # up to here nothing opens
            self.assertAlmostEqual(increment["energy"]["external"], increment["energy"]["elastic"], delta=1e-9 * force * shortening)
        self.assertAlmostEqual(increments[2]["energy"]["elastic"], 0.5 * force * shortening, delta=1e-9 * force * shortening)

    def test_a_force_is_set_and_then_the_shortening_stays(self):
        self.check(self.solve(f"{{{self.cut}, force: 20e3, tightened: tighten}}"), 20e3)
        arrays = arrays_of(self.directory / "results" / "fields_0003.vtu")
        stresses = [arrays["stress"][6 * i + 2] for i, body in enumerate(arrays["node_body"]) if body == 5]
        self.assertGreater(len(stresses), 100)
        for stress in stresses:  # also of the elements that the cut goes between
            self.assertAlmostEqual(stress, 200, delta=1e-3)

    def test_a_shortening_is_set(self):
        shortening = 20e3 * (1 / self.bolt + 1 / self.columns)
        self.check(self.solve(f"{{{self.cut}, shortening: {shortening!r}, tightened: tighten}}"), 20e3)

    def test_a_run_is_resumed_while_the_bolt_is_tightened(self):
        preload = f"{{{self.cut}, force: 20e3, tightened: tighten}}"
        whole = self.solve(preload, "--set", "steps.1.increments=40")
        shutil.rmtree(self.directory / "results")
        interrupt(self, self.directory / "model.yaml", self.directory / "results", "--set", "steps.1.increments=40")
        self.assertLess(len(summary_of(self.directory / "results")["increments"]), 41)
        done = scabo("resume", self.directory / "results", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(summary_of(self.directory / "results")["increments"], whole)

    def test_the_log_tells_the_tension(self):
        self.solve(f"{{{self.cut}, force: 20e3, tightened: tighten}}")
        self.assertIn("preload of shank: tension 40000, shortened by 0.0266667\n", (self.directory / "results" / "log.txt").read_text(encoding="utf-8"))

    def test_what_only_the_mesh_shows_is_refused(self):
        model = self.directory / "model.yaml"
        for preload, more, why in (
                ("{cut: {point: [0, 0, 21], normal: [0, 0, 1]}, force: 1}", "", r":13:14: bodies.shank.preload: the cut of the preload of body 'shank' has all of it on one side: "),
                (f"{{{self.cut}, force: 1}}", "  - {on: shank.top, fix: z}\n  - {on: shank.bottom, fix: z}\n", r":13:14: bodies.shank.preload: .* lies between supports that hold it along the bolt, ")):
            with self.subTest(preload=preload):
                model.write_text(self.head.replace("PRELOAD", preload).replace("loads:\n", more + "loads:\n", 1), encoding="utf-8")
                done = scabo("check", model)
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertRegex(done.stderr, why)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)


class AgainstThePlane(support.InTemporaryDirectory):
    """Models in space whose fields are those of a plane one: forces that statics fixes are the same, others converge."""
    materials = "materials: {steel: {young: 200e3, poisson: 0.3}}\n"

    def solve(self, text, name):
        model = self.directory / f"{name}.yaml"
        model.write_text("scabo: 1\n" + self.materials + text, encoding="utf-8")
        done = scabo("run", model, "-o", self.directory / name, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return summary_of(self.directory / name)["increments"]

    def assert_within(self, one, other, part):
        self.assertAlmostEqual(one, other, delta=part * abs(other))

    def test_plane_strain_between_planes_of_symmetry(self):
        """A block pressed on a larger one and pushed until half of its base slides; in space a slice of it."""
        common = """contacts: {joint: {between: [base.top, block.bottom], friction: 0.3}}
loads: {press: {on: block.top, pressure: 100}}
steps:
  - {name: press, loads: {press: 1, ram: 0}}
  - {name: push, loads: {ram: 1}}
"""
        plane = self.solve(common + """analysis: {plane: strain, thickness: 0.5}
bodies:
  base: {material: steel, shape: {rectangle: {corner: [0, -5], size: [10, 5]}}, mesh: {kind: fem, size: 0.2, order: 2}}
  block: {material: steel, shape: {rectangle: {corner: [2, 0], size: [6, 3]}}, mesh: {kind: fem, size: 0.2, order: 2}}
supports:
  - {on: base.bottom, fix: [x, y], name: ground}
  - {on: block.left, displacement: [2e-3, null], name: ram}
""", "plane")
        space = self.solve(common + """analysis: {space: true}
bodies:
  base: {material: steel, shape: {box: {corner: [0, 0, -5], size: [10, 0.5, 5]}}, mesh: {size: 0.5}}
  block: {material: steel, shape: {box: {corner: [2, 0, 0], size: [6, 0.5, 3]}}, mesh: {size: 0.5}}
supports:
  - {on: base.bottom, fix: [x, y, z], name: ground}
  - {on: block.left, displacement: [2e-3, null, null], name: ram}
""" + "".join(f"  - {{on: {body}.{face}, fix: y}}\n" for body in ("base", "block") for face in ("front", "back")), "space")
        for one, other in zip(space, plane, strict=True):
            self.assertAlmostEqual(one["contacts"]["joint"]["normal_force"][2], 300, delta=300e-9)
            self.assertAlmostEqual(one["reactions"]["ground"][2], 300, delta=300e-9)
            self.assert_within(one["reactions"]["ram"][0], other["reactions"]["ram"][0], 5e-3)
            self.assert_within(one["energy"]["elastic"], other["energy"]["elastic"], 5e-3)
        self.assertGreater(space[-1]["contacts"]["joint"]["slip"], 5)
        self.assertGreater(space[-1]["contacts"]["joint"]["stick"], 5)

    def test_a_pin_on_a_disc_against_a_body_of_revolution(self):
        """Pressed down by a given way. The force falls to that of a fine mesh of the plane as the elements become smaller."""
        common = """contacts: {joint: {between: [base.top, pin.bottom], friction: 0.1}}
"""
        plane, = self.solve(common + """analysis: {plane: axisymmetric}
bodies:
  base: {material: steel, shape: {rectangle: {corner: [0, -2], size: [3, 2]}}, mesh: {kind: fem, size: 0.15, order: 2}}
  pin: {material: steel, shape: {rectangle: {corner: [0, 0], size: [1.5, 2]}}, mesh: {kind: fem, size: 0.15, order: 2}}
supports:
  - {on: base.bottom, fix: [x, y], name: ground}
  - {on: pin.top, displacement: [0, -2e-3], name: ram}
""", "plane")
        force = -plane["reactions"]["ram"][1]
        for sizes, part in (((0.7, 0.55), 1e-2), ((0.45, 0.35), 5e-3)):
            space, = self.solve(common + f"""analysis: {{space: true}}
bodies:
  base: {{material: steel, shape: {{cylinder: {{from: [0, 0, -2], to: [0, 0, 0], radius: 3}}}}, mesh: {{size: {sizes[0]}}}}}
  pin: {{material: steel, shape: {{cylinder: {{from: [0, 0, 0], to: [0, 0, 2], radius: 1.5}}}}, mesh: {{size: {sizes[1]}}}}}
supports:
  - {{on: base.bottom, fix: [x, y, z], name: ground}}
  - {{on: pin.top, displacement: [0, 0, -2e-3], name: ram}}
""", "space")
            ram, ground = space["reactions"]["ram"], space["reactions"]["ground"]
            self.assert_within(-ram[2], force, part)
            self.assert_within(space["energy"]["elastic"], plane["energy"]["elastic"], part)
            for k in range(3):
                self.assertAlmostEqual(ram[k] + ground[k], 0, delta=1e-9 * force)
                self.assertAlmostEqual(space["moments"]["ram"][k] + space["moments"]["ground"][k], 0, delta=1e-9 * force)


if __name__ == "__main__":
    support.main()
