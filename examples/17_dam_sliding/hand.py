#!/usr/bin/env python3
"""Sliding of the dam of model.yaml by hand: weight, thrust of the water, uplift, sliding factor, and the level at which it
slides. N/m and m, for each metre of dam. Standard library only."""
import math

WEIGHT = 2400 * 9.81 * (5 * 20 + 0.5 * (13 - 5) * 15)
ARM = (5 * 20 * 2.5 + 0.5 * 8 * 15 * (5 + 8 / 3)) / (5 * 20 + 0.5 * 8 * 15)  # of the weight, from the heel
WATER, BASE, DRAIN, DRAINED, MU = 9.81e3, 13.0, 3.0, 1 / 3, 0.6


def thrust(level):
    return WATER * level**2 / 2


def uplift(level):
    """Bilinear: the full head at the heel, DRAINED of it at the drain, none at the toe."""
    return WATER * level * (DRAIN * (1 + DRAINED) / 2 + (BASE - DRAIN) * DRAINED / 2)


def uplift_moment(level):
    """About the heel."""
    triangle = DRAIN * (1 - DRAINED) / 2 * DRAIN / 3
    return WATER * level * (triangle + DRAINED * DRAIN**2 / 2 + (BASE - DRAIN) * DRAINED / 2 * (DRAIN + (BASE - DRAIN) / 3))


def centre(level):
    """Of the effective pressure, from the heel."""
    return (WEIGHT * ARM + thrust(level) * level / 3 - uplift_moment(level)) / (WEIGHT - uplift(level))


def calculate():
    numbers = {}
    for level in (10, 15, 19):
        numbers |= {f"thrust_{level}": thrust(level), f"normal_{level}": WEIGHT - uplift(level), f"centre_{level}": centre(level),
                    f"factor_{level}": MU * (WEIGHT - uplift(level)) / thrust(level)}
    # MU (W - u h) = water h^2 / 2 for the level h at which it slides.
    u = uplift(1.0)
    numbers["level"] = (-MU * u + math.sqrt((MU * u)**2 + 2 * WATER * MU * WEIGHT)) / WATER
    return numbers


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.6g}")
