"""Models whose outcome once depended on units, axes, the order of bodies or a scale that was zero, each with its twins:
in other units, turned, with other sides and bodies first, with a finer mesh, in more increments. With sanitizers a sample."""
import math
import unittest

import support
from drawing import TWINS, Drawing
from support import LONG, SANITIZED, scabo, summary_of

SAMPLE = TWINS[::3] if SANITIZED else TWINS


class Twins(support.InTemporaryDirectory):
    def run_model(self, text):
        """Exit status, standard error and the summary."""
        path = self.directory / "model.yaml"
        path.write_text(text, encoding="utf-8")
        run = scabo("run", path, "--quiet")
        return run.returncode, run.stderr, summary_of(self.directory / "model.results")

    def solve(self, text):
        status, errors, summary = self.run_model(text)
        self.assertEqual((status, summary["status"]), (0, "solved"), errors)
        self.assertLessEqual(max(map(support.certificate_of, summary["increments"])), 1e-10)
        return summary

    def stops_as_mechanism(self, text):
        status, errors, summary = self.run_model(text)
        self.assertEqual((status, summary["status"]), (2, "mechanism"), errors)
        return summary


def pile(draw, kind="quadtree", size=2.0, increments=1, dig=8):
    """A wall wished in place in ground at rest, of which 4 m are dug out before it."""
    deep, dug, thick = 12.0, 4.0, 0.4
    fine = {"kind": kind, "size": draw.length(size)}
    refined = [{"on": on, "size": draw.length(by * size)} for on, by in (("front", 0.2), ("back", 0.2), ("foot", 0.1))]
    friction = {"friction": 0.36}
    field = {"vertical": {"unit_weight": draw.per_volume(18e3), "surface": 0, "up": draw.vector(0, 1)}, "K0": 0.5}
    return draw.text({
        "analysis": {"plane": "strain"},
        "materials": {"soil": {"young": draw.stress(60e6), "poisson": 0.3},
                      "concrete": {"young": draw.stress(10e9), "poisson": 0.2}},
        "bodies": {
            "ground": {"material": "soil", "mesh": {**fine, "refine": refined}, "shape": draw.polygon(
                [(-30, -20), (30, -20), (30, -dug), (thick, -dug), (thick, -deep), (0, -deep), (0, 0), (-30, 0)],
                base="edge_1", east="edge_2", dredge="edge_3", front="edge_4", foot="edge_5", back="edge_6", west="edge_8")},
            "pit": {"material": "soil", "mesh": {**fine, "refine": [{"on": "left", "size": draw.length(0.2 * size)}]},
                    "removed": "dig", "shape": draw.box(thick, -dug, 30 - thick, dug)},
            "wall": {"material": "concrete", "mesh": {"kind": "polygons", "size": draw.length(0.2 * size)},
                     "shape": draw.box(0, -deep, thick, deep)},
        },
        "supports": [*draw.fixed("ground.base", (1, 0), (0, 1)), *draw.fixed("ground.west", (1, 0)),
                     *draw.fixed("ground.east", (1, 0)), *draw.fixed("pit.right", (1, 0))],
        "loads": {"rest": {"field": field}},
        "contacts": {
            "back": {"between": ["ground.back", "wall.left"], **friction},
            "front": {"between": ["wall.right", "ground.front"], **friction},
            "front_pit": {"between": ["wall.right", "pit.left"], **friction},
            "foot": {"between": ["ground.foot", "wall.bottom"], **friction},
            "joint": {"between": ["ground.dredge", "pit.bottom"], "bond": True},
        },
        "steps": [{"name": "rest", "increments": increments, "loads": {"rest": 1}}, {"name": "dig", "increments": dig}],
    })


class GroundAtRest(Twins):
    """Hardly anything moves under large forces: the earth pressure is K0 w D^2 / 2 = 648 kN/m, whatever is beside it."""

    def at_rest(self, text, delta=1e-3):
        summary = self.solve(text)
        rest = [increment for increment in summary["increments"] if increment["step"] == 1][-1]
        self.assertAlmostEqual(rest["contacts"]["back"]["normal_force"] / 648e3, 1.0, delta=delta)
        self.assertFalse([warning for warning in summary["warnings"] if "friction has dissipated" in warning])
        return summary

    def test_then_dug_out(self):
        dig = 2 if SANITIZED else 8
        summary = self.at_rest(pile(Drawing(), dig=dig))
        self.assertEqual(len(summary["increments"]), 1 + dig)

    def test_of_other_cells(self):
        for kind in ("polygons", "fem"):
            with self.subTest(kind=kind):
                self.at_rest(pile(Drawing(), kind, dig=1), delta=2e-3)  # on other meshes

    def test_in_increments_and_finer(self):
        self.at_rest(pile(Drawing(), increments=3, dig=1))
        self.at_rest(pile(Drawing(), size=1.5, dig=1))

    @unittest.skipUnless(LONG, "20 s of a processor, and minutes where it rounds otherwise: make test-long")
    def test_in_ten_increments(self):
        self.at_rest(pile(Drawing(), increments=10, dig=1))


