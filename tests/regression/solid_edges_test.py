"""Edges and points of bodies in space as places: reactions that statics fixes, closed forms, the same whatever axes and units; curves of mesh files."""
import csv
import math
import unittest

import support
from solid_bars_test import solution_of
from solid_resultants_test import FACES, box, cross, less
from solid_twins_test import IDENTITY, product, rotation, text_of
from solids import HEAD
from support import scabo, summary_of

SIZE = (1.2, 1.0, 0.8)
MIRROR = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]
# Six linear tetrahedra fill the unit cube.
CUBE_MSH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
0 4 "tip"
1 1 "crest"
2 2 "foot"
3 3 "cube"
$EndPhysicalNames
$Nodes
8
1 0 0 0
2 1 0 0
3 0 1 0
4 1 1 0
5 0 0 1
6 1 0 1
7 0 1 1
8 1 1 1
$EndNodes
$Elements
11
1 15 2 4 1 8
2 1 2 1 1 5 6
3 1 2 1 2 6 8
4 2 2 2 1 1 2 4
5 2 2 2 1 1 3 4
6 4 2 3 1 1 2 4 8
7 4 2 3 1 1 2 6 8
8 4 2 3 1 1 3 4 8
9 4 2 3 1 1 3 7 8
10 4 2 3 1 1 5 6 8
11 4 2 3 1 1 5 7 8
$EndElements
"""


def table(file):
    with open(file, encoding="utf-8", newline="") as opened:
        return list(csv.DictReader(opened))


class Edges(support.InTemporaryDirectory):
    def solve(self, text):
        (self.directory / "model.yaml").write_text(HEAD + text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return summary_of(self.directory / "results")["increments"][-1]

    def near(self, found, expected, size):
        for a, b in zip(found, expected, strict=True):
            self.assertAlmostEqual(a, b, delta=1e-9 * size)

    def point_row(self, name="tip"):
        rows = [row for row in table(self.directory / "results" / "points.csv") if row["name"] == name]
        return [float(rows[-1][key]) for key in ("ux", "uy", "uz")]

    def on_points(self, turn=IDENTITY, scale=1.0, force=1.0):
        """A block on three, two and one components of three corners, loaded along an edge, at a corner and by its weight."""
        (self.directory / "block.inp").write_text(box((0, 0, 0), SIZE, (2, 2, 2), turn, scale), encoding="utf-8")
        vector = lambda *v, unit=force: text_of([unit * x for x in product(turn, v)])  # noqa: E731
        corners = {"a": (0, 0, 0), "b": (1.2, 0, 0), "c": (0, 1.0, 0)}
        line, pin, weight = (30.0, 40.0, -200.0), (100.0, -50.0, 80.0), (0.0, 0.0, -900.0)
        density = force / scale**3 / math.prod(SIZE)
        last = self.solve(f"""materials: {{m: {{young: {1e7 * force / scale**2!r}, poisson: 0.3, density: {density!r}}}}}
bodies: {{block: {{material: m, mesh: {{file: block.inp}}}}}}
supports:
  - {{on: {{body: block, point: [LEFT, FRONT, BOTTOM]}}, fix: [x, y, z], name: a}}
  - {{on: {{body: block, point: [RIGHT, BOTTOM, FRONT]}}, fix: [y, z], name: b}}
  - {{on: {{body: block, at: {text_of([scale * x for x in product(turn, corners["c"])])}}}, fix: [z], name: c}}
loads:
  crest: {{on: {{body: block, edge: [RIGHT, TOP]}}, line_load: {vector(*line, unit=force / scale)}}}
  pin: {{on: {{body: block, point: [TOP, BACK, LEFT]}}, force: {vector(*pin)}}}
  weight: {{gravity: {vector(*weight, unit=1.0)}}}
