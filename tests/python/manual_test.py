"""The snippets of docs/python.md and of the README, run in their order, and the three tutorial programs."""
import os
import pathlib
import re
import subprocess
import sys
import unittest
import warnings

import matplotlib

from support import PATIENCE, ROOT, InTemporaryDirectory

matplotlib.use("Agg")
TUTORIALS = ROOT / "examples" / "python"


def snippets_of(file):
    """Line and text of every Python snippet of a page."""
    text = file.read_text(encoding="utf-8")
    return [(text[:match.start()].count("\n") + 2, match[1]) for match in re.finditer(r"^```python\n(.*?)^```", text, re.M | re.S)]


class Snippets(InTemporaryDirectory):
    def run_all(self, file, only=lambda text: True):
        """Those of one page share their names, as in a notebook, and a directory with the models that the page names."""
        count = 0
        before = os.getcwd()
        os.chdir(self.directory)
        self.addCleanup(os.chdir, before)
        (self.directory / "model.yaml").write_text((ROOT / "examples/01_double_cantilever/model.yaml").read_text())
        names = {"__name__": "snippet"}
        for line, text in snippets_of(file):
            if not only(text):
                continue
            count += 1
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                exec(compile("\n" * (line - 1) + text, str(file), "exec"), names)
        return count

    def test_manual(self):
        self.assertGreaterEqual(self.run_all(ROOT / "docs" / "python.md"), 10)

    def test_readme(self):
        self.assertGreaterEqual(self.run_all(ROOT / "README.md", lambda text: "import scabo" in text), 1)


class Tutorials(InTemporaryDirectory):
    def run_tutorial(self, name):
        done = subprocess.run([sys.executable, str(TUTORIALS / name)], text=True, capture_output=True, timeout=PATIENCE,
                              cwd=self.directory)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(list(self.directory.iterdir()), [])  # they leave nothing behind
        return done.stdout

    def test_beam(self):
        text = self.run_tutorial("1_beam.py")
        forces = re.findall(r"^ +0\.([025]) +([\d.]+) kN +(-?[\d.]+) kN", text, re.M)
        self.assertEqual([force[0] for force in forces], ["0", "2", "5"])
        for (_, normal, tangential), published in zip(forces, (0.0, 10.73, 26.82)):  # Zhu et al. 2017
            self.assertAlmostEqual(float(normal), 53.64, delta=0.01)
            self.assertAlmostEqual(abs(float(tangential)), published, delta=0.01)

    def test_hertz(self):
        rows = re.findall(r"^ +(0\.\d+) +(\d+) +([\d.]+) % +[\d.]+ MPa +(-?[\d.]+) %", self.run_tutorial("2_hertz.py"), re.M)
        self.assertEqual(len(rows), 3)
        for tolerance, _, error, _ in rows:
            self.assertLessEqual(float(error), 100 * float(tolerance))
        self.assertLess(abs(float(rows[-1][3])), 0.2)

    def test_own_contact(self):
        text = self.run_tutorial("3_own_contact.py")
        self.assertIn("normal force 20.000000 MN, tangential force -2.000000 MN", text)
        self.assertLess(float(re.search(r"model: ([\d.e+-]+) of the largest", text)[1]), 1e-9)


if __name__ == "__main__":
    unittest.main()
