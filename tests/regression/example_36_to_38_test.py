"""The checked numbers of examples/36_wing_cracks, 37_heel_crack and 38_fatigue_at_a_hole."""
import math

import support


class WingCracks(support.OfDrawnExample):
    FOLDER = "36_wing_cracks"

    def test_wings_turn_towards_the_load(self):
        check = self.check()
        summary = support.summary_of(self.drawn_in / "wing_cracks.results")
        states = [increment["growth"] for increment in summary["increments"]]
        self.assertAlmostEqual(states[0]["load_factor"] / check["first_load"], 1, delta=check["relative_tolerance_of_first_load"])
        for tip in states[0]["tips"].values():
            self.assertAlmostEqual(math.degrees(tip["kink"]), check["first_kink"], delta=0.1)
        self.assertAlmostEqual(states[-1]["load_factor"] / check["last_load"], 1, delta=check["relative_tolerance"])
        path = summary["growth"]["paths"]["plate.flaw"]
        angles = [math.degrees(math.atan2(abs(x - at), y - before)) for (at, before), (x, y) in zip(path, path[1:])]
        wing = angles[len(angles) // 2 + 1:]
        self.assertTrue(all(after < before + 0.5 for before, after in zip(wing, wing[1:])), wing)
        self.assertAlmostEqual(wing[-1], check["last_angle"], delta=check["tolerance_of_angle"])


class HeelCrack(support.OfDrawnExample):
    FOLDER = "37_heel_crack"

    def test_where_and_when(self):
        for run in self.check()["runs"]:
            summary = support.summary_of(self.drawn_in / f"heel_crack_{run['name']}.results")
            states = [increment["growth"] for increment in summary["increments"] if "growth" in increment]
            self.assertAlmostEqual(states[0]["load_factor"], run["first"], delta=run["tolerance"])
            self.assertAlmostEqual(states[-1]["load_factor"], run["last"], delta=run["tolerance"])
            self.assertLess(math.dist(summary["growth"]["paths"]["dam.crack"][-1], run["tip"]), run["tolerance_of_tip"])


class FatigueAtAHole(support.OfDrawnExample):
    FOLDER = "38_fatigue_at_a_hole"

    def test_cycles(self):
        check = self.check()
        last = support.summary_of(self.drawn_in / "fatigue.results")["increments"][-1]["growth"]
        self.assertAlmostEqual(last["cycles"] / check["cycles"], 1, delta=check["relative_tolerance"])
        for tip in last["tips"].values():
            self.assertAlmostEqual(tip["length"], 0.008, delta=1e-9)


if __name__ == "__main__":
    support.main()