""")
        held = [("a", 0), ("a", 1), ("a", 2), ("b", 1), ("b", 2), ("c", 2)]
        columns = []
        for name, axis in held:
            e = [float(axis == k) for k in range(3)]
            columns.append([*e, *cross(product(turn, corners[name]), e)])
        right = [0.0] * 6
        for load, at in ((line, (1.2, 0.5, 0.8)), (pin, (0.0, 1.0, 0.8)), (weight, [0.5 * x for x in SIZE])):
            f, x = product(turn, load), product(turn, at)
            right = [a - b for a, b in zip(right, [*f, *cross(x, f)])]
        exact = solution_of([[column[i] for column in columns] for i in range(6)], right)
        found = [last["reactions"][name][axis] / force for name, axis in held]
        self.near(found, exact, 2000)
        return last["energy"]["elastic"] / (force * scale)

    def test_a_block_on_three_points(self):
        """Six reactions follow from statics."""
        energy = self.on_points()
        for turn, scale, force in ((rotation(4), 1.0, 1.0), (MIRROR, 1.0, 1.0), (rotation(9), 1e3, 1e-3)):
            self.on_points(turn, scale, force)
        again = self.on_points(IDENTITY, 1e3, 1e-3)
        self.assertAlmostEqual(again, energy, delta=1e-9 * energy)

    def on_skew_directions(self, turn=IDENTITY, scale=1.0, force=1.0):
        """The block on three, two and one directions of three corners, at no right angles. Returns the reactions by name, in its axes."""
        (self.directory / "block.inp").write_text(box((0, 0, 0), SIZE, (2, 2, 2), turn, scale), encoding="utf-8")
        vector = lambda *v, unit=force: text_of([unit * x for x in product(turn, v)])  # noqa: E731
        places = {"a": ("point: [LEFT, FRONT, BOTTOM]", (0, 0, 0)), "b": ("point: [RIGHT, BOTTOM, FRONT]", (1.2, 0, 0)),
                  "c": (f"at: {vector(0, 1, 0, unit=scale)}", (0, 1.0, 0))}
        held = {"a_1": (1, 2, 2), "a_2": (0, -3, 1), "a_3": (-4, 0, 1), "b_1": (0.5, 1, 3), "b_2": (1, -2, 0), "c_1": (0.2, -0.1, 1)}
        line, pin = (30.0, 40.0, -200.0), (100.0, -50.0, 80.0)
        supports = "".join(f"  - {{on: {{body: block, {places[name[0]][0]}}}, fix: {{along: {vector(*along, unit=1.0)}}}, name: {name}}}\n" for name, along in held.items())
        last = self.solve(f"""materials: {{m: {{young: {1e7 * force / scale**2!r}, poisson: 0.3}}}}
bodies: {{block: {{material: m, mesh: {{file: block.inp}}}}}}
supports:
{supports}loads:
  crest: {{on: {{body: block, edge: [RIGHT, TOP]}}, line_load: {vector(*line, unit=force / scale)}}}
  pin: {{on: {{body: block, point: [TOP, BACK, LEFT]}}, force: {vector(*pin)}}}
