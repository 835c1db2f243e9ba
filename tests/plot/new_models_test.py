"""The models of `scabo new`: each runs as it is written, and has a number that is known."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "regression"))
import support

KINDS = ["beam", "dam", "wall", "hertz", "crack", "growth", "earthquake", "axisymmetric", "part3d"]


class NewModels(support.InTemporaryDirectory):
    def solve(self, kind):
        run = support.scabo("new", kind, cwd=self.directory)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn(f"`scabo run {kind}.yaml`", run.stdout)
        run = support.scabo("run", f"{kind}.yaml", "--quiet", cwd=self.directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        summary = support.summary_of(self.directory / f"{kind}.results")
        self.assertTrue(all(support.certificate_of(entry) < 1e-10 for entry in summary["increments"]))
        return summary["increments"]

    def test_beam_has_the_published_forces(self):
        joint = self.solve("beam")[-1]["contacts"]["joint"]
        self.assertAlmostEqual(joint["normal_force"], 53640, delta=10)  # Zhu et al. 2017, SBFEM
        self.assertAlmostEqual(abs(joint["tangential_force"]), 10730, delta=10)

    def test_dam_stands_on_its_weight_against_the_water(self):
        joint = self.solve("dam")[-1]["contacts"]["joint"]
        weight = (4 * 20 + 0.5 * 11 * 16) * 2400 * 9.81
        self.assertAlmostEqual(joint["normal_force"] / weight, 1.0, delta=1e-8)
        self.assertAlmostEqual(abs(joint["tangential_force"]) / (0.5 * 9.81e3 * 18**2), 1.0, delta=1e-8)

    def test_wall_weighs_what_its_stones_do(self):
        x, y = self.solve("wall")[-1]["reactions"]["ground"]
        weight = 3 * 2 * 0.25 * 2300 * 9.81
        self.assertAlmostEqual(y / weight, 1.0, delta=1e-9)
        self.assertAlmostEqual(x / (-0.3 * weight), 1.0, delta=1e-9)

    def test_wall_falls_as_its_comment_says(self):
        self.assertEqual(support.scabo("new", "wall", cwd=self.directory).returncode, 0)
        line = next(line for line in (self.directory / "wall.yaml").read_text().splitlines() if "--set" in line)
        setting = line.split("--set ")[1].split()[0]
        run = support.scabo("run", "wall.yaml", "--quiet", "--set", setting, cwd=self.directory)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertEqual(support.summary_of(self.directory / "wall.results")["status"], "mechanism")

    def test_hertz_has_his_pressure(self):
        modulus = 1 / ((1 - 0.3**2) / 210e9 + (1 - 0.3**2) / 70e9)
        half_width = math.sqrt(4 * 1e6 * 0.05 / (math.pi * modulus))
        pressure = 2 * 1e6 / (math.pi * half_width)
        touch = self.solve("hertz")[-1]["contacts"]["touch"]
        self.assertAlmostEqual(touch["max_pressure"] / pressure, 1.0, delta=5e-3)
        self.assertGreaterEqual(touch["normal_force"], 1e6 * (1 - 1e-9))  # along normals that lean by up to a / R
        self.assertLessEqual(touch["normal_force"], 1e6 / math.cos(1.05 * half_width / 0.05))

    def test_crack_has_the_factor_of_the_handbook(self):
        factors = self.solve("crack")[-1]["cracks"]["plate.flaw"]
        self.assertAlmostEqual(factors["K_I"] / (2.8255 * 1e6 * math.sqrt(math.pi * 0.5)), 1.0, delta=1e-4)
        self.assertLess(abs(factors["K_II"]), 1e-6 * factors["K_I"])

    def test_part_in_space_is_held_by_friction_as_its_comment_says(self):
        last = self.solve("part3d")[-1]
        normal, tangential = last["contacts"]["joint"]["normal_force"], last["contacts"]["joint"]["tangential_force"]
        self.assertAlmostEqual(normal[2] / (4e6 * math.pi * 0.1**2), 1.0, delta=1e-3)  # the area of the mesh
        self.assertAlmostEqual(tangential[0] / normal[2], -0.25, delta=1e-9)
        self.assertAlmostEqual(last["reactions"]["ground"][2] / normal[2], 1.0, delta=1e-9)
        run = support.scabo("run", "part3d.yaml", "--quiet", "--set", "loads.push.traction.0=1.3e6", cwd=self.directory)
        self.assertEqual(run.returncode, 2, run.stderr)

    def test_growth_needs_the_moment_of_beam_theory(self):
        increments = self.solve("growth")
        moment = math.sqrt(200e9 / (1 - 0.3**2) * 1e3 * 0.1**3 / 12)
        self.assertEqual(len(increments), 11)
        for entry in increments:
            self.assertAlmostEqual(entry["growth"]["load_factor"] * 1e3 / moment, 1.0, delta=1e-3)

    def test_earthquake_leaves_the_block_at_rest_on_its_weight(self):
        increments = self.solve("earthquake")
        end, weight = increments[-1], 6 * 8 * 2400 * 9.81
        self.assertAlmostEqual(end["time"], 1.5, delta=1e-12)
        self.assertAlmostEqual(end["contacts"]["joint"]["normal_force"] / weight, 1.0, delta=1e-5)
        for entry in increments[1:8]:  # before it slips, the ground pushes it sideways only
            self.assertAlmostEqual(entry["contacts"]["joint"]["normal_force"] / weight, 1.0, delta=1e-3)
        energy = end["energy"]
        spent = sum(energy[kind] for kind in
                    ("kinetic", "elastic", "friction", "damping", "impact", "projection", "massless"))
        self.assertAlmostEqual(spent / energy["external"], 1.0, delta=1e-9)
        self.assertGreater(energy["friction"], 0.9 * energy["external"])
        self.assertLess(energy["kinetic"], 1e-6 * energy["external"])

    def test_axisymmetric_has_lames_pressure_and_is_pushed_off_by_its_friction(self):
        increments = self.solve("axisymmetric")
        rows = support.rows_of(self.directory / "axisymmetric.results")
        middle = min((row for row in rows if row["step"] == "1"), key=lambda row: abs(float(row["y"]) - 0.08))
        self.assertAlmostEqual(float(middle["pressure"]) / 63e6, 1.0, delta=5e-3)
        fit, push = increments[-1]["contacts"]["fit"], increments[-1]["reactions"]["push"]
        self.assertAlmostEqual(push[1] / (0.15 * fit["normal_force"]), 1.0, delta=1e-8)
        self.assertEqual(fit["stick"], 0)

    def test_a_file_that_exists_is_kept(self):
        file = self.directory / "beam.yaml"
        file.write_text("mine")
        run = support.scabo("new", "beam", cwd=self.directory)
        self.assertEqual((run.returncode, run.stdout), (1, ""))
        self.assertIn("beam.yaml: exists: remove it, or name another file with -o", run.stderr)
        self.assertEqual(file.read_text(), "mine")
        run = support.scabo("new", "beam", "-o", "other.yaml", cwd=self.directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("other.yaml", run.stdout)

    def test_the_schema_for_editors_is_beside_it(self):
        for folder in ("", "folder"):
            with self.subTest(folder=folder):
                (self.directory / folder).mkdir(exist_ok=True)
                run = support.scabo("new", "dam", "-o", pathlib.Path(folder, "dam.yaml"), cwd=self.directory)
                self.assertEqual(run.returncode, 0, run.stderr)
                model, schema = (self.directory / folder / name for name in ("dam.yaml", "model.schema.json"))
                first = model.read_text(encoding="utf-8").splitlines()[0]
                self.assertEqual(first, "# yaml-language-server: $schema=" + schema.name)
                self.assertEqual(schema.read_text(encoding="utf-8"), support.scabo("schema").stdout)
        schema.write_text("mine")
        run = support.scabo("new", "beam", "-o", "folder/beam.yaml", cwd=self.directory)
        self.assertEqual((run.returncode, schema.read_text()), (0, "mine"))

    def test_mistakes(self):
        run = support.scabo("new", "bridge", cwd=self.directory)
        self.assertEqual(run.returncode, 1)
        self.assertIn("'bridge' is none of " + ", ".join(KINDS), run.stderr)
        run = support.scabo("new", "beam", "-o", "nowhere/beam.yaml", cwd=self.directory)
        self.assertEqual(run.returncode, 3)
        self.assertIn("No such file or directory", run.stderr)


if __name__ == "__main__":
    support.main()
