"""The checked numbers of examples/08_joint."""
import csv
import json

import support
from support import ROOT, scabo, summary_of

EXAMPLE = ROOT / "examples" / "08_joint"
CHECK = json.loads((EXAMPLE / "check.json").read_text(encoding="utf-8"))


class Joint(support.InTemporaryDirectory):
    def solve(self, *settings, status=0):
        arguments = [word for setting in settings for word in ("--set", setting)]
        run = scabo("run", EXAMPLE / "model.yaml", "-o", self.directory / "results", "--quiet", *arguments)
        self.assertEqual(run.returncode, status, run.stderr)
        return summary_of(self.directory / "results")

    def test_it_breaks_from_the_heel_pair_by_pair(self):
        increments = self.solve()["increments"]
        broken = {round(i["factors"]["water_1"], 9): i["contacts"]["joint"]["broken"] for i in increments}
        for thrust, pairs in CHECK["broken"]:
            self.assertEqual(broken[thrust], pairs, f"thrust {thrust}")
        for increment in increments:
            joint, energy = increment["contacts"]["joint"], increment["energy"]
            self.assertEqual(joint["open"] + joint["stick"] + joint["slip"], CHECK["pairs"])
            self.assertAlmostEqual(joint["normal_force"] / CHECK["weight"], 1.0, delta=1e-9)
            self.assertAlmostEqual(joint["tangential_force"], -increment["factors"]["water_1"] * CHECK["thrust"],
                                   delta=1e-9 * CHECK["thrust"])
            free = energy["external"] - energy["elastic"] - energy["friction"]
            self.assertGreaterEqual(free, -1e-9 * energy["external"])
            if joint["broken"] == 0:  # nothing is lost before
                self.assertAlmostEqual(free, 0.0, delta=1e-9 * energy["external"])
        self.assertEqual(increments[-1]["contacts"]["joint"]["first_pair_in_contact"], CHECK["broken"][-1][1] + 1)
        log = (self.directory / "results" / "log.txt").read_text(encoding="utf-8")
        self.assertIn("friction 0.75, cohesion 800000, tension 100000 until failure", log)

    def test_no_pair_pulls_by_more_than_the_tensile_strength(self):
        self.solve()
        with open(self.directory / "results" / "contact.csv", newline="", encoding="utf-8") as file:
            lowest = min(float(row["pressure"]) for row in csv.DictReader(file))
        self.assertGreaterEqual(lowest, -CHECK["tension"] * (1 + 1e-9))
        self.assertLess(lowest, -0.5 * CHECK["tension"])

    def friction_alone(self, thrust, status):
        factors = ", ".join(f"water_{k}: {thrust}" for k in range(1, 5))
        return self.solve("contacts.joint.cohesion=0", "contacts.joint.tension=0", "steps.1.increments=4",
                          f"steps.1.loads={{weight: 1, {factors}}}", status=status)

    def test_friction_alone_holds_its_coefficient_times_the_weight(self):
        limit = CHECK["collapse_with_friction_alone"]
        self.assertEqual(self.friction_alone(limit * (1 - 1e-4), 0)["status"], "solved")
        summary = self.friction_alone(limit * (1 + 1e-4), 2)
        self.assertEqual(summary["status"], "mechanism")
        self.assertIn("mechanism: body 'dam': translation along (1, 0)", summary["reason"])

    def test_a_weak_joint_fails_in_the_end_as_a_mechanism(self):
        summary = self.solve("contacts.joint.cohesion=0.4e6", "steps.1.increments=30",
                             "steps.1.loads={weight: 1, water_1: 3, water_2: 3, water_3: 3, water_4: 3}", status=2)
        self.assertEqual(summary["status"], "mechanism")
        self.assertIn("mechanism: body 'dam': translation along (1, 0)", summary["reason"])


if __name__ == "__main__":
    support.main()
