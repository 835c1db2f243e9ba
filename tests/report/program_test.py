"""`scabo report` and `scabo run --report`: what they write, what they say, and which exit status they have."""
import json
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "regression"))
import support

SLIDING = """
scabo: 1
materials: {m: {young: 1e9, poisson: 0.2}}
bodies:
  table: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}}
  block: {material: m, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 0.5}}
contacts: {base: {between: [table.top, block.bottom], friction: 0.3}}
supports: [{on: table, displacement: [0, 0], rotation: 0}]
loads: {weight: {on: block.top, traction: [0, -1e5]}, push: {on: block.left, traction: [1e5, 0]}}
steps: [{name: rest, loads: {weight: 1, push: 0}}, {name: pushed, increments: 4, loads: {weight: 1, push: 1}}]
"""

STAGES = """
scabo: 1
materials: {stone: {young: 1e9, poisson: 0.2, density: 2000}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [4, 1]}}}
  low: {material: stone, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 0.5}}
  high: {material: stone, shape: {rectangle: {corner: [0, 1], size: [1, 1]}}, mesh: {kind: quadtree, size: 0.5}, added: second, removed: third}
supports: [{on: floor, fix: [x, y]}]
loads: {weight: {gravity: [0, -9.81]}}
contacts: {joints: {between: all, friction: 0.6}}
steps: [{name: first, loads: {weight: 1}}, {name: second, increments: 2}, {name: third, increments: 2}]
"""


