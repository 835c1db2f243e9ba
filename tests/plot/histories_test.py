"""What `output.history` asks for, and the names of steps, in pictures."""
import json
import pathlib
import tempfile
import unittest

import made_up
import numpy as np
import plot
from plot import curves


class Histories(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="scabo_test_")
        self.addCleanup(holder.cleanup)
        self.directory = made_up.write(pathlib.Path(holder.name) / "made_up.results")

    def columns(self, names):
        rows = [[1, 1, 1, *range(len(names))], [2, 1, 2, *("" for _ in names)], [2, 2, 2.5, *(9 for _ in names)]]  # the last: not in summary.json
        lines = [["step", "increment", "time", *names], *rows]
        (self.directory / "history.csv").write_text("".join(",".join(map(str, line)) + "\n" for line in lines), encoding="utf-8")
        return curves.asked_for(plot.Results(self.directory))

    def test_a_panel_for_each_column_whatever_its_name(self):
        names = ["tip", "body", "state"]  # columns of text in other tables
        panels = self.columns(names)
        self.assertEqual([panel.title for panel in panels], names)
        for number, panel in enumerate(panels):
            [curve] = panel.curves
            np.testing.assert_array_equal(curve.x, [1.0, 2.0])
            np.testing.assert_array_equal(curve.y, [number, np.nan])
        self.assertEqual(len(plot.history(plot.Results(self.directory), "history").axes), 4)  # two rows of two

    def test_of_many_the_first(self):
        panels = self.columns([f"c{k}" for k in range(9)])
        self.assertEqual([panel.title for panel in panels], [f"c{k} (6 of 9 columns)" for k in range(6)])

    def test_without_any(self):
        self.assertEqual(curves.asked_for(plot.Results(self.directory)), [])

    def test_steps_are_named(self):
        path = self.directory / "summary.json"
        summary = json.loads(path.read_text(encoding="utf-8"))
        summary["model"]["steps"] = ["step_1", "push"]
        path.write_text(json.dumps(summary), encoding="utf-8")
        results = plot.Results(self.directory)
        self.assertEqual(results.name_of(1), "step 1, increment 1")
        self.assertTrue(results.name_of(2).startswith("step 2 (push), increment 1"), results.name_of(2))


if __name__ == "__main__":
    unittest.main()
