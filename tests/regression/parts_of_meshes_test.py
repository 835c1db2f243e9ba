"""Bodies from a mesh of several parts: which are joined, which become bodies of their own, and what is said about it."""
import math

import support
from support import scabo, summary_of


def squares(*corners, size=1.0, region="stone", divided=2):
    """An .inp mesh of squares with nodes of their own, each of `divided` by `divided` cells."""
    nodes, elements = [], []
    for x, y in corners:
        first = len(nodes) + 1
        for j in range(divided + 1):
            for i in range(divided + 1):
                nodes.append(f"{len(nodes) + 1}, {x + size * i / divided!r}, {y + size * j / divided!r}")
        for j in range(divided):
            for i in range(divided):
                at = first + j * (divided + 1) + i
                elements.append(f"{len(elements) + 1}, {at}, {at + 1}, {at + divided + 2}, {at + divided + 1}")
    return "*NODE\n" + "\n".join(nodes) + f"\n*ELEMENT, TYPE=CPS4, ELSET={region}\n" + "\n".join(elements) + "\n"


MODEL = """scabo: 1
materials: {stone: {young: 1e9, poisson: 0.0, density: 2000}}
bodies:
  wall: {material: stone, mesh: {file: wall.inp, elements: fem}EXTRA}
"""


class PartsOfMeshes(support.InTemporaryDirectory):
    def run_model(self, mesh, rest, extra="", command="run"):
        (self.directory / "wall.inp").write_text(mesh)
        (self.directory / "model.yaml").write_text(MODEL.replace("EXTRA", extra) + rest)
        return scabo(command, "model.yaml", *(["--quiet"] if command == "run" else []), cwd=self.directory)

    def increment(self):
        return summary_of(self.directory / "model.results")["increments"][-1]

    def test_patches_are_joined_with_a_word(self):
        """A column of two patches of 1 m under tension: u = s h / E, as if it had one mesh."""
        pull = "supports: [{on: wall.edge_1, fix: [x, y]}]\nloads: {pull: {on: wall.edge_3, traction: [0, 1e6]}}\n"
        run = self.run_model(squares((0, 0), (0, 1)), pull + "output: {points: [{at: [0.5, 2], name: top}], history: {u: top.uy}}\n")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("3 nodes of 'wall.inp' that lie in the place of others are joined to them", run.stderr)
        with open(self.directory / "model.results" / "history.csv", encoding="utf-8") as file:
            head, *rows = [line.strip().split(",") for line in file]
        self.assertAlmostEqual(float(rows[-1][head.index("u")]), 1e6 * 2 / 1e9, delta=1e-12)

    STACK = "supports: [{on: wall_1.edge_1, fix: [x, y]}]\nloads: {weight: {gravity: [0, -10]}}\ncontacts: "

    def test_parts_that_a_contact_names_stay_apart(self):
        for contacts in ("{joint: {between: [wall_1.edge_3, wall_2.edge_1], friction: 0.5}}", "{joint: {between: [wall_1, wall_2], friction: 0.5}}",
                         "{joint: {between: all, friction: 0.5}}"):
            with self.subTest(contacts=contacts):
                run = self.run_model(squares((0, 0), (0, 1)), self.STACK + contacts + "\n")
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertNotIn("joined", run.stderr)
                self.assertIn("become bodies of their own: wall_1 at (0.5, 0.5), wall_2 at (0.5, 1.5)", run.stderr)
                (contact,) = self.increment()["contacts"].values()
                self.assertAlmostEqual(contact["normal_force"], 2000 * 10, delta=1e-6)

    def test_parts_that_a_tie_names_stay_apart(self):
        run = self.run_model(squares((0, 0), (0, 1)), self.STACK.replace("contacts: ", "") + "ties: {joint: {between: [wall_1.edge_3, wall_2.edge_1]}}\n")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotIn("joined to them", run.stderr)
        self.assertAlmostEqual(self.increment()["reactions"]["wall_1.edge_1"][1], 2 * 2000 * 10, delta=1e-6)

    def test_parts_that_are_apart_are_bodies(self):
        held = "supports: [{on: wall_1.edge_1, fix: [x, y]}, {on: wall_2.edge_1, fix: [x, y]}]\nloads: {weight: {gravity: [0, -10]}}\n"
        run = self.run_model(squares((0, 0), (3, 0)), held)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("its cells have 2 parts that have no side in common", run.stderr)
        self.assertEqual(len(self.increment()["reactions"]), 2)

    def test_what_is_of_one_body(self):
        for extra, word in ((", cracks: [{path: [[0, 1], [1, 1]]}]", "cracks"), (", repeat: {count: 2, step: [9, 0]}", "repeat")):
            run = self.run_model(squares((0, 0), (0, 1), (5, 5)), "loads: {weight: {gravity: [0, -10]}}\n", extra, "check")
            self.assertEqual(run.returncode, 1)
            self.assertIn(f"bodies.wall.{word}: the cells of this body have", run.stderr)

    def test_two_bodies_are_never_joined(self):
        """Two regions with equal nodes, a body each: what lies on top of the other is held by nothing."""
        second = squares((0, 1), region="upper").replace("*NODE\n", "").split("*ELEMENT")
        offset = lambda text, by: "\n".join(", ".join([str(int(word) + by) if place in which else word for place, word in enumerate(line.split(", "))])
                                           for line in text.strip().splitlines())
        which = {0}
        nodes = offset(second[0], 100)
        which = {0, 1, 2, 3, 4}
        head, _, elements = second[1].partition("\n")
        mesh = squares((0, 0), region="lower") + "*NODE\n" + nodes + "\n*ELEMENT" + head + "\n" + offset(elements, 100) + "\n"
        (self.directory / "wall.inp").write_text(mesh)
        (self.directory / "model.yaml").write_text(MODEL.replace("  wall: {material: stone, mesh: {file: wall.inp, elements: fem}EXTRA}\n", "".join(
            f"  {name}: {{material: stone, mesh: {{file: wall.inp, region: {name}, elements: fem}}}}\n" for name in ("lower", "upper")))
            + "supports: [{on: lower.edge_1, fix: [x, y]}]\nloads: {weight: {gravity: [0, -10]}}\n")
        run = scabo("run", "model.yaml", "--quiet", cwd=self.directory)
        self.assertEqual(run.returncode, 1)
        self.assertNotIn("joined to them", run.stderr)
        self.assertIn("upper", run.stderr)


