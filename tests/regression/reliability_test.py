"""What a run does when the machine denies it something: memory, streams, a directory, the disk; and when it is told to end."""
import importlib.util
import os
import pathlib
import resource
import signal
import subprocess
import unittest

import support
from support import BEAM, rows_of, scabo, summary_of

SOLVED, WRONG_INPUT, FAILURE = 0, 1, 3
LOADER = 127  # of the system, where shared libraries do not fit: before the program begins
LONG = 240  # seconds that no test needs, also on a busy machine

LONG_RUN = ("--set", "steps=[{name: press, increments: 100000}]")


def limited(kind, value):
    return lambda: resource.setrlimit(kind, (value, value))


def run(*arguments, before=None, **options):
    return subprocess.run([support.SCABO, *map(str, arguments)], preexec_fn=before, stdin=subprocess.DEVNULL, text=True,
                          timeout=LONG, **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options})


def has_matplotlib():
    return importlib.util.find_spec("matplotlib") is not None


@unittest.skipIf("SCABO_SANITIZED" in os.environ, "the address sanitizer reserves terabytes of address space")
class Memory(support.InTemporaryDirectory):
    def test_every_limit_ends_with_success_or_a_sentence(self):
        solved = []
        # What has no room for the program itself, 43 MB, the system ends.
        for kilobytes in [50_000, 80_000, *range(90_000, 320_000, 15_000), 350_000, 450_000, 700_000, 1_000_000]:
            with self.subTest(kilobytes=kilobytes):
                ended = run("run", BEAM, "-q", "-o", self.directory / "out",
                            before=limited(resource.RLIMIT_AS, kilobytes * 1024))
                self.assertIn(ended.returncode, (SOLVED, FAILURE, LOADER), ended.stderr)
                if ended.returncode == FAILURE:
                    self.assertRegex(ended.stderr, r"^scabo: not enough memory.*\n$")
                elif ended.returncode == LOADER:
                    self.assertIn("error while loading shared libraries", ended.stderr)
                    self.assertFalse(solved)
                else:
                    solved.append(kilobytes)
        self.assertIn(1_000_000, solved)

    def test_a_model_that_is_too_large_says_so(self):
        # Several times: whether BLAS asked for a buffer after the matrices had taken all memory depended on the threads.
        for kilobytes in 2 * [350_000, 500_000, 600_000]:
            with self.subTest(kilobytes=kilobytes):
                ended = run("run", BEAM, "-q", "-o", self.directory / "out", "--set", "bodies.lower.mesh.size=0.01",
                            "--set", "bodies.upper.mesh.size=0.01", before=limited(resource.RLIMIT_AS, kilobytes * 1024))
                self.assertEqual(ended.returncode, FAILURE, ended.stderr)
                self.assertRegex(ended.stderr, r"^scabo: not enough memory.*coarser.*\n$")
                summary = summary_of(self.directory / "out")
                self.assertEqual((summary["status"], summary["increments"]), ("failed", []))
                self.assertIn("not enough memory", summary["reason"])

    def test_a_wall_is_solved_where_a_path_has_no_memory(self):
        # Near its limit load the path needs 120 MB more than interior points, which then follow.
        wall = BEAM.parent.parent / "14_wall" / "model.yaml"
        ended = run("run", wall, "-q", "-o", self.directory / "out", before=limited(resource.RLIMIT_AS, 370_000 * 1024),
                    env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
        self.assertEqual(ended.returncode, SOLVED, ended.stderr)


    @unittest.skipUnless(has_matplotlib(), "needs Matplotlib")
    def test_pictures_end_with_a_sentence(self):
        # NumPy's OpenBLAS waited for ever for the buffer that its first product needs.
        results = self.directory / "out"
        run("run", BEAM, "-q", "-o", results)
        for kilobytes in (240_000, 247_000, 254_000, 261_000, 268_000):
            with self.subTest(kilobytes=kilobytes):
                ended = run("plot", results, "--what", "stress", before=limited(resource.RLIMIT_AS, kilobytes * 1024))
                self.assertIn(ended.returncode, (SOLVED, FAILURE), ended.stderr)
                if ended.returncode == FAILURE:
                    self.assertRegex(ended.stderr, r"^scabo( plot)?: not enough memory.*\n$")


class Streams(support.InTemporaryDirectory):
    def shell(self, command):
        """`command` in a shell where $SCABO is the program; its exit status is that of the program."""
        return subprocess.run(["bash", "-c", "set -o pipefail; " + command], cwd=self.directory, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=LONG,
                              env={**os.environ, "SCABO": support.SCABO, "BEAM": str(BEAM)})

    def files(self, name):
        return {path.name: path.read_bytes() for path in (self.directory / name).iterdir()
                if path.suffix in (".csv", ".vtu", ".pvd")}

    def test_closed_streams_put_nothing_into_files(self):
        self.assertEqual(self.shell('"$SCABO" run "$BEAM" -o whole').returncode, SOLVED)
        for closing in (">&-", "2>&-", "<&-", ">&- 2>&-", "<&- >&- 2>&-"):
            with self.subTest(closing=closing):
                ended = self.shell(f'"$SCABO" run "$BEAM" -o out {closing}')
                self.assertEqual(ended.returncode, SOLVED, ended.stderr)
                self.assertEqual(self.files("out"), self.files("whole"))
                self.assertEqual(summary_of(self.directory / "out")["status"], "solved")

    @unittest.skipUnless(has_matplotlib(), "needs Matplotlib")
    def test_pictures_and_pages_are_files(self):
        self.shell('"$SCABO" run "$BEAM" -q -o out')
        page = (pathlib.Path(support.SCABO).resolve().parents[1] / "share/scabo/report_template.html").exists()
        for command in ("plot out -o out.png --what contact", *(["report out -o out.html"] if page else [])):
            file = self.directory / command.split()[3]
            for streams in (">&-", ">/dev/full", ">&- 2>&-", ">/dev/full 2>/dev/full", "| true", "2>&1 | true"):
                with self.subTest(command=command, streams=streams):
                    file.unlink(missing_ok=True)
                    ended = self.shell(f'"$SCABO" {command} {streams}')
                    self.assertEqual(ended.returncode, SOLVED, ended.stderr)
                    self.assertRegex(ended.stderr, r"^(scabo \w+: warning: cannot write to standard output: .* complete\n)?$")
                    self.assertGreater(file.stat().st_size, 1000)

    def test_a_text_that_is_the_answer_must_be_written(self):
        for command in ('schema', 'check "$BEAM"', 'exponents "$BEAM"', '--version', '--help', 'run --help'):
            for full in (">&-", ">/dev/full"):
                with self.subTest(command=command, full=full):
                    ended = self.shell(f'"$SCABO" {command} {full}')
                    self.assertEqual(ended.returncode, FAILURE)
                    self.assertIn("cannot write to standard output", ended.stderr)

    def test_errors_keep_their_status_without_a_standard_error(self):
        self.assertEqual(self.shell('"$SCABO" check no_such.yaml 2>&-').returncode, WRONG_INPUT)
        self.assertEqual(self.shell('"$SCABO" check no_such.yaml 2>/dev/full').returncode, WRONG_INPUT)

    def test_a_reader_that_has_gone_ends_no_run(self):
        for pipe in ("| true", "2>&1 | head -1"):
            with self.subTest(pipe=pipe):
                ended = self.shell(f'"$SCABO" run "$BEAM" -o out --set "steps=[{{name: press, increments: 20}}]" {pipe}')
                self.assertEqual(ended.returncode, SOLVED, ended.stderr)
                summary = summary_of(self.directory / "out")
                self.assertEqual((summary["status"], len(summary["increments"])), ("solved", 20))

    def test_a_full_screen_file_is_a_warning_of_a_run(self):
        ended = self.shell('"$SCABO" run "$BEAM" -o out > /dev/full')
        self.assertEqual(ended.returncode, SOLVED)
        self.assertIn("warning: cannot write to standard output", ended.stderr)


class LongRuns(support.InTemporaryDirectory):
    def start(self, *arguments, before=None):
        """A run of very many increments, some of which are finished."""
        process = subprocess.Popen([support.SCABO, "run", str(BEAM), "-o", str(self.directory / "out"), *LONG_RUN,
                                    *map(str, arguments)],
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   preexec_fn=before)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(lambda: process.poll() is None and process.kill())
        for line in process.stderr:
            if line.startswith("increment 3 of"):
                return process
        self.fail(f"ended by itself with {process.wait()}")

    def assert_readable(self):
        """Whole rows, and totals of no increment that has none."""
        directory = self.directory / "out"
        for name in ("contact.csv", "convergence.csv"):
            text = (directory / name).read_text()
            self.assertTrue(text.endswith("\n"), name)
            columns = {line.count(",") for line in text.splitlines()}
            self.assertEqual(len(columns), 1, name)
        numbers = [increment["increment"] for increment in summary_of(directory)["increments"]]
        self.assertEqual(numbers, list(range(1, len(numbers) + 1)))
        return numbers

    def test_the_end_of_the_terminal_keeps_what_is_finished(self):
        process = self.start()
        process.send_signal(signal.SIGHUP)
        process.send_signal(signal.SIGHUP)  # shell and system send one each
        _, errors = process.communicate(timeout=LONG)
        self.assertEqual(process.returncode, 128 + signal.SIGHUP, errors)
        numbers = self.assert_readable()
        self.assertGreaterEqual(len(numbers), 3)
        self.assertEqual(summary_of(self.directory / "out")["status"], "interrupted")
        self.assertEqual(sorted({int(row["increment"]) for row in rows_of(self.directory / "out")}), numbers)

    def test_the_summary_is_valid_at_every_moment(self):
        process = self.start()
        for _ in range(200):
            self.assertEqual(summary_of(self.directory / "out")["status"], "running")
        process.kill()
        process.communicate(timeout=LONG)
        self.assert_readable()
        self.assertEqual(summary_of(self.directory / "out")["status"], "running")

    def test_the_summary_is_there_while_an_earlier_run_is_removed(self):
        out = self.directory / "out"
        self.assertEqual(run("run", BEAM, "-q", "-o", out).returncode, SOLVED)
        fields = (out / "fields_0001.vtu").read_bytes()[:5000]
        for number in range(2, 4000):
            (out / f"fields_{number:04}.vtu").write_bytes(fields)
        process = subprocess.Popen([support.SCABO, "run", str(BEAM), "-q", "-o", str(out)], stdin=subprocess.DEVNULL)
        states = set()
        while process.poll() is None:
            states.add(summary_of(out)["status"])
        self.assertEqual(process.returncode, SOLVED)
        self.assertLessEqual(states, {"solved", "running"})
        self.assertEqual(len(list(out.glob("fields_*.vtu"))), 1)

    def test_the_second_run_in_a_directory_is_told(self):
        self.start()
        second = scabo("run", BEAM, "-o", self.directory / "out")
        self.assertEqual((second.returncode, second.stdout), (FAILURE, ""))
        self.assertRegex(second.stderr, r"^scabo: cannot write results to .*out: another run is writing there.*\n$")
        self.assert_readable()

    def test_a_killed_run_blocks_nobody(self):
        process = self.start()
        process.kill()
        process.communicate(timeout=LONG)
        ended = scabo("run", BEAM, "-o", self.directory / "out")
        self.assertEqual(ended.returncode, SOLVED, ended.stderr)

    def test_a_limit_on_files_keeps_what_is_finished(self):
        """As on a full disk: writing fails from some increment on, of which nothing is left."""
        for kilobytes, fields in ((40, True), (40, False), (100, False)):
            with self.subTest(kilobytes=kilobytes, fields=fields):
                ended = run("run", BEAM, "-q", "-o", self.directory / "out", *LONG_RUN,
                            *(() if fields else ("--set", "output={fields: []}")),
                            before=limited(resource.RLIMIT_FSIZE, kilobytes * 1024))
                self.assertEqual(ended.returncode, FAILURE)
                self.assertRegex(ended.stderr, rf"^scabo: cannot write .*{'fields_0001.vtu' if fields else ''}: File too large\n$")
                numbers = self.assert_readable()
                self.assertEqual(summary_of(self.directory / "out")["status"], "failed")
                in_table = sorted({int(row["increment"]) for row in rows_of(self.directory / "out")})
                self.assertEqual(in_table[:len(numbers)], numbers)
                self.assertEqual(len(numbers) >= 1, not fields)
                self.assertEqual([path.name for path in (self.directory / "out").glob("*.part")], [])

    def test_a_limit_that_the_motion_of_a_mechanism_meets(self):
        (self.directory / "block.yaml").write_text("""
scabo: 1
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}}
  block: {material: steel, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.1}}
supports: [{on: floor, fix: [x, y]}]
loads: {push: {on: block.top, traction: [4e6, -10e6]}}
contacts: {base: {between: [floor.top, block.bottom], friction: 0.3}}
""")
        ended = run("run", self.directory / "block.yaml", "-q", "-o", self.directory / "out", before=limited(resource.RLIMIT_FSIZE, 8 * 1024))
        self.assertEqual(ended.returncode, FAILURE, ended.stderr)
        self.assertRegex(ended.stderr, r"^scabo: cannot write .*mechanism.vtu.*: File too large\n$")
        self.assertEqual([path.name for path in (self.directory / "out").glob("mechanism*")], [])
        self.assertEqual(summary_of(self.directory / "out")["status"], "failed")

    def test_a_limit_that_the_contact_problems_meet(self):
        ended = run("run", BEAM, "-q", "-o", self.directory / "out", "--set", "output={discrete_problems: true}",
                    before=limited(resource.RLIMIT_FSIZE, 30 * 1024))
        self.assertEqual(ended.returncode, FAILURE, ended.stderr)
        self.assertRegex(ended.stderr, r"^scabo: cannot write .*problems/press_1.hdf5: File too large\n$")


class Places(support.InTemporaryDirectory):
    def test_places_that_cannot_be(self):
        (self.directory / "loop").symlink_to("loop")
        (self.directory / "nowhere").symlink_to("gone")
        (self.directory / "file").write_text("mine")
        for place, status, text in (("", WRONG_INPUT, "--output: is empty: give a value"),
                                    ("loop", FAILURE, "form a loop"), ("loop/out", FAILURE, "form a loop"),
                                    ("nowhere", FAILURE, "a directory that does not exist"),
                                    ("n" * 300, FAILURE, "name is too long"), ("a/" * 3000, FAILURE, "name is too long"),
                                    ("file", FAILURE, "it is a file, not a directory"),
                                    ("file/out", FAILURE, "is a file, not a directory")):
            with self.subTest(place=place[:20]):
                ended = scabo("run", BEAM, "-o", place, cwd=self.directory)
                self.assertEqual((ended.returncode, ended.stdout), (status, ""), ended.stderr)
                self.assertIn(text, ended.stderr)
                self.assertEqual(len(ended.stderr.splitlines()), 1, ended.stderr)
        self.assertEqual((self.directory / "file").read_text(), "mine")

    def test_files_that_cannot_be_read(self):
        (self.directory / "loop").symlink_to("loop")
        for path, text in (("loop", "form a loop"), ("loop/part", "form a loop"), ("n" * 300, "the name is too long")):
            for command in ("run", "check", "exponents", "resume", "contact", "convert", "report",
                            *(["plot"] if has_matplotlib() else [])):
                with self.subTest(command=command, path=path[:10]):
                    ended = scabo(command, path, cwd=self.directory)
                    self.assertEqual((ended.returncode, ended.stdout), (WRONG_INPUT, ""), ended.stderr)
                    self.assertRegex(ended.stderr, rf"^(scabo \w+: )?{path}:.* {text}\n$")

    def test_model_files_that_cannot_be(self):
        (self.directory / "loop.yaml").symlink_to("loop.yaml")
        for name, text in (("loop.yaml", "form a loop"), ("n" * 300 + ".yaml", "name is too long")):
            with self.subTest(name=name[:20]):
                ended = scabo("check", name, cwd=self.directory)
                self.assertEqual((ended.returncode, ended.stdout), (WRONG_INPUT, ""))
                self.assertIn(text, ended.stderr)


class LargeFiles(support.InTemporaryDirectory):
    """None may take minutes: each took a multiple of the limit here when its time grew with the square of its length."""

    def check(self, text):
        (self.directory / "model.yaml").write_text(text)
        return run("check", self.directory / "model.yaml")

    def test_many_mistakes_are_counted(self):
        ended = self.check("scabo: 1\n" + "".join(f"frictoin_{i}: 1\n" for i in range(200_000)))
        self.assertEqual(ended.returncode, WRONG_INPUT)
        self.assertEqual(len(ended.stderr.splitlines()), 201)
        self.assertIn("and 199800 more mistakes", ended.stderr)

    def test_a_text_without_end(self):
        for text in ('title: "' + "a" * 20_000_000 + '"\n', "title: " + "a b, " * 4_000_000 + "\n",
                     "title: |\n" + "  text\n" * 3_000_000, "# note\n" * 3_000_000, "title: {" + "a" * 5_000_000):
            with self.subTest(text=text[:12]):
                ended = self.check("scabo: 1\n" + text + "bodies: {}\n")
                self.assertEqual(ended.returncode, WRONG_INPUT)
                self.assertRegex(ended.stderr, r"^.*model\.yaml:\d:\d+: more than 1 MB of text or comment follow here")

    def test_many_names(self):
        count = 12_000
        model = ["scabo: 1", "materials:", *(f"  m{i}: {{young: 1e9, poisson: 0.2}}" for i in range(count)), "bodies:"]
        model += [f"  b{i}: {{material: m{i}, shape: {{rectangle: {{corner: [{2 * i}, 0], size: [1, 1]}}}}, mesh: {{size: 1}}}}"
                  for i in range(count)]
        model += ["supports:", *(f"  - {{on: b{i}.bottom, fix: [x, y], name: s{i}}}" for i in range(count))]
        model += ["loads:", *(f"  l{i}: {{on: b{i}.top, traction: [0, -1]}}" for i in range(count))]
        model += ["steps:", "- loads:", *(f"    l{i}: 1" for i in range(count))]
        ended = self.check("\n".join(model) + "\n")
        self.assertEqual((ended.returncode, ended.stderr), (SOLVED, ""))
        self.assertIn(f"{count} bodies", ended.stdout)

    def test_many_supports_of_one_body(self):
        supports = "".join(f"  - {{on: {{body: a, near: [{i * 1e-5}, 0]}}, fix: y}}\n" for i in range(20_000))
        again = "".join("  - {on: a.left, fix: [x, y]}\n" for i in range(20_000))
        model = ("scabo: 1\nmaterials: {m: {young: 1e9, poisson: 0.2}}\nbodies:\n  a: {material: m, shape: {rectangle: "
                 "{corner: [0, 0], size: [1, 1]}}, mesh: {size: 0.1}}\nsupports:\n" + supports + again + "%s"
                 "loads: {l: {on: a.top, traction: [0, -1]}}\n")
        ended = self.check(model % "")
        self.assertEqual((ended.returncode, ended.stderr), (SOLVED, ""))
        ended = self.check(model % "  - {on: a.bottom_left, displacement: [1, null]}\n")
        self.assertEqual(ended.returncode, WRONG_INPUT)
        self.assertIn("prescribes another x of a.bottom_left than the support of a.left in line 20006", ended.stderr)


if __name__ == "__main__":
    support.main()
