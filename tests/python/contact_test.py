"""Discrete contact problems against closed forms, and against `scabo contact`."""
import json
import unittest

import h5py
import numpy as np

import scabo
from support import ROOT, program

EXAMPLE = ROOT / "examples" / "03_discrete_problem" / "problem.hdf5"


class ClosedForms(unittest.TestCase):
    def test_one_pair(self):
        """W = diag(w_n, w_t), q = (-c, s): p_n = c / w_n; the pair sticks if |s| / w_t <= mu p_n, else p_t = -mu p_n."""
        w_n, w_t, c = 2.0, 4.0, 3.0
        W = np.diag([w_n, w_t])
        for s, mu in ((0.5, 0.3), (-0.5, 0.3), (5.0, 0.3), (-5.0, 0.3), (1.0, 0.0)):
            solution = scabo.solve_contact(W, [-c, s], mu)
            p_n = c / w_n
            p_t = np.clip(-s / w_t, -mu * p_n, mu * p_n)
            np.testing.assert_allclose(solution.forces, [[p_n, p_t]], rtol=1e-12, atol=1e-12)
            np.testing.assert_allclose(solution.slip, [[s + w_t * p_t]], atol=1e-11)
            self.assertEqual(solution.state.tolist(), ["slip" if abs(s) / w_t > mu * p_n else "stick"])
            np.testing.assert_allclose(solution.gap, 0.0, atol=1e-12)
            self.assertLess(max(solution.certificate.values()), 1e-10)
        solution = scabo.solve_contact(W, [c, 0.7], 0.3)
        self.assertEqual((solution.state.tolist(), solution.forces.tolist()), (["open"], [[0.0, 0.0]]))
        np.testing.assert_allclose(solution.gap, [c])

    def test_cohesion_and_tension(self):
        W = np.eye(2)
        solution = scabo.solve_contact(W, [1.0, 2.0], 0.5, cohesion=0.5, tension=3.0)
        np.testing.assert_allclose(solution.forces, [[-1.0, -0.5]], atol=1e-12)  # held by tension, slips at the cohesion
        solution = scabo.solve_contact(W, [1.0, 0.0], 0.5, tension=0.25)
        np.testing.assert_allclose((solution.forces[0, 0], solution.gap[0]), (-0.25, 0.75), atol=1e-12)

    def test_space(self):
        """The tangential force lies on the circle of Coulomb, against the slip."""
        solution = scabo.solve_contact(np.diag([1.0, 2.0, 2.0]), [-1.0, 3.0, 4.0], 0.5, dimension=3)
        np.testing.assert_allclose(solution.forces, [[1.0, -0.3, -0.4]], atol=1e-10)
        self.assertEqual(solution.slip.shape, (1, 2))

    def test_rigid_motions(self):
        """A rigid block of weight 2 on two springs under its ends: each carries 1."""
        W = np.diag([1.0, 1.0, 1.0, 1.0])
        G = np.array([[1.0, -1.0], [0.0, 0.0], [1.0, 1.0], [0.0, 0.0]])
        solution = scabo.solve_contact(W, np.zeros(4), 0.0, G=G, f=[-2.0, 0.0])
        np.testing.assert_allclose(solution.forces[:, 0], [1.0, 1.0], atol=1e-12)
        np.testing.assert_allclose(solution.rigid_motions, [-1.0, 0.0], atol=1e-12)
        with self.assertRaises(scabo.Mechanism) as failed:
            scabo.solve_contact(W, np.zeros(4), 0.0, G=G, f=[2.0, 0.0])  # it flies away
        self.assertEqual(failed.exception.result.status, "mechanism")
        self.assertEqual(failed.exception.result.unrestrained_motion.shape, (2,))

    def test_units_of_rigid_motions(self):
        """Forces do not depend on the unit of a column of G."""
        W = np.diag([1.0, 1.0, 1.0, 1.0])
        G = np.array([[1.0, -1.0], [0.0, 0.0], [1.0, 1.0], [0.0, 0.0]])
        for unit in ([2.0**-40, 2.0**-40], [2.0**40, 2.0**-30]):
            solution = scabo.solve_contact(W, np.zeros(4), 0.0, G=G * unit, f=np.array([-2.0, 0.0]) * unit)
            np.testing.assert_allclose(solution.forces[:, 0], [1.0, 1.0], atol=1e-12)
            np.testing.assert_allclose(solution.rigid_motions * unit, [-1.0, 0.0], atol=1e-12)

    def test_sparse(self):
        W = np.array([[2.0, 0.3, 0.1, 0.0], [0.3, 1.0, 0.0, 0.0], [0.1, 0.0, 2.0, -0.2], [0.0, 0.0, -0.2, 1.0]])
        q = [-1.0, 2.0, -0.5, 0.01]
        np.testing.assert_allclose(scabo.solve_contact(Columns(W), q, 0.4).forces, scabo.solve_contact(W, q, 0.4).forces,
                                   atol=1e-10)

    def test_units_do_not_matter(self):
        random = np.random.default_rng(3)
        A = random.normal(size=(12, 12))
        W, q = A @ A.T + 0.1 * np.eye(12), random.normal(size=12)
        forces = scabo.solve_contact(W, q, 0.3).forces
        for unit in (1e-12, 1e9):
            np.testing.assert_allclose(scabo.solve_contact(unit * W, q, 0.3).forces * unit, forces, rtol=1e-7, atol=1e-9)
        turned = q.copy()
        turned[1::2] *= -1
        mirror = np.diag(np.tile([1.0, -1.0], 6))
        np.testing.assert_allclose(scabo.solve_contact(mirror @ W @ mirror, turned, 0.3).forces, forces * [1, -1],
                                   rtol=1e-7, atol=1e-9)

    def test_infeasible(self):
        """A frictionless wedge that is pressed apart: W = 0 normal to what could carry it."""
        with self.assertRaises(scabo.NotConverged) as failed:
            scabo.solve_contact(np.zeros((2, 2)), [-1.0, 0.0], 0.3)
        self.assertIn(failed.exception.result.status, ("infeasible", "not_converged"))
        self.assertIn(failed.exception.result.reason, str(failed.exception))

    def test_arguments_that_do_not_fit(self):
        W, q = np.eye(2), [-1.0, 0.0]
        for arguments, message in (
                (dict(q=[-1.0]), "multiple"), (dict(W=np.eye(3)), "W must have the shape"), (dict(mu=-0.1), "mu"),
                (dict(mu=[0.1, 0.2]), "mu"), (dict(mu=np.nan), "mu"), (dict(q=[np.nan, 0.0]), "q contains"),
                (dict(W=np.full((2, 2), np.inf)), "W contains"), (dict(dimension=1), "dimension"),
                (dict(G=np.eye(3)), "G must"), (dict(f=[1.0]), "f must have 0"), (dict(cohesion=-1.0), "cohesion"),
                (dict(start=[1.0]), "start"), (dict(judge="me"), "judge"), (dict(tolerance=0.0), "tolerance"),
                (dict(tolerance=1.0), "tolerance"), (dict(iterations=0), "iterations"), (dict(force_scale=-1.0), "force_scale"),
                (dict(time_limit=0.0), "time_limit"), (dict(threads=0), "threads")):
            with self.subTest(**{key: str(value) for key, value in arguments.items()}):
                with self.assertRaisesRegex(ValueError, message):
                    scabo.solve_contact(**{**dict(W=W, q=q, mu=0.3), **arguments})

    def test_complex_numbers_are_refused(self):
        """NumPy would drop imaginary parts with a warning; so are masked values and text."""
        W, q, G, f = np.eye(2), np.array([-1.0, 0.0]), np.array([[1.0], [0.0]]), np.array([-1.0])
        for name, value in (("W", W), ("q", q), ("mu", np.array([0.3])), ("G", G), ("f", f), ("cohesion", np.array([1.0])),
                            ("start", q)):
            with self.subTest(name), self.assertRaisesRegex(ValueError, f"^{name} must be real, not of dtype complex128"):
                scabo.solve_contact(**{**dict(W=W, q=q, mu=0.3, G=G, f=f), name: value + 1j})
        for value in (np.ma.masked_array(q, [True, False]), ["-1", "0"], np.array(["-1", "0"], dtype=object), [-1j, object()]):
            with self.subTest(value=str(value)), self.assertRaisesRegex(ValueError, "^q "):
                scabo.solve_contact(W=W, q=value, mu=0.3)

    def test_unsymmetric_flexibilities_are_refused(self):
        W, q = np.array([[2.0, 0.1, 0.0, 0.0], [0.1, 3.0, 0.0, 0.0], [0.0, 0.0, 2.0, 0.2], [0.0, 0.0, 0.2, 1.0]]), [-1.0, 0.0] * 2
        forces = scabo.solve_contact(W, q, 0.3).forces
        wrong, slightly = W.copy(), W.copy()
        wrong[3, 1], slightly[3, 1] = 0.5, 1e-9
        for made in (np.array, Columns):
            with self.assertRaisesRegex(ValueError, r"W must be symmetric, but W\[(3, 1\] is 0.5 and W\[1, 3\] is 0|1, 3\] is 0 and)"):
                scabo.solve_contact(made(wrong), q, 0.3)
            np.testing.assert_allclose(scabo.solve_contact(made(slightly), q, 0.3).forces, forces, rtol=1e-7)
        self.assertEqual(scabo.solve_contact(np.zeros((0, 0)), [], 0.3).forces.shape, (0, 2))


