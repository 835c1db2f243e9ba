"""Shapes of models in space from the command line, against closed forms."""
import math
import unittest

import support
from support import ROOT, certificate_of, rows_of, scabo, summary_of


class Shapes(support.InTemporaryDirectory):
    def test_a_bush_under_pressure_in_a_ring_has_the_stress_of_lame(self):
        """Both of one material without a gap, kept from moving along the axis: together they are one thick tube, and the pressure between them is
        that of Lame at their radius, if gaps are seen to a hundredth of the displacements, which are 2e-5 of it."""
        text = """scabo: 1
analysis: {space: true}
materials: {steel: {young: 200e3, poisson: 0.3}}
bodies:
  ring: {material: steel, shape: {tube: {from: [0, 0, 0], to: [0, 0, 0.4], inner: 1.5, outer: 2}}, mesh: {size: 0.2}}
  bush: {material: steel, shape: {tube: {from: [0, 0, 0], to: [0, 0, 0.4], inner: 1, outer: 1.5}}, mesh: {size: 0.16}}
supports:
  - {on: ring.bottom, fix: z}
  - {on: ring.top, fix: z}
  - {on: bush.bottom, fix: z}
  - {on: bush.top, fix: z}
loads:
  oil: {on: bush.inside, pressure: 10}
  water: {on: ring.outside, pressure: 1}
contacts:
  joint: {between: [ring.inside, bush.outside], friction: 0.2}
"""
        (self.directory / "model.yaml").write_text(text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = rows_of(self.directory / "results")
        expected = 1 + 9 * (1 / 1.5**2 - 1 / 4) / (1 - 1 / 4)  # p(r) = p_b + (p_a - p_b) (a2 / r2 - a2 / b2) / (1 - a2 / b2)
        area = sum(float(row["area"]) for row in rows)
        mean = sum(float(row["normal_force"]) for row in rows) / area
        self.assertAlmostEqual(mean, expected, delta=1e-3 * expected)
        for row in rows:
            self.assertAlmostEqual(float(row["pressure"]), expected, delta=0.1 * expected)
        self.assertAlmostEqual(area, 2 * math.pi * 1.5 * 0.4, delta=0.02 * area)

    def test_faces_by_their_direction(self):
        """A model that is one in space by its shapes. A bar of which the part that looks down is pressed: all of a face, or 60 degrees of a round one."""
        radius, length, pressure = 0.5, 2.0, 7e3
        shapes = {"box": ("{box: {corner: [0, 0, 0], size: [1, 2, 1]}}", "front", length),
                  "cylinder": (f"{{cylinder: {{from: [0, 0, 0], to: [0, {length}, 0], radius: {radius}}}}}", "bottom", 2 * radius * math.sin(math.pi / 6) * length)}
        for name, (shape, end, area) in shapes.items():
            for place in ("{body: bar, normal: [0, 0, -2]}", f"{{body: bar, face: {'bottom' if name == 'box' else 'side'}, normal: [0, 0, -2]}}"):
                with self.subTest(shape=name, place=place):
                    (self.directory / "model.yaml").write_text(f"""scabo: 1
materials: {{steel: {{young: 200e9, poisson: 0.3}}}}
bodies: {{bar: {{material: steel, shape: {shape}, mesh: {{size: 0.13}}}}}}
supports: [{{on: bar.{end}, fix: [x, y, z], name: ground}}]
loads: {{press: {{on: {place}, pressure: {pressure}}}}}
""", encoding="utf-8")
                    done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
                    self.assertEqual(done.returncode, 0, done.stderr)
                    reaction = summary_of(self.directory / "results")["increments"][-1]["reactions"]["ground"]
                    exact = -pressure * area
                    self.assertAlmostEqual(reaction[2], exact, delta=(1e-9 if name == "box" else 0.1) * abs(exact))  # up to half a facet more or less
                    self.assertLess(abs(reaction[0]) + abs(reaction[1]), 1e-9 * abs(exact))

    def extruded(self, plane, loads):
        """A plate of 6 x 4 with a hole, 2 thick across the plane of its profile, on its bottom edge."""
        across, = set("xyz") - set(plane)
        text = f"""scabo: 1
analysis: {{space: true}}
materials: {{steel: {{young: 200e3, poisson: 0.3, density: 3}}}}
bodies:
  plate:
    material: steel
    shape:
      extrude:
        profile: {{rectangle: {{corner: [10, 20], size: [6, 4]}}}}
        holes: {{hole: {{circle: {{centre: [13, 22], radius: 1}}}}}}
        plane: {plane}
        from: -1
        to: 1
    mesh: {{size: 1, refine: [{{near: [0, 0, 0], size: 0.5}}]}}
supports:
  - {{on: plate.bottom, fix: [x, y, z], name: ground}}
loads:
{loads}
"""
        (self.directory / "model.yaml").write_text(text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        increment, = summary_of(self.directory / "results")["increments"]
        axes = ["xyz".index(axis) for axis in plane + across]
        return [-increment["reactions"]["ground"][k] for k in axes], [-increment["moments"]["ground"][k] for k in axes]

    def test_an_extruded_profile_has_its_volume_and_faces(self):
        for plane in ("xy", "xz", "yz", "zx"):
            with self.subTest(plane=plane):
                pull = ["0", "0", "0"]
                pull["xyz".index(plane[1])] = "-10"
                force, _ = self.extruded(plane, f"  weight: {{gravity: [{', '.join(pull)}]}}")
                volume = 2 * (24 - math.pi)
                self.assertAlmostEqual(force[1], -30 * volume, delta=1e-3 * 30 * volume)
                self.assertAlmostEqual(force[0], 0, delta=1e-9)
                for face, expected in (("top", [0, -12, 0]), ("left", [8, 0, 0]), ("right", [-8, 0, 0]), ("hole", [0, 0, 0])):
                    force, _ = self.extruded(plane, f"  push: {{on: plate.{face}, pressure: 1}}")
                    for one, other in zip(force, expected, strict=True):
                        self.assertAlmostEqual(one, other, delta=1e-9)
                for face, sign in (("start", 1), ("end", -1)):
                    force, _ = self.extruded(plane, f"  push: {{on: plate.{face}, pressure: 1}}")
                    self.assertAlmostEqual(force[2], sign * (24 - math.pi), delta=2e-3)

    def test_too_many_nodes_are_refused_before_they_are_made(self):
        text = (ROOT / "examples" / "35_ball_on_block" / "model.yaml").read_text(encoding="utf-8")
        (self.directory / "model.yaml").write_text(text, encoding="utf-8")
        done = scabo("check", self.directory / "model.yaml", "--set", "parameters.fine=1e-9")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stderr, r"bodies.block: its mesh would have .* nodes, and at most 4e\+06 are possible")


@unittest.skipIf(support.SANITIZED, "numbers")
class MadeShapes(support.InTemporaryDirectory):
    """A ring with a hole across, turned and cut by Gmsh's library, on a block: the same in other units, with its sides and bodies swapped."""

    def solve(self, unit=1.0, swapped=False, name="model"):
        def at(*x):
            return "[" + ", ".join(repr(unit * value) for value in x) + "]"
        block = f"  block: {{material: steel, shape: {{box: {{corner: {at(-41.3, -43.1, -20)}, size: {at(85, 87, 20)}}}}}, mesh: {{size: {unit * 20}}}}}\n"
        ring = f"""  ring:
    material: steel
    shape:
      subtract:
        body:
          revolve:
            profile: {{rectangle: {{corner: {at(15, 0)}, size: {at(15, 20)}}}}}
            plane: xz
            axis: {{from: [0, 0], to: [0, 1]}}
        hole: {{cylinder: {{from: {at(0, 0, 12)}, to: {at(40, 0, 12)}, radius: {unit * 4}}}}}
    mesh: {{size: {unit * 8}}}
"""
        sides = "[ring.body_bottom, block.top]" if swapped else "[block.top, ring.body_bottom]"
        text = f"""scabo: 1
analysis: {{space: true}}
materials: {{steel: {{young: {200e3 / unit**2!r}, poisson: 0.3}}}}
bodies:
{ring + block if swapped else block + ring}supports:
  - {{on: block.bottom, fix: [x, y, z], name: ground}}
loads:
  press: {{on: ring.body_top, force: [300, 0, -1000]}}
contacts:
  joint: {{between: {sides}, friction: 0.4}}
"""
        (self.directory / f"{name}.yaml").write_text(text, encoding="utf-8")
        done = scabo("run", self.directory / f"{name}.yaml", "-o", self.directory / name, "--quiet")
        if "built without Gmsh's library" in done.stderr:
            self.skipTest("built without Gmsh's library")
        self.assertEqual(done.returncode, 0, done.stderr)
        increment, = summary_of(self.directory / name)["increments"]
        self.assertLessEqual(certificate_of(increment), 1e-10)
        return increment["contacts"]["joint"]

    def test_balance_and_twins(self):
        one, small, turned_about = self.solve(), self.solve(unit=1e-3, name="small"), self.solve(swapped=True, name="swapped")
        for wanted, found in zip([-300, 0, 1000], [a + b for a, b in zip(one["normal_force"], one["tangential_force"])]):
            self.assertAlmostEqual(wanted, found, delta=1e-6)
        self.assertAlmostEqual(small["max_pressure"], 1e6 * one["max_pressure"], delta=1e-3 * one["max_pressure"])
        self.assertAlmostEqual(turned_about["max_pressure"], one["max_pressure"], delta=1e-9 * one["max_pressure"])
        for key in ("open", "stick", "slip"):
            self.assertEqual(one[key], small[key])
            self.assertEqual(one[key], turned_about[key])
        for wanted, found, swapped in zip(one["tangential_force"], small["tangential_force"], turned_about["tangential_force"]):
            self.assertAlmostEqual(wanted, found, delta=1e-6)
            self.assertAlmostEqual(wanted, -swapped, delta=1e-6)


if __name__ == "__main__":
    support.main()
