#!/usr/bin/env python3
"""Indentation of a layer that is bonded to a rigid base, without friction. N, m. Standard library only.

On a half-space a flat punch of radius a needs 2 a E* d, a ball of radius R 4/3 E* sqrt(R d^3) (Hertz). The base makes the layer stiffer:
its displacement under a force P, reflected by the base, is alpha P / (pi E* h) at the surface. To the first power of a / h

    P = 2 a E* d / (1 + 2 alpha a / (pi h))

and of a ball, with chi = sqrt(R d) / h, by the series of Dimitriadis, Horkay, Maresca, Kachar, Chadwick, Biophysical Journal 82 (2002)."""
import math

YOUNG, POISSON = 3e9, 0.3
MODULUS = YOUNG / (1 - POISSON**2)
RADIUS, DEPTH = 1e-3, 1e-6                   # of the flat punch
BALL, BALL_DEPTH = 200e-3, 5e-6
ALPHA = -(1.2876 - 1.4678 * POISSON + 1.3442 * POISSON**2) / (1 - POISSON)
BETA = (0.6387 - 1.0277 * POISSON + 1.5164 * POISSON**2) / (1 - POISSON)


def flat(layer):
    return 2 * RADIUS * MODULUS * DEPTH / (1 + 2 * ALPHA * RADIUS / (math.pi * layer))


def half_space(depth):
    return 4 / 3 * MODULUS * math.sqrt(BALL * depth**3)


def ball(depth, layer=5e-3):
    chi, c = math.sqrt(BALL * depth) / layer, 2 * ALPHA / math.pi
    return half_space(depth) * (1 - c * chi + (c * chi)**2 - 8 / math.pi**3 * (ALPHA**3 + 4 * math.pi**2 / 15 * BETA) * chi**3)


def calculate():
    return {"flat": flat(5e-3), "flat_thick": flat(20e-3), "ball": ball(BALL_DEPTH), "ball_on_half_space": half_space(BALL_DEPTH)}


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:20} {value:14.6g}")
