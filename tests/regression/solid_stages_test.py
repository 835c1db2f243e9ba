"""Bodies in space that are added and removed in steps."""
import importlib.util
import math
import signal
import subprocess
import sys
import time
import unittest

import support
from solids import HEAD, arrays_of
from support import certificate_of, rows_of, scabo, summary_of

YOUNG, RHO, G, H = 1e9, 2000.0, 10.0, 0.5
WEIGHT = RHO * G * H  # of a block over its area
UNIT = WEIGHT * H / YOUNG
STEPS = "{name: first}, {name: lift_2}, {name: lift_3, increments: 3}, {name: lift_4}, {name: down, increments: 2}, {name: back}"
ADDED = ["first", "lift_2", "lift_3", "lift_4"]
REMOVED = [None, None, "back", "down"]


def column(angle=0.0, metre=1.0, kind="tetrahedra"):
    """Four blocks of a column along a direction of the plane of x and y, on a rigid floor. `metre`: in units of length."""
    along, across = (math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))

    def at(s, t):
        return [metre * (s * along[k] + t * across[k]) for k in range(2)]

    def shape(low, high, left, right):
        corners = ", ".join(f"[{x!r}, {y!r}]" for x, y in (at(low, left), at(high, left), at(high, right), at(low, right)))
        return ("{extrude: {profile: {polygon: {vertices: [" + corners + "], names: {low: edge_4, high: edge_2}}}, plane: xy, "
                f"from: {left * metre!r}, to: {right * metre!r}}}}}")

    bodies = [f"  floor: {{rigid: true, shape: {shape(-1, 0, -1, 2)}, mesh: {{size: {metre}}}}}"]
    points = []
    for k in range(4):
        removed = f", removed: {REMOVED[k]}" if REMOVED[k] else ""
        bodies.append(f"  block_{k + 1}: {{material: stuff, shape: {shape(k * H, (k + 1) * H, 0, 1)}, "
                      f"mesh: {{size: {0.5 * metre}, kind: {kind}}}, added: {ADDED[k]}{removed}}}")
        x, y = at((k + 1) * H, 0.5)
        points.append(f"{{at: [{x!r}, {y!r}, {0.5 * metre!r}], body: block_{k + 1}, name: top_{k + 1}}}")
    contacts = ["  base: {between: [floor.high, block_1.low], friction: 0.5}"]
    contacts += [f"  joint_{k}: {{between: [block_{k}.high, block_{k + 1}.low], friction: 0.5}}" for k in (1, 2, 3)]
    gravity = [-G * metre * x for x in (*along, 0.0)]
    return "\n".join([f"materials: {{stuff: {{young: {YOUNG / metre**2!r}, poisson: 0, density: {RHO / metre**4!r}}}}}", "bodies:", *bodies,
                      "supports: [{on: floor, fix: [x, y, z]}]", f"loads: {{weight: {{gravity: {gravity!r}}}}}", "contacts:", *contacts,
                      f"steps: [{STEPS}]", f"output: {{points: [{', '.join(points)}]}}", ""]), along


class Running(support.InTemporaryDirectory):
    def run_model(self, text, name="model", status=0):
        (self.directory / f"{name}.yaml").write_text(HEAD + text, encoding="utf-8")
        done = scabo("run", self.directory / f"{name}.yaml", "-o", self.directory / f"{name}.results", "--quiet")
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return summary_of(self.directory / f"{name}.results")["increments"]

    def points(self, name="model"):
        """Displacements by step, increment and name."""
        rows = (self.directory / f"{name}.results" / "points.csv").read_text(encoding="utf-8").splitlines()[1:]
        return {(int(row[0]), int(row[1]), row[2]): [float(x) for x in row[7:10]] for row in (line.split(",") for line in rows)}

    def assert_energies(self, increment, delta=1e-9):
        energy = increment["energy"]
        self.assertAlmostEqual(energy["external"], energy["elastic"] + energy["friction"], delta=delta * energy["elastic"] + energy["friction_error"])


