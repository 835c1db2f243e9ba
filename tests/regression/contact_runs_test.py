"""The problems that a run leaves (`output.discrete_problems`): solved again, they give the forces of the run."""
import csv

import h5py
import numpy as np

import support
from contact_cli_test import FAILURE, NOT_CONVERGED, SOLVED, Contact
from support import BEAM, rows_of, scabo, summary_of

LIFTED = """
scabo: 1
materials: {stone: {young: 1e9, poisson: 0.2}}
bodies:
  base: {material: stone, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.5}}
  block: {material: stone, shape: {rectangle: {corner: [0, 1], size: [2, 1]}}, mesh: {size: 0.5}}
supports: [{on: base.bottom, fix: [x, y]}]
loads: {push: {on: block.top, force: [0, -1000]}}
contacts: {joint: {between: [base.top, block.bottom], friction: 0.3}}
steps:
  - {name: press}
  - {name: lift, loads: {push: -1}}
"""


class Runs(Contact):
    """Problems that a run left."""

    def run_model(self, *settings, model=BEAM):
        run = scabo("run", model, "-o", self.directory / "out", "--set", "output.discrete_problems=true", *settings)
        self.assertEqual(run.returncode, SOLVED, run.stderr)
        return self.directory / "out"

    def forces_of(self, solution):
        r = np.array(solution["r"]).reshape(-1, 2)
        return {(solution["contacts"][contact], number): force
                for contact, number, force in zip(solution["contact_of_pair"], solution["number_of_pair"], r)}

    def compare(self, directory, solution, step, increment):
        forces = self.forces_of(solution)
        rows = [row for row in rows_of(directory) if (int(row["step"]), int(row["increment"])) == (step, increment)]
        self.assertEqual(len(rows), len(forces))
        largest = max(float(row["normal_force"]) for row in rows)
        for row in rows:
            force = forces[row["contact"], int(row["pair"])]
            self.assertAlmostEqual(float(row["normal_force"]), force[0], delta=1e-9 * largest)
            self.assertAlmostEqual(float(row["tangential_force"]), force[1], delta=1e-9 * largest)

    def test_the_forces_are_those_of_contact_csv(self):
        directory = self.run_model("--set", "steps.0.increments=3")
        self.assertEqual(sorted(path.name for path in (directory / "problems").iterdir()),
                         ["press_1.hdf5", "press_2.hdf5", "press_3.hdf5"])
        for increment in (1, 2, 3):
            file = directory / "problems" / f"press_{increment}.hdf5"
            self.compare(directory, self.solve(file), 1, increment)
            with h5py.File(file) as saved:
                r, u = saved["solution/r"][...], saved["solution/u"][...]
                W, q = saved["fclib_local/W/x"][...].reshape(len(r), len(r)).T, saved["fclib_local/vectors/q"][...]
                np.testing.assert_allclose(W @ r + q, u, rtol=0, atol=1e-12 * abs(q).max())
                # The next increment starts where this one ended.
                if increment < 3:
                    with h5py.File(directory / "problems" / f"press_{increment + 1}.hdf5") as after:
                        np.testing.assert_array_equal(after["guesses/1/r"][...], r)

    def test_bodies_that_contact_alone_holds(self):
        model = self.directory / "model.yaml"
        model.write_text("""
scabo: 1
materials: {stone: {young: 1e9, poisson: 0.2}}
bodies:
  base: {material: stone, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {size: 0.5}}
  block: {material: stone, shape: {rectangle: {corner: [0, 1], size: [2, 1]}}, mesh: {size: 0.5}}
supports: [{on: base.bottom, fix: [x, y]}]
loads: {push: {on: block.top, force: [100, -1000]}}
contacts: {joint: {between: [base.top, block.bottom], friction: 0.3}}
""")
        directory = self.run_model(model=model)
        file = directory / "problems" / "step_1_1.hdf5"
        with h5py.File(file) as saved:
            self.assertEqual(saved["fclib_local/V/n"][...].tolist(), [3])
            self.assertEqual(saved["fclib_local/R/nz"][...].tolist(), [-1])
        self.compare(directory, self.solve(file, "--trace=way.csv"), 1, 1)
        for table in (directory / "convergence.csv", self.directory / "way.csv"):
            with open(table, newline="", encoding="utf-8") as rows:
                for row in csv.DictReader(rows):  # stages have names with commas
                    self.assertGreaterEqual(float(row["residual"]), 0.0)
                    self.assertGreaterEqual(int(row["states_changed"]), 0)

    def test_an_increment_that_failed_can_be_looked_at(self):
        model = self.directory / "model.yaml"
        model.write_text(LIFTED)
        run = scabo("run", model, "--set", "output.discrete_problems=true", cwd=self.directory)
        self.assertEqual(run.returncode, NOT_CONVERGED, run.stderr)
        files = {path.name for path in (self.directory / "model.results" / "problems").iterdir()}
        self.assertEqual(files, {"press_1.hdf5", "lift_1.hdf5"})
        solution = self.solve(self.directory / "model.results" / "problems" / "lift_1.hdf5", status=NOT_CONVERGED)
        self.assertEqual(solution["status"], "mechanism")
        with h5py.File(self.directory / "model.results" / "problems" / "lift_1.hdf5") as saved:
            self.assertNotIn("solution", saved)

    def test_old_problems_are_cleared_and_files_of_others_are_not(self):
        directory = self.run_model("--set", "steps.0.increments=2")
        self.run_model()
        self.assertEqual([path.name for path in (directory / "problems").iterdir()], ["press_1.hdf5"])
        with h5py.File(directory / "problems" / "mine.hdf5", "w") as file:
            file["data"] = [1.0, 2.0]
        run = scabo("run", BEAM, "-o", directory)
        self.assertEqual(run.returncode, FAILURE)
        self.assertIn("problems/mine.hdf5", run.stderr)
        self.assertTrue((directory / "problems" / "press_1.hdf5").exists())

    def test_without_the_key_there_are_none(self):
        run = scabo("run", BEAM, "-o", self.directory / "out")
        self.assertEqual(run.returncode, SOLVED, run.stderr)
        self.assertFalse((self.directory / "out" / "problems").exists())

    def test_convergence_of_every_increment(self):
        directory = self.run_model("--set", "steps.0.increments=2")
        with open(directory / "convergence.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), ["step", "increment", "attempt", "iteration", "stage", "residual", "merit", "step_length",
                                         "states_changed"])
        self.assertEqual({(row["step"], row["increment"], row["attempt"]) for row in rows}, {("1", "1", "1"), ("1", "2", "1")})
        increments = summary_of(directory)["increments"]
        for number, increment in enumerate(increments, 1):
            of_increment = [row for row in rows if int(row["increment"]) == number]
            self.assertGreaterEqual(len(of_increment), increment["newton_iterations"])
            self.assertLess(float(of_increment[-1]["residual"]), 1e-9)
        picture = (directory / "convergence.svg").read_text(encoding="utf-8")
        for word in ("press 1", "press 2", "tolerance", "iteration", "residual", "</svg>"):
            self.assertIn(word, picture)


if __name__ == "__main__":
    support.main()
