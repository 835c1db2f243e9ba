"""Runs: the same numbers and files as the program's, progress, cancelling, and what other threads do meanwhile."""
import functools
import operator
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import threading
import time
import traceback
import unittest
import warnings

import numpy as np

import scabo
from scabo import _core
from support import BEAM, InTemporaryDirectory, block, program, summary_of

TIMES = ("timing", "peak_memory_bytes")


def without_times(summary):
    return {key: value for key, value in summary.items() if key not in TIMES}


def in_steps(increments):
    model = scabo.Model(block())
    model["steps"] = [{"name": "press", "increments": increments}]
    return model


class SameAsTheProgram(InTemporaryDirectory):
    def test_double_cantilever_with_fine_elements(self):
        settings = [f"bodies.{body}.mesh.size=0.09375" for body in ("lower", "upper")]
        words = [word for setting in settings for word in ("--set", setting)]
        run = program("run", BEAM, "-o", self.directory / "program", "--quiet", *words)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        expected = summary_of(self.directory / "program")
        result = scabo.read(BEAM, set=dict(setting.split("=") for setting in settings)).run()
        self.assertEqual(without_times(result.summary), without_times(expected))
        force = expected["increments"][-1]["contacts"]["joint"]["normal_force"]
        self.assertAlmostEqual(force, 53.670e3, delta=1.0)  # docs/verification.md
        self.assertEqual(result.contact["joint"].normal_force, force)
        self.assertEqual(result.contact["joint"].history()["normal_force"][-1], force)
        # In the order of the solver; NumPy's own sum takes the terms in another order.
        forces = result.contact["joint"].table()["normal_force"]
        self.assertEqual(functools.reduce(operator.add, forces.tolist(), 0.0), force)

    def test_files_are_those_of_the_program(self):
        program("run", BEAM, "-o", self.directory / "program", "--quiet")
        result = scabo.read(BEAM).run(output=self.directory / "python")
        self.assertEqual(result.directory, str(self.directory / "python"))
        self.assertEqual(result.summary, summary_of(result.directory))
        names = sorted(path.name for path in (self.directory / "program").iterdir())
        self.assertEqual(sorted(path.name for path in (self.directory / "python").iterdir()), names)
        for name in names:
            if name not in ("summary.json", "log.txt"):
                self.assertEqual((self.directory / "python" / name).read_bytes(),
                                 (self.directory / "program" / name).read_bytes(), name)

    def test_results_that_are_saved_later(self):
        program("run", BEAM, "-o", self.directory / "program", "--quiet")
        result = scabo.read(BEAM).run()
        result.save(self.directory / "saved")
        self.assertEqual(result.directory, str(self.directory / "saved"))
        for name in ("contact.csv", "fields_0001.vtu", "contact_0001.vtu", "convergence.csv"):
            self.assertEqual((self.directory / "saved" / name).read_bytes(),
                             (self.directory / "program" / name).read_bytes(), name)
        self.assertEqual(without_times(summary_of(self.directory / "saved")), without_times(result.summary))

    def test_a_run_of_a_file_can_be_resumed_by_the_program(self):
        model = self.directory / "block.yaml"
        content = block()
        content["steps"] = [{"name": "press", "increments": 6}]
        import json
        model.write_text(json.dumps(content))
        with self.assertRaises(scabo.Interrupted) as stopped:
            scabo.read(model).run(output=self.directory / "results", progress=lambda now: now.increment < 2)
        self.assertEqual(str(stopped.exception), "interrupted; 2 finished increments kept")
        self.assertEqual(len(stopped.exception.result.increments), 2)
        self.assertEqual(summary_of(self.directory / "results")["status"], "interrupted")
        run = program("resume", self.directory / "results", "--quiet")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        scabo.read(model).run(output=self.directory / "unbroken")
        for name in ("contact.csv", "fields_0006.vtu", "convergence.csv"):
            self.assertEqual((self.directory / "results" / name).read_bytes(),
                             (self.directory / "unbroken" / name).read_bytes(), name)

    def test_text_of_a_run_without_solution(self):
        model = scabo.Model(block())
        model["loads"]["push"]["traction"] = [4e6, -10e6]
        with self.assertRaises(scabo.Mechanism) as failed:
            model.run()
        import json
        file = self.directory / "block.yaml"
        file.write_text(json.dumps(model))
        run = program("run", file, "-o", self.directory / "results", "--quiet")
        self.assertEqual(run.returncode, 2)
        self.assertEqual(run.stderr, f"scabo: {failed.exception}\n")
        self.assertEqual(failed.exception.result.status, "mechanism")
        self.assertEqual(failed.exception.result.increments, [])
        motion = failed.exception.result.mechanism  # it slides
        self.assertEqual((motion.text, motion.moving, motion.rule), ("1 of 2 bodies moves, 'block'", ["block"], "coulomb"))
        self.assertEqual(motion.text, summary_of(self.directory / "results")["mechanism"]["text"])
        np.testing.assert_allclose(motion.displacement("block", [[0, 0], [2, 1]]), [[1, 0], [1, 0]], atol=1e-8)
        np.testing.assert_allclose(motion.shift[1] - motion.largest[1] * np.array([1.0, 0.0]), 0, atol=1e-8)
        self.assertTrue(np.isnan(motion.centre).all())
        base = motion.contact("base")
        self.assertEqual(list(base["pair"]), list(range(1, 42)))
        np.testing.assert_allclose([base["opening"], base["slip"] - 1, base["y"], base["normal_y"] - 1], 0, atol=1e-8)
        # By hand: f . (1, 0), the push of 4 MPa on 2 m.
        self.assertAlmostEqual(motion.work / 8e6, 1.0, delta=1e-8)
        for wrong in (lambda: motion.contact("bass"), lambda: motion.displacement("blok", [[0, 0]])):
            with self.assertRaises(KeyError):
                wrong()
        failed.exception.result.save(self.directory / "saved")
        self.assertEqual((self.directory / "saved" / "mechanism.vtu").read_bytes(),
                         (self.directory / "results" / "mechanism.vtu").read_bytes())
        self.assertIsNone(scabo.Model(block()).run().mechanism)
        again = pickle.loads(pickle.dumps(failed.exception))  # as multiprocessing does
        self.assertEqual((type(again), str(again), again.result), (scabo.Mechanism, str(failed.exception), None))

    def test_warnings_are_those_of_the_program(self):
        content = block()
        content["loads"]["nothing"] = {"on": "floor.bottom_left", "force": [0, -1]}
        import json
        file = self.directory / "block.yaml"
        file.write_text(json.dumps(content))
        run = program("run", file, "-o", self.directory / "results", "--quiet")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            result = scabo.read(file).run()
        self.assertTrue(result.warnings)
        self.assertEqual(run.stderr, "".join(f"scabo: warning: {text}\n" for text in result.warnings))
        self.assertEqual([str(warning.message) for warning in caught], result.warnings)
        self.assertTrue(all(warning.category is scabo.ModelWarning for warning in caught))
        self.assertEqual(caught[0].filename, __file__)

    def test_memory_that_is_not_available(self):
        script = """
import resource, scabo, sys
model = scabo.read(sys.argv[1], set={f"bodies.{body}.mesh.size": 0.02 for body in ("lower", "upper")})
pages = int(open("/proc/self/statm").read().split()[0])
limit = pages * resource.getpagesize() + 300_000_000
resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
try:
    model.run()
except MemoryError as error:
    print(error)
"""
        done = subprocess.run([sys.executable, "-c", script, str(BEAM)], text=True, capture_output=True, timeout=1200,
                              env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
        self.assertRegex(done.stdout, "^not enough memory: the analysis needs about 440 MB, and `ulimit -v` leaves .*"
                                      "or start it with ignore_memory=True\n$", done.stderr)

    def test_a_directory_that_cannot_be_written(self):
        file = self.directory / "file"
        file.write_text("")
        with self.assertRaisesRegex(scabo.WriteError, "file"):
            scabo.Model(block()).run(output=file)
        with self.assertRaisesRegex(ValueError, "output"):
            scabo.Model(block()).run(output="")


class Progress(InTemporaryDirectory):
    def test_stages_and_increments(self):
        seen = []
        in_steps(4).run(progress=lambda now: now.iteration is None and seen.append(now) or None)
        stages = [now.stage for now in seen]
        self.assertEqual(stages[:4], ["mesh", "super-elements", "factorisation", "condensation to the contact pairs"])
        self.assertEqual(stages[-1], "step press, increment 4 of 4")
        self.assertEqual([now.increment for now in seen[4:]], [0, 1, 1, 2, 2, 3, 3, 4])
        self.assertEqual(seen[-1].fraction, 1.0)
        self.assertEqual([now.fraction for now in seen], sorted(now.fraction for now in seen))
        self.assertEqual({now.increments for now in seen}, {4})
        self.assertIsNone(seen[0].residual)
        self.assertLess(seen[-1].residual, 1e-10)
        self.assertGreater(max(now.newton_iterations or 0 for now in seen), 0)

    def test_what_is_no_function(self):
        with self.assertRaisesRegex(TypeError, "progress must be a function or True, not str"):
            in_steps(2).run(progress="tqdm")

    def test_number_of_automatic_increments_is_not_known(self):
        seen = []
        in_steps("auto").run(progress=seen.append)
        self.assertEqual({now.increments for now in seen}, {None})

    def test_false_ends_the_run(self):
        told = []

        def callback(now):
            told.append(now)
            return now.increment < 2

        with self.assertRaises(scabo.Interrupted) as stopped:
            in_steps(5).run(progress=callback)
        result = stopped.exception.result
        self.assertEqual((result.status, len(result.increments)), ("interrupted", 2))
        self.assertEqual(str(stopped.exception), "interrupted; 2 finished increments kept")
        self.assertEqual(told[-1].increment, 2)  # and not again
        part = in_steps(5).run().contact["base"].table(1)["pressure"]
        np.testing.assert_array_equal(result.contact["base"].table()["pressure"], part)

    def test_none_and_other_values_do_not_end_it(self):
        for value in (None, True, 0, ""):
            self.assertEqual(in_steps(2).run(progress=lambda now: value).status, "solved")

    def test_false_before_anything_is_finished(self):
        told = []

        def callback(now):
            told.append(now.stage)
            return now.stage != "super-elements"

        with self.assertRaises(scabo.Interrupted) as stopped:
            in_steps(5).run(output=self.directory / "results", progress=callback)
        self.assertEqual(told, ["mesh", "super-elements"])
        self.assertEqual(stopped.exception.result.increments, [])
        self.assertEqual(summary_of(self.directory / "results")["status"], "interrupted")

    def test_exceptions_of_the_callback(self):
        class Mine(Exception):
            pass

        def callback(now):
            if now.increment == 3:
                raise Mine("enough")

        try:
            in_steps(5).run(progress=callback)
            self.fail("nothing was raised")
        except Mine as raised:
            self.assertEqual(str(raised), "enough")
            self.assertEqual(len(raised.result.increments), 3)
            names = [frame.name for frame in traceback.extract_tb(raised.__traceback__)]
            self.assertEqual((names[0], names[-1]), ("test_exceptions_of_the_callback", "callback"))

    def long_increment(self):
        """A model whose increments take more than the time between two calls."""
        sizes = {f"bodies.{body}.mesh.size": 0.0125 for body in ("lower", "upper")}
        return scabo.read(BEAM, set={**sizes, "steps": [{"name": "press", "increments": 50}]})

    def test_iterations_within_an_increment(self):
        seen = []

        def callback(now):
            if now.iteration is not None:
                seen.append(now)
            return len(seen) < 3 and None

        with self.assertRaises(scabo.Interrupted):
            self.long_increment().run(progress=callback)
        self.assertTrue(all(now.iteration >= 0 and now.iteration_residual > 0.0 for now in seen))
        self.assertRegex(seen[0].stage, "step press, increment ")

    def one_long_stage(self):
        """A model of which one super-element takes most of the time, because it has no symmetry."""
        content = block()
        content["bodies"]["block"].update(shape={"polygon": {"vertices": [[0, 0], [2, 0], [1.9, 1.1], [0.2, 0.9]]}}, mesh={"size": 0.011})
        content["loads"]["push"] = {"on": "block.edge_3", "traction": [0, -1]}
        content["contacts"]["base"]["between"] = ["floor.top", "block.edge_1"]
        return scabo.Model(content)

    def test_it_can_end_within_a_stage(self):
        told = []

        def callback(now):
            told.append(now.stage)
            return told.count("super-elements") < 2 and None

        with self.assertRaises(scabo.Interrupted) as stopped:
            self.one_long_stage().run(output=self.directory / "results", progress=callback)
        self.assertEqual(told[-2:], ["super-elements"] * 2)  # no other stage was told
        self.assertEqual(stopped.exception.result.increments, [])
        summary = summary_of(self.directory / "results")
        self.assertEqual((summary["status"], summary["increments"]), ("interrupted", []))

    def test_seconds_left(self):
        seen = []
        in_steps(3).run(progress=seen.append)
        self.assertIsNone(seen[0].seconds_left)
        self.assertEqual(seen[-1].seconds_left, 0.0)

    def with_tqdm(self, text):
        """Runs a model with `progress=True` and this as tqdm/auto.py; its output."""
        (self.directory / "tqdm").mkdir()
        (self.directory / "tqdm" / "__init__.py").write_text("")
        (self.directory / "tqdm" / "auto.py").write_text(text)
        script = "import scabo, sys; print(scabo.read(sys.argv[1]).run(progress=True).status)"
        run = subprocess.run([sys.executable, "-c", script, str(BEAM)], capture_output=True, text=True, timeout=1200,
                             env={**os.environ, "PYTHONPATH": f"{self.directory}:{os.environ['PYTHONPATH']}"})
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return run.stdout.splitlines()

    def test_a_bar(self):
        lines = self.with_tqdm("""
class tqdm:
    def __init__(self, total, bar_format, postfix):
        self.n, self.total, self.postfix = 0.0, total, postfix
    def update(self, part):
        self.n += part
    def refresh(self):
        print(self.n / self.total, self.postfix[0])
    def close(self):
        print("closed")
""")
        self.assertEqual(lines[0], "0.0 mesh")
        self.assertRegex(lines[-3], r"^1\.0 step press, increment 1 of 1; residual [0-9.e-]+$")
        self.assertEqual(lines[-2:], ["closed", "solved"])

    def test_no_bar_without_tqdm(self):
        self.assertEqual(self.with_tqdm("raise ImportError"), ["solved"])

    def test_a_modal_analysis(self):
        model = scabo.read(BEAM.parent.parent / "02_natural_frequencies" / "model.yaml")
        with self.assertRaises(scabo.Interrupted):
            model.modes(progress=lambda now: not now.stage.startswith("mass"))
        with self.assertRaises(ZeroDivisionError):
            model.modes(progress=lambda now: 1 / 0)


class Threads(InTemporaryDirectory):
    def test_other_threads_go_on(self):
        """Another thread runs in the middle of a solve, which calls nothing of Python meanwhile. A busy machine may not give it
        the time at once, so that there are many solves; with the interpreter locked, it would never run there."""
        model = scabo.read(BEAM, set={"bodies.lower.mesh.size": 0.05, "bodies.upper.mesh.size": 0.05})._checked()
        ticks, stop = [], threading.Event()

        def tick():
            while not stop.is_set():
                ticks.append(time.perf_counter())
                time.sleep(1e-4)

        thread = threading.Thread(target=tick)
        thread.start()
        try:
            for _ in range(100):
                start = time.perf_counter()
                _core.solve_static(model, None, 1, True, False, None)
                end = time.perf_counter()
                part = 0.25 * (end - start)
                if any(start + part < at < end - part for at in ticks):
                    return
                ticks.clear()
        finally:
            stop.set()
            thread.join()
        self.fail("no other thread has run")

    def test_two_runs_at_once(self):
        expected = in_steps(3).run().contact["base"].table()["pressure"].copy()
        found = [None] * 4

        def run(index):
            found[index] = in_steps(3).run().contact["base"].table()["pressure"]

        threads = [threading.Thread(target=run, args=(index,)) for index in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for pressure in found:
            np.testing.assert_array_equal(pressure, expected)

    def test_number_of_threads(self):
        for wrong in (0, -1, 1.5, True, 2000):
            with self.assertRaisesRegex(ValueError, "threads must be"):
                in_steps(1).run(threads=wrong)
        self.assertEqual(in_steps(1).run(threads=1).status, "solved")


class Signals(InTemporaryDirectory):
    SCRIPT = """
import scabo, support, sys
model = scabo.Model(support.block())
model["steps"] = [{"name": "press", "increments": 100000}]
model["output"] = {"every": 100000}
def tell(now):
    if now.increment == 2 and not now.stage.endswith("3 of 100000"):
        print("running", flush=True)
try:
    model.run(progress=tell if sys.argv[1] == "told" else None, keep_fields=False, output=sys.argv[2])
except KeyboardInterrupt as interrupted:
    print("interrupted", interrupted.result.status, len(interrupted.result.increments) >= 2)
"""

    def test_ctrl_c(self):
        here = pathlib.Path(__file__).resolve().parent
        results = self.directory / "results"
        path = os.pathsep.join([str(here), os.environ["PYTHONPATH"]])
        process = subprocess.Popen([sys.executable, "-c", self.SCRIPT, "told", str(results)], stdout=subprocess.PIPE,
                                   text=True, env={**os.environ, "PYTHONPATH": path})
        self.assertEqual(process.stdout.readline(), "running\n")
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=1200)
        self.assertEqual(output, "interrupted interrupted True\n")
        self.assertEqual(summary_of(results)["status"], "interrupted")

    def test_within_work_that_calls_nothing(self):
        """An alarm a fifth into the work ends it: less than two thirds of its processor time pass."""
        class Alarm(Exception):
            pass

        def ring(*_):
            raise Alarm

        n = 640  # elements on four sides without symmetry
        nodes = scabo.boundary_nodes([[0, 0], [2, 0], [1.9, 1.1], [0.2, 0.9]], 12.0 / n)

        def seconds(work):
            start = time.process_time()
            work()
            return time.process_time() - start

        def element():
            scabo.SuperElement(nodes, 210e9, 0.3)

        def ended():
            signal.setitimer(signal.ITIMER_PROF, 0.2 * whole)  # of processor time
            with self.assertRaises(Alarm):
                element()

        seconds(element)
        whole = seconds(element)
        before = signal.signal(signal.SIGPROF, ring)
        self.addCleanup(signal.signal, signal.SIGPROF, before)
        self.assertLess(seconds(ended), 0.67 * whole)


if __name__ == "__main__":
    unittest.main()
