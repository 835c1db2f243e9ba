"""The checked numbers of examples/05_edge_crack, 06_ground and 07_corner."""
import json
import math

import support
from support import ROOT, scabo, summary_of

EXAMPLES = ROOT / "examples"


class Examples(support.InTemporaryDirectory):
    def solve(self, model, *settings):
        arguments = [word for setting in settings for word in ("--set", setting)]
        run = scabo("run", model, "-o", self.directory / "results", "--quiet", *arguments)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
        return summary_of(self.directory / "results")


class EdgeCrack(Examples):
    MODEL = EXAMPLES / "05_edge_crack" / "model.yaml"
    CHECK = json.loads((MODEL.parent / "check.json").read_text(encoding="utf-8"))

    def test_stress_intensity_factors(self):
        for case in self.CHECK["factors"]:
            h, a = case["h"], case["a"]
            summary = self.solve(self.MODEL, f"bodies.plate.shape.rectangle.size=[1, {2 * h}]",
                                 f"bodies.plate.cracks=[{{tip: [{a}, {h}], mouth: [0, {h}], name: flaw}}]")
            crack = summary["increments"][-1]["cracks"]["plate.flaw"]
            factor = crack["K_I"] / (1e6 * math.sqrt(math.pi * a))
            self.assertAlmostEqual(factor / case["factor"], 1.0, delta=self.CHECK["relative_tolerance"])
            self.assertLess(abs(crack["K_II"]), 1e-9 * crack["K_I"])
            self.assertAlmostEqual(crack["J"] / crack["G"], 1.0, delta=1e-4)
            self.assertLessEqual(summary["model"]["dofs"], self.CHECK["most_degrees_of_freedom"])

    def test_pressure_in_the_crack_is_as_strong_as_the_pull(self):
        pull = self.solve(self.MODEL)["increments"][-1]["cracks"]["plate.flaw"]["K_I"]
        water = self.solve(self.MODEL, "loads={left: {on: plate.flaw.left, pressure: 1e6}, "
                           "right: {on: plate.flaw.right, pressure: 1e6}}")["increments"][-1]["cracks"]["plate.flaw"]["K_I"]
        self.assertAlmostEqual(water / pull, 1.0, delta=1e-5)

    def test_an_interface_crack_begins_at_a_corner_of_the_outline(self):
        summary = self.solve(
            self.MODEL, "materials.glass={young: 21e9, poisson: 0.3}",
            "bodies.plate.shape={polygon: {vertices: [[0, 0], [1, 0], [1, 1], [1, 2], [0, 2], [0, 1]], names: {bottom: edge_1, "
            "top: edge_4, bottom_right: vertex_2, top_right: vertex_4}}}",
            "bodies.plate.sectors={edge_1: glass, edge_2: glass, edge_6: glass}")
        crack = summary["increments"][-1]["cracks"]["plate.flaw"]
        self.assertEqual(crack["kind"], "interface_crack")
        # E1 / E2 = 10, nu = 0.3, plane strain (VERIFICATION: 0.0758118)
        self.assertAlmostEqual(abs(crack["epsilon"]), 0.0758118, delta=1e-7)


class Ground(Examples):
    MODEL = EXAMPLES / "06_ground" / "model.yaml"

    def test_forces_in_the_joint_balance_the_loads(self):
        summary = self.solve(self.MODEL)
        self.assertEqual(len(summary["increments"]), 5)
        seat = summary["increments"][-1]["contacts"]["seat"]
        self.assertAlmostEqual(seat["normal_force"], 2e6, delta=1e-3)
        self.assertAlmostEqual(abs(seat["tangential_force"]), 0.4e6, delta=1e-3)
        self.assertEqual(seat["open"], 0)

    def test_forces_do_not_depend_on_the_reference(self):
        def forces(*settings):
            self.solve(self.MODEL, *settings)
            return (self.directory / "results" / "contact.csv").read_text().splitlines()[1:]

        near = [float(line.split(",")[8]) for line in forces("bodies.ground.reference=[5, -40]")]
        far = [float(line.split(",")[8]) for line in forces("bodies.ground.reference=[0, -1e6]")]
        for a, b in zip(near, far):
            self.assertAlmostEqual(a, b, delta=1e-6 * 2e6)

    def test_a_reference_above_the_ground_is_refused(self):
        run = scabo("check", self.MODEL, "--set", "bodies.ground.reference=[0, 50]")
        self.assertEqual(run.returncode, 1)
        self.assertIn("does not lie in this body", run.stderr)

    def test_without_reference_a_warning_says_what_is_relative(self):
        run = scabo("run", self.MODEL, "-o", self.directory / "results", "--quiet", "--set", "bodies.ground.reference=null")
        self.assertEqual(run.returncode, 0)
        self.assertIn("reference", run.stderr)


class Corner(Examples):
    MODEL = EXAMPLES / "07_corner" / "model.yaml"

    def test_exponent_and_weight(self):
        summary = self.solve(self.MODEL)
        increments = summary["increments"]
        corner = increments[0]["cracks"]["panel.corner"]
        # 0.61837399 by integration from face to face (tests/verification/converged_numbers.py)
        self.assertAlmostEqual(corner["exponents"][0][0], 0.61837399, delta=1e-6)
        # 2.5 m2 of concrete and 0.5 m2 of laminate, 0.2 m thick
        weight = 9.81 * 0.2 * (2.5 * 2400 + 0.5 * 1900)
        self.assertAlmostEqual(increments[0]["reactions"]["panel.foot"][1], weight, delta=1e-6 * weight)
        # the water: 2e5 Pa on average under 1 m
        self.assertAlmostEqual(increments[1]["reactions"]["panel.foot"][1], weight - 0.2 * 2e5, delta=1e-6 * weight)

    def test_the_corner_of_concrete_alone_is_that_of_williams(self):
        summary = self.solve(self.MODEL, "bodies.panel.sectors={edge_4: concrete}")
        exponents = summary["increments"][0]["cracks"]["panel.corner"]["exponents"]
        self.assertAlmostEqual(exponents[0][0], 0.544483737, delta=1e-6)
        self.assertAlmostEqual(exponents[1][0], 0.90852919, delta=1e-6)


if __name__ == "__main__":
    support.main()
