"""Pictures of models that are not solved, by `scabo plot MODEL` and `scabo check --plot`."""
import pathlib
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "regression"))
import support
from support import ROOT, scabo

DAM = ROOT / "apps" / "scabo" / "models" / "dam.yaml"


class Models(support.InTemporaryDirectory):
    def setUp(self):
        super().setUp()
        shutil.copy(DAM, self.directory)

    def test_a_picture_beside_the_model_and_nothing_else(self):
        run = scabo("plot", "dam.yaml", cwd=self.directory)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("dam.model.png", run.stdout)
        self.assertEqual({path.name for path in self.directory.iterdir()}, {"dam.yaml", "dam.model.png"})
        self.assertTrue((self.directory / "dam.model.png").read_bytes().startswith(b"\x89PNG"))

    def test_with_options_and_from_check(self):
        run = scabo("plot", "-o", "part.pdf", "--units", "m,N", "--window", "-5,20,-5,5", "dam.yaml", cwd=self.directory)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertTrue((self.directory / "part.pdf").is_file())
        run = scabo("check", "dam.yaml", "--plot", "--set", "title=Other", cwd=self.directory)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("No mistakes found", run.stdout)
        self.assertTrue((self.directory / "dam.model.png").is_file())

    def test_every_kind_of_model_can_be_drawn(self):
        good = ROOT / "tests" / "input" / "good"
        for name in ("ties.yaml", "outside.yaml", "mesh_file.yaml", "image_levels.yaml", "crack_faces.yaml", "springs.yaml", "bars.yaml", "revolution.yaml", "stages.yaml"):
            with self.subTest(name=name):
                run = scabo("plot", good / name, "-o", self.directory / "picture.png")
                self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_names_of_what_begins_and_ends(self):
        """An .svg has its texts as comments above the paths of their letters."""
        run = scabo("plot", ROOT / "tests" / "input" / "good" / "staged_supports.yaml", "-o", self.directory / "picture.svg")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        text = (self.directory / "picture.svg").read_text(encoding="utf-8")
        for name in ("prop (until strike)", "jack (from lift, until lower)", "beam"):
            self.assertIn(name, text)

    def test_mistakes(self):
        run = scabo("plot", "dam.yaml", "--what", "stress", cwd=self.directory)
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, r"^scabo plot: --what stress: of a model that is not solved there is one picture.*\n$")
        run = scabo("plot", "dam.yaml", "--increment", "2", cwd=self.directory)
        self.assertEqual(run.returncode, 1)
        self.assertIn("--increment: has no meaning for a model that is not solved", run.stderr)
        (self.directory / "wrong.yaml").write_text("scabo: 1\nbodies: {a: {rigid: maybe}}\n")
        run = scabo("plot", "wrong.yaml", cwd=self.directory)
        self.assertEqual(run.returncode, 1)
        self.assertIn("wrong.yaml:2", run.stderr)
        part = ROOT / "apps" / "scabo" / "models" / "part3d.yaml"
        for words in (("plot", part), ("check", part, "--plot")):
            run = scabo(*words, cwd=self.directory)
            self.assertEqual(run.returncode, 1, run.stderr)
            self.assertIn("pictures", run.stderr)


if __name__ == "__main__":
    support.main()
