"""Every broken model file through the program: bad_models_cli_test.py SCABO FOLDER.

Exit status 1 and the expected messages on standard error. Files with `# expect-later: text` pass the reader; `scabo run` must
end with a status of `# exit: 1|2` and that text. With sanitizers bad_models reads every file, in one process, and only some of
those that the reader refuses go through the program as well.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCABO = FOLDER = None
EVERY = 8 if "SCABO_SANITIZED" in os.environ else 1  # of the files that the reader refuses


def marked(text, mark):
    return [line[len(mark):].strip() for line in text.splitlines() if line.startswith(mark)]


def expected(file):
    """Messages, text found later (or None), allowed exit statuses."""
    sidecar = file.with_name(file.name + ".expect")
    if sidecar.exists():
        return sidecar.read_text(encoding="utf-8").splitlines(), None, [1]
    text = file.read_text(encoding="utf-8")
    later = marked(text, "# expect-later:")
    statuses = marked(text, "# exit:")
    return (marked(text, "# expect:"), later[0] if later else None,
            [int(status) for status in statuses[0].split("|")] if statuses else [1])


def sanitized(stderr):
    return "AddressSanitizer" in stderr or "runtime error:" in stderr


class BadModels(unittest.TestCase):
    def run_scabo(self, *arguments):
        """Finished process; fails when it hangs or dies of a signal."""
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([SCABO, *arguments], cwd=folder, capture_output=True, text=True,
                                  errors="replace", timeout=1200, env=dict(os.environ, LC_ALL="C"))
        self.assertGreaterEqual(done.returncode, 0, done.stderr)
        self.assertFalse(sanitized(done.stderr), done.stderr)
        return done

    def check_messages(self, command, file, messages):
        done = self.run_scabo(command, str(file))
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        for message in messages:
            place = f"{file}:" if message[0].isdigit() else f"{file}: "
            self.assertIn(place + message, done.stderr)
        self.assertEqual(done.stderr.count(str(file)), len(messages), done.stderr)

    def test_every_file(self):
        files = sorted(FOLDER.glob("*.yaml"))
        self.assertGreaterEqual(len(files), 80)
        for number, file in enumerate(files):
            messages, later, statuses = expected(file)
            with self.subTest(file=file.name):
                if later is None:
                    if number % EVERY == 0:
                        self.check_messages("run" if number // EVERY % 2 else "check", file, messages)
                    continue
                done = self.run_scabo("run", str(file), "-o", "results")
                self.assertIn(done.returncode, statuses, done.stdout + done.stderr)
                self.assertIn(later, done.stderr)
                if statuses == [1]:
                    self.assertEqual(done.stderr.count(later), 1, done.stderr)

    def test_files_that_are_no_model(self):
        with tempfile.TemporaryDirectory() as folder:
            missing = pathlib.Path(folder, "missing.yaml")
            for file, reason in [(missing, "no such file"), (pathlib.Path(folder), "is a directory")]:
                for command in ("run", "check"):
                    with self.subTest(file=str(file), command=command):
                        done = self.run_scabo(command, str(file))
                        self.assertEqual(done.returncode, 1, done.stderr)
                        self.assertIn(f"{file}: {reason}", done.stderr)

    def test_overrides(self):
        good = FOLDER.parent / "good" / "two_beams.yaml"
        for override, reason in [
            ("contacts.joint.friction=-1", "--set contacts.joint.friction: must be 0 or more, not -1"),
            ("contacts.joint.frictoin=1", "--set contacts.joint.frictoin: unknown key 'frictoin'"),
            ("contacts.jiont.friction=1", "--set contacts.jiont.friction: contacts has no 'jiont' "
                                          "(did you mean 'joint'?)"),
            ("supports.2.fix=x", "--set supports.2.fix: supports is a list: write a number from 0 to 1, not '2'"),
            ("loads.tip.force=[0, nan]", "--set loads.tip.force.1: must be a finite number, not 'nan'"),
            ("loads.tip.force=[0, 1", "--set loads.tip.force: not valid YAML"),
            ("no_value", "'no_value' has no '='"),
        ]:
            with self.subTest(override=override):
                done = self.run_scabo("check", str(good), "--set", override)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn(reason, done.stderr)

    def test_options_are_of_the_program_not_of_a_file(self):
        good = str(FOLDER.parent / "good" / "two_beams.yaml")
        for words in (["check", good, "--set", "no_value"], ["check", good, "--set", "=1"], ["sweep", good, "--vary", "contacts.joint.friction"]):
            with self.subTest(words=words):
                done = self.run_scabo(*words)
                self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
                self.assertTrue(done.stderr.startswith(f"scabo: {words[2]}: '"), done.stderr)
        done = self.run_scabo("run", good, "--json-lines", "--set", "no_value")
        errors = [json.loads(line) for line in done.stdout.splitlines() if '"error"' in line]
        self.assertEqual([error["file"] for error in errors], [None])
        self.assertIn("--set: 'no_value'", errors[0]["text"])


if __name__ == "__main__":
    SCABO = os.path.abspath(sys.argv[1])
    FOLDER = pathlib.Path(sys.argv[2]).resolve()
    unittest.main(argv=sys.argv[:1])