class Program(support.InTemporaryDirectory):
    def setUp(self):
        super().setUp()
        self.model = self.directory / "beam.yaml"
        self.assertEqual(support.scabo("new", "beam", "-o", self.model).returncode, 0)
        self.page = self.directory / "beam.report.html"

    def needs_the_page(self):
        if not (pathlib.Path(support.SCABO).resolve().parents[1] / "share" / "scabo" / "report_template.html").exists():
            self.skipTest("the page for reports was not built (apt install nodejs npm)")

    def scabo(self, *words, status=0, **environment):
        run = support.scabo(*words, cwd=self.directory, **{"SCABO_PYTHON": sys.executable, **environment})
        self.assertEqual(run.returncode, status, run.stderr)
        return run

    def test_run_ends_with_a_report(self):
        self.needs_the_page()
        self.assertIn("beam.report.html\n", self.scabo("run", self.model, "--report").stdout)
        text = self.page.read_text(encoding="utf-8")
        self.assertIn("<title>Two beams, one on the other</title>", text)
        self.page.unlink()
        run = self.scabo("run", self.model, "--report", "-q")
        self.assertEqual((run.stdout, run.stderr), ("", ""))
        self.assertTrue(self.page.exists())
        run = self.scabo("report", "beam.results", "-o", "again.html")
        self.assertEqual((run.stdout, run.stderr), ("again.html\n", ""))

    def test_the_status_of_an_unsolved_run_stays(self):
        self.needs_the_page()
        (self.directory / "sliding.yaml").write_text(SLIDING, encoding="utf-8")
        self.scabo("run", "sliding.yaml", "--report", "-q", status=2)
        text = (self.directory / "sliding.report.html").read_text(encoding="utf-8")
        self.assertIn('"heading":"The loads are more than the structure can carry"', text)
        self.assertIn("The file mechanism.vtu shows the motion.", text)

    def test_of_bodies_that_come_and_go(self):
        """Fields of all increments, each on its mesh; pairs of those that have the pairs of the last one, and a sentence that says so."""
        self.needs_the_page()
        (self.directory / "stages.yaml").write_text(STAGES, encoding="utf-8")
        self.scabo("run", "stages.yaml", "--report", "-q")
        text = (self.directory / "stages.report.html").read_text(encoding="utf-8")
        content = json.loads(re.search(r'id="content">(.*?)</script>', text, re.DOTALL)[1])
        self.assertEqual([content[part]["increments"] for part in ("field", "pairs")], [[1, 2, 3, 4, 5], [1, 4, 5]])
        self.assertEqual(content["field"]["mesh_of"], {"1": 0, "2": 1, "3": 1, "4": 0, "5": 0})
        self.assertEqual(content["field"]["note"], "")
        self.assertIn("those with the pairs of the last one", content["pairs"]["note"])

    def test_of_cracks_that_grow(self):
        """Every state of growth has its mesh; the page shows those whose fields were written."""
        self.needs_the_page()
        self.assertEqual(support.scabo("new", "growth", "-o", self.directory / "growth.yaml").returncode, 0)
        self.scabo("run", "growth.yaml", "--report", "-q")
        text = (self.directory / "growth.report.html").read_text(encoding="utf-8")
        field = json.loads(re.search(r'id="content">(.*?)</script>', text, re.DOTALL)[1])["field"]
        self.assertGreater(len(field["increments"]), 2)
        self.assertEqual(len(set(field["mesh_of"].values())), len(field["increments"]))
        self.assertIn("Super-elements are drawn on the last mesh only.", field["note"])
        self.assertIn(f'id="points_of_mesh_{len(field["increments"]) - 1}"', text)

    def test_a_report_that_cannot_be_written(self):
        self.needs_the_page()
        self.page.mkdir()
        run = self.scabo("run", self.model, "--report", "-q", status=3)
        self.assertIn("is a directory: name a file", run.stderr)
        self.assertIn("the report was not written; the results are complete, and `scabo report", run.stderr)
        self.assertEqual(support.summary_of(self.directory / "beam.results")["status"], "solved")

    def test_what_is_missing_is_missed_before_the_run(self):
        run = self.scabo("run", self.model, "--report", status=3, SCABO_PYTHON="/nowhere/python")
        self.assertIn("no Python with NumPy for reports: /nowhere/python not found. Install it (apt install python3-numpy)", run.stderr)
        copy = self.directory / "bin" / "scabo"
        copy.parent.mkdir()
        copy.write_bytes(pathlib.Path(support.SCABO).read_bytes())
        copy.chmod(0o755)
        for words in (["report", "nowhere"], ["run", str(self.model), "--report"]):
            run = subprocess.run([copy, *words], cwd=self.directory, capture_output=True, text=True, timeout=support.PATIENCE)
            self.assertEqual(run.returncode, 3)
            self.assertIn(f"the program for reports is not at {self.directory.resolve()}/share/scabo/scabo_report", run.stderr)
        share = self.directory / "share" / "scabo"
        share.mkdir(parents=True)
        for name in ("plot", "report"):
            (share / f"scabo_{name}").symlink_to(support.ROOT / "python" / "scabo" / name)
        run = subprocess.run([copy, "run", str(self.model), "--report"], cwd=self.directory, capture_output=True, text=True, timeout=support.PATIENCE)
        self.assertEqual(run.returncode, 3)
        self.assertIn(f"the page for reports is not at {share.resolve()}/report_template.html", run.stderr)
        self.assertFalse((self.directory / "beam.results").exists())

    def test_mistakes(self):
        self.assertIn("DIR is required", self.scabo("report", status=1).stderr)
        self.assertIn("--size", self.scabo("report", "nowhere", "--size", "-3", status=1).stderr)
        self.needs_the_page()
        self.assertIn("nowhere: there is no such directory", self.scabo("report", "nowhere", status=1).stderr)

    def test_both_command_lines_have_the_same_options(self):
        help_text = support.scabo("report", "--help").stdout.split("Example:")[0].replace("--units m,N", "")
        of_program = set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", help_text))
        source = (support.ROOT / "python" / "scabo" / "report" / "command.py").read_text(encoding="utf-8")
        of_report = {flag for line in re.findall(r"add_argument\(([^)]*)", source) for flag in re.findall(r'"(--?[a-z]+)"', line)}
        self.assertEqual(of_program, of_report | {"-h", "--help"})
        self.assertIn("default: 25.", re.sub(r"\s+", " ", help_text))


if __name__ == "__main__":
    support.main()
