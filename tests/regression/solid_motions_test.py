"""Bodies in space that nothing holds: the motion of a mechanism, motions that nothing determines, whether forces are unique."""
import csv
import math
import unittest

import support
from support import certificate_of, scabo, summary_of

HEAD = "scabo: 1\nanalysis: {space: true}\nmaterials: {m: {young: 1e9, poisson: 0.2, density: 2000}}\n"
BASE = "  base: {material: m, shape: {box: {corner: [0, 0, -1], size: [4, 3, 1]}}, mesh: {size: 1}}\n"
HELD = "supports: [{on: base.bottom, fix: [x, y, z]}]\n"


class Motions(support.InTemporaryDirectory):
    def run_model(self, text, status):
        """Summary and messages of a run that ends with this exit status."""
        (self.directory / "model.yaml").write_text(HEAD + text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, status, done.stderr)
        return summary_of(self.directory / "results"), done.stderr

    def on_base(self, shape, gravity, friction, status, size=0.5, more=""):
        return self.run_model(f"""bodies:
{BASE}  block: {{material: m, shape: {{{shape}}}, mesh: {{size: {size}}}}}
{HELD}loads: {{weight: {{gravity: {gravity}}}}}
contacts: {{joint: {{between: [base.top, block.{"surface" if "sphere" in shape else "bottom"}], friction: {friction}}}}}
{more}""", status)

    def assert_vector(self, is_, expected, delta):
        for one, other in zip(is_, expected):
            self.assertAlmostEqual(one, other, delta=delta)

    BRICK = "box: {corner: [1, 1, 0], size: [1, 1, 0.5]}"

    def test_a_block_slides_beyond_the_angle_of_friction(self):
        """Gravity is turned instead of the slope; in any direction it slides along its part in the plane."""
        friction = 0.3
        for azimuth in (0.0, 0.7, 3.9):
            for beyond, status in ((0.9999, 0), (1.0001, 2), (1.1, 2)):
                with self.subTest(azimuth=azimuth, beyond=beyond):
                    along = [math.cos(azimuth), math.sin(azimuth), 0.0]
                    summary, told = self.on_base(self.BRICK, [10 * friction * beyond * x for x in along[:2]] + [-10], friction, status)
                    if status == 0:
                        self.assertLess(certificate_of(summary["increments"][-1]), 1e-10)
                        self.assertNotIn("mechanism", summary)
                        continue
                    self.assertIn(summary["status"], ("mechanism", "collapse") if beyond < 1.05 else ("mechanism",))
                    self.assertRegex(told, r"step step_1, increment 1: (mechanism|collapse): .*body 'block': translation along \(")
                    mechanism = summary["mechanism"]
                    self.assertEqual(mechanism["text"], "1 of 2 bodies moves, 'block'")
                    self.assertEqual((mechanism["rule"], mechanism["moving"], mechanism["present"]), ("coulomb", 1, 2))
                    motion = mechanism["bodies"]["block"]
                    self.assert_vector(motion["displacement"], along, 1e-5)
                    self.assert_vector(motion["rotation"], [0, 0, 0], 1e-5)
                    self.assert_vector(motion["of"], [1.5, 1.5, 0.25], 1e-12)
                    self.assertAlmostEqual(mechanism["work"], 2000 * 0.5 * 10 * friction * beyond, delta=1e-3 * 3000)

    def test_a_tall_block_overturns(self):
        """0.5 x 0.5 x 2: it falls where the resultant leaves the base, 0.25 of the weight; pairs in the middle of facets lie a third of one inside."""
        shape = "box: {corner: [1, 1, 0], size: [0.5, 0.5, 2]}"
        self.on_base(shape, [0.2 * 10, 0, -10], 10, 0, size=0.125)
        summary, told = self.on_base(shape, [0.26 * 10, 0, -10], 10, 2, size=0.125)
        self.assertEqual(summary["status"], "mechanism")
        motion = summary["mechanism"]["bodies"]["block"]
        self.assertGreater(motion["rotation"][1], 0.1)
        self.assert_vector([motion["rotation"][0], motion["rotation"][2], motion["displacement"][1]], [0, 0, 0], 1e-6)
        x, _, z = motion["centre"]
        self.assertAlmostEqual(x, 1.5, delta=0.125 / 3 + 1e-6)
        self.assertAlmostEqual(z, 0.0, delta=1e-6)
        self.assertIn("body 'block': rotation about the axis through (", told)
        self.assertIn(" along (0, 1, 0)", told)

    def test_a_loose_ball_flies(self):
        summary, told = self.on_base("sphere: {centre: [2, 1.5, 0.5], radius: 0.5}", [0, 0, 10], 0.3, 2, size=0.25)
        self.assertIn("mechanism: body 'block': translation along (0, 0, 1), held neither by supports nor by contact and friction", told)
        self.assert_vector(summary["mechanism"]["bodies"]["block"]["displacement"], [0, 0, 1], 1e-9)

    def test_a_ball_at_rest_may_turn(self):
        summary, told = self.on_base("sphere: {centre: [2, 1.5, 0.5], radius: 0.5}", [0, 0, -10], 0, 0, size=0.25)
        sentence = "supports, friction and loads do not determine body 'block': "
        self.assertIn(sentence, told)
        at_rest, few = summary["warnings"]
        self.assertIn(sentence, at_rest)
        self.assertRegex(few, "^contact 'joint': only . of [0-9]+ pairs (is|are) in contact at the end, and the mesh is too coarse")
        self.assertIn("warning: step step_1, increment 1: " + sentence, (self.directory / "results" / "log.txt").read_text(encoding="utf-8"))

    def test_a_smooth_block_may_slide(self):
        summary, _ = self.on_base(self.BRICK, [0, 0, -10], 0, 0, more="steps: [{name: press, increments: 3}]\n")
        self.assertEqual(summary["warnings"], ["step press, increment 1: supports, friction and loads do not determine body 'block': translations normal to "
                                               "(0, 0, 1) and rotation about an axis along (0, 0, 1); the smallest such motion was chosen: add a support if the position matters"])

    def test_two_blocks_that_press_each_other_may_go_anywhere(self):
        summary, _ = self.run_model("""bodies:
  a: {material: m, shape: {box: {corner: [0, 0, -1], size: [2, 2, 1]}}, mesh: {size: 1}}
  b: {material: m, shape: {box: {corner: [0, 0, 0], size: [2, 2, 1]}}, mesh: {size: 1}}
loads:
  p: {on: b.top, pressure: 1e5}
  q: {on: a.bottom, pressure: 1e5}
contacts: {joint: {between: [a.top, b.bottom], friction: 0.3}}
output: {points: [{at: [2, 2, 1], name: above}, {at: [0, 1, -1], name: below}]}
""", 0)
        self.assertIn("do not determine body 'a': any motion; body 'b': any motion; the smallest such motion was chosen: add a support", summary["warnings"][0])
        self.assertAlmostEqual(summary["increments"][-1]["contacts"]["joint"]["normal_force"][2], 4e5, delta=1e-3)
        # What is given of the motions is the smallest: that of the deformation about the common centroid.
        with open(self.directory / "results" / "points.csv", encoding="utf-8", newline="") as file:
            points = {row["name"]: [float(row[f"u{axis}"]) for axis in "xyz"] for row in csv.DictReader(file)}
        self.assert_vector(points["above"], [2e-5, 2e-5, -1e-4], 1e-13)
        self.assert_vector(points["below"], [-2e-5, 0, 1e-4], 1e-13)

    def test_blocks_that_are_pulled_apart_and_one_that_stays(self):
        summary, _ = self.run_model(f"""bodies:
{BASE}  b: {{material: m, shape: {{box: {{corner: [1, 1, 0], size: [1, 1, 1]}}}}, mesh: {{size: 1}}}}
  c: {{material: m, shape: {{box: {{corner: [1, 1, 1], size: [1, 1, 1]}}}}, mesh: {{size: 1}}}}
{HELD}loads:
  weight: {{gravity: [0, 0, -10]}}
  lift: {{on: c.top, traction: [0, 0, 3e4]}}
contacts:
  below: {{between: [base.top, b.bottom], friction: 0.3}}
  above: {{between: [b.top, c.bottom], friction: 0.3}}
""", 2)
        self.assertEqual(summary["mechanism"]["text"], "1 of 3 bodies moves, 'c'")
        self.assertEqual(list(summary["mechanism"]["bodies"]), ["c"])

    def test_a_bolt_that_nothing_resists(self):
        summary, told = self.run_model(f"""bodies:
  base: {{material: m, shape: {{box: {{corner: [0, 0, -1], size: [1, 1, 1]}}}}, mesh: {{size: 0.5}}, preload: {{cut: {{point: [0, 0, -0.5], normal: [0, 0, 1]}}, force: 1e3}}}}
{HELD}""", 2)
        self.assertIn("mechanism: bolt 'base' is shortened, held neither by supports nor by contact and friction", told)
        self.assertEqual(summary["mechanism"]["text"], "bolt 'base' is shortened")

    def test_forces_are_unique_with_little_friction(self):
        text = """bodies:
  a: {material: m, shape: {box: {corner: [0, 0, -1], size: [2, 2, 1]}}, mesh: {size: 1}}
  b: {material: m, shape: {box: {corner: [0.25, 0.25, 0], size: [1.5, 1.5, 1]}}, mesh: {size: 0.75}}
supports:
  - {on: a.bottom, fix: [x, y, z]}
  - {on: b.top, displacement: [1e-5, 0, -1e-4]}
contacts: {joint: {between: [a.top, b.bottom], friction: FRICTION}}
solver: {uniqueness: true}
"""
        summary, _ = self.run_model(text.replace("FRICTION", "0.01"), 0)
        unique = summary["increments"][-1]["uniqueness"]
        self.assertEqual((unique["unique"], unique["others"], unique["index"]), ("proven", 0, 1))
        self.assertLess(unique["bound"], 1)
        self.assertIn("unique: proven", (self.directory / "results" / "log.txt").read_text(encoding="utf-8"))
        summary, _ = self.run_model(text.replace("FRICTION", "2"), 0)
        unique = summary["increments"][-1]["uniqueness"]
        self.assertEqual(unique["unique"], "not decided")
        self.assertGreater(unique["bound"], 1)

    def test_an_overlap_that_no_force_removes(self):
        """Nodes on both sides are held along the normal, and free across it."""
        _, told = self.run_model("""bodies:
  a: {material: m, shape: {box: {corner: [0, 0, -1], size: [1, 1, 1]}}, mesh: {size: 1}}
  b: {material: m, shape: {box: {corner: [0, 0, 0], size: [1, 1, 1]}}, mesh: {size: 1}}
supports:
  - {on: a.bottom, fix: [x, y]}
  - {on: b.top, fix: [x, y]}
  - {on: a.top, fix: z}
  - {on: b.bottom, displacement: [null, null, -1e-4]}
contacts: {joint: {between: [a.top, b.bottom], friction: 0.3}}
""", 2)
        self.assertIn("keep an overlap by 0.0001, which no contact force can remove: free one side there", told)

    def test_what_is_beyond_small_strains_and_rotations_is_told_once(self):
        summary, _ = self.run_model("""bodies:
  a: {material: m, shape: {box: {corner: [0, 0, -1], size: [2, 2, 1]}}, mesh: {size: 1}}
  b: {material: m, shape: {box: {corner: [0, 0, 0], size: [2, 2, 1]}}, mesh: {size: 1}}
  lever: {rigid: true, shape: {box: {corner: [5, 0, 0], size: [1, 1, 1]}}, mesh: {size: 1}}
supports:
  - {on: a.bottom, fix: [x, y, z]}
  - {on: b.top, displacement: [0, 0, -0.2]}
  - {on: lever, displacement: [0, 0, 0], rotation: [0, 0.09, 0.09]}
contacts: {joint: {between: [a.top, b.bottom], friction: 0.3}}
steps: [{name: press, increments: 2}]
""", 0)
        self.assertEqual(len(summary["warnings"]), 2, summary["warnings"])
        self.assertRegex(summary["warnings"][0], r"^step press, increment 1: between bodies 'a' and 'b' the pressure reaches \S+, \S+ % of Young's modulus: small strains are assumed$")
        self.assertRegex(summary["warnings"][1], r"^step press, increment 2: body 'lever' turns by 0.127 rad: the theory is valid for rotations of up to 0.1 rad, and normals of contacts and directions of loads do not turn$")

    def test_friction_holds_a_block_that_slides_across_its_way(self):
        """Pushed along x, free along y: without friction its place is not determined, with friction it is."""
        for friction, told in ((0.0, 1), (0.3, 0)):
            with self.subTest(friction=friction):
                summary, _ = self.run_model(f"""bodies:
{BASE}  block: {{material: m, shape: {{{self.BRICK}}}, mesh: {{size: 0.5}}}}
supports:
  - {{on: base.bottom, fix: [x, y, z]}}
  - {{on: block.left, displacement: [1e-3, null, null]}}
loads: {{weight: {{gravity: [0, 0, -10]}}}}
contacts: {{joint: {{between: [base.top, block.bottom], friction: {friction}}}}}
""", 0)
                self.assertEqual(len([text for text in summary["warnings"] if "do not determine body 'block'" in text]), told)
                self.assertEqual(summary["increments"][-1]["contacts"]["joint"]["stick"], 0)

    def test_the_motion_is_drawn(self):
        self.on_base(self.BRICK, [5, 0, -10], 0.3, 2)
        done = scabo("plot", self.directory / "results", "-o", self.directory / "motion.png")
        if done.returncode == 3 and "install NumPy" in done.stderr:
            self.skipTest(done.stderr)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.directory / "motion.mechanism.png").read_bytes().startswith(b"\x89PNG"))
        if not support.SANITIZED:  # there the page of the report is not built
            report = scabo("report", self.directory / "results")
            self.assertEqual(report.returncode, 0, report.stderr)


if __name__ == "__main__":
    support.main()
