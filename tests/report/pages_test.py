"""The page of a report without a browser: packing of arrays, the choice of increments, messages, texts of the user."""
import base64
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import unittest
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "plot"))
import made_up
import numpy as np

FOLDER = tempfile.TemporaryDirectory(prefix="scabo_test_")
for name in ("plot", "report"):  # as in share/scabo
    (pathlib.Path(FOLDER.name) / f"scabo_{name}").symlink_to(ROOT / "python" / "scabo" / name)
PAGE = pathlib.Path(FOLDER.name) / "report_template.html"
MARKS = "<title><!--scabo:title--></title><body><!--scabo:content--><!--scabo:arrays--><p>end</p>"
sys.path.insert(0, FOLDER.name)
from scabo_report import choice, command, fields, page, words
from scabo_report.packing import pack


def unpacked(text, kind):
    """As the page does it."""
    planes = np.frombuffer(zlib.decompress(base64.b64decode(text)), dtype="u1")
    if kind == "u1":
        return planes
    values = np.ascontiguousarray(planes.reshape(4, -1).T).view("<" + kind).reshape(-1)
    return np.cumsum(values, dtype="u4") if kind == "u4" else values


class Pages(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="scabo_test_")
        self.addCleanup(holder.cleanup)
        self.directory = pathlib.Path(holder.name)
        self.results = made_up.write(self.directory / "model.results")
        PAGE.write_text(MARKS, encoding="utf-8")

    def change_summary(self, **changes):
        path = self.results / "summary.json"
        path.write_text(json.dumps({**json.loads(path.read_text(encoding="utf-8")), **changes}), encoding="utf-8")

    def content(self, text):
        data, = re.findall(r'<script type="application/json" id="content">(.*?)</script>', text, re.DOTALL)
        return json.loads(data)

    def arrays(self, text):
        found = re.findall(r'<script type="text/plain" id="(\w+)" data-kind="(\w+)" data-count="(\d+)">([^<]*)</script>', text)
        return {name: unpacked(values, kind) for name, kind, _, values in found}

    def report(self, *words, status=0, says=""):
        import contextlib
        import io
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            result = command.main([str(word) for word in words])
        self.assertEqual(result, status, err.getvalue())
        self.assertIn(says, err.getvalue())
        self.assertLessEqual(err.getvalue().count("\n"), 1)
        return out.getvalue()

    def test_arrays_come_back(self):
        for kind, values in (("f4", np.linspace(-3, 5e8, 1001)), ("u4", np.random.default_rng(1).integers(0, 2**32 - 1, 777)), ("u1", np.arange(256)),
                             ("f4", []), ("u4", [])):
            np.testing.assert_array_equal(unpacked(pack(values, kind), kind), np.asarray(values).astype(kind))

    def test_values_are_those_of_the_files(self):
        text = page.page_of(self.results)
        content, arrays = self.content(text), self.arrays(text)
        grid = made_up.grid()
        self.assertEqual(content["field"]["increments"], [1, 2])
        np.testing.assert_allclose(arrays["points_of_mesh_0"].reshape(-1, 2) + content["field"]["centre"], grid["Points"][:, :2], atol=1e-6)
        np.testing.assert_array_equal(arrays["von_mises_2"][:-4], grid["point"]["von_mises"][:-4].astype("f4"))
        self.assertTrue(np.isnan(arrays["von_mises_2"][-4:]).all(), "a rigid body has no stress")
        np.testing.assert_array_equal(arrays["uy_2"], (2 * grid["point"]["displacement"][:, 1]).astype("f4"))
        rows = [row for row in made_up.contact_rows() if row[0] == 2]
        np.testing.assert_allclose(arrays["pressure_of_pairs_2"], [row[10] for row in rows], rtol=1e-7)
        self.assertEqual([("open", "stick", "slip")[state] for state in arrays["state_2"]], [row[12] for row in rows])
        self.assertEqual(content["verdict"]["level"], "bad")
        self.assertEqual(content["verdict"]["heading"], "Did not converge")
        self.assertEqual(len(content["failed"]), 1)
        self.assertEqual(content["totals"]["contacts"][0]["normal_force"], [100.0, 200.0])
        self.assertEqual(content["totals"]["contacts"][1]["tangential_force"], [-12.0, -24.0])
        self.assertEqual(content["reactions"]["supports"], [{"name": "ground", "x": [3.0, 6.0], "y": [-8.0, -8.0]}])
        self.assertEqual([row["open"] for row in content["increments"]], [6, 6])
        self.assertEqual([row["time"] for row in content["increments"]], [1, 2])
        self.assertEqual((content["convergence"]["attempt"][5], content["convergence"]["residual"][5]), (2, 0.5))
        self.assertEqual([row["iterations"] for row in content["increments"]], [3, 3])

    def test_sides_of_cells(self):
        from scabo_plot import vtu
        made_up.vtu(self.directory / "one.vtu", made_up.grid())
        sides = fields.sides_of_cells(vtu.read_grid(self.directory / "one.vtu"))
        self.assertEqual(len(sides), 3 + 4 + 6 + 8)
        self.assertIn([7, 10], sides.tolist(), "corner and middle of the quadratic triangle")

    def test_texts_of_the_user_end_no_script(self):
        title = "</script><script>alert(1)</script> <!--scabo:arrays--> <!--scabo:content--> & \u2028 \ud800 <b>"
        self.change_summary(title=title, warnings=["</script><!--", "<img src=x>"])
        text = page.page_of(self.results)
        self.assertEqual(text.count("<p>end</p>"), 1)
        self.assertNotIn("alert(1)</script>", text)
        self.assertEqual(text.count("</script>"), len(self.arrays(text)) + 1)
        self.assertEqual(self.content(text)["title"], title.replace("\ud800", "?"))
        self.assertEqual(self.content(text)["warnings"][0], "</script><!--")

    def test_a_name_that_utf_8_cannot_express(self):
        self.change_summary(title="")  # the title is then the name of the directory
        results = self.results.rename(self.directory / os.fsdecode(b"b\xf6se.results"))
        run = subprocess.run([sys.executable, os.path.join(FOLDER.name, "scabo_report"), results], capture_output=True,
                             env={**os.environ, "PYTHONIOENCODING": "utf-8:strict"})
        self.assertEqual((run.returncode, run.stderr), (0, b""))
        self.assertTrue(run.stdout.endswith(b"b\xf6se.report.html\n"), run.stdout)
        text = (self.directory / os.fsdecode(b"b\xf6se.report.html")).read_text(encoding="utf-8")
        self.assertTrue(text.startswith("<title>b?se.results</title>"), text[:40])

    def test_choice_of_increments(self):
        self.assertEqual(choice.in_order_of_importance(1, []), [1])
        order = choice.in_order_of_importance(200, [50])
        self.assertEqual(order[:4], [200, 1, 50, 125])
        self.assertEqual(sorted(order), list(range(1, 201)))
        self.assertLessEqual(max(np.diff(sorted(order[:40]))), 2 * 199 / 39 + 1, "halving the longest leaves none of twice the mean")
        self.assertEqual(choice.listed([1, 2, 3, 5, 7, 8]), "1 to 3, 5, 7, 8")

    def test_a_small_page_leaves_fields_out_and_says_so(self):
        text = page.page_of(self.results, megabytes=1e-3)
        content = self.content(text)
        self.assertEqual(content["field"]["increments"], [2])
        self.assertIn("fields of 1 of 2 increments (2)", content["field"]["note"])
        self.assertIn("pairs of 1 of 2 increments (2)", content["pairs"]["note"])
        self.assertEqual(len(content["increments"]), 2)

    def test_the_certificate_names_the_worst_increment(self):
        entries = [{"certificate": {"equilibrium": 1e-15, "penetration": 0.0}}, {"certificate": {"equilibrium": 3e-14, "penetration": 0.0}}]
        rows = {row["key"]: row for row in words.certificate(entries)}
        self.assertEqual((rows["equilibrium"]["worst"], rows["equilibrium"]["increment"]), (3e-14, 2))
        self.assertEqual((rows["penetration"]["worst"], rows["penetration"]["increment"]), (0.0, 1))

    def test_name_of_the_page(self):
        self.assertEqual(self.report(self.results), f"{self.directory / 'model.report.html'}\n")
        self.assertTrue((self.directory / "model.report.html").read_text(encoding="utf-8").startswith("<title>"))
        self.assertEqual(self.report(self.results, "-q", "-o", self.directory / "x.html"), "")
        self.assertEqual(sorted(path.name for path in self.directory.iterdir()), ["model.report.html", "model.results", "x.html"])

    def test_a_pipe_stays_a_pipe(self):
        pipe = self.directory / "pipe"
        os.mkfifo(pipe)
        read = []
        reader = threading.Thread(target=lambda: read.append(pipe.read_text(encoding="utf-8")))
        reader.start()
        self.report(self.results, "-o", pipe)
        reader.join(30)
        self.assertTrue(read[0].startswith("<title>"))
        self.assertTrue(pipe.is_fifo(), "a device in its place would be lost to all programs")

    def test_messages(self):
        self.report("nowhere", status=1, says="nowhere: there is no such directory")
        self.report(status=1, says="DIR")
        self.report(self.results, "--size", "0", status=1, says="--size 0: give a number of megabytes above 0")
        self.report(self.results, "--size", "many", status=1, says="--size")
        self.report(self.results, "--units", "m", status=1, says="--units m: give the unit of length and that of force")
        self.report(self.results, "-o", self.directory, status=1, says="is a directory: name a file")
        self.report(self.results, "-o", self.directory / "no" / "x.html", status=3, says="No such file or directory")
        PAGE.write_text("<p>", encoding="utf-8")
        self.report(self.results, status=1, says="is not the page for reports: build Scabo again")
        PAGE.unlink()
        self.report(self.results, status=1, says="is not at " + str(PAGE))
        self.report(self.results, status=1, says="apt install nodejs npm")

    def test_broken_directories(self):
        def broken(name, change, says):
            path = self.results / name
            whole = path.read_bytes()
            path.write_bytes(change(whole))
            self.report(self.results, "-o", self.directory / "x.html", status=1, says=says)
            self.assertFalse((self.directory / "x.html").exists())
            path.write_bytes(whole)
        broken("summary.json", lambda text: text[:100], "is damaged")
        broken("summary.json", lambda text: b"[]", "was not written by")
        broken("summary.json", lambda text: text.replace(b'"newton_iterations"', b'"n"'), "is damaged or of another version")
        broken("contact.csv", lambda text: text[:-30], "fields instead of")
        broken("contact.csv", lambda text: text.replace(b"slip,0,0", b"slop,0,0"), "has the state 'slop'")
        broken("contact.csv", lambda text: text.replace(b"\n2,1,_seat,3", b"\n2,3,_seat,3"), "the increments have different pairs")
        broken("fields_0002.vtu", lambda text: text[:600], "is damaged")
        broken("fields.pvd", lambda text: text[:60], "is damaged")

    def test_only_the_fields_that_are_asked_for(self):
        whole = page.page_of(self.results)
        text = page.page_of(self.results, fields="displacement, von_mises")
        self.assertEqual([quantity["key"] for quantity in self.content(text)["field"]["quantities"]], ["ux", "uy", "von_mises"])
        self.assertNotIn("xx_2", self.arrays(text))
        self.assertIn("xx_2", self.arrays(whole))
        self.assertLess(len(text), len(whole))
        self.report(self.results, "--fields", "strain", status=1, says="there are no fields 'strain': give some of displacement, stress")
        self.report(self.results, "--fields", "principal", status=1, says="has none of these fields")

    def test_tables_have_more_contacts_than_curves(self):
        summary = json.loads((self.results / "summary.json").read_text(encoding="utf-8"))
        for entry in filter(lambda entry: entry["converged"], summary["increments"]):
            one = entry["contacts"]["bend"]
            entry["contacts"].update({f"c{k}": {**one, "normal_force": k} for k in range(12)})
        self.change_summary(increments=summary["increments"])
        totals = self.content(page.page_of(self.results))["totals"]
        self.assertEqual((totals["count"], len(totals["contacts"])), (14, 14))
        self.assertEqual(totals["curves"], ["bend", "_seat", "c6", "c7", "c8", "c9", "c10", "c11"])

    def test_the_mechanism_is_in_the_page(self):
        square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
        points = np.concatenate([square, square + [0, 1], [[0, 1], [1, 1]]])
        zero = np.zeros(10)
        moved = np.zeros((10, 3))
        moved[4:8, 0] = 1.0
        made_up.vtu(self.results / "mechanism.vtu", {
            "Points": np.column_stack([points, zero]), "connectivity": np.arange(10), "offsets": [4, 8, 10], "types": [7, 7, 3],
            "point": {"displacement": moved, "pair": np.array([0.0] * 8 + [1, 2]), "opening": zero, "slip": np.array([0.0] * 8 + [1, 1])},
            "cell": {"body": [1, 2, 0], "motion": [0, 1, 0]}})
        self.change_summary(status="mechanism", mechanism={"text": "1 of 2 bodies moves: 'upper' slides"},
                            model={**json.loads((self.results / "summary.json").read_text(encoding="utf-8"))["model"],
                                   "bodies": [{"name": name, "rigid": True, "unbounded": False, "materials": [], "nodes": 0, "super_elements": 0,
                                               "finite_elements": 0} for name in "abcde"]})
        text = page.page_of(self.results)
        content, arrays = self.content(text), self.arrays(text)
        self.assertEqual(content["mechanism"]["text"], "1 of 2 bodies moves: 'upper' slides.")
        np.testing.assert_array_equal(arrays["mechanism_ux"], moved[:, 0])
        np.testing.assert_array_equal(arrays["mechanism_sizes"], [4, 4])
        np.testing.assert_array_equal(arrays["mechanism_slips"], [8, 9])
        self.assertEqual(len(arrays["mechanism_opens"]), 0)
        self.assertEqual(len(arrays["mechanism_sides"]), 2 * 8)
        self.assertIsNone(self.content(page.page_of(made_up.write(self.directory / "other.results")))["mechanism"])

    def test_nothing_finished(self):
        self.change_summary(increments=[], status="failed", reason="a full disk")
        content = self.content(page.page_of(self.results))
        self.assertEqual(content["verdict"]["text"], "A full disk. No increment was finished, so that there are no results.")
        self.assertIsNone(content["field"])
        self.assertIsNone(content["pairs"])

    def test_the_motion_of_a_mechanism(self):
        self.change_summary(status="mechanism", reason="no forces balance the loads",
                            mechanism={"text": "1 of 2 bodies moves: 'upper' slides"})
        text = self.content(page.page_of(self.results))["verdict"]["text"]
        self.assertTrue(text.startswith("No forces balance the loads. 1 of 2 bodies moves: 'upper' slides. "
                                        "The file mechanism.vtu shows the motion."), text)


if __name__ == "__main__":
    unittest.main()
