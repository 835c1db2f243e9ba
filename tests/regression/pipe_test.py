"""Named pipes instead of files: what is read once may be one, everything else is refused, and nothing waits for ever."""
import contextlib
import os
import signal
import subprocess
import threading
import time

import support
from support import InTemporaryDirectory, scabo, summary_of

MODEL = """scabo: 1
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [10, 1]}}}
  block: {material: steel, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.5}}
supports: [{on: floor, fix: [x, y]}]
loads: {press: {on: block.top, traction: [1e5, -1e6]}}
contacts: {base: {between: [floor.top, block.bottom], friction: 0.5}}
steps: [{increments: 3}]
"""


class Pipes(InTemporaryDirectory):
    def pipe(self, name, content):
        """Written once, when it is opened to be read; a reader that opens it again waits for ever."""
        path = self.directory / name
        path.parent.mkdir(exist_ok=True)
        os.mkfifo(path)

        def write():
            with contextlib.suppress(OSError), open(path, "w", encoding="utf-8") as stream:
                stream.write(content)

        writer = threading.Thread(target=write, daemon=True)
        writer.start()
        # A writer whose pipe nobody opened must not keep the test from ending.
        self.addCleanup(lambda: os.close(os.open(path, os.O_RDONLY | os.O_NONBLOCK)))
        return path

    def test_a_model_is_read_once(self):
        pipe = self.pipe("model.yaml", MODEL)
        run = scabo("run", pipe, "--quiet", "-o", self.directory / "results")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        increments = summary_of(self.directory / "results")["increments"]
        self.assertEqual(len(increments), 3)
        self.assertAlmostEqual(increments[-1]["contacts"]["base"]["normal_force"], 2e6, delta=1e-3)

    def test_a_model_is_checked(self):
        run = scabo("check", self.pipe("model.yaml", MODEL))
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("block", run.stdout)

    def test_a_sweep_refuses_it(self):
        run = scabo("sweep", self.pipe("model.yaml", MODEL), "--vary", "contacts.base.friction=0.4,0.5")
        self.assertEqual(run.returncode, 1)
        self.assertIn("model.yaml: is a pipe or a device, but every run of a sweep reads the model again: save it as a file", run.stderr)

    def test_plot_report_and_resume_refuse_it(self):
        pipe = self.pipe("results", "")
        for command in ("plot", "report", "resume"):
            with self.subTest(command):
                run = scabo(command, pipe)
                self.assertEqual(run.returncode, 1, run.stderr)
                if command != "report" or "make report" not in run.stderr:  # without its page it does not come that far
                    self.assertIn("results: is a file, not a", run.stderr)

    def test_convert_refuses_it(self):
        run = scabo("convert", self.pipe("part.inp", "*NODE\n1, 0, 0\n"))
        self.assertEqual(run.returncode, 1)
        self.assertIn("part.inp: is a pipe or a device, which is read only once; save what it gives as a file", run.stderr)

    def test_meshes_and_images_that_are_pipes_are_refused(self):
        self.pipe("part.msh", "$MeshFormat\n")
        self.pipe("part.png", "")
        for body in ("{material: steel, mesh: {file: part.msh}}",
                     "{shape: {image: {file: part.png, pixel: 1, materials: {0: steel}}}, mesh: {kind: quadtree, size: 1}}"):
            with self.subTest(body):
                model = self.directory / "of_pipe.yaml"
                model.write_text("scabo: 1\nmaterials: {steel: {young: 1, poisson: 0}}\nbodies:\n  part: " + body +
                                 "\nsupports: [{on: part.bottom, fix: [x, y]}]\nloads: {f: {on: part.top, pressure: 1}}\n", encoding="utf-8")
                run = scabo("check", model)
                self.assertEqual(run.returncode, 1)
                self.assertIn("is a pipe or a device, which is read only once", run.stderr)

    def test_records_and_states_that_are_pipes_are_refused(self):
        self.pipe("quake.txt", "0.1\n0.2\n")
        self.pipe("first.results/end.yaml", "")
        for more, message in (("curves: {quake: {record: {file: quake.txt, unit: m/s2}}}\n", "quake.txt: the file of the record cannot be read: is a pipe or a device"),
                              ("restart: first.results\n", "'first.results' has no state at its end to start from")):
            with self.subTest(more):
                model = self.directory / "model.yaml"
                model.write_text(MODEL + more, encoding="utf-8")
                run = scabo("check", model)
                self.assertEqual(run.returncode, 1)
                self.assertIn(message, run.stderr)

    def test_pipes_in_the_place_of_results_are_refused(self):
        model = self.directory / "model.yaml"
        model.write_text(MODEL, encoding="utf-8")
        for name in ("summary.json", "log.txt", "fields_0001.vtu", "checkpoint.state", "problems/0001.hdf5"):
            with self.subTest(name):
                pipe = self.directory / "results" / name
                pipe.parent.mkdir(parents=True, exist_ok=True)
                os.mkfifo(pipe)
                run = scabo("run", model, "--quiet", "-o", self.directory / "results")
                pipe.unlink()
                self.assertEqual(run.returncode, 3, run.stderr)
                self.assertIn(f"Scabo did not write the {name} there", run.stderr)

    def test_a_run_that_waits_for_its_model_ends_when_told_to(self):
        path = self.directory / "silent.yaml"
        os.mkfifo(path)
        run = subprocess.Popen([support.SCABO, "run", str(path), "--quiet"], stderr=subprocess.DEVNULL)
        try:
            writer = None
            while writer is None:  # opened for writing only once the program waits for the text
                try:
                    writer = os.open(path, os.O_WRONLY | os.O_NONBLOCK)
                except OSError:
                    time.sleep(0.01)
            run.send_signal(signal.SIGTERM)
            self.assertNotEqual(run.wait(timeout=support.PATIENCE), 0)
            os.close(writer)
        finally:
            run.kill()

    def test_a_run_of_a_pipe_is_resumed_from_a_file(self):
        """What the pipe gave is kept as a digest, which a file with the same text has."""
        slow = MODEL.replace("increments: 3", "increments: 100").replace("size: 0.5", "size: 0.1")
        pipe = self.pipe("model.yaml", slow)
        results = self.directory / "results"
        run = subprocess.Popen([support.SCABO, "run", str(pipe), "--quiet", "-o", str(results)], stderr=subprocess.DEVNULL)
        while not (results / "checkpoint.state").exists() and run.poll() is None:
            time.sleep(0.01)
        run.send_signal(signal.SIGTERM)
        run.wait(timeout=support.PATIENCE)
        if not (results / "checkpoint.state").exists():
            self.skipTest("the run ended before the signal")
        refused = scabo("resume", results)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("is a pipe: say with --model where the text of the model is kept in a file", refused.stderr)
        kept = self.directory / "kept.yaml"
        kept.write_text(slow, encoding="utf-8")
        self.assertEqual(scabo("resume", results, "--model", kept, "--quiet").returncode, 0)


if __name__ == "__main__":
    support.main()
