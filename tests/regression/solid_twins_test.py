"""One model in space in several ways: in other units, turned, sides and bodies swapped, nodes renumbered, bodies listed in another order. The mesh is
that of the shape, exported once, as a turned shape may be divided otherwise."""
import math
import random
import unittest

import support
from solids import HEAD, bodies_of
from support import scabo, summary_of

YOUNG, FRICTION = 10e9, 0.3
TOLERANCE = 1e-9
BASE = {"shape": "box: {corner: [0, 0, -0.4], size: [2, 1.6, 0.4]}", "size": 0.5}
# What stands on the base.
BLOCK = "extrude: {profile: {polygon: {vertices: [[0.4, 0.3], [1.3, 0.4], [1.1, 0.9], [0.6, 1.2]]}}, plane: xy, from: 0, to: 0.5}"
PARTS = {
    "extrude": {"shape": BLOCK, "size": 0.35},
    "tube": {"shape": "tube: {from: [0.9, 0.8, 0], to: [0.9, 0.8, 0.5], inner: 0.2, outer: 0.4}", "size": 0.25},
    "sphere": {"shape": "sphere: {centre: [0.9, 0.8, 0.5], radius: 0.5, keep: [-z]}", "size": 0.2},
    "rigid": {"shape": "box: {corner: [0.55, 0.45, 0], size: [0.7, 0.8, 0.3]}", "size": 0.35, "rigid": True},
    "bolt": {"shape": "cylinder: {from: [0.9, 0.8, 0], to: [0.9, 0.8, 0.5], radius: 0.3}", "size": 0.25, "preload": True},
    "subtract": {"shape": """subtract:
        block: {box: {corner: [0.5, 0.4, 0], size: [0.8, 0.8, 0.5]}}
        bore: {cylinder: {from: [0.9, 0.8, -1], to: [0.9, 0.8, 1], radius: 0.2}}""", "size": 0.3},
    "revolve": {"shape": "revolve: {profile: {polygon: {vertices: [[0.3, 0], [0.7, 0], [0.5, 0.5], [0.3, 0.5]]}}, plane: xz, axis: {from: [0, 0], to: [0, 1]}, angle: 120}",
                "size": 0.3},
}


def rotation(seed):
    """A random one, rows of a matrix."""
    dice = random.Random(seed)
    a, b, c, d = (dice.gauss(0, 1) for _ in range(4))
    n = math.sqrt(a * a + b * b + c * c + d * d)
    a, b, c, d = a / n, b / n, c / n, d / n
    return [[a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)], [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d]]


IDENTITY = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]


def product(matrix, vector):
    return [sum(matrix[i][k] * vector[k] for k in range(3)) for i in range(3)]


def text_of(vector):
    return "[" + ", ".join(f"{x!r}" for x in vector) + "]"


