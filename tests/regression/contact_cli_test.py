"""`scabo contact`: problems in every layout solved, judged by a residual formed here; manners of the command."""
import csv
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np

import support
from problem_files import csc, csr, natural_map_residual, random_problem, triplets, write_global, write_local
from support import scabo

SOLVED, WRONG_INPUT, NOT_CONVERGED, FAILURE = 0, 1, 2, 3
KEYS = {"status": str, "natural_map_residual": float, "iterations": int, "coarse_iterations": int, "seconds": float, "solver": str, "r": list}


class Contact(support.InTemporaryDirectory):
    def solve(self, file, *arguments, status=SOLVED):
        run = scabo("contact", file, "--json", *arguments, cwd=self.directory)
        if status is not None:
            self.assertEqual(run.returncode, status, run.stdout + run.stderr)
        return json.loads(run.stdout)

    def write(self, *problem, name="problem.hdf5", **options):
        path = self.directory / name
        write_local(path, *problem, **options)
        return path


class Solves(Contact):
    def test_two_and_three_dimensions_in_every_storage(self):
        for dimension in (2, 3):
            W, q, mu = random_problem(6, dimension, seed=dimension)
            W[0, 1] += 1e-9  # slightly unsymmetric, as data of others are
            for storage in (csc, csr, triplets):
                with self.subTest(dimension=dimension, storage=storage.__name__):
                    solution = self.solve(self.write(W, q, mu, storage=storage))
                    r = np.array(solution["r"])
                    np.testing.assert_allclose(solution["u"], W @ r + q, atol=1e-12)
                    self.assertLess(natural_map_residual(W @ r + q, r, mu, q, W), 1e-10)
                    self.assertAlmostEqual(solution["natural_map_residual"], natural_map_residual(W @ r + q, r, mu, q, W),
                                           delta=1e-13)
                    self.assertEqual((solution["status"], solution["pairs"], solution["dimension"]), ("solved", 6, dimension))

    def test_unsymmetric_entries_are_not_exchanged(self):
        # Two pairs without friction, both pressed: W r = -q on the normals, and W is far from symmetric.
        W = np.diag([2.0, 1.0, 2.0, 1.0])
        W[0, 2] = 0.5
        q = np.array([-1.0, 0.0, -1.0, 0.0])
        for storage in (csc, csr, triplets):
            solution = self.solve(self.write(W, q, [0, 0], storage=storage))
            np.testing.assert_allclose(solution["r"], [0.375, 0, 0.5, 0], atol=1e-9)

    def test_keys(self):
        solution = self.solve(self.write(*random_problem(3, 2, seed=5)))
        for key, kind in KEYS.items():
            self.assertIsInstance(solution[key], kind, key)
        self.assertEqual(solution["solver"], "b_differentiable")
        self.assertEqual(len(solution["r"]), 6)
        self.assertEqual(len(solution["states"]), 3)
        self.assertLessEqual(solution["natural_map_residual"], solution["tolerance"])  # by which such a file is judged

    def test_rigid_motions_are_bilateral_constraints(self):
        # A block on two springs, pressed by 3 and free to move and turn: 0 = V' r + s, u = W r + V l + q.
        W, V = np.diag([1.0, 1.0, 1.0, 1.0]), np.array([[1.0, 1], [0, 0], [1, -1], [0, 0]])
        solution = self.solve(self.write(W, np.zeros(4), [0, 0], V=V, s=[-3.0, 0.0]))
        np.testing.assert_allclose(solution["r"], [1.5, 0, 1.5, 0], atol=1e-10)
        np.testing.assert_allclose(solution["l"], [-1.5, 0], atol=1e-10)

    def test_constraints_with_a_stiffness_are_eliminated(self):
        W, q, mu = random_problem(4, 2, seed=8)
        V, R, s = np.random.default_rng(9).normal(size=(8, 2)), np.array([[-2.0, 0.5], [0.5, -3.0]]), np.array([0.3, -0.2])
        r = np.array(self.solve(self.write(W, q, mu, V=V, s=s, R=R))["r"])
        l = np.linalg.solve(R, -(V.T @ r + s))
        self.assertLess(natural_map_residual(W @ r + V @ l + q, r, mu, q), 1e-9)

    def test_global_form(self):
        random = np.random.default_rng(3)
        M = np.kron(np.eye(4), np.diag([2.0, 3.0, 4.0])) + 0.01 * np.diag(np.ones(11), 1)
        H, f, w, mu = random.normal(size=(12, 9)), random.normal(size=12), random.normal(size=9), np.full(3, 0.3)
        G, b = random.normal(size=(12, 1)), np.array([0.2])
        path = self.directory / "global.hdf5"
        for constraints in ({}, {"G": G, "b": b}):
            for storage in (csc, csr, triplets):
                with self.subTest(storage=storage.__name__, constraints=list(constraints)):
                    write_global(path, M, H, f, w, mu, storage=storage, **constraints)
                    solution = self.solve(path)
                    r, v, l = (np.array(solution[key]) for key in ("r", "v", "l"))
                    balance = M @ v - f - H @ r
                    if constraints:
                        balance -= G @ l
                        np.testing.assert_allclose(G.T @ v + b, 0, atol=1e-12)
                    np.testing.assert_allclose(balance, 0, atol=1e-12)
                    self.assertLess(natural_map_residual(H.T @ v + w, r, mu, w), 1e-9)

    def test_text(self):
        path = self.directory / "problem.dat"
        path.write_text("2\n1\n0\n2\n2\n2\t2\n2 0\n0 1\n-1 0.1\n0.3\n")
        np.testing.assert_allclose(self.solve(path)["r"], [0.5, -0.1], atol=1e-10)

    def test_saved_problem_is_read_by_others_and_by_us(self):
        W, q, mu = random_problem(5, 3, seed=4)
        first = self.solve(self.write(W, q, mu), "--save", "saved.hdf5")
        with h5py.File(self.directory / "saved.hdf5") as file:
            np.testing.assert_array_equal(file["solution/r"][...], first["r"])
            np.testing.assert_allclose(file["solution/u"][...], W @ first["r"] + q, atol=1e-12)
            np.testing.assert_array_equal(file["fclib_local/vectors/q"][...], q)
            self.assertEqual(file["fclib_local/spacedim"][...].tolist(), [3])
        self.solve("saved.hdf5", "--save", "saved.dat")
        np.testing.assert_allclose(self.solve("saved.dat")["r"], first["r"], atol=1e-9)
        run = scabo("contact", "saved.dat", "--save", "saved.hdf5", cwd=self.directory)
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("saved.hdf5: exists", run.stderr)


