"""Towers, walls and piles of rigid bodies (benchmarks/contact/stacks.py) that sweeps or Newton alone do not solve: `scabo contact` within
5e-9 by the scaled residual, which is formed here from W, q, mu and the forces."""
import json
import sys
import unittest

import numpy as np

import support
from problem_files import natural_map_residual
from support import scabo

sys.path.insert(0, str(support.ROOT / "benchmarks" / "contact"))
try:
    import stacks  # noqa: E402
except ImportError:  # scipy: package python3-scipy
    stacks = None

LIMIT = 5e-9
NAMES = ("tower20_m3_mu0.5_ratio1000", "tower40_m4_mu1.5", "wall5x6_m3_mu0.8_ratio1000", "wall5x6_m3_mu0.1_ratio1000", "pile30x4_mu0.5", "pile60x4_mu0.4",
         "plane_wall10x12_mu0.5_ratio1000")


@unittest.skipIf(stacks is None, "python3-scipy is missing")
class RigidStacks(support.InTemporaryDirectory):
    def test_are_solved(self):
        solved = 0
        for name, dimension, W, q, mu in stacks.stacks(NAMES):
            with self.subTest(name):
                path = self.directory / f"{name}.hdf5"
                stacks.write(path, dimension, W, q, mu)
                run = scabo("contact", path, "--json", "--tolerance", str(0.9 * LIMIT), cwd=self.directory)
                self.assertEqual(run.returncode, 0, run.stdout[:300] + run.stderr)
                r = np.array(json.loads(run.stdout)["r"])
                residual = lambda forces: natural_map_residual(W @ forces + q, forces, mu, q, W.toarray())  # noqa: E731
                self.assertLessEqual(residual(r), LIMIT)
                self.assertGreater(residual(1.001 * r), LIMIT)
                solved += 1
        self.assertEqual(solved, len(NAMES))


if __name__ == "__main__":
    support.main()
