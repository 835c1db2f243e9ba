#!/usr/bin/env python3
"""The plate of model.yaml by hand: the stress intensity factor of a crack that a plane wave of tension meets.

A jump of tension sigma that meets the whole crack at t = 0, in waves of the speed c without strain across, gives its tips

    K_I = 2 sigma sqrt((1 - 2 nu) c t / pi) / (1 - nu)

(Freund, Dynamic Fracture Mechanics, 1990) until the waves of the other tip arrive, at t = 2 a/c. A tension that rises along a line is a sum of
two ramps, of each of which this is the integral. Standard library only. Units of the model: m, s, N."""
import math

YOUNG, POISSON, DENSITY = 200e9, 0.3, 7850.0
ABOVE, HALF = 0.06, 0.05
TENSION, RISE = 100e6, 2e-6

SPEED = math.sqrt(YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON) * DENSITY))
ARRIVES = ABOVE / SPEED
OTHER_TIP = ARRIVES + 2 * HALF / SPEED


def of_ramp(t):
    """K_I while the tension grows as t/RISE: the integral of that of a jump."""
    return 0.0 if t <= 0 else 4 / 3 * TENSION / RISE * math.sqrt((1 - 2 * POISSON) * SPEED / math.pi) / (1 - POISSON) * t ** 1.5


def factor(t):
    return of_ramp(t - ARRIVES) - of_ramp(t - ARRIVES - RISE)


def calculate():
    """`slow`: of the same crack, two-dimensional plate without edges, under the same tension at rest."""
    return {"speed": SPEED, "arrives": ARRIVES, "other_tip": OTHER_TIP, "K_16": factor(16e-6), "K_20": factor(20e-6), "K_24": factor(24e-6),
            "K_27": factor(27e-6), "slow": TENSION * math.sqrt(math.pi * HALF)}


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:10} {value:14.7g}")
