"""Models in space: arrays with three components against closed forms, files as the program's, hand-over, exceptions."""
import filecmp
import json
import pathlib
import pickle
import re
import resource
import sys
import types
import unittest
import unittest.mock

import numpy as np

import scabo
from scabo.plot import vtu
from support import InTemporaryDirectory, program, summary_of

YOUNG, POISSON, PRESSURE, HEIGHT = 210e9, 0.3, 3e6, 0.5


def stack(increments=1):
    """Two blocks with meshes that do not match, free to widen, under a pressure: a constant stress."""
    return {
        "scabo": 1,
        "analysis": {"space": True},
        "materials": {"steel": {"young": YOUNG, "poisson": POISSON}},
        "bodies": {
            "lower": {"material": "steel", "shape": {"box": {"corner": [0, 0, 0], "size": [1, 0.8, 0.3]}}, "mesh": {"size": 0.34}},
            "upper": {"material": "steel", "shape": {"box": {"corner": [0, 0, 0.3], "size": [1, 0.8, 0.2]}}, "mesh": {"size": 0.5}},
        },
        "supports": [{"on": "lower.bottom", "fix": ["z"], "name": "ground"},
                     {"on": "lower.left", "fix": ["x"]}, {"on": "lower.front", "fix": ["y"]},
                     {"on": "upper.left", "fix": ["x"]}, {"on": "upper.front", "fix": ["y"]}],
        "loads": {"press": {"on": "upper.top", "pressure": PRESSURE}},
        "contacts": {"joint": {"between": ["lower.top", "upper.bottom"], "friction": 0}},
        "steps": [{"name": "press", "increments": increments}],
    }


class Warnings(unittest.TestCase):
    def test_a_warning_of_an_increment_is_given_once(self):
        model = stack(2)
        model["supports"] = [support for support in model["supports"] if not support["on"].startswith("upper")]
        with self.assertWarns(scabo.ModelWarning):
            warnings = scabo.Model(model).run().warnings
        self.assertEqual(len([text for text in warnings if "do not determine body 'upper'" in text]), 1)


def displacement_at(points):
    """u = sigma / E [-nu x, -nu y, z] with sigma = -pressure."""
    return -PRESSURE / YOUNG * np.asarray(points) * [-POISSON, -POISSON, 1.0]


