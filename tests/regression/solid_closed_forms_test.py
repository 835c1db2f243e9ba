"""Bodies in space against closed forms: torsion of bars, spheres under pressure, a cavity, two balls on each other."""
import csv
import itertools
import math
import unittest

import support
from support import scabo, summary_of

HEAD = "scabo: 1\nanalysis: {space: true}\n"


def shell(inner, outer, angular, layers, growth=1.0):
    """An octant of a hollow sphere, quadratic tetrahedra as a deck: nodes lie on the spheres. Node sets IN, OUT, X, Y, Z; `growth` of the thickness
    from layer to layer."""
    part = [sum(growth**k for k in range(j)) for j in range(layers + 1)]
    radii = [inner + (outer - inner) * p / part[-1] for p in part]
    index, points = {}, []
    for j, radius in enumerate(radii):
        for a in range(angular + 1):
            for b in range(angular + 1 - a):
                direction = (a, b, angular - a - b)
                size = math.hypot(*direction)
                index[a, b, j] = len(points)
                points.append((radius, tuple(x / size for x in direction)))
    triangles = []
    for a in range(angular):
        for b in range(angular - a):
            triangles.append(((a, b), (a + 1, b), (a, b + 1)))
            if a + b < angular - 1:
                triangles.append(((a + 1, b), (a + 1, b + 1), (a, b + 1)))
    place = [tuple(radius * x for x in direction) for radius, direction in points]
    middles, cells = {}, []

    def middle(i, k):
        key = (min(i, k), max(i, k))
        if key not in middles:
            middles[key] = len(place)
            mean = [x + y for x, y in zip(points[i][1], points[k][1])]
            radius, size = 0.5 * (points[i][0] + points[k][0]), math.hypot(*mean)
            place.append(tuple(radius * x / size for x in mean))
        return middles[key]

    for triangle, j in itertools.product(triangles, range(layers)):
        low = sorted(index[a, b, j] for a, b in triangle)  # prisms are divided alike from both sides
        high = [index[a, b, j + 1] for a, b in sorted(triangle, key=lambda corner: index[*corner, j])]
        for corners in ([*low, high[2]], [low[0], low[1], *high[1:]], [low[0], *high]):
            if volume(place, corners) < 0:
                corners[0], corners[1] = corners[1], corners[0]
            cells.append([*corners, *(middle(corners[i], corners[k]) for i, k in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)))])
    near = 1e-9 * outer
    sets = {"IN": lambda p: abs(math.hypot(*p) - inner) < near, "OUT": lambda p: abs(math.hypot(*p) - outer) < near,
            **{axis: (lambda p, k=k: abs(p[k]) < near) for k, axis in enumerate("XYZ")}}
    lines = ["*NODE", *(f"{k + 1}, {x:.15g}, {y:.15g}, {z:.15g}" for k, (x, y, z) in enumerate(place)), "*ELEMENT, TYPE=C3D10, ELSET=ALL",
             *(f"{k + 1}, " + ", ".join(str(node + 1) for node in cell) for k, cell in enumerate(cells))]
    for name, holds in sets.items():
        lines += [f"*NSET, NSET={name}", *(f"{k + 1}," for k, point in enumerate(place) if holds(point))]
    return "\n".join(lines) + "\n"


def volume(place, corners):
    a, b, c = ([place[corner][k] - place[corners[0]][k] for k in range(3)] for corner in corners[1:])
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])


@unittest.skipIf(support.SANITIZED, "numbers")
class ClosedForms(support.InTemporaryDirectory):
    def solve(self, text):
        (self.directory / "model.yaml").write_text(HEAD + text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        points = self.directory / "results" / "points.csv"
        values = {}
        if points.is_file():
            with open(points, encoding="utf-8", newline="") as file:
                values = {row["name"]: {key: float(value) for key, value in row.items() if key not in ("name", "body")} for row in csv.DictReader(file)}
        return summary_of(self.directory / "results")["increments"][-1], values

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
        near = "[{near: [0, 0, 0], size: 0.5, growth: 0.4}, {near: [2, 2, 0], size: 0.5, growth: 0.4}]"
        ball = "{{material: m, shape: {{sphere: {{centre: [0, 0, {}50], radius: 50, keep: [+x, +y, {}z]}}}}, mesh: {{size: 25, refine: {}}}}}"
        increment, _ = self.solve(f"""materials: {{m: {{young: 20000, poisson: 0.3}}}}
bodies:
  lower: {ball.format("-", "+", near)}
  upper: {ball.format("", "-", near)}
supports:
""" + "".join(f"  - {{on: {body}.cut_{axis}, fix: {axis}}}\n" for body in ("lower", "upper") for axis in "xy") + """  - {on: lower.cut_z, displacement: [null, null, 0.2]}
  - {on: upper.cut_z, displacement: [null, null, -0.2]}
contacts: {joint: {between: [lower.surface, upper.surface], friction: 0}}
""")
        joint = increment["contacts"]["joint"]
        stiffness, radius = 20000 / (2 * (1 - 0.3**2)), 25.0
        pressure = (6 * 4 * joint["normal_force"][2] * stiffness**2 / (math.pi**3 * radius**2)) ** (1 / 3)
        self.assertAlmostEqual(joint["max_pressure"], pressure, delta=0.01 * pressure)


if __name__ == "__main__":
    support.main()
