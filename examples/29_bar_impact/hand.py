#!/usr/bin/env python3
"""The bar of model.yaml by hand: waves in a rod without strain across.

When its end meets the wall, a wave of the stress rho c v runs through the bar and stops it, is reflected at the free end as a wave that takes
the stress away and gives the bar its velocity back, and is at the wall after 2 L/c: the bar leaves at the speed at which it came (Saint-Venant).
Standard library only. Units of the model: m, s, N."""
import math

YOUNG, DENSITY, LENGTH, AREA, SPEED, GAP = 200e9, 7850.0, 1.0, 0.02 * 0.02, 5.0, 5e-4

WAVE = math.sqrt(YOUNG / DENSITY)
TOUCHES = GAP / SPEED
LEAVES = TOUCHES + 2 * LENGTH / WAVE
STRESS = -DENSITY * WAVE * SPEED


def force(t):
    return -STRESS * AREA if TOUCHES < t < LEAVES else 0.0


def displacement(x, t):
    """Of the point at the distance x from the end that hits: it flies, stands between the wave and its reflection, and flies back."""
    stops, starts = TOUCHES + x / WAVE, LEAVES - x / WAVE
    return -SPEED * min(t, stops) + SPEED * max(0.0, t - starts)


def stress(x, t):
    return STRESS if TOUCHES + x / WAVE < t < LEAVES - x / WAVE else 0.0


def calculate():
    """`energy`: all of it at first, kinetic; `half_way`: kinetic, when the wave is at the middle of the bar."""
    return {"wave": WAVE, "touches": TOUCHES, "leaves": LEAVES, "force": -STRESS * AREA, "stress": STRESS,
            "farthest": displacement(LENGTH, TOUCHES + LENGTH / WAVE), "end": displacement(LENGTH, 6e-4), "speed": SPEED,
            "energy": DENSITY * LENGTH * AREA * SPEED**2 / 2}


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:10} {value:14.7g}")
