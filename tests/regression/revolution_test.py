"""Bodies of revolution from the command line: sections and edges of the whole circumference, restarts, sweeps, pictures of both halves and
the fields turned about the axis."""
import csv
import json
import math
import sys

import meshio
import numpy as np
import support
from support import scabo, summary_of

TUBE = """scabo: 1
analysis: {plane: axisymmetric}
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies:
  tube: {material: steel, shape: {rectangle: {corner: [1, 0], size: [1, 2]}}, mesh: {size: 0.25}}
supports: [{on: tube.bottom, fix: y}]
loads: {press: {on: tube.top, pressure: 1e6}}
output: {history: {cut: {section: {from: [0.5, 1], to: [2.5, 1]}}, foot: {edge: tube.bottom}, top: tube.top_right.uy}}
"""
FIT = """scabo: 1
analysis: {plane: axisymmetric}
materials: {steel: {young: 210e9, poisson: 0.3}}
bodies:
  shaft: {material: steel, shape: {rectangle: {corner: [0, 0], size: [0.025, 0.1]}}, mesh: {size: 0.0125}}
  hub: {material: steel, shape: {rectangle: {corner: [0.025, 0.02], size: [0.025, 0.06]}}, mesh: {size: 0.0125}}
supports: [{on: hub.top, fix: y}, {name: push, on: shaft.bottom, displacement: [null, 40e-6]}]
contacts: {fit: {between: [shaft.right, hub.left], friction: 0.15, gap: -20e-6, fit_in: press}}
"""
STEPS = "steps: [{name: press, loads: {push: 0}}, {name: push, increments: 3}]\n"


