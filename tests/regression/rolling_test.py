"""Round bodies that roll: with small displacements their contact moves along the round side and seems to hold them, while
in truth their weight moves along. No increment in which that is more than half of what holds a body is solved."""
import math
import unittest

import support
from drawing import TWINS, Drawing
from support import scabo, summary_of


def disc_on_slope(draw, slope=0.05, friction=0.9, size=0.05, increments=1, radius=1.0, rigid_floor=True, rigid_disc=False, order=1):
    """A disc on a slope, drawn with the slope horizontal."""
    weight = 9.81 * 2000.0 * math.pi * radius**2
    disc = {"shape": {"circle": {"centre": draw.point(0, radius), "radius": draw.length(radius)}}}
    floor = {"shape": draw.box(-4 * radius, -radius, 8 * radius, radius)}
    elastic = {"material": "m", "mesh": {"size": draw.length(size * radius), "order": order}}
    pull = [math.sin(slope), -math.cos(slope)]
    load = {"on": "d", "force": draw.vector(*(weight * part for part in pull))} if rigid_disc else {
        "on": "d", "body_force": [draw.per_volume(9.81 * 2000.0) * part for part in draw.vector(*pull)]}
    return draw.text({
        "analysis": {"plane": "strain"},
        "materials": {"m": {"young": draw.stress(1e9), "poisson": 0.3}},
        "bodies": {"floor": {**floor, **({"rigid": True} if rigid_floor else elastic)},
                   "d": {**disc, **({"rigid": True} if rigid_disc else elastic)}},
        "supports": [*draw.fixed("floor" if rigid_floor else "floor.bottom", (1, 0), (0, 1))],
        "loads": {"weight": load},
        "contacts": {"c": {"between": ["floor.top", "d.rim"], "friction": friction}},
        "steps": [{"name": "s", "increments": increments}],
    })


class Rolling(support.InTemporaryDirectory):
    def run_model(self, text):
        path = self.directory / "model.yaml"
        path.write_text(text, encoding="utf-8")
        run = scabo("run", path, "--quiet")
        return run.returncode, run.stderr, summary_of(self.directory / "model.results")

    def rolls(self, text, body="d"):
        status, errors, summary = self.run_model(text)
        self.assertEqual((status, summary["status"]), (2, "mechanism"), errors)
        self.assertIn(f"body '{body}' rolls", summary["reason"])
        self.assertEqual(summary["mechanism"]["bodies"][0]["name"], body)
        return summary

    def rests(self, text):
        status, errors, summary = self.run_model(text)
        self.assertEqual((status, summary["status"]), (0, "solved"), errors)
        return summary["increments"][-1]

    def test_a_disc_on_a_slope(self):
        for draw in TWINS:
            with self.subTest(draw=draw):
                self.rolls(disc_on_slope(draw))

    def test_at_other_slopes_sizes_and_increments(self):
        for changed in ({"slope": -0.02}, {"slope": 0.1}, {"slope": 0.3}, {"size": 0.02, "slope": 0.03}, {"size": 0.1},
                        {"increments": 10}, {"radius": 0.01}, {"order": 2}, {"friction": 0.3}):
            with self.subTest(**changed):
                self.rolls(disc_on_slope(Drawing(), **changed))

    def test_on_what_gives_way_and_as_a_rigid_one(self):
        self.rolls(disc_on_slope(Drawing(), rigid_floor=False))
        self.rolls(disc_on_slope(Drawing(), rigid_floor=False, rigid_disc=True))

    def test_a_disc_on_level_ground_rests(self):
        for draw in TWINS:
            with self.subTest(draw=draw):
                forces = self.rests(disc_on_slope(draw, slope=0.0))["contacts"]["c"]
                self.assertAlmostEqual(forces["normal_force"] / (9.81 * 2000 * math.pi), 1.0, delta=0.01)

    def test_bodies_that_are_flat_or_hardly_rounded_rest(self):
        for radius, height in ((math.inf, 1.0), (40.0, 1.0), (40.0, 6.0)):
            for draw in TWINS[:5]:
                with self.subTest(radius=radius, height=height, draw=draw):
                    turned = self.rests(rocker(draw, radius, height))["contacts"]["c"]
                    self.assertAlmostEqual(turned["normal_force"] / 1e5, 1.0, delta=1e-3)

    def test_a_rocker_whose_weight_is_high_above_its_radius_rolls(self):
        for radius, height in ((5.0, 6.0), (5.0, 4.0), (2.0, 6.0)):
            for draw in TWINS[:5]:
                with self.subTest(radius=radius, height=height, draw=draw):
                    self.rolls(rocker(draw, radius, height))

    def test_springs_that_hold_a_disc(self):
        self.rests(on_spring(Drawing(), 100.0))
        status, errors, summary = self.run_model(on_spring(Drawing(), 0.01))
        self.assertEqual((status, summary["status"]), (2, "not_converged"), errors)
        self.assertIn("body 'd' rolls", summary["reason"])

    def test_a_roller_between_a_floor_and_a_plate_that_is_pushed(self):
        for draw in (Drawing(), Drawing(metre=1e3, angle=0.4)):
            with self.subTest(draw=draw):
                self.rolls(roller(draw), "roller")


