"""Half spaces against closed forms: forces at a point of the surface, a rigid punch, a disc that turns. What is cut off far away moves as the closed
form says."""
import math
import unittest

import support
from solids import Solving, shell

YOUNG, POISSON = 1.0, 0.3
SHEAR = YOUNG / (2 * (1 + POISSON))
R = "sqrt(x^2 + y^2 + z^2)"


def scaled(factor, *formulas):
    """Formulas of a model file, quoted, times a number."""
    return ", ".join("null" if formula is None else f'"{factor:.17g} * ({formula})"' for formula in formulas)


def boussinesq():
    """Displacement, and traction on a sphere around the origin against its outward normal, of a unit force along z, which points into the body."""
    part = (1 + POISSON) / (2 * math.pi * YOUNG)
    along = [f"{x} * z / {R}^3 - {1 - 2 * POISSON} * {x} / ({R} * ({R} + z))" for x in "xy"]
    traction = [f"{x} / {R} * (3 * z / {R}^3 - {1 - 2 * POISSON} / ({R} * ({R} + z)))" for x in "xy"]
    return (scaled(part, *along, f"z^2 / {R}^3 + {2 * (1 - POISSON)} / {R}"),
            scaled(1 / (2 * math.pi), *traction, f"3 * z^2 / {R}^4"))


def cerruti():
    """The same of a unit force along x."""
    part, c, S = (1 + POISSON) / (2 * math.pi * YOUNG), 1 - 2 * POISSON, f"({R} + z)"
    moved = (f"1 / {R} + x^2 / {R}^3 + {c} * (1 / {S} - x^2 / ({R} * {S}^2))", f"x * y / {R}^3 - {c} * x * y / ({R} * {S}^2)",
             f"x * z / {R}^3 + {c} * x / ({R} * {S})")
    xx = f"x / {R}^3 - 3 * x / ({R} * {S}^2) + x^3 / ({R}^3 * {S}^2) + 2 * x^3 / ({R}^2 * {S}^3)"
    yy = f"x / {R}^3 - x / ({R} * {S}^2) + x * y^2 / ({R}^3 * {S}^2) + 2 * x * y^2 / ({R}^2 * {S}^3)"
    xy = f"x^2 * y / ({R}^3 * {S}^2) + 2 * x^2 * y / ({R}^2 * {S}^3) - y / ({R} * {S}^2)"
    traction = (f"3 * x^2 / {R}^4 - {c} / {R} * (({xx}) * x + ({xy}) * y)", f"3 * x * y / {R}^4 - {c} / {R} * (({xy}) * x + ({yy}) * y)",
                f"3 * x * z / {R}^4")
    return scaled(part, *moved), scaled(1 / (2 * math.pi), *traction)


class HalfSpace(Solving):
    def solve(self, text):
        return super().solve(f"materials: {{m: {{young: {YOUNG}, poisson: {POISSON}}}}}\n" + text)

    def assert_falls(self, errors, bound, order):
        """Errors of meshes whose elements are halved."""
        self.assertLess(errors[-1], bound, errors)
        self.assertLess(errors[-1], errors[0] / 2**(order * (len(errors) - 1)), errors)


@unittest.skipIf(support.SANITIZED, "numbers")
class ForcesAtAPoint(HalfSpace):
    """An octant of the half space between two spheres around the force: its tractions act on the inner one, and the outer one moves as it should."""

    def octant(self, fields, held, points, angular):
        (self.directory / "shell.inp").write_text(shell(inner=0.5, outer=2.0, angular=angular, layers=angular, growth=4**(1 / angular)), encoding="utf-8")
        moved, traction = fields
        increment, values = self.solve(f"""bodies: {{ground: {{material: m, mesh: {{file: shell.inp}}}}}}
supports:
  - {{on: ground.OUT, displacement: {{formula: [{moved}]}}, name: far}}
{held}loads: {{force: {{on: ground.IN, traction: {{formula: [{traction}]}}}}}}
output: {{points: [{", ".join(f"{{at: {list(at)}, name: {name}}}" for name, at in points.items())}]}}
""")
        return increment, values

    def test_boussinesq(self):
        held = "  - {on: ground.X, fix: x}\n  - {on: ground.Y, fix: y}\n"
        moved, stressed, balance = [], [], []
        for angular in (4, 8):
            increment, values = self.octant(boussinesq(), held, {"surface": (1, 0, 0), "axis": (0, 0, 1)}, angular)
            moved.append(max(abs(values["surface"]["uz"] / 0.289662 - 1), abs(values["axis"]["uz"] / 0.496563 - 1)))
            stressed.append(abs(values["axis"]["stress_zz"] / -0.477465 - 1))
            balance.append(abs(4 * increment["reactions"]["far"][2] + 1))
        self.assert_falls(moved, 1e-3, 2.5)
        self.assert_falls(stressed, 3e-2, 1.8)
        self.assert_falls(balance, 2e-5, 3.5)

    def test_cerruti(self):
        held = "  - {on: ground.X, fix: [y, z]}\n  - {on: ground.Y, fix: y}\n"
        moved = []
        for angular in (4, 8):
            increment, values = self.octant(cerruti(), held, {"x": (1, 0, 0), "y": (0, 1, 0)}, angular)
            moved.append(max(abs(values["x"]["ux"] / 0.413803 - 1), abs(values["y"]["ux"] / 0.289662 - 1), abs(values["x"]["uz"] / 0.0827606 - 1)))
        self.assert_falls(moved, 1e-3, 1.8)


