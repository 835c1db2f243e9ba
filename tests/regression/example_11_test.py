"""The checked numbers of examples/11_gravity_dam."""
import json

import support
from support import ROOT, scabo, summary_of

EXAMPLE = ROOT / "examples" / "11_gravity_dam"


class GravityDam(support.InTemporaryDirectory):
    def test_the_joint_carries_weight_and_thrust(self):
        check = json.loads((EXAMPLE / "check.json").read_text(encoding="utf-8"))
        for setting in ("bodies.dam.mesh.elements=superelement", "bodies.ground.mesh.elements=fem"):
            with self.subTest(setting=setting):
                run = scabo("run", EXAMPLE / "model.yaml", "-o", self.directory / "results", "--quiet", "--set", setting)
                self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
                increments = summary_of(self.directory / "results")["increments"]
                weight = check["normal_force"][0]
                for number, normal, tangential in zip((0, 2, 6), check["normal_force"], check["tangential_force"], strict=True):
                    joint = increments[number]["contacts"]["joint"]
                    tolerance = check["relative_tolerance"] * weight
                    self.assertAlmostEqual(joint["normal_force"], normal, delta=tolerance)
                    self.assertAlmostEqual(abs(joint["tangential_force"]), tangential, delta=tolerance)


if __name__ == "__main__":
    support.main()
