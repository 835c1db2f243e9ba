"""Supports in space along normals of faces and other directions: symmetry planes that are turned, sectors of tubes and spheres, bearings. Standard library only."""
import csv
import itertools
import math
import unittest

import support
from solid_twins_test import IDENTITY, product, rotation, text_of
from solids import HEAD
from support import scabo, summary_of

TOLERANCE = 1e-9
ANGLE = math.pi / 6
SHIFT = (0.3, -0.2, 0.7)
EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))  # of a C3D20
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


def moved(turn, x):
    return [a + b for a, b in zip(product(turn, x), SHIFT if turn is not IDENTITY else (0, 0, 0))]


def bricks(place, parts, turn=IDENTITY):
    """A deck of hexahedra with 20 nodes: those of a cube from 0 to 1, put in `place`. Node sets LOW_1, HIGH_1 and so on of its faces."""
    number, lines, cells = {}, ["*NODE"], []

    def node(at):
        if at not in number:
            number[at] = len(number) + 1
            point = moved(turn, place(*(0.5 * i / n for i, n in zip(at, parts))))
            lines.append(f"{number[at]}, " + ", ".join(repr(x) for x in point))
        return number[at]

    for first in itertools.product(*(range(n) for n in parts)):
        corners = [tuple(2 * (i + c) for i, c in zip(first, corner)) for corner in CORNERS]
        middles = [tuple((a + b) // 2 for a, b in zip(corners[i], corners[k])) for i, k in EDGES]
        cells.append([node(at) for at in (*corners, *middles)])
    lines += ["*ELEMENT, TYPE=C3D20, ELSET=ALL", *(f"{k + 1}, " + ", ".join(map(str, cell[:15])) + ",\n" + ", ".join(map(str, cell[15:])) for k, cell in enumerate(cells))]
    for axis, (name, end) in itertools.product(range(3), (("LOW", 0), ("HIGH", 1))):
        lines += [f"*NSET, NSET={name}_{axis + 1}", *(f"{k}," for at, k in number.items() if at[axis] == 2 * end * parts[axis])]
    return "\n".join(lines) + "\n"


def tube(inner, outer, angle, length):
    """Radius, angle, height."""
    return lambda r, t, z: ((inner + (outer - inner) * r) * math.cos(angle * t), (inner + (outer - inner) * r) * math.sin(angle * t), length * z)


def sphere(inner, outer, angle):
    """A part between four planes through its centre; the middles of edges lie on the spheres."""
    def place(r, a, b):
        direction = (math.tan(angle * a), math.tan(angle * b), 1.0)
        size = math.hypot(*direction)
        return tuple((inner + (outer - inner) * r) * x / size for x in direction)
    return place


def cone(bore, radius, slope, length):
    """Around a bore, with an outside that opens upwards."""
    return lambda r, t, z: tuple((bore + (radius + slope * length * z - bore) * r) * f(2 * math.pi * t) for f in (math.cos, math.sin)) + (length * z,)


class Running(support.InTemporaryDirectory):
    def run_model(self, text, name="model", status=0):
        (self.directory / f"{name}.yaml").write_text(HEAD + text, encoding="utf-8")
        done = scabo("run", self.directory / f"{name}.yaml", "-o", self.directory / f"{name}.results", "--quiet")
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return summary_of(self.directory / f"{name}.results")

    def rows(self, file, name="model"):
        with open(self.directory / f"{name}.results" / file, encoding="utf-8", newline="") as opened:
            return list(csv.DictReader(opened))

    def deck(self, name, *how):
        (self.directory / f"{name}.inp").write_text(bricks(*how), encoding="utf-8")


@unittest.skipIf(support.SANITIZED, "numbers")
class Directions(Running):
    def sector(self, file, supports, more, kind="hexahedra"):
        return self.run_model(f"""materials: {{m: {{young: 1, poisson: 0.3}}}}
bodies: {{part: {{material: m, mesh: {{file: {file}.inp, kind: {kind}}}}}}}
supports: [{", ".join(supports)}]
{more}""")["increments"][-1]

    def assert_work(self, increment):
        self.assertAlmostEqual(increment["energy"]["external"], increment["energy"]["elastic"], delta=TOLERANCE * increment["energy"]["elastic"])

    def test_a_sector_of_a_thick_sphere(self):
        """1 to 2, p = 1e-3, E = 1, nu = 0.3, between four planes that meet at edges. All that acts through the faces is in balance."""
        for turn in (IDENTITY, rotation(3)):
            self.deck("part", sphere(1.0, 2.0, ANGLE), (5, 3, 3), turn)
            inside, outside = (text_of(moved(turn, [0, 0, r])) for r in (1.0, 2.0))
            faces = [f"{side}_{axis}" for side in ("LOW", "HIGH") for axis in (1, 2, 3)]
            increment = self.sector("part", [f"{{on: part.{face}, fix: normal}}" for face in faces if face[-1] != "1"],
                                    f"loads: {{press: {{on: part.LOW_1, pressure: 1e-3}}}}\noutput: {{points: [{inside}, {outside}], history: {{" +
                                    ", ".join(f"{face}: {{face: part.{face}}}" for face in faces) + "}}\n")
            for row, expected in zip(self.rows("points.csv"), (0.8e-3, 0.3e-3), strict=True):
                u = product(list(zip(*turn)), [float(row[f"u{axis}"]) for axis in "xyz"])
                self.assertAlmostEqual(u[2], expected, delta=2e-3 * expected)
                self.assertLess(math.hypot(*u[:2]), 1e-9 * expected)
            self.assert_work(increment)
            row = self.rows("history.csv")[-1]
            for kind, axis in itertools.product(("force", "moment"), "xyz"):
                through = [float(row[f"{face}.{kind}_{axis}"]) for face in faces]
                self.assertLess(abs(sum(through)), TOLERANCE * sum(map(abs, through)))

    def test_a_sector_of_a_thick_tube(self):
        """Plane strain: Lame's displacement, and the reaction of the planes along their normals, the force p r of the hoop; and a body of revolution."""
        inner, outer, length, p, poisson = 1.0, 2.0, 0.5, 1e-3, 0.3
        expected = (1 + poisson) * p * inner / (outer**2 - inner**2) * ((1 - 2 * poisson) * inner**2 + outer**2)
        self.assertAlmostEqual(self.tube_of_revolution(inner, outer, length, p), expected, delta=1e-5 * expected)
        for kind, turn in (("hexahedra", IDENTITY), ("hexahedra", rotation(5)), ("tetrahedra", rotation(6))):
            with self.subTest(kind=kind, turned=turn is not IDENTITY):
                self.deck("part", tube(inner, outer, ANGLE, length), (6, 3, 1), turn)
                increment = self.sector("part", [f"{{on: part.{side}_{axis}, fix: normal, name: {side}_{axis}}}" for side in ("LOW", "HIGH") for axis in (2, 3)],
                                        f"loads: {{press: {{on: part.LOW_1, pressure: {p}}}}}\noutput: {{points: [{text_of(moved(turn, [inner, 0, length / 2]))}]}}\n", kind)
                back = list(zip(*turn))
                u = product(back, [float(self.rows("points.csv")[0][f"u{axis}"]) for axis in "xyz"])
                self.assertAlmostEqual(u[0], expected, delta=1e-3 * expected)
                self.assertLess(abs(u[1]), TOLERANCE * expected)
                forces = {name: product(back, force) for name, force in increment["reactions"].items()}
                for name, normal in (("LOW_2", (0, -1, 0)), ("HIGH_2", (-math.sin(ANGLE), math.cos(ANGLE), 0))):
                    for component, n in zip(forces[name], normal):
                        self.assertAlmostEqual(component, p * inner * length * n, delta=TOLERANCE * p)
                self.assertAlmostEqual(sum(force[2] for force in forces.values()), 0.0, delta=TOLERANCE * p)
                self.assert_work(increment)

    def tube_of_revolution(self, inner, outer, length, p):
        (self.directory / "round.yaml").write_text(f"""scabo: 1
analysis: {{plane: axisymmetric}}
materials: {{m: {{young: 1, poisson: 0.3}}}}
bodies: {{tube: {{material: m, shape: {{rectangle: {{corner: [{inner}, 0], size: [{outer - inner}, {length}]}}}}, mesh: {{size: 0.1}}}}}}
supports: [{{on: tube.bottom, fix: y}}, {{on: tube.top, fix: y}}]
loads: {{press: {{on: tube.left, pressure: {p}}}}}
output: {{history: {{moved: tube.bottom_left.ux}}}}
""", encoding="utf-8")
        done = scabo("run", self.directory / "round.yaml", "-o", self.directory / "round.results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return float(self.rows("history.csv", "round")[-1]["moved"])

    def test_a_press_fit_as_a_sector(self):
        """Two tubes, 1 to 1.5 to 2, whose ends are free: Lame's pressure of the fit."""
        inner, middle, outer, fit = 1.0, 1.5, 2.0, 1e-3
        pressure = fit / middle * (middle**2 - inner**2) * (outer**2 - middle**2) / (2 * middle**2 * (outer**2 - inner**2))
        totals = []
        for turn in (IDENTITY, rotation(8)):
            self.deck("hub", tube(middle, outer, ANGLE, 0.5), (4, 4, 2), turn)
            self.deck("bush", tube(inner, middle, ANGLE, 0.5), (4, 3, 2), turn)
            increment = self.run_model("""materials: {m: {young: 1, poisson: 0.3}}
bodies: {hub: {material: m, mesh: {file: hub.inp, kind: hexahedra}}, bush: {material: m, mesh: {file: bush.inp, kind: hexahedra}}}
supports: [""" + ", ".join(f"{{on: {body}.{face}, fix: normal, name: {body}_{face}}}" for body in ("hub", "bush") for face in ("LOW_2", "HIGH_2", "LOW_3")) + f"""]
contacts: {{fit: {{between: [hub.LOW_1, bush.HIGH_1], friction: 0, gap: {-fit}}}}}
""")["increments"][-1]
            back = list(zip(*turn))
            fitted = increment["contacts"]["fit"]
            self.assertEqual(fitted["open"], 0)
            forces = {name: product(back, force) for name, force in increment["reactions"].items()}
            force = product(back, fitted["normal_force"])
            chord = math.hypot(math.sin(ANGLE), 1 - math.cos(ANGLE)) * middle * 0.5
            self.assertAlmostEqual(math.hypot(*force), pressure * chord, delta=5e-3 * pressure * chord)
            for body, sense in (("hub", -1), ("bush", 1)):  # what holds a body balances the fit
                for axis in range(3):
                    total = sum(forces[f"{body}_{face}"][axis] for face in ("LOW_2", "HIGH_2", "LOW_3")) + sense * force[axis]
                    self.assertLess(abs(total), TOLERANCE * pressure)
            totals.append([*force, *(x for name in sorted(forces) for x in forces[name]), increment["energy"]["elastic"]])
        for one, other in zip(*totals):
            self.assertAlmostEqual(one, other, delta=TOLERANCE * pressure)

    def test_a_bearing_lets_a_shaft_turn(self):
        """A tube, slit along a line, whose outside is held along its normals: it turns about its axis and moves along it, and nothing else."""
        for turn in (IDENTITY, rotation(2)):
            self.deck("part", tube(0.5, 1.0, 2 * math.pi, 1.0), (2, 12, 2), turn)
            for load, ends in (("traction: " + text_of(product(turn, [1e-3, 0, 0])), None), ("traction: " + text_of(product(turn, [0, 0, 1e-3])), "translation along"),
                               ("moment: " + text_of(product(turn, [0, 0, 1e-3])), "rotation about the axis")):
                summary = self.run_model(f"""materials: {{m: {{young: 1, poisson: 0.3}}}}
bodies: {{part: {{material: m, mesh: {{file: part.inp}}}}}}
supports: [{{on: part.HIGH_1, fix: normal}}]
loads: {{pull: {{on: part.LOW_1, {load}}}}}
""", status=2 if ends else 0)
                self.assertEqual(summary["status"], "mechanism" if ends else "solved")
                self.assertIn(ends or "", summary["reason"] or "")

    def test_parts_of_a_curved_face(self):
        """Two supports on parts of a wavy face, which is no quadric, are one on all of it, whose normals they have where they meet."""
        self.deck("part", lambda x, y, z: (x, y, z * (1 + 0.3 * math.sin(2 * x))), (5, 2, 2))
        whole, parts, axes = (self.sector("part", [*supports, "{on: part.LOW_2, fix: y}"],
                                          "loads: {pull: {on: part.HIGH_1, traction: [1e-3, 0, 2e-3]}}\n", "tetrahedra")
                              for supports in (["{on: part.HIGH_3, fix: normal}"],
                                               [f"{{on: {{body: part, face: HIGH_3, normal: {normal}}}, fix: normal}}" for normal in ("[-0.5, 0, 1]", "[0.1, 0, 1]")],
                                               ["{on: part.HIGH_3, fix: [x, z]}"]))
        self.assertAlmostEqual(parts["energy"]["elastic"], whole["energy"]["elastic"], delta=TOLERANCE * whole["energy"]["elastic"])
        self.assertLess(axes["energy"]["elastic"], 0.99 * whole["energy"]["elastic"])

    def test_a_plug_in_a_conical_seat(self):
        """What holds a cone along its normals balances a force along the axis; a moment about the axis turns it."""
        for turn in (IDENTITY, rotation(4)):
            self.deck("part", cone(0.3, 0.6, 0.4, 0.5), (2, 12, 2), turn)
            for load, status in (([0, 0, -1e-3], 0), (None, 2)):
                acts = f"force: {text_of(product(turn, load))}" if load else f"moment: {text_of(product(turn, [0, 0, 1e-3]))}"
                summary = self.run_model(f"""materials: {{m: {{young: 1, poisson: 0.3}}}}
bodies: {{part: {{material: m, mesh: {{file: part.inp}}}}}}
supports: [{{on: part.HIGH_1, fix: normal, name: seat}}]
loads: {{push: {{on: part.HIGH_3, {acts}}}}}
""", status=status)
                if load:
                    self.assert_work(summary["increments"][-1])
                    for a, b in zip(summary["increments"][-1]["reactions"]["seat"], product(turn, load)):
                        self.assertAlmostEqual(a, -b, delta=TOLERANCE * 1e-3)
                else:
                    self.assertEqual(summary["status"], "mechanism")
                    self.assertIn("rotation about the axis", summary["reason"])



    def test_fixed_supports_that_overlap_are_one(self):
        """One ends after the other one begins, along a direction or its opposite: as one that lasts."""
        text = """materials: {m: {young: 1e7, poisson: 0.3}}
bodies: {block: {material: m, shape: {box: {corner: [0, 0, 0], size: [1, 1, 1]}}, mesh: {size: 0.5}}}
supports: [{on: block.left, fix: [x, y, z], name: wall}, SUPPORTS]
loads: {push: {on: block.top, traction: [10, 20, -300]}}
steps: [{name: first}, {name: second, increments: 2, loads: {push: 2}}, {name: third, increments: 2, loads: {push: 3}}]
"""
        for along in ([1, 2, 2], [0.3, -0.7, 0.1], [0, 0, 1]):
            one = f"{{on: block.right, fix: {{along: {along}}}, name: one}}"
            two = f"{{on: block.right, fix: {{along: {[-3 * x for x in along]}}}, name: two, added: second}}"
            ends = one.replace("}, name", "}, removed: third, name")
            alone, both = (self.run_model(text.replace("SUPPORTS", supports))["increments"] for supports in (one, f"{ends}, {two}"))
            for a, b in zip(both, alone, strict=True):
                total = [sum(x) for x in zip(a["reactions"]["one"], a["reactions"].get("two", [0, 0, 0]))]
                for x, y in zip(total + a["reactions"]["wall"], b["reactions"]["one"] + b["reactions"]["wall"], strict=True):
                    self.assertAlmostEqual(x, y, delta=TOLERANCE * 300)
                self.assertAlmostEqual(a["energy"]["elastic"], b["energy"]["elastic"], delta=TOLERANCE * b["energy"]["elastic"])
            self.assertEqual(both[-1]["reactions"]["one"], [0, 0, 0])

    def test_supports_that_overlap_are_one(self):
        """One ends after the other one begins, with the same displacement along a direction, however that is written: as one that lasts."""
        def model(supports, second, third):
            steps = "{name: first, loads: {push: 1}}, "
            steps += f"{{name: second, increments: 2, loads: {{{second}}}}}, {{name: third, increments: 2, loads: {{push: 2, {third}}}}}"
            return f"""materials: {{m: {{young: 1e7, poisson: 0.3}}}}
bodies: {{block: {{material: m, shape: {{box: {{corner: [0, 0, 0], size: [1, 1, 1]}}}}, mesh: {{size: 0.5}}}}}}
supports: [{{on: block.left, fix: [x, y, z], name: wall}}, {", ".join(f"{{on: block.right, displacement: {support}}}" for support in supports)}]
loads: {{push: {{on: block.top, traction: [10, 20, -300]}}}}
steps: [{steps}]
output: {{points: [[1, 0.5, 0.5]]}}
"""

        for along, again, value in (([1, 2, 2], [1, 2, 2], 1e-3), ([1, 2, 2], [-2, -4, -4], -1e-3), ([0.3, -0.7, 0.1], [0.9, -2.1, 0.3], 1e-3),
                                    ([1, 0, 0], [-3, 0, 0], -1e-3)):
            with self.subTest(along=along, again=again):
                one = f"{{along: {along}, value: 1e-3}}, name: one"
                alone, moved_alone = self.run_model(model([one], "one: 1", "one: 2"))["increments"], self.rows("points.csv")
                first, second = one + ", removed: third", f"{{along: {again}, value: VALUE}}, name: two, added: second"
                text = model([first, second], "one: 1, two: 1", "two: 2")
                both = self.run_model(text.replace("VALUE", repr(value)))["increments"]
                self.assertEqual(both[-1]["reactions"].get("one", [0, 0, 0]), [0, 0, 0])
                size = max(abs(x) for x in alone[-1]["reactions"]["wall"])
                for a, b in zip(both, alone, strict=True):
                    total = [sum(a["reactions"].get(name, [0, 0, 0])[k] for name in ("one", "two")) for k in range(3)]
                    for x, y in zip(total + a["reactions"]["wall"], b["reactions"]["one"] + b["reactions"]["wall"], strict=True):
                        self.assertAlmostEqual(x, y, delta=TOLERANCE * size)
                    self.assertAlmostEqual(a["energy"]["elastic"], b["energy"]["elastic"], delta=TOLERANCE * alone[-1]["energy"]["elastic"])
                for a, b in zip(self.rows("points.csv"), moved_alone, strict=True):
                    for axis in "xyz":
                        self.assertAlmostEqual(float(a[f"u{axis}"]), float(b[f"u{axis}"]), delta=TOLERANCE * 1e-3)
                said = self.refused(text.replace("VALUE", repr(value * (1 + 1e-6))))
                self.assertRegex(said, r"supports.2.on: support 'two' prescribes another displacement .* than support 'one'")

    def refused(self, text):
        (self.directory / "refused.yaml").write_text(HEAD + text, encoding="utf-8")
        done = scabo("run", self.directory / "refused.yaml", "-o", self.directory / "refused.results", "--quiet")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        return done.stderr

    def pyramid(self, turn):
        """Four tetrahedra on a square of 2 m around a node in its middle, 1.5 m high, pointing down: node sets of its sides, each and together."""
        nodes = [(-1, -1, 1.5), (1, -1, 1.5), (1, 1, 1.5), (-1, 1, 1.5), (0, 0, 1.5), (0, 0, 0)]
        around = ((1, 2), (2, 3), (3, 4), (4, 1))
        lines = ["*NODE", *(f"{k + 1}, " + ", ".join(repr(float(x)) for x in moved(turn, node)) for k, node in enumerate(nodes)), "*ELEMENT, TYPE=C3D4, ELSET=ALL",
                 *(f"{k + 1}, {b}, {a}, 5, 6" for k, (a, b) in enumerate(around))]
        for name, members in {"SEAT": (1, 2, 3, 4, 6), "BASE": (1, 2, 3, 4, 5), **{f"SIDE_{k + 1}": (*ends, 6) for k, ends in enumerate(around)}}.items():
            lines += [f"*NSET, NSET={name}", *(f"{node}," for node in members)]
        (self.directory / "part.inp").write_text("\n".join(lines) + "\n", encoding="utf-8")

    def test_a_pyramid_in_a_seat_that_moves(self):
        """Its tip has four normals, of which one follows from three. What moves out along all of them at once lowers the pyramid: u / n_z, without a
        force, at every factor; and the seat balances what presses."""
        un, normal_z = 2e-3, 1 / math.hypot(1, 1.5)
        for turn in (IDENTITY, rotation(3), rotation(10)):
            self.pyramid(turn)
            model = f"""materials: {{m: {{young: 1e6, poisson: 0.3}}}}
bodies: {{part: {{material: m, mesh: {{file: part.inp}}}}}}
supports: [SUPPORTS]
loads: {{press: {{on: part.BASE, force: {text_of(product(turn, [10, -20, -100]))}}}}}
steps: [STEPS]
output: {{points: [{text_of(moved(turn, [0.1, 0.2, 1.2]))}, {text_of(moved(turn, [0, 0, 0.2]))}]}}
"""
            steps = "{name: lower, increments: 2, loads: {seat: 1}}, {name: lift, loads: {seat: -0.5}}, {name: press, loads: {press: 1}}"
            summary = self.run_model(model.replace("SUPPORTS", f"{{on: part.SEAT, displacement: {{normal: {un}}}, name: seat}}").replace("STEPS", steps))
            back, rows = list(zip(*turn)), self.rows("points.csv")
            for k, (increment, factor) in enumerate(zip(summary["increments"][:3], (0.5, 1, -0.5), strict=True)):
                self.assertLess(max(map(abs, increment["reactions"]["seat"])), TOLERANCE * 1e6 * un)
                for row in rows[2 * k:2 * k + 2]:
                    for u, expected in zip(product(back, [float(row[f"u{axis}"]) for axis in "xyz"]), (0, 0, -factor * un / normal_z), strict=True):
                        self.assertAlmostEqual(u, expected, delta=TOLERANCE * un)
            for reaction, expected in zip(product(back, summary["increments"][3]["reactions"]["seat"]), (-10, 20, 100), strict=True):
                self.assertAlmostEqual(reaction, expected, delta=TOLERANCE * 100)
            # Without displacements also as four supports; with them their factors might differ.
            sides = ", ".join(f"{{on: part.SIDE_{k}, HOW, name: side_{k}}}" for k in (1, 2, 3, 4))
            model = model.replace("SUPPORTS", sides).replace("STEPS", "{name: all}")
            fixed = self.run_model(model.replace("HOW", "fix: normal"))["increments"][0]
            total = [sum(reaction[axis] for reaction in fixed["reactions"].values()) for axis in range(3)]
            for reaction, expected in zip(product(back, total), (-10, 20, 100), strict=True):
                self.assertAlmostEqual(reaction, expected, delta=TOLERANCE * 100)
            self.assertIn("prescribes another displacement", self.refused(model.replace("HOW", f"displacement: {{normal: {un}}}")))


if __name__ == "__main__":
    support.main()
