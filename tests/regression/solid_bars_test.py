"""Bars in space: closed forms of tensions, preloads and energies; a body on six bars, turned and in other units; resumed runs."""
import csv
import filecmp
import math
import unittest

import support
from solid_resultants_test import box, cross, less
from solid_twins_test import IDENTITY, product, rotation, text_of
from solids import HEAD, interrupt
from support import scabo, summary_of

YOUNG, AREA, LENGTH, K = 1e9, 1.0, 2.0, 3e8  # of the columns together, and the stiffness of the bolt
COLUMNS = YOUNG * AREA / LENGTH
FORCE = 2e5
BOLTED = f"""materials: {{m: {{young: {YOUNG}, poisson: 0}}}}
bodies:
  lower: {{material: m, shape: {{box: {{corner: [0, 0, 0], size: [1, 1, 1]}}}}, mesh: {{size: 0.5}}}}
  upper: {{material: m, shape: {{box: {{corner: [0, 0, 1], size: [1, 1, 1]}}}}, mesh: {{size: 0.7}}}}
supports: [{{on: lower.bottom, fix: [x, y, z], name: ground}}, {{on: upper.left, fix: x}}, {{on: upper.front, fix: y}}]
loads:
  weight: {{on: upper.top, traction: [0, 0, -1e5]}}
  pull: {{on: upper.top, traction: [0, 0, 6e5]}}
bars:
  bolt: {{between: [upper.top, lower.bottom], k: {K}, preload: {FORCE}, tightened: tighten}}
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: 0.3}}}}
steps:
  - {{name: settle, loads: {{weight: 1}}}}
  - {{name: tighten, increments: 2, loads: {{}}}}
  - {{name: pull, increments: 6, loads: {{pull: 1}}}}
output: {{history: {{bolt: bolt.tension, top: {{face: upper.top, about: [0.5, 0.5, 0]}}}}}}
"""


def solution_of(matrix, right):
    """By elimination with pivots."""
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    for k in range(len(rows)):
        pivot = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(len(rows)):
            if i != k:
                factor = rows[i][k] / rows[k][k]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    return [row[-1] / row[k] for k, row in enumerate(rows)]


