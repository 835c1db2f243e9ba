"""The report of a model in space in headless Chromium: values at points that are clicked, also on sections, are those of the closed form, bodies
can be turned, cut and hidden, and contact faces are maps whose pairs light up.

Skipped where there is no Chromium or where the page was not built (no Node.js, no npm)."""
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "regression"))
import matplotlib.image
import numpy as np
import support
from in_browser import InBrowser

YOUNG, POISSON, PRESSURE = 210e9, 0.3, 3e6
MODEL = f"""scabo: 1
title: "</script><script>alert(1)</script>"
analysis: {{space: true}}
materials: {{steel: {{young: {YOUNG}, poisson: {POISSON}}}}}
bodies:
  lower: {{material: steel, shape: {{box: {{corner: [0, 0, 0], size: [1, 0.8, 0.3]}}}}, mesh: {{size: 0.34}}}}
  upper: {{material: steel, shape: {{box: {{corner: [0, 0, 0.3], size: [1, 0.8, 0.2]}}}}, mesh: {{size: 0.5}}}}
supports:
  - {{on: lower.bottom, fix: z, name: ground}}
  - {{on: lower.left, fix: x}}
  - {{on: lower.front, fix: y}}
  - {{on: upper.left, fix: x}}
  - {{on: upper.front, fix: y}}
loads: {{press: {{on: upper.top, pressure: {PRESSURE}}}}}
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: 0.2}}}}
steps: [{{name: press, increments: 3}}]
"""
# It slides at 18 degrees, beyond a friction of 0.3; pushed in a second step.
SLIDING = """scabo: 1
analysis: {space: true}
materials: {stone: {young: 10e9, poisson: 0.2, density: 2500}}
bodies:
  ground: {material: stone, shape: {box: {corner: [0, 0, -1], size: [4, 3, 1]}}, mesh: {size: 1}}
  block: {material: stone, shape: {box: {corner: [1, 1, 0], size: [1, 1, 0.5]}}, mesh: {size: 0.5}}
supports: [{on: ground.bottom, fix: [x, y, z]}]
loads:
  weight: {gravity: [0, 0, -10]}
  push: {on: block.left, force: [4000, 0, 0]}
contacts: {joint: {between: [ground.top, block.bottom], friction: 0.3}}
"""
STEPS = "steps: [{name: rest, loads: {weight: 1}}, {name: push, loads: {push: 1}}]\n"
# The same with a stop that is struck, the first of the bodies.
STRUCK = SLIDING.replace("bodies:\n", "bodies:\n  stop: {rigid: true, shape: {box: {corner: [2, 1, 0], size: [0.2, 1, 0.5]}}, mesh: {size: 1}, removed: strike}\n").replace(
    "supports: [", "supports: [{on: stop, fix: [x, y, z]}, ").replace("contacts: {", "contacts: {stopped: {between: [block.right, stop.left]}, ")
CENTRE = np.array([0.5, 0.4, 0.25])
TOP, ON_CUT, BELOW = (0.63, 0.31, 0.5), (0.5, 0.3, 0.17), (0.55, 0.5, 0.3)
MAGNIFICATION = 2e4


def motion(point):
    return -PRESSURE / YOUNG * np.asarray(point) * [-POISSON, -POISSON, 1.0]