""")
        columns = [[*along, *cross(places[name[0]][1], along)] for name, along in held.items()]
        right = [0.0] * 6
        for load, at in ((line, (1.2, 0.5, 0.8)), (pin, (0.0, 1.0, 0.8))):
            right = [a - b for a, b in zip(right, [*load, *cross(at, load)])]
        exact = solution_of([[column[i] for column in columns] for i in range(6)], right)
        found = {name: [x / force for x in product(list(zip(*turn)), last["reactions"][name])] for name in held}
        for (name, along), part in zip(held.items(), exact, strict=True):
            self.near(found[name], [part * x for x in along], 2000)
        return found

    def test_a_block_on_directions_of_three_points(self):
        """Each reaction lies along its direction, and all six follow from statics."""
        one = self.on_skew_directions()
        for turn, scale, force in ((rotation(4), 1.0, 1.0), (MIRROR, 1.0, 1.0), (rotation(9), 1e3, 1e-3)):
            other = self.on_skew_directions(turn, scale, force)
            for name, reaction in one.items():
                self.near(other[name], reaction, 2000)

    def on_directions_of_edges(self, how, turn=IDENTITY, scale=1.0, force=1.0):
        """A block on two edges, of which one is moved, and on a point; along axes, or along the same directions. Reactions, moments, resultants of
        faces, and the displacement of a point, in the axes and units of the original."""
        (self.directory / "block.inp").write_text(box((0, 0, 0), SIZE, (3, 2, 2), turn, scale), encoding="utf-8")
        vector = lambda *v, unit=1.0: text_of([unit * x for x in product(turn, v)])  # noqa: E731
        places = {"a": "edge: [LEFT, BOTTOM]", "b": "edge: [RIGHT, BOTTOM]", "c": "point: [LEFT, FRONT, TOP]"}
        supports, lengths = "", (-1.0, 2.0, 0.25)  # what directions are given by does not count
        for place, axis, value in (("a", 0, 0), ("a", 2, 0), ("b", 0, 1e-4), ("b", 2, -3e-4), ("c", 1, 0)):
            along = vector(*(lengths[axis] * (k == axis) for k in range(3)))
            value *= scale * (math.copysign(1, lengths[axis]) if how == "directions" else 1)
            hold = f"displacement: {{along: {along}, value: {value!r}}}" if value else f"fix: {{along: {along}}}"
            if how == "axes":
                hold = f"displacement: {text_of([value if k == axis else None for k in range(3)]).replace('None', 'null')}" if value else f"fix: {'xyz'[axis]}"
            supports += f"  - {{on: {{body: block, {places[place]}}}, {hold}, name: {place}_{axis}}}\n"
        faces = ", ".join(f"{name.lower()}: {{face: block.{name}}}" for name in FACES)
        stiff = f"{1e4 * force / scale**2!r}"
        last = self.solve(f"""materials: {{m: {{young: {1e7 * force / scale**2!r}, poisson: 0.3}}}}
bodies: {{block: {{material: m, mesh: {{file: block.inp}}}}}}
supports:
{supports}loads:
  crest: {{on: {{body: block, edge: [FRONT, TOP]}}, force: {vector(30, 40, -200, unit=force)}}}
  pin: {{on: {{body: block, point: [TOP, BACK, LEFT]}}, force: {vector(100, -50, 80, unit=force)}}}
springs: [{{on: {{body: block, edge: [BACK, TOP]}}, k_x: {stiff}, k_y: {stiff}, k_z: {stiff}}}]
output: {{points: [{{at: {vector(*[0.999 * x for x in SIZE], unit=scale)}, name: tip}}], history: {{{faces}}}}}
""")
        back = list(zip(*turn))
        told = [[1e6 * x / scale for x in product(back, self.point_row())]]
        sense = round(sum(a * b for a, b in zip(turn[0], cross(turn[1], turn[2]))))  # of moments in a mirror
        for name in sorted(last["reactions"]):
            told += [[x / force for x in product(back, last["reactions"][name])], [sense * x / (force * scale) for x in product(back, last["moments"][name])]]
        row = table(self.directory / "results" / "history.csv")[-1]
        for name in FACES:
            told += [[unit * x for x in product(back, [float(row[f"{name.lower()}.{kind}_{axis}"]) for axis in "xyz"])]
                     for kind, unit in (("force", 1 / force), ("moment", sense / (force * scale)))]
        return told

    def test_twins_along_directions(self):
        """Along axes and along directions, turned, seen in a mirror, and in other units."""
        one = self.on_directions_of_edges("axes")
        size = max(abs(x) for told in one for x in told)
        for turn, scale, force in ((IDENTITY, 1.0, 1.0), (rotation(5), 1.0, 1.0), (MIRROR, 1.0, 1.0), (IDENTITY, 1e3, 1e-3), (rotation(2), 1e-3, 1e6)):
            for found, expected in zip(self.on_directions_of_edges("directions", turn, scale, force), one, strict=True):
                self.near(found, expected, size)

    def loaded_along_an_edge(self, turn=IDENTITY, scale=1.0, force=1.0):
        (self.directory / "block.inp").write_text(box((0, 0, 0), SIZE, (3, 2, 2), turn, scale), encoding="utf-8")
        vector = lambda *v, unit=1.0: text_of([unit * x for x in product(turn, v)])  # noqa: E731
        self.solve(f"""materials: {{m: {{young: {1e7 * force / scale**2!r}, poisson: 0.3}}}}
