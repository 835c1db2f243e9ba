"""Single super-elements against closed forms."""
import ctypes
import pathlib
import unittest

import numpy as np

import scabo

SQUARE = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]


class Closed(unittest.TestCase):
    def test_exact_for_linear_displacements(self):
        """u = A x: K u is the resultant of the uniform traction sigma n on the boundary, and the field inside is the same."""
        young, poisson, thickness = 3.0, 0.2, 0.5
        for plane, order in (("stress", 1), ("stress", 2), ("strain", 3)):
            nodes = scabo.boundary_nodes(SQUARE, 0.5, order)
            element = scabo.SuperElement(nodes, young, poisson, plane=plane, order=order, thickness=thickness)
            gradient = np.array([[0.3, -0.1], [0.4, 0.2]])
            u = nodes @ gradient.T
            exx, eyy, gxy = gradient[0, 0], gradient[1, 1], gradient[0, 1] + gradient[1, 0]
            if plane == "stress":
                scale, nu = young / (1 - poisson**2), poisson
            else:
                scale, nu = young / (1 - (poisson / (1 - poisson))**2) / (1 - poisson**2), poisson / (1 - poisson)
            stress = scale * np.array([exx + nu * eyy, eyy + nu * exx, 0.5 * (1 - nu) * gxy])
            at = np.array([[0.3, 0.4], [1.9, 0.9], [1.0, 0.5]])
            moved, found = element.field(u, at)
            np.testing.assert_allclose(moved, at @ gradient.T, atol=1e-11)
            np.testing.assert_allclose(found, np.tile(stress, (3, 1)), atol=1e-10)
            forces = (element.stiffness @ u.reshape(-1)).reshape(-1, 2)
            right = np.isclose(nodes[:, 0], 2.0) & (nodes[:, 1] > 1e-9) & (nodes[:, 1] < 1 - 1e-9)
            # The forces of the inner nodes of the right edge are those of sigma n = [xx, xy].
            np.testing.assert_allclose(forces[right][:, 1] * stress[0], forces[right][:, 0] * stress[2], atol=1e-11)
            np.testing.assert_allclose(forces.sum(axis=0), 0.0, atol=1e-11)
            work = u.reshape(-1) @ element.stiffness @ u.reshape(-1)
            self.assertAlmostEqual(work, thickness * 2.0 * stress @ [exx, eyy, gxy], delta=1e-11)

    def test_exponents(self):
        nodes = scabo.boundary_nodes(SQUARE, 0.25)
        element = scabo.SuperElement(nodes, 1.0, 0.3)
        self.assertEqual(len(element.exponents), nodes.size)
        np.testing.assert_array_equal(element.exponents[:2], 0.0)                  # translations
        np.testing.assert_allclose(element.exponents[2:6], 1.0, atol=1e-5)         # rotation, constant strains
        self.assertGreater(element.exponents[6].real, 1.9)
        np.testing.assert_array_equal(element.stiffness, element.stiffness.T)

    def test_crack(self):
        """Of an open super-element with coinciding faces: two exponents of a half."""
        closed = np.array([[1.0, 0.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, 0.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 0.0]])
        nodes = [np.linspace(a, b, 17)[:-1] for a, b in zip(closed, closed[1:])]
        nodes = np.concatenate([*nodes, closed[-1:]])
        element = scabo.SuperElement(nodes, 1.0, 0.3, centre=[0, 0], open=True, order=2)
        np.testing.assert_allclose(np.sort(element.exponents.real)[2:4], 0.5, atol=1e-3)

    def test_coefficient_matrices(self):
        element = scabo.SuperElement(scabo.boundary_nodes(SQUARE, 0.5), 1.0, 0.3)
        E0, E1, E2 = element.coefficient_matrices
        K = element.stiffness
        # The stiffness solves the Riccati equation (K - E1) E0^-1 (K - E1') = E2.
        np.testing.assert_allclose((K - E1) @ np.linalg.solve(E0, K - E1.T), E2, atol=1e-10)
        self.assertEqual(E0.shape, K.shape)

    def test_unbounded(self):
        angles = np.linspace(0.0, 2 * np.pi, 33)[:-1]
        circle = np.column_stack([np.cos(angles), np.sin(angles)])
        outside = scabo.SuperElement(circle, 1.0, 0.25, order=2, unbounded=True, plane="strain")
        pressure = circle.reshape(-1)  # u = x: a hole of radius 1 opened by 1: energy 2 pi E / (1 + nu) * 1 (2 G p = u / r)
        shear = 1.0 / (2 * 1.25)
        self.assertAlmostEqual(pressure @ outside.stiffness @ pressure / (2 * np.pi * 2 * shear), 1.0, delta=0.02)
        self.assertTrue((outside.exponents.real <= 1e-12).all())

    def test_what_cannot_be_solved(self):
        nodes = scabo.boundary_nodes(SQUARE, 0.5)
        for arguments, message in (
                (dict(nodes=nodes[::-1]), "counter-clockwise"),
                (dict(nodes=nodes[:-1]), "multiple of 2"),
                (dict(nodes=nodes.tolist() + [[np.nan, 0], [0, 0]]), "finite"),
                (dict(nodes=[1, 2, 3]), "shape"),
                (dict(young=0.0), "young"), (dict(young=-1.0), "young"), (dict(young=float("inf")), "young"),
                (dict(poisson=0.6), "poisson"), (dict(poisson=0.5, plane="strain"), "poisson"),
                (dict(plane="stres"), "plane"), (dict(order=0), "order"), (dict(order=17), "order"),
                (dict(order=2.0), "order"), (dict(centre=[5, 5]), "ill-posed"), (dict(centre=[1]), "centre"),
                (dict(open=True), "multiple|scaling centre"), (dict(threads=0), "threads"), (dict(thickness=0), "thickness")):
            with self.subTest(**{key: str(value)[:30] for key, value in arguments.items()}):
                with self.assertRaisesRegex(ValueError, message):
                    scabo.SuperElement(**{**dict(nodes=nodes, young=1.0, poisson=0.3), **arguments})
        element = scabo.SuperElement(nodes, 1.0, 0.3)
        with self.assertRaisesRegex(ValueError, "displacements"):
            element.field(np.zeros(3), [[1, 0.5]])
        self.assertTrue(np.isnan(element.field(np.zeros(nodes.size), [[9.0, 9.0]])[0]).all())

    def test_complex_numbers_are_refused(self):
        nodes = scabo.boundary_nodes([[0, 0], [1, 0], [1, 1], [0, 1]], 0.5)
        element, u = scabo.SuperElement(nodes, 1.0, 0.3), nodes.copy()
        for name, call in (("nodes", lambda: scabo.SuperElement(nodes + 0j, 1.0, 0.3)),
                           ("centre", lambda: scabo.SuperElement(nodes, 1.0, 0.3, centre=np.array([0.5, 0.5]) + 1j)),
                           ("displacement", lambda: element.field(u + 1j, [[0.5, 0.5]])),
                           ("points", lambda: element.field(u, np.array([[0.5, 0.5]]) + 1j)),
                           ("vertices", lambda: scabo.boundary_nodes(nodes + 1j, 0.5))):
            with self.subTest(name), self.assertRaisesRegex(ValueError, f"^{name} must be real"):
                call()

    def test_boundary_nodes(self):
        np.testing.assert_allclose(scabo.boundary_nodes([[0, 0], [1, 0], [0, 1]], 2.0, 1), [[0, 0], [1, 0], [0, 1]])
        nodes = scabo.boundary_nodes(SQUARE, 1.0, 3)
        self.assertEqual(len(nodes), 6 * 3)
        self.assertAlmostEqual(nodes[1, 0], 0.5 * (1 - 1 / np.sqrt(5.0)), delta=1e-15)  # zeros of P_3'
        for wrong in (dict(vertices=[[0, 0]], size=1.0), dict(vertices=SQUARE, size=0.0),
                      dict(vertices=SQUARE, size=1.0, order=0)):
            with self.assertRaises(ValueError):
                scabo.boundary_nodes(**wrong)
        with self.assertRaisesRegex(ValueError, "coordinates of all vertices must be finite"):
            scabo.boundary_nodes([[0, 0], [1, 0], [1, np.nan]], 0.5)


class NumPy(unittest.TestCase):
    def test_its_products_stay_the_same(self):
        A = np.random.default_rng(1).normal(size=(300, 300))
        before = A @ A
        scabo.SuperElement(scabo.boundary_nodes(SQUARE, 0.05), 1.0, 0.3).exponents
        np.testing.assert_array_equal(A @ A, before)

    def test_its_threads_are_restored(self):
        names = [line.split()[-1] for line in pathlib.Path("/proc/self/maps").read_text().splitlines()
                 if "libopenblas" in line]
        if not names:
            self.skipTest("another BLAS")
        blas = ctypes.CDLL(names[0])
        before = blas.openblas_get_num_threads()
        try:
            blas.openblas_set_num_threads(2)
            scabo.SuperElement(scabo.boundary_nodes(SQUARE, 0.5), 1.0, 0.3).exponents
            scabo.solve_contact([[1.0, 0.0], [0.0, 1.0]], [-1.0, 0.0], 0.5)
            self.assertEqual(blas.openblas_get_num_threads(), 2)
        finally:
            blas.openblas_set_num_threads(before)


if __name__ == "__main__":
    unittest.main()
