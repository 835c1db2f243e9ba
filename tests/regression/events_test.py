"""`--json-lines`: every line is JSON, and the events come in the order that docs/events.md describes."""
import json
import re
import signal
import subprocess

import support
from support import BEAM, ROOT, scabo

KEYS = {
    "start": {"schema", "version", "command", "pid"},
    "model": {"model", "directory", "analysis"},
    "plan": {"bodies", "nodes", "dofs", "super_elements", "finite_elements", "contact_pairs", "increments", "bytes",
             "seconds", "stages", "first_mesh_only"},
    "stage_begin": {"stage"},
    "stage_end": {"stage", "seconds"},
    "increment_begin": {"step", "step_name", "increment", "increments"},
    "iteration": {"iteration", "residual", "states_changed", "method"},
    "increment_end": {"step", "step_name", "increment", "reached", "converged", "residual", "certificate", "iterations",
                      "coarse_iterations", "halvings", "pairs", "growth", "reason", "seconds", "done", "seconds_left"},
    "warning": {"kind", "text"},
    "error": {"text", "file", "line", "column", "path"},
    "finished": {"status", "exit_status", "mechanism"},
}


class Events(support.InTemporaryDirectory):
    def events(self, text, whole=True):
        """The events of standard output, after checks of what holds for each run."""
        self.assertTrue(text.endswith("\n"))
        events = [json.loads(line) for line in text.splitlines()]
        times = [event["t"] for event in events]
        self.assertEqual(times, sorted(times))
        for event in events:
            self.assertEqual(set(event) - {"event", "t"}, KEYS[event["event"]], event)
        kinds = [event["event"] for event in events]
        self.assertEqual(kinds[0], "start")
        self.assertEqual([kind for kind in kinds if kind in ("start", "finished")], ["start", "finished"] if whole else ["start"])
        if whole:
            self.assertEqual(kinds[-1], "finished")
        open_stage = None
        for event in events:
            kind = event["event"]
            if kind in ("stage_begin", "increment_begin", "finished"):
                if kind != "finished":
                    self.assertIsNone(open_stage, event)
                    open_stage = (kind.split("_")[0], event.get("stage") or (event["step"], event["increment"]))
            elif kind in ("stage_end", "increment_end"):
                self.assertEqual(open_stage, (kind.split("_")[0], event.get("stage") or (event["step"], event["increment"])))
                self.assertGreaterEqual(event["seconds"], 0.0)
                open_stage = None
            elif kind == "iteration":
                self.assertEqual(open_stage[0], "increment")
        return events

    def of_kind(self, events, kind):
        return [event for event in events if event["event"] == kind]

    def run_steps(self, *words, increments=4):
        return scabo("run", BEAM, "-o", self.directory / "results", "--json-lines", "--set",
                     f"steps=[{{name: press, increments: {increments}}}]", *words)

    def test_cracks_that_grow(self):
        model = self.directory / "growth.yaml"
        self.assertEqual(scabo("new", "growth", "-o", model).returncode, 0)
        run = scabo("run", model, "--json-lines", "--set", "steps.0.growth.until={steps: 1}")
        self.assertEqual(run.returncode, 0, run.stderr)
        first, second = (end["growth"] for end in self.of_kind(self.events(run.stdout), "increment_end"))
        self.assertAlmostEqual(first["load_factor"] / second["load_factor"], 1.0, delta=1e-3)
        self.assertIsNone(first["cycles"])
        self.assertEqual(first["tips"]["beam.flaw.end"], [0.4, 0])
        self.assertAlmostEqual(second["tips"]["beam.flaw.end"][0], 0.42, delta=1e-9)

    def test_a_run(self):
        run = self.run_steps()
        self.assertEqual(run.returncode, 0)
        self.assertIn("solved and certified", run.stderr)  # the summary, for people
        events = self.events(run.stdout)
        summary = support.summary_of(self.directory / "results")
        plan = self.of_kind(events, "plan")[0]
        self.assertEqual(plan["dofs"], summary["model"]["dofs"])
        self.assertAlmostEqual(sum(plan["stages"].values()), plan["seconds"], delta=1e-9 * plan["seconds"])
        stages = [event["stage"] for event in self.of_kind(events, "stage_end")]
        self.assertEqual(stages, ["reading", "checking", "mesh", "super-elements", "factorisation",
                                  "condensation to the contact pairs"])
        ends = self.of_kind(events, "increment_end")
        self.assertEqual([event["increment"] for event in ends], [1, 2, 3, 4])
        self.assertEqual([event["done"] for event in ends], [0.25, 0.5, 0.75, 1.0])
        self.assertEqual(ends[-1]["seconds_left"], 0.0)
        for event, increment in zip(ends, summary["increments"], strict=True):
            self.assertEqual((event["residual"], event["iterations"]),
                             (increment["residual"], increment["newton_iterations"]))
            joint = increment["contacts"]["joint"]
            self.assertEqual(event["pairs"], {state: joint[state] for state in ("open", "stick", "slip")})
        self.assertEqual((events[-1]["status"], events[-1]["exit_status"]), ("solved", 0))

    def test_quiet(self):
        run = self.run_steps("--quiet")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.events(run.stdout)

    def test_results_do_not_change(self):
        self.run_steps("--quiet")
        scabo("run", BEAM, "-o", self.directory / "plain", "--quiet", "--set", "steps=[{name: press, increments: 4}]")
        self.assertEqual((self.directory / "results" / "contact.csv").read_bytes(),
                         (self.directory / "plain" / "contact.csv").read_bytes())

    def test_mistakes_in_the_model(self):
        run = self.run_steps("--set", "contacts.joint.friction=-1", "--set", "bodies.lower.material=stel")
        self.assertEqual(run.returncode, 1)
        events = self.events(run.stdout)
        errors = self.of_kind(events, "error")
        self.assertEqual({error["path"] for error in errors}, {"--set contacts.joint.friction", "--set bodies.lower.material"})
        self.assertEqual((events[-1]["status"], events[-1]["exit_status"]), ("wrong_input", 1))
        run = scabo("run", "missing.yaml", "--json-lines", cwd=self.directory)
        self.assertEqual(run.returncode, 1)
        self.assertEqual(self.of_kind(self.events(run.stdout), "error")[0]["file"], "missing.yaml")

    def test_a_mechanism(self):
        model = re.search(r"```yaml\n(scabo: 1\nmaterials: \{steel.*?)```", (ROOT / "README.md").read_text(), re.DOTALL).group(1)
        (self.directory / "block.yaml").write_text(model)
        run = scabo("run", "block.yaml", "--json-lines", "--quiet", "--set", "loads.push.traction=[4e6,-10e6]", cwd=self.directory)
        self.assertEqual(run.returncode, 2)
        events = self.events(run.stdout)
        end = self.of_kind(events, "increment_end")[-1]
        self.assertEqual((end["converged"], end["pairs"]), (False, None))
        self.assertIn("mechanism", end["reason"])
        self.assertIn("mechanism", self.of_kind(events, "error")[0]["text"])
        self.assertEqual((events[-1]["status"], events[-1]["exit_status"]), ("mechanism", 2))
        summary = json.loads((self.directory / "block.results" / "summary.json").read_text())
        self.assertEqual(events[-1]["mechanism"], summary["mechanism"]["text"])
        self.assertIn("'", events[-1]["mechanism"], "no body is named")

    def test_warnings(self):
        run = self.run_steps("--set", "loads.tip.force=[0,-1e9]", increments=1)
        self.assertIn("large_displacement", [event["kind"] for event in self.of_kind(self.events(run.stdout), "warning")])

    def test_a_refined_model_reports_its_increments_at_the_end(self):
        run = self.run_steps("--quiet", "--set", "output.error=true")
        events = self.events(run.stdout)
        kinds = [event["event"] for event in events]
        self.assertLess(len(kinds) - 1 - kinds[::-1].index("stage_end"), kinds.index("increment_begin"))
        self.assertEqual(len(self.of_kind(events, "increment_end")), 4)

    def test_a_modal_analysis(self):
        run = scabo("run", ROOT / "examples" / "02_natural_frequencies" / "model.yaml", "-o", self.directory / "results",
                    "--json-lines", "--quiet")
        events = self.events(run.stdout)
        self.assertIn("shapes", [event["stage"] for event in self.of_kind(events, "stage_end")])
        self.assertEqual(events[-1]["exit_status"], 0)

    def interrupted(self, *signals):
        """A long run that gets the signals after its second increment, and its output."""
        process = subprocess.Popen([support.SCABO, "run", BEAM, "-o", self.directory / "results", "--json-lines", "--quiet",
                                    "--set", "steps=[{name: press, increments: 20000}]"],
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        text = ""
        while '"increment":2,' not in text.replace(" ", ""):
            line = process.stdout.readline()
            self.assertTrue(line, text)
            text += line
        for number in signals:
            process.send_signal(number)
        text += process.stdout.read()
        process.stdout.close()
        return process.wait(support.PATIENCE), text

    def test_sigterm_before_the_first_increment_ends_it_within_a_stage(self):
        """A super-element without symmetry that takes seconds."""
        (self.directory / "model.yaml").write_text("""scabo: 1
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies: {plate: {material: steel, shape: {polygon: {vertices: [[0, 0], [2, 0], [1.9, 1.1], [0.2, 0.9]]}}, mesh: {size: 0.009}}}
supports: [{on: plate.edge_1, fix: [x, y]}]
loads: {pull: {on: plate.edge_3, traction: [0, 1]}}
""")
        process = subprocess.Popen([support.SCABO, "run", self.directory / "model.yaml", "--json-lines", "--quiet"],
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        text = ""
        while '"super-elements"' not in text:
            line = process.stdout.readline()
            self.assertTrue(line, text)
            text += line
        process.send_signal(signal.SIGTERM)
        text += process.stdout.read()
        process.stdout.close()
        self.assertEqual(process.wait(support.PATIENCE), 143)
        events = self.events(text)
        self.assertEqual([event["stage"] for event in self.of_kind(events, "stage_begin")][-1], "super-elements")
        self.assertEqual((events[-1]["status"], events[-1]["exit_status"]), ("interrupted", 143))
        summary = support.summary_of(self.directory / "model.results")
        self.assertEqual((summary["status"], summary["increments"]), ("interrupted", []))

    def test_sigterm_ends_it_with_a_last_event_and_resume_goes_on(self):
        status, text = self.interrupted(signal.SIGTERM)
        self.assertEqual(status, 143)
        events = self.events(text)
        self.assertEqual((events[-1]["status"], events[-1]["exit_status"]), ("interrupted", 143))
        process = subprocess.Popen([support.SCABO, "resume", self.directory / "results", "--json-lines", "--quiet"],
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        text = ""
        while '"increment_end"' not in text:
            text += process.stdout.readline()
        process.send_signal(signal.SIGTERM)
        text += process.stdout.read()
        process.stdout.close()
        self.assertEqual(process.wait(support.PATIENCE), 143)
        again = self.events(text)
        self.assertEqual(again[0]["command"], "resume")
        last = self.of_kind(events, "increment_end")[-1]["increment"]
        self.assertEqual(self.of_kind(again, "increment_begin")[0]["increment"], last + 1)

    def test_killed(self):
        status, text = self.interrupted(signal.SIGKILL)
        self.assertEqual(status, -signal.SIGKILL)
        self.events(text, whole=False)

    def test_a_reader_that_goes_away(self):
        process = subprocess.Popen([support.SCABO, "run", BEAM, "-o", self.directory / "results", "--json-lines", "--quiet",
                                    "--set", "steps=[{name: press, increments: 200}]"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        process.stdout.readline()
        process.stdout.close()
        self.assertEqual(process.stderr.read(), "")
        process.stderr.close()
        self.assertEqual(process.wait(support.PATIENCE), 0)
        self.assertEqual(len(support.summary_of(self.directory / "results")["increments"]), 200)


if __name__ == "__main__":
    support.main()