bodies: {{block: {{material: m, mesh: {{file: block.inp}}}}}}
supports: [{{on: {{body: block, edge: [LEFT, BOTTOM]}}, fix: [x, y, z]}}, {{on: {{body: block, edge: [RIGHT, BOTTOM]}}, fix: [x, y, z]}}]
loads:
  crest: {{on: {{body: block, edge: [FRONT, TOP]}}, force: {vector(30, 40, -200, unit=force)}}}
  pin: {{on: {{body: block, point: [TOP, BACK, LEFT]}}, force: {vector(100, -50, 80, unit=force)}}}
springs: [{{on: {{body: block, edge: [BACK, TOP]}}, k_x: {1e4 * force / scale**2!r}, k_y: {1e4 * force / scale**2!r}, k_z: {1e4 * force / scale**2!r}}}]
output: {{points: [{{at: {vector(*[0.999 * x for x in SIZE], unit=scale)}, name: tip}}]}}
""")
        return [x / scale for x in product([[turn[k][i] for k in range(3)] for i in range(3)], self.point_row())]

    def test_twins(self):
        """Turned, seen in a mirror, and in other units."""
        one = self.loaded_along_an_edge()
        size = max(abs(x) for x in one)
        for turn, scale, force in ((rotation(5), 1.0, 1.0), (MIRROR, 1.0, 1.0), (IDENTITY, 1e3, 1e-3), (rotation(2), 1e-3, 1e6)):
            self.near(self.loaded_along_an_edge(turn, scale, force), one, size)

    def cantilever(self, load, kind="tetrahedra", size=0.25):
        return self.solve(f"""materials: {{m: {{young: 1e9, poisson: 0}}}}
