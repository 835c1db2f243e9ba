"""Supports that begin or end in a step: over a restart, in a run that is resumed, and in decks."""
import shutil
import signal
import subprocess
import time

import support
from decks import END, HELD, MATERIAL, PRESSED, SQUARE, STATIC, Converting, grid
from support import rows_of, scabo, summary_of

# A beam on a shoe with friction, and a prop at its end that is struck; another one comes, lifts and goes, then the shoe
# goes that springs catch.
BEAM = """scabo: 1
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies:
  beam: {material: steel, shape: {rectangle: {corner: [0, 0], size: [4, 0.2]}}, mesh: {kind: fem, size: 0.1}}
  shoe: {rigid: true, shape: {rectangle: {corner: [1.5, -0.2], size: [0.4, 0.2]}}}
supports:
  - {on: beam.left, fix: [x, y], name: wall}
  - {on: shoe, fix: [x, y], name: footFOOT}
PROP
LATER
springs: [{on: shoe.bottom, k_n: 1e10, k_t: 1e10}]
loads: {q: {on: beam.top, traction: [0, -5e3]}}
contacts: {seat: {between: [shoe.top, beam.bottom], friction: 0.4}}
RESTART
steps: [STEPS]
"""
PROP = "  - {on: beam.bottom_right, fix: y, name: propSTAGE}"
LATER = "  - {on: beam.bottom_right, displacement: [null, 2e-3], name: laterSTAGE}"
LOAD = "{name: load, loads: {q: 1}}"
STRIKE = "{name: strike, increments: 2}"
MORE = "{name: place}, {name: more, increments: 3, loads: {q: 3}}, {name: lift, loads: {later: 1}}"
AWAY = "{name: off, increments: 2}, {name: away, increments: 2}"


def beam(steps, foot="", prop=None, later=None, restart=""):
    lines = {"FOOT": foot, "PROP": "" if prop is None else PROP.replace("STAGE", prop),
             "LATER": "" if later is None else LATER.replace("STAGE", later),
             "RESTART": restart and f"restart: {restart}", "STEPS": steps}
    text = BEAM
    for key, value in lines.items():
        text = text.replace(key, value)
    return text


