"""The flange with bolts of docs/practice.md: its model is the one of the page; every number of its table by hand and from the run."""
import re

import support
from support import ROOT, scabo, summary_of

PAGE = (ROOT / "docs" / "practice.md").read_text(encoding="utf-8")
PRELOAD, PULL, BOLT, WALL = 365e3, 150e3, 75e-3, 10e-3  # N, m


class Flange(support.InTemporaryDirectory):
    def test_the_joint_has_what_balance_leaves(self):
        section = PAGE[PAGE.index("## Flange with bolts"):]
        model = self.directory / "model.yaml"
        model.write_text(re.search(r"```yaml\n(.*?)```", section, re.DOTALL)[1], encoding="utf-8")
        run = scabo("run", model, "--quiet", "-o", self.directory / "results", "--set", "output.fields=[]")
        self.assertEqual(run.returncode, 0, run.stderr)
        increments = summary_of(self.directory / "results")["increments"]
        tight, last = increments[0], increments[-1]
        joints = [increment["contacts"]["joint"] for increment in (tight, last)]
        tension = last["bars"]["bolt"]["tension"]
        joint = tension - PULL
        rows = [("tightened: normal force of the joint, kN", 1e-3 * PRELOAD, 1e-3 * joints[0]["normal_force"], 4),
                ("tightened: its centre from the outside, mm", 1e3 * BOLT, 1e3 * joints[0]["centre_of_pressure"][0], 4),
                ("pulled: normal force of the joint, kN", 1e-3 * joint, 1e-3 * joints[1]["normal_force"], 4),
                ("pulled: its centre from the outside, mm", 1e3 * (BOLT * tension - WALL * PULL) / joint,
                 1e3 * joints[1]["centre_of_pressure"][0], 4)]
        lines = PAGE.splitlines()
        for what, by_hand, by_run, digits in rows:
            self.assertAlmostEqual(by_run / by_hand, 1.0, delta=1e-9, msg=what)
            self.assertIn(f"| {what} | {by_hand:.{digits}f} | {by_run:.{digits}f} |", lines)
        self.assertIn(f"| pulled: tension of the bolt, kN | more than {1e-3 * PRELOAD:.0f} | {1e-3 * tension:.2f} |", lines)
        self.assertGreater(tension, PRELOAD)
        self.assertGreater(joints[1]["open"], joints[0]["open"])
        energy = tight["energy"]
        self.assertAlmostEqual(energy["external"], energy["elastic"] + energy["friction"], delta=1e-6 * energy["elastic"] + energy["friction_error"])


if __name__ == "__main__":
    support.main()
