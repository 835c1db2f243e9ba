"""What the tests of the program share. Standard library only."""
import contextlib
import csv
import io
import json
import os
import pathlib
import re
import runpy
import signal
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BEAM = ROOT / "examples" / "01_double_cantilever" / "model.yaml"
SCABO = None  # set by main()
SANITIZED = "SCABO_SANITIZED" in os.environ  # ten times slower: a sample of many like runs
LONG = "SCABO_LONG" in os.environ  # `make test-long`
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
    """Of the example in `FOLDER`."""
    FOLDER = ""

    def check(self):
        return json.loads((ROOT / "examples" / self.FOLDER / "check.json").read_text(encoding="utf-8"))

    def solve(self, *settings):
        arguments = [word for setting in settings for word in ("--set", setting)]
        run = scabo("run", ROOT / "examples" / self.FOLDER / "model.yaml", "-o", self.directory / "results", "--quiet", *arguments)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
        return summary_of(self.directory / "results")


class OfDrawnExample(OfExample):
    """Its figures.py has run, and the numbers are taken from the same results: they are in self.drawn_in."""

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="scabo_test_")
        cls.addClassCleanup(holder.cleanup)
        cls.drawn_in = pathlib.Path(holder.name)
        cls.printed = draw(cls.FOLDER, cls.drawn_in)

    def test_figures_are_drawn(self):
        check_pictures(self, self.FOLDER, self.drawn_in)

    def test_the_readme_states_the_numbers(self):
        check_stated_numbers(self, self.FOLDER, self.printed)


def draw(folder, directory):
    """Runs the figures.py of an example in this process, as importing Matplotlib takes longer than most pictures. Results and
    pictures go to `directory`. What it has printed."""
    example = ROOT / "examples" / folder
    before, arguments, path = pathlib.Path.cwd(), sys.argv, list(sys.path)
    sys.argv = ["figures.py", "--scabo", SCABO, "-o", str(directory)]
    sys.path.insert(0, str(example))  # as for a script
    for own in ("hand", "runs"):  # several examples have modules of these names
        sys.modules.pop(own, None)
    os.chdir(directory)
    try:
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            runpy.run_path(str(example / "figures.py"), run_name="__main__")
        return printed.getvalue()
    finally:
        os.chdir(before)
        sys.argv, sys.path[:] = arguments, path
        sys.modules["matplotlib.pyplot"].close("all")


# The numbers of a run in a README, and the same ones as figures.py prints them.
STATED = {
    "09_plate_with_hole": (r"\| (?:polygons|quadtree) \| ([\d,]+) \| ([\d,]+) \| ([\d.]+) \|",
                           r"(?:polygons|quadtree) +(\d+) +(\d+) +([\d.]+) "),
    "10_culvert": (r"(\d+), (\d+), (\d+) (?=\|)", r"(\d+) pairs open, (\d+) stick, (\d+) slip"),
    "12_hertz": (r"\| ([\d,]+) \| (\d+) \| (\d+) \| (-?[\d.]+) % \|",
                 r"(\d+) dofs, +(\d+) meshes, +(\d+) pairs in contact: largest pressure ([+-][\d.]+) %"),
    "14_wall": (r"\| (-?[\d.]+) \| ([\d.]+) \| (\d+), (\d+), (\d+) \| ([\d.]+) \|",
                r"reaction (-?[\d.]+), ([\d.]+) kN; open, stick, slip \[(\d+), (\d+), (\d+)\]; widest joint ([\d.]+) mm"),
}


def check_stated_numbers(test, folder, printed):
    """Those of the README agree with those of the run to half a unit of their last digit; on other processors, which round
    otherwise, counts may differ by one or a hundredth."""
    if folder not in STATED:
        return
    readme = (ROOT / "examples" / folder / "README.md").read_text(encoding="utf-8")
    stated, found = (re.findall(pattern, text) for pattern, text in zip(STATED[folder], (readme, printed)))
    test.assertTrue(found, printed)
    test.assertEqual(len(stated), len(found), f"{stated} beside {found}")
    for in_readme, of_run in zip(stated, found):
        for text, number in zip(in_readme, of_run, strict=True):
            value, decimals = float(text.replace(",", "")), len(text.partition(".")[2])
            slack = 0.51 * 10**-decimals if decimals or text.startswith("-") else max(1, 0.01 * value)
            test.assertAlmostEqual(value, float(number), delta=slack, msg=f"{in_readme} beside {of_run}")


def check_pictures(test, folder, directory):
    """Those in `directory` are the ones of the example, and its README shows them."""
    example = ROOT / "examples" / folder
    shown = sorted(picture.name for picture in (example / "figures").glob("*.png"))
    test.assertEqual(sorted(picture.name for picture in directory.glob("*.png")), shown)
    readme = (example / "README.md").read_text(encoding="utf-8")
    for name in shown:
        content = (directory / name).read_bytes()
        test.assertTrue(content.startswith(b"\x89PNG"), name)
        test.assertTrue(20_000 < len(content) < 500_000, f"{name}: {len(content)} bytes")
        test.assertIn(f"figures/{name}", readme)


def heed_signals():
    """Programs in the background (`nohup make test &`) inherit that they ignore SIGINT and SIGHUP, as the runs that the tests
    stop by a signal would."""
    for number in (signal.SIGINT, signal.SIGHUP, signal.SIGTERM):
        if signal.getsignal(number) == signal.SIG_IGN:
            signal.signal(number, signal.SIG_DFL)


def main():
    """Runs the tests of the calling script; its first argument is the program."""
    global SCABO
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        SCABO = str(pathlib.Path(sys.argv.pop(1)).resolve())
    else:
        SCABO = os.environ.get("SCABO")
    if not SCABO or not os.access(SCABO, os.X_OK):
        sys.exit(f"usage: {sys.argv[0]} SCABO_BINARY [unittest options]")
    heed_signals()
    unittest.main(module="__main__")