class Bars(support.InTemporaryDirectory):
    def solve(self, text):
        (self.directory / "model.yaml").write_text(HEAD + text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return summary_of(self.directory / "results")["increments"]

    def rows(self):
        with open(self.directory / "results" / "history.csv", encoding="utf-8", newline="") as file:
            return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]

    def pairs(self):
        with open(self.directory / "results" / "contact.csv", encoding="utf-8", newline="") as file:
            return {row["pair"] for row in csv.DictReader(file)}

    def test_a_bolt_through_two_columns(self):
        """Before its step it has no force; its elongation counts from the end of its step; it takes k / (k + k_c) of a pull until the joint opens."""
        increments = self.solve(BOLTED)
        for row, increment in zip(self.rows(), increments, strict=True):
            step, part = increment["step"], increment["reached"]
            pull = 6e5 * part if step == 3 else 0.0
            preload = {1: 0.0, 2: part * FORCE, 3: FORCE}[step]
            on_joint = preload + 1e5 - pull * COLUMNS / (K + COLUMNS)
            tension = preload + (pull * K / (K + COLUMNS) if step == 3 else 0.0)
            if on_joint < 0:
                tension, on_joint = pull - 1e5, 0.0
            self.assertAlmostEqual(increment["bars"]["bolt"]["tension"], tension, delta=1e-9 * 6e5)
            self.assertEqual(row["bolt"], increment["bars"]["bolt"]["tension"])
            self.assertAlmostEqual(increment["contacts"]["joint"]["normal_force"][2], on_joint, delta=1e-9 * 6e5)
            self.assertAlmostEqual(row["top.force_z"], pull - 1e5 * (part if step == 1 else 1.0) - tension, delta=1e-9 * 6e5)
            for name in ("moment_x", "moment_y", "force_x"):
                self.assertAlmostEqual(row[f"top.{name}"], 0.0, delta=1e-9 * 6e5)
        # The columns, and the bolt beyond its preload, which counts as a load.
        for number, pull in ((2, 0.0), (6, 4e5)):
            energy, share = increments[number]["energy"], K / (K + COLUMNS)
            stored = (1e5 + FORCE - pull * (1 - share))**2 / (2 * COLUMNS) + (pull * share)**2 / (2 * K)
            self.assertAlmostEqual(energy["elastic"], stored, delta=1e-9 * stored)
            self.assertAlmostEqual(energy["external"], stored, delta=1e-9 * stored)
        pairs = len(self.pairs())
        self.assertEqual([increments[k]["contacts"]["joint"]["open"] for k in (6, 7, 8)], [0, pairs, pairs])

    def test_a_bar_without_preload_and_one_of_the_ground(self):
        """A column between a load and a prop: the load is shared by stiffness; area and young are those of the length that is drawn."""
        increments = self.solve(f"""materials: {{m: {{young: {YOUNG}, poisson: 0}}}}
bodies:
  post: {{material: m, shape: {{box: {{corner: [0, 0, 0], size: [1, 1, 2]}}}}, mesh: {{size: 1}}}}
supports: [{{on: post.bottom, fix: [x, y, z], name: ground}}]
loads: {{press: {{on: post.top, pressure: 1e5}}}}
bars: {{prop: {{between: [[0.5, 0.5, 6], post.top], area: 0.2, young: 5e9}}}}
""")
        k = 5e9 * 0.2 / 4
        self.assertAlmostEqual(increments[-1]["bars"]["prop"]["tension"], 1e5 * k / (k + COLUMNS), delta=1e-9 * 1e5)
        energy = increments[-1]["energy"]
        self.assertAlmostEqual(energy["elastic"], 1e5**2 / (2 * (k + COLUMNS)), delta=1e-9 * energy["elastic"])
        self.assertAlmostEqual(energy["external"], energy["elastic"], delta=1e-9 * energy["elastic"])

    def on_six(self, rigid, turn=IDENTITY, scale=1.0, force=1.0, preload=""):
        """A body that nothing but six bars holds; tensions in the units of the original, their closed form, and the energy."""
        self.directory.joinpath("body.inp").write_text(box((0, 0, 0), (1.2, 1.0, 0.8), (2, 2, 2), turn, scale), encoding="utf-8")
        ends = [((0, 0, 0), (-1, 0.2, -1)), ((1.2, 0, 0), (1.5, 0.5, -1)), ((1.2, 1, 0), (2, 2, -1.3)), ((0, 1, 0), (-0.5, 0.5, -1)), ((0, 0, 0.8), (0, -1.5, 1)), ((1.2, 1, 0.8), (0.4, 2.5, 0.3))]
        at, load = (0.9, 0.2, 0.8), (300.0, -500.0, -2000.0)
        place = lambda x: text_of([scale * y for y in product(turn, x)])  # noqa: E731
        lines = "".join(f"  b{k}: {{between: [{{body: body, at: {place(a)}}}, {place(b)}], k: {(1 + k) * 1e6 * force / scale!r}{preload}}}\n" for k, (a, b) in enumerate(ends))
        body = f"body: {{rigid: true, mesh: {{file: body.inp}}}}" if rigid else "body: {material: m, mesh: {file: body.inp}}"
        vector = text_of([force * x for x in product(turn, load)])
        on = "body" if rigid else "body.TOP"
        last = self.solve(f"""materials: {{m: {{young: {1e7 * force / scale**2!r}, poisson: 0.3}}}}
bodies: {{{body}}}
loads: {{push: {{on: {on}, force: {vector}, at: {place(at)}}}}}
bars:
{lines}steps: [{{name: one, loads: {{}}}}, {{name: two, loads: {{push: 1}}}}]
""")[-1]
        columns = []
        for a, b in ends:
            size = math.dist(a, b)
            e = [x / size for x in less(b, a)]
            columns.append([*e, *cross(a, e)])
        exact = solution_of([[column[i] for column in columns] for i in range(6)], [-x for x in (*load, *cross(at, load))])
        return [last["bars"][f"b{k}"]["tension"] / force for k in range(6)], exact, last["energy"]["elastic"] / (force * scale)

    def test_a_body_on_six_bars(self):
        for rigid in (True, False):
            tensions, exact, energy = self.on_six(rigid)
            for k in range(6):
                self.assertAlmostEqual(tensions[k], exact[k], delta=1e-9 * 2000)
            if rigid:
                stored = sum(tension**2 / (2e6 * (1 + k)) for k, tension in enumerate(exact))
                self.assertAlmostEqual(energy, stored, delta=1e-9 * stored)
            for turn, scale, force in ((rotation(3), 1.0, 1.0), (IDENTITY, 1e3, 1.0), (rotation(8), 1e3, 1e-3)):
                again, _, stored = self.on_six(rigid, turn, scale, force)
                for k in range(6):
                    self.assertAlmostEqual(again[k], tensions[k], delta=1e-9 * 2000)
                self.assertAlmostEqual(stored, energy, delta=1e-9 * energy)

    def test_bars_that_wait_hold_nothing(self):
        """Without a stiffness in its step a bar does not hold a body: a mechanism, whose motion is that of the body."""
        (self.directory / "model.yaml").write_text(HEAD + """bodies: {body: {rigid: true, shape: {box: {corner: [0, 0, 0], size: [1, 1, 1]}}, mesh: {size: 1}}}
supports: [{on: body, displacement: [0, 0, null], rotation: [0, 0, 0]}]
loads: {push: {on: body, force: [0, 0, -5]}}
bars: {hanger: {between: [{body: body, at: [0.5, 0.5, 1]}, [0.5, 0.5, 3]], k: 100, preload: 3}}
steps: [{name: hang, loads: {push: 1}}]
""", encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 2, done.stderr)
        summary = summary_of(self.directory / "results")
        self.assertEqual(summary["status"], "mechanism")
        self.assertAlmostEqual(summary["mechanism"]["work"], 2.0, delta=1e-9)  # the push less the preload

    def test_a_run_that_was_interrupted_goes_on(self):
        text = HEAD + BOLTED.replace("size: 0.5", "size: 0.25").replace("size: 0.7", "size: 0.3")
        (self.directory / "model.yaml").write_text(text, encoding="utf-8")
        whole, broken = self.directory / "whole", self.directory / "broken"
        self.assertEqual(scabo("run", self.directory / "model.yaml", "-o", whole, "--quiet").returncode, 0)
        interrupt(self, self.directory / "model.yaml", broken)
        self.assertEqual(scabo("resume", broken, "--quiet").returncode, 0)
        for name in ("history.csv", "contact.csv"):
            self.assertTrue(filecmp.cmp(whole / name, broken / name, shallow=False), name)

    def test_a_restart_goes_on_with_them(self):
        """In the step after the one in which a bar is tightened, and with its stiffness at work."""
        text = BOLTED.replace("increments: 6, loads: {pull: 1}}", "increments: 2, loads: {pull: 0.3}}\n  - {name: more, increments: 2, loads: {pull: 1}}")
        whole = self.solve(text)
        self.assertEqual(len(whole), 7)
        model, steps = text.split("steps:\n")[0], text.split("steps:\n")[1].split("output")[0].splitlines(keepends=True)
        for first, name in ((2, "tightened"), (3, "pulled")):
            (self.directory / "one.yaml").write_text(HEAD + model + "steps:\n" + "".join(steps[:first]), encoding="utf-8")
            done = scabo("run", self.directory / "one.yaml", "-o", self.directory / f"{name}.results", "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            rest = self.solve(model.replace(", tightened: tighten", "") + f"restart: {name}.results\nsteps:\n" + "".join(steps[first:]))
            for one, other in zip(rest, whole[-len(rest):], strict=True):
                self.assertAlmostEqual(one["bars"]["bolt"]["tension"], other["bars"]["bolt"]["tension"], delta=1e-9 * 6e5)
                for key in ("external", "elastic"):
                    self.assertAlmostEqual(one["energy"][key], other["energy"][key], delta=1e-9 * other["energy"]["elastic"])
        (self.directory / "two.yaml").write_text(HEAD + model + "restart: pulled.results\nsteps:\n" + steps[1] + steps[3], encoding="utf-8")
        done = scabo("run", self.directory / "two.yaml")
        self.assertEqual(done.returncode, 1)
        self.assertIn("bar 'bolt' has been tightened in 'pulled.results' already: leave 'tightened' out", done.stderr)
        (self.directory / "two.yaml").write_text(HEAD + model.replace(", tightened: tighten", "").replace(f"k: {K}", "k: 1e8")
                                                 + "restart: pulled.results\nsteps:\n" + steps[3], encoding="utf-8")
        done = scabo("run", self.directory / "two.yaml")
        self.assertEqual(done.returncode, 1)
        self.assertIn("bar 'bolt' is not the same as in ", done.stderr)

    def test_a_body_takes_its_bar_with_it(self):
        """The tension of a bar, its preload too, falls to nothing while its body is removed; another one begins with its body."""
        increments = self.solve(f"""materials: {{m: {{young: {YOUNG}, poisson: 0}}}}
bodies:
  post: {{material: m, shape: {{box: {{corner: [0, 0, 0], size: [1, 1, 2]}}}}, mesh: {{size: 1}}}}
  beam: {{rigid: true, shape: {{box: {{corner: [0, 0, 5], size: [1, 1, 1]}}}}, mesh: {{size: 1}}, removed: free}}
  late: {{rigid: true, shape: {{box: {{corner: [0, 0, 5], size: [1, 1, 1]}}}}, mesh: {{size: 1}}, added: again}}
supports: [{{on: post.bottom, fix: [x, y, z], name: ground}}, {{on: beam, fix: [x, y, z]}}, {{on: late, fix: [x, y, z]}}]
loads: {{press: {{on: post.top, traction: [0, 0, -1e5]}}}}
bars:
  tie: {{between: [post.top, beam.bottom], k: {K}, preload: 5e4, tightened: tighten}}
  next: {{between: [post.top, late.bottom], k: {K}}}
steps:
  - {{name: tighten, loads: {{}}}}
  - {{name: press, increments: 2, loads: {{press: 1}}}}
  - {{name: free, increments: 2, loads: {{}}}}
  - {{name: again, loads: {{press: 2}}}}
""")
        share = K / (K + COLUMNS)
        ties = [5e4, 5e4 + 0.5e5 * share, 5e4 + 1e5 * share, 0.0, 0.0, 0.0]
        pulls = [*ties[:3], 0.5 * ties[2], 0.0, 1e5 * share]  # at the top of the post
        for increment, tie, pull, press in zip(increments, ties, pulls, [0, 0.5e5, 1e5, 1e5, 1e5, 2e5], strict=True):
            self.assertAlmostEqual(increment["bars"]["tie"]["tension"], tie, delta=1e-9 * 2e5)
            self.assertAlmostEqual(increment["reactions"]["ground"][2], press - pull, delta=1e-9 * 2e5)
            energy, in_bar = increment["energy"], max(tie - 5e4, 0.0) + (pull if press == 2e5 else 0.0)
            stored = (press - pull)**2 / (2 * COLUMNS) + in_bar**2 / (2 * K)
            self.assertAlmostEqual(energy["elastic"], stored, delta=1e-9 * 1e5**2 / COLUMNS)
            self.assertAlmostEqual(energy["external"], stored, delta=1e-9 * 1e5**2 / COLUMNS)
        self.assertAlmostEqual(increments[-1]["bars"]["next"]["tension"], 1e5 * share, delta=1e-9 * 2e5)


if __name__ == "__main__":
    support.main()
