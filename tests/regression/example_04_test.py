"""The checked numbers of examples/04_error_control (check.json there names their source)."""
import csv
import json

import support
from support import ROOT, certificate_of, scabo, summary_of

EXAMPLE = ROOT / "examples" / "04_error_control"
CHECK = json.loads((EXAMPLE / "check.json").read_text(encoding="utf-8"))


def rows(directory, name):
    with open(directory / f"{name}.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class ErrorControl(support.InTemporaryDirectory):
    def solve(self, *settings):
        directory = self.directory / "results"
        arguments = [word for setting in settings for word in ("--set", setting)]
        run = scabo("run", EXAMPLE / "model.yaml", "-o", directory, "--quiet", *arguments)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return directory

    def test_deflection_error_and_passes(self):
        directory = self.solve()
        summary = summary_of(directory)
        increment = summary["increments"][0]
        self.assertLess(certificate_of(increment), 1e-10)
        self.assertLessEqual(increment["error"]["relative_energy_norm"], 1e-3)
        self.assertEqual(list(increment["error"]["bodies"]), ["panel"])
        errors = [step["error"] for step in summary["passes"]]
        self.assertGreater(len(errors), 2)
        self.assertEqual(errors[-1], increment["error"]["relative_energy_norm"])
        self.assertEqual(summary["passes"][-1]["dofs"], summary["model"]["dofs"])
        middle = rows(directory, "points")[0]
        self.assertEqual(middle["name"], "middle")
        self.assertAlmostEqual(float(middle["uy"]), CHECK["deflection"], delta=CHECK["deflection_tolerance"])
        self.assertIn("estimated error", (directory / "log.txt").read_text(encoding="utf-8"))

    def test_section_carries_the_load(self):
        line = rows(self.solve(), "lines")
        y = [float(row["y"]) for row in line]
        def integral(value):
            return sum(0.5 * (y[k + 1] - y[k]) * (value(line[k]) + value(line[k + 1])) for k in range(len(y) - 1))
        normal = integral(lambda row: float(row["stress_xx"]))
        shear = integral(lambda row: float(row["stress_xy"]))
        moment = integral(lambda row: -float(row["stress_xx"]) * float(row["y"]))
        self.assertAlmostEqual(normal, CHECK["section_force"][0], delta=2e-3)
        self.assertAlmostEqual(shear, CHECK["section_force"][1], delta=2e-3)
        self.assertAlmostEqual(abs(moment), CHECK["section_moment"], delta=0.05)

    def test_grid_holds_the_points_inside(self):
        grid = rows(self.solve(), "grid")
        for row in grid:
            x, y = float(row["x"]), float(row["y"])
            self.assertGreaterEqual(y, 44 / 48 * x - 1e-6)
            self.assertLessEqual(y, 44 + 16 / 48 * x + 1e-6)
            self.assertGreater(float(row["energy_density"]), 0)
        self.assertGreater(len(grid), 2400)  # area 1440 / 0.75^2 = 2560


if __name__ == "__main__":
    support.main()