def disc(sides):
    """A mesh of Gmsh of triangles: radius .5 about (2, 1.5), its rim one curve."""
    layers = sides // 6
    points = [(2.0, 1.5)]
    for k in range(1, layers + 1):
        angles = [2 * math.pi * i / sides for i in range(sides)]
        points += [(2 + 0.5 * k / layers * math.sin(a), 1.5 - 0.5 * k / layers * math.cos(a)) for a in angles]
    node = lambda k, i: 2 + (k - 1) * sides + i % sides
    cells = [(1, node(layers, i), node(layers, i + 1)) for i in range(sides)]
    for i in range(sides):
        cells.append((2, 1, node(1, i), node(1, i + 1)))
        for k in range(1, layers):
            cells += [(2, node(k, i), node(k + 1, i), node(k + 1, i + 1)), (2, node(k, i), node(k + 1, i + 1), node(k, i + 1))]
    group = {1: "1 2 5 1", 2: "2 2 2 2"}
    return "\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '1 5 "rim"', '2 2 "roller"', "$EndPhysicalNames",
                      "$Nodes", str(len(points)), *(f"{i} {x!r} {y!r} 0" for i, (x, y) in enumerate(points, 1)), "$EndNodes",
                      "$Elements", str(len(cells)), *(f"{i} {group[kind]} {' '.join(map(str, at))}" for i, (kind, *at) in enumerate(cells, 1)),
                      "$EndElements", ""])


ROLLER = """scabo: 1
analysis: {plane: strain}
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies:
  plate: {material: steel, shape: {rectangle: {corner: [0, 0], size: [4, 1]}}, mesh: {size: SIZE}}
  roller: {material: steel, BODY}
supports:
  - {on: plate.bottom, fix: [x, y]}
  - {on: {body: roller, near: [2, 2]}, displacement: [0, -1e-4], name: press}
contacts: {c: {between: [plate.top, roller.rim], friction: 0.3}}
"""


class ClosedCurves(support.InTemporaryDirectory):
    def flexibility(self, body, size):
        (self.directory / "model.yaml").write_text(ROLLER.replace("BODY", body).replace("SIZE", str(size)))
        run = scabo("run", "model.yaml", "--quiet", cwd=self.directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("support 'press' moves a single point of body 'roller': its force depends on the mesh", run.stderr)
        contact = summary_of(self.directory / "model.results")["increments"][-1]["contacts"]["c"]
        return 1e-4 / contact["normal_force"]

    def test_a_disc_that_a_point_presses_on_a_plate(self):
        """In three points, one of them of the plate, a force acts on a single node, which gives way by 2 (1 - nu^2) / (pi E) log(1 / h)
        more on a finer mesh: no mesh gives the force. It depends on the mesh of a file as on that of a circle."""
        more = 3 * 2 * (1 - 0.3**2) / (math.pi * 210e9) * math.log(2)
        for sides in (32, 64):
            (self.directory / f"{sides}.msh").write_text(disc(sides))
        circle = "shape: {circle: {centre: [2, 1.5], radius: 0.5}}, mesh: {size: SIZE}"
        for coarse, fine, size in ((circle, circle, 0.2), ("mesh: {file: 32.msh}", "mesh: {file: 64.msh}", 0.1)):
            softer = self.flexibility(fine, size / 2) - self.flexibility(coarse, size)
            self.assertAlmostEqual(softer, more, delta=0.12 * more, msg=coarse)


if __name__ == "__main__":
    support.main()
