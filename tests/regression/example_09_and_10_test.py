"""The checked numbers of examples/09_plate_with_hole and 10_culvert."""
import csv

import support


class PlateWithHole(support.OfExample):
    FOLDER = "09_plate_with_hole"

    def test_the_stress_at_the_hole_is_howlands(self):
        check = self.check()
        for kind in ("polygons", "quadtree"):
            with self.subTest(kind=kind):
                self.solve(f"bodies.plate.mesh.kind={kind}")
                with open(self.directory / "results" / "points.csv", newline="", encoding="utf-8") as file:
                    factor = float(next(csv.DictReader(file))["stress_xx"]) / 100e6
                self.assertAlmostEqual(factor / check["howland"], 1.0, delta=check["relative_tolerance_of_howland"])
                self.assertAlmostEqual(factor / check["converged"], 1.0, delta=check["relative_tolerance"])


class Culvert(support.OfExample):
    FOLDER = "10_culvert"

    def test_weight_traffic_and_pressure(self):
        check = self.check()
        for kind in ("quadtree", "polygons"):
            with self.subTest(kind=kind):
                summary = self.solve(f"bodies.ground.mesh.kind={kind}")
                for increment, base in zip(summary["increments"], check["base"], strict=True):
                    self.assertAlmostEqual(increment["reactions"]["ground.base"][1] / base, 1.0,
                                           delta=check["relative_tolerance_of_base"])
                if kind == "quadtree":
                    pressure = summary["increments"][-1]["contacts"]["wall"]["max_pressure"]
                    self.assertAlmostEqual(pressure / check["pressure"], 1.0, delta=check["relative_tolerance_of_pressure"])


if __name__ == "__main__":
    support.main()
