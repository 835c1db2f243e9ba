"""Pictures of bodies in space: what is seen of them, and the maps of their contact faces."""
import unittest

import made_up  # noqa: F401  the package for pictures
import numpy as np
from plot import cuts, geometry, solids, tetrahedra, vtu


def grid():
    """Two tetrahedra with one facet in common; quadratic, straight edges; displacement (0, 0, z)."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], dtype=float)
    points, numbers, cells = list(corners), {}, []
    for cell in ([0, 1, 2, 3], [1, 2, 3, 4]):
        a, b, c, d = corners[cell]
        if np.cross(b - a, c - a) @ (d - a) < 0:
            cell = [cell[1], cell[0], *cell[2:]]
        middles = []
        for i, j in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)):
            key = tuple(sorted((cell[i], cell[j])))
            if key not in numbers:
                numbers[key] = len(points)
                points.append(0.5 * (corners[cell[i]] + corners[cell[j]]))
            middles.append(numbers[key])
        cells += cell + middles
    points = np.array(points)
    displacement = np.zeros_like(points)
    displacement[:, 2] = points[:, 2]
    return vtu.Grid(points, np.array(cells), np.array([10, 20]), np.array([24, 24], dtype="u1"),
                    {"displacement": displacement, "von_mises": points[:, 0], "stress": np.tile(np.arange(6.0), (len(points), 1))}, {})


def brick_and_wedge():
    """A unit cube of 20 points, and a wedge of 15 on its right side."""
    places, numbers = [], {}

    def number(place):
        if tuple(place) not in numbers:
            numbers[tuple(place)] = len(places)
            places.append(place)
        return numbers[tuple(place)]

    def cell(kind, corners):
        corners = np.array(corners, dtype=float)
        return [number(x) for x in corners] + [number(0.5 * (corners[i] + corners[j])) for i, j in tetrahedra.EDGES[kind]]
    brick = cell(25, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    wedge = cell(26, [[1, 0, 0], [2, 0, 0], [1, 1, 0], [1, 0, 1], [2, 0, 1], [1, 1, 1]])
    return vtu.Grid(np.array(places), np.array(brick + wedge), np.array([20, 35]), np.array([25, 26], dtype="u1"), {}, {})


class Cut(unittest.TestCase):
    """What a plane leaves of a body is closed: the surface that is left and the section, turned outwards, have the volume that is left."""

    def left_of(self, of, point, normal, fine=False):
        surface = tetrahedra.triangles_of(tetrahedra.outer_facets(of))
        return cuts.cut_surface(of.points, surface, tetrahedra.tetrahedra_of(of, fine), point, normal)

    def volume(self, left, points):
        a, b, c = left.of(points)[left.corners].transpose(1, 0, 2)
        return np.einsum("ij,ij->", a, np.cross(b, c)) / 6, np.cross(b - a, c - a).sum(axis=0) / 2

    def test_volumes_of_a_cube_and_a_wedge(self):
        of = brick_and_wedge()
        for point, normal, volume in (((0.3, 0, 0), (1, 0, 0), 0.3), ((0.3, 0, 0), (-2, 0, 0), 1.2), ((0, 0, 0.25), (0, 0, 1), 0.375), ((0.5, 0.5, 0.5), (1, 1, 1), 0.5 + 1 / 48)):
            left = self.left_of(of, point, normal)
            found, area = self.volume(left, of.points)
            self.assertAlmostEqual(found, volume, places=12)
            np.testing.assert_allclose(area, 0, atol=1e-12)  # closed
            self.assertGreater(len(left.outline), 0)
            on = left.of(of.points)[left.outline.ravel()]
            np.testing.assert_allclose((on - point) @ np.array(normal), 0, atol=1e-12)
            np.testing.assert_allclose(left.of(of.points[:, 0] + 3 * of.points[:, 1]), left.of(of.points) @ [1, 3, 0], atol=1e-12)

    def test_the_section_of_quadratic_tetrahedra_fits_their_facets(self):
        """Also where their middle nodes are moved."""
        of = grid()
        moved = of.points + 0.05 * np.sin(9 * of.points[:, [1, 2, 0]])
        left = self.left_of(of, (0.3, 0, 0), (1, 0.2, -0.1), fine=True)
        np.testing.assert_allclose(self.volume(left, moved)[1], 0, atol=1e-12)
        whole = self.left_of(of, (9, 0, 0), (1, 0, 0), fine=True)
        self.assertEqual(len(whole.outline), 0)
        other = self.left_of(of, (0.3, 0, 0), (-1, -0.2, 0.1), fine=True)
        self.assertAlmostEqual(self.volume(left, moved)[0] + self.volume(other, moved)[0], self.volume(whole, moved)[0], places=12)


class Seen(unittest.TestCase):
    def test_facets_outside_are_those_of_one_cell_and_turn_outwards(self):
        of = grid()
        both = tetrahedra.outer_facets(of)
        facets, none = both
        self.assertEqual((len(facets), len(none)), (6, 0))
        middle = of.points[:5].mean(axis=0)
        volume = 0.0
        for a, b, c in of.points[facets[:, :3]]:
            self.assertGreater(np.cross(b - a, c - a) @ (a - middle), 0)
            volume += np.cross(b, c) @ a / 6
        self.assertAlmostEqual(volume, 1 / 6 + 1 / 3)
        for k in range(3):
            np.testing.assert_allclose(of.points[facets[:, 3 + k]], 0.5 * (of.points[facets[:, k]] + of.points[facets[:, (k + 1) % 3]]))
        self.assertEqual(len(tetrahedra.triangles_of(both)), 24)

    def test_hexahedra_and_wedges_have_facets_edges_and_tetrahedra(self):
        of = brick_and_wedge()
        triangles, squares = tetrahedra.outer_facets(of)
        self.assertEqual((len(triangles), len(squares)), (2, 5 + 2))
        drawn = of.points[tetrahedra.triangles_of([triangles, squares])]
        self.assertEqual(len(drawn), 2 * 4 + 7 * 6)
        volume = lambda corners: np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6
        self.assertAlmostEqual(np.einsum("ij,ij->", drawn[:, 0], np.cross(drawn[:, 1], drawn[:, 2])) / 6, 1.5)  # all turn outwards
        parts = of.points[tetrahedra.tetrahedra_of(of)]
        self.assertTrue((np.linalg.det(parts[:, 1:] - parts[:, :1]) > 0.1).all())
        self.assertAlmostEqual(volume(parts), 1.5)
        chains = tetrahedra.sharp_edges(of.points, [triangles, squares])
        np.testing.assert_allclose(of.points[chains[:, 1]], 0.5 * (of.points[chains[:, 0]] + of.points[chains[:, 2]]))
        self.assertEqual(len(chains), 12 + 9 - 4 - 3)  # those around the side in common are one, three of them flat

    def test_directions_are_a_turn(self):
        for view in ((-60, 25), (0, 90), (135, -40)):
            axes = solids.directions(*view)
            np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-15)
            self.assertAlmostEqual(np.linalg.det(axes), 1.0)
        np.testing.assert_allclose(solids.directions(0, 0)[2], [1, 0, 0], atol=1e-15)

    def test_the_nearest_triangle_is_seen_with_its_values(self):
        points = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 1], [2, 0, 1], [0, 2, 1]], dtype=float)
        image = solids.seen_image(points, np.array([[0, 1, 2], [3, 4, 5]]), np.array([0, 4, 8, -1, -1, -1.0]), pixels=80)
        at = lambda x, y: image.values[int((y - image.low[1]) / image.pixel), int((x - image.low[0]) / image.pixel)]
        self.assertEqual(at(0.5, 0.5), -1)
        self.assertAlmostEqual(at(2.0, 1.0), 2 + 2 * 1.0, delta=0.2)
        self.assertTrue(np.isnan(at(3.5, 3.5)))
        behind = solids.visible_pieces(image, np.array([[0, 1, 1]]), points)
        self.assertLess(len(behind), 12)  # the part under the near triangle is hidden

    def test_values_of_components(self):
        of = grid()
        np.testing.assert_array_equal(tetrahedra.values_of(of, "yz"), 4)
        np.testing.assert_array_equal(tetrahedra.values_of(of, "uz"), of.points[:, 2])
        np.testing.assert_array_equal(tetrahedra.values_of(of, "displacement"), of.points[:, 2])
        self.assertEqual(tetrahedra.magnification_of(of), 1.0)


class Maps(unittest.TestCase):
    def test_a_face_across_an_axis_keeps_the_other_two_and_any_other_its_lengths(self):
        square = np.array([[0, 0, 2], [3, 0, 2], [3, 1, 2], [0, 1, 2]], dtype=float)
        turn = solids.directions(30, 50)
        for turned in (False, True):
            points, normal = (square @ turn, np.array([0, 0, 1]) @ turn) if turned else (square, np.array([0, 0, 1.0]))
            data = {"contact": np.array([2] * 4), "normal": np.tile(normal, (4, 1)), "pressure": np.arange(4.0), "gap": np.zeros(4),
                    "shear": np.tile([3.0, 4.0, 0.0], (4, 1)), "slip": np.zeros((4, 3)), "state": np.array([0, 1, 2, 1])}
            of = tetrahedra.map_of("joint", vtu.Grid(points, np.array([0, 1, 2, 0, 2, 3]), np.array([3, 6]), np.array([5, 5]), data,
                                                 {"contact": np.array([2, 2])}), 2)
            self.assertAlmostEqual(geometry.areas(of.places, of.corners).sum(), 3.0)
            one = tetrahedra.map_of("joint", vtu.Grid(points, np.array([0, 1, 2, 3]), np.array([4]), np.array([9]), data, {"contact": np.array([2])}), 2)
            self.assertAlmostEqual(geometry.areas(one.places, one.corners).sum(), 3.0)
            np.testing.assert_array_equal(of.values["shear"], 5.0)
            self.assertEqual(list(of.states), ["open", "stick", "slip", "stick"])
            if not turned:
                self.assertEqual(of.axes, ("x", "y"))


if __name__ == "__main__":
    unittest.main()
