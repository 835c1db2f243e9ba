"""The checked numbers of examples/12_hertz and 13_brazilian_disc."""
import math

import support


class Hertz(support.OfExample):
    FOLDER = "12_hertz"

    def test_pressure_half_width_and_force_are_those_of_hertz(self):
        check = self.check()
        summary = self.solve()
        pairs = [(float(row["x"]), float(row["pressure"])) for row in support.rows_of(self.directory / "results")]
        inside = [(x * x, pressure * pressure) for x, pressure in pairs if pressure > 0]
        mean_x, mean_p = (sum(column) / len(inside) for column in zip(*inside))
        slope = sum((x - mean_x) * (p - mean_p) for x, p in inside) / sum((x - mean_x)**2 for x, _ in inside)
        self.assertAlmostEqual((mean_x - mean_p / slope)**0.5 / check["half_width"], 1.0, delta=check["relative_tolerance_of_half_width"])
        self.assertAlmostEqual(max(p for _, p in pairs) / check["pressure"], 1.0, delta=check["relative_tolerance_of_pressure"])
        self.assertAlmostEqual(summary["increments"][-1]["reactions"]["block.bottom"][1] / 1e6, 1.0,
                               delta=check["relative_tolerance_of_force"])


class BrazilianDisc(support.OfExample):
    FOLDER = "13_brazilian_disc"

    def test_stress_intensity_factors_are_those_of_dislocations(self):
        check = self.check()
        for kind in ("polygons", "quadtree"):
            for case in check["cases"]:
                with self.subTest(kind=kind, **case):
                    a, angle = 0.05 * case["a_over_R"], math.radians(case["angle"])
                    x, y = a * math.sin(angle), a * math.cos(angle)
                    near = ", ".join(f"{{near: [{s * x:.15g}, {s * y:.15g}], size: 0.005}}" for s in (-1, 1))
                    summary = self.solve(f"bodies.disc.cracks.0.path=[[{-x:.15g}, {-y:.15g}], [{x:.15g}, {y:.15g}]]",
                                         f"bodies.disc.mesh.refine=[{near}]", f"bodies.disc.mesh.kind={kind}")
                    unit = 20e3 / (math.pi * 0.05 * 0.02) * math.sqrt(math.pi * a)
                    for tip in summary["increments"][-1]["cracks"].values():
                        self.assertAlmostEqual(tip["K_I"] / unit, case["N_I"], delta=check["absolute_tolerance"])
                        self.assertAlmostEqual(abs(tip["K_II"]) / unit, case["N_II"], delta=check["absolute_tolerance"])


if __name__ == "__main__":
    support.main()
