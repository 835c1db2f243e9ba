"""A model in space with everything in it, bolt, friction, ties, temperature, springs and a rigid body, in several ways: in other units, turned, mirrored,
sides swapped, nodes and corners of elements in another order, bodies too. The same to 1e-9."""
import math
import random
import unittest

import support
from solid_twins_test import IDENTITY, product, rotation, text_of
from solids import HEAD, bodies_of
from support import scabo, summary_of

TOLERANCE = 1e-9
SHAPES = {"base": ("box: {corner: [-0.04, -0.03, -0.02], size: [0.08, 0.06, 0.02]}", 0.02), "ring": ("tube: {from: [0, 0, 0], to: [0, 0, 0.03], inner: 9e-3, outer: 20e-3}", 0.012),
          "bolt": ("cylinder: {from: [0, 0, 0], to: [0, 0, 0.03], radius: 8e-3}", 8e-3), "head": ("cylinder: {from: [0, 0, 0.03], to: [0, 0, 0.04], radius: 13e-3}", 0.01)}
SETS = {"BELOW": min, "ABOVE": max}  # of the heights
MIRROR = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def determinant(m):
    return sum(m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3]) for i in range(3))


@unittest.skipIf(support.SANITIZED, "numbers")
class TwinsOfEverything(support.InTemporaryDirectory):
    def run_model(self, text):
        (self.directory / "model.yaml").write_text(HEAD + text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return summary_of(self.directory / "results")["increments"]

    def meshes(self):
        """Nodes and tetrahedra of every body."""
        bodies = "\n".join(f"  {name}: {{material: m, shape: {{{shape}}}, mesh: {{size: {size}}}}}" for name, (shape, size) in SHAPES.items())
        self.run_model(f"materials: {{m: {{young: 1e9, poisson: 0.2, density: 1}}}}\nbodies:\n{bodies}\nloads: {{none: {{gravity: [0, 0, 0]}}}}\n")
        return dict(zip(SHAPES, bodies_of(self.directory / "results" / "fields_0001.vtu", len(SHAPES))))

    def write(self, name, mesh, turn, scale, renumber, corners):
        nodes, cells = mesh
        order, cell_order = list(range(len(nodes))), list(range(len(cells)))
        if renumber:
            dice = random.Random(renumber)
            dice.shuffle(order)
            dice.shuffle(cell_order)
        number = {node: k + 1 for k, node in enumerate(order)}
        ordered = (0, 2, 1, 3, 6, 5, 4, 7, 9, 8) if determinant(turn) < 0 else (1, 2, 0, 3, 5, 6, 4, 8, 9, 7) if corners else range(10)  # seen in a mirror
        lines = ["*NODE", *(f"{number[i]}, " + ", ".join(f"{scale * x!r}" for x in product(turn, nodes[i])) for i in order), "*ELEMENT, TYPE=C3D10, ELSET=ALL",
                 *(f"{k + 1}, " + ", ".join(str(number[cells[c][j]]) for j in ordered) for k, c in enumerate(cell_order))]
        for set_name, of in SETS.items():
            height = of(node[2] for node in nodes)
            lines += [f"*NSET, NSET={set_name}", *(f"{number[i]}," for i, node in enumerate(nodes) if abs(node[2] - height) < 1e-9)]
        (self.directory / f"{name}.inp").write_text("\n".join(lines) + "\n", encoding="utf-8")

    def solve(self, meshes, turn=None, scale=1.0, swap=False, reverse=False, renumber=0, corners=False):
        """Of every increment what is told of it, in the axes and units of the original: forces in N, lengths so that they are alike; and states."""
        turn = turn or IDENTITY
        for name, mesh in meshes.items():
            self.write(name, mesh, turn, scale, renumber, corners)
        vector = lambda v, factor=1.0: text_of([factor * x for x in product(turn, v)])
        hand, stress = determinant(turn), scale**-2
        slope = [g / scale for g in product(turn, [100.0, -40.0, 30.0])]
        bodies = ["  base: {material: alu, mesh: {file: base.inp}}", "  ring: {material: steel, mesh: {file: ring.inp}}",
                  f"  bolt: {{material: steel, mesh: {{file: bolt.inp}}, preload: {{cut: {{point: {vector([0, 0, 0.015], scale)}, normal: {vector([0, 0, 1])}}}, force: 30e3}}}}",
                  f"  head: {{rigid: true, density: {7850 * scale**-3!r}, mesh: {{file: head.inp}}}}"]
        between = lambda a, b: f"[{b}, {a}]" if swap else f"[{a}, {b}]"
        about = f", about: {vector([0.01, 0.02, 0.0], scale)}"
        increments = self.run_model(f"""materials:
  steel: {{young: {210e9 * stress!r}, poisson: 0.3, density: {7850 * scale**-3!r}, expansion: 12e-6}}
  alu: {{young: {70e9 * stress!r}, poisson: 0.33, density: {2700 * scale**-3!r}}}
bodies:
{chr(10).join(reversed(bodies) if reverse else bodies)}
supports: [{{on: base.BELOW, fix: [x, y, z], name: ground}}]
springs:
  - {{on: head, k_x: {1e7 / scale!r}, k_y: {1e7 / scale!r}, k_z: {1e7 / scale!r}, name: spring}}
loads:
  push: {{on: head, force: {vector([3500, 1200, 0])}}}
  twist: {{on: head, moment: {vector([10, 20, 25], scale * hand)}}}
  weight: {{gravity: {vector([0, 0.3, -9.81])}}}
  heat: {{on: ring, temperature: {{constant: 20, x: {slope[0]!r}, y: {slope[1]!r}, z: {slope[2]!r}}}}}
contacts:
  under_head: {{between: {between("ring.ABOVE", "head.BELOW")}, friction: 0.2{about}}}
  under_ring: {{between: {between("base.ABOVE", "ring.BELOW")}, friction: 0.15{about}}}
ties:
  to_head: {{between: {between("bolt.ABOVE", "head.BELOW")}}}
  to_base: {{between: {between("bolt.BELOW", "base.ABOVE")}}}
steps:
  - {{name: tighten, loads: {{push: 0, twist: 0, weight: 1, heat: 0}}}}
  - {{name: heat, increments: 2, loads: {{heat: 1}}}}
  - {{name: push, increments: 3, loads: {{push: 1, twist: 1}}}}
""")
        back, sense, told, states = list(zip(*turn)), -1.0 if swap else 1.0, [], []
        for increment in increments:
            for name in ("under_head", "under_ring", "to_head", "to_base"):
                joint = increment["contacts"][name]
                told += [sense * x for kind in ("normal_force", "tangential_force") for x in product(back, joint[kind])]
                told += [joint["max_pressure"] / stress * 1e-4]
                if name.startswith("under"):
                    told += [sense * hand * x / scale * 1e2 for x in product(back, joint["moment"])]
                    states.append([joint[state] for state in ("open", "stick", "slip")])
            told += [*product(back, increment["reactions"]["ground"]), *(hand * x / scale * 1e2 for x in product(back, increment["moments"]["ground"]))]
            told += [increment["energy"][kind] / scale * 1e3 for kind in ("external", "elastic", "friction")]
            told += [increment["preloads"]["bolt"]["force"], increment["preloads"]["bolt"]["shortening"] / scale * 1e9]
        return told, states

    def test_twins(self):
        meshes = self.meshes()
        one, states = self.solve(meshes)
        size = max(map(abs, one))
        self.assertTrue(any(of[1] and of[2] for of in states) and any(of[0] for of in states), states)
        turned = rotation(7)
        ways = {"kilometres": {"scale": 1e-3}, "micrometres": {"scale": 1e6}, "turned": {"turn": turned}, "mirrored": {"turn": MIRROR}, "sides swapped": {"swap": True},
                "bodies reversed": {"reverse": True}, "renumbered": {"renumber": 1}, "corners of elements in another order": {"corners": True},
                "all": {"turn": times(turned, MIRROR), "scale": 1e6, "swap": True, "reverse": True, "renumber": 2}}
        for way, how in ways.items():
            with self.subTest(way=way):
                other, other_states = self.solve(meshes, **how)
                difference = max(abs(a - b) for a, b in zip(one, other)) / size
                self.assertLess(difference, TOLERANCE)
                self.assertEqual(states, other_states)


if __name__ == "__main__":
    support.main()
