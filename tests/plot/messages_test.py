"""What the pictures say about results that are missing or broken, and about options; each with exit status 1, in one line."""
import contextlib
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import made_up
from plot import command


def draw(*words):
    """As the program does, within this process."""
    output, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
        status = command.main(list(map(str, words)))
    return subprocess.CompletedProcess(words, status, output.getvalue(), errors.getvalue())


class Messages(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="scabo_test_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.directory = made_up.write(self.folder / "made_up.results")

    def refused(self, message, *words, status=1):
        run = draw(*words)
        self.assertEqual((run.returncode, run.stdout), (status, ""), run.stderr)
        self.assertRegex(run.stderr, message)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertEqual(sorted(path.suffix for path in self.folder.rglob("*") if path.suffix in (".png", ".svg", ".pdf")), [])

    def change(self, name, change):
        path = self.directory / name
        path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")

    def test_directories(self):
        self.refused("nowhere: there is no such directory: `scabo run", self.folder / "nowhere")
        self.refused("is a file, not a results directory", self.directory / "contact.csv")
        (self.folder / "empty").mkdir()
        self.refused("has no summary.json", self.folder / "empty")
        self.refused("the following arguments are required: DIR")

    def test_summaries(self):
        self.change("summary.json", lambda text: text[:100])
        self.refused(r"summary.json: is damaged \(.*\); run the model again", self.directory)
        self.change("summary.json", lambda text: "[]")
        self.refused("was not written by `scabo run`", self.directory)
        content = made_up.summary()
        (self.directory / "summary.json").write_text(json.dumps({**content, "increments": content["increments"][2:]}), encoding="utf-8")
        self.refused(r"has no finished increment \(status: not_converged\)", self.directory)

    def test_increments(self):
        self.refused("--increment 3: .* has 2 increments; give 1 to 2, or -1 for the last one", self.directory, "--increment", "3")
        self.refused("--increment 0: ", self.directory, "--increment", "0")
        self.refused("--increment -3: ", self.directory, "--increment", "-3")
        self.refused("invalid int value: 'last'", self.directory, "--increment", "last")

    def test_tables(self):
        self.change("contact.csv", lambda text: text.replace("\n2,1,bend,3,", "\n2,bend,3,"))
        self.refused("contact.csv:16: has 16 fields instead of 17; run the model again", self.directory, "--what", "contact")
        made = made_up.write(self.folder / "second.results")
        text = (made / "contact.csv").read_text(encoding="utf-8")
        (made / "contact.csv").write_text(text.replace("\n2,1,bend,3,", "\n2,1,bend,three,"), encoding="utf-8")
        self.refused("contact.csv: is damaged .*three", made, "--what", "contact")
        (made / "contact.csv").write_text("", encoding="utf-8")
        self.refused("contact.csv: is empty", made, "--what", "contact")
        (made / "contact.csv").unlink()
        self.refused("has no contact.csv with pairs of step 2, increment 1", made, "--what", "contact")
        (made / "convergence.csv").unlink()
        self.refused("has no convergence.csv", made, "--what", "convergence")

    def test_fields(self):
        path = self.directory / "fields_0002.vtu"
        whole = path.read_bytes()
        path.write_bytes(whole[:-400])
        self.refused("fields_0002.vtu: is damaged .*; run the model again", self.directory, "--what", "stress")
        path.unlink()
        self.refused("fields_0002.vtu: cannot be read: No such file", self.directory, "--what", "stress")
        self.change("fields.pvd", lambda text: "\n".join(line for line in text.splitlines() if "0002" not in line) + "\n")
        self.change("fields.pvd", lambda text: text if "Collection></VTK" in text else text + "</Collection></VTKFile>")
        self.refused("has no fields of increment 2; there are those of 1", self.directory, "--what", "stress")
        self.change("fields.pvd", lambda text: text[:60])
        self.refused("fields.pvd: is damaged", self.directory, "--what", "stress")
        (self.directory / "fields.pvd").unlink()
        self.refused("has no fields of increment 2; `output` in the model file asks for none", self.directory, "--what", "stress")
        self.refused("has neither cells.vtu nor fields", self.directory, "--what", "mesh")

    def test_components(self):
        self.refused("--component von_mieses: there are von_mises, principal_1", self.directory, "--what", "stress", "--component", "von_mieses")
        self.refused("the fields have no stress yy: `output: {fields", self.directory, "--what", "stress", "--component", "yy")
        self.refused("along a contact there are pressure, shear, gap, slip", self.directory, "--what", "contact", "--component", "force")
        self.refused("over increments there are forces, states", self.directory, "--what", "history", "--component", "force")
        self.refused("--component ux: say of what, as in --what stress", self.directory, "--component", "ux")
        self.refused("--contact bent: there is no such contact; there are bend, _seat", self.directory, "--what", "contact", "--contact", "bent")

    def test_options(self):
        self.refused("invalid choice: 'stresses'", self.directory, "--what", "stresses")
        self.refused("-o picture.jpeg: the name must end in .png, .svg or .pdf", self.directory, "-o", "picture.jpeg")
        self.refused("--window 1,2: give four numbers", self.directory, "--window", "1,2")
        self.refused("x0 below x1", self.directory, "--window", "-1,-2,0,1")
        self.refused("no part of a body lies in it", self.directory, "--what", "stress", "--window", "-9,-8,0,1")
        self.refused("--units m: give the unit of length and that of force", self.directory, "--units", "m")
        for scale in ("nan", "inf", "-3"):
            self.refused(f"--scale {scale}: give a number that is not negative", self.directory, "--scale", scale)
        for what, option, value in (("contact", "--scale", "2"), ("history", "--window", "0,1,0,1"), ("mesh", "--component", "xx"),
                                    ("convergence", "--units", "m,N"), ("history", "--increment", "1"), ("stress", "--contact", "bend")):
            self.refused(f"{option}: has no meaning for --what {what}", self.directory, "--what", what, option, value)

    def test_a_place_that_cannot_be_written(self):
        self.refused("cannot write .*: No such file or directory", self.directory, "--what", "mesh", "-o", self.folder / "nowhere" / "a.png",
                     status=3)

    def test_a_name_that_utf_8_cannot_express(self):
        os.rename(os.fsencode(self.directory), os.path.join(os.fsencode(self.folder), b"b\xf6se.results"))
        run = subprocess.run([sys.executable, made_up.ROOT / "python" / "scabo" / "plot", os.path.join(os.fsencode(self.folder), b"b\xf6se.results")],
                             capture_output=True, env={**os.environ, "PYTHONIOENCODING": "utf-8:strict"})
        self.assertEqual((run.returncode, run.stderr), (0, b""))
        self.assertEqual([os.path.basename(line) for line in run.stdout.splitlines()],
                         [b"b\xf6se.%s.png" % kind for kind in (b"stress", b"contact", b"convergence", b"mesh", b"history")])

    def test_what_is_missing_is_left_out_of_all(self):
        for name in ("contact.csv", "convergence.csv"):
            os.remove(self.directory / name)
        run = draw(self.directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        names = [pathlib.Path(line).name for line in run.stdout.splitlines()]
        self.assertEqual(names, ["made_up.stress.png", "made_up.mesh.png", "made_up.history.png"])
        self.assertRegex(run.stderr, "no picture of contact: ")

    def test_what_is_broken_is_not_left_out(self):
        self.change("contact.csv", lambda text: text[:-20])
        self.refused("contact.csv:37: has 1. fields instead of 17", self.directory)


if __name__ == "__main__":
    unittest.main()
