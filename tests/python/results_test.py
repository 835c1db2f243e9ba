"""Arrays of results: memory without copies, tables as the files of the program, values at points."""
import csv
import gc
import json
import pathlib
import sys
import types
import unittest
import unittest.mock

import numpy as np

import scabo
from support import BEAM, ROOT, InTemporaryDirectory, block, program


def address(array):
    return array.__array_interface__["data"][0]


def copies(array):
    """Whether asking twice gives the same memory: a copy would be elsewhere while the first one lives."""
    return address(array()) != address(array())


class Growth(InTemporaryDirectory):
    def test_cracks_are_the_columns_of_the_file(self):
        model = scabo.read(ROOT / "apps" / "scabo" / "models" / "growth.yaml")
        model["steps"][0]["growth"]["until"] = {"steps": 2}
        result = model.run(output=self.directory / "results")
        with open(self.directory / "results" / "cracks.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(result.cracks), ["beam.flaw.end"])
        columns = result.cracks["beam.flaw.end"]
        self.assertEqual(set(columns), set(rows[0]) - {"step", "tip"})
        for name, values in columns.items():
            expected = [float(row[name] or "nan") for row in rows]
            np.testing.assert_array_equal(values, np.array(expected) - 1 if name == "increment" else expected, name)
        np.testing.assert_allclose(np.diff(columns["length"]), 0.02, atol=1e-12)
        self.assertTrue((np.diff(columns["opening"]) > 0).all() and (np.diff(columns["displacement"]) > 0).all())


class Memory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = scabo.read(BEAM).run()

    def test_arrays_are_those_of_the_solver(self):
        result, contact = self.result, self.result.contact["joint"]
        for array in (lambda: result.nodes("lower"), lambda: result.nodal_displacement("upper"),
                      lambda: contact.table()["pressure"], lambda: contact.table()["pair"]):
            first, second = array(), array()
            self.assertEqual(address(first), address(second))
            self.assertFalse(first.flags.owndata)
            self.assertFalse(first.flags.writeable)
            with self.assertRaises(ValueError):
                first[0] = 1
        table = contact.table()
        step = table["gap"].strides[0]
        self.assertEqual(step, table["pressure"].strides[0])  # members of one list of pairs
        self.assertLess(abs(address(table["gap"]) - address(table["pressure"])), step)

    def test_memory_lives_as_long_as_the_array(self):
        result = scabo.Model(block()).run()
        pressure = result.contact["base"].table()["pressure"]
        expected = pressure.copy()
        del result
        gc.collect()
        other = scabo.Model(block())  # would take the memory if it were free
        other["loads"]["push"]["traction"] = [0.0, -1e6]
        other.run()
        np.testing.assert_array_equal(pressure, expected)

    def test_a_million_values(self):
        nodes = scabo.boundary_nodes([[0, 0], [2, 0], [2, 1], [0, 1]], 6 / 250.0, order=2)
        element = scabo.SuperElement(nodes, 1.0, 0.3)
        stiffness = element.stiffness
        self.assertGreaterEqual(stiffness.size, 1_000_000)
        self.assertEqual(address(stiffness), address(element.stiffness))
        self.assertFalse(stiffness.flags.owndata)


class Tables(InTemporaryDirectory):
    def test_columns_are_those_of_contact_csv(self):
        content = block()
        content["steps"] = [{"name": "press", "increments": 3}]
        file = self.directory / "block.yaml"
        file.write_text(json.dumps(content))
        program("run", file, "-o", self.directory / "results")
        result = scabo.read(file).run()
        with open(self.directory / "results" / "contact.csv", newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual(len(result.increments), 3)
        for increment in range(3):
            table = result.contact["base"].table(increment)
            of_file = [row for row in rows if row["increment"] == str(increment + 1)]
            self.assertEqual(len(of_file), len(table["pair"]))
            for name in of_file[0]:
                if name in ("step", "increment", "contact"):
                    continue
                if name == "state":
                    self.assertEqual(table[name].tolist(), [row[name] for row in of_file])
                else:
                    np.testing.assert_array_equal(table[name], [float(row[name]) for row in of_file], name)
        np.testing.assert_array_equal(result.contact["base"].table(2)["slip"], result.contact["base"].table()["slip"])
        history = result.contact["base"].history()
        self.assertEqual(history["normal_force"].tolist(),
                         [increment["contacts"]["base"]["normal_force"] for increment in result.summary["increments"]])
        np.testing.assert_array_equal(history["open"] + history["stick"] + history["slip"], 41)

    def test_frame(self):
        result = scabo.Model(block()).run()
        try:
            import pandas  # noqa: F401
        except ImportError:
            with self.assertRaisesRegex(ImportError, "pandas"):
                result.contact["base"].frame()
            return
        frame = result.contact["base"].frame()
        self.assertEqual(list(frame.columns), list(result.contact["base"].table()))
        self.assertEqual(frame[frame.state != "open"].normal_force.sum(), frame.normal_force.sum())

    def test_names_and_numbers_that_do_not_exist(self):
        result = scabo.Model(block()).run()
        with self.assertRaisesRegex(KeyError, "no contact named 'bse'; there are: base"):
            result.contact["bse"]
        with self.assertRaisesRegex(KeyError, "no body named 'blok'"):
            result.nodes("blok")
        for wrong in (0.5, "last", None):
            with self.assertRaisesRegex(TypeError, "increment must be"):
                result.contact["base"].table(wrong)
        for wrong in (1, -2):
            with self.assertRaisesRegex(IndexError, "no increment"):
                result.contact["base"].table(wrong)
        with self.assertRaisesRegex(AttributeError, "newton_iterations"):
            result.increments[0].iterations
        self.assertEqual(result.increments[-1].certificate, result.summary["increments"][-1]["certificate"])

    def test_fields_that_were_not_kept(self):
        model = scabo.Model(block())
        model["steps"] = [{"name": "press", "increments": 3}]
        lean, full = model.run(keep_fields=False), model.run()
        np.testing.assert_array_equal(lean.contact["base"].table()["slip"], full.contact["base"].table()["slip"])
        self.assertEqual(lean.contact["base"].history()["max_pressure"].tolist(),
                         full.contact["base"].history()["max_pressure"].tolist())
        for call in (lambda: lean.contact["base"].table(0), lambda: lean.nodal_displacement("block", 1),
                     lambda: lean.stress([[1, 0.5]], increment=0), lambda: lean.save(self.directory / "results")):
            with self.assertRaisesRegex(LookupError, "not kept"):
                call()


class Points(InTemporaryDirectory):
    def test_body_of_revolution(self):
        """A shaft under pressure all around: radial and hoop stress -p, u = -(1 - nu) p r / E, also on the axis; pictures of both halves."""
        model = scabo.Model({
            "scabo": 1, "analysis": {"plane": "axisymmetric"}, "materials": {"m": {"young": 400.0, "poisson": 0.25}},
            "bodies": {"shaft": {"material": "m", "shape": {"rectangle": {"corner": [0, 0], "size": [2, 1]}}, "mesh": {"size": 0.5}}},
            "supports": [{"on": "shaft.bottom", "fix": "y"}],
            "loads": {"grip": {"on": "shaft.right", "pressure": 3.0}}})
        result = model.run()
        points = np.array([[1.0, 0.5], [0.3, 0.2], [0.0, 1.0]])
        np.testing.assert_allclose(result.stress(points), np.tile([-3.0, 0, 0, -3.0], (3, 1)), atol=1e-11)
        np.testing.assert_allclose(result.displacement(points)[:, 0], -0.75 * 3.0 / 400.0 * points[:, 0], atol=1e-14)
        drawn = result.plot("stress", component="zz", mirrored=True)
        self.assertAlmostEqual(drawn.axes[0].dataLim.x0, -drawn.axes[0].dataLim.x1)

    def test_whose_forces_a_table_has(self):
        """A cylinder under pressure on a floor: the force on it is that of the angle that the table names."""
        for forces, angle in (("whole", 2 * np.pi), ("per_radian", 1.0)):
            result = scabo.Model({
                "scabo": 1, "analysis": {"plane": "axisymmetric", "forces": forces}, "materials": {"m": {"young": 400.0, "poisson": 0.25}},
                "bodies": {"floor": {"rigid": True, "shape": {"rectangle": {"corner": [0, -1], "size": [4, 1]}}},
                           "shaft": {"material": "m", "shape": {"rectangle": {"corner": [0, 0], "size": [2, 1]}}, "mesh": {"size": 0.5}}},
                "supports": [{"on": "floor", "fix": "y"}], "loads": {"press": {"on": "shaft.top", "pressure": 3.0}},
                "contacts": {"base": {"between": ["floor.top", "shaft.bottom"], "friction": 0}}}).run()
            table = result.contact["base"].table()
            self.assertEqual(set(table["forces_of_radians"]), {angle})
            self.assertAlmostEqual(table["normal_force"].sum(), angle * 3.0 * 2.0**2 / 2, delta=1e-9)
        self.assertNotIn("forces_of_radians", scabo.Model(block()).run().contact["base"].table())

    def test_uniform_stress(self):
        """A bar under a traction on smooth supports: sigma = t, u = sigma x / E and -nu sigma y / E."""
        model = scabo.Model({
            "scabo": 1, "materials": {"m": {"young": 4.0, "poisson": 0.25}},
            "bodies": {"bar": {"material": "m", "shape": {"rectangle": {"corner": [0, 0], "size": [2, 1]}},
                               "mesh": {"size": 0.5}}},
            "supports": [{"on": "bar.left", "fix": "x"}, {"on": "bar.bottom_left", "fix": "y"}],
            "loads": {"pull": {"on": "bar.right", "traction": [3.0, 0.0]}}})
        with self.assertWarnsRegex(scabo.ModelWarning, "more than a tenth"):
            result = model.run()
        points = np.array([[1.0, 0.5], [0.3, 0.2], [2.0, 1.0], [0.0, 0.0]])
        np.testing.assert_allclose(result.stress(points), np.tile([3.0, 0, 0, 0], (4, 1)), atol=1e-12)
        np.testing.assert_allclose(result.displacement(points), points * [0.75, -0.1875], atol=1e-13)
        values = result.values(points)
        np.testing.assert_allclose(values["strain"], np.tile([0.75, -0.1875, 0], (4, 1)), atol=1e-12)
        np.testing.assert_allclose(values["von_mises"], 3.0, atol=1e-12)
        np.testing.assert_allclose(values["energy_density"], 0.5 * 3.0 * 0.75, atol=1e-12)
        np.testing.assert_allclose(values["principal"], np.tile([3.0, 0, 0], (4, 1)), atol=1e-12)
        nodes = result.nodes("bar")
        np.testing.assert_allclose(result.nodal_displacement("bar"), nodes * [0.75, -0.1875], atol=1e-13)

    def test_values_are_those_of_points_csv(self):
        points = [[3.1, 0.7], {"at": [5.5, 2.2], "name": "b"}, {"at": [6.0, 1.5], "body": "upper"}]
        model = scabo.read(BEAM)
        model["output"] = {"points": points}
        result = model.run(output=self.directory / "results")
        with open(self.directory / "results" / "points.csv", newline="") as stream:
            for row in csv.DictReader(stream):
                at = [[float(row["x"]), float(row["y"])]]
                values = result.values(at, body=row["body"])
                found = [*values["displacement"][0], *values["stress"][0], *values["principal"][0],
                         values["principal_angle"][0], values["von_mises"][0], values["energy_density"][0]]
                names = ["ux", "uy", "stress_xx", "stress_yy", "stress_xy", "stress_zz", "principal_1", "principal_2",
                         "principal_3", "principal_angle", "von_mises", "energy_density"]
                self.assertEqual([float(row[name]) for name in names], found)

    def test_points_outside_and_between(self):
        result = scabo.read(BEAM).run()
        with self.assertRaisesRegex(ValueError, r"point 1: \(7, 1\) lies outside every body; the nearest is 'lower', 1"):
            result.stress([[1, 1], [7, 1]])
        with self.assertRaisesRegex(ValueError, "point 0: it lies in several bodies .'lower', 'upper'.: .*body='lower'"):
            result.displacement([[3.0, 1.5]])
        with self.assertRaisesRegex(ValueError, "lies outside body 'upper'"):
            result.displacement([[3.0, 1.0]], body="upper")
        with self.assertRaisesRegex(ValueError, "not finite"):
            result.displacement([[np.nan, 1.0]], outside="nan")
        with self.assertRaisesRegex(ValueError, r"\(1e\+300, 0\) lies outside every body: move the point"):
            result.displacement([[1e300, 0.0]])  # the square of its distance is infinite
        with self.assertRaisesRegex(ValueError, "outside must be"):
            result.displacement([[3.0, 1.0]], outside="zero")
        with self.assertRaisesRegex(ValueError, "^points must be real"):
            result.stress(np.array([[3.0, 1.0]]) + 1j)
        for wrong in ([1.0, 2.0], [[1.0, 2.0, 3.0]], 5.0):
            with self.assertRaisesRegex(ValueError, "shape"):
                result.displacement(wrong)
        values = result.values([[7, 1], [1, 1]], outside="nan")
        self.assertTrue(np.isnan(values["displacement"][0]).all() and np.isnan(values["stress"][0]).all())
        self.assertEqual(values["body"].tolist(), [-1, 0])
        np.testing.assert_array_equal(values["displacement"][1], result.displacement([[1, 1]])[0])
        self.assertEqual(result.stress(np.empty((0, 2))).shape, (0, 4))
        lower, upper = (result.displacement([[3.0, 1.5]], body=body)[0] for body in ("lower", "upper"))
        joint = result.contact["joint"].table()
        pair = int(np.argmin(abs(joint["x"] - 3.0)))
        self.assertAlmostEqual((upper - lower) @ [0, 1], joint["gap"][pair], delta=1e-12)
        self.assertAlmostEqual((upper - lower) @ [1, 0], joint["slip"][pair], delta=1e-12)

    def test_rigid_bodies_have_no_stress(self):
        model = scabo.Model(block())
        result = model.run()
        self.assertTrue(np.isnan(result.stress([[1.0, -0.5]])).all())
        np.testing.assert_allclose(result.displacement([[1.0, -0.5]]), 0.0, atol=1e-15)
        self.assertEqual(result.nodal_displacement("floor").shape, (3,))
        self.assertEqual(result.nodes("floor").shape, (0, 2))

    def test_a_mesh_of_finite_elements_and_steps(self):
        model = scabo.Model(block())
        model["bodies"]["block"]["mesh"] = {"kind": "fem", "size": 0.25, "order": 2}
        model["steps"] = [{"name": "press", "increments": 2}]
        result = model.run()
        half, whole = (result.stress([[1.0, 0.6]], increment=k)[0] for k in (0, 1))
        self.assertLess(abs(half[1]), abs(whole[1]))
        nodes, moved = result.nodes("block"), result.nodal_displacement("block")
        node = int(np.argmin(np.linalg.norm(nodes - [1.0, 0.5], axis=1)))
        np.testing.assert_allclose(result.displacement([nodes[node]])[0], moved[node], atol=1e-18)

    def test_displacements_relative_to_a_reference(self):
        model = scabo.read(ROOT / "tests" / "input" / "good" / "outside.yaml")
        result = model.run()
        body = next(name for name in result.bodies if len(result.nodes(name)))
        nodes = result.nodes(body)
        np.testing.assert_allclose(result.displacement(nodes[:3], body=body), result.nodal_displacement(body)[:3],
                                   rtol=1e-9, atol=1e-15)


class Modes(InTemporaryDirectory):
    def test_modal_analysis(self):
        file = ROOT / "examples" / "02_natural_frequencies" / "model.yaml"
        program("run", file, "-o", self.directory / "program", "--quiet")
        expected = json.loads((self.directory / "program" / "summary.json").read_text())
        result = scabo.read(file).modes(output=self.directory / "python")
        self.assertEqual({**result.summary, "timing": None, "peak_memory_bytes": None},
                         {**expected, "timing": None, "peak_memory_bytes": None})
        self.assertEqual(scabo.read(file).modes().summary["modes"], expected["modes"])
        self.assertEqual(result.frequencies.tolist(), [mode["frequency"] for mode in expected["modes"]])
        [(body, shape)] = result.modes[0].shape.items()
        self.assertEqual(shape.shape, result.nodes(body).shape)
        self.assertAlmostEqual(np.linalg.norm(shape, axis=1).max(), 1.0, delta=1e-12)
        self.assertFalse(shape.flags.owndata)
        with self.assertRaisesRegex(ValueError, r"use modes\(\)"):
            scabo.read(file).run()
        with self.assertRaisesRegex(ValueError, r"use run\(\)"):
            scabo.Model(ROOT / "examples" / "01_double_cantilever" / "model.yaml").modes()


class Plot(InTemporaryDirectory):
    """What scabo.plot is given; what it draws has tests of its own."""

    def setUp(self):
        super().setUp()
        self.calls = []
        module = types.ModuleType("scabo.plot")
        module.Results = pathlib.Path
        module.stress, module.contact = self.draw("stress"), self.draw("contact")
        module.history, module.spectrum = self.draw("history"), self.draw("spectrum")
        patched = unittest.mock.patch.dict(sys.modules, {"scabo.plot": module})
        patched.start()
        self.addCleanup(patched.stop)
        attribute = unittest.mock.patch.object(scabo, "plot", module, create=True)
        attribute.start()
        self.addCleanup(attribute.stop)

    def draw(self, what):
        def function(results, **options):
            self.calls.append((what, str(results), sorted(path.name for path in results.iterdir()), options))
            return "figure"
        return function

    def test_directory_of_the_run(self):
        model = scabo.Model(block())
        model["steps"] = [{"name": "press", "increments": 3}]
        result = model.run(output=self.directory / "results")
        for increment, number in ((0, 1), (2, 3), (-1, 3), (-3, 1)):  # pictures and files count from 1
            self.assertEqual(result.plot("contact", increment=increment, component="slip"), "figure")
            what, directory, _, options = self.calls.pop()
            self.assertEqual((what, directory), ("contact", result.directory))
            self.assertEqual(options, {"increment": number, "component": "slip"})
        result.plot("history")
        self.assertEqual(self.calls.pop()[3], {})
        result.plot("spectrum", columns="ground")
        self.assertEqual(self.calls.pop()[::3], ("spectrum", {"columns": "ground"}))
        with self.assertRaises(IndexError):
            result.plot(increment=3)
        with self.assertRaisesRegex(ValueError, "what must be stress, .* or cracks, not 'strees'"):
            result.plot("strees")

    def test_temporary_directory(self):
        result = scabo.Model(block()).run()
        result.plot()
        [(what, directory, names, _)] = self.calls
        self.assertEqual(what, "stress")
        self.assertIn("fields_0001.vtu", names)
        self.assertFalse(pathlib.Path(directory).exists())
        self.assertIsNone(result.directory)


class Report(InTemporaryDirectory):
    """Where the page is built; what it contains has tests of its own."""

    def setUp(self):
        super().setUp()
        if not pathlib.Path(scabo.__file__).with_name("report").joinpath("template.html").is_file():
            self.skipTest("the page for reports was not built")

    def test_with_and_without_a_directory(self):
        model = scabo.Model(block())
        model["title"] = "pressed"
        result = model.run(output=self.directory / "block.results")
        path = result.report()
        self.assertEqual(path, self.directory / "block.report.html")
        self.assertIn("<title>pressed</title>", path.read_text(encoding="utf-8"))
        result = scabo.Model(block()).run()
        self.assertEqual(result.report(self.directory / "other.html", units="m,N"), self.directory / "other.html")
        self.assertIn('"directory":"other"', (self.directory / "other.html").read_text(encoding="utf-8"))
        with self.assertRaisesRegex(ValueError, "these results are in no directory: name the page"):
            result.report()
        self.assertEqual(sorted(path.name for path in self.directory.iterdir()), ["block.report.html", "block.results", "other.html"])


if __name__ == "__main__":
    unittest.main()
