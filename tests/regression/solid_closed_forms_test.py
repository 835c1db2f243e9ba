"""Bodies in space against closed forms: torsion of bars, spheres under pressure, a cavity, two balls on each other."""
import math
import unittest

import support
from solids import Solving, shell


@unittest.skipIf(support.SANITIZED, "numbers")
class ClosedForms(Solving):
    def test_torsion_of_bars(self):
        """A quarter of the section: on its planes x = 0 and y = 0 points move across them alone. The ends are turned, and free to warp."""
        young, poisson, length, twist = 1.0, 0.3, 0.5, 1e-3
        shear = young / (2 * (1 + poisson))
        for width, height, constant in ((1.0, 1.0, 0.1405770), (2.0, 1.0, 0.457363)):
            errors = []
            for size in (0.25, 0.125):
                increment, values = self.solve(f"""materials: {{m: {{young: {young}, poisson: {poisson}}}}}
bodies: {{bar: {{material: m, shape: {{box: {{corner: [0, 0, 0], size: [{width / 2}, {height / 2}, {length}]}}}}, mesh: {{size: {size}}}}}}}
supports:
  - {{on: bar.bottom, fix: [x, y]}}
  - {{on: bar.top, displacement: {{formula: ["{-twist} * y", "{twist} * x", null]}}, name: turned}}
  - {{on: bar.left, fix: [y, z]}}
  - {{on: bar.front, fix: [x, z]}}
output: {{points: [{{at: [0, {height / 2}, {length / 2}], name: side}}]}}
""")
                moment = 4 * increment["moments"]["turned"][2]
                errors.append(moment / (shear * constant * twist / length) - 1)
                if width == height:  # in the middle of a side
                    self.assertAlmostEqual(abs(values["side"]["stress_xz"]), moment / 0.2081653, delta=0.02 * moment / 0.2081653)
            self.assertLess(abs(errors[0]), 5e-3)
            self.assertLess(abs(errors[1]), 5e-4)
            self.assertLess(abs(errors[1]), abs(errors[0]) / 6)  # as the third power of the size, or faster

    def octant(self, loads, points, supports="", **mesh):
        (self.directory / "shell.inp").write_text(shell(**mesh), encoding="utf-8")
        return self.solve(f"""materials: {{m: {{young: 1, poisson: 0.3}}}}
bodies: {{shell: {{material: m, mesh: {{file: shell.inp}}}}}}
supports:
  - {{on: shell.X, fix: x}}
  - {{on: shell.Y, fix: y}}
  - {{on: shell.Z, fix: z}}
{supports}loads:
{loads}output: {{points: [{points}]}}
""")

    def test_a_thick_sphere_under_pressure(self):
        """1 to 2, p = 1, E = 1, nu = 0.3. The pressure is small, as displacements are."""
        for angular, layers, moved, stressed in ((4, 3, 1.5e-2, 4e-2), (8, 6, 3e-3, 1.2e-2)):
            _, values = self.octant("  press: {on: shell.IN, pressure: 1e-3}\n", "{at: [0, 0, 1], name: inside}, {at: [0, 0, 2], name: outside}",
                                    inner=1.0, outer=2.0, angular=angular, layers=layers)
            self.assertAlmostEqual(values["inside"]["uz"], 0.8e-3, delta=moved * 0.8e-3)
            self.assertAlmostEqual(values["outside"]["uz"], 0.3e-3, delta=moved * 0.3e-3)
            for key in ("stress_xx", "stress_yy"):
                self.assertAlmostEqual(values["inside"][key], 0.714286e-3, delta=stressed * 0.714286e-3)

    def test_a_spherical_cavity_under_tension(self):
        """In a sphere of 12 radii under the stress of the tension along z: equator 2.045455, pole -0.681818 times it."""
        _, values = self.octant("""  pull: {on: shell.OUT, traction: {formula: [null, null, "1e-3 * z / 12"]}}
""", "{at: [1, 0, 0], name: equator}, {at: [0, 0, 1], name: pole}", inner=1.0, outer=12.0, angular=10, layers=12, growth=1.4)
        self.assertAlmostEqual(values["equator"]["stress_zz"], 2.045455e-3, delta=0.01e-3)
        for key in ("stress_xx", "stress_yy"):
            self.assertAlmostEqual(values["pole"][key], -0.681818e-3, delta=0.02e-3)

    def test_two_balls_on_each_other(self):
        """Two balls R = 50, E = 20000, nu = 0.3 (code_aster's SSNV104) as a quarter of two half balls. Hertz's pressure under the force that they carry;
        the approach is not compared, as half balls that are held on flat faces are stiffer than half spaces."""
        excess = {}
        for approach, size, bound in ((0.4, 0.5, 0.01), (4.0, 2.2, 0.05)):
            with self.subTest(approach=approach):
                excess[approach] = self.excess_of_two_balls(approach, size)
                self.assertLess(abs(excess[approach]), bound)
        self.assertGreater(excess[4.0], 0.02)  # as the square of the contact radius over that of the balls

    def excess_of_two_balls(self, approach, size):
        """Of the largest pressure over Hertz's, relative; `size` of elements where they touch."""
        radius = 5 * approach**0.5
        near = ", ".join(f"{{near: [{at}, {at}, 0], size: {size}, growth: 0.4}}" for at in (0, 0.63 * radius))
        ball = "{{material: m, shape: {{sphere: {{centre: [0, 0, {}50], radius: 50, keep: [+x, +y, {}z]}}}}, mesh: {{size: 25, refine: [{}]}}}}"
        increment, _ = self.solve(f"""materials: {{m: {{young: 20000, poisson: 0.3}}}}
bodies:
  lower: {ball.format("-", "+", near)}
  upper: {ball.format("", "-", near)}
supports:
""" + "".join(f"  - {{on: {body}.cut_{axis}, fix: {axis}}}\n" for body in ("lower", "upper") for axis in "xy") + f"""  - {{on: lower.cut_z, displacement: [null, null, {approach / 2}]}}
  - {{on: upper.cut_z, displacement: [null, null, {-approach / 2}]}}
contacts: {{joint: {{between: [lower.surface, upper.surface], friction: 0}}}}
""")
        joint = increment["contacts"]["joint"]
        stiffness, radius = 20000 / (2 * (1 - 0.3**2)), 25.0
        pressure = (6 * 4 * joint["normal_force"][2] * stiffness**2 / (math.pi**3 * radius**2)) ** (1 / 3)
        return joint["max_pressure"] / pressure - 1


if __name__ == "__main__":
    support.main()
