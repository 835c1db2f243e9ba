"""The checked numbers of examples/02_natural_frequencies (check.json there names their source), and what a modal analysis
writes and says."""
import json
import xml.etree.ElementTree

import support
from support import ROOT, scabo, summary_of

EXAMPLE = ROOT / "examples" / "02_natural_frequencies"
CHECK = json.loads((EXAMPLE / "check.json").read_text(encoding="utf-8"))


class NaturalFrequencies(support.InTemporaryDirectory):
    def solve(self, *settings, model=EXAMPLE / "model.yaml"):
        arguments = [word for setting in settings for word in ("--set", setting)]
        run = scabo("run", model, "-o", self.directory / "results", "--quiet", *arguments)
        self.assertEqual((run.returncode, run.stdout), (0, ""), run.stderr)
        self.said = run.stderr
        return summary_of(self.directory / "results")

    def test_one_super_element(self):
        summary = self.solve()
        self.assertEqual(len(summary["frequencies"]), 10)
        for found, expected in zip(summary["frequencies"], CHECK["super_element"]["frequencies"]):
            self.assertAlmostEqual(found, expected, delta=CHECK["super_element"]["tolerance"])
        self.assertAlmostEqual(summary["total_mass"], CHECK["total_mass"], places=9)
        first = summary["modes"][0]
        self.assertAlmostEqual(first["effective_mass"][1] / summary["total_mass"],
                               CHECK["effective_mass_of_the_first_mode"], places=3)
        self.assertEqual((first["mode"], first["body"], first["rigid"]), (1, "beam", False))
        self.assertLess(max(mode["residual"] for mode in summary["modes"]), 1e-12)

    def test_finite_elements_come_near_the_converged_frequencies(self):
        expected = CHECK["finite_elements"]
        summary = self.solve(f"bodies.beam.mesh={{kind: fem, size: {expected['size']}}}")
        for found, converged in zip(summary["frequencies"], CHECK["converged"]):
            self.assertAlmostEqual(found / converged, 1.0, delta=expected["relative_tolerance"])

    def test_a_free_beam_has_rigid_body_modes(self):
        summary = self.solve("supports=[]")
        rigid = CHECK["free"]["rigid_modes"]
        self.assertEqual(summary["frequencies"][:rigid], [0.0] * rigid)
        self.assertEqual([mode["rigid"] for mode in summary["modes"]], [True] * rigid + [False] * (10 - rigid))
        self.assertAlmostEqual(summary["frequencies"][rigid], CHECK["free"]["first_elastic"], delta=1e-3)

    def test_every_mode_has_a_file_whose_time_is_its_number(self):
        self.solve()
        results = self.directory / "results"
        collection = xml.etree.ElementTree.parse(results / "fields.pvd")
        times = [(float(entry.get("timestep")), entry.get("file")) for entry in collection.iter("DataSet")]
        self.assertEqual(times, [(float(k), f"fields_{k:04d}.vtu") for k in range(1, 11)])
        self.assertEqual({path.name for path in results.iterdir()},
                         {"summary.json", "log.txt", "fields.pvd"} | {file for _, file in times})
        self.assertIn("32.6085", (results / "log.txt").read_text())
        self.assertEqual(self.said, "")

    def test_what_plays_no_part_is_said(self):
        summary = self.solve("analysis.type=modal", "materials.concrete.density=2400", model=support.BEAM)
        self.assertEqual(summary["warnings"], ["a modal analysis ignores the model's loads, contacts and steps: each "
                                               "body vibrates by itself"])
        self.assertIn(summary["warnings"][0], self.said)

    def test_check_names_the_analysis(self):
        run = scabo("check", EXAMPLE / "model.yaml")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("Modal analysis: the lowest 10 modes.", run.stdout)


if __name__ == "__main__":
    support.main()
