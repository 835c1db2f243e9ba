"""A quarter of a ball on a block with everything, held along axes, normals or directions, on faces, edges and points, turned and in two runs. Standard library
only."""
import itertools
import math
import unittest

import support
from solid_directions_test import Running, TOLERANCE, moved, sphere
from solid_twins_test import IDENTITY, product, rotation, text_of
from solids import HEAD, bodies_of

FIX = {"X": ("x", [1, 0, 0]), "Y": ("y", [0, 1, 0]), "BOTTOM": ("z", [0, 0, 1]), "RIGHT": ("x", [1, 0, 0])}


@unittest.skipIf(support.SANITIZED, "numbers")
class Twins(Running):
    """A quarter of a ball on a block, with friction, springs, a bar, temperature and supports that come and go, turned."""

    def meshes(self):
        self.run_model("""materials: {m: {young: 1e9, poisson: 0.2, density: 1}}
bodies:
  base: {material: m, shape: {box: {corner: [0, 0, -0.4], size: [0.8, 0.7, 0.4]}}, mesh: {size: 0.3, refine: [{near: [0, 0, 0], size: 0.06, growth: 0.5}]}}
  ball: {material: m, shape: {sphere: {centre: [0, 0, 0.5], radius: 0.5, keep: [+x, +y, -z]}}, mesh: {size: 0.25, refine: [{near: [0, 0, 0], size: 0.06, growth: 0.5}]}}
loads: {none: {gravity: [0, 0, 0]}}
""")
        return bodies_of(self.directory / "model.results" / "fields_0001.vtu", 2)

    def write(self, name, mesh, sets, turn):
        nodes, cells = mesh
        lines = ["*NODE", *(f"{k + 1}, " + ", ".join(repr(x) for x in moved(turn, node)) for k, node in enumerate(nodes)), "*ELEMENT, TYPE=C3D10, ELSET=ALL",
                 *(f"{k + 1}, " + ", ".join(str(node + 1) for node in cell) for k, cell in enumerate(cells))]
        for set_name, inside in sets.items():
            lines += [f"*NSET, NSET={set_name}", *(f"{k + 1}," for k, node in enumerate(nodes) if inside(node))]
        (self.directory / f"{name}.inp").write_text("\n".join(lines) + "\n", encoding="utf-8")

    def model(self, meshes, turn, how, steps, restart="", places=False):
        """`how`: axes, normals or directions. `places`: also supports, springs and bars on edges and at points."""
        if places:
            steps = steps.replace("drive: 1, push", "drive: 1, pin: 1, push").replace("jack: 1", "jack: 1, knob: 1")
        near = {"X": lambda p: abs(p[0]) < 1e-9, "Y": lambda p: abs(p[1]) < 1e-9}
        self.write("base", meshes[0], {**near, "BOTTOM": lambda p: p[2] < -0.4 + 1e-9, "TOP": lambda p: abs(p[2]) < 1e-9, "RIGHT": lambda p: p[0] > 0.8 - 1e-9,
                                       "BACK": lambda p: p[1] > 0.7 - 1e-9, "SKIN": lambda p: True}, turn)
        self.write("ball", meshes[1], {**near, "BALL": lambda p: abs(math.dist(p, (0, 0, 0.5)) - 0.5) < 1e-6, "HEAD": lambda p: abs(p[2] - 0.5) < 1e-9,
                                       "SKIN": lambda p: True}, turn)
        vector = lambda v: text_of(product(turn, v))

        def held(place):
            axis, along = FIX[place.split(".")[1]]
            return {"axes": f"fix: {axis}", "normals": "fix: normal", "directions": f"fix: {{along: {vector([-3 * x for x in along])}}}"}[how]

        drive = {"axes": "displacement: [null, null, -1.5e-2]", "normals": "displacement: {normal: -1.5e-2}",
                 "directions": f"displacement: {{along: {vector([0, 0, 2])}, value: -1.5e-2}}"}[how]
        supports = [f"{{on: {place}, {held(place)}, name: {place.replace('.', '_').lower()}}}" for place in ("base.X", "base.Y", "base.BOTTOM", "ball.X", "ball.Y")]
        slope = product(turn, [10.0, -4.0, 3.0])
        shift = 20.0 - sum(a * b for a, b in zip(slope, moved(turn, [0, 0, 0])))
        faces = ("base.X", "base.Y", "base.BOTTOM", "base.RIGHT", "ball.X", "ball.Y", "ball.HEAD") + (("base.BACK", "base.SKIN", "ball.SKIN") if places else ())
        supports_there, springs_there, bars_there = self.on_places(turn, how, steps) if places else ("", "", "")
        about = text_of(moved(turn, [0, 0, 0]))
        history = ", ".join(f"{face.replace('.', '_').lower()}: {{face: {face}, about: {about}}}" for face in faces)
        return f"""materials: {{m: {{young: 1e9, poisson: 0.2, expansion: 1e-5}}}}
bodies: {{base: {{material: m, mesh: {{file: base.inp}}}}, ball: {{material: m, mesh: {{file: ball.inp}}}}}}
supports:
""" + "".join(f"  - {text}\n" for text in supports) + f"""  - {{on: ball.HEAD, {drive}, name: drive}}
  - {{on: base.RIGHT, {held("base.RIGHT")}, name: prop{", removed: strike" if "strike" in steps else ""}}}
{self.jack(turn, how) if "strike" in steps else ""}{supports_there}springs: [{{on: base.BACK, k_n: 1e8, k_t: 5e7, name: soft}}{springs_there}]
bars: {{{bars_there}tie: {{between: [{{body: ball, at: {text_of(moved(turn, [0, 0.25, 0.5]))}}}, {text_of(moved(turn, [0, 1, 1]))}], k: 1e6}}}}
loads:
  push: {{on: base.BACK, traction: {vector([0, -3e5, 1e5])}}}
  heat: {{on: ball, temperature: {{constant: {shift!r}, x: {slope[0]!r}, y: {slope[1]!r}, z: {slope[2]!r}}}}}
contacts: {{joint: {{between: [base.TOP, ball.BALL], friction: 0.2, about: {about}}}}}
{restart}
steps: [{steps}]
output: {{points: [{text_of(moved(turn, [0.3, 0.3, 0.0]))}, {text_of(moved(turn, [0, 0.1, 0.2]))}], history: {{{history}}}}}
"""

    def jack(self, turn, how):
        """It pulls the right side on from where that is then."""
        along = {"axes": "[1e-4, null, null]", "normals": "{normal: 1e-4}", "directions": f"{{along: {text_of(product(turn, [-2, 0, 0]))}, value: -1e-4}}"}[how]
        return f"  - {{on: base.RIGHT, displacement: {along}, name: jack, added: back}}\n"

    def on_places(self, turn, how, steps):
        """An edge that is held until the prop goes, a point that is pulled on where its face is held along another direction, springs along an edge and
        at a node, and bars between edges, a point and the ground."""
        vector, later = lambda v: text_of(product(turn, v)), "strike" in steps
        tightened = ", tightened: push" if "name: push" in steps else ""  # not in the second one of two runs
        tangent = "fix: z" if how == "axes" else f"fix: {{along: {vector([0, 0, -2])}}}"
        supports = f"  - {{on: {{body: base, edge: [RIGHT, TOP]}}, {tangent}, name: rim{', removed: strike' if later else ''}}}\n"
        supports += f"  - {{on: {{body: base, point: [BACK, RIGHT, BOTTOM]}}, displacement: {{along: {vector([-1, -2, 2])}, value: 1e-5}}, name: pin}}\n"
        if later:
            supports += f"  - {{on: {{body: base, edge: [BACK, X]}}, displacement: {{along: {vector([0, 2, 1])}, value: -1e-4}}, name: knob, added: back}}\n"
        even = lambda k: f"k_x: {k}, k_y: {k}, k_z: {k}"
        springs = f", {{on: {{body: base, edge: [BACK, BOTTOM]}}, {even('1e7')}, name: bed}}"
        springs += f", {{on: {{body: base, at: {text_of(moved(turn, [0.8, 0, 0]))}}}, {even('1e6')}, name: nail}}"
        return (supports, springs,
                f"stay: {{between: [{{body: ball, edge: [X, HEAD]}}, {text_of(moved(turn, [-1, 0.25, 1]))}], k: 1e6}}, "
                f"brace: {{between: [{{body: base, edge: [BACK, TOP]}}, {{body: ball, point: [X, Y, HEAD]}}], k: 2e6, preload: 30{tightened}}}, ")

    FIRST = "{name: press, increments: 2, loads: {drive: 1, push: 0, heat: 0}}, {name: push, increments: 2, loads: {push: 1}}"
    SECOND = "{name: strike, increments: 2, loads: {heat: 1}}, {name: back, increments: 2, loads: {drive: 0.8, jack: 1}}"

    def told(self, summary, turn, name="model"):
        """Of every increment, in the axes of the original: forces, moments about its origin, energies, states, displacements, resultants."""
        back, origin, told = list(zip(*turn)), moved(turn, [0, 0, 0]), []

        def moment(of, force):
            arm = [origin[j] * force[k] - origin[k] * force[j] for j, k in ((1, 2), (2, 0), (0, 1))]
            return product(back, [a - b for a, b in zip(of, arm)])

        for increment in summary["increments"]:
            values = []
            for support_name, force in sorted(increment["reactions"].items()):
                values += [*product(back, force), *moment(increment["moments"][support_name], force)]
            joint = increment["contacts"]["joint"]
            values += [*product(back, joint["normal_force"]), *product(back, joint["tangential_force"]), *product(back, joint["moment"])]
            for _, force in sorted(increment["springs"].items()):
                values += product(back, force)
            values += [bar["tension"] for _, bar in sorted(increment["bars"].items())]
            values += [1e4 * increment["energy"][kind] for kind in ("external", "elastic", "friction")]
            told.append((values, [joint[state] for state in ("open", "stick", "slip")]))
        points = [[1e7 * x for x in product(back, [float(row[f"u{axis}"]) for axis in "xyz"])] for row in self.rows("points.csv", name)]
        rows = self.rows("history.csv", name)
        names = sorted({column.rsplit("_", 1)[0] for column in rows[0] if ".force_" in column or ".moment_" in column})
        faces = [product(back, [float(row[f"{column}_{axis}"]) for axis in "xyz"]) for row in rows for column in names]
        return told, points, faces

    def assert_same(self, one, other):
        size = max(abs(x) for values, _ in one[0] for x in values)
        for (values, states), (others, other_states) in zip(one[0], other[0], strict=True):
            self.assertEqual(states, other_states)
            for a, b in zip(values, others, strict=True):
                self.assertAlmostEqual(a, b, delta=TOLERANCE * size)
        for kind in (1, 2):
            size = max(abs(x) for vector in one[kind] for x in vector)
            for vector, other_vector in zip(one[kind], other[kind], strict=True):
                for a, b in zip(vector, other_vector, strict=True):
                    self.assertAlmostEqual(a, b, delta=TOLERANCE * size)

    def test_twins(self):
        meshes = self.meshes()
        steps = f"{self.FIRST}, {self.SECOND}"
        one = self.told(self.run_model(self.model(meshes, IDENTITY, "axes", steps)), IDENTITY)
        self.assertTrue(any(states[0] and states[1] and states[2] for _, states in one[0]), [states for _, states in one[0]])
        for turn, how in ((IDENTITY, "normals"), (IDENTITY, "directions"), (rotation(7), "normals"), (rotation(11), "directions")):
            with self.subTest(turned=turn is not IDENTITY, how=how):
                self.assert_same(one, self.told(self.run_model(self.model(meshes, turn, how, steps)), turn))

    def test_two_runs_are_one(self):
        """The second starts where the first ends, and a support of the first ends in it."""
        meshes, turn = self.meshes(), rotation(7)
        whole = self.told(self.run_model(self.model(meshes, turn, "normals", f"{self.FIRST}, {self.SECOND}"), "whole"), turn, "whole")
        self.run_model(self.model(meshes, turn, "normals", self.FIRST), "one")
        second = "{name: wait, loads: {drive: 1}}, " + self.SECOND
        later = self.told(self.run_model(self.model(meshes, turn, "normals", second, "restart: one.results"), "two"), turn, "two")
        for (values, states), (others, other_states) in zip(later[0][1:], whole[0][4:], strict=True):
            self.assertEqual(states, other_states)
            size = max(map(abs, others))
            for a, b in zip(values, others, strict=True):
                self.assertAlmostEqual(a, b, delta=TOLERANCE * size)

    def assert_balanced(self, summary, turn, name="model"):
        """All that acts through the sides of a body is in balance, also on edges and at points; and the back of the base has all that acts there."""
        back = list(zip(*turn))
        for increment, row in zip(summary["increments"], self.rows("history.csv", name), strict=True):
            for body, kind in itertools.product(("base", "ball"), ("force", "moment")):
                size = max(abs(float(value)) for key, value in row.items() if key.startswith(f"{body}_") and f".{kind}_" in key)
                for axis in "xyz":
                    self.assertLess(abs(float(row[f"{body}_skin.{kind}_{axis}"])), TOLERANCE * size)
            brace = [a - b for a, b in zip((0, 0, 0.5), (0.4, 0.7, 0.0))]
            acting = [[x * increment["bars"]["brace"]["tension"] / math.hypot(*brace) for x in brace], [x * 0.8 * 0.4 * increment["factors"]["push"] for x in (0, -3e5, 1e5)],
                      *(product(back, increment["springs"][springs]) for springs in ("soft", "bed")),
                      *(product(back, increment["reactions"].get(support_name, [0, 0, 0])) for support_name in ("pin", "knob"))]
            through = product(back, [float(row[f"base_back.force_{axis}"]) for axis in "xyz"])
            if any(increment["reactions"].get("rim", [0, 0, 0])):  # it ends at a node of the back, which it holds along z
                through, acting = through[:2], [force[:2] for force in acting]
            for found, *forces in zip(through, *acting, strict=True):
                self.assertAlmostEqual(found, sum(forces), delta=TOLERANCE * 1e5)

    def test_twins_on_edges_and_points(self):
        meshes = self.meshes()
        steps = f"{self.FIRST}, {self.SECOND}"
        summary = self.run_model(self.model(meshes, IDENTITY, "axes", steps, places=True))
        self.assert_balanced(summary, IDENTITY)
        one = self.told(summary, IDENTITY)
        reactions = [increment["reactions"] for increment in summary["increments"]]
        self.assertGreater(math.hypot(*reactions[3]["rim"]), 1.0)
        self.assertGreater(math.hypot(*reactions[4]["rim"]), 0.1)
        for name, increment in (("rim", 5), ("rim", 7), ("knob", 5)):
            self.assertEqual(reactions[increment].get(name, [0, 0, 0]), [0, 0, 0])
        self.assertGreater(math.hypot(*reactions[7]["knob"]), 1.0)
        for turn, how in ((IDENTITY, "normals"), (rotation(7), "normals"), (rotation(11), "directions")):
            with self.subTest(turned=turn is not IDENTITY, how=how):
                summary = self.run_model(self.model(meshes, turn, how, steps, places=True))
                self.assert_balanced(summary, turn)
                self.assert_same(one, self.told(summary, turn))

    def test_two_runs_on_edges_and_points_are_one(self):
        """Of all that acts on edges and at points: forces, displacements and resultants of faces; an edge that is held in the first run ends in the second."""
        meshes = self.meshes()
        for turn, how in ((IDENTITY, "axes"), (rotation(7), "directions")):
            with self.subTest(turned=turn is not IDENTITY, how=how):
                whole = self.told(self.run_model(self.model(meshes, turn, how, f"{self.FIRST}, {self.SECOND}", places=True), "whole"), turn, "whole")
                self.run_model(self.model(meshes, turn, how, self.FIRST, places=True), "one")
                second = self.run_model(self.model(meshes, turn, how, "{name: wait, loads: {}}, " + self.SECOND, "restart: one.results", places=True), "two")
                self.assert_balanced(second, turn, "two")
                later = self.told(second, turn, "two")
                faces = len(whole[2]) // 8
                self.assert_same((later[0][1:], later[1][2:], later[2][faces:]), (whole[0][4:], whole[1][8:], whole[2][4 * faces:]))


if __name__ == "__main__":
    support.main()
