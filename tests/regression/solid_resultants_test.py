"""Resultants over faces of bodies in space: the faces of a body are in balance with its weight, and each has what is known to act on it, whatever the
axes and the units; displacements and stresses at points in the history."""
import csv
import itertools
import math
import unittest

import support
from solids import HEAD
from solid_twins_test import IDENTITY, product, rotation, text_of
from support import scabo, summary_of

SIZE, WEIGHT = (1.2, 1.0, 0.8), (300.0, -200.0, -900.0)
ABOUT, RIM, PIN = (0.3, -0.2, 1.1), (0.0, 0.5, 0.8), (0.0, 5.0, -7.0)
FACES = {"LEFT": (0, 0), "RIGHT": (0, 1), "FRONT": (1, 0), "BACK": (1, 1), "BOTTOM": (2, 0), "TOP": (2, 1)}
CORNERS = ((0, 1, 3, 7), (0, 1, 5, 7), (0, 2, 3, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 4, 6, 7))  # of six tetrahedra in a cube
CYCLES = ((1, 2), (2, 0), (0, 1))


def cross(a, b):
    return [a[j] * b[k] - a[k] * b[j] for j, k in CYCLES]


def less(a, b):
    return [x - y for x, y in zip(a, b)]


def box(corner, size, parts, turn, scale):
    """A deck of linear tetrahedra, turned, with its faces as sets of nodes, and the nodes within the edge of LEFT and TOP."""
    place = {}
    for at in itertools.product(*(range(n + 1) for n in parts)):
        place[at] = len(place) + 1
    points = {at: [c + s * i / n for c, s, i, n in zip(corner, size, at, parts)] for at in place}
    lines = ["*NODE", *(f"{number}, " + ", ".join(repr(scale * x) for x in product(turn, points[at])) for at, number in place.items()), "*ELEMENT, TYPE=C3D4, ELSET=ALL"]
    number = 0
    for at in itertools.product(*(range(n) for n in parts)):
        for cell in CORNERS:
            nodes = [tuple(a + (corner >> k & 1) for k, a in enumerate(at)) for corner in cell]
            u, v, w = (product(turn, less(points[node], points[nodes[0]])) for node in nodes[1:])
            if sum(x * y for x, y in zip(cross(u, v), w)) < 0:
                nodes[0], nodes[1] = nodes[1], nodes[0]
            number += 1
            lines.append(f"{number}, " + ", ".join(str(place[node]) for node in nodes))
    sets = {name: [place[at] for at in place if at[axis] == end * parts[axis]] for name, (axis, end) in FACES.items()}
    sets["RIM"] = [place[at] for at in place if at[0] == 0 and at[1] not in (0, parts[1]) and at[2] == parts[2]]
    for name, nodes in sets.items():
        lines += [f"*NSET, NSET={name}", *(f"{node}," for node in nodes)]
    return "\n".join(lines) + "\n"


