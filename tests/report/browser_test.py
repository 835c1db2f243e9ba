"""A report in headless Chromium: it opens from a file without errors and without a network, its values are those of the program, pairs
light up in the field and in the curves, the keyboard reaches everything, and there is light and dark.

Skipped where there is no Chromium or where the page was not built (no Node.js, no npm)."""
import csv
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "regression"))
import matplotlib.image
import numpy as np
import support
from in_browser import InBrowser, template
from program_test import SLIDING

TITLE = "</script><script>alert(1)</script><img src=x onerror=alert(2)> <!--scabo:arrays--> & \"beam\" ünïcode"
COLUMNS = {"ux": "ux", "uy": "uy", "xx": "stress_xx", "yy": "stress_yy", "xy": "stress_xy", "zz": "stress_zz", "von_mises": "von_mises",
           "principal_1": "principal_1", "principal_2": "principal_2", "principal_3": "principal_3"}
RINGS = (2, 5, 7)        # of the lower beam, 80 nodes each; a node in the middle of an element has one value of the stress
NODES = (7, 33, 61)
BETWEEN = ((1.234, 0.567), (5.43, 2.21))
PAIR, OTHER = 30, 11     # from 0: one that slips, one that is open
LINE = (0.5, 0.3, 5.5, 2.7)  # from the lower beam into the upper one
LOOP = ("joint, normal force", "joint, tangential force")  # across, up


