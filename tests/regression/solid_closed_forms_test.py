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
        errors = []
        for angular, layers, growth in ((5, 6, 1.96), (10, 12, 1.4)):
            _, values = self.octant("""  pull: {on: shell.OUT, traction: {formula: [null, null, "1e-3 * z / 12"]}}
""", "{at: [1, 0, 0], name: equator}, {at: [0, 0, 1], name: pole}", inner=1.0, outer=12.0, angular=angular, layers=layers, growth=growth)
            errors.append([abs(values["equator"]["stress_zz"] / 1e-3 - 2.045455)] + [abs(values["pole"][key] / 1e-3 + 0.681818) for key in ("stress_xx", "stress_yy")])
        for coarse, fine, bound, order in zip(*errors, (0.01, 0.02, 0.02), (1, 2, 2), strict=True):
            self.assertLess(fine, bound)
            self.assertLess(fine, coarse / 2**order)

    def test_two_balls_on_each_other(self):
        """Two balls R = 50, E = 20000, nu = 0.3 (code_aster's SSNV104) as a quarter of two half balls: as bodies of revolution; Hertz's pressure under
        the force that they carry. Half balls that are held on flat faces are stiffer than half spaces, so that the approach is not Hertz's."""
        for approach, size, of_hertz in ((0.4, 0.5, 0.01), (4.0, 2.2, 0.01)):
            with self.subTest(approach=approach):
                joint, exact = self.of_two_balls(approach, size), self.of_revolution(approach)
                force, pressure = 4 * joint["normal_force"][2], joint["max_pressure"]
                self.assertAlmostEqual(force, exact["normal_force"], delta=1e-2 * force)
                self.assertAlmostEqual(pressure, exact["max_pressure"], delta=5e-3 * pressure)
                self.assertLess(abs(joint["normal_force"][0]), 3e-3 * joint["normal_force"][2])  # 0 in their plane of symmetry
                stiffness, radius = 20000 / (2 * (1 - 0.3**2)), 25.0
                self.assertAlmostEqual(pressure, (6 * force * stiffness**2 / (math.pi**3 * radius**2)) ** (1 / 3), delta=of_hertz * pressure)

    def test_a_ball_on_a_rigid_plane_is_half_of_two(self):
        """Its normal is that of the contact, though the ball, which leans by a fifth at the edge of the contact, has the pairs."""
        joint, exact = self.of_two_balls(4.0, 2.2, rigid=True), self.of_revolution(4.0)
        self.assertAlmostEqual(4 * joint["normal_force"][2], exact["normal_force"], delta=1e-2 * exact["normal_force"])
        self.assertAlmostEqual(joint["max_pressure"], exact["max_pressure"], delta=5e-3 * exact["max_pressure"])
        self.assertLess(max(map(abs, joint["normal_force"][:2])), 1e-9 * joint["normal_force"][2])

    def of_two_balls(self, approach, size, rigid=False):
        """`size` of elements where they touch; `rigid`: the lower one is a rigid half space."""
        radius = 5 * approach**0.5
        near = ", ".join(f"{{near: [{at}, {at}, 0], size: {size}, growth: 0.4}}" for at in (0, 0.63 * radius))
        ball = "{{material: m, shape: {{sphere: {{centre: [0, 0, {}50], radius: 50, keep: [+x, +y, {}z]}}}}, mesh: {{size: 25, refine: [{}]}}}}"
        lower = "{rigid: true, shape: {box: {corner: [0, 0, -10], size: [60, 60, 10]}}, mesh: {size: 60}}" if rigid else ball.format("-", "+", near)
        elastic = ["upper"] if rigid else ["lower", "upper"]
        increment, _ = self.solve(f"""materials: {{m: {{young: 20000, poisson: 0.3}}}}
bodies:
  lower: {lower}
  upper: {ball.format("", "-", near)}
supports:
""" + "".join(f"  - {{on: {body}.cut_{axis}, fix: {axis}}}\n" for body in elastic for axis in "xy") + f"""  - {"{on: lower, fix: [x, y, z]}" if rigid else
 f"{{on: lower.cut_z, displacement: [null, null, {approach / 2}]}}"}
  - {{on: upper.cut_z, displacement: [null, null, {-approach / 2}]}}
contacts: {{joint: {{between: [{"lower.top" if rigid else "lower.surface"}, upper.surface], friction: 0}}}}
""")
        return increment["contacts"]["joint"]

    def of_revolution(self, approach):
        """The same two balls, with elements of a fortieth of the radius of the contact."""
        radius = 5 * approach**0.5
        mesh = f"{{size: 5, refine: [{{near: [0, 0], size: {radius / 40}, growth: 0.1}}, {{near: [{radius}, 0], size: {radius / 40}, growth: 0.1}}]}}"
        (self.directory / "revolution.yaml").write_text(f"""scabo: 1
analysis: {{plane: axisymmetric}}
materials: {{m: {{young: 20000, poisson: 0.3}}}}
bodies:
  lower:
    material: m
    shape:
      outline:
        - {{arc: {{from: [50, -50], to: [0, 0], centre: [0, -50]}}, name: surface}}
        - {{line: {{to: [0, -50]}}}}
        - {{line: {{to: [50, -50]}}, name: cut}}
    mesh: {mesh}
  upper:
    material: m
    shape:
      outline:
        - {{arc: {{from: [0, 0], to: [50, 50], centre: [0, 50]}}, name: surface}}
        - {{line: {{to: [0, 50]}}, name: cut}}
        - {{line: {{to: [0, 0]}}}}
    mesh: {mesh}
supports:
  - {{on: lower.cut, displacement: [null, {approach / 2}]}}
  - {{on: upper.cut, displacement: [null, {-approach / 2}]}}
contacts: {{joint: {{between: [lower.surface, upper.surface], friction: 0}}}}
""", encoding="utf-8")
        done = support.scabo("run", self.directory / "revolution.yaml", "-o", self.directory / "revolution", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return support.summary_of(self.directory / "revolution")["increments"][-1]["contacts"]["joint"]


if __name__ == "__main__":
    support.main()
