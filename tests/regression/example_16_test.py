"""The checked numbers of examples/16_footing."""
import csv
import json
import math

import support
from support import ROOT, scabo, summary_of

EXAMPLE = ROOT / "examples" / "16_footing"


class Footing(support.InTemporaryDirectory):
    CHECK = json.loads((EXAMPLE / "check.json").read_text(encoding="utf-8"))

    def solve(self, *settings):
        arguments = [part for setting in settings for part in ("--set", setting)]
        run = scabo("run", EXAMPLE / "model.yaml", "-o", self.directory / "results", "--quiet", *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        return summary_of(self.directory / "results")

    def test_the_joint_carries_wall_and_wind(self):
        joint = self.solve()["increments"][-1]["contacts"]["seat"]
        tolerance = self.CHECK["relative_tolerance"] * self.CHECK["normal_force"]
        self.assertAlmostEqual(joint["normal_force"], self.CHECK["normal_force"], delta=tolerance)
        self.assertAlmostEqual(joint["tangential_force"], self.CHECK["tangential_force"], delta=tolerance)

    def test_without_friction_it_is_a_rigid_punch(self):
        self.solve("contacts.seat.friction=0", "loads.wind.traction=[0, 0]")
        with open(self.directory / "results" / "contact.csv", newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["step"] == "1" and abs(float(row["x"])) <= 0.61]
        self.assertGreater(len(rows), 15)
        for row in rows:
            punch = self.CHECK["normal_force"] / (math.pi * math.sqrt(1 - float(row["x"]) ** 2))
            self.assertAlmostEqual(float(row["pressure"]) / punch, 1, delta=self.CHECK["relative_tolerance_of_pressure"])


if __name__ == "__main__":
    support.main()