class Report(InBrowser):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        sys.path.insert(0, str(template().parent))
        from scabo_plot import Results, geometry
        cls.run_model("first")
        first = Results(cls.folder / "first")
        grid = first.fields(3)
        cls.points = [grid.points[80 * ring + node] for ring, node in zip(RINGS, NODES)]
        wanted = json.dumps([{"name": f"p{k}", "at": [float(value) for value in at]} for k, at in enumerate(cls.points)])
        cls.run_model("beam", "--set", f"output={{points: {wanted}}}")
        cls.results = Results(cls.folder / "beam")
        run = support.scabo("report", cls.folder / "beam", "-o", cls.folder / "beam.html", "--units", "m,N", SCABO_PYTHON=sys.executable)
        assert (run.returncode, run.stderr) == (0, ""), run.stderr
        cls.sliding()
        cls.triangles = geometry.triangles(grid)
        cls.asked = [(number, *map(float, at)) for number in (3, 1) for at in (*cls.points, *BETWEEN)]
        cls.seen = cls.drive("browser.mjs", cls.folder / "beam.html", {"picks": cls.asked, "pair": PAIR, "other": OTHER, "loop": LOOP, "line": LINE, "mechanism": str(cls.folder / "sliding.html")})

    @classmethod
    def run_model(cls, name, *settings):
        run = support.scabo("run", support.BEAM, "-q", "-o", cls.folder / name, "--set", "steps.0.increments=3", "--set", f"title={json.dumps(TITLE)}",
                            *settings)
        assert run.returncode == 0, run.stderr

    @classmethod
    def sliding(cls):
        """A page of a run that ends as a mechanism."""
        (cls.folder / "sliding.yaml").write_text(SLIDING, encoding="utf-8")
        assert support.scabo("run", "sliding.yaml", "-q", cwd=cls.folder).returncode == 2
        run = support.scabo("report", "sliding.results", "-o", "sliding.html", cwd=cls.folder, SCABO_PYTHON=sys.executable)
        assert (run.returncode, run.stderr) == (0, ""), run.stderr

    def test_a_mechanism_is_played(self):
        seen = self.seen["mechanism"]
        self.assertIn("1 of 2 bodies moves, 'block'. Colours: displacements", seen["note"])
        self.assertEqual(seen["fields"], [False, True])
        self.assertLessEqual(seen["longest"], 0.06 * np.hypot(4, 2))

    def test_no_error_no_network_and_no_text_is_code(self):
        self.assertEqual(self.seen["errors"], [])
        self.assertEqual(self.seen["requests"], [])
        self.assertEqual((self.seen["dialogs"], self.seen["injected"]), (0, 0))
        self.assertEqual(self.seen["title"], TITLE)
        self.assertEqual(self.seen["heading"], TITLE)

    def test_the_page_says_what_the_results_say(self):
        text = self.seen["text"]
        for words in ("Solved and certified", "All 3 increments converged", "Do all forces balance?", "concrete", "10 GPa", "lower.top", "friction 0.2", "320"):
            self.assertIn(words, text)

    def test_picks_are_the_values_of_the_program(self):
        with open(self.folder / "beam" / "points.csv", newline="", encoding="utf-8") as file:
            rows = {(int(row["increment"]), row["name"]): row for row in csv.DictReader(file)}
        for (number, x, y), pick in zip(self.asked, self.seen["picks"]):
            known = next((k for k, at in enumerate(self.points) if (x, y) == tuple(map(float, at))), None)
            if known is None:
                continue
            for way in ("clicked", "typed"):
                for key, column in COLUMNS.items():
                    exact = float(rows[number, f"p{known}"][column])
                    size = max(abs(float(rows[number, f"p{known}"][of])) for of in (("ux", "uy") if key in ("ux", "uy") else ("von_mises",)))
                    self.assertAlmostEqual(pick[way][key], exact, delta=(2e-6 if way == "typed" else 2e-5) * size, msg=(way, number, known, key))

    def test_picks_between_points_are_interpolated(self):
        for (number, x, y), pick in zip(self.asked, self.seen["picks"]):
            if (x, y) not in BETWEEN:
                continue
            grid = self.results.fields(number)
            a, b, c = (grid.points[self.triangles[:, k]] for k in range(3))
            weights = np.linalg.solve(np.stack([np.column_stack([p, np.ones(len(p))]) for p in (a, b, c)], axis=2), np.tile([[x], [y], [1.0]], (len(a), 1, 1)))[..., 0]
            inside, = np.flatnonzero((weights > 0).all(axis=1))
            for key, array in (("xx", "stress_xx"), ("von_mises", "von_mises")):
                value = float(weights[inside] @ grid.point_data[array][self.triangles[inside]])
                self.assertAlmostEqual(pick["typed"][key], value, delta=1e-5 * abs(grid.point_data[array]).max())
            self.assertEqual(pick["typed"]["displacement"] > 0, True)

    def test_increments_differ(self):
        half = len(self.asked) // 2
        for last, first in zip(self.seen["picks"][:half], self.seen["picks"][half:]):
            self.assertGreater(abs(last["typed"]["uy"]), 1.5 * abs(first["typed"]["uy"]))

    def test_outside_there_is_nothing(self):
        self.assertIn("There is no elastic body", self.seen["outside"])

    def rows_of_pair(self, pair):
        rows = support.rows_of(self.folder / "beam")
        return next(row for row in rows if row["increment"] == "1" and row["pair"] == rows[pair]["pair"])

    def test_pairs_light_up_both_ways(self):
        self.assertIsNone(self.seen["dark_pair"]["ring"])
        for name, pair in (("from_field", PAIR), ("from_curve", OTHER)):
            seen = self.seen[name]
            self.assertEqual((seen["pair"], seen["values"]), (pair, str(pair)), name)
            ring = [float(part) for part in seen["ring"].removeprefix("translate(").removesuffix(")").split()]
            np.testing.assert_allclose(ring, seen["place"], atol=0.1, err_msg=name)
            row = self.rows_of_pair(pair)
            for key in ("pressure", "shear", "slip", "normal_force"):
                self.assertAlmostEqual(seen["shown"][key], float(row[key]), delta=1e-6 * abs(float(row[key])) + 1e-300, msg=(name, key))
        self.assertAlmostEqual(self.seen["from_field"]["cursor"], self.seen["from_field"]["expected"], delta=1.5)
        self.assertEqual(self.seen["from_keyboard"]["pair"], OTHER)

    def test_two_quantities_against_each_other(self):
        totals = [entry["contacts"]["joint"] for entry in self.results.increments]
        expected = [[total["normal_force"] / 1e3, total["tangential_force"] / 1e3] for total in totals]  # kN
        np.testing.assert_allclose(self.seen["loop"]["points"], expected, rtol=1e-12)
        np.testing.assert_allclose(self.seen["loop"]["rings"], [expected[2], expected[0]], rtol=1e-12)
        self.assertEqual(self.seen["loop"]["clicked"], 2)

    def test_smallest_and_largest_values_and_where_they_are(self):
        grid = self.results.fields(2)
        values, bodies = grid.point_data["von_mises"], grid.point_data["body"]
        for seen, there in zip(self.seen["extremes"], (bodies > 0, bodies == 1)):
            for key, of in (("smallest", np.argmin), ("largest", np.argmax)):
                point = np.flatnonzero(there)[of(values[there])]
                self.assertAlmostEqual(seen[key][0], values[point], delta=1e-6 * values.max())
                np.testing.assert_allclose(seen[key][1:], grid.points[point], atol=1e-5)

    def test_bodies_are_hidden_and_ordered(self):
        self.assertEqual(self.seen["bodies"][0], {"hidden": [2, 1], "order": [1, 2]})
        self.assertEqual(self.seen["bodies"][1], {"hidden": [], "order": [2, 1]})
        self.assertEqual(self.seen["opacity"], [255, 0])

    def saved(self, button):
        with open(self.folder / self.seen["saved"][button], newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_values_along_a_line(self):
        rows = self.saved("line-csv")
        self.assertEqual(self.seen["saved"]["line-csv"], "beam_line_von_mises_2.csv")
        at = np.array([[float(row["x"]), float(row["y"])] for row in rows])
        np.testing.assert_allclose([at[0], at[-1]], [LINE[:2], LINE[2:]], atol=1e-5)
        self.assertAlmostEqual(float(rows[-1]["distance"]), np.hypot(5.0, 2.4), places=5)
        grid = self.results.fields(2)
        a, b, c = (grid.points[self.triangles[:, k]] for k in range(3))
        matrices = np.stack([np.column_stack([p, np.ones(len(p))]) for p in (a, b, c)], axis=2)
        for row, (x, y) in list(zip(rows, at))[3::23]:
            weights = np.linalg.solve(matrices, np.tile([[x], [y], [1.0]], (len(a), 1, 1)))[..., 0]
            inside = np.flatnonzero((weights > 1e-6).all(axis=1))
            if len(inside) != 1:
                continue  # on a side
            values = grid.point_data["von_mises"][self.triangles[inside[0]]]
            self.assertAlmostEqual(float(row["von_mises"]), float(weights[inside[0]] @ values), delta=1e-4 * values.max())
            self.assertEqual(row["body"], "lower" if y < 1.5 else "upper")
        np.testing.assert_allclose(self.seen["drawn_line"], [1, 0.5, 2, 1], atol=0.03)

    def test_files_of_the_page_are_those_of_the_program(self):
        wanted = [row for row in support.rows_of(self.folder / "beam") if row["increment"] == "2"]
        pairs = self.saved("pairs-csv")
        self.assertEqual([row["state"] for row in pairs], [row["state"] for row in wanted])
        for key in ("pressure", "shear", "gap", "normal_force"):
            largest = max(abs(float(row[key])) for row in wanted)
            np.testing.assert_allclose([float(row[key]) for row in pairs], [float(row[key]) for row in wanted], atol=1e-6 * largest, err_msg=key)
        totals = [entry["contacts"]["joint"] for entry in self.results.increments]
        for row, total in zip(self.saved("contacts-csv"), totals):
            for key in ("normal_force", "tangential_force", "max_pressure", "max_gap", "stick", "slip", "open"):
                self.assertEqual(float(row[key]), total[key], key)
        reactions = self.saved("reactions-csv")
        self.assertEqual([float(row["x"]) for row in reactions], [force[0] for entry in self.results.increments for force in entry["reactions"].values()])
        picture = matplotlib.image.imread(self.folder / self.seen["saved"]["save-png"])
        self.assertGreater(len(np.unique((32 * picture[..., :3]).astype(int).reshape(-1, 3), axis=0)), 60, "colours of the field")

    def test_totals_are_those_of_the_increment(self):
        total = self.results.increments[2]["contacts"]["joint"]
        self.assertEqual(self.seen["totals"][0], "joint")
        self.assertEqual(float(self.seen["totals"][1].removesuffix(" kN")), float(f"{total['normal_force'] / 1e3:.5g}"))
        self.assertEqual(self.seen["totals"][5:], [str(total[key]) for key in ("stick", "slip", "open")])

    def test_on_paper(self):
        self.assertEqual(self.seen["paper"], {"image": "data:image/png;base64,", "theme": "light", "after": True})

    def test_on_a_phone_the_picture_comes_first(self):
        phone = self.seen["phone"]
        self.assertLess(phone["bottom"], 844)
        self.assertGreater(phone["verdict"], phone["bottom"])
        self.assertLessEqual(phone["width"], 390, "nothing stands out at the side")
        self.assertGreater(phone["right"] - phone["left"], 340)

    def test_the_keyboard_reaches_everything(self):
        wanted = ["units", "theme", "play", "increment", "quantity", "range", "magnification", "show-mesh", "show-elements", "field-view", "pick-x", "pair"]
        places = [self.seen["reached"].index(name) for name in wanted]
        self.assertEqual(places, sorted(places), "in the order of the page")
        self.assertEqual(self.seen["unlabelled"], [])
        start, right, up, nearer, again = self.seen["cameras"]
        self.assertGreater(right[0], start[0])
        self.assertGreater(up[1], right[1])
        self.assertAlmostEqual(nearer[2], 1.25 * up[2])
        np.testing.assert_allclose(again, start)
        self.assertTrue(self.seen["middle"])
        self.assertEqual(self.seen["stepped"], 1, "before the first there is none")

    def test_light_and_dark(self):
        light, dark, system = self.seen["backgrounds"]
        brightness = lambda colour: sum(map(int, colour.removeprefix("rgb(").removesuffix(")").split(",")))
        self.assertGreater(brightness(light), 600)
        self.assertLess(brightness(dark), 150)
        self.assertEqual(dark, system)
        for name, corner in (("light", 0.8), ("dark", 0.0)):
            pixels = matplotlib.image.imread(self.folder / f"{name}.png")[..., :3]
            self.assertGreater(len(np.unique((32 * pixels).astype(int).reshape(-1, 3), axis=0)), 60, f"{name}: colours of the field")
            self.assertAlmostEqual(float(pixels[8, 8].mean()), corner, delta=0.25)

    def test_all_quantities_can_be_shown(self):
        self.assertEqual(self.seen["quantities"], ["ux", "uy", "displacement", "von_mises", "principal_1", "principal_2", "principal_3", "xx", "yy", "xy", "zz"])


if __name__ == "__main__":
    support.main()
