"""Staged construction, resumed bit by bit, and runs that start where another one ended."""
import csv
import math
import signal
import subprocess
import time

import support
from support import rows_of, scabo, summary_of

COLUMN = """
scabo: 1
materials: {stone: {young: 1e9, poisson: 0.2, density: 2000}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [3, 1]}}}
  block:
    material: stone
    shape: {rectangle: {corner: [0, 0], size: [1, 1]}}
    mesh: {size: 0.25}
    repeat: {count: 3, step: [0, 1]}
    added: [null, second, third]
    removed: [null, null, away]
supports: [{on: floor, fix: [x, y]}]
loads: {weight: {gravity: [0, -10]}, push: {on: block_1.left, traction: [3e3, 0]}}
contacts: {joint: {between: all, friction: 0.3}}
steps:
  - {name: first, increments: 4, loads: {weight: 1}}
  - {name: second, increments: 20}
  - {name: third, increments: auto, loads: {push: 0.5}}
  - {name: away, increments: 20}
output:
  points: [{at: [0.5, 2.5], name: high}, {at: [0.5, 0.5], name: low}]
  history: {top: block_3.top_left.uy, seat: joint_1.normal_force}
"""


def content(directory):
    return {path.name: path.read_bytes() for path in sorted(directory.iterdir())
            if path.name not in ("summary.json", "log.txt")}


