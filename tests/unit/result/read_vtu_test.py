"""Reads what `result_sample` wrote back: with meshio, and with VTK's own readers, which ParaView uses.
Usage: read_vtu_test.py RESULT_SAMPLE"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import meshio
import numpy as np
import vtk  # package python3-vtk9 (make packages)
from vtk.util.numpy_support import vtk_to_numpy

YOUNG, POISSON = 2.0e9, 0.3  # plane strain
GRADIENT = np.array([[1.1e-3, -0.4e-3], [0.7e-3, -0.9e-3]])
SHIFT = np.array([0.002, -0.001])
COMPONENTS = {"displacement": 3, "stress": 6, "stress_xx": 1, "stress_yy": 1, "stress_xy": 1, "stress_zz": 1,
              "principal_1": 1, "principal_2": 1, "principal_3": 1, "principal_angle": 1, "von_mises": 1, "body": 1}
SINGLE = 3e-7  # relative precision of stresses
SAMPLE = None


def uniform_stress(gradient):
    """3 x 3, by Hooke's law."""
    strain = np.zeros((3, 3))
    strain[:2, :2] = 0.5 * (gradient + gradient.T)
    shear = YOUNG / (2 * (1 + POISSON))
    lame = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
    return lame * np.trace(strain) * np.eye(3) + 2 * shear * strain


class Fields(unittest.TestCase):
    """Checks of numbers, however the file was read: `points`, `data` by name, `cell_bodies`."""

    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory(prefix="scabo_test_")
        cls.directory = pathlib.Path(cls.holder.name) / "out"
        subprocess.run([SAMPLE, cls.directory], check=True, timeout=1200)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def check_values(self, points, data, factor):
        self.assertEqual(set(data), set(COMPONENTS))
        for name, values in data.items():
            # A scalar is one number for each point, not a list of one.
            shape = (len(points),) if COMPONENTS[name] == 1 else (len(points), COMPONENTS[name])
            self.assertEqual(values.shape, shape, name)
            self.assertTrue(np.all(np.isfinite(values)), name)
        self.assertEqual(points.dtype, np.float64)
        self.assertTrue(np.all(points[:, 2] == 0))
        body = data["body"].ravel()
        self.assertEqual(sorted(set(body)), [1, 2, 3])
        elastic = body < 3

        expected = points[elastic, :2] @ (factor * GRADIENT).T + SHIFT
        displacement = data["displacement"]
        self.assertEqual(displacement.dtype, np.float64)
        np.testing.assert_allclose(displacement[elastic, :2], expected, rtol=0, atol=1e-12)
        arms = points[~elastic, :2] - [9.0, 0.0]
        turned = factor * (np.array([0.01, -0.02]) + 0.003 * np.column_stack([-arms[:, 1], arms[:, 0]]))
        np.testing.assert_allclose(displacement[~elastic, :2], turned, rtol=0, atol=1e-14)

        stress = uniform_stress(factor * GRADIENT)
        tolerance = SINGLE * np.abs(stress).max()

        def check(values, number):
            np.testing.assert_allclose(values[elastic], number, rtol=0, atol=tolerance)
            self.assertTrue(np.all(values[~elastic] == 0))

        for column, (i, j) in enumerate([(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)]):
            check(data["stress"][:, column], stress[i, j])
        for name, (i, j) in {"xx": (0, 0), "yy": (1, 1), "xy": (0, 1), "zz": (2, 2)}.items():
            check(data[f"stress_{name}"].ravel(), stress[i, j])
        principal = np.linalg.eigvalsh(stress)[::-1]
        for i in range(3):
            check(data[f"principal_{i + 1}"].ravel(), principal[i])
        deviator = stress - np.trace(stress) / 3 * np.eye(3)
        check(data["von_mises"].ravel(), np.sqrt(1.5 * np.sum(deviator**2)))
        angle = data["principal_angle"].ravel()[elastic]
        direction = np.column_stack([np.cos(angle), np.sin(angle)])
        along = np.einsum("ni,ij,nj->n", direction, stress[:2, :2], direction)
        np.testing.assert_allclose(along, np.linalg.eigvalsh(stress[:2, :2])[1], rtol=0, atol=tolerance)


