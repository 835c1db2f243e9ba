"""`scabo exponents` on a closed super-element: Song's square (The SBFEM, 2018, example 3.1)."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)

MODEL = """
scabo: 1
materials: {m: {young: 10, poisson: 0}}
bodies:
  square: {material: m, shape: {rectangle: {corner: [-1, -1], size: [2, 2]}}, mesh: {size: 2, order: 1}}
supports: [{on: square.bottom, fix: [x, y]}]
loads: {pull: {on: square.top, pressure: -1}}
"""


def exponents(*arguments):
    with tempfile.TemporaryDirectory() as directory:
        path = os.path.join(directory, "square.yaml")
        with open(path, "w") as file:
            file.write(MODEL)
        return subprocess.run([PROGRAM, "exponents", path, *arguments], capture_output=True, text=True, check=True).stdout


class Exponents(unittest.TestCase):
    def test_json_has_the_published_numbers(self):
        square = json.loads(exponents("--json"))["square"]
        found = [(round(e["real"], 5), e["imaginary"], e["multiplicity"]) for e in square["exponents"]]
        self.assertEqual(found, [(0.0, 0.0, 2), (1.0, 0.0, 4), (1.91485, 0.0, 2)])
        self.assertEqual(square["exponents"][0]["meaning"], "translations")
        self.assertFalse(any(e["singular"] or e["defective"] for e in square["exponents"]))
        self.assertEqual((square["kind"], square["dofs"]), ("closed", 8))

    def test_table_names_the_body_and_the_rigid_motions(self):
        text = exponents()
        for word in ("square", "translations", "rotation", "1.91485"):
            self.assertIn(word, text)


if __name__ == "__main__":
    unittest.main()