class ConstantStress(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = scabo.Model(stack()).run()

    def near(self, values, expected, scale):
        np.testing.assert_allclose(values, np.broadcast_to(expected, np.shape(values)), rtol=0, atol=1e-9 * scale)

    def test_contact_arrays(self):
        self.assertEqual(self.result.dimension, 3)
        joint = self.result.contact["joint"]
        table = joint.table()
        count = len(table["pair"])
        self.near(table["pressure"], PRESSURE, PRESSURE)
        self.near(table["shear"], [0, 0, 0], PRESSURE)
        self.near(table["force"], table["area"][:, None] * PRESSURE * np.array([0, 0, 1.0]), 0.8 * PRESSURE)
        self.near(table["normal_force"], table["area"] * PRESSURE, PRESSURE)
        self.near(table["normal"], [0, 0, 1], 1.0)
        self.near(table["gap"], 0.0, PRESSURE / YOUNG)
        self.near(table["slip"], [0, 0, 0], PRESSURE / YOUNG)
        self.assertAlmostEqual(table["area"].sum(), 0.8, delta=1e-12)
        self.assertEqual({name: array.shape for name, array in table.items() if array.ndim == 2},
                         {name: (count, 3) for name in ("position", "normal", "slip", "force", "shear")})
        self.assertEqual(set(table["state"]) - {"stick", "slip"}, set())
        self.near(joint.normal_force, [0, 0, 0.8 * PRESSURE], PRESSURE)
        self.assertEqual(joint.history()["normal_force"].shape, (1, 3))

    def test_nodes_and_displacements_show_the_memory_of_the_solver(self):
        for body in self.result.bodies:
            nodes, u = self.result.nodes(body), self.result.nodal_displacement(body)
            self.assertEqual(nodes.shape, u.shape)
            self.near(u, displacement_at(nodes), HEIGHT * PRESSURE / YOUNG)
            for array in (nodes, u):
                self.assertFalse(array.flags.owndata)
                self.assertFalse(array.flags.writeable)

    def test_values_at_points(self):
        points = np.array([[0.21, 0.43, 0.07], [0.9, 0.1, 0.29], [0.33, 0.77, 0.4], [1, 0.8, 0.5]])
        values = self.result.values(points)
        self.assertEqual(values["body"].tolist(), [0, 0, 1, 1])
        self.near(values["displacement"], displacement_at(points), HEIGHT * PRESSURE / YOUNG)
        self.near(values["stress"], [0, 0, -PRESSURE, 0, 0, 0], PRESSURE)
        self.near(values["principal"], [0, 0, -PRESSURE], PRESSURE)
        self.near(values["von_mises"], PRESSURE, PRESSURE)
        np.testing.assert_array_equal(self.result.displacement(points), values["displacement"])
        np.testing.assert_array_equal(self.result.stress(points), values["stress"])

    def test_points_outside_and_on_the_joint(self):
        with self.assertRaisesRegex(ValueError, "point 1: it lies in no body"):
            self.result.values([[0.5, 0.5, 0.1], [0.5, 0.5, 0.51]])
        away = self.result.values([[0.5, 0.5, 0.51]], outside="nan")
        self.assertEqual(away["body"].tolist(), [-1])
        self.assertTrue(np.isnan(away["stress"]).all() and np.isnan(away["displacement"]).all())
        with self.assertRaisesRegex(ValueError, r"several bodies \('lower', 'upper'\): name one of them, as in body='lower'"):
            self.result.values([[0.5, 0.5, 0.3]])
        self.assertEqual(self.result.values([[0.5, 0.5, 0.3]], body="upper")["body"].tolist(), [1])
        with self.assertRaisesRegex(ValueError, "outside of body 'upper'"):
            self.result.values([[0.5, 0.5, 0.1]], body="upper")
        with self.assertRaisesRegex(ValueError, r"the shape \(n, 3\), as in \[\[x, y, z\]"):
            self.result.values([[0.5, 0.5]])
        with self.assertRaisesRegex(ValueError, "not finite"):
            self.result.values([[0.5, 0.5, np.inf]])

    def test_fields_go_to_meshio_and_pyvista(self):
        fields = self.result.fields()
        self.assertEqual(set(fields.types), {24})
        self.near(fields.values["stress"][:, 2], -PRESSURE, 1e3 * PRESSURE)  # 32 bits
        try:
            mesh = self.result.to_meshio()
            [block] = mesh.cells
            self.assertEqual(block.type, "tetra10")
            a, b, c, d = (mesh.points[block.data[:, k]] for k in range(4))
            self.assertAlmostEqual(np.abs(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)).sum() / 6, 0.4, delta=1e-12)
            middle = 0.5 * (mesh.points[block.data[:, 0]] + mesh.points[block.data[:, 1]])
            np.testing.assert_allclose(mesh.points[block.data[:, 4]], middle, atol=1e-14)
        except ImportError:
            pass
        grid = types.ModuleType("pyvista")
        grid.UnstructuredGrid = lambda cells, kinds, points: types.SimpleNamespace(cells=cells, kinds=kinds, points=points, cell_data={}, point_data={})
        with unittest.mock.patch.dict(sys.modules, pyvista=grid):
            made = self.result.to_pyvista()
        self.assertEqual(made.cells[0], 10)
        self.assertEqual(made.point_data["displacement"].shape, (len(made.points), 3))

    def test_pickled(self):
        again = pickle.loads(pickle.dumps(self.result))
        self.assertEqual((again.dimension, again.status, again.bodies), (3, "solved", ["lower", "upper"]))
        np.testing.assert_array_equal(again.contact["joint"].table()["shear"], self.result.contact["joint"].table()["shear"])
        np.testing.assert_array_equal(again.nodal_displacement("upper"), self.result.nodal_displacement("upper"))
        self.assertEqual(again.summary, self.result.summary)
        with self.assertRaisesRegex(LookupError, "pickled"):
            again.values([[0.5, 0.5, 0.1]])

    def test_frame_has_the_columns_of_the_file(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not there for this Python")
        frame = self.result.contact["joint"].frame()
        self.assertEqual(list(frame.columns)[:8], ["pair", "x", "y", "z", "normal_x", "normal_y", "normal_z", "area"])
        self.assertIn("shear_z", frame.columns)

    def test_what_this_run_has_not(self):
        self.assertIsNone(self.result.mechanism)
        self.assertIsNone(self.result.limit)
        self.assertEqual((self.result.cracks, self.result.history), ({}, {}))  # it asks for no sections
        with self.assertRaisesRegex(ValueError, "what must be stress, contact, lines or mechanism"):
            self.result.plot("mesh")

    def test_notebook(self):
        self.assertIn("<td>[", self.result._repr_html_())


class AsTheProgram(InTemporaryDirectory):
    def setUp(self):
        super().setUp()
        self.file = self.directory / "model.json"
        self.file.write_text(json.dumps(stack(3), indent=2))

    def test_the_same_summary_and_files(self):
        run = program("run", self.file, "-o", self.directory / "program", "--quiet", "--threads", 1)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        written = scabo.read(self.file).run(self.directory / "python", threads=1)
        names = sorted(path.name for path in (self.directory / "program").iterdir())
        self.assertEqual(sorted(path.name for path in (self.directory / "python").iterdir()), names)
        same, other, failed = filecmp.cmpfiles(self.directory / "program", self.directory / "python", names, shallow=False)
        self.assertEqual((other, failed), ([], []))
        in_memory = scabo.read(self.file).run(threads=1)
        self.assertEqual(in_memory.summary, summary_of(self.directory / "program"))
        self.assertIsNone(in_memory.directory)
        in_memory.save(self.directory / "saved")
        kept = [name for name in names if name not in ("log.txt", "end.state", "end.yaml")]  # as in the plane, a restart needs the run itself
        same, other, failed = filecmp.cmpfiles(self.directory / "program", self.directory / "saved", kept, shallow=False)
        self.assertEqual((other, failed), ([], []))
        grid = vtu.read_grid(self.directory / "saved" / "fields_0003.vtu")
        np.testing.assert_array_equal(in_memory.fields().values["displacement"], grid.point_data["displacement"])

    def test_sizes(self):
        sizes = scabo.read(self.file).check()
        result = scabo.read(self.file).run()
        self.assertEqual((sizes.bodies, sizes.increments), (2, 3))
        self.assertEqual(sizes.dofs, sum(3 * len(result.nodes(body)) for body in result.bodies))
        self.assertEqual(sizes.contacts, {"joint": len(result.contact["joint"].table()["pair"])})
        self.assertEqual(sizes.contact_pairs, sizes.contacts["joint"])
        self.assertTrue(sizes.memory_bytes > 0 and sizes.seconds > 0)

    def test_mistakes_have_their_lines(self):
        self.file.write_text(self.file.read_text().replace('"friction": 0', '"friction": -1'))
        with self.assertRaises(scabo.ModelError) as caught:
            scabo.read(self.file)
        [problem] = caught.exception.problems
        self.assertEqual(problem.path, "contacts.joint.friction")
        self.assertTrue(problem.line and problem.column)
        model = scabo.Model(stack())
        model["bodies"]["upper"]["mesh"]["kind"] = "quadtree"
        with self.assertRaisesRegex(scabo.ModelError, "bodies.upper.mesh.kind"):
            model.check()

    def test_what_was_read_can_be_changed(self):
        model = scabo.read(self.file, set={"loads.press.pressure": 1e6})
        model["materials"]["steel"]["young"] = np.float64(70e9)
        result = model.run()
        np.testing.assert_allclose(result.contact["joint"].table()["pressure"], 1e6, rtol=1e-9)
        u = result.displacement([[1, 0.8, 0.5]])[0]
        self.assertAlmostEqual(u[2], -1e6 / 70e9 * 0.5, delta=1e-15)

    def test_pictures(self):
        try:
            import matplotlib
            matplotlib.use("Agg")
        except ImportError:
            self.skipTest("Matplotlib is not there for this Python")
        result = scabo.read(self.file).run()
        for what in ("stress", "contact"):
            self.assertTrue(result.plot(what).axes)


class HandOver(InTemporaryDirectory):
    def test_hexahedra_and_wedges_go_to_meshio(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("meshio is not there for this Python")
        model = stack()
        model["bodies"]["lower"]["mesh"]["kind"] = model["bodies"]["upper"]["mesh"]["kind"] = "hexahedra"
        model["bodies"]["upper"]["shape"] = {"extrude": {"profile": {"polygon": {
            "vertices": [[0, 0], [1, 0], [1, 0.8], [0, 0.8]], "names": {"left": "edge_4", "front": "edge_1"}}},
            "plane": "xy", "from": 0.3, "to": 0.5}}
        model = json.loads(json.dumps(model).replace("upper.bottom", "upper.start").replace("upper.top", "upper.end"))
        scabo.Model(model).run().to_meshio().write(self.directory / "mesh.vtu")
        mesh = meshio.read(self.directory / "mesh.vtu")
        edges = {"hexahedron20": ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
                 "wedge15": ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5))}  # with a node in the middle
        self.assertEqual({block.type for block in mesh.cells}, set(edges))
        for block in mesh.cells:
            x, ends = mesh.points[block.data], np.array(edges[block.type])
            np.testing.assert_allclose(x[:, -len(ends):], 0.5 * (x[:, ends[:, 0]] + x[:, ends[:, 1]]), atol=1e-12)
        np.testing.assert_allclose(mesh.point_data["stress"][:, 2], -PRESSURE, rtol=1e-5)


