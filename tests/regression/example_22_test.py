"""The checked numbers of examples/22_ironing."""
import math

import support
from support import certificate_of


class Ironing(support.OfDrawnExample):
    FOLDER = "22_ironing"

    def test_forces_are_smooth_and_pressure_is_that_of_hertz(self):
        check = self.check()
        increments = support.summary_of(self.drawn_in / "ironing.results")["increments"]
        self.assertTrue(all(certificate_of(one) <= 1e-10 for one in increments))
        path = [one["contacts"]["iron"] for one in increments if one["step"] == 2][check["increments_until_it_slides"]:]
        normal, tangential = ([abs(one[key]) for one in path] for key in ("normal_force", "tangential_force"))
        for forces in (normal, tangential):
            self.assertLessEqual(max(forces) - min(forces), check["smooth_to"] * sum(forces) / len(forces))
        for n, t in zip(normal, tangential):
            self.assertAlmostEqual(t / n, check["friction"], delta=check["relative_tolerance_of_friction"] * check["friction"])
        self.assertLessEqual(max(one["pairs_found_anew"]["jump"] for one in increments), check["largest_jump"])
        self.assertGreaterEqual(sum(one["pairs_found_anew"]["times"] for one in increments), 15)

        rows = [row for row in support.rows_of(self.drawn_in / "ironing.results") if row["step"] == "2"]
        for increment, force in enumerate(normal, check["increments_until_it_slides"] + 1):
            pairs = [(float(row["x"]) - path[increment - check["increments_until_it_slides"] - 1]["centre_of_pressure"][0],
                      float(row["pressure"])) for row in rows if row["increment"] == str(increment)]
            inside = [(x * x, p * p) for x, p in pairs if p > 0]
            mean_x, mean_p = (sum(column) / len(inside) for column in zip(*inside))
            slope = sum((x - mean_x) * (p - mean_p) for x, p in inside) / sum((x - mean_x)**2 for x, _ in inside)
            half = math.sqrt(mean_x - mean_p / slope)
            hertz = math.sqrt(4 * force * check["radius"] / (math.pi * check["modulus"]))
            self.assertAlmostEqual(half / hertz, 1, delta=check["relative_tolerance_of_half_width"])
            self.assertAlmostEqual(max(p for _, p in pairs) * math.pi * hertz / (2 * force), 1,
                                   delta=check["relative_tolerance_of_pressure"])


if __name__ == "__main__":
    support.main()