class Stages(Running):
    def test_a_column_settles_under_what_comes_later_and_rises_again(self):
        """As in the plane (tests/verification/stages_test.cpp): nu = 0, so that every stress is uniaxial, and any division is exact."""
        for angle, metre, kind in ((0.0, 1.0, "tetrahedra"), (0.0, 1.0, "hexahedra"), (0.7, 1.0, "tetrahedra"), (2.0, 1000.0, "tetrahedra")):
            with self.subTest(angle=angle, metre=metre, kind=kind):
                text, along = column(angle, metre, kind)
                increments = self.run_model(text)
                points = self.points()
                there = {1: 1, 2: 2, 3: 3, 4: 4, 5: 3, 6: 2}
                for increment in increments:
                    step, reached, part = increment["step"], increment["increment"], increment["reached"]
                    n = there[step]
                    self.assertLessEqual(certificate_of(increment), 1e-10)
                    self.assert_energies(increment)
                    self.assertEqual(increment["absent"], [f"block_{k}" for k in range(n + 1, 5)])
                    joints = ["base", "joint_1", "joint_2", "joint_3"]
                    for k in range(4):  # the weight of what comes grows, and of what goes falls, over the step
                        force = sum(x * a for x, a in zip(increment["contacts"][joints[k]]["normal_force"], along))
                        above = n - k - 1 + part if step <= 4 else n - k + 1 - part
                        self.assertAlmostEqual(force, above * WEIGHT if k < n else 0.0, delta=1e-9 * WEIGHT)
                    for k in range(n, 4):
                        self.assertNotIn((step, reached, f"top_{k + 1}"), points)
                    if part < 1.0:
                        continue
                    for i in range(1, n + 1):
                        down = ((i - 1) * (n - i + 1) + n - i + 0.5) * UNIT * metre
                        u = points[step, reached, f"top_{i}"]
                        self.assertAlmostEqual(-sum(x * a for x, a in zip(u, along)), down, delta=1e-9 * UNIT * metre)
                        self.assertLess(max(abs(u[0] + down * along[0]), abs(u[1] + down * along[1]), abs(u[2])), 1e-9 * UNIT * metre)
        fields = arrays_of(self.directory / "model.results" / "fields_0001.vtu")
        self.assertEqual(set(fields["node_body"]), {1, 2})
        self.assertEqual({row["contact"] for row in rows_of(self.directory / "model.results") if row["step"] == "2"}, {"base", "joint_1"})

    def test_what_a_prop_carried_goes_to_the_others(self):
        """A beam on three props, of which the middle one is struck."""
        props = "".join(f"  {name}: {{material: stone, shape: {{box: {{corner: [{x}, 0, -1], size: [0.5, 1, 1]}}}}, mesh: {{size: 0.5}}{more}}}\n"
                        for name, x, more in (("left", 0, ""), ("middle", 2, ", removed: strike"), ("right", 4.5, "")))
        text = f"""materials: {{stone: {{young: 10e9, poisson: 0.2}}, beam: {{young: 10e9, poisson: 0.2, density: 2500}}}}
bodies:
{props}  beam: {{material: beam, shape: {{box: {{corner: [0, 0, 0], size: [5, 1, 0.5]}}}}, mesh: {{size: 0.5}}}}
supports: [{", ".join(f"{{on: {name}.bottom, fix: [x, y, z]}}" for name in ("left", "middle", "right"))}]
loads: {{weight: {{on: beam, gravity: [0, 0, -10]}}}}
contacts:
""" + "".join(f"  on_{name}: {{between: [{name}.top, beam.bottom], friction: 0.3}}\n" for name in ("left", "middle", "right"))
        increments = self.run_model(text + "steps: [{name: load}, {name: strike, increments: 4}]\n")
        weight = 2500 * 10 * 5 * 0.5
        force = lambda increment, name: increment["contacts"]["on_" + name]["normal_force"][2]
        middle = force(increments[0], "middle")
        self.assertGreater(middle, 0.3 * weight)
        for increment in increments:
            self.assertLessEqual(certificate_of(increment), 1e-10)
            self.assert_energies(increment, 1e-6)
            released = middle * (1.0 - increment["reached"]) if increment["step"] == 2 else 0.0
            self.assertAlmostEqual(sum(force(increment, name) for name in ("left", "middle", "right")), weight - released, delta=1e-9 * weight)
            if increment["step"] == 2:
                self.assertEqual(increment["contacts"]["on_middle"]["normal_force"], [0, 0, 0])
        moments = [increments[-1]["contacts"]["on_" + name]["moment"][1] for name in ("left", "right")]
        self.assertAlmostEqual(-sum(moments), 2.5 * weight, delta=1e-9 * weight)  # about the origin
        # Nothing else is left of the prop: the beam on the two others from the start, which has slipped less.
        alone = self.run_model(text.replace(", removed: strike", ", added: strike, removed: gone")
                               + "steps: [{name: load}, {name: rest, loads: {}}, {name: strike}, {name: gone}]\n", "alone")
        self.assertAlmostEqual(force(alone[0], "left") + force(alone[0], "right"), weight, delta=1e-9 * weight)

    def test_an_extruded_model_between_planes_of_symmetry_is_that_of_the_plane(self):
        """Two lifts on ground, and a pit dug beside them."""
        load = "loads: {weight: {GRAVITY}}\n"
        parts = {"rock": (0, -3, 8, 3, ""), "pit": (5, -2, 3, 2, ", removed: dig"), "lift_1": (1, 0, 3, 1, ", added: first"), "lift_2": (1, 1, 3, 1, ", added: second")}
        steps = "steps: [{name: rest}, {name: first}, {name: second, increments: 2}, {name: dig, increments: 2}]\n"
        corners = {"rock": "[[0, -3], [8, -3], [8, -2], [5, -2], [5, 0], [0, 0]]"}
        names = "names: {bottom: edge_1, right: edge_2, floor: edge_3, wall: edge_4, top: edge_5, left: edge_6}"

        def outline(name):
            x, y, w, h, _ = parts[name]
            return f"polygon: {{vertices: {corners[name]}, {names}}}" if name in corners else f"rectangle: {{corner: [{x}, {y}], size: [{w}, {h}]}}"

        contacts = """contacts:
  floor: {between: [rock.floor, pit.bottom], bond: true}
  wall: {between: [rock.wall, pit.left], bond: true}
  base: {between: [rock.top, lift_1.bottom], friction: 0.6}
  joint: {between: [lift_1.top, lift_2.bottom], friction: 0.6}
"""
        material = "materials: {stone: {young: 1e9, poisson: 0.2, density: 2000}}\n"
        solid = material + "bodies:\n" + "".join(
            f"  {name}: {{material: stone, shape: {{extrude: {{profile: {{{outline(name)}}}, plane: xy, from: 0, to: 0.5}}}}, mesh: {{size: 0.5}}{part[4]}}}\n"
            for name, part in parts.items()) + "supports:\n" + "".join(f"  - {{on: {name}.{side}, fix: z}}\n" for name in parts for side in ("start", "end")) + \
            "  - {on: rock.bottom, fix: [x, y], name: bed}\n" + load.replace("GRAVITY", "gravity: [0, -10, 0]") + contacts + steps + \
            "output: {points: [{at: [2.5, 1, 0.25], body: lift_1, name: first}, {at: [6.5, -2, 0.25], body: rock, name: floor}]}\n"
        plane = "scabo: 1\nanalysis: {plane: strain, thickness: 0.5}\n" + material + "bodies:\n" + "".join(
            f"  {name}: {{material: stone, shape: {{{outline(name)}}}, mesh: {{kind: fem, size: 0.25}}{part[4]}}}\n" for name, part in parts.items()) + \
            "supports: [{on: rock.bottom, fix: [x, y], name: bed}]\n" + load.replace("GRAVITY", "gravity: [0, -10]") + contacts + steps + \
            "output: {points: [{at: [2.5, 1], body: lift_1, name: first}, {at: [6.5, -2], body: rock, name: floor}]}\n"
        (self.directory / "plane.yaml").write_text(plane, encoding="utf-8")
        done = scabo("run", self.directory / "plane.yaml", "--quiet", "-o", self.directory / "plane.results")
        self.assertEqual(done.returncode, 0, done.stderr)
        in_plane = summary_of(self.directory / "plane.results")["increments"]
        in_space = self.run_model(solid)
        lift = 3 * 1 * 0.5 * 2000 * 10.0
        for one, other in zip(in_space, in_plane, strict=True):
            self.assertLessEqual(certificate_of(one), 1e-10)
            self.assertAlmostEqual(one["reactions"]["bed"][1], other["reactions"]["bed"][1], delta=1e-9 * lift)
            for name in ("base", "joint"):
                self.assertAlmostEqual(one["contacts"][name]["normal_force"][1], other["contacts"][name]["normal_force"], delta=1e-9 * lift)
            self.assertAlmostEqual(one["energy"]["elastic"], other["energy"]["elastic"], delta=5e-3 * other["energy"]["elastic"])
            self.assert_energies(one)
        there = {}
        for line in (self.directory / "plane.results" / "points.csv").read_text(encoding="utf-8").splitlines()[1:]:
            row = line.split(",")
            there[int(row[0]), int(row[1]), row[2]] = row
        columns = (self.directory / "plane.results" / "points.csv").read_text(encoding="utf-8").splitlines()[0].split(",")
        largest = max(abs(float(row[columns.index("uy")])) for row in there.values())
        compared = 0
        for key, u in self.points().items():
            row = there[key]
            for k, name in enumerate(("ux", "uy")):
                self.assertAlmostEqual(u[k], float(row[columns.index(name)]), delta=5e-3 * largest)
                compared += 1
        self.assertGreater(compared, 10)

    def test_a_run_that_is_killed_in_its_stages_goes_on(self):
        text, _ = column()
        text = text.replace("increments: 3", "increments: 6").replace("increments: 2", "increments: 4")
        self.run_model(text)
        broken = self.directory / "broken"
        for after in (3, 7, 9, 11):
            process = subprocess.Popen([support.SCABO, "run", self.directory / "model.yaml", "-o", broken, "--quiet"])
            while process.poll() is None and not (broken / f"fields_{after:04d}.vtu").exists():
                time.sleep(0.002)
            process.send_signal(signal.SIGKILL)
            process.wait(timeout=support.PATIENCE)
            if not (broken / "checkpoint.state").exists():
                continue  # it had ended
            done = scabo("resume", broken, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            for name in ("contact.csv", "points.csv", "fields_0014.vtu"):
                self.assertEqual((broken / name).read_bytes(), (self.directory / "model.results" / name).read_bytes(), (after, name))
            self.assertEqual(summary_of(broken)["increments"][-1]["energy"], summary_of(self.directory / "model.results")["increments"][-1]["energy"])

    def test_what_springs_in_a_joint_store_leaves_with_the_body(self):
        """A block on a bed of springs, on another block, in the plane and in space: w^2 / 2 k and the sum of the blocks' w^2 h / E (1 + 1/3 + 1) / 2 and w^2 h / 6 E."""
        common = """loads: {weight: {gravity: DOWN}}
contacts: {base: {between: [floor.top, low.bottom], friction: 0.5}, joint: {between: [low.top, high.bottom], friction: 0.5, modulus: 1e8}}
steps: [{name: on}, {name: off, increments: 2}]
"""
        material = f"materials: {{stuff: {{young: {YOUNG}, poisson: 0, density: {RHO}}}}}\n"
        plane = "scabo: 1\n" + material + """bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [3, 1]}}}
  low: {material: stuff, shape: {rectangle: {corner: [0, 0], size: [1, 0.5]}}, mesh: {kind: fem, size: 0.5}}
  high: {material: stuff, shape: {rectangle: {corner: [0, 0.5], size: [1, 0.5]}}, mesh: {kind: fem, size: 0.5}, removed: off}
supports: [{on: floor, fix: [x, y]}]
""" + common.replace("DOWN", f"[0, {-G}]")
        (self.directory / "plane.yaml").write_text(plane, encoding="utf-8")
        done = scabo("run", "plane.yaml", "--quiet", cwd=self.directory)
        self.assertEqual(done.returncode, 0, done.stderr)
        solid = material + """bodies:
  floor: {rigid: true, shape: {box: {corner: [-1, -1, -1], size: [3, 3, 1]}}, mesh: {size: 1}}
  low: {material: stuff, shape: {box: {corner: [0, 0, 0], size: [1, 1, 0.5]}}, mesh: {size: 0.5}}
  high: {material: stuff, shape: {box: {corner: [0, 0, 0.5], size: [1, 1, 0.5]}}, mesh: {size: 0.5}, removed: off}
supports: [{on: floor, fix: [x, y, z]}]
""" + common.replace("DOWN", f"[0, 0, {-G}]")
        for increments in (summary_of(self.directory / "plane.results")["increments"], self.run_model(solid)):
            for increment in increments:
                self.assert_energies(increment)
        unit = WEIGHT * UNIT
        self.assertAlmostEqual(increments[0]["energy"]["elastic"], WEIGHT**2 / 2e8 + unit * (7 / 6 + 1 / 6), delta=1e-9 * unit)
        self.assertAlmostEqual(increments[-1]["energy"]["elastic"], unit / 6, delta=1e-9 * unit)

    @unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "no Matplotlib")
    def test_pictures_and_pages_have_what_is_there(self):
        text, _ = column()
        self.run_model(text)
        results = self.directory / "model.results"
        draw = lambda *words: scabo(*words, cwd=self.directory, SCABO_PYTHON=sys.executable)
        for words in (("plot", results, "-o", "last.png"), ("plot", results, "--increment", "2", "-o", "second.png")):
            done = draw(*words)
            self.assertEqual(done.returncode, 0, done.stderr)
        if not support.SANITIZED:  # there the page of the report is not built
            done = draw("report", results, "-o", "page.html")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("those with the bodies of the last one", (self.directory / "page.html").read_text(encoding="utf-8"))
        done = draw("plot", results, "--what", "contact", "--contact", "joint_3", "-o", "joint.png")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the bodies of this contact are not there in increment 9", done.stderr)

    def test_a_body_whose_foundation_is_dug_away_is_a_mechanism(self):
        text, _ = column()
        text = text.replace("added: first}", "added: first, removed: down}")
        self.run_model(text, status=2)
        summary = summary_of(self.directory / "model.results")
        for name in ("block_2", "block_3"):
            self.assertIn(f"body '{name}': translation along (-1, 0, 0)", summary["reason"])
        self.assertEqual((summary["mechanism"]["moving"], summary["mechanism"]["present"]), (2, 3))
        self.assertEqual(summary["increments"][-1]["absent"], ["block_1", "block_4"])
        self.assertEqual(set(arrays_of(self.directory / "model.results" / "mechanism.vtu")["body"]) - {0}, {1, 3, 4})