def leaves(draw, increments=(40, 40), final=0.0, count=3, size=0.02, force=300.0):
    """Slender leaves on each other, clamped at the left; the upper one is bent down and let go."""
    low = draw.vector(0, -force)
    return draw.text({
        "analysis": {"plane": "stress", "thickness": 0.05},
        "materials": {"steel": {"young": draw.stress(210e9), "poisson": 0.3}},
        "bodies": {f"l{k}": {"material": "steel", "shape": draw.box(0, 0.01 * k, 1.0, 0.01),
                             "mesh": {"kind": "fem", "size": draw.length(size), "order": 2}} for k in range(count)},
        "supports": [item for k in range(count) for item in draw.fixed(f"l{k}.left", (1, 0), (0, 1))],
        "loads": {"tip": {"on": f"l{count - 1}.right", "force": low}},
        "contacts": {f"c{k}": {"between": [f"l{k}.top", f"l{k + 1}.bottom"], "friction": 0.3} for k in range(count - 1)},
        "steps": [{"name": "load", "increments": increments[0]},
                  {"name": "unload", "increments": increments[1], "loads": {"tip": final}}],
    })


class LoadThatReturnsToZero(Twins):
    """What is left is judged against the load that was there, not against nothing."""

    def unloaded(self, text, force=300.0):
        last = self.solve(text)["increments"][-1]
        for contact in last["contacts"].values():
            self.assertLess(abs(contact["normal_force"]), 1e-8 * force)
            self.assertLess(abs(contact["tangential_force"]), 1e-8 * force)

    @unittest.skipIf(SANITIZED, "in fewer increments it is tested as well")
    def test_of_three_leaves(self):
        self.unloaded(leaves(Drawing()))

    def test_in_few_increments(self):
        for increments in ((1, 1), (4, 10), (10, 3)):
            with self.subTest(increments=increments):
                self.unloaded(leaves(Drawing(), increments))

    def test_in_other_units_turned_and_in_another_order(self):
        for draw in SAMPLE[1:]:
            with self.subTest(draw=draw):
                self.unloaded(leaves(draw, (5, 10)))

    def test_of_two_leaves_and_finer_ones(self):
        self.unloaded(leaves(Drawing(), (5, 10), count=2))
        self.unloaded(leaves(Drawing(), (5, 10), size=0.01))


def pressed_block(draw, side=1e-3, fine=4, increments=1):
    """A block between a floor and a platen along which it may slide: nothing holds it against the push."""
    size = draw.length(side / fine)
    return draw.text({
        "materials": {"m": {"young": draw.stress(1e9), "poisson": 0.3}},
        "bodies": {"lower": {"material": "m", "mesh": {"size": size}, "shape": draw.box(0, 0, side, side)},
                   "upper": {"material": "m", "mesh": {"size": size}, "shape": draw.box(0, side, side, side)}},
        "supports": [*draw.fixed("lower.bottom", (1, 0), (0, 1)),
                     {"on": "upper.top", "displacement": {"along": draw.vector(0, 1), "value": -draw.length(1e-4 * side)}}],
        "loads": {"push": {"on": "upper.left", "traction": draw.traction(1000.0, 0.0)}},
        "contacts": {"c": {"between": ["lower.top", "upper.bottom"]}},
        "steps": [{"name": "s", "increments": increments}],
    })


class Mechanisms(Twins):
    def test_a_block_without_friction_is_one_at_any_size(self):
        for side in (1e-3, 1e-4, 1e-2, 1.0, 37.0):
            for draw in SAMPLE:
                with self.subTest(side=side, draw=draw):
                    self.stops_as_mechanism(pressed_block(draw, side))

    def test_finer_and_in_ten_increments(self):
        self.stops_as_mechanism(pressed_block(Drawing(), fine=10))
        self.stops_as_mechanism(pressed_block(Drawing(metre=10.0), increments=10))

    def test_a_shallow_rigid_segment_pushed_beyond_its_friction(self):
        for push, solved in ((1.0, False), (0.5, False), (0.35, True)):
            for draw in SAMPLE:
                with self.subTest(push=push, draw=draw):
                    text = segment(draw, push)
                    if solved:
                        total = self.solve(text)["increments"][-1]["contacts"]["c"]
                        self.assertAlmostEqual(abs(total["tangential_force"]) / 1e5, push, delta=0.02)
                    else:
                        self.stops_as_mechanism(text)


def segment(draw, push, radius=50.0, half=0.5, size=0.25):
    """A flat rigid segment of a circle on a block, pressed by 100 kN and pushed by a part of that; friction 0.4."""
    angle = math.asin(half / radius)
    x, y = radius * math.sin(angle), radius * (1 - math.cos(angle))
    return draw.text({
        "materials": {"m": {"young": draw.stress(1e9), "poisson": 0.3}},
        "bodies": {
            "b": {"material": "m", "mesh": {"size": draw.length(size)}, "shape": draw.box(-0.5, -0.5, 1.0, 0.5)},
            "r": {"rigid": True, "shape": {"outline": [draw.arc("rim", (-x, y), (x, y), (0, radius)), draw.line("top", (-x, y))]}},
        },
        "supports": draw.fixed("b.bottom", (1, 0), (0, 1)),
        "loads": {"P": {"on": "r", "force": draw.vector(1e5 * push, -1e5)}},
        "contacts": {"c": {"between": ["b.top", "r.rim"], "friction": 0.4}},
    })