class Revolution(support.InTemporaryDirectory):
    def solve(self, name, text, *words):
        (self.directory / f"{name}.yaml").write_text(text, encoding="utf-8")
        run = scabo("run", f"{name}.yaml", "--quiet", *words, cwd=self.directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        return summary_of(self.directory / f"{name}.results")["increments"][-1]

    def plot(self, *words, status=0):
        run = scabo("plot", *words, cwd=self.directory, SCABO_PYTHON=sys.executable)
        self.assertEqual(run.returncode, status, run.stderr)
        return run

    def test_sections_and_edges_are_those_of_the_whole_circumference(self):
        self.solve("tube", TUBE)
        with open(self.directory / "tube.results" / "history.csv", newline="", encoding="utf-8") as file:
            row = list(csv.DictReader(file))[-1]
        force = 1e6 * math.pi * (2**2 - 1**2)
        self.assertAlmostEqual(float(row["cut.normal"]) / -force, 1.0, delta=1e-10)
        self.assertAlmostEqual(float(row["foot.force_y"]) / force, 1.0, delta=1e-10)
        self.assertAlmostEqual(float(row["top"]) / (-1e6 * 2 / 210e9), 1.0, delta=1e-10)
        log = (self.directory / "tube.results" / "log.txt").read_text(encoding="utf-8")
        self.assertIn("forces are those of the whole circumference", log)

    def test_every_table_says_whose_forces_these_are(self):
        """Of the whole circumference, or of one radian: contact.csv, history.csv and sweep.csv by a column, the rest by a sentence."""
        output = "output: {history: {force: push.reaction_y}}\n"
        for forces, angle, words in (("whole", 2 * math.pi, "the whole circumference"), ("per_radian", 1.0, "one radian")):
            text = FIT.replace("axisymmetric", f"axisymmetric, forces: {forces}") + STEPS + output
            self.solve(forces, text)
            results = self.directory / f"{forces}.results"
            run = scabo("sweep", f"{forces}.yaml", "--vary", "contacts.fit.friction=0.1", "--quiet", cwd=self.directory)
            self.assertEqual(run.returncode, 0, run.stderr)
            for table in (results / "contact.csv", results / "history.csv", self.directory / f"{forces}.sweep" / "sweep.csv"):
                with open(table, newline="", encoding="utf-8") as file:
                    angles = {float(row["forces_of_radians"]) for row in csv.DictReader(file)}
                self.assertEqual(angles, {angle}, table)
            lines = meshio.read(results / "contact_0001.vtu")
            self.assertEqual(lines.field_data["forces_of_radians"].tolist(), [angle])
            self.assertEqual(summary_of(results)["model"]["forces_of"], words)
            log = (results / "log.txt").read_text(encoding="utf-8")
            self.assertIn(f"forces are those of {words}", log)
            self.assertIn(f"After step push, increment 3, forces of {words}:", log)
        self.solve("plane", TUBE.replace("axisymmetric", "strain").replace("fix: y", "fix: [x, y]"))
        for table in ("contact.csv", "history.csv"):
            self.assertNotIn("radians", (self.directory / "plane.results" / table).read_text(encoding="utf-8"))

    def test_elements_of_the_plane_are_taken_with_a_warning(self):
        """A mesh file with CPS4, as Gmsh writes them; with CAX4 there is no warning, and nothing else differs."""
        model = TUBE.replace("shape: {rectangle: {corner: [1, 0], size: [1, 2]}}, mesh: {size: 0.25}", "mesh: {file: KIND.inp, elements: fem}")
        model = model[:model.index("output")]
        found = {}
        for kind in ("CPS4", "CAX4"):
            (self.directory / f"{kind}.inp").write_text(
                f"*NODE\n1, 1, 0\n2, 2, 0\n3, 2, 2\n4, 1, 2\n*ELEMENT, TYPE={kind}, ELSET=TUBE\n1, 1, 2, 3, 4\n"
                "*SURFACE, NAME=BOTTOM, TYPE=ELEMENT\nTUBE, S1\n*SURFACE, NAME=TOP, TYPE=ELEMENT\nTUBE, S3\n", encoding="utf-8")
            reactions = self.solve(kind, model.replace("KIND", kind).replace("tube.top", "tube.TOP").replace("tube.bottom", "tube.BOTTOM"))["reactions"]
            warnings = summary_of(self.directory / f"{kind}.results")["warnings"]
            found[kind] = (list(reactions.values())[0][1], [text for text in warnings if "half section of a body of revolution" in text])
        self.assertEqual(len(found["CPS4"][1]), 1)
        self.assertEqual(found["CAX4"][1], [])
        self.assertEqual(found["CPS4"][0], found["CAX4"][0])

    def test_springs_on_an_edge_carry_the_whole_circumference(self):
        text = TUBE.replace("supports: [{on: tube.bottom, fix: y}]", "springs: [{name: bed, on: tube.bottom, k_n: 1e9}]")
        self.solve("bed", text.replace("top: tube.top_right.uy", "low: tube.bottom_left.uy, bed: bed.reaction_y"))
        with open(self.directory / "bed.results" / "history.csv", newline="", encoding="utf-8") as file:
            row = list(csv.DictReader(file))[-1]
        self.assertAlmostEqual(float(row["low"]) / -1e-3, 1.0, delta=1e-9)
        self.assertAlmostEqual(float(row["bed"]) / (1e6 * math.pi * 3), 1.0, delta=1e-9)

    def test_a_run_that_goes_on_is_the_whole_run(self):
        begin, end = "{name: press, loads: {push: 0}}, {name: begin, loads: {push: 0.2}}", "{name: push, loads: {push: 1}, increments: 3}"
        whole = self.solve("whole", FIT + f"steps: [{begin}, {end}]\n")
        first = self.solve("first", FIT + f"steps: [{begin}]\n")
        self.assertEqual(first["contacts"]["fit"]["open"], 0)
        second = self.solve("second", FIT.replace(", fit_in: press", "") + f"restart: first.results\nsteps: [{end}]\n")
        for name in ("normal_force", "tangential_force", "max_pressure"):
            self.assertAlmostEqual(second["contacts"]["fit"][name] / whole["contacts"]["fit"][name], 1.0, delta=1e-8)

    def test_sweep(self):
        (self.directory / "fit.yaml").write_text(FIT + STEPS, encoding="utf-8")
        run = scabo("sweep", "fit.yaml", "--vary", "contacts.fit.friction=0.1,0.2", "--quiet", cwd=self.directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        rows = (self.directory / "fit.sweep" / "sweep.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(len(rows), 3)

    def test_both_halves_and_the_whole_body(self):
        """A .vtu of the fit turned about the axis: its volume is that of two bodies with a regular polygon for a circle, and points
        move along their radii."""
        self.solve("fit", FIT + STEPS)
        picture = self.plot("fit.results", "--what", "stress", "--component", "zz", "--mirror", "-o", "hoop.png")
        self.assertEqual(picture.stderr, "")
        self.assertTrue((self.directory / "hoop.png").read_bytes().startswith(b"\x89PNG"))
        sectors = 24
        self.assertEqual(self.plot("fit.results", "--turned", sectors).stdout, "fit.turned.vtu\n")
        mesh = meshio.read(self.directory / "fit.turned.vtu")
        self.assertEqual([block.type for block in mesh.cells], ["wedge"])
        volume = 0.0
        for wedges in (block.data for block in mesh.cells):
            x = mesh.points[wedges]
            for corners in ([0, 1, 2, 5], [0, 1, 5, 4], [0, 4, 5, 3]):
                a, b, c, d = (x[:, k] for k in corners)
                part = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6
                self.assertGreater(part.min(), -1e-20)
                volume += part.sum()
        polygon = sectors * math.sin(2 * math.pi / sectors) / 2
        self.assertAlmostEqual(volume / (polygon * (0.025**2 * 0.1 + (0.05**2 - 0.025**2) * 0.06)), 1.0, delta=1e-9)
        moved, radial = mesh.point_data["displacement"], mesh.points[:, [0, 2]]
        self.assertLess(np.abs(moved[:, 0] * radial[:, 1] - moved[:, 2] * radial[:, 0]).max(), 1e-15)

    def test_what_is_no_body_of_revolution_has_no_other_half(self):
        self.solve("plane", TUBE.replace("axisymmetric", "strain").replace("fix: y", "fix: [x, y]"))
        for words in (["--mirror"], ["--turned", "12"]):
            self.assertIn("plane: axisymmetric", self.plot("plane.results", *words, status=1).stderr)
        self.solve("tube", TUBE)
        self.assertIn("from 3 to 720", self.plot("tube.results", "--turned", "2", status=1).stderr)

    def test_report_names_hoop_stress(self):
        self.solve("tube", TUBE)
        run = scabo("report", "tube.results", "--mirror", cwd=self.directory, SCABO_PYTHON=sys.executable)
        if "is not at" in run.stderr:
            self.skipTest("the page for reports is not built")
        self.assertEqual(run.returncode, 0, run.stderr)
        page = (self.directory / "tube.report.html").read_text(encoding="utf-8")
        content = json.loads(page.split('id="content">')[1].split("</script>")[0])
        self.assertIn("hoop stress", [quantity["name"] for quantity in content["field"]["quantities"]])
        self.assertAlmostEqual(content["field"]["low"][0], -2.0)
        self.assertIn("Forces are those of the whole circumference.", content["verdict"]["text"])
        self.assertNotIn("forces_of_radians", [column["name"] for column in content["history"]["columns"]])
        self.solve("radian", TUBE.replace("axisymmetric", "axisymmetric, forces: per_radian"))
        scabo("report", "radian.results", cwd=self.directory, SCABO_PYTHON=sys.executable)
        self.assertIn("Forces are those of one radian.", (self.directory / "radian.report.html").read_text(encoding="utf-8"))


if __name__ == "__main__":
    support.main()
