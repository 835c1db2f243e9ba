"""What goes to other programs: fields to meshio and PyVista, histories, model files, notebooks, type checkers."""
import pickle
import shutil
import subprocess
import sys
import types
import unittest
import unittest.mock

import numpy as np

import scabo
from scabo.plot import vtu
from support import PATIENCE, ROOT, InTemporaryDirectory, block, program


class FieldsOfAModel(InTemporaryDirectory):
    def setUp(self):
        super().setUp()
        self.result = scabo.Model(block()).run(self.directory / "out")
        self.file = vtu.read_grid(self.directory / "out" / "fields_0001.vtu")
        self.fields = self.result.fields()

    def test_are_those_of_the_file(self):
        np.testing.assert_array_equal(self.fields.points[:, :2], self.file.points[:, :2])
        np.testing.assert_array_equal(self.fields.connectivity, self.file.connectivity)
        np.testing.assert_array_equal(self.fields.offsets[1:], self.file.offsets)
        np.testing.assert_array_equal(self.fields.types, self.file.types)
        self.assertEqual(self.fields.offsets[0], 0)
        for name, array in self.fields.values.items():
            np.testing.assert_array_equal(array, self.file.point_data[name], name)
        np.testing.assert_array_equal(self.fields.cell_body, self.file.cell_data["body"])

    def test_every_cell_is_in_one_block_of_meshio(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("meshio is not there for this Python")
        mesh = self.result.to_meshio()
        self.assertEqual(len({(cells.type, cells.data.shape[1]) for cells in mesh.cells}), len(mesh.cells))
        self.assertEqual(sum(len(cells.data) for cells in mesh.cells), len(self.fields.types))
        self.assertEqual(self.area(mesh.points, [cell for cells in mesh.cells for cell in cells.data]), (2.0, 4.0))
        mesh.write(self.directory / "mesh.vtk")
        again = meshio.read(self.directory / "mesh.vtk")
        np.testing.assert_array_equal(again.point_data["displacement"], self.fields.values["displacement"])

    def area(self, points, cells):
        """Of the block above y = 0, and of the floor below."""
        above = below = 0.0
        for cell in cells:
            x, y = points[cell][:, :2].T
            area = 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))
            above, below = (above + area, below) if y.mean() > 0 else (above, below + area)
        return round(above, 12), round(below, 12)

    def test_cells_as_pyvista_takes_them(self):
        class Grid:
            def __init__(self, cells, kinds, points):
                self.cells, self.kinds, self.points, self.cell_data, self.point_data = cells, kinds, points, {}, {}

        module = types.ModuleType("pyvista")
        module.UnstructuredGrid = Grid
        with unittest.mock.patch.dict(sys.modules, pyvista=module):
            grid = self.result.to_pyvista()
        at, cells = 0, []
        while at < len(grid.cells):
            cells.append(grid.cells[at + 1:at + 1 + grid.cells[at]])
            at += 1 + grid.cells[at]
        self.assertEqual(len(cells), len(grid.kinds))
        self.assertEqual(self.area(grid.points, cells), (2.0, 4.0))
        self.assertEqual(set(grid.point_data), set(self.fields.values))


