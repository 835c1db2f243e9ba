"""Examples 17 to 21, 23 to 28, 32 to 34, 39 to 44 and docs/practice.md: every number of their tables, by hand and from the run; the loads at which things
slide; the closed forms behind the hand calculations."""
import importlib.util
import json

import support
from support import ROOT, scabo, summary_of

PAGE = ROOT / "docs" / "practice.md"


def hand_of(folder):
    """The module hand.py of an example."""
    specification = importlib.util.spec_from_file_location(f"hand_{folder}", ROOT / "examples" / folder / "hand.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


class Practice(support.InTemporaryDirectory):
    def history(self, folder, settings):
        """Rows of history.csv as numbers."""
        key = (folder, tuple(settings))
        if key not in self.runs:
            directory = self.directory / f"run_{len(self.runs)}"
            run = self.run_scabo(folder, directory, settings)
            self.assertEqual(run.returncode, 0, run.stderr)
            lines = (directory / "history.csv").read_text(encoding="utf-8").splitlines()
            names = lines[0].split(",")
            self.runs[key] = [dict(zip(names, (float(cell or "nan") for cell in line.split(",")))) for line in lines[1:]]
            self.cracks[key] = summary_of(directory)["increments"][-1].get("cracks", {})
        return self.runs[key]

    def value(self, folder, run):
        """What a row compares: a number of history.csv, or the stress intensity factor of a crack after the last increment."""
        rows = self.history(folder, run.get("settings", []))
        if "crack" in run:
            return self.cracks[folder, tuple(run.get("settings", []))][run["crack"]]["K_I"]
        values = rows[run["row"]]
        return run.get("times", 1) * values[run["column"]] / (values[run["over"]] if "over" in run else 1) + run.get("plus", 0)

    def run_scabo(self, folder, directory, settings, model="model.yaml"):
        arguments = [word for setting in settings for word in ("--set", setting)]
        return scabo("run", ROOT / "examples" / folder / model, "-o", directory, "--quiet", *arguments,
                     "--set", "output.fields=[]")

    def check(self, folder, page=PAGE):
        self.runs, self.cracks, self.limits = {}, {}, {}
        example = ROOT / "examples" / folder
        self.assertLess(len((example / "model.yaml").read_text(encoding="utf-8").splitlines()), 60)
        table, numbers = json.loads((example / "check.json").read_text(encoding="utf-8")), hand_of(folder).calculate()
        written = []
        for row in table["rows"]:
            run, scale, digits = row["run"], row["scale"], row["digits"]
            value, hand = self.value(folder, run), numbers[row["hand"]]
            if row["relative_tolerance"] is not None:
                self.assertLess(abs(value / hand - 1), row["relative_tolerance"], row["quantity"])
            cells = ([numbers[row["also"]]] if "also" in row else []) + [hand, value]
            written.append(f"| {row['quantity']} | " + " | ".join(f"{scale * cell:.{digits}f}" for cell in cells) + " |")
        for limit in table.get("limits", []):
            hand, stands, slides = numbers[limit["hand"]], limit["stands"], limit["slides"]
            self.assertTrue(min(stands, slides) < hand < max(stands, slides), limit["quantity"])
            for value, status in ((stands, 0), (slides, 2)):
                run = self.run_scabo(folder, self.directory / "limit", [f"{limit['parameter']}={value}"])
                self.assertEqual(run.returncode, status, run.stderr)
                self.assertEqual("mechanism" in run.stderr, status == 2, run.stderr)
            written.append(f"| {limit['quantity']} | {hand:.{limit['digits']}f} | stands at {stands:g}, slides at {slides:g} |")
        for bracket in table.get("brackets", []):
            directory = self.directory / "bracket"
            run = self.run_scabo(folder, directory, [])
            self.assertEqual(run.returncode, 0, run.stderr)
            limit, hand, digits = summary_of(directory)["limit"], numbers[bracket["hand"]], bracket["digits"]
            self.assertLessEqual(limit["solved"], hand, bracket["quantity"])
            self.assertLessEqual(hand, limit["beyond"], bracket["quantity"])
            self.assertLess(limit["beyond"] / limit["solved"] - 1, 1.05e-3)
            self.limits[folder] = limit
            written.append(f"| {bracket['quantity']} | {hand:.{digits}f} | {limit['solved']:.{digits}f} to {limit['beyond']:.{digits}f} |")
        for page in (example / "README.md", page):
            lines = page.read_text(encoding="utf-8").splitlines()
            for row in written:
                self.assertIn(row, lines, page)

    def test_dam(self):
        self.check("17_dam_sliding")

    def test_retaining_wall(self):
        self.check("18_retaining_wall")
        # What the hand calculation assumes is the height of the thrust: with that of the run, statics give the run's centre.
        hand, last = hand_of("18_retaining_wall"), self.history("18_retaining_wall", [])[-1]
        self.assertAlmostEqual(last["centre"] + 2.0, hand.centre(last["thrust"], last["height"]), delta=1e-9)

    def test_press_fit(self):
        self.check("19_press_fit")

    def test_push_out(self):
        self.check("23_push_out")

    def test_lap_joint(self):
        self.check("20_lap_joint")

    def test_tunnel_lining(self):
        self.check("21_tunnel_lining")

    def test_masonry_arch(self):
        self.check("40_masonry_arch")

    def test_dam_strength(self):
        self.check("41_dam_strength")

    def test_heated_hub(self):
        self.check("42_heated_hub")

    def test_sheet_pile(self):
        """After the excavation both sides and the foot balance, and all of what stands behind the wall has fallen towards the active thrust."""
        self.check("43_sheet_pile")
        rows = self.history("43_sheet_pile", [])
        for row in rows[1:]:
            self.assertLess(row["back"], 648e3)
            self.assertGreater(row["head"], 0)
        self.assertAlmostEqual((rows[-1]["back"] - rows[-1]["front"] + rows[-1]["foot"]) / 648e3, 0, delta=1e-9)

    def test_tilted_wall(self):
        """Head joints carry next to no friction, so that the wall falls below the limit of joints that dilate."""
        self.check("44_tilted_wall")
        self.assertLess(self.limits["44_tilted_wall"]["beyond"], 0.98 * hand_of("44_tilted_wall").calculate()["dilating"])

    def test_cracked_slab(self):
        self.check("24_cracked_slab")
        for row in self.history("24_cracked_slab", [])[1:]:
            self.assertLess(row["middle"], 0)  # the soil presses everywhere
        half = self.cracks["24_cracked_slab", ()]["slab.tip"]["K_I"]
        two_gauges = "loads.sun.temperature={over: y, at: [0, 0.25], values: [2, 9]}"
        for settings, factor in (([two_gauges], half), ([], 0.325e6)):
            directory = self.directory / "whole"
            run = self.run_scabo("24_cracked_slab", directory, settings, "whole.yaml")
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            whole = summary_of(directory)["increments"][-1]["cracks"]["slab.flaw.end"]["K_I"]
            self.assertAlmostEqual(whole / factor, 1, delta=1e-3)


    def test_sled_test(self):
        readme = ROOT / "examples" / "25_sled_test" / "README.md"
        self.check("25_sled_test", page=readme)
        forces = [row["force"] for row in self.history("25_sled_test", [])]
        self.assertEqual((forces.index(max(forces)), forces.index(min(forces))), (6, 29))

    def test_shaken_block(self):
        self.check("26_shaken_block", page=ROOT / "examples" / "26_shaken_block" / "README.md")
        self.assertLess(abs(self.history("26_shaken_block", ["parameters.friction=0.6"])[-1]["moved"]), 1e-8)

    def test_shaken_wall(self):
        """All stones above the damp course move as one, and those below it stay."""
        self.check("27_shaken_wall", page=ROOT / "examples" / "27_shaken_wall" / "README.md")
        rows = self.history("27_shaken_wall", [])
        for row in rows:
            self.assertLess(abs(row["top"] - row["upper"]), 1e-9)
            self.assertLess(abs(row["lower"]), 1e-9)

    def test_koyna(self):
        """At the end nothing slides any more, and the lift joint is closed."""
        self.check("28_koyna", page=ROOT / "examples" / "28_koyna" / "README.md")
        rows = self.history("28_koyna", [])
        self.assertLess(max(abs(row["base.ux"] - rows[-1]["base.ux"]) for row in rows[160:]), 1e-4)
        self.assertLess(abs(rows[-1]["lift.uy"]), 1e-9)

    def test_bar_impact(self):
        """Before and after the impact the wall takes nothing; until the front comes back the force is within 1 %."""
        self.check("29_bar_impact", page=ROOT / "examples" / "29_bar_impact" / "README.md")
        hand = hand_of("29_bar_impact")
        for row in self.history("29_bar_impact", []):
            if row["time"] < hand.TOUCHES or hand.TOUCHES + 1e-5 < row["time"] < 4.2e-4 or row["time"] > hand.LEAVES:
                self.assertAlmostEqual(row["force"], hand.force(row["time"]), delta=0.01 * hand.calculate()["force"])

    def test_cracked_plate_under_a_wave(self):
        """Before the wave comes the tip is at rest."""
        self.check("39_cracked_plate_under_a_wave", page=ROOT / "examples" / "39_cracked_plate_under_a_wave" / "README.md")
        rows = self.history("39_cracked_plate_under_a_wave", [])
        self.assertLess(max(abs(row["K_I"]) for row in rows[:18]), 1e-2 * rows[-1]["K_I"])

    def test_press_fit_of_revolution(self):
        self.check("32_press_fit_of_revolution", page=ROOT / "examples" / "32_press_fit_of_revolution" / "README.md")

    def test_indentation(self):
        """The rows of the ball: half-space and layer by hand, and the run of ball.yaml."""
        readme = ROOT / "examples" / "33_indentation" / "README.md"
        self.check("33_indentation", page=readme)
        hand, directory = hand_of("33_indentation"), self.directory / "ball"
        run = self.run_scabo("33_indentation", directory, [], "ball.yaml")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        lines = readme.read_text(encoding="utf-8").splitlines()
        for row in (directory / "history.csv").read_text(encoding="utf-8").splitlines()[1:]:
            number, force = int(row.split(",")[1]), float(row.split(",")[3])
            depth = number / 5 * hand.BALL_DEPTH
            self.assertAlmostEqual(force / hand.ball(depth), 1, delta=1e-2)
            self.assertIn(f"| {1e6 * depth:.0f} | {hand.half_space(depth):.3f} | {hand.ball(depth):.3f} | {force:.3f} |", lines)

    def test_flange(self):
        self.check("34_flange", page=ROOT / "examples" / "34_flange" / "README.md")


class ClosedFormOfTheLining(support.unittest.TestCase):
    """The hand calculation of example 21, independently of Scabo."""

    @classmethod
    def setUpClass(cls):
        cls.hand = hand_of("21_tunnel_lining")

    def test_modes_are_in_equilibrium_and_follow_from_their_displacements(self):
        """Hooke's law and equilibrium of Airy's modes, by differences."""
        hand, step = self.hand, 1e-4
        young, poisson = material = (70.0, 0.27)
        lame, shear = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))
        for mode in range(4):
            of = lambda r: hand.second_term(material, r)[mode]
            r = 1.3
            low, here, high = of(r - step), of(r), of(r + step)
            slope = [(b - a) / (2 * step) for a, b in zip(low, high)]
            ur, ut, rr, rt, tt = here
            strain_r, strain_t, gamma = slope[0], (ur + 2 * ut) / r, slope[1] - ut / r - 2 * ur / r
            volume = lame * (strain_r + strain_t)
            for value, stress in ((volume + 2 * shear * strain_r, rr), (volume + 2 * shear * strain_t, tt), (shear * gamma, rt)):
                self.assertAlmostEqual(value, stress, delta=1e-5)
            self.assertAlmostEqual(slope[2] + 2 * rt / r + (rr - tt) / r, 0, delta=1e-5)
            self.assertAlmostEqual(slope[3] - 2 * tt / r + 2 * rt / r, 0, delta=1e-5)

    def shell(self, slip, thickness):
        """Mean thrust, thrust and moment of cos 2 theta in Fluegge's ring of the radius R, N = D (v' + w) / R + B (w + w'') / R^3
        and M = -B (w + w'') / R^2, in the same ground; w = w0 + w2 cos 2 theta, v = v2 sin 2 theta."""
        hand = self.hand
        (young, nu), (young_lining, nu_lining), r = hand.GROUND, hand.CONCRETE, hand.R
        membrane = young_lining * thickness / (1 - nu_lining**2)
        bending = young_lining * thickness**3 / 12 / (1 - nu_lining**2)
        far_mean, far_second = -hand.P * (1 + hand.K) / 2, hand.P * (1 - hand.K) / 2
        w0 = far_mean / ((membrane + bending / r**2) / r**2 + young / (1 + nu) / r)
        strain, curvature = (1 / r, 2 / r), (-3 / r**2, 0)
        ring = [[membrane * strain[i] * strain[j] + bending * curvature[i] * curvature[j] for j in (0, 1)] for i in (0, 1)]
        c, d = hand.second_term(hand.GROUND, r)[2:]
        rows = [[1, 0, -c[0], -d[0]], [*ring[0], -c[2], -d[2]]]
        if slip:
            rows += [[*ring[1], 0, 0], [0, 0, c[3], d[3]]]
            right = [0, far_second, 0, far_second]
        else:
            rows += [[*ring[1], -c[3], -d[3]], [0, 1, -c[1], -d[1]]]
            right = [0, far_second, -far_second, 0]
        w, v, _, _ = hand.solve(rows, right)
        moment = -bending * curvature[0] * w
        return (membrane + bending / r**2) * w0 / r, membrane * (strain[0] * w + strain[1] * v) - moment / r, moment

    def test_formulas_of_einstein_and_schwartz_are_those_of_a_thin_ring(self):
        for slip in (True, False):
            for thickness in (0.05, 0.3, 0.6):
                result = self.hand.thin_shell(slip, thickness)
                mean, second = ((result["side"][0] + sign * result["crown"][0]) / 2 for sign in (1, -1))
                for value, exact in zip(self.shell(slip, thickness), (mean, second, result["side"][1])):
                    self.assertAlmostEqual(value / exact, 1, delta=1e-9)

    def test_a_thick_ring_becomes_a_thin_one(self):
        for slip in (True, False):
            differences = []
            for thickness in (0.3, 0.03, 0.003):
                thick, thin = self.hand.elasticity(slip, thickness), self.hand.thin_shell(slip, thickness)
                moments = [(result["side"][1] - result["crown"][1]) / 2 for result in (thick, thin)]
                differences.append(max(abs(moments[0] / moments[1] - 1), *(abs(thick[place][0] / thin[place][0] - 1) for place in thick)))
            for difference, bound in zip(differences, (0.083, 0.011, 0.0011)):
                self.assertLess(difference, bound)


if __name__ == "__main__":
    support.main()
