"""The checked numbers of examples/03_discrete_problem: the saved problem, and the model it came from."""
import json
import subprocess
import sys

import h5py
import numpy as np

import support
from support import ROOT, scabo, summary_of

EXAMPLE = ROOT / "examples" / "03_discrete_problem"
CHECK = json.loads((EXAMPLE / "check.json").read_text(encoding="utf-8"))


class DiscreteProblem(support.InTemporaryDirectory):
    def test_the_saved_problem(self):
        run = scabo("contact", EXAMPLE / "problem.hdf5", "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        solution = json.loads(run.stdout)
        r = np.array(solution["r"])
        self.assertAlmostEqual(r[0::2].sum(), CHECK["normal_force"], delta=CHECK["force_tolerance"])
        self.assertAlmostEqual(r[1::2].sum(), CHECK["tangential_force"], delta=CHECK["force_tolerance"])
        self.assertEqual({state: solution["states"].count(state) for state in ("open", "stick", "slip")},
                         {state: CHECK[state] for state in ("open", "stick", "slip")})
        self.assertLessEqual(solution["iterations"], CHECK["iterations_at_most"])

    def test_the_model_leads_to_the_saved_problem(self):
        run = scabo("run", EXAMPLE / "model.yaml", "-o", self.directory / "out", "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        with h5py.File(EXAMPLE / "problem.hdf5") as saved, h5py.File(self.directory / "out/problems/push_2.hdf5") as now:
            for name in ("fclib_local/W/x", "fclib_local/vectors/q", "fclib_local/vectors/s", "solution/r"):
                expected = saved[name][...]
                np.testing.assert_allclose(now[name][...], expected, rtol=0, atol=1e-9 * np.abs(expected).max(), err_msg=name)
        joint = summary_of(self.directory / "out")["increments"][-1]["contacts"]["bed"]
        self.assertAlmostEqual(joint["normal_force"], CHECK["normal_force"], delta=CHECK["force_tolerance"])

    def test_checked_without_scabo(self):
        run = subprocess.run([sys.executable, EXAMPLE / "check_solution.py", "--scabo", support.SCABO], cwd=self.directory, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=support.PATIENCE)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        for line in run.stdout.splitlines():
            if "worst violation" in line or "the saved ones" in line:
                self.assertLess(float(line.split(": ")[1]), CHECK["violation_below"])
        self.assertIn("solved in", run.stdout)


if __name__ == "__main__":
    support.main()