class Runs(support.InTemporaryDirectory):
    def run_model(self, name, text):
        (self.directory / f"{name}.yaml").write_text(text, encoding="utf-8")
        run = scabo("run", f"{name}.yaml", "--quiet", cwd=self.directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        return summary_of(self.directory / f"{name}.results")["increments"]

    def whole(self):
        return self.run_model("whole", beam(", ".join([LOAD, STRIKE, MORE, AWAY]), ", removed: away",
                                            ", removed: strike", ", added: place, removed: off"))

    def assert_same(self, one, other):
        for name, reaction in other["reactions"].items():
            for a, b in zip(one["reactions"].get(name, [0, 0]), reaction):
                self.assertAlmostEqual(a, b, delta=1e-9 * 3e4, msg=name)
        for name in ("external", "elastic", "friction"):
            self.assertAlmostEqual(one["energy"][name], other["energy"][name], delta=1e-8)

    def test_a_support_that_has_begun_goes_on_and_ends_after_a_restart(self):
        first = self.run_model("one", beam(", ".join([LOAD, STRIKE, MORE]), "", ", removed: strike", ", added: place"))
        second = self.run_model("two", beam("{name: rest, loads: {}}, " + AWAY, ", removed: away", None,
                                            ", removed: off", "one.results"))
        self.assert_same(second[0], first[-1])
        for one, other in zip(first + second[1:], self.whole(), strict=True):
            self.assert_same(one, other)

    def test_a_support_that_lasts_in_one_run_ends_in_the_next(self):
        first = self.run_model("one", beam(LOAD, "", ""))
        second = self.run_model("two", beam("{name: rest, loads: {}}, " + ", ".join([STRIKE, MORE, AWAY]),
                                            ", removed: away", ", removed: strike", ", added: place, removed: off",
                                            "one.results"))
        self.assert_same(second[0], first[-1])
        self.assertGreater(abs(first[-1]["reactions"]["prop"][1]), 1e3)
        for one, other in zip(first + second[1:], self.whole(), strict=True):
            self.assert_same(one, other)

    def test_without_any_contact(self):
        """A rigid lid on springs, which a support held whole in the first run, and a disc, whose rim another one held."""
        text = """scabo: 1
materials: {s: {young: 2e9, poisson: 0.2, density: 2000}}
bodies:
  disc: {material: s, shape: {circle: {centre: [0, 0], radius: 1}}, mesh: {kind: polygons, size: 0.25}}
  lid: {rigid: true, shape: {rectangle: {corner: [-1, 2], size: [2, 0.5]}}}
supports:
  - {on: disc.rim, fix: normal, name: rimRIM}
  - {on: {body: disc, near: [0, -1]}, fix: [x, y], name: foot}
  - {on: {body: disc, near: [1, 0]}, fix: {along: [1, 2]}, name: side}
  - {on: lid, fix: [x, y], name: wholeLID}
springs: [{on: lid.bottom, k_n: 1e7, k_t: 1e7}]
loads: {w: {on: disc, gravity: [0, -10]}, q: {on: lid.top_left, force: [1e3, -2e4]}}
RESTART
steps: [STEPS]
"""
        filled = lambda steps, rim="", lid="", restart="": (text.replace("STEPS", steps).replace("RIM", rim).replace("LID", lid)
                                                            .replace("RESTART", restart))
        ends = "{name: b, increments: 2}, {name: c, increments: 2}"
        whole = self.run_model("whole", filled("{name: a}, " + ends, ", removed: b", ", removed: c"))
        first = self.run_model("one", filled("{name: a}"))
        second = self.run_model("two", filled("{name: rest, loads: {}}, " + ends, ", removed: b", ", removed: c", "restart: one.results"))
        for increment in whole + first + second:
            self.assertAlmostEqual(increment["energy"]["external"], increment["energy"]["elastic"], delta=1e-9)
        for one, other in zip(second, whole, strict=True):
            self.assert_same(one, other)

    def test_a_support_that_ends_in_the_first_step_of_a_restart_is_refused(self):
        self.run_model("one", beam(LOAD, "", ""))
        (self.directory / "two.yaml").write_text(beam(STRIKE, "", ", removed: strike", None, "one.results"))
        run = scabo("run", "two.yaml", cwd=self.directory)
        self.assertEqual(run.returncode, 1)
        self.assertIn("put a step before it in which nothing changes", run.stderr)

    def test_a_run_that_is_resumed_is_the_unbroken_one(self):
        self.whole()
        broken = self.directory / "broken"
        for after in (2, 5, 9):
            process = subprocess.Popen([support.SCABO, "run", self.directory / "whole.yaml", "-o", broken, "--quiet"],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while process.poll() is None and not (broken / f"fields_{after:04d}.vtu").exists():
                time.sleep(0.001)
            process.send_signal(signal.SIGINT)
            process.wait()
            self.assertIn(scabo("resume", broken, "--quiet").returncode, (0, 1))
            self.assertEqual(rows_of(broken), rows_of(self.directory / "whole.results"))


class Decks(Converting):
    def increments(self):
        run = scabo("run", "part.yaml", "--quiet", cwd=self.directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        return summary_of(self.directory / "part.results")["increments"]

    def reaction(self, increment, name):
        return next(of for key, of in increment["reactions"].items() if key.upper() == name)

    def test_a_support_that_new_ones_take_back_ends(self):
        """A square that its left side holds, and its right side under pressure beside it, until OP=NEW lets go of that:
        the left side then carries the pressure alone."""
        run = self.convert(SQUARE + HELD + "*BOUNDARY\nN_BODY_RIGHT, 1\n" + PRESSED + STATIC
                           + "*BOUNDARY, OP=NEW\nN_BODY_LEFT, 1, 2\n" + END)
        self.assertEqual(run.returncode, 0, run.stderr)
        text = (self.directory / "part.yaml").read_text()
        self.assertEqual(text.count("removed: step_2"), 1, text)
        first, last = self.increments()
        pressed = -self.reaction(first, "N_BODY_RIGHT")[0] - self.reaction(first, "N_BODY_LEFT")[0]
        self.assertGreater(abs(self.reaction(first, "N_BODY_RIGHT")[0]), 0.9 * abs(pressed))
        self.assertEqual(self.reaction(last, "N_BODY_RIGHT"), [0.0, 0.0])
        self.assertAlmostEqual(self.reaction(last, "N_BODY_LEFT")[0] / -pressed, 1.0, delta=1e-9)

    def test_a_support_that_begins_where_its_nodes_are(self):
        """The square keeps its length without the pressure: the side that is held then has taken it over."""
        run = self.convert(SQUARE + HELD + PRESSED + STATIC + "*BOUNDARY, FIXED\nN_BODY_RIGHT, 1, 1\n*DSLOAD, OP=NEW\n" + END)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("added: step_2", (self.directory / "part.yaml").read_text())
        first, last = self.increments()
        pressed = -self.reaction(first, "N_BODY_LEFT")[0]
        self.assertAlmostEqual(self.reaction(last, "N_BODY_RIGHT")[0] / pressed, 1.0, delta=1e-9)
        self.assertAlmostEqual(self.reaction(last, "N_BODY_LEFT")[0] / -pressed, 1.0, delta=1e-9)

    def test_as_calculix(self):
        """Under a pressure on its top the right side of a square is held where it is (FIXED) before the pressure becomes three times as large; or it
        is drawn, and let go by OP=NEW. Reactions of CalculiX 2.20, to the seven digits that it prints."""
        square = grid(4, 4, 2.0, 2.0, kind="CPE8") + MATERIAL + "*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n" + HELD
        top = "*DSLOAD\nBODY_TOP, P, {}\n"
        self.assertEqual(self.convert(square + STATIC + top.format("1e6") + END + STATIC + "*BOUNDARY, FIXED\nN_BODY_RIGHT, 1, 2\n"
                                      + top.format("3e6") + END).returncode, 0)
        self.assertAlmostEqual(self.reaction(self.increments()[-1], "N_BODY_RIGHT")[0] / -6.376355e5, 1.0, delta=2e-7)
        shutil.rmtree(self.directory / "part.results")
        self.assertEqual(self.convert(square + STATIC + "*BOUNDARY\nN_BODY_RIGHT, 1, 1, 1e-4\n" + top.format("1e6") + END + STATIC
                                      + "*BOUNDARY, OP=NEW\nN_BODY_LEFT, 1, 2\n" + END).returncode, 0)
        first, last = self.increments()
        self.assertAlmostEqual(self.reaction(first, "N_BODY_RIGHT")[0] / 2.333194e7, 1.0, delta=2e-7)
        self.assertAlmostEqual(self.reaction(last, "N_BODY_LEFT")[0], 0.0, delta=1e-6)
        self.assertAlmostEqual(self.reaction(last, "N_BODY_LEFT")[1] / 2e6, 1.0, delta=1e-9)

    def test_a_support_that_begins_elsewhere_or_again_is_refused(self):
        run = self.convert(SQUARE + HELD + PRESSED + STATIC + "*BOUNDARY\nN_BODY_RIGHT, 1, 1\n" + END)
        self.assertEqual(run.returncode, 1)
        self.assertIn("the support begins in step 2, and moves its nodes from where they are then", run.stderr)
        again = STATIC + "*BOUNDARY, OP=NEW\nN_BODY_BOTTOM, 2\n" + END + STATIC + "*BOUNDARY\nN_BODY_BOTTOM, 1\n" + END
        run = self.convert(SQUARE + HELD + PRESSED + again)
        self.assertEqual(run.returncode, 1)
        self.assertIn("the support ends in step 2 by OP=NEW and begins again in step 3", run.stderr)


if __name__ == "__main__":
    support.main()
