"""The checked numbers of the larger examples in space (check.json there names their source)."""
import json
import unittest

import support
from support import ROOT, certificate_of, scabo, summary_of


@unittest.skipIf(support.SANITIZED, "numbers")
class Examples(support.InTemporaryDirectory):
    def run_of(self, name):
        example = ROOT / "examples" / name
        done = scabo("run", example / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        increments = summary_of(self.directory / "results")["increments"]
        for increment in increments:
            self.assertLessEqual(certificate_of(increment), 1e-10)
        return increments, json.loads((example / "check.json").read_text(encoding="utf-8"))

    def assert_within(self, one, other, part):
        self.assertAlmostEqual(one, other, delta=part * abs(other))

    def test_a_bolted_flange(self):
        increments, check = self.run_of("47_bolted_flange_in_space")
        def normal(increment, contact):
            return increment["contacts"][contact]["normal_force"][2]
        for increment in increments:
            tension = increment["preloads"]["bolt"]["force"]
            pulled = check["pull"] * increment["factors"]["pull"]
            self.assert_within(pulled + normal(increment, "raised") + normal(increment, "heel"), tension, 1e-9)
            self.assert_within(normal(increment, "washer"), tension, 1e-9)
            self.assertAlmostEqual(increment["reactions"]["ground"][2], -pulled, delta=1e-9 * tension)
        tightened, pulled = increments[3], increments[-1]
        self.assert_within(tightened["preloads"]["bolt"]["force"], check["preload"], 1e-9)
        self.assert_within(normal(tightened, "heel"), check["heel_when_tightened"], check["relative_tolerance_when_tightened"])
        self.assertEqual(normal(pulled, "raised"), 0)
        self.assert_within(pulled["preloads"]["bolt"]["force"], check["tension"], check["relative_tolerance"])
        self.assert_within(normal(pulled, "heel"), check["heel"], check["relative_tolerance"])

    def test_dam_monoliths(self):
        increments, check = self.run_of("48_dam_monoliths")
        for name in ("left", "middle", "right"):
            base = increments[0]["contacts"][f"base_{name}"]
            self.assert_within(base["normal_force"][2], check["weight"], 1e-9)
        built, filled = increments[0]["contacts"], increments[-1]["contacts"]
        for joint in ("joint_left", "joint_right", "bank_left", "bank_right"):
            self.assertEqual(built[joint]["normal_force"], [0, 0, 0])
        joints = filled["joint_right"]["tangential_force"][0] - filled["joint_left"]["tangential_force"][0]
        base = -filled["base_middle"]["tangential_force"][0]
        self.assert_within(base + joints, check["water"], check["relative_tolerance_of_the_water"])
        self.assertGreater(check["water"], check["friction_of_the_seam"] * check["weight"])  # alone it would slide
        self.assertGreater(joints, check["water"] - check["friction_of_the_seam"] * filled["base_middle"]["normal_force"][2])
        # All of the water, and what balances it.
        names = ("ground", "ground_upstream", "ground_downstream", "left_bank", "right_bank")
        self.assert_within(sum(increments[-1]["reactions"][name][0] for name in names), -3 * (base + joints), 1e-9)


if __name__ == "__main__":
    support.main()
