"""Bodies in space that are added and removed in steps."""
import math
import signal
import subprocess
import time

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


class Stages(support.InTemporaryDirectory):
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


if __name__ == "__main__":
    support.main()
