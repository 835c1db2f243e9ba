"""A press fit with large slip: pressed together, pushed and pulled out; twins, resuming and restarting."""
import math

import support
from large_slip_test import LargeSlipRuns, RestartRuns, ResumeRuns, model_of, rectangle, text_of, turned

# Half of a bar that is pressed together with a jaw and pushed out of it, as in example 23. m, N, Pa.
HALF, JAW, OVERLAP, YOUNG, POISSON, INTERFERENCE = 10e-3, 10e-3, 100e-3, 210e9, 0.3, 10e-6
GRIP = 0.15
SLID = 80e-6           # by which one end moves until all of the bar slides


def press_fit(way=60e-3, increments=6, pulled=True, drawn_at=0.0, angle=0.0, scale=1.0, swapped=False, mesh=None, length=OVERLAP,
              slip="large", sign=-1.0):
    """Overlapping by 100 mm less `drawn_at`; `scale`: 1000 in mm, N and MPa."""
    mesh = {"size": 10e-3 * scale, "order": 2, **(mesh or {})}
    along, across = turned([1, 0], angle, 1.0), turned([0, 1], angle, 1.0)
    bar = rectangle([drawn_at, 0], [drawn_at + length, HALF], angle, scale)
    jaw = rectangle([0, HALF], [OVERLAP, HALF + JAW], angle, scale)
    between = ["jaw.bottom", "bar.top"] if swapped else ["bar.top", "jaw.bottom"]
    return model_of({
        "scabo": 1, "analysis": {"plane": "stress", "thickness": 40e-3 * scale},
        "materials": {"steel": {"young": YOUNG / scale**2, "poisson": POISSON}},
        "bodies": {"bar": {"material": "steel", "mesh": mesh, "shape": bar}, "jaw": {"material": "steel", "mesh": mesh, "shape": jaw}},
        "supports": [{"on": "bar.bottom", "fix": "normal"}, {"on": "jaw.top", "fix": "normal"}, {"on": "jaw.right", "fix": "normal"},
                     {"name": "push", "on": "bar.right" if pulled else "bar.left",
                      "displacement": {"along": along, "value": way * scale}}],
        "contacts": {"fit": {"between": between, "friction": GRIP, "gap": sign * INTERFERENCE * scale, "fit_in": "press", "slip": slip}},
        "steps": [{"name": "press", "friction": {"fit": 0}, "loads": {"push": 0}}, {"name": "grip", "friction": {"fit": GRIP}},
                  {"name": "slide", "increments": 2, "loads": {"push": SLID / way}},
                  {"name": "push", "increments": increments, "loads": {"push": 1}}],
        "output": {"fields": []}})


def force_of_fit(overlap, pulled):
    """Of one half, by hand: examples/23_push_out/hand.py, where it is derived."""
    pressure = YOUNG * INTERFERENCE / (HALF + JAW - (0 if pulled else POISSON * GRIP * overlap))
    return GRIP * pressure * overlap * 40e-3


