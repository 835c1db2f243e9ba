"""scabo sweep: tables, points that fail, interruption and continuation."""
import csv
import json
import signal
import subprocess
import time

import support
from support import InTemporaryDirectory, scabo, summary_of

# A block on a floor, pressed and pushed: it slides when the push exceeds friction times the pressure.
MODEL = """
scabo: 1
parameters: {p: 1e6, push: 0.25, width: 2.0}
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [10, 1]}}}
  block: {material: steel, shape: {rectangle: {corner: [0, 0], size: ["${width}", 1]}}, mesh: {size: 0.5}}
supports: [{on: floor, fix: [x, y]}]
loads: {press: {on: block.top, traction: ["${push * p}", "${-p}"]}}
contacts: {base: {between: [floor.top, block.bottom], friction: 0.5}}
steps: [{increments: 4}]
"""


class Sweep(InTemporaryDirectory):
    def setUp(self):
        super().setUp()
        self.model = self.directory / "model.yaml"
        self.model.write_text(MODEL, encoding="utf-8")
        self.results = self.directory / "model.sweep"

    def sweep(self, *words):
        return scabo("sweep", self.model, *words)

    def table(self):
        with open(self.results / "sweep.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_forces_of_every_point(self):
        done = self.sweep("--vary", "contacts.base.friction=0.1:0.5:5", "--vary", "width=1,2", "-j", "2")
        self.assertEqual(done.returncode, 2, done.stderr)  # 0.1 and 0.2 do not hold it
        rows = self.table()
        self.assertEqual([row["contacts.base.friction"] for row in rows],
                         ["0.1", "0.1", "0.2", "0.2", "0.3", "0.3", "0.4", "0.4", "0.5", "0.5"])
        self.assertEqual([row["status"] for row in rows], ["mechanism"] * 4 + ["solved"] * 6)
        for row in rows:
            if row["status"] == "mechanism":  # at any load: the push grows with the pressure
                self.assertEqual((row["base.normal_force"], row["step"]), ("", ""))
                continue
            force = 1e6 * float(row["parameters.width"])
            self.assertAlmostEqual(float(row["base.normal_force"]) / force, 1.0, delta=1e-9)
            self.assertAlmostEqual(float(row["base.tangential_force"]) / force, -0.25, delta=1e-9)
            self.assertAlmostEqual(float(row["floor.reaction_y"]) / force, 1.0, delta=1e-9)
            self.assertAlmostEqual(float(row["reached"]), 1.0)
        # The same numbers as those of a run of its own.
        alone = scabo("run", self.model, "-q", "-o", self.directory / "alone", "--set", "contacts.base.friction=0.4",
                      "--set", "parameters.width=2", "--threads", "1")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        last = summary_of(self.directory / "alone")["increments"][-1]
        self.assertEqual(float(rows[7]["base.max_pressure"]), last["contacts"]["base"]["max_pressure"])

    def test_spacings(self):
        self.assertEqual(self.sweep("--vary", "materials.steel.young=log:1e9:1e11:3", "-q").returncode, 0)
        self.assertEqual([float(row["materials.steel.young"]) for row in self.table()], [1e9, 1e10, 1e11])

    def test_a_point_that_fails_loses_no_other(self):
        done = self.sweep("--vary", "contacts.base.friction=0.4,-1,0.5")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("must be 0 or more, not -1", done.stderr)
        self.assertEqual([row["status"] for row in self.table()], ["solved", "wrong_input", "solved"])
        self.assertIn("must be 0 or more", (self.results / "point_002.txt").read_text(encoding="utf-8"))

    def test_wrong_commands(self):
        for words, message in [
            (["contacts.bsae.friction=0.1,0.2"], "--vary contacts.bsae.friction: contacts has no 'bsae' (did you mean 'base'?)"),
            (["contacts.base.frictoin=0.1,0.2"], "--vary contacts.base.frictoin: unknown key 'frictoin'"),
            (["parameters.widht=1,2"], "the model has and uses no parameter 'widht' (did you mean 'width'?)"),
            (["contacts.base.friction=0.1:0.9"], "is not a range"),
            (["contacts.base.friction=0.1:0.9:1.5"], "whole number of values"),
            (["contacts.base.friction=log:0:0.9:3"], "two ends of one sign"),
            (["contacts.base.friction=0.1,,0.2"], "empty value"),
            (["contacts.base.friction=0.1,0.1"], "twice"),
            (["contacts.base.friction"], "has no '='"),
            (["parameters.p=1:2:200", "--vary", "parameters.width=1:2:200"], "more than 10000 runs"),
            (["parameters.p=1,2", "--vary", "parameters.p=3,4"], "is varied twice"),
        ]:
            with self.subTest(words=words):
                done = self.sweep("--vary", *words)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn(message, done.stderr)
                self.assertFalse(self.results.exists())
        self.assertEqual(self.sweep().returncode, 1)

    def test_other_sweeps_are_not_mixed(self):
        self.assertEqual(self.sweep("--vary", "parameters.width=1,2", "-q").returncode, 0)
        done = self.sweep("--vary", "parameters.width=1,3", "-q")
        self.assertEqual(done.returncode, 1)
        self.assertIn("holds the results of another sweep", done.stderr)
        self.model.write_text(MODEL.replace("0.25", "0.2"), encoding="utf-8")
        done = self.sweep("--vary", "parameters.width=1,2", "-q")
        self.assertIn("of another model file", done.stderr)
        self.assertEqual(self.sweep("--vary", "parameters.width=1,2", "-q", "--anew").returncode, 0)
        self.assertAlmostEqual(float(self.table()[0]["base.tangential_force"]) / 1e6, -0.2, delta=1e-9)

    def test_a_second_call_runs_what_is_missing(self):
        vary = ["--vary", "contacts.base.friction=0.3,0.4,0.5", "-j", "1"]
        self.assertEqual(self.sweep(*vary).returncode, 0)
        before = (self.results / "sweep.csv").read_bytes()
        kept = (self.results / "point_001" / "summary.json").stat().st_mtime_ns
        (self.results / "point_002" / "summary.json").unlink()
        third = self.results / "point_003" / "summary.json"
        summary = json.loads(third.read_text(encoding="utf-8"))
        third.write_text(json.dumps({**summary, "status": "failed"}), encoding="utf-8")
        done = self.sweep(*vary)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("1 of 3 points are there already", done.stderr)
        self.assertEqual((self.results / "sweep.csv").read_bytes(), before)
        self.assertEqual((self.results / "point_001" / "summary.json").stat().st_mtime_ns, kept)

    def test_interrupt_keeps_what_is_done(self):
        self.model.write_text(MODEL.replace("increments: 4", "increments: 20000").replace("size: 0.5", "size: 0.02"),
                              encoding="utf-8")
        words = [support.SCABO, "sweep", self.model, "--vary", "contacts.base.friction=0.3,0.4,0.5", "-j", "2"]
        running = subprocess.Popen(list(map(str, words)), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        first = self.results / "point_001" / "checkpoint.increments"
        end = time.monotonic() + support.PATIENCE
        while time.monotonic() < end and not (first.exists() and first.stat().st_size > 2000):
            time.sleep(0.02)
        running.send_signal(signal.SIGINT)
        error = running.communicate(timeout=support.PATIENCE)[1]
        self.assertEqual(running.returncode, 130, error)
        self.assertIn("the same command goes on", error)
        rows = self.table()
        self.assertEqual(rows[0]["status"], "interrupted")
        self.assertEqual(rows[2]["status"], "waiting")
        self.assertGreater(len(summary_of(self.results / "point_001")["increments"]), 0)

    def test_an_interrupted_sweep_goes_on_to_the_same_table(self):
        self.model.write_text(MODEL.replace("increments: 4", "increments: 80").replace("size: 0.5", "size: 0.05")
                              + "output: {history: {force: base.tangential_force, heat: friction_energy}}\n", encoding="utf-8")
        vary = ["--vary", "contacts.base.friction=0.3,0.4,0.5", "-j", "1"]
        self.assertEqual(self.sweep(*vary, "-o", self.directory / "unbroken").returncode, 0)
        words = [support.SCABO, "sweep", self.model, *vary]
        for point in ("point_001", "point_002"):
            running = subprocess.Popen(list(map(str, words)), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            records = self.results / point / "checkpoint.increments"
            while running.poll() is None and not (records.exists() and records.stat().st_size > 2000):
                time.sleep(0.005)
            running.send_signal(signal.SIGTERM)
            self.assertIn(running.wait(timeout=support.PATIENCE), (0, 143))
        self.assertEqual(self.sweep(*vary).returncode, 0)
        self.assertEqual((self.results / "sweep.csv").read_bytes(), (self.directory / "unbroken" / "sweep.csv").read_bytes())

    def test_runs_end_with_the_sweep(self):
        self.model.write_text(MODEL.replace("increments: 4", "increments: 20000").replace("size: 0.5", "size: 0.02"),
                              encoding="utf-8")
        words = [support.SCABO, "sweep", self.model, "--vary", "contacts.base.friction=0.3,0.4", "-j", "1"]
        running = subprocess.Popen(list(map(str, words)), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        first = self.results / "point_001" / "checkpoint.increments"
        end = time.monotonic() + support.PATIENCE
        while time.monotonic() < end and not (first.exists() and first.stat().st_size > 2000):
            time.sleep(0.02)
        running.kill()
        running.wait(timeout=support.PATIENCE)
        status = ""
        while time.monotonic() < end and status != "interrupted":
            status = summary_of(self.results / "point_001")["status"]
            time.sleep(0.02)
        self.assertEqual(status, "interrupted")


if __name__ == "__main__":
    support.main()
