"""A run that is killed at any moment and resumed gives the files of an unbroken run, bit by bit."""
import csv
import io
import json
import math
import os
import pathlib
import random
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import support
from support import SANITIZED, scabo, summary_of

KILLS = int(os.environ.get("SCABO_KILLS", "2" if SANITIZED else "8"))  # benchmarks/README.md: 50
SEED = int(os.environ.get("SCABO_SEED", "1"))

MODEL = """
scabo: 1
title: Cycles of shear on two pressed blocks
analysis: {plane: strain}
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies:
  upper:
    material: steel
    shape: {rectangle: {corner: [0, 1e-2], size: [4e-2, 1e-2]}}
    mesh: {size: 2e-3}
  lower:
    material: steel
    shape: {rectangle: {corner: [-1e-2, 0], size: [6e-2, 1e-2]}}
    mesh: {kind: quadtree, size: 5e-3}
supports: [{on: lower.bottom, fix: [x, y]}]
loads:
  down: {on: upper.top, pressure: 100e6}
  push: {on: upper.left, traction: [60e6, 0]}
contacts: {joint: {between: [lower.top, upper.bottom], friction: {static: 0.5, dynamic: 0.4, slip_distance: 1e-5}}}
steps:
  - {name: press, increments: 4, loads: {down: 1}}
  - {name: push, increments: auto, loads: {push: 1}}
  - {name: pull, increments: {largest: 0.02}, loads: {push: -1}}
  - {name: again, increments: LONG, loads: {push: 1}}
  - {name: back, increments: LONG, loads: {push: 0}}
  - {name: waves, increments: 20, cycles: 2, loads: {push: wave}}
curves: {wave: {sine: {amplitude: 0.9, periods: 2}}}
output:
  points: [[1e-2, 1.5e-2]]
  every: 3
  discrete_problems: true
  history: {tip: upper.top_left.ux, shear: joint.tangential_force, centre: joint.centre_x, work: friction_energy,
            sliding: joint.slip, first: joint.first_pair_in_contact,
            cut: {section: {from: [0, 1.4e-2], to: [4e-2, 1.4e-2]}}}
""".replace("LONG", "20" if SANITIZED else "80")


IN_TIME = """
scabo: 1
title: A block on rock that the ground shakes
analysis: {plane: strain}
materials: {stone: {young: 2e9, poisson: 0.2, density: 2400, damping: {ratio: 0.05, between: [20, 200]}}}
bodies:
  rock: {material: stone, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}, mesh: {kind: fem, size: 0.25}}
  block: {material: stone, shape: {rectangle: {corner: [0, 0], size: [2, 1.5]}}, mesh: {kind: fem, size: 0.25}}
supports: [{on: rock.bottom, fix: [x, y]}]
loads: {weight: {gravity: [0, -9.81], on: block}}
contacts: {base: {between: [rock.top, block.bottom], friction: 0.4}}
curves: {quake: {sine: {amplitude: 8, periods: 4}}}
steps:
  - {name: rest}
  - {name: shake, dynamic: {duration: DURATION, step: 1e-3, ground: {x: quake}}, increments: LONG}
output: {every: 10, history: {tip: block.top_left.ux, kinetic: kinetic_energy}}
""".replace("LONG", "20" if SANITIZED else "100").replace("DURATION", "0.06" if SANITIZED else "0.5")

BOLTED = """
scabo: 1
title: A block with a bolt that is tightened, and then pulled again and again
materials: {stuff: {young: 70e9, poisson: 0.3}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-0.5, -0.1], size: [1, 0.1]}}}
  block: {material: stuff, shape: {rectangle: {corner: [-0.1, 0], size: [0.2, 0.3]}}, mesh: {kind: fem, size: 0.025}}
supports: [{on: floor, fix: [x, y]}]
bars: {bolt: {between: [block.top, [0, -0.15]], area: 8e-3, young: 210e9, preload: 1.5e6, tightened: tighten}}
loads: {weight: {on: block.top, force: [0, -1e4]}, pull: {on: block.right, force: [2e5, 4e5]}}
contacts: {joint: {between: [floor.top, block.bottom], friction: 0.3, modulus: 1e12}}
steps:
  - {name: weight, loads: {weight: 1, pull: 0}}
  - {name: tighten, increments: 4}
  - {name: pull, increments: LONG, loads: {pull: 1}}
output: {every: 10, history: {bolt: bolt.tension}}
""".replace("LONG", "20" if SANITIZED else "200")