bodies: {{beam: {{material: m, shape: {{box: {{corner: [0, 0, 0], size: [5, 0.5, 0.5]}}}}, mesh: {{size: {size}, kind: {kind}}}}}}}
supports: [{{on: beam.left, fix: [x, y, z], name: wall}}]
loads: {{push: {{on: {{body: beam, edge: [right, top]}}, {load}}}}}
output: {{points: [{{at: [5, 0.25, 0.25], name: tip}}], history: {{right: {{face: beam.right}}, top: {{face: beam.top}}}}}}
""")

    def test_a_cantilever_with_a_load_along_its_edge(self):
        """A force over the edge is its constant force per length; the wall has the resultant and its moment; the tip that of Timoshenko's beam."""
        for kind in ("tetrahedra", "hexahedra"):
            tips = []
            for load in ("line_load: [0, 0, -2e3]", "force: [0, 0, -1e3]", 'line_load: {formula: [0, null, "-2e3"]}'):
                last = self.cantilever(load, kind)
                self.near(last["reactions"]["wall"], [0, 0, 1e3], 1e3)
                self.near(last["moments"]["wall"], [250.0, -5e3, 0], 5e3)
                tips.append(self.point_row()[2])
            self.near(tips, [tips[0]] * 3, abs(tips[0]))
            inertia, area = 0.5**4 / 12, 0.25
            exact = -1e3 * 5**3 / (3 * 1e9 * inertia) - 1e3 * 5 / (5 / 6 * 0.5e9 * area)
            self.assertAlmostEqual(tips[0], exact, delta=3e-3 * abs(exact))
            row = table(self.directory / "results" / "history.csv")[-1]
            for face in ("right", "top"):  # what acts along an edge counts for both of its faces
                self.near([float(row[f"{face}.force_{axis}"]) for axis in "xyz"], [0, 0, -1e3], 1e3)

    def test_a_line_load_by_formula(self):
        """Its resultant and moment are the integrals of a quadratic one."""
        for kind in ("tetrahedra", "hexahedra"):
            last = self.cantilever('line_load: {formula: ["30 * y", "6 * y^2", "-2 * (1 + y^2)"]}', kind)
            b = 0.5
            total = [15 * b**2, 2 * b**3, -2 * (b + b**3 / 3)]
            first = [10 * b**3, 6 * b**4 / 4, -2 * (b**2 / 2 + b**4 / 4)]  # integrals of y times it
            self.near(last["reactions"]["wall"], [-x for x in total], 10)
            moment = [first[2] - 0.5 * total[1], 0.5 * total[0] - 5 * total[2], 5 * total[1] - first[0]]
            self.near(last["moments"]["wall"], [-x for x in moment], 10)

    def test_the_rim_of_a_cylinder(self):
        """A force is the total; a line load times the length of the rim, up to its parabolas."""
        model = """materials: {{m: {{young: 1e9, poisson: 0.3}}}}
bodies: {{post: {{material: m, shape: {{cylinder: {{from: [0, 0, 0], to: [0, 0, 2], radius: 0.5}}}}, mesh: {{size: 0.25}}}}}}
supports: [{{on: post.bottom, fix: [x, y, z], name: ground}}]
loads: {{push: {{on: {{body: post, edge: [top, side]}}, {load}}}}}
"""
        last = self.solve(model.format(load="force: [1, 2, -1000]"))
        self.near(last["reactions"]["ground"], [-1, -2, 1000], 1e3)
        self.near(last["moments"]["ground"], [4, -2, 0], 1e3)  # about its centre at z = 2
        last = self.solve(model.format(load="line_load: [0, 0, -1]"))
        self.assertAlmostEqual(last["reactions"]["ground"][2], math.pi, delta=1e-4 * math.pi)

    def test_edges_of_every_shape(self):
        """A line load of 1 has the length of the edge as its total, and a force of 1 in the middle of the edge has its moments."""
        square = "profile: {rectangle: {corner: [1, 0], size: [2, 2]}}"
        bodies = (("box: {corner: [0, 0, 0], size: [1, 2, 3]}", "bottom", "edge: [top, back]", 1.0, (0.5, 2, 3)),
                  ("tube: {from: [0, 0, 0], to: [0, 0, 2], inner: 0.5, outer: 1}", "bottom", "edge: [top, inside]", math.pi, (0, 0, 2)),
                  ("sphere: {centre: [0, 0, 0], radius: 1, keep: [+z, +x]}", "cut_z", "edge: [surface, cut_x]", math.pi, (0, 0, 2 / math.pi)),
                  (f"extrude: {{{square}, holes: {{gallery: {{circle: {{centre: [2, 1], radius: 0.5}}}}}}, plane: xy, from: 0, to: 1}}", "start", "edge: [end, gallery]", math.pi, (2, 1, 1)),
                  (f"extrude: {{{square}, plane: xy, from: 0, to: 1}}", "start", "edge: [left, top]", 1.0, (1, 2, 0.5)),
                  (f"revolve: {{{square}, plane: xz, axis: {{from: [0, 0], to: [0, 1]}}, angle: 90}}", "bottom", "edge: [start, top]", 2.0, None),
                  ("subtract: {plate: {box: {corner: [0, 0, 0], size: [2, 2, 1]}}, bore: {cylinder: {from: [1, 1, -1], to: [1, 1, 2], radius: 0.5}}}", "plate_bottom",
                   "edge: [plate_top, bore_side]", math.pi, (1, 1, 1)))
        for shape, foot, edge, length, middle in bodies:
            model = f"""materials: {{m: {{young: 1e7, poisson: 0.3}}}}
bodies: {{body: {{material: m, shape: {{{shape}}}, mesh: {{size: 0.25}}}}}}
supports: [{{on: body.{foot}, fix: [x, y, z], name: ground}}]
loads: {{push: {{on: {{body: body, {edge}}}, LOAD}}}}
"""
            (self.directory / "model.yaml").write_text(HEAD + model.replace("LOAD", "line_load: [0, 0, -1]"), encoding="utf-8")
            done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
            if "built without Gmsh's library" in done.stderr:
                continue
            self.assertEqual(done.returncode, 0, done.stderr)
            total = summary_of(self.directory / "results")["increments"][-1]["reactions"]["ground"][2]
            self.assertAlmostEqual(total, length, delta=(1e-9 if length < math.pi else 1e-3) * length, msg=shape)
            last = self.solve(model.replace("LOAD", "force: [0, 0, -1]"))
            self.assertAlmostEqual(last["reactions"]["ground"][2], 1.0, delta=1e-9)
            if middle:
                for found, exact in zip(last["moments"]["ground"], [middle[1], -middle[0], 0]):
                    self.assertAlmostEqual(found, exact, delta=1e-3, msg=shape)

    def test_a_beam_on_two_edges(self):
        """Each edge has half of the weight; the whole load along the edge above it."""
        for kind in ("tetrahedra", "hexahedra"):
            last = self.solve(f"""materials: {{m: {{young: 1e9, poisson: 0.3, density: 100}}}}
bodies: {{beam: {{material: m, shape: {{box: {{corner: [0, 0, 0], size: [4, 1, 0.5]}}}}, mesh: {{size: 0.5, kind: {kind}}}}}}}
supports: [{{on: {{body: beam, edge: [left, bottom]}}, fix: [x, y, z], name: a}}, {{on: {{body: beam, edge: [right, bottom]}}, fix: z, name: b}}]
loads: {{weight: {{gravity: [0, 0, -10]}}, crest: {{on: {{body: beam, edge: [right, top]}}, line_load: [7, 0, -300]}}}}
""")
            weight = 100 * 2 * 10
            right = 0.5 * weight + 300 + 7 * 0.5 / 4
            self.near(last["reactions"]["b"], [0, 0, right], 2e3)
            self.near(last["reactions"]["a"], [-7, 0, weight + 300 - right], 2e3)

    def test_springs_along_edges_and_at_points(self):
        """A stiff block settles by force / (stiffness per length times length); springs at corners share alike."""
        model = """materials: {{m: {{young: 1e15, poisson: 0}}}}
bodies: {{block: {{material: m, shape: {{box: {{corner: [0, 0, 0], size: [2, 3, 1]}}}}, mesh: {{size: 0.5}}}}}}
supports: [{{on: {{body: block, point: [left, front, bottom]}}, fix: [x, y]}}, {{on: {{body: block, point: [right, front, bottom]}}, fix: y}}]
loads: {{press: {{on: block.top, force: [0, 0, -600]}}}}
springs: [{springs}]
output: {{points: [{{at: [1, 1.5, 0.5], name: tip}}]}}
"""
        last = self.solve(model.format(springs="{on: {body: block, edge: [left, bottom]}, k_z: 100, name: a}, {on: {body: block, edge: [right, bottom]}, k_z: 100, name: b}"))
        self.near(last["springs"]["a"], [0, 0, 300], 600)
        self.near(last["springs"]["b"], [0, 0, 300], 600)
        self.assertAlmostEqual(self.point_row()[2], -1.0, delta=1e-9)
        corners = [(x, y) for x in ("left", "right") for y in ("front", "back")]
        last = self.solve(model.format(springs=", ".join(f"{{on: {{body: block, point: [{x}, {y}, bottom]}}, k_z: 100}}" for x, y in corners)))
        for x, y in corners:
            self.near(last["springs"][f"block.{x}/{y}/bottom"], [0, 0, 150], 600)
        self.assertAlmostEqual(self.point_row()[2], -1.5, delta=1e-9)

    def test_a_bar_at_an_edge(self):
        """A plate on a hinge along one edge, hung up at another one: the bar has half of its weight."""
        last = self.solve("""materials: {m: {young: 1e9, poisson: 0.3, density: 100}}
bodies: {plate: {material: m, shape: {box: {corner: [0, 0, 0], size: [4, 1, 0.5]}}, mesh: {size: 0.5}}}
supports: [{on: {body: plate, edge: [left, bottom]}, fix: [x, y, z], name: hinge}]
loads: {weight: {gravity: [0, 0, -10]}}
bars: {hanger: {between: [{body: plate, edge: [right, top]}, [4, 0.5, 3]], k: 1e6}}
""")
        self.assertAlmostEqual(last["bars"]["hanger"]["tension"], 1000, delta=1e-9 * 1e3)
        self.near(last["reactions"]["hinge"], [0, 0, 1000], 1e3)

    def test_the_nearest_of_several(self):
        """Of a face that has two parts one edge or one point is meant; without a point of the edges both are."""
        deck = box((0, 0, 0), SIZE, (2, 2, 2), IDENTITY, 1.0)
        sets = deck.split("*NSET, NSET=")
        ends = "".join(part.split("\n", 1)[1] for part in sets if part.startswith(("LEFT", "RIGHT")))
        (self.directory / "block.inp").write_text(deck + "*NSET, NSET=ENDS\n" + ends, encoding="utf-8")
        model = """materials: {{m: {{young: 1e7, poisson: 0.3}}}}
bodies: {{block: {{material: m, mesh: {{file: block.inp}}}}}}
supports: [{{on: block.BOTTOM, fix: [x, y, z], name: ground}}]
loads: {{push: {{on: {{body: block, {place}}}, {load}}}}}
"""
        last = self.solve(model.format(place="edge: [ENDS, TOP]", load="line_load: [0, 0, -100]"))
        self.near(last["reactions"]["ground"], [0, 0, 200], 200)
        self.near(last["moments"]["ground"], [100, -120, 0], 200)
        last = self.solve(model.format(place="edge: [ENDS, TOP], near: [1, 1, 1]", load="line_load: [0, 0, -100]"))
        self.near(last["moments"]["ground"], [50, -120, 0], 200)
        last = self.solve(model.format(place="point: [ENDS, TOP, FRONT], near: [1, 1, 1]", load="force: [0, 0, -100]"))
        self.near(last["moments"]["ground"], [0, -120, 0], 200)
        for place, why in (("point: [ENDS, TOP, FRONT]", "is 2 points, in all of which these faces meet"), ("edge: [ENDS, LEFT]", "the faces 'block.ENDS' and 'block.LEFT' do not meet")):
            (self.directory / "model.yaml").write_text(HEAD + model.format(place=place, load="force: [0, 0, -100]"), encoding="utf-8")
            done = scabo("check", self.directory / "model.yaml")
            self.assertEqual(done.returncode, 1)
            self.assertIn(why, done.stderr)

    def test_curves_points_and_sets_of_files(self):
        """Physical curves and points of Gmsh; a set of nodes along an edge, also of linear elements."""
        (self.directory / "cube.msh").write_text(CUBE_MSH, encoding="utf-8")
        last = self.solve("""materials: {m: {young: 1e7, poisson: 0.3}}
bodies: {cube: {material: m, mesh: {file: cube.msh}}}
supports: [{on: cube.foot, fix: [x, y, z], name: ground}]
loads: {crest: {on: cube.crest, line_load: [0, 0, -100]}, tip: {on: cube.tip, force: [10, 0, 0]}}
""")
        self.near(last["reactions"]["ground"], [-10, 0, 200], 200)
        self.near(last["moments"]["ground"], [50, -150 - 10, 10], 200)
        deck = box((0, 0, 0), SIZE, (2, 2, 2), IDENTITY, 1.0)
        sets = {part.split("\n", 1)[0]: set(part.split("\n", 1)[1].split()) for part in deck.split("*NSET, NSET=")[1:]}
        edge = "\n".join(sorted(sets["RIGHT"] & sets["TOP"]))
        (self.directory / "block.inp").write_text(deck + f"*NSET, NSET=EDGE\n{edge}\n", encoding="utf-8")
        for load in ("line_load: [0, 0, -100]", "force: [0, 0, -100]"):
            last = self.solve(f"""materials: {{m: {{young: 1e7, poisson: 0.3}}}}
bodies: {{block: {{material: m, mesh: {{file: block.inp}}}}}}
supports: [{{on: block.BOTTOM, fix: [x, y, z], name: ground}}]
loads: {{push: {{on: block.EDGE, {load}}}}}
""")
            self.near(last["reactions"]["ground"], [0, 0, 100], 100)
            self.near(last["moments"]["ground"], [50, -120, 0], 100)

    def test_loads_on_sets_that_do_not_suit_them(self):
        """A set along an edge has no side through which a force could act at a point, and one with sides is no edge; each is said at its place."""
        deck = box((0, 0, 0), SIZE, (2, 2, 2), IDENTITY, 1.0)
        sets = {part.split("\n", 1)[0]: part.split("\n", 1)[1].split() for part in deck.split("*NSET, NSET=")[1:]}
        edge = "\n".join(node for node in sets["RIGHT"] if node in sets["TOP"])
        (self.directory / "block.inp").write_text(deck + f"*NSET, NSET=EDGE\n{edge}\n", encoding="utf-8")
        for place, load, words in (("EDGE", "force: [0, 0, -100], at: [0.6, 0.5, 0.8]", "'block.EDGE' .*'at'"),
                                   ("TOP", "line_load: [0, 0, -100]", "'block.TOP' .*'line_load'"),
                                   ("TOP", 'line_load: {formula: [null, null, "-x"]}', "'block.TOP' .*'line_load'")):
            (self.directory / "model.yaml").write_text(HEAD + f"""materials: {{m: {{young: 1e7, poisson: 0.3}}}}
bodies: {{block: {{material: m, mesh: {{file: block.inp}}}}}}
supports: [{{on: block.BOTTOM, fix: [x, y, z], name: ground}}]
loads: {{push: {{on: block.{place}, {load}}}}}
""", encoding="utf-8")
            for command in ("check", "run"):
                with self.subTest(place=place, load=load, command=command):
                    done = scabo(command, self.directory / "model.yaml")
                    self.assertEqual(done.returncode, 1)
                    self.assertRegex(done.stderr, rf"model.yaml:6:\d+: loads.push(\.\w+)?: .*{words}")

    def test_a_support_along_an_edge_that_ends(self):
        """A prop under the end of a cantilever has its share of the load, and nothing once it is gone."""
        model = """materials: {m: {young: 1e9, poisson: 0}}
bodies: {beam: {material: m, shape: {box: {corner: [0, 0, 0], size: [5, 0.5, 0.5]}}, mesh: {size: 0.5}}}
supports: [{on: beam.left, fix: [x, y, z], name: wall}, {on: {body: beam, edge: [right, bottom]}, fix: z, removed: strike, name: prop}]
loads: {push: {on: beam.top, pressure: 1e3}}
steps: [{name: load}, {name: strike, loads: {}}]
"""
        self.solve(model)
        first, last = summary_of(self.directory / "results")["increments"]
        self.assertAlmostEqual(first["reactions"]["prop"][2], 3 / 8 * 2500, delta=0.02 * 2500)
        self.near([a + b for a, b in zip(first["reactions"]["prop"], first["reactions"]["wall"])], [0, 0, 2500], 2500)
        self.near(last["reactions"]["wall"], [0, 0, 2500], 2500)
        self.near(last["moments"]["wall"][1:2], [-2500 * 2.5], 2500 * 2.5)


if __name__ == "__main__":
    support.main()