class Sections(InTemporaryDirectory):
    def test_history_is_the_same_in_memory_and_in_files(self):
        model = scabo.Model(stack(2))
        model["output"] = {"history": {"cut": {"section": {"point": [0, 0, 0.4], "normal": [0, 0, 1]}}}, "points": [[0.5, 0.5, 0.1]]}
        written, kept = model.run(self.directory / "out"), model.run()
        for name, column in kept.history.items():
            np.testing.assert_array_equal(column, written.history[name], name)
        np.testing.assert_allclose(kept.history["cut.normal"], [-0.4 * PRESSURE, -0.8 * PRESSURE], rtol=1e-9)
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(kept)).history["cut.normal"], kept.history["cut.normal"])
        self.assertTrue((self.directory / "out" / "points.csv").is_file())
        model["output"]["points"] = [[0.5, 0.5, 1.1]]
        with self.assertRaisesRegex(scabo.ModelError, "output.points.0: the point .* lies in no body"):
            model.check()


class Pages(InTemporaryDirectory):
    def content(self, **options):
        page = scabo.Model(stack(2)).run(self.directory / "out").report(self.directory / "page.html", **options).read_text(encoding="utf-8")
        data, = re.findall(r'<script type="application/json" id="content">(.*?)</script>', page, re.DOTALL)
        return json.loads(data), set(re.findall(r'<script type="text/plain" id="(\w+)"', page))

    def test_a_page_has_fields_and_faces(self):
        if not (pathlib.Path(scabo.__path__[0]) / "report" / "template.html").is_file():
            self.skipTest("the page for reports was not built")
        content, arrays = self.content(units="m,N")
        space = content["space"]
        self.assertEqual((space["bodies"], space["increments"], [face["name"] for face in space["faces"]]), (["lower", "upper"], [1, 2], ["joint"]))
        self.assertEqual((content["field"], content["pairs"]), (None, None))
        self.assertAlmostEqual(space["ranges"]["2"]["von_mises"][1], PRESSURE, delta=1e-6 * PRESSURE)
        self.assertAlmostEqual(content["totals"]["contacts"][0]["normal_force"][1], 0.8 * PRESSURE, delta=1e-6 * PRESSURE)
        self.assertAlmostEqual(content["reactions"]["supports"][0]["z"][1], 0.8 * PRESSURE, delta=1e-6 * PRESSURE)
        self.assertLessEqual({f"{key}_{number}" for key in ("ux", "uy", "uz", "xx", "yz", "von_mises") for number in (1, 2)}, arrays)
        content, arrays = self.content(fields="von_mises")
        self.assertEqual([quantity["key"] for quantity in content["space"]["quantities"]], ["von_mises"])
        self.assertNotIn("ux_1", arrays)
        content, arrays = self.content(megabytes=1e-3)  # one increment is always there, with its faces
        self.assertEqual(content["space"]["increments"], [2])
        self.assertIn("face_0_pressure_2", arrays)