# A bar that hangs and stands between two ends, without lateral strain, under its weight; and a rigid lid beside it on a post.
BAR_WEIGHT, LENGTH, STIFFNESS = RHO * G * 2.0, 2.0, YOUNG / 2.0
PUSH = [300.0, -200.0, -5000.0]  # on the lid, through a corner of it
SUPPORTED = f"""materials: {{stuff: {{young: {YOUNG}, poisson: 0, density: {RHO}}}, post: {{young: {YOUNG}, poisson: 0.2}}}}
bodies:
  bar: {{material: stuff, shape: {{box: {{corner: [0, 0, 0], size: [1, 1, 2]}}}}, mesh: {{size: 0.5}}}}
  post: {{material: post, shape: {{box: {{corner: [3, 0, 0], size: [1, 1, 1]}}}}, mesh: {{size: 0.5}}}}
  lid: {{rigid: true, shape: {{cylinder: {{from: [3.5, 0.5, 1], to: [3.5, 0.5, 1.5], radius: 1}}}}, mesh: {{size: 0.6}}}}
supports:
  - {{on: bar.bottom, fix: [x, y, z], name: foot}}
  - {{on: bar.top, fix: z, name: propREMOVED}}
  - {{on: bar.top, displacement: [null, null, -1e-5], name: jack, added: lift, removed: lower}}
  - {{on: post.bottom, fix: [x, y, z], name: bed}}
  - {{on: lid, fix: [x, y, z], name: hand, removed: strike}}
loads:
  weight: {{on: bar, gravity: [0, 0, {-G}]}}
  push: {{on: lid, force: {PUSH}, at: [4.2, 1.2, 1.5]}}
contacts: {{seat: {{between: [post.top, lid.bottom], bond: true}}}}
steps: [{{name: load, loads: {{weight: 1, push: 1}}}}, {{name: strike, increments: 4}}, {{name: lift, increments: 2, loads: {{jack: 1}}}}, {{name: lower, increments: 2}}]
output: {{points: [{{at: [0.5, 0.5, 2], body: bar, name: top}}, {{at: [3.5, 0.5, 1.5], name: lid, body: lid}}], history: {{prop: prop.reaction_z, hand: hand.moment_x}}}}
"""


