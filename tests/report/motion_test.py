"""The report of a run in time in headless Chromium: the slider says the times, the values at a point are those of the program at these times, and
the motion plays.

Skipped where there is no Chromium or where the page was not built (no Node.js, no npm)."""
import csv
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "regression"))
import support
from in_browser import InBrowser

MODEL = """scabo: 1
analysis: {plane: stress}
materials: {rubber: {young: 1e6, poisson: 0.3, density: 1000}}
bodies: {block: {material: rubber, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 0.25}}}
supports: [{on: block.bottom, fix: [x, y]}]
curves: {quake: {sine: {amplitude: 5, periods: 2}}}
steps: [{name: shake, dynamic: {duration: 0.4, step: 2e-3, ground: {x: quake}}, increments: 40}]
output: {points: [{at: [1, 1], name: corner}]}
"""
INCREMENTS = (3, 17, 40)


class Motion(InBrowser):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.folder / "shaken.yaml").write_text(MODEL, encoding="utf-8")
        for arguments in (("run", "shaken.yaml", "-q"), ("report", "shaken.results", "-o", "shaken.html")):
            run = support.scabo(*arguments, cwd=cls.folder, SCABO_PYTHON=sys.executable)
            assert run.returncode == 0, run.stderr
        cls.picture = pathlib.Path(os.environ.get("SCABO_PICTURE", cls.folder / "motion.png"))
        cls.seen = cls.drive("motion.mjs", cls.folder / "shaken.html", {"increments": INCREMENTS, "at": [1, 1], "until": 8}, cls.picture)

    def test_values_are_those_of_the_program_at_these_times(self):
        with open(self.folder / "shaken.results" / "points.csv", newline="", encoding="utf-8") as file:
            rows = {int(row["increment"]): row for row in csv.DictReader(file)}
        largest = max(abs(float(row["ux"])) for row in rows.values())
        for number, at in zip(INCREMENTS, self.seen["values"]):
            self.assertIn(f"time {0.01 * number:.4g}: increment {number} of 40, step shake", at["name"])
            for key in ("ux", "uy"):
                self.assertAlmostEqual(at[key], float(rows[number][key]), delta=2e-6 * largest)
        self.assertGreater(max(abs(at["ux"] - self.seen["values"][0]["ux"]) for at in self.seen["values"]), 0.1 * largest)

    def test_the_motion_plays_and_stops(self):
        self.assertEqual((self.seen["pressed"], self.seen["stopped"]), ("true", "false"))
        self.assertGreater(self.picture.stat().st_size, 20000)

    def test_there_are_no_errors(self):
        self.assertEqual(self.seen["errors"], [])


if __name__ == "__main__":
    support.main()