def check_contacts(test, points, data):
    """Three pairs on the line y = x/2 and one pair of another contact, as result_sample made them."""
    i = np.array([0, 1, 2, 1])
    n, t = np.array([-1, 2]) / np.sqrt(5), np.array([2, 1]) / np.sqrt(5)
    np.testing.assert_allclose(points, np.column_stack([2 * i, i, 0 * i]), atol=1e-15)
    expected = {"state": i, "pressure": 100 * i, "shear": -30 * i, "gap": 0.1 * (2 - i), "slip": 0.01 * i,
                "normal_force": 10 * i, "tangential_force": -3 * i, "pair": i + 1, "contact": np.array([1, 1, 1, 2])}
    vectors = {"traction": np.outer(100 * i, n) + np.outer(-30 * i, t),
               "displacement": np.outer(0.5 + 0 * i, n) + np.outer(0.25 * i, t)}
    test.assertEqual(set(data), set(expected) | set(vectors))
    for name, values in expected.items():
        test.assertEqual(data[name].shape, (4,), name)
        np.testing.assert_allclose(data[name], values, atol=1e-14, err_msg=name)
    for name, values in vectors.items():
        np.testing.assert_allclose(data[name], np.column_stack([values, 0 * i]), atol=1e-12, err_msg=name)


class WithMeshio(Fields):
    def test_values(self):
        for number in (1, 2):
            mesh = meshio.read(self.directory / f"fields_{number:04d}.vtu")
            self.check_values(mesh.points, mesh.point_data, number)

    def test_cells(self):
        mesh = meshio.read(self.directory / "fields_0001.vtu")
        self.assertEqual([block.type for block in mesh.cells], ["quad", "triangle", "quad8", "polygon"])
        for block, body in zip(mesh.cells, mesh.cell_data["body"]):
            corners = mesh.points[block.data[:, :4] if block.type == "quad8" else block.data][:, :, :2]
            after = np.roll(corners, -1, axis=1)
            areas = 0.5 * np.sum(corners[..., 0] * after[..., 1] - corners[..., 1] * after[..., 0], axis=1)
            self.assertTrue(np.all(areas > 0), block.type)
            self.assertTrue(np.all(body == {"quad8": 2, "polygon": 3}.get(block.type, 1)))
            self.assertTrue(np.all(mesh.point_data["body"][block.data].reshape(len(body), -1) == body.reshape(-1, 1)))

    def test_collections(self):
        for name in ("fields", "contact"):
            root = xml.etree.ElementTree.parse(self.directory / f"{name}.pvd").getroot()
            self.assertEqual(root.get("type"), "Collection")
            self.assertEqual([(float(entry.get("timestep")), entry.get("file")) for entry in root.iter("DataSet")],
                             [(0.25, f"{name}_0001.vtu"), (0.5, f"{name}_0002.vtu")])

    def test_contacts(self):
        mesh = meshio.read(self.directory / "contact_0001.vtu")
        check_contacts(self, mesh.points, mesh.point_data)
        cells = {block.type: (block.data.tolist(), contact.tolist())
                 for block, contact in zip(mesh.cells, mesh.cell_data["contact"])}
        self.assertEqual(cells, {"line": ([[0, 1], [1, 2]], [1, 1]), "vertex": ([[3]], [2])})


MANY_CELLS = """scabo: 1
analysis: {plane: strain}
materials: {steel: {young: 2e9, poisson: 0.25}}
bodies:
  plate: {material: steel, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {kind: quadtree, size: 0.0125}}
supports: [{on: plate.left, fix: x}, {on: plate.bottom_left, fix: y}]
loads: {pull: {on: plate.right, traction: [3e6, 0]}}
output: {fields: [displacement, stress]}
"""


