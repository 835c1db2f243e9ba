"""Laws of contacts of models in space from the command line, against closed forms and plane models of the same body."""
import math
import unittest

import support
from solids import interrupt, vector
from support import certificate_of, rows_of, scabo, summary_of

HEAD = "scabo: 1\nmaterials: {m: {young: 1e9, poisson: 0}, steel: {young: 1e9, poisson: 0.3}}\n"

# Without Poisson's ratio a block whose top is moved has the same stress everywhere, and every pair its share of the area.
# Its sides are kept from bending where it is pushed.
MOVED = HEAD + """analysis: {space: true}
bodies:
  block: {material: m, shape: {box: {corner: [0, 0, 0], size: [2, 0.5, 1]}}, mesh: {size: 0.5}}
  plane: {rigid: true, shape: {box: {corner: [-1, -1, -1], size: [4, 3, 1]}}, mesh: {size: 2}}
supports:
  - {on: plane, fix: [x, y, z]}
SUPPORTS
contacts:
  joint: {between: [plane.top, block.bottom], LAW}
steps: STEPS
"""
LIFTED = "  - {on: block.top, displacement: [0, 0, LIFT], name: lift}"
PUSHED = """  - {on: block.top, displacement: [PUSH, 0, null], name: push}
""" + "\n".join(f"  - {{on: block.{face}, displacement: {{formula: [null, null, \"LIFT * z\"]}}}}" for face in ("top", "left", "right"))


@unittest.skipIf(support.SANITIZED, "numbers")
class Solved(support.InTemporaryDirectory):
    def run_model(self, text, name="space", *settings):
        model = self.directory / f"{name}.yaml"
        model.write_text(text, encoding="utf-8")
        return scabo("run", model, "-o", self.directory / name, "--quiet", *settings)

    def solve(self, text, name="space", *settings):
        done = self.run_model(text, name, *settings)
        self.assertEqual(done.returncode, 0, done.stderr)
        increments = summary_of(self.directory / name)["increments"]
        for increment in increments:
            self.assertLessEqual(certificate_of(increment), 1e-10)
        return increments