@unittest.skipUnless(importlib.util.find_spec("siconos"), "python3-siconos is not installed")
class Siconos(Contact):
    """Siconos reads our text with equal bits, and we read its own."""
    READ = """
import json, sys
import siconos.numerics as sn
p = sn.frictionContact_new_from_filename(sys.argv[1])
n = p.dimension * p.numberOfContacts
W = [[sn.NM_get_value(p.M, i, j) for j in range(n)] for i in range(n)]
sn.frictionContact_printInFilename(p, sys.argv[2])
print(json.dumps([p.dimension, p.numberOfContacts, W, list(p.q.ravel()), list(p.mu.ravel())]))
"""

    def test_dense_and_sparse(self):
        W, q, mu = random_problem(7, 2, seed=12)
        W[0, 1] += 0.125  # unsymmetric
        sparse = np.where(np.abs(W) > 0.3, W, 0.0)
        for name, matrix in dict(dense=W, sparse=sparse).items():
            with self.subTest(storage=name):
                first = self.solve(self.write(matrix, q, mu), "--save", f"{name}.dat")
                run = subprocess.run([sys.executable, "-c", self.READ, f"{name}.dat", f"{name}_2.dat"], cwd=self.directory,
                                     text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=support.PATIENCE)
                self.assertEqual(run.returncode, 0, run.stderr)
                dimension, pairs, read, q_read, mu_read = json.loads(run.stdout.splitlines()[-1])
                self.assertEqual((dimension, pairs, q_read, mu_read), (2, 7, list(q), list(mu)))
                np.testing.assert_array_equal(read, matrix)
                # What Siconos writes sparse has six digits.
                np.testing.assert_allclose(self.solve(f"{name}_2.dat")["r"], first["r"],
                                           atol=1e-9 if name == "dense" else 1e-4)