@unittest.skipIf(support.SANITIZED, "numbers")
class Twins(support.InTemporaryDirectory):
    def run_model(self, text):
        (self.directory / "model.yaml").write_text(HEAD + text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        if "built without Gmsh's library" in done.stderr:
            return None
        self.assertEqual(done.returncode, 0, done.stderr)
        return summary_of(self.directory / "results")["increments"][-1]

    def meshes_of(self, part):
        """Nodes and tetrahedra of base and part, exported from a run of the shapes; None without the library that some need."""
        made = self.run_model(f"""materials: {{m: {{young: {YOUNG}, poisson: 0.2, density: 1}}}}
bodies:
  base: {{material: m, shape: {{{BASE["shape"]}}}, mesh: {{size: {BASE["size"]}}}}}
  part:
    material: m
    mesh: {{size: {part["size"]}}}
    shape:
      {part["shape"]}
loads: {{heat: {{gravity: [0, 0, 0]}}}}
""")
        if made is None:
            return None
        return bodies_of(self.directory / "results" / "fields_0001.vtu", 2)

    def write_mesh(self, name, mesh, sets, turn, scale, renumber):
        nodes, cells = mesh
        order, cell_order = list(range(len(nodes))), list(range(len(cells)))
        if renumber:
            dice = random.Random(renumber)
            dice.shuffle(order)
            dice.shuffle(cell_order)
        number = {node: k + 1 for k, node in enumerate(order)}
        lines = ["*NODE", *(f"{number[i]}, " + ", ".join(f"{scale * x!r}" for x in product(turn, nodes[i])) for i in order), "*ELEMENT, TYPE=C3D10, ELSET=ALL",
                 *(f"{k + 1}, " + ", ".join(str(number[node]) for node in cells[c]) for k, c in enumerate(cell_order))]
        for set_name, members in sets.items():
            lines += [f"*NSET, NSET={set_name}", *(f"{number[i]}," for i in members)]
        (self.directory / f"{name}.inp").write_text("\n".join(lines) + "\n", encoding="utf-8")

    def solve(self, meshes, part, turn=None, scale=1.0, swap=False, reverse=False, renumber=0, rename=False):
        """Resultants in the axes of the original and its units."""
        turn = turn or IDENTITY
        sphere = "sphere" in part["shape"]
        for name, mesh, sets in (("base", meshes[0], {"BOTTOM": lambda p: abs(p[2] + 0.4) < 1e-9, "TOP": lambda p: abs(p[2]) < 1e-9}),
                                 ("part", meshes[1], {"FOOT": (lambda p: abs(math.dist(p, (0.9, 0.8, 0.5)) - 0.5) < 1e-6) if sphere else (lambda p: abs(p[2]) < 1e-9),
                                                      "HEAD": lambda p: abs(p[2] - 0.5) < 1e-9})):
            chosen = {key: [i for i, point in enumerate(mesh[0]) if inside(point)] for key, inside in sets.items()}
            self.write_mesh(name, mesh, {key: nodes for key, nodes in chosen.items() if nodes}, turn, scale, renumber)
        base, other = ("zebra", "ant") if rename else ("base", "part")
        stress = scale**-2  # force stays the same number
        preload = f", preload: {{cut: {{point: {text_of([scale * x for x in product(turn, [0.9, 0.8, 0.25])])}, normal: {text_of(product(turn, [0, 0, 1]))}}}, force: 2e4}}"
        kind = "rigid: true, density: " + repr(2000 * scale**-3) if part.get("rigid") else "material: m"
        bodies = [f"  {base}: {{material: m, mesh: {{file: base.inp}}}}", f"  {other}: {{{kind}, mesh: {{file: part.inp}}{preload if part.get('preload') else ''}}}"]
        load = f"{{on: {other}, force: {text_of(product(turn, [1e3, 5e2, -9e3]))}}}" if part.get("rigid") else \
            f"{{on: {other}.HEAD, traction: {text_of([stress * x for x in product(turn, [4e3, 2e3, -3e4])])}}}"
        sides = [f"{base}.TOP", f"{other}.FOOT"]
        between = ", ".join(reversed(sides) if swap else sides)
        joint = f"contacts: {{joint: {{between: [{between}], friction: {FRICTION}, about: {text_of([scale * x for x in product(turn, [1.0, 1.0, 0.0])])}}}}}"
        held = ""
        if part.get("preload"):  # between what holds it
            joint, held = f"ties: {{joint: {{between: [{between}]}}}}", f", {{on: {other}.HEAD, fix: [x, y, z]}}"
        increment = self.run_model(f"""materials: {{m: {{young: {YOUNG * stress!r}, poisson: 0.2, density: {2000 * scale**-3!r}}}}}
bodies:
{chr(10).join(reversed(bodies) if reverse else bodies)}
supports: [{{on: {base}.BOTTOM, displacement: [0, 0, 0], name: ground}}{held}]
loads:
  push: {load}
  weight: {{gravity: {text_of(product(turn, [0.3, 0.2, -9.81]))}}}
{joint}
""")
        joint, back = increment["contacts"]["joint"], list(zip(*turn))
        sense = -1.0 if swap else 1.0
        forces = [sense * x for name in ("normal_force", "tangential_force") for x in product(back, joint[name])]
        forces += [sense * x / scale for x in product(back, joint["moment"])] + product(back, increment["reactions"]["ground"])
        forces += [x / scale for x in product(back, increment["moments"]["ground"])]
        forces += [increment["energy"]["external"] / scale * 1e4, increment["energy"]["elastic"] / scale * 1e4, joint["max_pressure"] / stress]
        if part.get("preload"):
            forces += [increment["preloads"][other]["force"], increment["preloads"][other]["shortening"] / scale * 1e7]
        return forces, [joint[state] for state in ("open", "stick", "slip")]

    def test_twins(self):
        turned = [rotation(seed) for seed in (1, 2)]
        ways = {"millimetres": {"scale": 1e3}, "kilometres": {"scale": 1e-3}, "turned": {"turn": turned[0]}, "turned, millimetres": {"turn": turned[1], "scale": 1e3}, "sides swapped": {"swap": True},
                "bodies reversed": {"reverse": True}, "both": {"swap": True, "reverse": True, "rename": True}, "renumbered": {"renumber": 1},
                "all": {"turn": turned[1], "scale": 1e3, "swap": True, "reverse": True, "renumber": 2, "rename": True}}
        for name, part in PARTS.items():
            meshes = self.meshes_of(part)
            if meshes is None:
                continue
            one, states = self.solve(meshes, part)
            size = max(map(abs, one))
            self.assertGreaterEqual(states[1] + states[2], 3, name)
            for way, how in ways.items():
                with self.subTest(part=name, way=way):
                    other, other_states = self.solve(meshes, part, **how)
                    self.assertLess(max(abs(a - b) for a, b in zip(one, other)) / size, TOLERANCE)
                    self.assertEqual(states, other_states)


if __name__ == "__main__":
    support.main()
