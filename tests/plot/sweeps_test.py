"""Pictures of sweeps: what is drawn, and messages."""
import contextlib
import io
import json
import math
import pathlib
import tempfile
import unittest

import made_up  # noqa: F401  the package for pictures
import matplotlib.image
import numpy as np
import plot
from plot import command, sweeps


class Sweeps(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="scabo_test_")
        self.addCleanup(holder.cleanup)
        self.directory = pathlib.Path(holder.name) / "block.sweep"
        self.directory.mkdir()

    def write(self, vary, figures, columns):
        """`figures(values)`: status and figures of a point."""
        rows, points = [], [[]]
        for _, values in vary:
            points = [[*point, value] for point in points for value in values]
        for k, point in enumerate(points):
            status, numbers = figures(*point)
            rows.append([str(k + 1), *map(str, point), status, "1", "1", *map(str, numbers or [""] * len(columns))])
        header = ["point", *(path for path, _ in vary), "status", "step", "reached", *columns]
        (self.directory / "sweep.csv").write_text("\n".join(",".join(row) for row in [header, *rows]) + "\n", encoding="utf-8")
        (self.directory / "sweep.json").write_text(json.dumps({"vary": [{"path": path} for path, _ in vary]}), encoding="utf-8")

    def write_block(self, widths=(1, 2)):
        """A block that slides below a coefficient of friction of 0.25."""
        self.write([("contacts.base.friction", [0.5, 0.1, 0.3]), ("parameters.width", list(widths))],
                   lambda mu, width: ("solved", [1e6 * width, -0.25e6 * width, mu * width, 7.0]) if mu > 0.25 else ("mechanism", None),
                   ["base.normal_force", "base.tangential_force", "base.max_pressure", "floor.reaction_x"])

    def run_plot(self, *words):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            status = command.main([str(self.directory), *words])
        return status, out.getvalue(), err.getvalue()

    def test_lines_and_points(self):
        self.write_block()
        figure = plot.sweep(self.directory)
        axes = [axis for axis in figure.axes if axis.get_visible() and axis.axison]
        self.assertEqual([axis.get_ylabel().split(" ")[0] for axis in axes],
                         ["base.normal_force", "base.tangential_force", "base.max_pressure"])  # what does not change is left out
        pressure = [line for line in axes[2].lines if line.get_linestyle() != "None"]
        self.assertEqual(len(pressure), 2)
        for width, line in zip((1, 2), pressure):
            np.testing.assert_allclose(line.get_xdata(), [0.1, 0.3, 0.5])  # in order, however they were given
            np.testing.assert_allclose(line.get_ydata(), [math.nan, 0.3 * width, 0.5 * width])
        crosses = [line for line in axes[2].lines if line.get_marker() == "x"]
        self.assertEqual([list(line.get_xdata()) for line in crosses], [[0.1], [0.1]])
        self.assertEqual([text.get_text() for text in figure.legends[0].get_texts()], ["width = 1", "width = 2"])

    def test_a_history_comes_first_and_names_are_short(self):
        self.write([("p", [1, 10, 100])], lambda p: ("solved", [p, 2 * p, p, 3 * p]), ["base.normal_force", "tip.last", "tip.min", "tip.max"])
        axis, = plot.sweep(self.directory).axes
        self.assertEqual((axis.get_ylabel(), axis.get_xscale()), ("tip", "log"))
        axis, = plot.sweep(self.directory, ["tip.max"]).axes
        np.testing.assert_allclose(axis.lines[0].get_ydata(), [3, 30, 300])

    def test_words_are_not_joined(self):
        self.write([("analysis.plane", ["stress", "strain"])], lambda plane: ("solved", [len(plane) + plane.count("t")]), ["tip.last"])
        axis, = plot.sweep(self.directory).axes
        self.assertEqual([label.get_text() for label in axis.get_xticklabels()], ["stress", "strain"])
        self.assertEqual(axis.lines[0].get_linestyle(), "None")

    def test_files(self):
        self.write_block(range(1, 6))
        status, out, err = self.run_plot("--units", "m,N", "--component", "base.normal_force, base.max_pressure")
        self.assertEqual((status, err), (0, ""))
        path = pathlib.Path(out.strip())
        self.assertEqual(path, self.directory.parent / "block.sweep.png")
        self.assertGreater((matplotlib.image.imread(path)[..., :3] < 0.9).any(axis=2).mean(), 0.005)

    def test_messages(self):
        self.write_block()
        for words, said in ((["--component", "base.normal"], "--component base.normal: the table has base.normal_force, "),
                            (["--what", "stress"], "is a sweep, of which there is one picture; draw one of its points"),
                            (["--increment", "2"], "--increment: has no meaning for a sweep"),
                            (["-o", "a.txt"], "the name must end in .png, .svg or .pdf")):
            status, _, err = self.run_plot(*words)
            self.assertEqual(status, 1)
            self.assertIn(said, err)
        self.write_block(range(13))
        self.assertIn("would have 13 lines, at most 12 can be told apart", self.run_plot()[2])
        self.write([("p", [1, 2])], lambda p: ("mechanism", None), ["tip.last"])
        self.assertIn("no point is solved", self.run_plot()[2])
        for text in ("", "point,p\n", "point,p,status,step,reached,tip.last\n1,1,solved,1,1,word\n"):
            (self.directory / "sweep.csv").write_text(text, encoding="utf-8")
            status, _, err = self.run_plot()
            self.assertEqual(status, 1)
            self.assertIn("sweep.csv: is damaged", err)


if __name__ == "__main__":
    unittest.main()