@unittest.skipIf(support.SANITIZED, "numbers")
class RigidDisc(HalfSpace):
    """A rigid disc of radius 1 on a quarter of a block of 6 x 6 x 6, which is a half space: its outer faces move as by a force, or moment, at a point."""
    DEPTH = 6.0

    def on_disc(self, size, far, held, disc, joint):
        near = ", ".join(f"{{near: [{math.cos(angle):.6f}, {math.sin(angle):.6f}, 0], size: {size}, growth: 0.3}}" for angle in (0, math.pi / 4, math.pi / 2))
        return self.solve(f"""bodies:
  ground: {{material: m, shape: {{box: {{corner: [0, 0, {-self.DEPTH}], size: [{self.DEPTH}, {self.DEPTH}, {self.DEPTH}]}}}}, mesh: {{size: 2, refine: [{near}]}}}}
  disc: {{rigid: true, shape: {{cylinder: {{from: [0, 0, 0], to: [0, 0, 1], radius: 1}}}}, mesh: {{size: 0.25}}}}
supports:
  - {{on: ground.right, displacement: {{formula: [{far}]}}}}
  - {{on: ground.back, displacement: {{formula: [{far}]}}}}
  - {{on: ground.bottom, displacement: {{formula: [{far}]}}}}
{held}{disc}{joint}""")[0]

    def test_smooth_punch(self):
        depth = 1e-3
        force = 2 * YOUNG / (1 - POISSON**2) * depth
        moved, _ = boussinesq()
        far = ", ".join(f'"{sign * force:.17g} * ({one})"' for sign, one in zip((1, 1, -1), moved.replace("z", "(-z)").replace('"', "").split(", ")))
        errors = []
        for size in (0.4, 0.2):
            increment = self.on_disc(size, far, "  - {on: ground.left, fix: x}\n  - {on: ground.front, fix: y}\n",
                                     f"  - {{on: disc, displacement: [0, 0, {-depth}]}}\n", "contacts: {joint: {between: [ground.top, disc.bottom], friction: 0}}\n")
            errors.append(abs(4 * increment["contacts"]["joint"]["normal_force"][2] / force - 1))
        self.assert_falls(errors, 4e-2, 1.0)

    def test_torsion(self):
        turn = 1e-3
        moment = 16 / 3 * SHEAR * turn
        far = ", ".join((*(f'"{sign * moment / (8 * math.pi * SHEAR):.17g} * {x} / {R}^3"' for sign, x in ((-1, "y"), (1, "x"))), "0"))
        errors = []
        for size in (0.4, 0.2):
            increment = self.on_disc(size, far, "  - {on: ground.left, fix: [y, z]}\n  - {on: ground.front, fix: [x, z]}\n",
                                     f"  - {{on: disc, displacement: [0, 0, 0], rotation: [0, 0, {turn}], at: [0, 0, 0]}}\n", "ties: {joint: {between: [ground.top, disc.bottom]}}\n")
            errors.append(abs(4 * increment["contacts"]["joint"]["moment"][2] / -moment - 1))  # on the disc
        self.assert_falls(errors, 0.13, 1.0)


if __name__ == "__main__":
    support.main()