class Supports(Running):
    def test_supports_begin_and_end(self):
        increments = self.run_model(SUPPORTED.replace("REMOVED", ", removed: strike"))
        points = self.points()
        moment = [1.2 * PUSH[2] - 1.5 * PUSH[1], 1.5 * PUSH[0] - 4.2 * PUSH[2], 4.2 * PUSH[1] - 1.2 * PUSH[0]]  # about the origin
        free = BAR_WEIGHT / (2.0 * STIFFNESS)
        for increment in increments:
            step, s = increment["step"], increment["reached"]
            self.assertLessEqual(certificate_of(increment), 1e-10)
            self.assert_energies(increment)
            forces, moments = increment["reactions"], increment["moments"]
            top = points[step, increment["increment"], "top"][2]
            left = {1: 1.0, 2: 1.0 - s}.get(step, 0.0)  # of what ends in the second step
            jack = {3: s, 4: 1.0 - s}.get(step, 0.0) * STIFFNESS * 1e-5
            self.assertAlmostEqual(forces["prop"][2], 0.5 * BAR_WEIGHT * left, delta=1e-9 * BAR_WEIGHT)
            self.assertAlmostEqual(forces["jack"][2], -jack, delta=1e-9 * BAR_WEIGHT)
            self.assertAlmostEqual(forces["foot"][2], BAR_WEIGHT * (1.0 - 0.5 * left) + jack, delta=1e-9 * BAR_WEIGHT)
            self.assertAlmostEqual(top, -free * (1.0 - left) - jack / STIFFNESS, delta=1e-9 * free)
            lid = points[step, increment["increment"], "lid"]
            for k in range(3):
                self.assertAlmostEqual(forces["hand"][k], -left * PUSH[k], delta=1e-9 * 5e3)
                self.assertAlmostEqual(forces["bed"][k], -(1.0 - left) * PUSH[k], delta=1e-9 * 5e3)
                self.assertAlmostEqual(moments["hand"][k], -left * moment[k], delta=1e-9 * 3e4)
                self.assertAlmostEqual(moments["bed"][k], -(1.0 - left) * moment[k], delta=1e-9 * 3e4)
            if step == 1:
                self.assertLess(max(map(abs, lid)), 1e-16)
            elif left == 0.0:
                self.assertLess(lid[2], -1e-6)

    def test_a_prop_that_alone_held_is_a_mechanism(self):
        self.run_model(SUPPORTED.replace("REMOVED", ", removed: strike").replace("bond: true", "friction: 0.3"), status=2)
        self.assertIn("body 'lid': rotation about the axis", summary_of(self.directory / "model.results")["reason"])

    def test_a_run_with_such_supports_goes_on(self):
        self.run_model(SUPPORTED.replace("REMOVED", ", removed: strike"))
        broken = self.directory / "broken"
        for after in (2, 3, 5, 7):
            process = subprocess.Popen([support.SCABO, "run", self.directory / "model.yaml", "-o", broken, "--quiet"])
            while process.poll() is None and not (broken / f"fields_{after:04d}.vtu").exists():
                time.sleep(0.002)
            process.send_signal(signal.SIGKILL)
            process.wait(timeout=support.PATIENCE)
            if not (broken / "checkpoint.state").exists():
                continue
            done = scabo("resume", broken, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            for name in ("contact.csv", "points.csv", "history.csv", "fields_0009.vtu"):
                self.assertEqual((broken / name).read_bytes(), (self.directory / "model.results" / name).read_bytes(), (after, name))

    def test_a_support_that_lasts_is_one_that_ends_after_the_run(self):
        """Its points as constraints, and as pairs."""
        for one, other in zip(self.run_model(SUPPORTED.replace("REMOVED", "").replace("- {on: bar.top, displacement: [null, null, -1e-5], name: jack, added: lift, removed: lower}",
                                                                                      "- {on: bar.left, fix: x, name: jack}").replace("loads: {jack: 1}", "loads: {}")),
                              self.run_model(SUPPORTED.replace("REMOVED", ", removed: lower").replace(
                                  "- {on: bar.top, displacement: [null, null, -1e-5], name: jack, added: lift, removed: lower}",
                                  "- {on: bar.left, fix: x, name: jack, removed: lower}").replace("loads: {jack: 1}", "loads: {}"), "other")[:7]):
            for name in ("prop", "jack", "foot"):
                for a, b in zip(one["reactions"][name] + one["moments"][name], other["reactions"][name] + other["moments"][name], strict=True):
                    self.assertAlmostEqual(a, b, delta=1e-9 * BAR_WEIGHT)
            self.assertAlmostEqual(one["energy"]["external"], other["energy"]["external"], delta=1e-9 * one["energy"]["elastic"])


if __name__ == "__main__":
    support.main()