def stack(columns, blocks, closing, d=3):
    """Columns of blocks of mass 1 between a floor and a ceiling that close by `closing`: W and q of H = [1, -1, 0 ...; 0, 1, -1 ...]."""
    H = np.zeros((blocks, blocks + 1))
    for block in range(blocks):
        H[block, block], H[block, block + 1] = 1.0, -1.0
    H = np.kron(np.kron(np.eye(columns), H), np.eye(d))
    q = np.zeros(H.shape[1])
    q[::d] = 0.1
    q[(blocks // 2) * d] = -closing
    return H.T @ H, q, np.full(columns * (blocks + 1), 0.5)


class Trust(Contact):
    """Solved means solved, in any unit; what has no solution is proven so."""

    def test_powers_of_two_change_no_bit(self):
        for dimension in (2, 3):
            W, q, mu = random_problem(12, dimension, seed=20 + dimension)
            first = self.solve(self.write(W, q, mu))
            for s, t in ((2.0**100, 1.0), (2.0**-100, 1.0), (1.0, 2.0**100), (1.0, 2.0**-100), (2.0**-100, 2.0**100)):
                other = self.solve(self.write(s * W, t * q, mu))
                np.testing.assert_array_equal(other["r"], np.array(first["r"]) * (t / s))
                np.testing.assert_array_equal(other["u"], np.array(first["u"]) * t)
                for key in ("status", "iterations", "natural_map_residual", "rounding", "certificate"):
                    self.assertEqual(other[key], first[key], key)

    def test_powers_of_two_change_no_bit_of_other_solvers(self):
        W, q, mu = random_problem(8, 2, seed=24)
        for solver in ("newton_only", "trial_and_error", "lemke", "fischer_burmeister", "alart_curnier", "gauss_seidel",
                       "tresca", "proximal_point"):
            first = self.solve(self.write(W, q, mu), "--solver", solver, status=None)
            for s, t in ((2.0**100, 1.0), (2.0**-100, 2.0**100)):
                other = self.solve(self.write(s * W, t * q, mu), "--solver", solver, status=None)
                np.testing.assert_array_equal(other["r"], np.array(first["r"]) * (t / s), solver)
                for key in ("status", "iterations", "natural_map_residual"):
                    self.assertEqual(other[key], first[key], solver)

    def test_units_of_rigid_motions_change_no_bit(self):
        # Columns of G in other units: the same forces, and l in the new ones. In units of 1e12 the balance V'r + s was
        # far below the tolerance whatever r was, in units of 1e-12 the gaps were.
        for dimension in (2, 3):
            W, q, mu = random_problem(8, dimension, seed=40 + dimension)
            random, m = np.random.default_rng(50 + dimension), 3 * dimension - 3
            V, balanced = 0.3 * random.normal(size=(len(q), m)), np.zeros(len(q))
            balanced[::dimension] = random.uniform(0.5, 1, 8)
            s = -V.T @ balanced
            first = self.solve(self.write(W, q, mu, V=V, s=s))
            r = np.array(first["r"])
            self.assertLess(natural_map_residual(W @ r + V @ first["l"] + q, r, mu, q, W), 1e-9)
            np.testing.assert_allclose(V.T @ r, -s, atol=1e-10)
            for unit in (2.0**40 * np.ones(m), 2.0**-40 * np.ones(m), 2.0 ** random.integers(-60, 60, m)):
                other = self.solve(self.write(W, q, mu, V=V * unit, s=s * unit))
                np.testing.assert_array_equal(other["r"], first["r"])
                np.testing.assert_array_equal(np.array(other["l"]) * unit, first["l"])
                for key in ("iterations", "certificate"):
                    self.assertEqual(other[key], first[key], key)

    def test_other_units_do_not_make_it_solved(self):
        # An elastic problem whose W is 1e12 times its forces' unit: the natural map in file units is 1e-13 for anything.
        W, q, mu = random_problem(30, 2, seed=31, mu=1.5)
        for s in (1e-12, 1.0, 1e8, 1e12):
            solution = self.solve(self.write(s * W, q, mu), status=None)
            r = s * np.array(solution["r"])
            residual = natural_map_residual(W @ r + q, r, mu, q, W)
            self.assertEqual(solution["status"] == "solved", residual <= 1.1e-10, residual)
            self.assertAlmostEqual(solution["natural_map_residual"], residual, delta=1e-12)

    def test_no_contacts_are_solved(self):
        empty = np.zeros((0, 0))
        for storage in (csc, csr, triplets):
            file = self.write(empty, np.zeros(0), np.zeros(0), storage=storage, spacedim=3)
            for solver in ("b_differentiable", "gauss_seidel", "lemke"):
                solution = self.solve(file, "--solver", solver)
                self.assertEqual((solution["status"], solution["r"], solution["u"], solution["pairs"]), ("solved", [], [], 0))
        path = self.directory / "global.hdf5"
        write_global(path, np.diag([2.0, 3.0]), np.zeros((2, 0)), [1.0, 6.0], np.zeros(0), np.zeros(0), spacedim=2)
        solution = self.solve(path)
        self.assertEqual((solution["status"], solution["r"]), ("solved", []))
        np.testing.assert_allclose(solution["v"], [0.5, 2.0])
        text = self.directory / "none.dat"
        text.write_text("2\n0\n0\n0\n0\n0 0\n\n\n")
        self.assertEqual(self.solve(text)["status"], "solved")
        self.assertIn("Solved", scabo("contact", path).stdout)

    def test_infeasible_with_its_proof(self):
        for columns, blocks in ((1, 1), (2, 5), (3, 12)):
            W, q, mu = stack(columns, blocks, closing=0.1 * blocks + 0.05)
            run = scabo("contact", self.write(W, q, mu), "--json")
            self.assertEqual(run.returncode, NOT_CONVERGED, run.stdout)
            solution = json.loads(run.stdout)
            self.assertEqual(solution["status"], "infeasible")
            self.assertIn(": infeasible: ", run.stderr)
            r = np.array(solution["proof"])
            self.assertLessEqual(np.abs(W @ r).max(), 1e-12)
            self.assertLess(q @ r, 0.0)
            self.assertTrue((r[::3] >= 0).all() and not r[1::3].any() and not r[2::3].any())
            # A little less, and it is solved: statics of a column.
            W, q, mu = stack(columns, blocks, closing=0.1 * blocks - 0.05)
            self.assertEqual(self.solve(self.write(W, q, mu))["status"], "solved")
        self.assertIn("Infeasible by", scabo("contact", self.write(*stack(1, 2, 1.0))).stdout)

    def test_a_wedged_pair(self):
        W, q = np.array([[1.0, 2, 0], [2, 4, 0], [0, 0, 0]]), np.array([-1.0, -1, 0])
        for solver in ("b_differentiable", "newton_only", "proximal_point"):
            solution = self.solve(self.write(W, q, [1.0]), "--solver", solver, status=NOT_CONVERGED)
            self.assertEqual(solution["status"], "infeasible")
            r = np.array(solution["proof"])
            self.assertLessEqual(np.abs(W @ r).max(), 1e-12)
            self.assertLess(q @ r, 0.0)
            self.assertLessEqual(np.hypot(r[1], r[2]), r[0])

    def test_time_limit(self):
        W, q, mu = random_problem(40, 3, seed=7)
        run = scabo("contact", self.write(W, q, mu), "--json", "--time-limit", "1e-9", "--tolerance", "1e-15", "--save",
                    "best.hdf5", cwd=self.directory)
        self.assertEqual(run.returncode, NOT_CONVERGED, run.stdout)
        solution = json.loads(run.stdout)
        self.assertEqual(solution["status"], "not_converged")
        self.assertIn("the time limit of 1e-09 s", run.stderr)
        r = np.array(solution["r"])
        self.assertLessEqual(natural_map_residual(W @ r + q, r, mu, q, W), natural_map_residual(q, 0 * q, mu, q, W))
        with h5py.File(self.directory / "best.hdf5") as saved:  # where a later solve goes on
            np.testing.assert_array_equal(saved["guesses/1/r"][...], r)
        self.assertEqual(self.solve("best.hdf5", "--time-limit", "1000")["status"], "solved")
        for wrong in ("0", "-1", "soon"):
            self.assertEqual(scabo("contact", "best.hdf5", "--time-limit", wrong).returncode, WRONG_INPUT)


class Manners(Contact):
    def test_table(self):
        run = scabo("contact", self.write(*random_problem(4, 3, seed=6)))
        self.assertEqual((run.returncode, run.stderr), (SOLVED, ""))
        for word in ("FCLIB, local form", "Written by h5py", "4 pairs in 3D", "Solved by b_differentiable", "penetration",
                     "natural_map_residual", "all pairs"):
            self.assertIn(word, run.stdout)

    def test_mechanism(self):
        # Nothing presses the block down, so nothing holds it against the load along the floor.
        V = np.array([[1.0, 0], [0, 1]])
        solution = self.solve(self.write(np.eye(2), np.zeros(2), [0.3], V=V, s=[0.0, 1.0]), status=NOT_CONVERGED)
        self.assertEqual(solution["status"], "mechanism")
        self.assertTrue(solution["reason"])

    def test_not_converged_is_a_status(self):
        W, q, mu = random_problem(20, 2, seed=1, mu=0.9)
        run = scabo("contact", self.write(W, q, mu), "--json", "--solver", "newton_only", "--iterations", "1")
        self.assertEqual(run.returncode, NOT_CONVERGED, run.stdout)
        solution = json.loads(run.stdout)
        self.assertEqual(solution["status"], "not_converged")
        self.assertGreater(solution["natural_map_residual"], 1e-10)
        self.assertIn("did not converge: ", run.stderr)
        self.assertIn(solution["reason"], run.stderr)

    def test_one_pair_has_three_solutions_above_the_ratio_of_its_stiffnesses(self):
        # K = W^-1: a pair that sticks slides on its own when mu > K_tt / |K_tn| = 1 (docs/methods/21_uniqueness.md).
        K, q = np.array([[2.0, -1.0], [-1.0, 1.0]]), np.array([0.1, 1.0])
        W = np.linalg.inv(K)
        file = self.write(W, q, [1.5])
        solution = self.solve(file, "--uniqueness")
        uniqueness = solution["uniqueness"]
        self.assertEqual((uniqueness["unique"], uniqueness["others"], uniqueness["complete"]), ("several found", 2, True))
        self.assertGreaterEqual(uniqueness["bound"], 1.0)
        all_of_them = sorted([solution["r"]] + uniqueness["r"])
        np.testing.assert_allclose(all_of_them, [[0.0, 0.0], [0.2, -0.3], [0.8, -0.9]], atol=1e-10)
        indices = {(0.0, 0.0): 1, (0.2, -0.3): -1, (0.8, -0.9): 1}  # their sum is 1
        self.assertEqual(uniqueness["index"], indices[tuple(np.abs(np.round(solution["r"], 6)) * [1, -1] + 0.0)])
        self.assertNotIn("uniqueness", self.solve(file))
        table = scabo("contact", file, "--uniqueness").stdout
        self.assertRegex(table, r"Unique: several found \(2 others, no more\), bound [\d.]+, index -?1\n")

    def test_uniqueness_is_proven_with_little_friction_in_the_plane_and_in_space(self):
        for dimension in (2, 3):
            W, q, mu = random_problem(8, dimension, seed=3, mu=0.01)
            uniqueness = self.solve(self.write(W, q, mu), "--uniqueness")["uniqueness"]
            self.assertEqual((uniqueness["unique"], uniqueness["others"], uniqueness["r"]), ("proven", 0, []))
            self.assertLess(uniqueness["bound"], 1.0)

    def test_uniqueness_is_not_decided_where_bodies_are_held_by_contact_alone(self):
        V = np.array([[1.0, 1], [0, 0], [1, -1], [0, 0]])
        solution = self.solve(self.write(np.eye(4), np.zeros(4), [0, 0], V=V, s=[-3.0, 0.0]), "--uniqueness")
        self.assertEqual((solution["uniqueness"]["unique"], solution["uniqueness"]["bound"]), ("not decided", None))

    def test_uniqueness_of_what_is_not_solved_is_not_examined(self):
        V = np.array([[1.0, 0], [0, 1]])
        solution = self.solve(self.write(np.eye(2), np.zeros(2), [0.3], V=V, s=[0.0, 1.0]), "--uniqueness",
                              status=NOT_CONVERGED)
        self.assertNotIn("uniqueness", solution)

    def test_unknown_solver(self):
        run = scabo("contact", "no_such.hdf5", "--solver", "gaus_seidel")
        self.assertEqual((run.returncode, run.stdout), (WRONG_INPUT, ""))
        self.assertIn("there is no solver called 'gaus_seidel' (did you mean 'gauss_seidel'?); available are "
                      "b_differentiable, ", run.stderr)

    def test_wrong_command_lines(self):
        for arguments in ([], ["a.hdf5", "b.hdf5"], ["a.hdf5", "--tolerance", "0"], ["a.hdf5", "--tolerance", "tight"],
                          ["a.hdf5", "--iterations", "0"], ["a.hdf5", "--solver"], ["--trace"]):
            with self.subTest(arguments=arguments):
                run = scabo("contact", *arguments, cwd=self.directory)
                self.assertEqual((run.returncode, run.stdout), (WRONG_INPUT, ""))
                self.assertRegex(run.stderr, r"^scabo: .* \(see `scabo contact --help`\)\n$")

    def test_trace(self):
        file = self.write(*random_problem(8, 3, seed=2))
        for arguments, name in ((["--trace"], "problem.hdf5.trace.csv"), (["--trace=way.csv"], "way.csv"),
                                (["--trace", "other.csv"], "other.csv"), (["--trace"], "problem.hdf5.trace.csv")):
            solution = self.solve(file, *arguments)
            with open(self.directory / name, newline="", encoding="utf-8") as trace:
                rows = list(csv.DictReader(trace))
            self.assertEqual(list(rows[0]), ["iteration", "stage", "residual", "merit", "step_length", "states_changed"])
            self.assertGreaterEqual(len(rows), solution["iterations"])
            self.assertLess(float(rows[-1]["residual"]), 1e-9)
            picture = (self.directory / name).with_suffix(".svg").read_text(encoding="utf-8")
            self.assertIn("</svg>", picture)
        run = scabo("contact", "--json", "--trace", file, cwd=self.directory)  # the problem, not where its trace goes
        self.assertEqual(run.returncode, SOLVED, run.stderr)

    def test_trace_into_a_pipe(self):
        run = scabo("contact", self.write(*random_problem(2, 2, seed=2)), "--trace=/dev/stdout", cwd=self.directory)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertTrue(run.stdout.startswith("iteration,stage,residual"), run.stdout[:100])
        self.assertFalse(os.path.exists("/dev/stdout.svg"))

    def test_trace_never_over_a_file_of_another_kind(self):
        file = self.write(*random_problem(2, 2, seed=2))
        shutil.copy(file, self.directory / "precious.hdf5")
        run = scabo("contact", file, "--trace", "precious.hdf5", cwd=self.directory)
        self.assertEqual((run.returncode, run.stdout), (WRONG_INPUT, ""))
        self.assertIn("precious.hdf5: exists and is not a trace", run.stderr)
        self.assertEqual((self.directory / "precious.hdf5").read_bytes(), file.read_bytes())


if __name__ == "__main__":
    support.main()
