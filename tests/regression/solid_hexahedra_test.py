"""Hexahedra and wedges in space (`kind: hexahedra`) from the command line, where statics or a closed form gives the answer."""
import csv
import json
import math
import unittest

import support
from solids import arrays_of
from support import ROOT, rows_of, scabo, summary_of

HEAD = "scabo: 1\nanalysis: {space: true}\n"


@unittest.skipIf(support.SANITIZED, "numbers")
class Hexahedra(support.InTemporaryDirectory):
    def solve(self, text):
        (self.directory / "model.yaml").write_text(HEAD + text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        points = self.directory / "results" / "points.csv"
        values = {}
        if points.is_file():
            with open(points, encoding="utf-8", newline="") as file:
                values = {row["name"]: {key: float(value) for key, value in row.items() if key not in ("name", "body") and value} for row in csv.DictReader(file)}
        return summary_of(self.directory / "results")["increments"][-1], values

    def test_a_block_pressed_on_another_one(self):
        """All pairs of kinds: every pair has the pressure, all nodes the stress, and the section the force."""
        for kinds in (("hexahedra", "hexahedra"), ("hexahedra", "tetrahedra"), ("tetrahedra", "hexahedra")):
            increment, values = self.solve(f"""materials: {{m: {{young: 200e9, poisson: 0.3}}}}
bodies:
  lower: {{material: m, shape: {{box: {{corner: [0, 0, -1], size: [2, 2, 1]}}}}, mesh: {{size: 0.7, kind: {kinds[0]}}}}}
  upper: {{material: m, shape: {{box: {{corner: [0, 0, 0], size: [2, 2, 1]}}}}, mesh: {{size: 0.5, kind: {kinds[1]}}}}}
supports:
  - {{on: lower.bottom, fix: z}}
  - {{on: lower.left, fix: x}}
  - {{on: lower.front, fix: y}}
  - {{on: upper.left, fix: x}}
  - {{on: upper.front, fix: y}}
loads: {{press: {{on: upper.top, pressure: 1e6}}}}
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: 0.3}}}}
output:
  points: [{{at: [1.1, 0.7, -0.3], name: below}}, {{at: [0.3, 0.4, 0.6], name: above}}]
  history: {{cut: {{section: {{point: [1, 1, 0.4], normal: [0.3, 0, 1], body: upper}}}}}}
""")
            for row in rows_of(self.directory / "results"):
                self.assertAlmostEqual(float(row["pressure"]), 1e6, delta=1e-4)
            self.assertAlmostEqual(increment["contacts"]["joint"]["normal_force"][2], 4e6, delta=1e-3)
            for name, height in (("below", 0.7), ("above", 1.6)):
                self.assertAlmostEqual(values[name]["stress_zz"], -1e6, delta=1e-3)
                self.assertAlmostEqual(values[name]["uz"], -height * 1e6 / 200e9, delta=1e-14)
                self.assertAlmostEqual(values[name]["von_mises"], 1e6, delta=1e-3)
            with open(self.directory / "results" / "history.csv", encoding="utf-8", newline="") as file:
                cut = list(csv.DictReader(file))[-1]
            self.assertAlmostEqual(float(cut["cut.force_z"]), -4e6, delta=1e-2)
            fields = arrays_of(self.directory / "results" / "fields_0001.vtu")
            self.assertEqual({25 if kind == "hexahedra" else 24 for kind in kinds}, set(fields["types"]))
            for k, stress in enumerate(fields["stress"]):
                self.assertAlmostEqual(stress, -1e6 if k % 6 == 2 else 0.0, delta=1.0)  # single precision

    def test_the_block_of_example_30_under_a_rigid_lid(self):
        """Base, block and lid of hexahedra: the lid is pressed, the block pushed until it slides. The forces are those of statics."""
        check = json.loads((ROOT / "examples" / "30_blocks_in_space" / "check.json").read_text(encoding="utf-8"))
        increment, values = self.solve(f"""materials: {{steel: {{young: 210e9, poisson: 0.3}}}}
bodies:
  base: {{material: steel, shape: {{box: {{corner: [0, 0, -0.3], size: [1, 1, 0.3]}}}}, mesh: {{size: 0.34, kind: hexahedra}}}}
  block: {{material: steel, shape: {{box: {{corner: [0.2, 0.2, 0], size: [0.6, 0.6, 0.4]}}}}, mesh: {{size: 0.2, kind: hexahedra}}}}
  lid: {{rigid: true, shape: {{box: {{corner: [0.1, 0.1, 0.4], size: [0.8, 0.8, 0.1]}}}}, mesh: {{size: 0.4, kind: hexahedra}}}}
supports:
  - {{on: base.bottom, fix: [x, y, z], name: ground}}
  - {{on: block.left, displacement: [1e-3, null, null], name: ram}}
loads:
  press: {{on: lid, force: [0, 0, {-check["normal_force"]}]}}
contacts:
  joint: {{between: [base.top, block.bottom], friction: 0.3}}
ties:
  seat: {{between: [block.top, lid.bottom]}}
steps:
  - {{name: press, loads: {{press: 1, ram: 0}}}}
  - {{name: push, increments: 3, loads: {{ram: 1}}}}
output: {{points: [{{at: [0.5, 0.5, 0.45], name: lid}}]}}
""")
        close = lambda value, wanted: self.assertAlmostEqual(value / wanted, 1.0, delta=check["relative_tolerance"])
        close(increment["contacts"]["joint"]["normal_force"][2], check["normal_force"])
        close(-increment["contacts"]["joint"]["tangential_force"][0], check["tangential_force"])
        close(increment["reactions"]["ram"][0], check["tangential_force"])
        self.assertEqual(increment["contacts"]["joint"]["slip"] + increment["contacts"]["joint"]["open"], 16)
        self.assertAlmostEqual(values["lid"]["ux"], 1e-3, delta=1e-5)

    def test_a_wall_of_incompressible_rubber_in_a_tube(self):
        """Lame: a quarter of a ring of wedges under pressure inside, held along its axis. They do not lock: errors fall as the third power of the size."""
        inner, outer, pressure, young = 1.0, 2.0, 1e-3, 1.0
        for poisson in (0.3, 0.49999):
            exact = (1 + poisson) / young * pressure * inner**2 / (outer**2 - inner**2) * ((1 - 2 * poisson) * inner + outer**2 / inner)
            errors = []
            for size in (0.5, 0.25):
                _, values = self.solve(f"""materials: {{m: {{young: {young}, poisson: {poisson}}}}}
bodies:
  ring:
    material: m
    shape:
      extrude:
        profile:
          outline:
            - {{line: {{from: [{inner}, 0], to: [{outer}, 0]}}, name: along_x}}
            - {{arc: {{to: [0, {outer}], centre: [0, 0]}}}}
            - {{line: {{to: [0, {inner}]}}, name: along_y}}
            - {{arc: {{to: [{inner}, 0], centre: [0, 0], direction: clockwise}}, name: wall}}
        plane: xy
        from: 0
        to: 0.3
    mesh: {{size: {size}, kind: hexahedra}}
supports:
  - {{on: ring.along_x, fix: y}}
  - {{on: ring.along_y, fix: x}}
  - {{on: ring.start, fix: z}}
  - {{on: ring.end, fix: z}}
loads: {{oil: {{on: ring.wall, pressure: {pressure}}}}}
output: {{points: [{{at: [{inner}, 0, 0.1], name: wall}}]}}
""")
                errors.append(abs(values["wall"]["ux"] / exact - 1))
            self.assertLess(errors[1], 5e-4 if poisson < 0.4 else 1.5e-3)
            self.assertLess(errors[1], errors[0] / 5)

    def test_a_cylinder_on_a_block(self):
        """Hertz in plane strain: wedges on hexahedra, five facets in the half width of the contact. Pressures do not oscillate."""
        width, thickness, load = 0.1, 0.03, 2.157e-3
        stiffness = 1 / (2 * (1 - 0.3**2))
        largest = 4 * load / (math.pi * width)
        self.assertAlmostEqual(math.sqrt(8 * load / (math.pi * stiffness)), width, delta=1e-4)
        self.solve(f"""materials: {{m: {{young: 1, poisson: 0.3}}}}
bodies:
  disc:  # a quarter
    material: m
    shape:
      extrude:
        profile:
          outline:
            - {{arc: {{from: [0, 0], to: [1, 1], centre: [0, 1]}}, name: outside}}
            - {{line: {{to: [0, 1]}}, name: top}}
            - {{line: {{to: [0, 0]}}, name: middle}}
        plane: xz
        from: 0
        to: {thickness}
    mesh: {{size: 0.3, kind: hexahedra, refine: [{{near: [0, 0, 0], size: 0.02, growth: 0.25}}]}}
  block:
    material: m
    shape: {{box: {{corner: [0, 0, -1], size: [1, {thickness}, 1]}}}}
    mesh: {{size: 0.3, kind: hexahedra, refine: [{{near: [0, 0, 0], size: 0.03, growth: 0.25}}]}}
supports:
  - {{on: disc.middle, fix: x}}
  - {{on: block.left, fix: x}}
  - {{on: block.bottom, fix: z}}
  - {{on: disc.start, fix: y}}
  - {{on: disc.end, fix: y}}
  - {{on: block.front, fix: y}}
  - {{on: block.back, fix: y}}
loads: {{press: {{on: disc.top, pressure: {load}}}}}
contacts: {{joint: {{between: [block.top, disc.outside], friction: 0}}}}
""")
        pairs = [(float(row["x"]), float(row["pressure"]) / largest) for row in rows_of(self.directory / "results")]
        self.assertAlmostEqual(max(pressure for _, pressure in pairs), 1.0, delta=1e-2)
        near = [pressure - math.sqrt(1 - (x / width)**2) for x, pressure in pairs if x < 0.85 * width]
        self.assertGreater(len(near), 8)
        self.assertLess(math.sqrt(sum(error**2 for error in near) / len(near)), 2e-2)

    def test_bending_of_a_few_bricks_is_exact(self):
        """A bar under the tractions of a bending moment, also of a material that hardly changes its volume: displacements are quadratic."""
        for poisson in (0.0, 0.3, 0.49999):
            _, values = self.solve(f"""materials: {{m: {{young: 1, poisson: {poisson}}}}}
bodies: {{bar: {{material: m, shape: {{box: {{corner: [0, 0, -0.5], size: [4, 1, 1]}}}}, mesh: {{size: 1, kind: hexahedra}}}}}}
supports:
  - {{on: bar.left, displacement: {{formula: [0, "{poisson} * 1e-3 * (y - 0.5) * z", "-0.5e-3 * {poisson} * ((y - 0.5)^2 - z^2)"]}}}}
loads: {{bend: {{on: bar.right, traction: {{formula: ["-1e-3 * z", null, null]}}}}}}
output: {{points: [{{at: [4, 0.5, 0], name: end}}, {{at: [2.3, 0.2, 0.3], name: inside}}]}}
""")
            self.assertAlmostEqual(values["end"]["uz"], 0.5e-3 * 16, delta=1e-9)
            self.assertAlmostEqual(values["inside"]["stress_xx"], -1e-3 * 0.3, delta=1e-10)
            self.assertAlmostEqual(values["inside"]["ux"], -1e-3 * 2.3 * 0.3, delta=1e-10)

    def test_a_hanging_bar_has_the_stress_of_its_weight(self):
        """Linear in the height, also inside a cell: the load inside counts."""
        increment, values = self.solve("""materials: {m: {young: 1e6, poisson: 0, density: 1000}}
bodies: {bar: {material: m, shape: {box: {corner: [0, 0, 0], size: [1, 1, 3]}}, mesh: {size: 1, kind: hexahedra}}}
supports:
  - {on: bar.top, fix: [x, y, z], name: hook}
loads: {weight: {gravity: [0, 0, -10]}}
output: {points: [{at: [0.3, 0.6, 1.3], name: inside}, {at: [0.5, 0.5, 0.5], name: centre}, {at: [0, 0, 0], name: foot}]}
""")
        self.assertAlmostEqual(increment["reactions"]["hook"][2], 3e4, delta=1e-5)
        for name, z in (("inside", 1.3), ("centre", 0.5), ("foot", 0.0)):
            self.assertAlmostEqual(values[name]["stress_zz"], 1e4 * z, delta=1e-5)
            self.assertAlmostEqual(values[name]["uz"], 1e-2 * 0.5 * (z**2 - 9), delta=1e-10)

    def test_a_bolt_and_a_plate_that_is_heated(self):
        """A square bolt that is held at both ends and shortened: E A s / l. A heated plate between walls: E alpha T."""
        increment, values = self.solve("""materials: {m: {young: 200e9, poisson: 0.0, expansion: 1e-5}}
bodies:
  bolt:
    material: m
    shape: {box: {corner: [-0.1, -0.1, 0], size: [0.2, 0.2, 1]}}
    mesh: {size: 0.25, kind: hexahedra}
    preload: {cut: {point: [0, 0, 0.4], normal: [0, 0, 1]}, shortening: 1e-4}
  plate: {material: m, shape: {box: {corner: [2, 0, 0], size: [1, 1, 0.2]}}, mesh: {size: 0.5, kind: hexahedra}}
supports:
  - {on: bolt.bottom, fix: [x, y, z]}
  - {on: bolt.top, fix: [x, y, z], name: head}
  - {on: plate.left, fix: x}
  - {on: plate.right, fix: x}
  - {on: plate.front, fix: y}
  - {on: plate.bottom, fix: z}
loads: {heat: {on: plate, temperature: 30}}
output: {points: [{at: [2.3, 0.4, 0.1], name: heated}]}
""")
        self.assertAlmostEqual(increment["preloads"]["bolt"]["force"], 8e5, delta=1e-3)
        self.assertAlmostEqual(increment["reactions"]["head"][2], 8e5, delta=1e-3)
        self.assertAlmostEqual(values["heated"]["stress_xx"], -200e9 * 1e-5 * 30, delta=1e-2)
        self.assertAlmostEqual(values["heated"]["stress_yy"], 0.0, delta=1e-2)
        self.assertAlmostEqual(values["heated"]["uy"], 0.4 * 1e-5 * 30, delta=1e-12)

    def test_the_picture_of_a_mechanism_has_hexahedra(self):
        """A lifted block: cells and faces of the picture keep their nodes, and it is drawn."""
        (self.directory / "model.yaml").write_text(HEAD + """materials: {m: {young: 1e9, poisson: 0.2}}
bodies:
  base: {material: m, shape: {box: {corner: [0, 0, -1], size: [2, 2, 1]}}, mesh: {size: 1, kind: hexahedra}}
  block: {material: m, shape: {box: {corner: [0, 0, 0], size: [2, 2, 1]}}, mesh: {size: 1, kind: hexahedra}}
supports: [{on: base.bottom, fix: [x, y, z]}]
loads: {lift: {on: block.top, traction: [0, 0, 1e3]}}
contacts: {joint: {between: [base.top, block.bottom], friction: 0.3}}
""", encoding="utf-8")
        self.assertEqual(scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet").returncode, 2)
        picture = arrays_of(self.directory / "results" / "mechanism.vtu")
        lengths = [end - start for start, end in zip([0, *picture["offsets"]], picture["offsets"])]
        self.assertEqual(sorted(set(zip(picture["types"], lengths))), [(9, 4), (25, 20)])
        of_cell = [list(picture["connectivity"][end - 20:end]) for kind, end in zip(picture["types"], picture["offsets"]) if kind == 25]
        points = picture["Points"] if "Points" in picture else picture["points"]
        for cell in of_cell:  # node 9 lies between the first two corners
            first, second, middle = (points[3 * node:3 * node + 3] for node in (cell[0], cell[1], cell[8]))
            self.assertEqual([(a + b) / 2 for a, b in zip(first, second)], list(middle))

    def test_hexahedra_and_wedges_of_a_file(self):
        """The good file with every kind of cell: forces balance, and the mesh file keeps its cells."""
        done = scabo("run", ROOT / "tests" / "input" / "good" / "hexahedra_in_space.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = summary_of(self.directory / "results")
        self.assertEqual([warning for warning in summary["warnings"] if "do not determine body" not in warning], [])  # all are loose
        bodies = {body["name"]: body for body in summary["model"]["bodies"]}
        self.assertEqual(bodies["stack"]["super_elements"], 2)
        self.assertEqual(bodies["block"]["super_elements"], 0)
        types = arrays_of(self.directory / "results" / "fields_0001.vtu")["types"]
        self.assertEqual(set(types), {24, 25, 26})


if __name__ == "__main__":
    support.main()