class Columns:
    """What is needed of scipy.sparse."""

    def __init__(self, dense):
        self.dense, self.shape = dense, dense.shape

    def tocsc(self):
        columns = [np.flatnonzero(column) for column in self.dense.T]
        self.indptr = np.cumsum([0, *map(len, columns)]).astype(np.int32)
        self.indices = np.concatenate(columns).astype(np.int64)
        self.data = np.concatenate([self.dense[rows, k] for k, rows in enumerate(columns)])
        return self

    def sort_indices(self):
        pass


class SameAsTheProgram(unittest.TestCase):
    def test_saved_problem(self):
        with h5py.File(EXAMPLE) as file:
            local, guess = file["fclib_local"], file["guesses/1"]
            problem = dict(W=columns_of(local["W"]), q=local["vectors/q"][...], mu=local["vectors/mu"][...],
                           G=columns_of(local["V"]), f=local["vectors/s"][...], start=guess["r"][...],
                           start_motions=guess["l"][...], force_scale=file["scabo/force_scale"][0])
        done = program("contact", EXAMPLE, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        expected = json.loads(done.stdout)
        solution = scabo.solve_contact(**problem)
        np.testing.assert_allclose(solution.forces.reshape(-1), expected["r"], rtol=1e-9, atol=1e-3)
        self.assertEqual(solution.state.tolist(), expected["states"])
        self.assertEqual(solution.iterations, expected["iterations"])


def columns_of(group):
    """A matrix of the file, whose columns are compressed, as an array."""
    m, n, p, i, x = (group[name][...] for name in ("m", "n", "p", "i", "x"))
    dense = np.zeros((m[0], n[0]))
    for column in range(n[0]):
        entries = slice(p[column], p[column + 1])
        dense[i[entries], column] = x[entries]
    return dense


if __name__ == "__main__":
    unittest.main()