class Compressed(unittest.TestCase):
    """A plate of 12,800 cells and more than 50,000 points under uniform tension: its arrays are compressed."""

    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory(prefix="scabo_test_")
        cls.folder = pathlib.Path(cls.holder.name)
        (cls.folder / "plate.yaml").write_text(MANY_CELLS)
        for threads in (1, 2):
            subprocess.run([os.environ["SCABO"], "run", "plate.yaml", "-o", f"out{threads}", "--threads", str(threads)],
                           cwd=cls.folder, check=True, timeout=1200, stdout=subprocess.DEVNULL)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def check(self, points, displacement, stress_xx, stress_yy):
        self.assertGreater(len(points), 50000)
        self.assertAlmostEqual(points[:, 0].max(), 2)
        # Plane strain: exx = (1 - nu^2) sxx / E, eyy = -nu (1 + nu) sxx / E.
        expected = points[:, :2] * np.array([(1 - 0.25**2) * 3e6 / 2e9, -0.25 * 1.25 * 3e6 / 2e9])
        np.testing.assert_allclose(displacement[:, :2], expected, atol=1e-12)
        np.testing.assert_allclose(stress_xx, 3e6, rtol=SINGLE)
        np.testing.assert_allclose(stress_yy, 0, atol=3e6 * SINGLE)

    def test_meshio_reads_it(self):
        mesh = meshio.read(self.folder / "out1" / "fields_0001.vtu")
        self.check(mesh.points, *(mesh.point_data[name] for name in ("displacement", "stress_xx", "stress_yy")))

    def test_vtk_reads_it(self):
        for name in ("fields_0001.vtu", "cells.vtu"):
            path = self.folder / "out1" / name
            grid = read_with_vtk(self, path)
            self.assertEqual(b"vtkZLibDataCompressor" in path.read_bytes()[:400], name != "cells.vtu")
            if name == "cells.vtu":
                self.assertEqual(grid.GetNumberOfCells(), 12800)
                continue
            fields = grid.GetPointData()
            self.check(vtk_to_numpy(grid.GetPoints().GetData()),
                       *(vtk_to_numpy(fields.GetArray(name)) for name in ("displacement", "stress_xx", "stress_yy")))

    def test_it_is_smaller_and_does_not_depend_on_threads(self):
        one, two = (self.folder / f"out{threads}" / "fields_0001.vtu" for threads in (1, 2))
        self.assertEqual(one.read_bytes(), two.read_bytes())
        points = read_with_vtk(self, one).GetNumberOfPoints()
        self.assertLess(one.stat().st_size, 0.5 * 92 * points)  # 6 doubles and 11 numbers of 4 bytes, without the cells


def read_with_vtk(test, path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    test.assertEqual(reader.CanReadFile(str(path)), 1)
    complaints = []
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *_: complaints.append(event))
    reader.SetFileName(str(path))
    reader.Update()
    test.assertEqual(complaints, [])
    test.assertEqual(reader.GetErrorCode(), 0)
    return reader.GetOutput()


class WithVtk(Fields):
    def read(self, number, kind="fields"):
        return read_with_vtk(self, self.directory / f"{kind}_{number:04d}.vtu")

    def test_values(self):
        for number in (1, 2):
            grid = self.read(number)
            fields = grid.GetPointData()
            data = {fields.GetArrayName(i): vtk_to_numpy(fields.GetArray(i)) for i in range(fields.GetNumberOfArrays())}
            self.check_values(vtk_to_numpy(grid.GetPoints().GetData()), data, number)

    def test_contacts(self):
        grid = self.read(1, "contact")
        fields = grid.GetPointData()
        data = {fields.GetArrayName(i): vtk_to_numpy(fields.GetArray(i)) for i in range(fields.GetNumberOfArrays())}
        check_contacts(self, vtk_to_numpy(grid.GetPoints().GetData()), data)
        self.assertEqual([grid.GetCellType(i) for i in range(grid.GetNumberOfCells())],
                         [vtk.VTK_LINE, vtk.VTK_LINE, vtk.VTK_VERTEX])

    def test_names(self):
        fields = self.read(1).GetPointData()
        self.assertEqual(fields.GetScalars().GetName(), "principal_1")
        self.assertEqual(fields.GetVectors().GetName(), "displacement")
        stress = fields.GetArray("stress")
        self.assertEqual([stress.GetComponentName(i) for i in range(6)], ["XX", "YY", "ZZ", "XY", "YZ", "XZ"])

    def test_cells_are_valid(self):
        grid = self.read(1)
        validator = vtk.vtkCellValidator()
        validator.SetInputData(grid)
        validator.Update()
        state = vtk_to_numpy(validator.GetOutput().GetCellData().GetArray("ValidityState"))
        self.assertTrue(np.all(state == 0), np.unique(state))
        size = vtk.vtkCellSizeFilter()
        size.SetInputData(grid)
        size.Update()
        area = vtk_to_numpy(size.GetOutput().GetCellData().GetArray("Area"))
        self.assertTrue(np.all(area > 0))
        body = vtk_to_numpy(grid.GetCellData().GetArray("body"))
        vertices = np.array([[0.1, 0.0], [2.3, 0.4], [2.9, 1.7], [1.2, 2.6], [-0.4, 1.1]])
        after = np.roll(vertices, -1, axis=0)
        pentagon = 0.5 * np.sum(vertices[:, 0] * after[:, 1] - vertices[:, 1] * after[:, 0])
        for number, expected, tolerance in ((1, pentagon, 1e-12), (2, 0.5, 1e-12), (3, np.pi * 0.25, 1e-3)):
            self.assertAlmostEqual(area[body == number].sum() / expected, 1.0, delta=tolerance)


del Fields  # only what reads a file is a test


if __name__ == "__main__":
    SAMPLE = sys.argv.pop(1)
    unittest.main()
