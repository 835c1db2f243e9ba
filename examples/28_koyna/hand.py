#!/usr/bin/env python3
"""The dam of model.yaml by hand, and the numbers of a finer run of it, with which README.md compares the run.

At rest the joints carry weight and thrust. A rigid dam begins to slide on its base where thrust and inertia, that of the water of Westergaard
included, exceed the friction; the block above the lift joint, on which no more than the top 25 m of water press, at another acceleration.
Standard library only. Units of the model: m, s, N, for 1 m of the dam."""
import math

GRAVITY, DENSITY, WATER, LEVEL = 9.81, 2643.0, 9810.0, 91.75
LIFT, HEIGHT, BASE, WIDTH, CREST = 66.5, 103.0, 70.0, 19.25, 14.8
FRICTION = {"base": 1.0, "lift": 0.7}

# `scabo run model.yaml --set parameters.size=2 --set parameters.step=5e-4`: half the elements and half the step.
FINER = {"forth": 55.2482e-3, "back": -27.1323e-3, "opens": 27.3501e-3, "base": 8.9981e-3, "lift": 8.1987e-3, "shear": 94.9789e6, "heat": 483.843e3}


def slides_at(mass, water, thrust, friction):
    """Acceleration of the ground at which a rigid body with its water begins to slide."""
    return (friction * mass * GRAVITY - thrust) / (mass + water)


def calculate():
    upper = DENSITY * (HEIGHT - LIFT) * (WIDTH + CREST) / 2
    whole = upper + DENSITY * LIFT * (BASE + WIDTH) / 2
    above = LEVEL - LIFT
    thrust, thrust_above = WATER * LEVEL ** 2 / 2, WATER * above ** 2 / 2
    added = 7 / 12 * 1000 * LEVEL ** 2  # 7/8 density sqrt(H y) over the depth
    added_above = 7 / 12 * 1000 * math.sqrt(LEVEL) * above ** 1.5
    return {"thrust": thrust, "weight": whole * GRAVITY,
            "base_slides": slides_at(whole, added, thrust, FRICTION["base"]),
            "lift_slides": slides_at(upper, added_above, thrust_above, FRICTION["lift"]), **FINER}


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.7g}")