class Laws(Solved):
    def moved(self, law, steps="[{increments: 1}]", lift="0", push="0"):
        text = MOVED
        for key, value in (("SUPPORTS", PUSHED if push != "0" else LIFTED), ("LIFT", str(lift)), ("PUSH", str(push)), ("LAW", law), ("STEPS", steps)):
            text = text.replace(key, value)
        return self.solve(text)

    def test_a_block_is_pulled_off_at_its_strength_times_its_area(self):
        """It opens at once, stays broken, and carries pressure but no pull when it closes again."""
        strength, area = 2e4, 1.0
        limit = strength / 1e9
        law = f"cohesion: 1e6, tension: {strength}"
        held, = self.moved(law, lift=limit * (1 - 1e-6))
        self.assertAlmostEqual(held["contacts"]["joint"]["normal_force"][2], -strength * area * (1 - 1e-6), delta=1e-8 * strength)
        self.assertEqual(held["contacts"]["joint"]["broken"], 0)
        lifted = self.moved(law, "[{increments: 3}, {name: back, loads: {lift: 0.5}}, {name: press, loads: {lift: -1}}]", lift=limit * (1 + 1e-6))
        first, _, *opened, pressed = [of["contacts"]["joint"] for of in lifted]
        self.assertAlmostEqual(first["normal_force"][2], -strength * area / 3, delta=1e-5 * strength)
        pairs = first["stick"]
        for joint, part in zip(opened, (1, 0.5), strict=True):
            self.assertEqual((joint["open"], joint["broken"], joint["normal_force"]), (pairs, pairs, [0, 0, 0]))
            self.assertAlmostEqual(joint["max_gap"], part * limit * (1 + 1e-6), delta=1e-15)
        self.assertAlmostEqual(pressed["normal_force"][2], strength * area, delta=1e-5 * strength)

    def test_a_block_slides_at_cohesion_and_friction(self):
        """Pushed under pressure it holds c A + mu N, then mu N: friction is what it dissipates after that."""
        c, mu, pressure, area = 3e4, 0.4, 1e5, 1.0
        way = 2 * (c + mu * pressure) / 5e8  # twice what shears the block to its strength: G = E / 2
        steps = "[{name: press, loads: {push: 0}}, {name: push, increments: 5, loads: {push: 1}}]"
        made = self.moved(f"friction: {mu}, cohesion: {c}", steps, lift=-pressure / 1e9, push=way)
        for k, increment in enumerate(made[1:], 1):
            shear = -increment["contacts"]["joint"]["tangential_force"][0]
            expected = k / 5 * 2 * (c + mu * pressure) if k < 3 else mu * pressure
            self.assertAlmostEqual(shear, expected * area, delta=1e-8 * pressure)
            self.assertEqual(increment["contacts"]["joint"]["broken"] > 0, k >= 3)
        slips = [vector(row, "slip") for row in rows_of(self.directory / "space") if (row["step"], row["increment"]) == ("2", "5")]
        for slip in slips:
            self.assertAlmostEqual(slip[0], way - mu * pressure / 5e8, delta=1e-8 * way)
        friction = made[-1]["energy"]["friction"]
        self.assertAlmostEqual(friction, mu * pressure * area * slips[0][0], delta=1e-8 * friction)

    def test_a_lasting_cohesion_and_a_shear_strength_stay(self):
        way, pressure = 1e-3, 1e5
        steps = "[{name: press, loads: {push: 0}}, {name: push, increments: 2, loads: {push: 1}}]"
        for law, bound in (("friction: 0.4, cohesion: {lasting: 3e4}", 7e4), ("shear_strength: 5e4", 5e4)):
            made = self.moved(law, steps, lift=-pressure / 1e9, push=way)
            for increment in made[1:]:
                self.assertAlmostEqual(-increment["contacts"]["joint"]["tangential_force"][0], bound, delta=1e-8 * bound)
                self.assertNotIn("broken", increment["contacts"]["joint"])

    def test_friction_falls_with_slip(self):
        """mu_s - (mu_s - mu_d) s / L, with the slip s of each pair; G (way - s) / h = mu(s) p."""
        at_rest, sliding, distance, pressure, G, way = 0.6, 0.4, 1e-3, 1e5, 5e8, 6e-4
        steps = "[{name: press, loads: {push: 0}}, {name: push, increments: 3, loads: {push: 1}}]"
        made = self.moved(f"friction: {{static: {at_rest}, dynamic: {sliding}, slip_distance: {distance}}}", steps, lift=-pressure / 1e9, push=way)
        for k, increment in enumerate(made[1:], 1):
            slip = (G * way * k / 3 - at_rest * pressure) / (G - (at_rest - sliding) / distance * pressure)
            shear = (at_rest - (at_rest - sliding) * slip / distance) * pressure
            self.assertAlmostEqual(-increment["contacts"]["joint"]["tangential_force"][0], shear, delta=1e-7 * shear)

    def test_a_bonded_contact_is_a_tie(self):
        bonded = self.moved("bond: true", lift=1e-4, push=2e-4)[0]
        tied = self.solve((self.directory / "space.yaml").read_text(encoding="utf-8").replace("contacts:", "ties:").replace(", bond: true", ""))[0]
        self.assertAlmostEqual(bonded["contacts"]["joint"]["normal_force"][2], -1e5, delta=1e-4)
        self.assertAlmostEqual(bonded["contacts"]["joint"]["tangential_force"][0], -1e5, delta=1e-4)
        self.assertEqual(bonded["contacts"], tied["contacts"])

    def test_friction_is_changed_in_a_step(self):
        """A block that sticks under a shear slides as soon as its coefficient has fallen to shear / pressure."""
        pressure, shear = 1e5, 3e4
        steps = """
  - {name: press, loads: {push: 0}}
  - {name: push, loads: {push: 1}}
  - {name: oil, increments: 4, friction: {joint: 0.1}}
  - {name: more, friction: {joint: 0.2}}"""
        made = self.moved("property: dry", steps + "\ncontact_properties: {dry: {friction: 0.5}}\n", lift=-pressure / 1e9, push=shear / 5e8)
        for increment, mu in zip(made[1:], (0.5, 0.4, 0.3, 0.2, 0.1, 0.2), strict=True):
            force = -increment["contacts"]["joint"]["tangential_force"][0]
            expected = min(shear, mu * pressure) if increment["step"] < 4 else 0.1 * pressure
            self.assertAlmostEqual(force, expected, delta=1e-8 * pressure)

    def test_laws_that_last_are_those_of_the_plane(self):
        """A block pressed on a larger one and pushed until a part of its base slides; in space a slice of it between planes of symmetry."""
        for law in ("friction: 0.3, cohesion: {lasting: 10}", "shear_strength: 30", "friction: {static: 0.4, dynamic: 0.2, slip_distance: 5e-3}",
                    "friction: 0.3, modulus: 1e5"):
            common = f"""materials: {{steel: {{young: 200e3, poisson: 0.3}}}}
contacts: {{joint: {{between: [base.top, block.bottom], {law}}}}}
loads: {{press: {{on: block.top, pressure: 100}}}}
steps:
  - {{name: press, loads: {{press: 1, ram: 0}}}}
  - {{name: push, loads: {{ram: 1}}}}
"""
            plane = self.solve("scabo: 1\n" + common + """analysis: {plane: strain, thickness: 0.5}
bodies:
  base: {material: steel, shape: {rectangle: {corner: [0, -5], size: [10, 5]}}, mesh: {kind: fem, size: 0.2, order: 2}}
  block: {material: steel, shape: {rectangle: {corner: [2, 0], size: [6, 3]}}, mesh: {kind: fem, size: 0.2, order: 2}}
supports:
  - {on: base.bottom, fix: [x, y], name: ground}
  - {on: block.left, displacement: [2e-3, null], name: ram}
""", "plane")
            made = self.solve("scabo: 1\n" + common + """analysis: {space: true}
bodies:
  base: {material: steel, shape: {box: {corner: [0, 0, -5], size: [10, 0.5, 5]}}, mesh: {size: 0.5}}
  block: {material: steel, shape: {box: {corner: [2, 0, 0], size: [6, 0.5, 3]}}, mesh: {size: 0.5}}
supports:
  - {on: base.bottom, fix: [x, y, z], name: ground}
  - {on: block.left, displacement: [2e-3, null, null], name: ram}
""" + "".join(f"  - {{on: {body}.{face}, fix: y}}\n" for body in ("base", "block") for face in ("front", "back")))
            with self.subTest(law=law):
                for one, other in zip(made, plane, strict=True):
                    self.assertAlmostEqual(one["contacts"]["joint"]["normal_force"][2], 300, delta=300e-9)
                    for key, place in (("ram", 0), ("ground", 0)):
                        ours, theirs = one["reactions"][key][place], other["reactions"][key][place]
                        self.assertAlmostEqual(ours, theirs, delta=5e-3 * abs(plane[-1]["reactions"]["ram"][0]))
                    self.assertAlmostEqual(one["energy"]["elastic"], other["energy"]["elastic"], delta=5e-3 * other["energy"]["elastic"])
                    self.assertAlmostEqual(one["energy"]["friction"], other["energy"]["friction"], delta=1e-2 * plane[-1]["energy"]["elastic"])
                self.assertGreater(made[-1]["contacts"]["joint"]["slip"], 4)
                self.assertGreater(made[-1]["contacts"]["joint"]["stick"], 4)

    glued = """scabo: 1
analysis: {space: true}
materials: {m: {young: 1e9, poisson: 0}}
bodies:
  lid: {rigid: true, shape: {box: {corner: [-1, 0, 1], size: [7, 1, 0.5]}}, mesh: {size: 1}}
""" + "".join(f"  {name}: {{material: m, shape: {{box: {{corner: [{x}, 0, 0], size: [1, 1, 1]}}}}, mesh: {{size: 0.5}}}}\n"
              for name, x in (("left", 0), ("middle", 2), ("right", 4))) + "supports:\n" + "".join(
        f"  - {{on: {name}.bottom, fix: [x, y, z], name: under_{name}}}\n" for name in ("left", "middle", "right")) + """contacts:
  glue_left: {between: [left.top, lid.bottom], cohesion: 1e9, tension: 2e4}
  glue_middle: {between: [middle.top, lid.bottom], cohesion: 1e9, tension: 1e4}
  glue_right: {between: [right.top, lid.bottom], cohesion: 1e9, tension: 2e4}
loads: {lift: {on: lid, force: [0, 0, 1e3]}}
steps: [{name: lift, increments: COUNT, loads: {lift: LAST}}]
"""

    def test_what_a_broken_contact_carried_goes_to_the_others(self):
        """A rigid lid on three columns: the weakest one breaks at a third of the force, and the others at half of it."""
        made = self.solve(self.glued.replace("COUNT", "12").replace("LAST", "39"))
        for k, increment in enumerate(made, 1):
            force = 39e3 * k / 12
            shares = (force / 3,) * 3 if force < 3e4 else (force / 2, 0, force / 2)
            for name, share in zip(("left", "middle", "right"), shares, strict=True):
                glue = increment["contacts"][f"glue_{name}"]
                self.assertAlmostEqual(glue["normal_force"][2], -share, delta=1e-8 * 39e3)
                self.assertEqual(glue["broken"] > 0, name == "middle" and force > 3e4)
        done = self.run_model(self.glued.replace("COUNT", "1").replace("LAST", "41"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("body 'lid': translation along (0, 0, 1), held neither by supports nor by contact and friction", done.stderr)

    def test_a_run_is_resumed_while_contacts_break(self):
        """Killed after the first columns slip with a friction that falls, with the bits of an unbroken run."""
        text = self.glued.replace("COUNT", "60").replace("LAST", "39").replace("glue_right: {between: [right.top, lid.bottom], cohesion: 1e9, tension: 2e4}",
            "glue_right: {between: [right.top, lid.bottom], cohesion: 1e9, tension: 2e4}\n  pushed: {between: [middle.right, brake.left], friction: {static: 0.5, dynamic: 0.2, slip_distance: 1e-5}, gap: -1e-6}")
        text = text.replace("supports:", "  brake: {material: m, shape: {box: {corner: [3, 0, 0], size: [0.5, 1, 1]}}, mesh: {size: 0.5}}\nsupports:\n  - {on: brake.right, fix: [x, y, z]}")
        whole = self.solve(text, "whole")
        interrupt(self, self.directory / "whole.yaml", self.directory / "cut")
        self.assertLess(len(summary_of(self.directory / "cut")["increments"]), 60)
        done = scabo("resume", self.directory / "cut", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(summary_of(self.directory / "cut")["increments"], whole)
        for file in ("contact.csv", "fields_0060.vtu", "contact_0060.vtu"):
            self.assertEqual((self.directory / "cut" / file).read_bytes(), (self.directory / "whole" / file).read_bytes())
        self.assertGreater(whole[-1]["contacts"]["glue_middle"]["broken"], 0)
        self.assertGreater(whole[-1]["energy"]["friction"], 0)


@unittest.skipIf(support.SANITIZED, "numbers")
class TwoRigidBodies(Solved):
    """Two blocks of stone on a floor: what rests on what follows from equilibrium."""
    text = """scabo: 1
analysis: {space: true}
bodies:
  floor: {rigid: true, shape: {box: {corner: [-1, -1, -1], size: [3, 3, 1]}}, mesh: {size: 1.5}}
  stone: {rigid: true, density: 2000, shape: {box: {corner: [0, 0, 0], size: [1, 1, 0.5]}}, mesh: {size: 0.5}}
  upper: {rigid: true, density: 2000, shape: {box: {corner: [0, 0, 0.5], size: [1, 1, 0.5]}}, mesh: {size: 0.3}}
supports: [{on: floor, fix: [x, y, z], name: ground}]
loads: {weight: {gravity: [0, 0, -10]}, push: {on: upper, force: [1000, 500, 0]}}
contacts:
  below: {between: [floor.top, stone.bottom], friction: 0.6MODULUS}
  above: {between: [stone.top, upper.bottom], friction: 0.6MODULUS}
steps: [{name: weight, loads: {weight: 1}}, {name: push, loads: {push: PUSH}}]
"""

    def test_totals_are_those_of_statics(self):
        made = self.solve(self.text.replace("MODULUS", "").replace("PUSH", "5"))
        for increment, push in zip(made, (0, 5), strict=True):
            for name, weight, arm in (("below", 2e4, 0.75), ("above", 1e4, 0.75)):
                joint = increment["contacts"][name]
                exact = {"normal_force": [0, 0, weight], "tangential_force": [-1000 * push, -500 * push, 0],
                         # About the origin, of weight at (0.5, 0.5) and of the push at (0.5, 0.5, 0.75).
                         "moment": [weight / 2 + 500 * push * arm, -weight / 2 - 1000 * push * arm, 250 * push]}
                for key, vector_of in exact.items():
                    for a, b in zip(joint[key], vector_of, strict=True):
                        self.assertAlmostEqual(a, b, delta=1e-9 * weight)

    def test_a_stone_slides_at_its_friction(self):
        limit = 0.6 * 1e4 / math.hypot(1000, 500)
        self.solve(self.text.replace("MODULUS", "").replace("PUSH", str(limit * (1 - 1e-6))))
        done = self.run_model(self.text.replace("MODULUS", "").replace("PUSH", str(limit * (1 + 1e-3))))
        self.assertEqual(done.returncode, 2)

    def test_on_beds_of_springs_the_pressure_of_a_weight_is_uniform(self):
        modulus = 1e7
        made = self.solve(self.text.replace("MODULUS", f", modulus: {modulus}").replace("PUSH", "1"))
        stored = {"1": 0, "2": 0}
        for row in rows_of(self.directory / "space"):
            weight, pressure = 2e4 if row["contact"] == "below" else 1e4, float(row["pressure"])
            stored[row["step"]] += float(row["area"]) * pressure**2 / 2 / modulus
            if row["step"] == "1":
                self.assertAlmostEqual(pressure, weight, delta=1e-8 * weight)
            elif float(row["x"]) + float(row["y"]) / 2 > 0.8:  # the push is to the right and, half of it, to the back
                self.assertGreater(pressure, weight)
        for increment, elastic in zip(made, stored.values(), strict=True):
            self.assertAlmostEqual(increment["energy"]["elastic"], elastic, delta=1e-8 * elastic)
            self.assertAlmostEqual(increment["energy"]["external"], elastic, delta=1e-8 * elastic)


@unittest.skipIf(support.SANITIZED, "numbers")
class Twins(Solved):
    """A block torn off a larger one and pressed on it again, held by springs at its other end: the same broken pairs and forces
    with its sides swapped, the bodies listed in another order, in other units, and turned (x -> y -> z -> x)."""

    def tear(self, name, length=1, force=1, swapped=False, listed=1, turned=False):
        axes, faces = [0, 1, 2], {face: face for face in ("bottom", "top", "left", "right")}
        if turned:
            axes, faces = [2, 0, 1], {"bottom": "left", "top": "right", "left": "front", "right": "back"}
        def vector_of(*numbers):
            return "[" + ", ".join(numbers[axis] if isinstance(numbers[axis], str) else repr(numbers[axis] * length) for axis in axes) + "]"
        pressure = force / length**2
        bodies = [f"  base: {{material: steel, shape: {{box: {{corner: {vector_of(0, 0, -4)}, size: {vector_of(12, 1, 4)}}}}}, mesh: {{size: {length}}}}}\n",
                  f"  block: {{material: steel, shape: {{box: {{corner: {vector_of(2, 0, 0)}, size: {vector_of(8, 1, 2)}}}}}, mesh: {{size: {0.8 * length}}}}}\n"]
        sides = [f"base.{faces['top']}", f"block.{faces['bottom']}"]
        made = self.solve(f"""scabo: 1
analysis: {{space: true}}
materials: {{steel: {{young: {1e9 * pressure}, poisson: 0.3}}}}
bodies:
{"".join(bodies[::listed])}supports:
  - {{on: base.{faces["bottom"]}, fix: [x, y, z], name: ground}}
  - {{on: block.{faces["left"]}, displacement: {vector_of("null", "null", 2e-3)}, name: ram}}
springs: [{{on: block.{faces["right"]}, k_n: {1e6 * pressure / length}, k_t: {2e6 * pressure / length}, name: wall}}]
contacts: {{joint: {{between: [{", ".join(sides[::-1] if swapped else sides)}], friction: 0.5, cohesion: {4e5 * pressure}, tension: {2e5 * pressure}}}}}
steps: [{{name: tear, increments: 5, loads: {{ram: 1}}}}, {{name: back, increments: 2, loads: {{ram: -0.5}}}}]
""", name)
        states = [[of["contacts"]["joint"][key] for key in ("broken", "open", "stick", "slip")] for of in made]
        forces = [[of[key][name][axes.index(axis)] / force for key, name in (("reactions", "ram"), ("springs", "wall")) for axis in range(3)]
                  + [of["energy"]["elastic"] / force / length] for of in made]
        return states, forces

    def test_the_same_pairs_break(self):
        states, forces = self.tear("first")
        broken = [of[0] for of in states]
        self.assertEqual(broken, sorted(broken))
        self.assertGreater(len(set(broken)), 3)  # one after the other
        self.assertGreater(states[-1][3], 0)
        for name, change in (("swapped", {"swapped": True}), ("listed", {"listed": -1}), ("units", {"length": 1000.0, "force": 1e-3}), ("turned", {"turned": True})):
            with self.subTest(change=name):
                other_states, other_forces = self.tear(name, **change)
                self.assertEqual(other_states, states)
                for one, other in zip(other_forces, forces, strict=True):
                    for a, b in zip(one, other, strict=True):
                        self.assertAlmostEqual(a, b, delta=1e-9 * 4e4)


if __name__ == "__main__":
    support.main()