class Running(unittest.TestCase):
    def test_progress(self):
        told = []
        scabo.Model(stack(3)).run(progress=lambda now: told.append((now.stage, now.increment, now.increments, now.fraction)))
        stages = list(dict.fromkeys(stage for stage, *_ in told))
        self.assertEqual(stages, ["mesh", *(f"step press, increment {k} of 3" for k in (1, 2, 3))])
        self.assertEqual(told[-1][1:], (3, 3, 1.0))

    def test_a_callback_ends_the_run(self):
        with self.assertRaises(scabo.Interrupted) as caught:
            scabo.Model(stack(4)).run(progress=lambda now: now.increment < 2)
        result = caught.exception.result
        self.assertEqual((result.status, len(result.increments)), ("interrupted", 2))
        np.testing.assert_allclose(result.contact["joint"].table()["pressure"], PRESSURE / 2, rtol=1e-9)

        def fail(now):
            if now.increment == 1:
                raise KeyError("mine")
        with self.assertRaisesRegex(KeyError, "mine") as caught:
            scabo.Model(stack(3)).run(progress=fail)
        self.assertEqual(len(caught.exception.result.increments), 1)

        def fail_at_once(now):
            raise KeyError("at once")
        with self.assertRaisesRegex(KeyError, "at once"):
            scabo.Model(stack(3)).run(progress=fail_at_once)
        with self.assertRaises(scabo.Interrupted):
            scabo.Model(stack(3)).run(progress=lambda now: False)

    def test_the_last_fields_alone(self):
        result = scabo.Model(stack(3)).run(keep_fields=False)
        self.assertEqual(len(result.increments), 3)
        np.testing.assert_allclose(result.contact["joint"].history()["normal_force"][:, 2], 0.8 * PRESSURE * np.array([1, 2, 3]) / 3)
        with self.assertRaisesRegex(LookupError, "keep_fields"):
            result.contact["joint"].table(0)
        self.assertEqual(result.nodal_displacement("lower").shape[1], 3)

    def test_a_mechanism_is_raised_with_what_was_before(self):
        model = scabo.Model(stack(2))
        model["loads"]["pull"] = {"on": "upper.top", "force": [0, 0, 1.2 * 0.8 * PRESSURE]}
        model["steps"] = [{"name": "press", "loads": {"press": 1}}, {"name": "pull", "loads": {"pull": 1}}]
        with self.assertRaisesRegex(scabo.Mechanism, "step pull, increment 1") as caught:
            model.run()
        result = caught.exception.result
        self.assertEqual(len(result.increments), 1)
        motion = result.mechanism  # it is lifted; by hand: the pull less the pressure, on 0.8 m2
        self.assertEqual((motion.text, motion.moving, motion.rule), (result.summary["mechanism"]["text"], ["upper"], result.summary["mechanism"]["rule"]))
        np.testing.assert_allclose(motion.shift, [[0, 0, 0], [0, 0, 1]], atol=1e-8)
        np.testing.assert_allclose(motion.displacement("upper", [[0, 0, 0.3], [1, 2, 3]]), [[0, 0, 1]] * 2, atol=1e-8)
        self.assertTrue(np.isnan(motion.centre).all())
        self.assertAlmostEqual(motion.work / (0.2 * 0.8 * PRESSURE), 1.0, delta=1e-8)
        joint, pairs = motion.contact("joint"), result.contact["joint"].table()
        np.testing.assert_array_equal(joint["pair"], pairs["pair"])
        np.testing.assert_array_equal(joint["position"], pairs["position"])
        np.testing.assert_allclose(joint["opening"], 1.0, atol=1e-8)
        np.testing.assert_allclose(joint["slip"], 0.0, atol=1e-8)
        for wrong in (lambda: motion.contact("bass"), lambda: motion.displacement("blok", [[0, 0, 0]])):
            with self.assertRaises(KeyError):
                wrong()
        with self.assertRaisesRegex(ValueError, r"\(n, 3\), as in \[\[x, y, z\]"):
            motion.displacement("upper", [[0, 0]])
        again = pickle.loads(pickle.dumps(result)).mechanism
        np.testing.assert_array_equal(again.contact("joint")["slip"], joint["slip"])

    def test_a_body_that_turns(self):
        """A pillar on a block without friction to speak of is pushed over its edge: u = w x (x - c)."""
        model = {
            "scabo": 1, "analysis": {"space": True},
            "materials": {"stone": {"young": 10e9, "poisson": 0.2, "density": 2500}},
            "bodies": {name: {"material": "stone", "shape": {"box": {"corner": corner, "size": size}}, "mesh": {"size": 0.5}}
                       for name, corner, size in (("ground", [0, 0, -1], [4, 3, 1]), ("pillar", [1, 1, 0], [1, 1, 2]))},
            "supports": [{"on": "ground.bottom", "fix": ["x", "y", "z"]}],
            "loads": {"weight": {"gravity": [0, 0, -10]}, "push": {"on": "pillar.left", "force": [20e3, 0, 0], "at": [1, 1.5, 2]}},
            "contacts": {"joint": {"between": ["ground.top", "pillar.bottom"], "friction": 0.8}},
        }
        with self.assertRaises(scabo.Mechanism) as caught:
            scabo.Model(model).run()
        motion = caught.exception.result.mechanism
        body = caught.exception.result.summary["mechanism"]["bodies"]["pillar"]
        np.testing.assert_allclose([motion.centre[1], motion.rotation[1]], [body["centre"], body["rotation"]], rtol=1e-12)
        axis = motion.rotation[1] / np.linalg.norm(motion.rotation[1])
        np.testing.assert_allclose(axis, [0, 1, 0], atol=1e-6)
        np.testing.assert_allclose(motion.displacement("pillar", [motion.centre[1]]), [[0, 0, 0]], atol=1e-8)
        top = motion.displacement("pillar", [[1, 1.5, 2]])
        np.testing.assert_allclose(top, [np.cross(motion.rotation[1], [1, 1.5, 2] - motion.centre[1])], atol=1e-8)
        self.assertGreater(top[0, 0], 0.9)

    def test_without_memory(self):
        model = scabo.Model(stack())
        for body in model["bodies"].values():
            body["mesh"]["size"] = 0.02
        with self.assertRaisesRegex(MemoryError, "ignore_memory=True"):
            before = resource.getrlimit(resource.RLIMIT_AS)
            used = int(pathlib.Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
            resource.setrlimit(resource.RLIMIT_AS, (used + 700_000_000, before[1]))
            try:
                model.run()
            finally:
                resource.setrlimit(resource.RLIMIT_AS, before)


if __name__ == "__main__":
    unittest.main()
