"""Values along lines: through the cells of bodies in space, over contact faces, and of lines.csv; and as tables."""
import csv
import pathlib
import tempfile
import types
import unittest

import made_up  # noqa: F401  the package for pictures
import numpy as np
from plot import paths, solids, vtu
from plot.results import ResultsError
from solids_test import brick_and_wedge, grid


def results_of(of=None, faces=None, table=None):
    """What the functions ask of a results directory, with one increment."""
    of_increment = {"step": 1, "increment": 1, "contacts": {"joint": {}}}
    return types.SimpleNamespace(in_space=True, directory=pathlib.Path("made_up"), title="made up", increments=[of_increment], number=lambda increment: 1,
                                 name_of=lambda number: "step 1, increment 1", fields=lambda number: of, faces=lambda number: faces, table=lambda name: table,
                                 summary={"model": {"bodies": [{"name": "one"}, {"name": "two"}]}})


class Through(unittest.TestCase):
    """Fields that are linear in the coordinates are exact, whatever the cells."""

    def with_fields(self, of):
        of.point_data.update(body=np.ones(len(of.points), dtype=int), displacement=of.points @ np.diag([0.01, -0.02, 0.03]), von_mises=3 + of.points[:, 0],
                             stress=of.points @ np.arange(18.0).reshape(3, 6), **{f"principal_{k}": k * of.points[:, 1] for k in (1, 2, 3)})
        return of

    def test_linear_fields(self):
        for of, first, last, part in ((grid(), (0.1, 0.2, 0.3), (0.3, 0.3, 0.2), 1.0), (brick_and_wedge(), (-1, 0.2, 0.1), (3, 0.3, 0.4), None)):
            path, = paths.paths_through(results_of(self.with_fields(of)), 1, first, last)
            x = path.points
            np.testing.assert_allclose(np.linalg.norm(x - np.array(first), axis=1), path.distance, atol=1e-12)
            np.testing.assert_allclose(path.values["von_mises"], 3 + x[:, 0], atol=1e-12)
            np.testing.assert_allclose(path.values["yz"], x @ np.arange(18.0).reshape(3, 6)[:, 4], atol=1e-12)
            np.testing.assert_allclose(path.values["displacement"], np.linalg.norm(x @ np.diag([0.01, -0.02, 0.03]), axis=1), atol=1e-12)
            if part:
                self.assertEqual(len(x), paths.POINTS)
            else:  # only what is inside
                self.assertGreater(x[:, 0].min(), -0.02)
                self.assertGreater(len(x), 85)
                self.assertLess(len(x), 90)

    def test_two_bodies_on_one_line(self):
        of = self.with_fields(brick_and_wedge())
        moved = of.points + np.array([0.0, 0.0, 1.0])
        twice = vtu.Grid(np.concatenate([of.points, moved]), np.concatenate([of.connectivity, of.connectivity + len(moved)]), np.concatenate([of.offsets, of.offsets + len(of.connectivity)]),
                         np.concatenate([of.types, of.types]), {key: np.concatenate([values, values + (key == "body")]) for key, values in of.point_data.items()}, {})
        one, two = paths.paths_through(results_of(twice), 1, (0.5, 0.5, 0.0), (0.5, 0.5, 2.0))
        self.assertEqual((one.name, two.name), ("one", "two"))
        self.assertEqual((one.distance[-1], two.distance[0]), (1.0, 1.0))  # both have the point between them

    def test_a_line_beside_the_bodies(self):
        with self.assertRaisesRegex(ResultsError, "meets no body"):
            paths.paths_through(results_of(self.with_fields(grid())), 1, (5, 5, 5), (6, 6, 6))

    def test_a_wrong_component_is_told(self):
        with self.assertRaisesRegex(ResultsError, "along a line there are von_mises, principal_1"):
            paths.lines(results_of(self.with_fields(grid())), component="sigma", along=((0, 0, 0), (1, 1, 1)))

    def test_a_picture_has_a_panel_for_each_component(self):
        figure = paths.lines(results_of(self.with_fields(grid())), component="zz,uz,von_mises", along=((0.1, 0.2, 0.3), (0.3, 0.3, 0.2)))
        drawn = [axis for axis in figure.axes if axis.get_visible()]
        self.assertEqual([axis.get_title(loc="left") or axis.get_title() for axis in drawn], ["stress zz", "displacement along z", "von Mises stress"])


class OverFaces(unittest.TestCase):
    def faces(self, turn):
        square = np.array([[0, 0, 2], [3, 0, 2], [3, 1, 2], [0, 1, 2]], dtype=float)
        data = {"contact": np.array([1] * 4), "normal": np.tile(np.array([0, 0, 1.0]) @ turn, (4, 1)), "pressure": np.array([0.0, 3.0, 3.0, 0.0]), "gap": np.zeros(4),
                "shear": np.tile([3.0, 4.0, 0.0], (4, 1)), "slip": np.zeros((4, 3)), "state": np.array([0, 1, 1, 0])}
        return vtu.Grid(square @ turn, np.array([0, 1, 2, 0, 2, 3]), np.array([3, 6]), np.array([5, 5]), data, {"contact": np.array([1, 1])})

    def test_pressure_along_a_face_in_any_direction(self):
        """A line above the face counts as it is seen along the normal; what lies beside it is left out."""
        for turn in (np.eye(3), solids.directions(30, 50)):
            first, last = np.array([-1, 0.5, 4.0]) @ turn, np.array([4, 0.5, 4.0]) @ turn
            of, = paths.contact_paths(results_of(faces=self.faces(turn)), 1, first, last)
            inside = (of.distance >= 1 - 1e-9) & (of.distance <= 4 + 1e-9)
            self.assertTrue(inside.all())
            self.assertEqual(len(of.distance), 121)
            np.testing.assert_allclose(of.values["pressure"], of.distance - 1, atol=1e-12)
            np.testing.assert_allclose(of.values["shear"], 5, atol=1e-12)
            self.assertEqual((of.states[0], of.states[-1]), ("open", "stick"))

    def test_a_line_beside_the_face(self):
        with self.assertRaisesRegex(ResultsError, "meets no contact face"):
            paths.contact_paths(results_of(faces=self.faces(np.eye(3))), 1, (0, 5, 0), (1, 5, 0))


class OfTheModel(unittest.TestCase):
    def table(self):
        rows = {"step": [1, 1, 1, 1, 2], "increment": [1, 1, 1, 1, 1], "name": ["axis"] * 5, "body": ["one", "one", "two", "two", "one"], "distance": [0, 1, 1, 2, 0],
                **{key: [0.0, 3, 3, 6, 9] for key in ("x", "y", "z", "ux", "uy", "von_mises", "stress_zz")}, "uz": [1.0, 0, 0, 0, 0]}
        return {key: np.array(column) for key, column in rows.items()}

    def test_a_curve_for_each_body_of_this_increment(self):
        one, two = paths.paths_of(results_of(table=self.table()), 1)
        self.assertEqual((one.name, two.name), ("axis, one", "axis, two"))
        np.testing.assert_array_equal(one.distance, [0, 1])
        np.testing.assert_array_equal(two.values["zz"], [3, 6])
        np.testing.assert_allclose(one.values["displacement"], [1, 3 * 2**0.5])

    def test_a_table(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "axis.csv")
            paths.write_table(results_of(table=self.table()), 1, "zz,uz", None, path)
            with open(path, encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), ["name", "distance", "x", "y", "z", "zz", "uz"])
        self.assertEqual([float(row["zz"]) for row in rows], [0, 3, 3, 6])


if __name__ == "__main__":
    unittest.main()
