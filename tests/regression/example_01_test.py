"""The checked numbers of examples/01_double_cantilever (check.json there names their source)."""
import json

import support
from support import BEAM, certificate_of, rows_of, scabo, summary_of

CHECK = json.loads((BEAM.parent / "check.json").read_text(encoding="utf-8"))
JOINT = CHECK["contact"]


class DoubleCantilever(support.InTemporaryDirectory):
    def solve(self, *settings):
        directory = self.directory / "results"
        arguments = [word for setting in settings for word in ("--set", setting)]
        run = scabo("run", BEAM, "-o", directory, "--quiet", *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        return directory

    def test_totals_pairs_iterations_and_certificate(self):
        for expected in CHECK["runs"]:
            with self.subTest(friction=expected["friction"]):
                directory = self.solve(f"contacts.{JOINT}.friction={expected['friction']}")
                increments = summary_of(directory)["increments"]
                self.assertEqual(len(increments), 1)
                increment = increments[0]
                joint = increment["contacts"][JOINT]
                self.assertTrue(increment["converged"])
                self.assertAlmostEqual(joint["normal_force"], expected["normal_force"],
                                       delta=CHECK["force_tolerance"])
                self.assertAlmostEqual(abs(joint["tangential_force"]), expected["tangential_force"],
                                       delta=CHECK["force_tolerance"])
                self.assertLessEqual(increment["newton_iterations"], CHECK["newton_iterations_at_most"])
                self.assertLess(certificate_of(increment), CHECK["certificate_below"])

                states = {int(row["pair"]): row["state"] for row in rows_of(directory)}
                first, last = CHECK["first_in_contact"], CHECK["last_in_contact"]
                self.assertEqual(sorted(states), list(range(1, last + 1)))
                self.assertEqual({pair for pair, state in states.items() if state == "slip"},
                                 set(range(first, last + 1)))
                self.assertEqual({state for pair, state in states.items() if pair < first}, {"open"})
                self.assertEqual((joint["first_pair_in_contact"], joint["last_pair_in_contact"]), (first, last))

    def test_totals_are_the_sums_of_the_pairs(self):
        directory = self.solve()
        joint = summary_of(directory)["increments"][0]["contacts"][JOINT]
        for total in ("normal_force", "tangential_force"):
            self.assertAlmostEqual(sum(float(row[total]) for row in rows_of(directory)), joint[total], delta=1e-3)

    def test_friction_is_mu_times_pressure_wherever_the_pair_slips(self):
        for row in rows_of(self.solve("contacts.joint.friction=0.2")):
            self.assertAlmostEqual(abs(float(row["tangential_force"])), 0.2 * float(row["normal_force"]), delta=1e-3)

    def test_halving_the_size_twice_converges(self):
        refinement = CHECK["refinement"]
        forces = []
        for size in refinement["sizes"]:
            directory = self.solve(*(f"bodies.{body}.mesh.size={size}" for body in ("lower", "upper")))
            increment = summary_of(directory)["increments"][0]
            forces.append(increment["contacts"][JOINT]["normal_force"])
            self.assertLessEqual(increment["newton_iterations"], refinement["newton_iterations_at_most"])
            self.assertLess(certificate_of(increment), CHECK["certificate_below"])
        self.assertAlmostEqual(forces[-1], refinement["normal_force"], delta=CHECK["force_tolerance"])


if __name__ == "__main__":
    support.main()