class Stages(support.InTemporaryDirectory):
    def setUp(self):
        super().setUp()
        self.model = self.directory / "column.yaml"
        self.model.write_text(COLUMN, encoding="utf-8")

    def test_absent_bodies_are_neither_in_fields_nor_in_tables(self):
        whole = self.directory / "whole"
        run = scabo("run", self.model, "-o", whole, "--quiet")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        increments = summary_of(whole)["increments"]
        self.assertEqual(increments[0]["absent"], ["block_2", "block_3"])
        self.assertEqual(increments[4]["absent"], ["block_3"])
        self.assertEqual(increments[-1]["absent"], ["block_3"])
        rows = [row for row in rows_of(whole) if row["step"] == "1"]
        self.assertEqual({row["contact"] for row in rows}, {increments_contact(increments[0])})
        with open(whole / "points.csv", encoding="utf-8") as file:
            lines = file.read().splitlines()[1:]
        high = {line.split(",")[0] for line in lines if ",high," in line}
        self.assertEqual(high, {"3"})
        with open(whole / "history.csv", encoding="utf-8") as file:
            history = [line.split(",") for line in file.read().splitlines()[1:]]
        for row in history:
            self.assertEqual(row[3] == "", row[0] != "3", row)
        self.assertNotIn(b"nan", (whole / "history.csv").read_bytes())
        self.assertIn(b'NumberOfPoints="', (whole / "fields_0001.vtu").read_bytes())
        self.assertLess((whole / "fields_0001.vtu").stat().st_size, (whole / "fields_0030.vtu").stat().st_size)

    def test_a_run_that_is_interrupted_and_resumed_is_the_unbroken_one(self):
        whole, broken = self.directory / "whole", self.directory / "broken"
        self.assertEqual(scabo("run", self.model, "-o", whole, "--quiet").returncode, 0)
        for after in (2, 10, 30):
            process = subprocess.Popen([support.SCABO, "run", self.model, "-o", broken, "--quiet"],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while process.poll() is None:
                if (broken / f"fields_{after:04d}.vtu").exists():
                    process.send_signal(signal.SIGINT)
                    break
                time.sleep(0.001)
            process.wait(timeout=support.PATIENCE)
            if summary_of(broken)["status"] == "interrupted":
                self.assertEqual(scabo("resume", broken, "--quiet").returncode, 0)
            self.assertEqual(content(broken), content(whole))


def increments_contact(increment):
    """The only contact with pairs."""
    return next(name for name, contact in increment["contacts"].items() if contact["stick"] + contact["slip"] > 0)


class Restart(support.InTemporaryDirectory):
    FIRST = COLUMN.split("steps:")[0].split("    repeat")[0] + COLUMN.split("away]\n")[1].split("steps:")[0].replace(
        "block_1", "block")

    def write(self, name, steps, more=""):
        path = self.directory / name
        path.write_text(self.FIRST + "steps: " + steps + "\n" + more, encoding="utf-8")
        return path

    def test_two_halves_are_one_run(self):
        first, then = "{name: a, loads: {weight: 1, push: 0.2}}", "{name: b, increments: 3, loads: {push: 1}}"
        whole = self.write("whole.yaml", f"[{first}, {then}]")
        self.assertEqual(scabo("run", whole, "--quiet").returncode, 0)
        run = scabo("run", self.write("one.yaml", f"[{first}]"), "--quiet")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        run = scabo("run", self.write("two.yaml", f"[{then}]", "restart: one.results"), "--quiet")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        in_whole = [row for row in rows_of(self.directory / "whole.results") if row["step"] == "2"]
        alone = rows_of(self.directory / "two.results")
        for one, other in zip(in_whole, alone, strict=True):
            for key in set(one) - {"step"}:
                self.assertEqual(one[key], other[key])
        # The end of the second run is the start of a third.
        run = scabo("run", self.write("three.yaml", "[{name: c, loads: {push: 0}}]", "restart: two.results"), "--quiet")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual(summary_of(self.directory / "three.results")["increments"][0]["factors"],
                         {"push": 0.0, "weight": 1.0})

    BOLTED = """
scabo: 1
analysis: {thickness: 0.1}
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [3, 1]}}}
  plate: {material: steel, thickness: 0.08, shape: {rectangle: {corner: [0, 0], size: [1, 0.3]}}, mesh: {size: 0.1}}
  cover: {material: steel, shape: {rectangle: {corner: [0, 0.3], size: [1, 0.3]}}, mesh: {size: 0.1}}
supports: [{on: floor, fix: [x, y]}]
bars:
  hanger: {between: [cover.top_right, [1, 2]], k: 20e6}
  bolt: {between: [cover.top, [0.5, -0.2]], area: 1e-3, young: 210e9, preload: 200e3, tightened: tighten}
  late: {between: [cover.top_left, [0, -0.2]], k: 50e6, preload: 30e3, tightened: late}
loads: {down: {on: cover.top, pressure: 2e5}, push: {on: cover.left, pressure: 4e5}, pull: {on: cover.top, traction: [0, 1e6]}}
contacts:
  seat: {between: [floor.top, plate.bottom], friction: 0.3, modulus: 1e11}
  joint: {between: [plate.top, cover.bottom], friction: 0.2}
output: {history: {bolt: bolt.tension, late: late.tension, hanger: hanger.tension, seat: seat.normal_force, x: cover.top_right.ux}}
"""

    def test_bars_and_beds_go_on(self):
        """A bolt that the other run tightened, in its last step or before, is tightened; one that this run tightens is not yet."""
        steps = ["{name: rest, loads: {down: 1}}", "{name: tighten, increments: 2, loads: {}}", "{name: load, increments: 2, loads: {push: 1}}",
                 "{name: late, loads: {}}", "{name: pull, increments: 2, loads: {pull: 1}}"]

        def run(name, first, last, more=""):
            text = self.BOLTED
            for bar, step in (("tighten", 1), ("late", 3)):
                if not first <= step < last:
                    text = text.replace(f", tightened: {bar}", "")
            if last <= 3:  # the bar of a later step is that of a later model
                text = "".join(line for line in text.splitlines(True) if not line.startswith("  late")).replace("late: late.tension, ", "")
            for load, act in (("push: {on: cover.left, pressure: 4e5}, ", 2), (", pull: {on: cover.top, traction: [0, 1e6]}", 4)):
                if last <= act:  # a load that never acts is refused
                    text = text.replace(load, "")
            path = self.directory / f"{name}.yaml"
            path.write_text(more + text + "steps: [" + ", ".join(steps[first:last]) + "]\n", encoding="utf-8")
            done = scabo("run", path, "--quiet")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            with open(self.directory / f"{name}.results" / "history.csv", encoding="utf-8") as file:
                return list(csv.DictReader(file))

        whole = run("whole", 0, 5)
        for at in (2, 3):
            run("one", 0, at)
            second = run("two", at, 5, "restart: one.results\n")
            for row, other in zip(whole[-len(second):], second, strict=True):
                for key in set(row) - {"step", "time"}:
                    self.assertAlmostEqual(float(other[key]), float(row[key]), delta=1e-9 * abs(float(row[key])), msg=(at, key))
        run("one", 0, 3)
        run("two", 3, 4, "restart: one.results\n")
        third = run("three", 4, 5, "restart: two.results\n")
        for row, other in zip(whole[-2:], third, strict=True):
            for key in set(row) - {"step", "time"}:
                self.assertAlmostEqual(float(other[key]), float(row[key]), delta=1e-9 * abs(float(row[key])), msg=key)
        again = self.directory / "again.yaml"
        again.write_text("restart: two.results\n" + self.BOLTED.replace(", tightened: late", "").replace("tightened: tighten", "tightened: more")
                         + "steps: [{name: more}]\n", encoding="utf-8")
        done = scabo("run", again, "--quiet")
        self.assertEqual(done.returncode, 1)
        self.assertIn("bars.bolt.tightened: bar 'bolt' has been tightened in 'two.results' already: leave 'tightened' out", done.stderr)

    def test_two_halves_of_a_large_body_are_one_run(self):
        """Of 22,000 degrees of freedom: motions without contact come from partial solves, refinement from its need."""
        head = """
scabo: 1
materials: {steel: {young: 210e9, poisson: 0.3, expansion: 1.2e-5}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [3, 1]}}}
  block: {material: steel, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {kind: fem, order: 2, size: 0.0166}}
supports: [{on: floor, fix: [x, y]}, {on: block.left, name: side, displacement: [1e-4, null]}]
loads: {down: {on: block.top, pressure: 1e8}, push: {on: block.top, traction: [2e7, 0]}, warm: {on: block, temperature: 5}}
contacts: {joint: {between: [floor.top, block.bottom], friction: 0.3}}
output: {fields: []}
"""
        first = "{name: a, loads: {down: 1, push: 0.2, warm: 0.7, side: 1}}"
        then = "{name: b, increments: 2, loads: {push: 1, warm: 0.1, side: 0.3}}"

        def run(name, steps, more=""):
            path = self.directory / name
            path.write_text(head + "steps: " + steps + "\n" + more, encoding="utf-8")
            done = scabo("run", path, "--quiet")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            return path.with_suffix(".results")

        whole = run("whole.yaml", f"[{first}, {then}]")
        run("one.yaml", f"[{first}]")
        alone = rows_of(run("two.yaml", f"[{then}]", "restart: one.results"))
        in_whole = [row for row in rows_of(whole) if row["step"] == "2"]
        self.assertGreater(summary_of(whole)["model"]["dofs"], 20000)
        for one, other in zip(in_whole, alone, strict=True):
            for key in set(one) - {"step"}:
                self.assertEqual(one[key], other[key])

    def test_pairs_that_supports_hold_count_from_their_placing(self):
        """The ground was 2 mm up when the block was placed on it: 1 mm less is no overlap, 1 mm more is one of 1 mm."""
        text = """
scabo: 1
materials: {stuff: {young: 1e9, poisson: 0.2, density: 2000}}
bodies:
  ground: {material: stuff, shape: {rectangle: {corner: [0, -1], size: [1, 1]}}, mesh: {size: 0.5}}
  block: {material: stuff, shape: {rectangle: {corner: [0, 0], size: [1, 0.5]}}, mesh: {size: 0.5}%s}
supports: [{on: ground.top, displacement: [0, 2e-3], name: lift}, {on: block.bottom, fix: [x, y]}]
loads: {weight: {gravity: [0, -10]}}
contacts: {seat: {between: [ground.top, block.bottom], friction: 0.5}}
steps: %s
"""
        (self.directory / "one.yaml").write_text(text % (", added: place", "[{name: raise}, {name: place}]"), encoding="utf-8")
        done = scabo("run", self.directory / "one.yaml", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for lift, status in ((0.5, 0), (1.5, 1)):
            two = self.directory / "two.yaml"
            two.write_text("restart: one.results" + text % ("", f"[{{name: more, loads: {{lift: {lift}}}}}]"), encoding="utf-8")
            done = scabo("run", two, "--quiet")
            self.assertEqual(done.returncode, status, done.stderr)
            if status:
                self.assertIn("keep it at an overlap of 0.001, which no contact force can remove", done.stderr)

    def test_bodies_placed_on_unbounded_ground_count_from_their_placing(self):
        """What the reference point of the ground had moved before is no displacement of the plug, after a restart either."""
        text = """
scabo: 1
materials: {rock: {young: 2e9, poisson: 0.25}}
bodies:
  ground: {material: rock, outside: true, shape: {rectangle: {corner: [-1, -1], size: [2, 2]}}, mesh: {size: 0.5}, reference: [5, -20]}
  plug: {material: rock, shape: {rectangle: {corner: [-1, -1], size: [2, 2]}}, mesh: {size: 0.5}%s}
contacts: {base: {between: [ground.bottom, plug.bottom], friction: 0.5}}
loads: {push: {on: ground.left, traction: [1e6, 2e5]}, weight: {on: plug, body_force: [0, -1e5]}}
steps: %s
"""
        first, then = "{name: push, loads: {push: 1}}, {name: place, loads: {weight: 0.5}}", "{name: more, loads: {weight: 1}}"
        for name, added, steps, more in (("whole", ", added: place", f"[{first}, {then}]", ""), ("one", ", added: place", f"[{first}]", ""),
                                         ("two", "", f"[{then}]", "restart: one.results")):
            model = self.directory / f"{name}.yaml"
            model.write_text(more + text % (added, steps), encoding="utf-8")
            done = scabo("run", model, "--quiet")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        whole = [row for row in rows_of(self.directory / "whole.results") if row["step"] == "3"]
        for one, other in zip(whole, rows_of(self.directory / "two.results"), strict=True):
            for key in set(one) - {"step"}:
                self.assertEqual(one[key], other[key], key)

    def test_joints_of_the_second_half_that_open_lose_their_strength(self):
        """A pair that opens by a thousandth of the motions, and is at its strength within the tolerance only, does not keep it."""
        law = "friction: 0.3, cohesion: 1e4, tension: 1e3"
        added = {1: ", added: second", 2: ", added: third"}

        def wall(courses, placed, steps, more):
            bodies, contacts = "", ""
            for z in range(courses):
                for x in range(3):
                    bodies += (f"  b{x}{z}: {{material: stone, mesh: {{size: 0.25}}{'' if z in placed else added.get(z, '')}, "
                               f"shape: {{rectangle: {{corner: [{x}, {0.5 * z}], size: [1, 0.5]}}}}}}\n")
                    below = f"b{x}{z - 1}" if z else "floor"
                    contacts += f"  v{x}{z}: {{between: [{below}.top, b{x}{z}.bottom], {law}}}\n"
                    if x:
                        contacts += f"  h{x}{z}: {{between: [b{x - 1}{z}.right, b{x}{z}.left], {law}}}\n"
            push = "push: {on: b12.top, force: [2e3, -1e4]}" if courses == 3 else ""
            return ("scabo: 1\nanalysis: {plane: strain}\nmaterials: {stone: {young: 3e9, poisson: 0.15, density: 2500}}\n"
                    "bodies:\n  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [6, 1]}}}\n" + bodies +
                    "supports: [{on: floor, fix: [x, y]}]\n"
                    f"loads: {{weight: {{gravity: [0, -9.81]}}, {push}}}\ncontacts:\n{contacts}steps: [{steps}]\n{more}")

        spring = "springs: [{on: b12.top, k_n: 1e7, k_t: 1e6, at_rest: [1e-5, 1e-5], name: pulled}]\n"
        first = "{name: first, loads: {weight: 1}}, {name: second, increments: 2, loads: {}}"
        then = "{name: idle, loads: {}}, {name: third, increments: 2, loads: {push: 1, pulled: 1}}"
        for name, text in (("whole", wall(3, (), f"{first}, {then}", spring)), ("one", wall(2, (), first, "")),
                           ("two", wall(3, (1,), then, spring + "restart: one.results"))):
            model = self.directory / f"{name}.yaml"
            model.write_text(text, encoding="utf-8")
            done = scabo("run", model, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
        whole = [row for row in rows_of(self.directory / "whole.results") if row["step"] in ("3", "4")]
        two = rows_of(self.directory / "two.results")
        for one, other in zip(whole, two, strict=True):
            self.assertAlmostEqual(float(one["normal_force"]), float(other["normal_force"]), delta=1e-6)
            self.assertAlmostEqual(float(one["tangential_force"]), float(other["tangential_force"]), delta=1e-6)
        for row in whole + two:
            if float(row["gap"]) > 1e-12:
                self.assertEqual((row["state"], float(row["normal_force"])), ("open", 0.0))

    def test_bodies_are_taken_away_after_a_step_in_which_nothing_changes(self):
        text = """scabo: 1
materials: {stone: {young: 1e9, poisson: 0.2, density: 2000}}
bodies:
  low: {material: stone, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.25}}
  high: {material: stone, shape: {rectangle: {corner: [0.5, 1], size: [1, 1]}}, mesh: {size: 0.25}%s}
supports: [{on: low.bottom, fix: [x, y]}]
loads: {weight: {gravity: [0, -10]}, push: {on: high.left, traction: [5e3, 0]}}
contacts: {joint: {between: [low.top, high.bottom], friction: 0.4}}
output: {history: {top: low.top_left.uy, energy: friction_energy}}
steps: %s
"""
        first, away = "{name: first, increments: 2}", "{name: away, increments: 4}"
        for name, removed, steps, more in (("whole", ", removed: away", f"[{first}, {away}]", ""), ("one", "", f"[{first}]", ""),
                                           ("two", ", removed: away", "[{name: rest, loads: {}}, %s]" % away, "restart: one.results\n")):
            model = self.directory / f"{name}.yaml"
            model.write_text(more + text % (removed, steps), encoding="utf-8")
            run = scabo("run", model, "--quiet")
            self.assertEqual(run.returncode, 0, run.stderr)
        rows = {name: (self.directory / f"{name}.results" / "history.csv").read_text(encoding="utf-8").splitlines()
                for name in ("whole", "two")}
        for one, other in zip(rows["whole"][-4:], rows["two"][-4:], strict=True):
            for expected, value in zip(one.split(",")[3:], other.split(",")[3:], strict=True):
                self.assertAlmostEqual(float(value), float(expected), delta=1e-9 * abs(float(expected)))
        model.write_text("restart: one.results\n" + text % (", removed: away", f"[{away}]"), encoding="utf-8")
        run = scabo("check", model)
        self.assertEqual(run.returncode, 1)
        self.assertIn("bodies.high.removed: is the first step of a restart, which begins with what is there at the other run's end: "
                      "put a step before it in which nothing changes, as {name: rest, loads: {}}", run.stderr)

    def test_its_own_directory_and_runs_without_an_end_are_refused(self):
        one = self.write("one.yaml", "[{name: a, loads: {weight: 1, push: 0.2}}]")
        self.assertEqual(scabo("run", one, "--quiet").returncode, 0)
        two = self.write("two.yaml", "[{name: b, loads: {push: 1}}]", "restart: one.results")
        run = scabo("run", two, "-o", self.directory / "one.results")
        self.assertEqual(run.returncode, 1)
        self.assertIn("is also the directory that this run writes to", run.stderr)
        self.assertTrue((self.directory / "one.results" / "end.state").exists())
        (self.directory / "one.results" / "end.state").unlink()
        run = scabo("check", two)
        self.assertEqual(run.returncode, 1)
        self.assertIn("has no state at its end to start from", run.stderr)


def history_of(directory):
    with open(directory / "history.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class RestartInTime(support.InTemporaryDirectory):
    """A run in time and the same in two halves, the second of which starts in motion."""
    AXLE = ", axle: {on: rock.top, force: [0, -1e3], moving: {velocity: -10, from: 4}}"
    BLOCK = """
scabo: 1
analysis: {plane: strain}
materials: {stone: {young: 2e9, poisson: 0.2, density: 2400, damping: {ratio: 0.05, between: [20, 200]}}}
bodies:
  rock: {material: stone, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}, mesh: {kind: fem, size: 0.5}}
  block: {material: stone, shape: {rectangle: {corner: [0, 0], size: [2, 1.5]}}, mesh: {kind: fem, size: 0.5}}
  stone: {rigid: true, density: 2500, shape: {rectangle: {corner: [2.25, 0], size: [0.5, 0.5]}}}
supports: [{on: rock.bottom, fix: [x, y]}]
loads: {weight: {gravity: [0, -9.81]}AXLE}
contacts: {base: {between: [rock.top, block.bottom], friction: 0.4}, seat: {between: [rock.top, stone.bottom], friction: 0.3}}
solver: {halvings: 1}
output: {history: {tip: block.top_left.ux, speed: block.top_left.vx, ground: ground_velocity_x, heat: friction_energy, work: external_energy}}
""".replace("AXLE", AXLE)
    BAR = """
scabo: 1
analysis: {type: dynamic, plane: stress}
materials: {bar: {young: 900, poisson: 0, density: 1}}
bodies:
  wall: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [1, 3]}}}
  bar: {material: bar, shape: {rectangle: {corner: [5, 0], size: [10, 1]}}, mesh: {kind: fem, size: 0.5, order: 1}}
supports: [{on: wall, fix: [x, y]}]
contacts: {hit: {between: [wall.right, bar.left], friction: 0}}
output: {history: {tip: bar.top_left.ux, force: hit.normal_force, kinetic: kinetic_energy}}
"""

    def run_model(self, name, text):
        model = self.directory / f"{name}.yaml"
        model.write_text(text, encoding="utf-8")
        done = scabo("run", model, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return history_of(model.with_suffix(".results"))

    def test_two_halves_of_a_shaken_block_are_one_run(self):
        lines = [f"{0.01 * i:.2f},{8 * math.sin(25 * 0.01 * i):.6f}" for i in range(31)]
        (self.directory / "quake.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
        rest = "{name: rest, loads: {weight: 1}}"

        def steps(duration, begin, before=""):
            return (f"curves: {{quake: {{record: {{file: quake.csv, unit: m/s2, from: {begin}}}}}}}\n"
                    f"steps: [{before}{{name: shake, dynamic: {{duration: {duration}, step: 1e-3, ground: {{x: quake}}}}, "
                    f"loads: {{axle: 1}}, increments: {round(100 * duration)}}}]\n")

        whole = self.run_model("whole", self.BLOCK + steps(0.2, 0, rest + ", "))[1:]
        one = self.run_model("one", self.BLOCK + steps(0.12, 0, rest + ", "))[1:]
        two = self.run_model("two", self.BLOCK + steps(0.08, 0.12) + "restart: one.results\n")
        self.assertGreater(float(whole[-1]["heat"]), 10)
        for expected, row in zip(whole, one + two, strict=True):
            for key in ("time", "tip", "speed", "ground", "heat", "work"):
                self.assertAlmostEqual(float(row[key]), float(expected[key]), delta=1e-8 * max(map(abs, (float(r[key]) for r in whole))))
        # From a run at rest the same begins with its first step in time.
        self.run_model("rest", self.BLOCK.replace(self.AXLE, "").split("output")[0] + f"steps: [{rest}]\noutput: {{history: {{heat: friction_energy}}}}\n")
        other = self.run_model("other", self.BLOCK + steps(0.12, 0) + "restart: rest.results\n")
        for expected, row in zip(one, other, strict=True):
            for key in ("time", "tip", "speed", "ground", "heat", "work"):
                self.assertEqual(row[key], expected[key])

    def test_two_halves_of_a_bar_that_hits_a_wall_are_one_run_bit_by_bit(self):
        initial = "initial: [{on: bar, velocity: [-10, 0]}]\n"
        one, two = ("{dynamic: {duration: %s, step: 5e-3}, increments: %s}" % of for of in ((0.8, 16), (0.6, 12)))
        whole = self.run_model("whole", self.BAR + initial + f"steps: [{one}, {two}]\n")
        halves = self.run_model("one", self.BAR + initial + f"steps: [{one}]\n")
        halves += self.run_model("two", self.BAR + f"steps: [{two}]\nrestart: one.results\n")
        self.assertGreater(float(whole[15]["force"]), 250)
        for expected, row in zip(whole, halves, strict=True):
            for key in ("time", "tip", "force", "kinetic"):
                self.assertEqual(row[key], expected[key])

    def test_what_does_not_go_on_in_motion_is_refused(self):
        self.run_model("one", self.BAR + "initial: [{on: bar, velocity: [-10, 0]}]\nsteps: [{dynamic: {duration: 0.1}, increments: 1}]\n")
        for text, message in (
                (self.BAR.replace("type: dynamic, ", "").split("output")[0] + "steps: [{name: press}]\n",
                 "steps.0: is quasi-static, but the run that this one starts from ended in motion: make it a step in time, "
                 "'dynamic: {duration: ...}'"),
                (self.BAR + "initial: [{on: bar, velocity: [1, 0]}]\nsteps: [{dynamic: {duration: 0.1}}]\n",
                 "initial.0: has no effect: bodies go on with the velocities at the end of the run that this one starts from")):
            (self.directory / "two.yaml").write_text(text + "restart: one.results\n", encoding="utf-8")
            run = scabo("check", self.directory / "two.yaml")
            self.assertEqual(run.returncode, 1)
            self.assertIn(message, run.stderr)
        text = self.BAR.replace("density: 1}", "density: 2}") + "steps: [{dynamic: {duration: 0.1}}]\nrestart: one.results\n"
        (self.directory / "two.yaml").write_text(text, encoding="utf-8")
        run = scabo("run", self.directory / "two.yaml", "--quiet")
        self.assertEqual(run.returncode, 1)
        self.assertIn("body 'bar' is not the same as in", run.stderr)


if __name__ == "__main__":
    support.main()