class Results(InTemporaryDirectory):
    def test_history_is_the_same_in_memory(self):
        model = block()
        model["steps"] = [{"increments": 3}]
        model["output"] = {"history": {"top": "block.top_left.ux", "none": "base.first_pair_in_contact",
                                       "cut": {"section": {"from": [0, 0.5], "to": [2, 0.5]}}}}
        written = scabo.Model(model).run(self.directory / "out").history
        kept = scabo.Model(model).run().history
        self.assertEqual(list(kept), list(written))
        for name, column in kept.items():
            np.testing.assert_array_equal(column, written[name], name)
        self.assertAlmostEqual(abs(kept["cut.shear"][-1]) / 2e6, 1.0, delta=2e-3)  # the push, from stresses of the mesh
        with self.assertRaisesRegex(LookupError, "keep_fields"):
            scabo.Model(model).run(keep_fields=False).history

    def test_in_a_notebook(self):
        text = scabo.Model(block()).run()._repr_html_()
        self.assertIn("<b>solved</b>, 1 increments", text)
        self.assertIn("<td>base</td><td>2e+07</td><td>-2e+06</td>", text)

    def test_pickled(self):
        model = block()
        model["output"] = {"history": {"top": "block.top_left.ux"}}
        result = scabo.Model(model).run()
        again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(result))))
        self.assertEqual((again.status, again.summary, again.bodies, again.directory), (result.status, result.summary, result.bodies, None))
        for name, column in result.contact["base"].table().items():
            np.testing.assert_array_equal(again.contact["base"].table()[name], column, name)
        np.testing.assert_array_equal(again.nodes("block"), result.nodes("block"))
        np.testing.assert_array_equal(again.nodal_displacement("block"), result.nodal_displacement("block"))
        np.testing.assert_array_equal(again.fields().values["von_mises"], result.fields().values["von_mises"])
        np.testing.assert_array_equal(again.history["top"], result.history["top"])
        with self.assertRaisesRegex(LookupError, "no values at points"):
            again.stress([[1.0, 0.5]])
        with self.assertRaisesRegex(LookupError, r"save\(\) them before"):
            again.save(self.directory / "out")

    def test_pickled_with_a_directory(self):
        result = scabo.Model(block()).run(self.directory / "out", keep_fields=False)
        again = pickle.loads(pickle.dumps(result))
        self.assertEqual(again.directory, result.directory)
        self.assertEqual(again.contact["base"].normal_force, result.contact["base"].normal_force)

    def test_pickled_modes(self):
        model = block()
        model["materials"]["steel"]["density"] = 7850
        model["analysis"] = {"type": "modal", "modes": 4}
        del model["contacts"], model["loads"], model["bodies"]["floor"]
        model["supports"] = [{"on": "block.bottom", "fix": ["x", "y"]}]
        modes = scabo.Model(model).modes()
        again = pickle.loads(pickle.dumps(modes))
        np.testing.assert_array_equal(again.frequencies, modes.frequencies)
        np.testing.assert_array_equal(again.modes[0].shape["block"], modes.modes[0].shape["block"])
        np.testing.assert_array_equal(again.nodes("block"), modes.nodes("block"))
        self.assertIn(f"<td>1</td><td>{modes.frequencies[0]:.6g}</td>", modes._repr_html_())


class ModelFiles(InTemporaryDirectory):
    def test_saved_and_read_again(self):
        model = scabo.Model(block())
        model["loads"]["push"]["traction"] = np.array([1e6, -10e6])
        file = self.directory / "saved.yaml"
        model.save(file)
        self.assertEqual(scabo.Model(file), block())
        self.assertEqual(scabo.Model(str(file)).file, str(file))
        self.assertEqual(program("check", file).returncode, 0)
        self.assertEqual(pickle.loads(pickle.dumps(scabo.Model(file))), block())

    def test_mistakes_have_their_line(self):
        file = self.directory / "wrong.yaml"
        file.write_text("scabo: 1\nbodies: {a: {rigid: true, shap: 1}}\n")
        with self.assertRaisesRegex(scabo.ModelError, r"wrong\.yaml:2"):
            scabo.Model(file)

    def test_what_json_cannot_hold(self):
        with self.assertRaisesRegex(TypeError, "not complex"):
            scabo.Model({"scabo": 1j}).save(self.directory / "m.yaml")


class OtherPythons(InTemporaryDirectory):
    def test_are_told_which_one_it_was_built_for(self):
        package = self.directory / "scabo"
        shutil.copytree(scabo.__path__[0], package, ignore=shutil.ignore_patterns("__pycache__"))
        [module] = package.glob("_core.*.so")
        module.rename(package / "_core.cpython-27-x86_64-linux-gnu.so")
        done = subprocess.run([sys.executable, "-c", "import scabo"], cwd=self.directory, text=True, capture_output=True,
                              env={"PYTHONPATH": str(self.directory)}, timeout=PATIENCE)
        self.assertRegex(done.stderr, r"ImportError: scabo was built for another Python \(_core.cpython-27.*this one needs _core")


class TypeChecker(InTemporaryDirectory):
    def test_the_tutorials_and_the_package_have_no_findings(self):
        if subprocess.run([sys.executable, "-m", "mypy", "--version"], capture_output=True).returncode:
            self.skipTest("mypy is not there for this Python")
        files = [*sorted((ROOT / "examples" / "python").glob("*.py"))]
        script = self.directory / "script.py"
        script.write_text("import scabo\nforce: float = scabo.read('m.yaml').run().contact['base'].normal_force\n"
                          "vector: list[float] = scabo.read('space.yaml').run().contact['joint'].normal_force.tolist()\n"
                          "first: float = scabo.Model('m.yaml').modes().modes[0].frequency\n")
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--follow-imports=silent",
                               *files, script], text=True, capture_output=True, cwd=self.directory, timeout=PATIENCE)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
