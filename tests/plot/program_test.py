"""`scabo plot`: pictures of real results, and how the program finds what draws them."""
import argparse
import os
import pathlib
import re
import subprocess
import sys

import made_up  # noqa: F401  the package for pictures

sys.path.insert(0, str(made_up.ROOT / "tests" / "regression"))
import matplotlib.image
import meshio
import numpy as np
import plot
import support
from plot import command, contacts, crack_paths, fields, mechanisms


class Program(support.InTemporaryDirectory):
    def run_model(self, name, *settings):
        model = self.directory / f"{name}.yaml"
        self.assertEqual(support.scabo("new", name, "-o", model).returncode, 0)
        run = support.scabo("run", model, "--quiet", *[word for setting in settings for word in ("--set", setting)])
        self.assertEqual(run.returncode, 0, run.stderr)
        return self.directory / f"{name}.results"

    def plot(self, *words, status=0, **environment):
        run = support.scabo("plot", *words, cwd=self.directory, SCABO_PYTHON=environment.pop("SCABO_PYTHON", sys.executable), **environment)
        self.assertEqual(run.returncode, status, run.stderr)
        return run

    def test_all_pictures_of_a_run(self):
        results = self.run_model("beam")
        run = self.plot(results)
        self.assertEqual(run.stderr, "")
        paths = [pathlib.Path(line) for line in run.stdout.splitlines()]
        self.assertEqual([path.name for path in paths], [f"beam.{kind}.png" for kind in command.KINDS if kind not in ("lines", "cracks", "mechanism")])
        for path in paths:
            pixels = matplotlib.image.imread(path)
            drawn = (pixels[..., :3] < 0.9).any(axis=2)
            self.assertGreater(drawn.mean(), 0.005, f"{path} is empty")
            self.assertGreater(len(np.unique(pixels.reshape(-1, pixels.shape[2]), axis=0)), 20, path)

        # What is drawn, against the files as others read them.
        grid = meshio.read(results / "fields_0004.vtu")
        field = fields.field_of(plot.Results(results), -1, "principal_1", 0)
        np.testing.assert_array_equal(field.grid.points, grid.points[:, :2])
        np.testing.assert_array_equal(field.values, grid.point_data["principal_1"])
        self.assertEqual(len(field.triangles), sum(len(block.data) * {"triangle": 1, "quad": 2}[block.type] for block in grid.cells))
        line, = contacts.lines_of(plot.Results(results), 4)
        rows = [row for row in support.rows_of(results) if row["increment"] == "4"]
        np.testing.assert_array_equal(line.values["pressure"], [float(row["pressure"]) for row in rows])
        np.testing.assert_allclose(line.distance, [float(row["x"]) - float(rows[0]["x"]) for row in rows], atol=1e-12)

    def test_a_mechanism(self):
        """A block of 1 x 3 m that falls over about its toe, in the second increment and in the first."""
        model = self.directory / "fall.yaml"
        model.write_text("{scabo: 1, materials: {m: {young: 1e9, poisson: 0.2, density: 2000}}, bodies: {floor: {rigid: true, shape: "
                         "{rectangle: {corner: [-1, -1], size: [4, 1]}}}, block: {material: m, shape: {rectangle: {corner: [0, 0], size: "
                         "[1, 3]}}, mesh: {size: 0.5}}}, supports: [{on: floor, fix: [x, y]}], loads: {weight: {gravity: [0, -9]}, push: "
                         "{gravity: [4, 0]}}, contacts: {base: {between: [floor.top, block.bottom], friction: 0.8}}, steps: [{name: weight, "
                         "loads: {weight: 1}}, {name: push}]}")
        run = support.scabo("run", model)
        self.assertEqual(run.returncode, 2)
        self.assertIn("\nmechanism.vtu shows the motion: 1 of 2 bodies moves, 'block'\n", run.stdout)
        results = self.directory / "fall.results"
        names = [line.rsplit("/", 1)[1] for line in self.plot(results).stdout.splitlines()]
        self.assertEqual(names, [f"fall.{kind}.png" for kind in command.KINDS if kind not in ("lines", "cracks")])
        motion = mechanisms.motion_of(plot.Results(results), 0.5)
        grid = meshio.read(results / "mechanism.vtu")  # as others read it
        np.testing.assert_array_equal(motion.grid.point_data["displacement"], grid.point_data["displacement"])
        np.testing.assert_allclose(motion.motion, [0.0, 1.0], atol=1e-8)
        np.testing.assert_array_equal(motion.rigid, [True, False])
        hatched = [part for part in mechanisms.mechanism(plot.Results(results)).axes[0].collections if part.get_hatch()]
        self.assertEqual([len(part.get_paths()) for part in hatched], [1])  # the floor
        np.testing.assert_allclose(np.ptp(hatched[0].get_paths()[0].vertices, axis=0), [4.0, 1.0])
        of_block = grid.point_data["body"] == 2
        expected = np.column_stack([grid.points[:, 1], 1.0 - grid.points[:, 0]]) / np.sqrt(10.0)  # about (1, 0)
        np.testing.assert_allclose(grid.point_data["displacement"][of_block, :2], expected[of_block], atol=1e-8)
        np.testing.assert_allclose(motion.points[motion.grid.point_data["body"] == 2],
                                   grid.points[of_block, :2] + 0.5 * expected[of_block], atol=1e-8)
        of_pairs = grid.point_data["pair"] > 0
        np.testing.assert_allclose(grid.point_data["opening"][of_pairs], (1.0 - grid.points[of_pairs, 0]) / np.sqrt(10.0), atol=1e-8)
        self.assertEqual((len(motion.slips), len(motion.opens)), (0, of_pairs.sum() - 1))
        body = support.summary_of(results)["mechanism"]["bodies"]["block"]
        np.testing.assert_allclose(body["centre"], [1.0, 0.0], atol=1e-8)

        self.assertEqual(support.scabo("run", model, "--set", "steps=[{name: both}]").returncode, 2)
        self.assertIn("fall.mechanism.png", self.plot(results).stdout)
        self.plot(results, "--what", "stress", status=1)
        self.assertEqual(support.scabo("run", model, "--set", "loads.push.gravity=[2, 0]").returncode, 0)
        self.assertFalse((results / "mechanism.vtu").exists())  # what the run before left is removed
        self.assertIn("has no mechanism.vtu", self.plot(results, "--what", "mechanism", status=1).stderr)

    def test_the_snippet_of_the_manual_runs(self):
        self.run_model("beam")
        text = (made_up.ROOT / "docs" / "pictures.md").read_text(encoding="utf-8")
        code, = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        installed = str(pathlib.Path(support.SCABO).resolve().parents[1] / "share" / "scabo")
        self.assertIn('"/usr/local/share/scabo"', code)
        code = "import matplotlib; matplotlib.use('Agg')\n" + code.replace("/usr/local/share/scabo", installed)
        run = subprocess.run([sys.executable, "-B", "-c", code], cwd=self.directory, text=True, capture_output=True, timeout=support.PATIENCE)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertTrue((self.directory / "joint.pdf").read_bytes().startswith(b"%PDF"))

    def test_formats(self):
        results = self.run_model("crack")
        for kind, start in (("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")):
            path = self.directory / f"picture.{kind}"
            self.assertEqual(self.plot(results, "--what", "stress", "--component", "yy", "-o", path).stdout, f"{path}\n")
            self.assertTrue(path.read_bytes().startswith(start))
        self.plot(results, "-o", self.directory / "all.pdf")
        pages = len(re.findall(rb"/Type /Page\b", (self.directory / "all.pdf").read_bytes()))
        self.assertEqual(pages, 3, "stress, mesh and history: there is no contact")

    def test_compressed_fields(self):
        results = self.run_model("crack", "bodies.plate.mesh={kind: quadtree, size: 0.02}", "bodies.plate.cracks=[{path: [[0, 1], [0.5, 1]]}]",
                                 "supports=[{on: plate.bottom, fix: [x, y]}]")
        self.assertIn(b"vtkZLibDataCompressor", (results / "fields_0001.vtu").read_bytes()[:200])
        grid = meshio.read(results / "fields_0001.vtu")
        np.testing.assert_array_equal(plot.Results(results).fields(1).point_data["von_mises"], grid.point_data["von_mises"])

    def test_cracks_that_grow(self):
        """The picture against cracks.csv, and the animation: every file has a mesh of its own, whose crack is open by what cracks.csv says."""
        results = self.run_model("growth", "output.every=1", "steps.0.growth.until={steps: 3}", "output.fields=[displacement]")
        table = plot.Results(results).table("cracks.csv")
        figure = crack_paths.cracks(plot.Results(results))
        for axis, column in zip(figure.axes[1:], ("length", "opening", "displacement"), strict=True):
            line, = axis.lines
            np.testing.assert_allclose(line.get_xdata() / line.get_xdata()[0], table[column] / table[column][0], rtol=1e-12)
            np.testing.assert_array_equal(line.get_ydata(), table["load_factor"])
        files = re.findall('file="(.*?)"', (results / "fields.pvd").read_text(encoding="utf-8"))
        self.assertEqual(len(files), 4)
        grids = [meshio.read(results / name) for name in files]
        self.assertEqual(len({len(grid.points) for grid in grids}), 4)
        for grid, opening in zip(grids, table["opening"]):
            at_mouth = grid.point_data["displacement"][np.linalg.norm(grid.points, axis=1) < 1e-12, 1]
            self.assertAlmostEqual(np.ptp(at_mouth) / opening, 1.0, delta=1e-6)

    def test_modes(self):
        model = self.directory / "modes.yaml"
        model.write_text("{scabo: 1, analysis: {type: modal, modes: 4}, materials: {m: {young: 1, poisson: 0.3, density: 1}}, bodies: "
                         "{b: {material: m, shape: {rectangle: {corner: [0, 0], size: [4, 1]}}, mesh: {size: 0.5}}}}")
        self.assertEqual(support.scabo("run", model, "--quiet").returncode, 0)
        run = self.plot(self.directory / "modes.results", "--increment", 4)
        self.assertIn("modes.stress.png", run.stdout)
        self.plot(self.directory / "modes.results", "--increment", 5, status=1)
        self.assertIn("is a modal analysis", self.plot(self.directory / "modes.results", "--what", "contact", status=1).stderr)

    def test_the_exit_status_is_that_of_the_pictures(self):
        self.assertIn("nowhere: there is no such directory", self.plot("nowhere", status=1).stderr)
        self.assertIn("--what: 'forces' is none of stress, contact", self.plot("nowhere", "--what", "forces", status=1).stderr)
        self.assertIn("DIR is required", self.plot(status=1).stderr)

    def test_interpreters(self):
        lacking = self.directory / "lacking"
        lacking.write_text("#!/bin/sh\necho matplotlib\n")
        lacking.chmod(0o755)
        run = self.plot("nowhere", SCABO_PYTHON=str(lacking), status=3)
        self.assertIn(f"no Python with NumPy and Matplotlib for pictures: {lacking} lacks matplotlib. Install them (apt install", run.stderr)
        run = self.plot("nowhere", SCABO_PYTHON="/nowhere/python", status=3)
        self.assertIn("/nowhere/python not found", run.stderr)
        run = self.plot("nowhere", SCABO_PYTHON="/bin/false", status=3)
        self.assertIn("/bin/false does not run", run.stderr)
        self.assertIn("there is no such directory", self.plot("nowhere", SCABO_PYTHON=None, PATH=os.environ["PATH"], status=1).stderr
                      if self.has_default_interpreter() else "there is no such directory")

    def has_default_interpreter(self):
        return any(subprocess.run([name, "-c", "import numpy, matplotlib"], capture_output=True).returncode == 0
                   for name in ("/usr/bin/python3", "python3"))

    def test_a_copy_of_the_program_says_what_is_not_beside_it(self):
        copy = self.directory / "bin" / "scabo"
        copy.parent.mkdir()
        copy.write_bytes(pathlib.Path(support.SCABO).read_bytes())
        copy.chmod(0o755)
        run = subprocess.run([copy, "plot", "nowhere"], capture_output=True, text=True, timeout=support.PATIENCE)
        self.assertEqual(run.returncode, 3)
        self.assertIn(f"the program for pictures is not at {self.directory.resolve()}/share/scabo/scabo_plot", run.stderr)

    def test_both_command_lines_have_the_same_options(self):
        of_program = set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", support.scabo("plot", "--help").stdout.split("Example:")[0].replace(
            "--units m,N", "")))
        of_pictures = {flag for action in command.parser()._actions for flag in action.option_strings if action.help != argparse.SUPPRESS}
        self.assertEqual(of_program, of_pictures)
        kinds = re.search(r"--what KIND", support.scabo("plot", "--help").stdout)
        self.assertTrue(kinds)


if __name__ == "__main__":
    support.main()