STEPS_OF_GROWTH = 5 if SANITIZED else 12
GROWTH = """
scabo: 1
title: A crack that grows in a plate, after its weight
analysis: {plane: strain}
materials: {stone: {young: 30e9, poisson: 0.2, density: 2400}}
bodies:
  plate:
    material: stone
    shape: {rectangle: {corner: [0, 0], size: [1, 2]}}
    mesh: {kind: quadtree, size: 0.125}
    cracks: [{path: [[0, 0.8], [0.25, 1]], name: flaw}]
supports: [{on: plate.bottom, fix: [x, y]}]
loads: {pull: {on: plate.top, traction: [0, 1e6]}, weight: {on: plate, gravity: [0, -9.81]}}
steps:
  - {name: weight, loads: {weight: 1}, increments: 2}
  - {name: grow, loads: {pull: 1}, growth: {LAW, step: 0.04, until: {steps: COUNT}}}
output: {every: 3, history: {tip: plate.top_left.uy}, points: [[0.5, 1.5]]}
""".replace("COUNT", str(STEPS_OF_GROWTH))


def content(directory):
    """All files by name; of summary.json and log.txt what does not depend on the machine's speed."""
    files = {}
    for path in sorted(pathlib.Path(directory).rglob("*")):
        if path.is_dir():
            continue
        name, data = str(path.relative_to(directory)), path.read_bytes()
        if name == "summary.json":
            summary = json.loads(data)
            summary["timing"] = summary["peak_memory_bytes"] = None
            data = json.dumps(summary).encode()
        if name == "log.txt":
            data = data.split(b"\n  stage ")[0]
        files[name] = data
    return files


