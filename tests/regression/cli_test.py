"""The manners of the program: exit statuses, messages, --set, --quiet, pipes and terminals, interruption."""
import json
import os
import pty
import re
import signal
import stat
import subprocess
import xml.etree.ElementTree

import support
from support import BEAM, ROOT, rows_of, scabo, summary_of

SOLVED, WRONG_INPUT, NOT_CONVERGED, FAILURE = 0, 1, 2, 3


class CommandLine(support.InTemporaryDirectory):
    def test_version_is_the_projects(self):
        version = re.search(r"project\(scabo VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
        for word in ("--version", "-V"):
            run = scabo(word)
            self.assertEqual((run.returncode, run.stdout, run.stderr), (SOLVED, f"scabo {version}\n", ""))

    def test_help(self):
        for command, words in {"": ("run", "check", "contact", "schema", "Exit status"),
                               "contact": ("FILE", "--solver", "b_differentiable", "--tolerance", "--json", "--uniqueness", "--trace", "Example"),
                               "run": ("MODEL", "--output", "--set", "--threads", "--quiet", "Example"),
                               "check": ("MODEL", "--set", "Example"),
                               "new": ("KIND", "beam, dam, wall", "part3d"), "plot": ("--what", "convergence, mesh", "spectrum"),
                               "schema": ("Example",)}.items():
            with self.subTest(command=command):
                run = scabo(*filter(None, [command]), "--help")
                self.assertEqual((run.returncode, run.stderr), (SOLVED, ""))
                for word in words:
                    self.assertIn(word, run.stdout)
                again = scabo("help", *filter(None, [command]))
                self.assertEqual((again.returncode, again.stdout, again.stderr), (SOLVED, run.stdout, ""))

    def test_wrong_command_lines_are_wrong_input_and_name_the_help(self):
        for arguments in ([], ["solve"], ["run"], ["run", BEAM, "--colour"], ["run", BEAM, "--threads", "0"],
                          ["run", BEAM, "--threads", "-2"], ["run", BEAM, "--threads", "many"],
                          ["run", BEAM, "--set"], ["run", BEAM, "other.yaml"], ["check"], ["schema", "x"]):
            with self.subTest(arguments=arguments):
                run = scabo(*arguments, cwd=self.directory)
                self.assertEqual((run.returncode, run.stdout), (WRONG_INPUT, ""))
                self.assertRegex(run.stderr, r"^scabo: .* \(see `scabo.* --help`\)\n$")

    def test_empty_names_are_not_taken_for_none(self):
        for arguments, name in [(["run", ""], "MODEL"), (["check", ""], "MODEL"), (["run", BEAM, "-o", ""], "--output"),
                                (["sweep", BEAM, "--vary", "contacts.joint.friction=0.1,0.2", "-o", ""], "--output"),
                                (["new", "beam", "-o", ""], "--output"), (["plot", ""], "DIR"), (["plot", "x", "-o", ""], "--output"),
                                (["report", "x", "-o", ""], "--output"), (["contact", "problem.hdf5", "--save", ""], "--save"),
                                (["resume", ""], "DIR"), (["run", BEAM, "--set", ""], "--set")]:
            with self.subTest(arguments=arguments):
                run = scabo(*arguments, cwd=self.directory)
                self.assertEqual((run.returncode, run.stdout), (WRONG_INPUT, ""))
                self.assertRegex(run.stderr, rf"^scabo: {name}: is empty: .* \(see `scabo {arguments[0]} --help`\)\n$")
                self.assertEqual(list(self.directory.iterdir()), [])

    def test_numbers_out_of_range_say_what_they_may_be(self):
        for option, value, message in [
            ("--threads", "0", "must be a whole number from 1 to 1024, not '0'"),
            ("--threads", "many", "must be a whole number from 1 to 1024, not 'many'"),
            ("--threads", "1.5", "must be a whole number from 1 to 1024, not '1.5'"),
            ("--divide-from", "-1", "must be 0 or a larger number, not '-1'"),
        ]:
            with self.subTest(option=option, value=value):
                run = scabo("run", BEAM, f"{option}={value}", cwd=self.directory)
                self.assertEqual((run.returncode, run.stderr), (WRONG_INPUT, f"scabo: {option}: {message} (see `scabo run --help`)\n"))
        for option, value, message in [
            ("--time-limit", "0", "must be a number greater than 0, not '0'"),
            ("--time-limit", "inf", "must be a number greater than 0, not 'inf'"),
            ("--tolerance", "1e-30", "must be a number from 1e-15 to 0.1, not '1e-30'"),
            ("--iterations", "0", "must be a whole number from 1 to 100000000, not '0'"),
        ]:
            with self.subTest(option=option, value=value):
                run = scabo("contact", "no.dat", option, value, cwd=self.directory)
                self.assertEqual((run.returncode, run.stderr), (WRONG_INPUT, f"scabo: {option}: {message} (see `scabo contact --help`)\n"))

    def test_schema_is_json(self):
        run = scabo("schema")
        self.assertEqual((run.returncode, run.stderr), (SOLVED, ""))
        self.assertIn("$schema", json.loads(run.stdout))

    def test_output_that_cannot_be_written_is_a_failure(self):
        with open("/dev/full", "w") as full:
            run = subprocess.run([support.SCABO, "schema"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(run.returncode, FAILURE)
        self.assertIn("cannot write to standard output", run.stderr)


class Rounding(support.InTemporaryDirectory):
    def test_forces_that_are_rounding_are_shown_as_zero(self):
        """A disc that its support moves without stress."""
        (self.directory / "disc.yaml").write_text("""
scabo: 1
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies:
  disc: {material: steel, shape: {circle: {centre: [0, 1], radius: 1}}, mesh: {size: 0.3}}
  floor: {rigid: true, shape: {rectangle: {corner: [-2, -1], size: [4, 1]}}}
supports:
  - {on: floor, fix: [x, y]}
  - {on: {body: disc, near: [0, 2]}, displacement: [0, -0.0001], name: push}
contacts: {base: {between: [disc.rim, floor.top]}}
""")
        run = scabo("run", "disc.yaml", cwd=self.directory)
        self.assertEqual(run.returncode, SOLVED, run.stderr)
        self.assertRegex(run.stdout, r"\n  push +0 +0\n")


class Input(support.InTemporaryDirectory):
    def test_missing_file(self):
        for command in ("run", "check"):
            run = scabo(command, "no_such.yaml", cwd=self.directory)
            self.assertEqual((run.returncode, run.stdout), (WRONG_INPUT, ""))
            self.assertIn("no_such.yaml", run.stderr)
            self.assertEqual(list(self.directory.iterdir()), [], "a results directory for nothing")

    def test_every_mistake_has_its_line_and_column(self):
        model = self.directory / "model.yaml"
        model.write_text(BEAM.read_text().replace("material: concrete", "material: concreet")
                         .replace("friction: 0.2", "friction: -1"))
        for command in ("run", "check"):
            run = scabo(command, "model.yaml", cwd=self.directory)
            self.assertEqual((run.returncode, run.stdout), (WRONG_INPUT, ""))
            lines = run.stderr.splitlines()
            self.assertEqual(len(lines), 3, run.stderr)
            for line in lines:
                self.assertRegex(line, r"^model\.yaml:\d+:\d+: [a-z_.]+: .+")
            self.assertIn("bodies.lower.material: there is no material named 'concreet' (did you mean 'concrete'?)",
                          lines[0])

    def test_set_replaces_a_value(self):
        for arguments in (["--set", "contacts.joint.friction=0.5", BEAM],
                          [BEAM, "--set", "title=Beams", "contacts.joint.friction=0.5"],
                          ["--set=contacts.joint.friction=0.5", BEAM]):
            with self.subTest(arguments=arguments):
                run = scabo("run", "-o", self.directory / "out", *arguments)
                self.assertEqual(run.returncode, SOLVED, run.stderr)
                joint = summary_of(self.directory / "out")["increments"][0]["contacts"]["joint"]
                self.assertAlmostEqual(abs(joint["tangential_force"]), 0.5 * joint["normal_force"], delta=1e-3)

    def test_bad_settings(self):
        for setting, word in {"friction": "=", "=0.5": "=", "contacts.joint.frictoin=0.5": "friction",
                              "contacts.joint.friction=-1": "friction",
                              "contacts.joint.friction=[": "friction"}.items():
            with self.subTest(setting=setting):
                run = scabo("run", BEAM, "--set", setting, "-o", self.directory / "out")
                self.assertEqual((run.returncode, run.stdout), (WRONG_INPUT, ""))
                self.assertIn(word, run.stderr)
                self.assertFalse((self.directory / "out").exists())

    def test_check_reports_sizes_and_writes_nothing(self):
        run = scabo("check", BEAM, cwd=self.directory)
        self.assertEqual((run.returncode, run.stderr), (SOLVED, ""))
        self.assertIn("2 bodies, 160 nodes, 320 degrees of freedom, 2 super-elements, 32 contact pairs", run.stdout)
        for word in ("lower", "upper", "joint", "press"):
            self.assertIn(word, run.stdout)
        self.assertEqual(list(self.directory.iterdir()), [])


class Output(support.InTemporaryDirectory):
    def test_default_directory_is_beside_the_model(self):
        model = self.directory / "deep" / "beam.yaml"
        model.parent.mkdir()
        model.write_text(BEAM.read_text())
        run = scabo("run", "deep/beam.yaml", cwd=self.directory)
        self.assertEqual(run.returncode, SOLVED, run.stderr)
        self.assertIn("deep/beam.results", run.stdout)
        files = {path.name for path in (self.directory / "deep" / "beam.results").iterdir()}
        self.assertLessEqual({"summary.json", "contact.csv", "convergence.csv", "convergence.svg", "fields.pvd", "log.txt"}, files)

    def test_piped_output_is_plain(self):
        run = scabo("run", BEAM, "-o", self.directory / "out", TERM="xterm-256color")
        self.assertEqual(run.returncode, SOLVED)
        for text in (run.stdout, run.stderr):
            self.assertNotIn("\r", text)
            self.assertNotIn("\033", text)
        self.assertIn("increment 1 of 1", run.stderr)
        self.assertIn("joint", run.stdout)

    def test_quiet_prints_nothing(self):
        run = scabo("run", BEAM, "-o", self.directory / "out", "--quiet")
        self.assertEqual((run.returncode, run.stdout, run.stderr), (SOLVED, "", ""))

    def test_quiet_still_prints_errors(self):
        run = scabo("run", "no_such.yaml", "--quiet", cwd=self.directory)
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("no_such.yaml", run.stderr)

    def test_terminal_line_is_rewritten_and_removed(self):
        text = self.on_terminal("run", BEAM, "-o", self.directory / "out", TERM="xterm")
        self.assertIn("\r\033[K", text)
        self.assertTrue(text.endswith("\r\033[K"), repr(text[-80:]))
        self.assertNotIn("\n", text)

    def test_no_color_is_honoured(self):
        colour = re.compile(r"\033\[[0-9;]*m")
        arguments = ("check", BEAM, "--set", "contacts.joint.friction=-1")
        self.assertRegex(self.on_terminal(*arguments, TERM="xterm", NO_COLOR=""), colour)
        self.assertNotRegex(self.on_terminal(*arguments, TERM="xterm", NO_COLOR="1"), colour)
        self.assertNotRegex(self.on_terminal(*arguments, TERM="dumb", NO_COLOR=""), colour)

    def on_terminal(self, *arguments, **environment):
        """Standard error of a run that has a terminal there."""
        main, terminal = pty.openpty()
        process = subprocess.Popen([support.SCABO, *map(str, arguments)], env={**os.environ, **environment},
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=terminal)
        os.close(terminal)
        text = b""
        try:
            while piece := os.read(main, 4096):
                text += piece
        except OSError:
            pass  # how Linux says that the other end of a terminal was closed
        os.close(main)
        process.wait(timeout=support.PATIENCE)
        return text.decode()

    def test_unwritable_directory_is_a_failure(self):
        file = self.directory / "file"
        file.write_text("")
        places = [file, file / "out"]
        locked = self.directory / "locked"
        locked.mkdir()
        locked.chmod(stat.S_IRUSR | stat.S_IXUSR)
        if not os.access(locked, os.W_OK):  # the superuser may write everywhere
            places.append(locked / "out")
        for place in places:
            with self.subTest(place=place.name):
                run = scabo("run", BEAM, "-o", place)
                self.assertEqual((run.returncode, run.stdout), (FAILURE, ""), run.stderr)
                self.assertRegex(run.stderr, rf"^scabo: .*{re.escape(str(place))}")


class NotConverged(support.InTemporaryDirectory):
    """A block that rests on another by contact alone is pressed down, then lifted: nothing holds it."""
    MODEL = """
scabo: 1
materials: {stone: {young: 1e9, poisson: 0.2}}
bodies:
  base: {material: stone, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.25}}
  block: {material: stone, shape: {rectangle: {corner: [0, 1], size: [2, 1]}}, mesh: {size: 0.25}}
supports: [{on: base.bottom, fix: [x, y]}]
loads: {push: {on: block.top, force: [0, -1000]}}
contacts: {joint: {between: [base.top, block.bottom], friction: 0.3}}
steps:
  - {name: press, increments: 2}
  - {name: lift, increments: 3, loads: {push: -1}}
"""

    def test_the_converged_increments_are_kept(self):
        (self.directory / "model.yaml").write_text(self.MODEL)
        run = scabo("run", "model.yaml", cwd=self.directory)
        self.assertEqual(run.returncode, NOT_CONVERGED, run.stderr)
        self.assertIn("scabo: step lift, increment 2: mechanism: body 'block': translation along (0, 1), held neither by "
                      "supports nor by contact and friction (3 finished increments kept)\n", run.stderr)
        results = self.directory / "model.results"
        self.assertIn("model.results", run.stdout)
        self.assertEqual(summary_of(results)["status"], "mechanism")
        self.assertIn("Not solved: step lift, increment 2: mechanism: body 'block': translation along (0, 1), held neither",
                      (results / "log.txt").read_text())
        increments = summary_of(results)["increments"]
        self.assertEqual([increment["converged"] for increment in increments], [True, True, True, False])
        self.assertEqual(sorted({(int(row["step"]), int(row["increment"])) for row in rows_of(results)}),
                         [(1, 1), (1, 2), (2, 1)])
        self.assertEqual(len(list(results.glob("fields_*.vtu"))), 3)

    def test_very_stiff_parts_beside_soft_ones(self):
        (self.directory / "model.yaml").write_text("""
scabo: 1
materials: {stiff: {young: 1e14, poisson: 0.3}, soft: {young: 1e6, poisson: 0.2}}
bodies:
  plate: {material: soft, sectors: {bottom: stiff, top: stiff}, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.1}}
supports: [{on: plate.left, fix: [x, y]}]
loads: {pull: {on: plate.right, traction: [1e3, 0]}}
""")
        run = scabo("run", "model.yaml", cwd=self.directory)
        self.assertEqual(run.returncode, SOLVED, run.stderr)
        reaction = summary_of(self.directory / "model.results")["increments"][0]["reactions"]["plate.left"]
        self.assertAlmostEqual(reaction[0], -1e3, delta=1e-6)  # 1e3 Pa on 1 m
        self.assertAlmostEqual(reaction[1], 0.0, delta=1e-6)

    def test_rounding_of_a_very_slender_body_is_told_with_its_remedy(self):
        (self.directory / "model.yaml").write_text("""
scabo: 1
materials: {steel: {young: 2e11, poisson: 0.3}}
bodies: {strip: {material: steel, shape: {rectangle: {corner: [0, 0], size: [1000, 1]}}, mesh: {size: 4}}}
supports: [{on: strip.left, fix: [x, y]}]
loads: {push: {on: strip.right, traction: [0, 1]}}
""")
        run = scabo("run", "model.yaml", cwd=self.directory)
        self.assertEqual(run.returncode, SOLVED, run.stderr)
        self.assertRegex(run.stderr, r"warning: .*rounding of the stiffness of body '\w+' may change its displacements by a part of "
                                     r"about [1-4]e-04: it is 1000 times as long as deep; mesh \{kind: fem\} is changed less")
        increment = summary_of(self.directory / "model.results")["increments"][0]
        self.assertAlmostEqual(increment["reactions"]["strip.left"][1], -1.0, delta=1e-10)

    def test_a_gap_that_no_load_can_close_is_named(self):
        """In other units than the bodies: the motion leaves no digits for the forces."""
        (self.directory / "model.yaml").write_text("""
scabo: 1
materials: {rubber: {young: 1e9, poisson: 0.25}}
bodies:
  base: {material: rubber, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 0.25}}
  block: {material: rubber, shape: {rectangle: {corner: [0, 1], size: [1, 1]}}, mesh: {size: 0.25}}
supports: [{on: base.bottom, fix: [x, y]}]
loads: {press: {on: block.top, pressure: 1e6}}
contacts: {joint: {between: [base.top, block.bottom], friction: 0.3, gap: 1}}
""")
        self.assertEqual(scabo("run", "model.yaml", cwd=self.directory).returncode, SOLVED)
        for gap in ("1e+09", "1e+60"):
            run = scabo("run", "model.yaml", "--quiet", "--set", f"contacts.joint.gap={gap}", cwd=self.directory)
            self.assertEqual(run.returncode, NOT_CONVERGED, run.stderr)
            self.assertIn(f"all pairs are open by {gap} or more at first", run.stderr)
            self.assertIn(": a smaller gap or a larger load is needed", run.stderr)
        run = scabo("run", "model.yaml", "--quiet", "--set", "contacts.joint.gap=-1e99", cwd=self.directory)
        self.assertEqual(run.returncode, NOT_CONVERGED, run.stderr)
        self.assertNotIn("(1 iterations)", run.stderr)

    def test_quiet_prints_the_reason_only(self):
        (self.directory / "model.yaml").write_text(self.MODEL)
        run = scabo("run", "model.yaml", "--quiet", cwd=self.directory)
        self.assertEqual((run.returncode, run.stdout), (NOT_CONVERGED, ""))
        self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)


class Interruption(support.InTemporaryDirectory):
    def start(self):
        """A run of very many increments, some of which are finished."""
        process = subprocess.Popen([support.SCABO, "run", str(BEAM), "-o", str(self.directory), "--set",
                                    "steps=[{name: press, increments: 100000}]"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(lambda: process.poll() is None and process.kill())
        for line in process.stderr:
            if line.startswith("increment 3 of"):
                return process
        self.fail(f"ended by itself with {process.wait()}")

    def test_finished_increments_are_readable(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=number.name):
                process = self.start()
                process.send_signal(number)
                out, err = process.communicate(timeout=support.PATIENCE)
                self.assertEqual(process.returncode, 128 + number, err)
                self.assertRegex(err, rf"interrupted; \d+ finished increments kept: go on with `scabo resume {self.directory}`")

                increments = summary_of(self.directory)["increments"]
                self.assertGreaterEqual(len(increments), 3)
                self.assertTrue(all(increment["converged"] for increment in increments))
                numbers = [increment["increment"] for increment in increments]
                self.assertEqual(numbers, list(range(1, len(increments) + 1)))
                self.assertEqual(sorted({int(row["increment"]) for row in rows_of(self.directory)}), numbers)
                sets = xml.etree.ElementTree.parse(self.directory / "fields.pvd").findall(".//DataSet")
                self.assertEqual(len(sets), len(increments))
                for data_set in sets:
                    self.assertGreater((self.directory / data_set.get("file")).stat().st_size, 0)

    def test_the_second_signal_ends_at_once(self):
        process = self.start()
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=support.PATIENCE)
        self.assertIn(process.returncode, (-signal.SIGINT, 128 + signal.SIGINT))


if __name__ == "__main__":
    support.main()
