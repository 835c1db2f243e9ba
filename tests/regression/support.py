"""What the tests of the program share. Standard library only."""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BEAM = ROOT / "examples" / "01_double_cantilever" / "model.yaml"
SCABO = None  # set by main()
PATIENCE = 1200  # seconds until a program counts as hung: a busy machine is slow, and no test judges speed


def scabo(*arguments, cwd=None, **environment):
    """Runs the program with its output piped; environment variables by name, None removes one."""
    variables = {key: value for key, value in {**os.environ, **environment}.items() if value is not None}
    return subprocess.run([SCABO, *map(str, arguments)], cwd=cwd, env=variables, text=True, capture_output=True,
                          stdin=subprocess.DEVNULL, timeout=PATIENCE)


def summary_of(directory):
    return json.loads((pathlib.Path(directory) / "summary.json").read_text(encoding="utf-8"))


def rows_of(directory):
    with open(pathlib.Path(directory) / "contact.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def certificate_of(increment):
    """The worst figure of an increment's certificate."""
    return max(value for value in increment["certificate"].values() if isinstance(value, (int, float)))


class InTemporaryDirectory(unittest.TestCase):
    """Each test gets an empty directory, self.directory."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="scabo_test_")
        self.addCleanup(holder.cleanup)
        self.directory = pathlib.Path(holder.name)


class OfExample(InTemporaryDirectory):
    """Of the example in `FOLDER`, whose README shows the pictures `PICTURES`."""
    FOLDER, PICTURES = "", ()

    def check(self):
        return json.loads((ROOT / "examples" / self.FOLDER / "check.json").read_text(encoding="utf-8"))

    def solve(self, *settings):
        arguments = [word for setting in settings for word in ("--set", setting)]
        run = scabo("run", ROOT / "examples" / self.FOLDER / "model.yaml", "-o", self.directory / "results", "--quiet", *arguments)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
        return summary_of(self.directory / "results")

    def draw(self):
        example = ROOT / "examples" / self.FOLDER
        run = subprocess.run([sys.executable, example / "figures.py", "--scabo", SCABO, "-o", self.directory],
                             cwd=self.directory, text=True, capture_output=True, timeout=PATIENCE)
        self.assertEqual(run.returncode, 0, run.stderr)
        for picture in self.PICTURES:
            self.assertTrue((self.directory / picture).read_bytes().startswith(b"\x89PNG"))
            self.assertTrue((example / "figures" / picture).exists(), "the README shows it")


def main():
    """Runs the tests of the calling script; its first argument is the program."""
    global SCABO
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        SCABO = str(pathlib.Path(sys.argv.pop(1)).resolve())
    else:
        SCABO = os.environ.get("SCABO")
    if not SCABO or not os.access(SCABO, os.X_OK):
        sys.exit(f"usage: {sys.argv[0]} SCABO_BINARY [unittest options]")
    unittest.main(module="__main__")