def on_slope(draw, shape, slope, size=0.05, increments=1, floor=None):
    """A body of 20 kN/m^3 on a rigid floor that rises by `slope`; friction 0.9."""
    floor = floor or draw.polygon([(-4, -1), (4, -1), (4, 0), (-4, 0)], base="edge_1", top="edge_3")
    weight = [draw.length(component) for component in draw.vector(9.81 * math.sin(slope), -9.81 * math.cos(slope))]
    return draw.text({
        "analysis": {"plane": "strain"},
        "materials": {"m": {"young": draw.stress(1e9), "poisson": 0.3, "density": draw.per_volume(2000.0) / draw.metre}},
        "bodies": {"floor": {"rigid": True, "shape": floor},
                   "d": {"material": "m", "shape": shape, "mesh": {"size": draw.length(size)}}},
        "supports": draw.fixed("floor", (1, 0), (0, 1)),
        "loads": {"w": {"gravity": weight}},
        "contacts": {"c": {"between": ["floor.top", "d.rim"], "friction": 0.9}},
        "steps": [{"name": "s", "increments": increments}],
    })


def disc(draw, radius=1.0):
    return {"circle": {"centre": draw.point(0, radius), "radius": draw.length(radius)}}


def rollers(draw, push):
    """A plate on two rollers, pushed along by a part of its weight of 100 kN."""
    steel = {"material": "m", "mesh": {"size": draw.length(0.05)}}
    return draw.text({
        "materials": {"m": {"young": draw.stress(1e9), "poisson": 0.3}},
        "bodies": {
            "floor": {"rigid": True, "shape": draw.box(-3, -1, 6, 1)},
            "a": {**steel, "shape": {"circle": {"centre": draw.point(-1, 0.5), "radius": draw.length(0.5)}}},
            "b": {**steel, "shape": {"circle": {"centre": draw.point(1, 0.5), "radius": draw.length(0.5)}}},
            "plate": {"rigid": True, "shape": draw.box(-2, 1, 4, 0.2)},
        },
        "supports": draw.fixed("floor", (1, 0), (0, 1)),
        "loads": {"P": {"on": "plate", "force": draw.vector(push * 1e5, -1e5)}},
        "contacts": {f"{body}_{side}": {"between": [place, f"{body}.rim"], "friction": 0.9}
                     for body in "ab" for side, place in (("low", "floor.edge_3"), ("high", "plate.edge_1"))},
    })


class Rolling(Twins):
    """With small rotations the contact of a round body moves and its weight stays: it would rest on any slope."""

    def rolls(self, text, body="d"):
        summary = self.stops_as_mechanism(text)
        self.assertIn(f"body '{body}' rolls", summary["reason"])
        return summary

    def test_a_disc_on_a_slope(self):
        for draw in SAMPLE:
            with self.subTest(draw=draw):
                self.rolls(on_slope(draw, disc(draw), 0.05))

    def test_mirrored_in_ten_increments_finer_and_on_other_slopes(self):
        draw = Drawing()
        self.rolls(on_slope(draw, disc(draw), -0.05))
        self.rolls(on_slope(draw, disc(draw), 0.05, increments=10))
        self.rolls(on_slope(draw, disc(draw), 0.05, size=0.03))
        for slope in (0.02, 0.08):
            self.rolls(on_slope(draw, disc(draw), slope))
        self.rolls(on_slope(draw, disc(draw, 0.3), 0.05, size=0.01))

    def test_rollers_under_a_plate(self):
        _, _, summary = self.run_model(rollers(Drawing(), 0.08))
        self.assertEqual(summary["status"], "mechanism")
        self.assertIn("rolls", summary["reason"])

    def test_what_stands_does_not_roll(self):
        draw = Drawing()
        self.solve(on_slope(draw, disc(draw), 0.0))
        for width in (1.0, 0.3):
            self.solve(on_slope(draw, draw.polygon([(0, 0), (width, 0), (width, 2), (0, 2)], rim="edge_1"), 0.05))
        groove = draw.polygon([(-2, -1), (2, -1), (2, 1), (math.sqrt(2), 1), (0, 1 - math.sqrt(2)), (-math.sqrt(2), 1), (-2, 1)],
                              left="edge_4", right="edge_5")
        model = on_slope(draw, disc(draw), 0.1, floor=groove).replace(
            '"c": {', '"e": {"between": ["floor.left", "d.rim"], "friction": 0.9}, "c": {').replace("floor.top", "floor.right")
        self.solve(model)


if __name__ == "__main__":
    support.main()