class Space(InBrowser):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.folder / "stack.yaml").write_text(MODEL, encoding="utf-8")
        run = support.scabo("run", "stack.yaml", "-q", "--report", cwd=cls.folder, SCABO_PYTHON=sys.executable)
        assert run.returncode == 0, run.stderr
        cls.picture = pathlib.Path(os.environ.get("SCABO_PICTURE", cls.folder / "space.png"))
        tasks = {"increments": (1, 3), "top": list(TOP - CENTRE), "cut": 500, "on_cut": list(ON_CUT - CENTRE), "below": list(BELOW - CENTRE), "pair": 5,
                 "mechanisms": [cls.mechanism_of("sliding", SLIDING), cls.mechanism_of("pushed", SLIDING + STEPS), cls.mechanism_of("struck", STRUCK + STEPS.replace("]", ", {name: strike, loads: {push: 1}}]"))], "magnification": MAGNIFICATION, "moved": list(TOP - CENTRE + MAGNIFICATION * motion(TOP))}
        cls.seen = cls.drive("space.mjs", cls.folder / "stack.report.html", tasks, cls.picture)

    @classmethod
    def mechanism_of(cls, name, text):
        (cls.folder / f"{name}.yaml").write_text(text, encoding="utf-8")
        run = support.scabo("run", f"{name}.yaml", "-q", "--report", cwd=cls.folder, SCABO_PYTHON=sys.executable)
        assert run.returncode == 2, run.stderr
        return str(cls.folder / f"{name}.report.html")

    def near(self, pick, point, factor=1.0, pixels=0.004):
        """Values are those at the point that the page names, which lies where it was clicked."""
        at = np.array(pick["at"])
        self.assertLess(np.linalg.norm(at - point), pixels)
        for key, value in zip(("ux", "uy", "uz"), factor * motion(at)):
            self.assertAlmostEqual(pick["values"][key], value, delta=2e-6 * PRESSURE / YOUNG)
        for key in ("xx", "yy", "zz", "xy", "yz", "xz", "von_mises"):
            expected = factor * PRESSURE * {"zz": -1.0, "von_mises": 1.0}.get(key, 0.0)
            self.assertAlmostEqual(pick["values"][key], expected, delta=2e-6 * PRESSURE)

    def test_there_are_no_errors_and_no_network(self):
        self.assertEqual((self.seen["errors"], self.seen["requests"], self.seen["unlabelled"]), ([], [], []))
        for text in ("Solved and certified", "tetrahedra", "Contact faces", "</script><script>alert(1)</script>"):
            self.assertIn(text, self.seen["text"])

    def test_values_on_the_surface(self):
        for number, pick in zip((1, 3), self.seen["picks"]):
            self.assertTrue(pick["where"].startswith("upper, at ("), pick["where"])
            self.near(pick, TOP, number / 3)
        self.near(self.seen["moved"], TOP)

    def test_values_on_a_section(self):
        for pick, x in ((self.seen["cut"], 0.5), (self.seen["other_side"], 1.0)):  # on the other side the end of the block is seen
            self.assertAlmostEqual(pick["at"][0], x, delta=1e-6)
            self.near(pick, (x, *ON_CUT[1:]))
            self.assertTrue(pick["where"].startswith("lower"), pick["where"])
        self.assertRegex(self.seen["cut_text"], r"x = 0\.5")

    def test_a_hidden_body_is_not_there(self):
        self.assertTrue(self.seen["below"]["where"].startswith("lower"), self.seen["below"])
        self.near(self.seen["below"], BELOW)

    def test_mouse_and_keys_turn_and_move(self):
        first, turned, moved, enlarged, by_key, reset = self.seen["cameras"]
        self.assertAlmostEqual(turned["azimuth"], first["azimuth"] - 20, delta=1e-9)
        self.assertAlmostEqual(turned["elevation"], first["elevation"] + 8, delta=1e-9)
        self.assertEqual(turned["middle"], first["middle"])
        self.assertEqual((moved["azimuth"], moved["elevation"]), (turned["azimuth"], turned["elevation"]))
        self.assertAlmostEqual(np.linalg.norm(np.subtract(moved["middle"], turned["middle"])) * moved["scale"], np.hypot(50, 20), delta=1e-6)
        self.assertGreater(enlarged["scale"], 1.2 * moved["scale"])
        self.assertNotEqual(by_key["azimuth"], enlarged["azimuth"])
        np.testing.assert_allclose(reset["middle"], [0, 0, 0], atol=1e-12)
        self.assertEqual(self.seen["stepped"], 2)

    def test_pairs_light_up(self):
        self.assertEqual((self.seen["pair"]["number"], self.seen["pair"]["ring"]), (5, 1))
        self.assertAlmostEqual(self.seen["pair"]["values"]["pressure"], PRESSURE, delta=2e-6 * PRESSURE)
        self.assertAlmostEqual(self.seen["pair"]["values"]["shear"], 0.0, delta=2e-6 * PRESSURE)

    def test_a_mechanism_is_played(self):
        """Also where no increment was finished. The block, whose points come last, slides along x as it is drawn, the ground stays."""
        for seen, finished, block in zip(self.seen["mechanisms"], (False, True, False), (2, 2, 3), strict=True):
            self.assertIn("1 of 2 bodies moves, 'block'.", seen["note"])
            moved, body = np.reshape(seen["moved"], (-1, 3)), np.array(seen["body"])
            np.testing.assert_allclose(moved, np.where(body[:, None] == block, [1.0, 0.0, 0.0], 0.0), atol=1e-7)
            self.assertAlmostEqual(seen["longest"], 0.2, delta=0.02)  # of a diagonal of 5.2: 0.06 or less
            self.assertEqual(seen["coloured"], [block])
            self.assertEqual(seen["boxes"], int(finished))
            if finished:
                self.assertEqual(seen["fields"][0], seen["fields"][1])
                self.assertEqual(seen["after"], "von_mises")

    def test_the_picture_has_something_in_it(self):
        picture = matplotlib.image.imread(self.picture)[..., :3]
        self.assertGreater(len(np.unique((255 * picture).astype(int).reshape(-1, 3), axis=0)), 20)


if __name__ == "__main__":
    support.main()