class PressFit(LargeSlipRuns):
    def forces(self, increments):
        """Of the contact in the last step, with the overlap of its pairs."""
        self.assertEqual([one["step"] for one in increments[:4]], [1, 2, 3, 3])
        for one in increments[4:]:
            fit = one["contacts"]["fit"]
            if fit["normal_force"] > 0:
                self.assertAlmostEqual(abs(fit["tangential_force"]) / fit["normal_force"], GRIP, delta=1e-9)
        return [abs(one["contacts"]["fit"]["tangential_force"]) for one in increments[4:]]

    def test_force_falls_with_the_overlap(self):
        for pulled in (True, False):
            with self.subTest(pulled=pulled):
                increments = self.solve(press_fit(pulled=pulled, increments=12, mesh={"size": 5e-3}), warned=True)
                area = OVERLAP * 40e-3
                pressed = YOUNG * INTERFERENCE / (HALF + JAW) * area
                self.assertAlmostEqual(increments[0]["contacts"]["fit"]["normal_force"] / pressed, 1, delta=1e-9)
                # With the whole overlap all of it is uniform, and the closed form exact.
                slid = abs(increments[3]["contacts"]["fit"]["tangential_force"])
                self.assertAlmostEqual(slid / force_of_fit(OVERLAP, pulled), 1, delta=2e-4)
                # Then stress spreads into what sticks out, which is the same at any overlap: it is one of a little more length.
                forces = self.forces(increments)
                more = [self.length_of(force, pulled) - (OVERLAP - (k + 1) * 5e-3) for k, force in enumerate(forces)]
                self.assertTrue(0.9e-3 < min(more) and max(more) < 1.7e-3, more)
                # Work: of the forces along the way; what is stored in the bar and not lost with the overlap is the rest.
                friction = [one["energy"]["friction"] for one in increments[4:]]
                for k in range(11):
                    by_hand = (forces[k] + forces[k + 1]) / 2 * 5e-3
                    self.assertAlmostEqual((friction[k + 1] - friction[k]) / by_hand, 1, delta=3e-3)
                first, last = increments[3]["energy"], increments[-1]["energy"]
                self.assertAlmostEqual((last["external"] - first["external"]) / (last["friction"] - first["friction"]), 1, delta=2e-3)
                self.assertLess(last["elastic"], 0.55 * first["elastic"])

    def length_of(self, force, pulled):
        """Overlap that has this force by hand."""
        low, high = 0.0, 2 * OVERLAP
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if force_of_fit(middle, pulled) < force else (low, middle)
        return low

    def test_it_is_as_if_pressed_where_it_has_been_pushed_to(self):
        """Once all slides, the way there does not matter: the same bar drawn at 40 mm, without large slip."""
        for pulled in (True, False):
            fine = {"pulled": pulled, "mesh": {"size": 5e-3}}
            pushed = self.forces(self.solve(press_fit(way=40e-3, increments=4, **fine), warned=True))[-1]
            drawn = self.solve(press_fit(way=0.2e-3, increments=1, drawn_at=40e-3, slip="small", **fine), name="drawn")[-1]
            self.assertAlmostEqual(pushed / abs(drawn["contacts"]["fit"]["tangential_force"]), 1, delta=1e-3)  # 0.04 mm of stretch

    def test_twins(self):
        plain = self.forces(self.solve(press_fit(increments=3), warned=True))
        for other, tolerance in (({"angle": math.radians(30), "scale": 1e3}, 1e-8), ({"swapped": True}, 1e-9),
                                 ({"mesh": {"kind": "quadtree"}}, 1e-2), ({"mesh": {"kind": "fem"}}, 1e-2)):
            with self.subTest(other=other):
                for one, twin in zip(plain, self.forces(self.solve(press_fit(increments=3, **other), warned=True)), strict=True):
                    self.assertAlmostEqual(twin / one, 1, delta=tolerance)

    def test_a_whole_bar_that_slides_while_the_interference_grows(self):
        """Between two jaws that alone hold it across, with all of its rigid motions but one: each carries what the half has."""
        half = self.forces(self.solve(press_fit(increments=6), warned=True))
        text = press_fit(increments=3).replace(", {on: bar.bottom, fix: normal}", "").replace("[{on: bar.bottom, fix: normal}, ", "[")
        bar = rectangle([0, 0], [OVERLAP, HALF], 0.0, 1.0)
        self.assertIn(text_of(bar), text)
        text = text.replace(text_of(bar), text_of(rectangle([0, -HALF], [OVERLAP, HALF], 0.0, 1.0)))
        lower = {"material": "steel", "mesh": {"size": 10e-3, "order": 2},
                 "shape": rectangle([0, -HALF - JAW], [OVERLAP, -HALF], 0.0, 1.0)}
        text = text.replace("bodies: {", "bodies: {lower: " + text_of(lower) + ", ")
        text = text.replace("supports: [", "supports: [{on: lower.bottom, fix: normal}, {on: lower.right, fix: normal}, ")
        fit = text.split("contacts: {fit: ")[1].split("}\n")[0]
        text = text.replace("contacts: {", "contacts: {low: " + fit.replace("bar.top, jaw.bottom", "lower.top, bar.bottom") + ", ")
        begin = text.index("steps: [")
        text = text[:begin] + ("steps: [{name: press, increments: 6, loads: {push: 0.5}}, {name: push, increments: 3, loads: {push: 1}}]\n"
                               "output: {fields: []}\n")
        increments = self.solve(text, warned=True)
        self.assertEqual(len(increments), 9)
        for one, by_half in zip(increments[5:], half[2:], strict=True):
            upper, lower = (one["contacts"][name] for name in ("fit", "low"))
            self.assertAlmostEqual(upper["normal_force"] / lower["normal_force"], 1, delta=1e-8)
            self.assertAlmostEqual(abs(upper["tangential_force"]) / by_half, 1, delta=2e-3)
            self.assertAlmostEqual(abs(upper["tangential_force"]) / upper["normal_force"], GRIP, delta=1e-8)

    def test_pushed_in_again_and_right_through(self):
        """The overlap grows as it fell; beyond the jaw nothing is left."""
        text = press_fit(way=40e-3, increments=4)
        text = text.replace("increments: 4, loads: {push: 1}}]", "increments: 4, loads: {push: 1}}, "
                            "{name: back, increments: 4, loads: {push: 0}}]")
        back = self.forces(self.solve(text, warned=True))
        for there, here in zip(back[:3], reversed(back[4:-1])):
            self.assertAlmostEqual(here / there, 1, delta=0.03)  # jaw and bar are pulled the other way: see pushed and pulled
        increments = self.solve(press_fit(way=120e-3, increments=12), warned=True)
        self.assertEqual([one["contacts"]["fit"]["normal_force"] for one in increments[-2:]], [0.0, 0.0])
        self.assertLess(increments[-1]["energy"]["elastic"], 1e-9 * increments[0]["energy"]["elastic"])


class Resume(ResumeRuns):
    def test_a_killed_run_gives_the_same_bits(self):
        self.kill(press_fit(increments=40, mesh={"kind": "polygons"}), 44)  # of which most are not solved anew


class Restart(RestartRuns):
    def test_two_runs_are_one(self):
        whole = press_fit(increments=4).replace("loads: {push: 1}}]", "loads: {push: 0.5}}, {name: more, increments: 4, loads: {push: 1}}]")
        first = whole.replace(", {name: more, increments: 4, loads: {push: 1}}", "")
        begin = whole.index("steps: [") + len("steps: [")
        second = whole[:begin] + whole[whole.index("{name: more"):]
        self.check(first, second.replace("fit_in: press, ", ""), whole)


if __name__ == "__main__":
    support.main()