class Resultants(support.InTemporaryDirectory):
    def rows(self):
        with open(self.directory / "results" / "history.csv", encoding="utf-8", newline="") as file:
            return [{name: float(value or "nan") for name, value in row.items()} for row in csv.DictReader(file)]

    def solve(self, turn=IDENTITY, scale=1.0, force=1.0):
        """A block under everything, between a base, a wall that it is tied to, and springs. `scale` of lengths, `force` of forces. Returns resultants of the
        faces in the axes and units of the original, and the summary."""
        for name, corner, size, parts in (("block", (0, 0, 0), SIZE, (2, 2, 2)), ("base", (-0.3, -0.3, -0.5), (1.9, 1.7, 0.5), (3, 3, 1)),
                                          ("wall", (1.2, -0.1, 0.1), (0.4, 1.3, 0.5), (1, 3, 1))):
            (self.directory / f"{name}.inp").write_text(box(corner, size, parts, turn, scale), encoding="utf-8")
        of = lambda *vector, unit=force: text_of([unit * x for x in product(turn, vector)])  # noqa: E731
        per_area, length = force / scale**2, lambda *vector: text_of([scale * x for x in product(turn, vector)])
        density = force / (scale**3) / math.prod(SIZE)
        model = f"""materials: {{m: {{young: {1e7 * per_area!r}, poisson: 0.3, density: {density!r}, expansion: 1e-5}}}}
bodies:
  block: {{material: m, mesh: {{file: block.inp}}}}
  base: {{material: m, mesh: {{file: base.inp}}}}
  wall: {{material: m, mesh: {{file: wall.inp}}}}
supports:
  - {{on: base.BOTTOM, fix: [x, y, z]}}
  - {{on: wall.RIGHT, fix: [x, y, z]}}
  - {{on: block.RIM, displacement: {length(1e-4, 0, 0)}, name: rim}}
springs: [{{on: block.FRONT, k_n: {1e5 * per_area / scale!r}, k_t: {3e4 * per_area / scale!r}}}, {{on: block.BACK, k_n: {1e5 * per_area / scale!r}, at_rest: {1e-3 * scale!r}, name: jack}}]
loads:
  weight: {{on: block, gravity: {of(*WEIGHT, unit=1.0)}}}
  press: {{on: block.TOP, pressure: {2000 * per_area!r}}}
  push: {{on: block.TOP, force: {of(400, 100, -300)}, at: {length(0.9, 0.7, 0.8)}}}
  drag: {{on: block.BACK, traction: {of(50, 70, -80, unit=per_area)}}}
  twist: {{on: block.LEFT, moment: {of(10, 20, 30, unit=force * scale)}}}
  pins: {{on: block.RIM, nodal_force: {of(*PIN)}}}
  heat: {{on: block, temperature: 20}}
contacts: {{joint: {{between: [base.TOP, block.BOTTOM], friction: 0.5}}}}
ties: {{glue: {{between: [block.RIGHT, wall.LEFT]}}}}
steps: [{{name: all, increments: 2}}]
output:
  history:
    {chr(10).join(f"    {name.lower()}: {{face: block.{name}, about: {length(*ABOUT)}}}" for name in FACES).strip()}
    footing: {{face: base.TOP}}
"""
        (self.directory / "model.yaml").write_text(HEAD + model, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        back = [[turn[k][i] for k in range(3)] for i in range(3)]
        last = self.rows()[-1]
        found = {}
        for name in [*(name.lower() for name in FACES), "footing"]:
            found[name] = [[x / unit for x in product(back, [last[f"{name}.{kind}_{axis}"] for axis in "xyz"])] for kind, unit in (("force", force), ("moment", force * scale))]
        return found, summary_of(self.directory / "results")["increments"][-1]

    def near(self, found, expected, size=3000.0):
        for a, b in zip(found, expected, strict=True):
            self.assertAlmostEqual(a, b, delta=1e-9 * size)

    def test_the_faces_of_a_body_balance_its_weight(self):
        found, last = self.solve()
        rim = [r + p for r, p in zip(last["reactions"]["rim"], PIN)]  # on two faces, LEFT and TOP, which both count it
        force = [sum(of[0][k] for name, of in found.items() if name != "footing") for k in range(3)]
        self.near([f + w for f, w in zip(force, WEIGHT)], rim)
        moment = [sum(of[1][k] for name, of in found.items() if name != "footing") for k in range(3)]
        arm = less([0.5 * x for x in SIZE], ABOUT)
        self.near([m + w for m, w in zip(moment, cross(arm, WEIGHT))], cross(less(RIM, ABOUT), rim))

    def test_each_face_has_what_acts_there(self):
        found, last = self.solve()
        joint, glue = last["contacts"]["joint"], last["contacts"]["glue"]
        on_block = [a + b for a, b in zip(joint["normal_force"], joint["tangential_force"])]
        self.near(found["bottom"][0], on_block)
        self.near(found["bottom"][1], less(joint["moment"], cross(ABOUT, on_block)))  # plane faces without a gap have one moment
        self.near(found["footing"][0], [-x for x in on_block])
        self.near(found["footing"][1], [-x for x in joint["moment"]])
        self.near(found["right"][0], [-(a + b) for a, b in zip(glue["normal_force"], glue["tangential_force"])])
        self.near(found["front"][0], last["springs"]["block.FRONT"])
        self.near(found["back"][0], [a + b * 1.2 * 0.8 for a, b in zip(last["springs"]["jack"], (50, 70, -80))])
        rim = [r + p for r, p in zip(last["reactions"]["rim"], PIN)]
        self.near(found["top"][0], [r + p for r, p in zip(rim, (400, 100, -300 - 2000 * 1.2))])
        self.near(found["left"][0], rim)
        of_rim = cross(less(RIM, ABOUT), rim)
        self.near(found["left"][1], [r + m for r, m in zip(of_rim, (10, 20, 30))])
        top = [a + b for a, b in zip(cross(less((0.9, 0.7, 0.8), ABOUT), (400, 100, -300)), cross(less((0.6, 0.5, 0.8), ABOUT), (0, 0, -2400)))]
        self.near(found["top"][1], [r + m for r, m in zip(of_rim, top)])

    def test_stages(self):
        """A block that comes in the second step, and a support that ends in the third: the faces balance the loads that act, and what is not there has none."""
        text = """materials: {m: {young: 1e7, poisson: 0.3, density: 500}}
bodies:
  base: {material: m, shape: {box: {corner: [0, 0, 0], size: [1, 1, 1]}}, mesh: {size: 0.5}}
  lid: {material: m, shape: {box: {corner: [0, 0, 1], size: [1, 1, 0.5]}}, mesh: {size: 0.5}, added: lid}
supports: [{on: base.bottom, fix: [x, y, z], name: ground}, {on: base.right, fix: x, removed: strike, name: prop}]
loads:
  weight: {gravity: [0, 0, -10]}
  push: {on: base.left, traction: [3000, 0, 0]}
  press: {on: lid.top, pressure: 4000}
contacts: {joint: {between: [base.top, lid.bottom], friction: 0.5}}
steps:
  - {name: base, loads: {weight: 1, push: 1}}
  - {name: lid, increments: 2, loads: {press: 1}}
  - {name: strike, increments: 4, loads: {}}
output:
  history:
""" + "".join(f"    {body}_{face}: {{face: {body}.{face}, about: [0.5, 0.5, 0.5]}}\n" for body in ("base", "lid") for face in ("bottom", "top", "left", "right", "front", "back"))
        (self.directory / "model.yaml").write_text(HEAD + text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        increments = summary_of(self.directory / "results")["increments"]
        for row, increment, there in zip(self.rows(), increments, (0, 0.5, 1, 1, 1, 1, 1), strict=True):
            total = lambda body, of: sum(row[f"{body}_{face}.{of}"] for face in ("bottom", "top", "left", "right", "front", "back"))  # noqa: E731
            for body, weight in (("base", 5000.0), ("lid", 2500.0 * there)):
                for axis, exact in zip("xyz", (0.0, 0.0, weight)):
                    self.assertAlmostEqual(total(body, f"force_{axis}"), exact, delta=1e-9 * 5000)
            press = 4000 * there**2  # its factor grows with the part of the lid that is there
            self.assertAlmostEqual(row["lid_top.force_z"], -press, delta=1e-9 * 5000)
            self.assertAlmostEqual(row["base_top.force_z"], -press - 2500 * there, delta=1e-9 * 5000)
            prop = increment["reactions"].get("prop", [0.0] * 3)
            self.assertAlmostEqual(row["base_right.force_x"], prop[0], delta=1e-9 * 5000)
        self.assertLess(self.rows()[2]["base_right.force_x"], -500)
        self.assertAlmostEqual(self.rows()[-1]["base_right.force_x"], 0.0, delta=1e-9 * 5000)
        (self.directory / "model.yaml").write_text(HEAD + text.replace("added: lid}", "added: lid, removed: strike}"), encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "again", "--quiet")
        self.assertEqual(done.returncode, 1)
        self.assertIn("body 'lid', which touches 'base', is removed in a step", done.stderr)

    def test_turned_and_in_millimetres(self):
        found, _ = self.solve()
        for turn, scale, force in ((rotation(5), 1.0, 1.0), (IDENTITY, 1e3, 1e-3), (rotation(6), 1e3, 1.0)):
            other, _ = self.solve(turn, scale, force)
            for name, (vector, moment) in found.items():
                self.near(other[name][0], vector)
                self.near(other[name][1], moment)

    def test_a_face_that_has_some_of_the_sides_of_a_load(self):
        (self.directory / "block.inp").write_text(box((0, 0, 0), SIZE, (2, 2, 2), IDENTITY, 1.0).replace(
            "*NSET, NSET=RIM", "*NSET, NSET=HALF\n" + "\n".join(f"{9 * i + 3 * j + 3}," for i in (0, 1) for j in (0, 1, 2)) + "\n*NSET, NSET=RIM"), encoding="utf-8")
        (self.directory / "model.yaml").write_text(HEAD + """materials: {m: {young: 1e7, poisson: 0.3}}
bodies: {block: {material: m, mesh: {file: block.inp}}}
supports: [{on: block.BOTTOM, fix: [x, y, z]}]
loads: {press: {on: block.TOP, pressure: 1}}
output: {history: {half: {face: block.HALF}}}
""", encoding="utf-8")
        for command in ("check", "run"):
            done = scabo(command, self.directory / "model.yaml")
            self.assertEqual(done.returncode, 1)
            self.assertIn("model.yaml:7:33: output.history.half.face: 'block.HALF' has some of the sides on which load 'press' acts, and not all of them: "
                          "name a face that has all or none", done.stderr)

    def test_points(self):
        """A column in pressure without Poisson's ratio: u_z = -p z / E, also of a rigid plate on it."""
        (self.directory / "model.yaml").write_text(HEAD + """materials: {m: {young: 1e7, poisson: 0, density: 1}}
bodies:
  post: {material: m, shape: {box: {corner: [0, 0, 0], size: [1, 1, 2]}}, mesh: {size: 1}}
  plate: {rigid: true, shape: {box: {corner: [0, 0, 2], size: [1, 1, 0.2]}}, mesh: {size: 1}}
supports: [{on: post.bottom, fix: [x, y, z]}]
loads: {press: {on: plate, force: [0, 0, -1e4]}}
ties: {glue: {between: [post.top, plate.bottom]}}
steps: [{increments: 2}]
output:
  points: [{at: [0.3, 0.4, 1.5], name: high}, {at: [0.3, 0.4, 0.5], name: low}, {at: [0.5, 0.5, 2.1], name: lid}]
  history:
    settlement: high.uz
    squeeze: {displacement: high, relative_to: low}
    lid: {displacement: lid}
    stress: low.stress_zz
    shear: low.stress_yz
    least: low.principal_3
    mises: low.von_mises
    rigid: lid.stress_xx
""", encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        for row, part in zip(self.rows(), (0.5, 1.0), strict=True):
            for name, value in (("settlement", -1.5e-3), ("squeeze.uz", -1e-3), ("squeeze.ux", 0.0), ("lid.uz", -2e-3), ("stress", -1e4), ("shear", 0.0), ("least", -1e4), ("mises", 1e4)):
                self.assertAlmostEqual(row[name], part * value, delta=5e-9 * (1e4 if name in ("stress", "shear", "least", "mises") else 2e-3))
            self.assertTrue(math.isnan(row["rigid"]))


if __name__ == "__main__":
    support.main()