class Resume(unittest.TestCase):
    whole = None

    def setUp(self):
        # In memory, where waiting for the disk takes no time, nearly every increment has a checkpoint.
        memory = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
        holder = tempfile.TemporaryDirectory(prefix="scabo_test_", dir=memory)
        self.addCleanup(holder.cleanup)
        self.directory = pathlib.Path(holder.name)
        self.model = self.directory / "model.yaml"
        self.model.write_text(MODEL, encoding="utf-8")
        self.results = self.directory / "model.results"

    def start(self, *words):
        return subprocess.Popen([support.SCABO, *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                stdin=subprocess.DEVNULL)

    def unbroken(self):
        """The files of a run without interruption, and its seconds; one run for all tests."""
        if not Resume.whole:
            begun = time.monotonic()
            run = scabo("run", self.model, "-o", self.directory / "whole", "--quiet")
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            Resume.whole = content(self.directory / "whole"), time.monotonic() - begun, str(self.model)
        files, seconds, model = Resume.whole
        return {**files, "log.txt": files["log.txt"].replace(model.encode(), str(self.model).encode())}, seconds

    def assert_same(self, whole):
        self.assertFalse(list(self.results.glob("checkpoint*")), "a finished run leaves no checkpoint")
        resumed = content(self.results)
        self.assertEqual(sorted(resumed), sorted(whole))
        for name, data in whole.items():
            self.assertEqual(resumed[name], data, name)

    def killed(self, after_checkpoints=1):
        """A run that was killed once it had written some checkpoints; whether it was still running."""
        process = self.start("run", self.model, "--quiet")
        seen, last = 0, None
        while process.poll() is None and seen < after_checkpoints + 1:
            try:
                now = (self.results / "checkpoint.state").stat().st_mtime_ns
            except FileNotFoundError:
                now = None
            seen += now is not None and now != last
            last = now or last
            time.sleep(0.001)
        process.kill()
        return process.wait() == -signal.SIGKILL

    def test_killed_at_random_moments(self):
        whole, seconds = self.unbroken()
        random.seed(SEED)
        kills, rounds = 0, 0
        while kills < KILLS and rounds < 20 * KILLS:
            rounds += 1
            shutil.rmtree(self.results, ignore_errors=True)
            process = self.start("run", self.model, "--quiet")
            while True:
                time.sleep(random.uniform(0, 0.7) * seconds)
                process.kill()
                if process.wait() != -signal.SIGKILL:
                    break
                kills += 1
                for file in self.results.glob("*.vtu"):
                    self.assertTrue(file.read_bytes().endswith(b"</VTKFile>\n"), file.name)
                if not (self.results / "checkpoint.state").exists():  # killed before it began
                    process = self.start("run", self.model, "--quiet")
                elif kills >= KILLS or random.random() < 0.5:
                    run = scabo("resume", self.results, "--quiet")
                    self.assertEqual((run.returncode, run.stderr), (0, ""))
                    break
                else:
                    process = self.start("resume", self.results, "--quiet")
            self.assert_same(whole)
        self.assertGreaterEqual(kills, KILLS)

    def test_killed_between_time_steps(self):
        self.model.write_text(IN_TIME, encoding="utf-8")
        run = scabo("run", self.model, "-o", self.directory / "whole", "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue(self.killed(after_checkpoints=5))
        run = scabo("resume", self.results, "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assert_same(content(self.directory / "whole"))

    def test_killed_with_a_bolt_that_was_tightened(self):
        self.model.write_text(BOLTED, encoding="utf-8")
        run = scabo("run", self.model, "-o", self.directory / "whole", "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        whole = content(self.directory / "whole")
        for checkpoints in (1, 4, 8):
            if self.killed(checkpoints):
                self.assertEqual(scabo("resume", self.results, "--quiet").returncode, 0)
            self.assert_same(whole)
            shutil.rmtree(self.results)

    def test_killed_while_cracks_grow(self):
        for law in ("law: paris, C: 1e-29, m: 3, between: [{pull: 0.1}, {pull: 1}]", "toughness: {K_Ic: 1e6}")[:1 if SANITIZED else 2]:
            with self.subTest(law=law):
                self.model.write_text(GROWTH.replace("LAW", law), encoding="utf-8")
                run = scabo("run", self.model, "-o", self.directory / "whole", "--quiet")
                self.assertEqual(run.returncode, 0, run.stderr)
                whole = content(self.directory / "whole")
                self.assertEqual(whole["cracks.csv"].count(b"\n"), STEPS_OF_GROWTH + 2)
                for checkpoints in ((2,) if SANITIZED else (4, 1, 8)):
                    shutil.rmtree(self.results, ignore_errors=True)
                    self.assertTrue(self.killed(after_checkpoints=checkpoints), "the run was too fast")
                    run = scabo("resume", self.results, "--quiet")
                    self.assertEqual(run.returncode, 0, run.stderr)
                    self.assert_same(whole)

    def test_killed_while_a_crack_grows_through_polygons(self):
        """Whose mesh keeps what it can of the one before, so that all of them are made again."""
        self.model.write_text(GROWTH.replace("quadtree", "polygons").replace("LAW", "toughness: {K_Ic: 1e6}"), encoding="utf-8")
        run = scabo("run", self.model, "-o", self.directory / "whole", "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        whole = content(self.directory / "whole")
        for checkpoints in ((4,) if SANITIZED else (4, 9)):  # two of them of increments before growth
            shutil.rmtree(self.results, ignore_errors=True)
            self.assertTrue(self.killed(after_checkpoints=checkpoints), "the run was too fast")
            run = scabo("resume", self.results, "--quiet")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assert_same(whole)

    def test_killed_while_a_crack_grows_in_a_large_body(self):
        """Whose states are solved by the factor of an earlier one: of 21, those of the first and of the seventeenth."""
        large = GROWTH.replace("size: 0.125", "size: 0.0125, order: 1").replace(
            f"step: 0.04, until: {{steps: {STEPS_OF_GROWTH}}}", "step: 0.022, until: {steps: 20}").replace("every: 3", "fields: []")
        self.model.write_text(large.replace("LAW", "toughness: {K_Ic: 1e6}"), encoding="utf-8")
        run = scabo("run", self.model, "-o", self.directory / "whole", "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        whole = content(self.directory / "whole")
        rows = list(csv.DictReader(io.StringIO(whole["cracks.csv"].decode())))
        self.assertEqual(len(rows), 21)
        for row in rows:
            K_I, K_II, a = (float(row[name]) for name in ("K_I", "K_II", "kink"))
            self.assertAlmostEqual(math.cos(a / 2) * (K_I * math.cos(a / 2)**2 - 1.5 * K_II * math.sin(a)), 1e6, delta=1e-3)
        for checkpoints in (6, 20):  # two of them of increments before growth
            shutil.rmtree(self.results, ignore_errors=True)
            self.assertTrue(self.killed(after_checkpoints=checkpoints), "the run was too fast")
            run = scabo("resume", self.results, "--quiet")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assert_same(whole)

    def test_killed_while_a_closed_crack_grows(self):
        closed = GROWTH.replace(f"steps: {STEPS_OF_GROWTH}", "steps: 2").replace("traction: [0, 1e6]", "traction: [3e5, -1e6]").replace(
            "supports:", "contacts: {faces: {between: [plate.flaw.left, plate.flaw.right], friction: 0.2}}\nsupports:")
        self.model.write_text(closed.replace("LAW", "toughness: {K_Ic: 1e6}"), encoding="utf-8")
        run = scabo("run", self.model, "-o", self.directory / "whole", "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        whole = content(self.directory / "whole")
        for checkpoints in (2, 1)[:1 if SANITIZED else 2]:  # of four, two of them of increments before growth
            shutil.rmtree(self.results, ignore_errors=True)
            self.assertTrue(self.killed(after_checkpoints=checkpoints), "the run was too fast")
            run = scabo("resume", self.results, "--quiet")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assert_same(whole)

    def test_killed_under_cycles_in_contact_and_where_one_crack_has_ended(self):
        growing = GROWTH.replace(f"steps: {STEPS_OF_GROWTH}", "steps: 4").replace("fix: [x, y]}", "fix: y}, {on: plate.bottom_left, fix: x}")
        cycled = growing.replace("[[0, 0.8], [0.25, 1]]", "[[0, 1], [0.3, 1]]").replace(
            "supports:", "contacts: {faces: {between: [plate.flaw.left, plate.flaw.right], friction: 0.2}}\nsupports:").replace(
            "LAW", "law: paris, C: 1e-29, m: 3, between: [{pull: -0.5}, {pull: 1}]")
        ended = growing.replace("[{path: [[0, 0.8], [0.25, 1]], name: flaw}]", "[{path: [[0, 1], [0.35, 1]], name: flaw}, {path: [[1, 1], [0.85, 1]], "
                                "name: other}]\n    holes: {bore: {circle: {centre: [0.55, 1], radius: 0.1}}}").replace(
            "fix: x}]", "fix: x}, {on: plate.top, displacement: [null, 1e-4], name: up}]").replace("loads: {pull: 1}", "loads: {up: 1}").replace(
            "LAW", "toughness: {K_Ic: 1e6}").replace("{steps: 4}", "{steps: 4, break: true}").replace("pull: {on: plate.top, traction: [0, 1e6]}, ", "")
        for model in (cycled, ended):
            self.model.write_text(model, encoding="utf-8")
            run = scabo("run", self.model, "-o", self.directory / "whole", "--quiet")
            self.assertEqual(run.returncode, 0, run.stderr)
            whole = content(self.directory / "whole")
            for checkpoints in (4,) if SANITIZED else (4, 3, 2):  # two of them of increments before growth
                shutil.rmtree(self.results, ignore_errors=True)
                self.assertTrue(self.killed(after_checkpoints=checkpoints), "the run was too fast")
                run = scabo("resume", self.results, "--quiet")
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assert_same(whole)
        self.assertIn(b'"meets"', whole["summary.json"])

    def test_half_written_files_are_cut_off(self):
        whole, _ = self.unbroken()
        self.assertTrue(self.killed(), "the run was too fast")
        for name in ("contact.csv", "convergence.csv", "points.csv", "log.txt", "fields.pvd", "contact.pvd",
                     "checkpoint.increments"):
            with open(self.results / name, "ab") as file:
                file.write(b"half a li")
        for name in ("fields_9999.vtu", "contact_9999.vtu", "fields_9999.vtu.part", "checkpoint.state.new"):
            (self.results / name).write_bytes(b"<half")
        run = scabo("resume", self.results)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("Resuming after", run.stderr)
        self.assert_same(whole)

    def test_interrupted_run_goes_on(self):
        whole, seconds = self.unbroken()
        process = self.start("run", self.model, "--quiet")
        time.sleep(0.4 * seconds)
        process.send_signal(signal.SIGINT)
        if process.wait() == 130 and summary_of(self.results)["status"] == "interrupted":
            self.assertEqual(scabo("resume", self.results, "--quiet").returncode, 0)
        self.assert_same(whole) if summary_of(self.results)["status"] == "solved" else self.fail("not resumed")

    def test_moved_together_with_the_model(self):
        whole, _ = self.unbroken()
        self.assertTrue(self.killed(), "the run was too fast")
        moved = self.directory / "moved"
        moved.mkdir()
        self.model.rename(moved / "model.yaml")
        self.results = self.results.rename(moved / "model.results")
        run = scabo("resume", self.results, "--quiet")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assert_same(whole)

    def refused(self, sentence, *words):
        before = content(self.results) if self.results.is_dir() else None
        run = scabo("resume", *(words or [self.results]))
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertIn(sentence, run.stderr)
        if before is not None:
            self.assertEqual(content(self.results), before, "nothing is changed")

    def test_what_cannot_be_resumed(self):
        self.refused("there is no such directory")
        self.results.mkdir()
        self.refused("holds no results of Scabo")
        self.assertTrue(self.killed(), "the run was too fast")
        checkpoint = self.results / "checkpoint.state"
        good = checkpoint.read_bytes()

        self.model.write_text(MODEL + "# a remark\n", encoding="utf-8")
        self.refused("model.yaml: has changed since the run began")
        self.model.unlink()
        self.refused("the model file of the run is no longer there")
        elsewhere = self.directory / "elsewhere.yaml"
        elsewhere.write_text(MODEL + "# a remark\n", encoding="utf-8")
        self.refused("elsewhere.yaml: has changed", self.results, "--model", elsewhere)
        self.model.write_text(MODEL, encoding="utf-8")

        text = good.index(summary_of(self.results)["scabo"].encode())
        checkpoint.write_bytes(good[:text] + b"9" + good[text + 1:])
        self.refused("was written by Scabo 9")
        random.seed(SEED)
        for _ in range(10):
            at = random.randrange(len(good))
            checkpoint.write_bytes(good[:at])
            self.refused("the checkpoint is damaged")
        records = self.results / "checkpoint.increments"
        checkpoint.write_bytes(good)
        kept = records.read_bytes()
        for at in (3, 40, len(kept) // 2):
            records.write_bytes(kept[:at] + bytes([kept[at] ^ 1]) + kept[at + 1:])
            if at < len(kept) // 2:
                self.refused("the checkpoint is damaged")
        records.unlink()
        self.refused("the checkpoint is damaged")
        records.write_bytes(kept)

        (self.results / "contact.csv").write_bytes(b"")
        run = scabo("resume", self.results)
        self.assertEqual(run.returncode, 3)
        self.assertIn("contact.csv: it is shorter than the run left it", run.stderr)
        checkpoint.unlink()
        self.refused("there is no checkpoint to resume from")

    def test_a_finished_run(self):
        self.assertEqual(scabo("run", self.model, "--quiet").returncode, 0)
        self.refused("has ended with status `solved`")

    def test_a_mesh_file_that_has_changed(self):
        source = support.ROOT / "tests" / "input" / "good"
        shutil.copy(source / "blocks.msh", self.directory)
        text = (source / "mesh_file.yaml").read_text(encoding="utf-8")
        self.assertNotIn("steps:", text)
        self.model.write_text(text + "steps: [{increments: 2000}]\n", encoding="utf-8")
        self.assertTrue(self.killed(), "the run was too fast")
        with open(self.directory / "blocks.msh", "a", encoding="utf-8") as file:
            file.write("\n")
        self.refused("blocks.msh: has changed since the run began")

    def test_damage_is_found_wherever_it_is(self):
        self.assertTrue(self.killed(), "the run was too fast")
        checkpoint = self.results / "checkpoint.state"
        good, kept = checkpoint.read_bytes(), self.directory / "kept"
        shutil.copytree(self.results, kept)
        random.seed(SEED)
        for _ in range(3 if SANITIZED else 12):
            shutil.rmtree(self.results)
            shutil.copytree(kept, self.results)
            at = random.randrange(len(good))
            checkpoint.write_bytes(good[:at] + bytes([good[at] ^ (1 << random.randrange(8))]) + good[at + 1:])
            run = scabo("resume", self.results, "--quiet")
            self.assertEqual(run.returncode, 1, run.stderr)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)


if __name__ == "__main__":
    support.main()