def rocker(draw, radius, height, half=1.0):
    """A body with a round bottom on a rigid floor under a load of 100 kN on its top, beside its middle by `half` / 20."""
    if math.isinf(radius):
        shape = draw.polygon([(-half, 0.0), (half, 0.0), (half, height), (-half, height)], bottom="edge_1", top="edge_3")
    else:
        rise = radius - math.sqrt(radius**2 - half**2)
        shape = {"outline": [draw.arc("bottom", (-half, rise), (half, rise), (0.0, radius)),
                             draw.line("right", (half, height)), draw.line("top", (-half, height)), draw.line("left", (-half, rise))]}
    pressure = draw.stress(1e5 / (2 * half))
    return draw.text({
        "analysis": {"plane": "strain"},
        "materials": {"m": {"young": draw.stress(1e10), "poisson": 0.3}},
        "bodies": {"floor": {"rigid": True, "shape": draw.box(-4, -1, 8, 1)},
                   "d": {"material": "m", "shape": shape, "mesh": {"kind": "fem", "size": draw.length(half / 20)}}},
        "supports": draw.fixed("floor", (1, 0), (0, 1)),
        "loads": {"press": {"on": "d.top", "pressure": pressure},
                  "turn": {"on": "d.top", "moment": -0.05 * half * 1e5}},
        "contacts": {"c": {"between": ["floor.top", "d.bottom"], "friction": 0.5}},
    })


def on_spring(draw, stiffness):
    """The disc on a slope, its centre on a spring along the slope; `stiffness`: in weights per radius."""
    weight = 9.81 * 2000.0 * math.pi
    return draw.text({
        "analysis": {"plane": "strain"},
        "materials": {"m": {"young": draw.stress(1e9), "poisson": 0.3}},
        "bodies": {"floor": {"material": "m", "shape": draw.box(-4, -1, 8, 1), "mesh": {"size": draw.length(0.05)}},
                   "d": {"rigid": True, "shape": {"circle": {"centre": draw.point(0, 1), "radius": draw.length(1)}}}},
        "supports": draw.fixed("floor.bottom", (1, 0), (0, 1)),
        "springs": [{"on": {"body": "d", "near": draw.point(0, 1)}, "k_x": stiffness * weight / draw.metre, "k_y": 0.0}],
        "loads": {"weight": {"on": "d", "force": draw.vector(0.05 * weight, -weight)}},
        "contacts": {"c": {"between": ["floor.top", "d.rim"], "friction": 0.9}},
    })


def roller(draw):
    """A roller that a plate presses onto a floor; the plate is moved along."""
    return draw.text({
        "analysis": {"plane": "strain"},
        "materials": {"m": {"young": draw.stress(1e9), "poisson": 0.3}},
        "bodies": {"floor": {"rigid": True, "shape": draw.box(-4, -1, 8, 1)},
                   "roller": {"material": "m", "shape": {"circle": {"centre": draw.point(0, 1), "radius": draw.length(1)}},
                              "mesh": {"size": draw.length(0.05)}},
                   "plate": {"rigid": True, "shape": draw.box(-4, 2, 8, 1)}},
        "supports": [*draw.fixed("floor", (1, 0), (0, 1)), {"on": "plate", "rotation": 0}],
        "loads": {"press": {"on": "plate", "force": draw.vector(2e3, -1e5)}},
        "contacts": {"low": {"between": ["floor.top", "roller.rim"], "friction": 0.9},
                     "high": {"between": ["roller.rim", "plate.bottom"], "friction": 0.9}},
    })


if __name__ == "__main__":
    support.main()
