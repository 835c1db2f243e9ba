"""The three tutorial programs. The snippets of docs/python.md and of the README are run by tests/docs."""
import re
import subprocess
import sys
import unittest

from support import PATIENCE, ROOT, InTemporaryDirectory

TUTORIALS = ROOT / "examples" / "python"


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
