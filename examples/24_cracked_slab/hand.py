#!/usr/bin/env python3
"""The cracked slab of model.yaml by hand: curling of a slab on soil, after H. M. Westergaard, "Analysis of stresses in concrete
pavements due to variations of temperature", Proc. Highway Research Board 6 (1927) 201-215, as a beam on Winkler's foundation in
plane strain, and a crack as a hinge with the rotation that linear fracture mechanics gives it.

Deflection w upward, x from the crack. Of a beam whose top is warmer by dT, free of load, the curvature is -c, c = alpha (1 + nu) dT / h;
its moment, positive with tension at the underside, M = D (w'' + c), D = E h^3 / (12 (1 - nu^2)). Then

    D w'''' + k w = 0,   w'' = -c and w''' = 0 at the end x = L / 2,   w''' = 0 and w' = theta / 2 at x = 0.

The crack of depth a opens by the angle theta under the moment M. Its stress intensity factor in bending and, as what it takes from
the energy is K^2 / E' for each area (Irwin), the angle:

    K = s sqrt(pi a) F(a / h), s = 6 M / h^2,
    F(r) = (1.99 - 2.47 r + 12.97 r^2 - 23.17 r^3 + 24.80 r^4) / sqrt(pi)    W. F. Brown, J. E. Srawley, ASTM STP 410 (1966), to 0.2 %
    theta = d/dM integral of K^2 / E' da = 72 pi M / (E' h^2) integral of r F^2 dr from 0 to a / h

The polynomial holds for r up to 0.6.

`uncracked`: Westergaard's moment of a slab of this length without a crack. The weight sinks the slab by rho g h / k and bends nothing;
curling lifts the middle by `lift`. Standard library only. Units of the model: N, m, K;
moments for each metre of width."""
import math

YOUNG, POISSON, EXPANSION, DENSITY = 30e9, 0.15, 1e-5, 2400
LENGTH, HEIGHT, SOIL, CRACK = 5.0, 0.25, 80e6, 0.05
DIFFERENCE = 9.0 - 2.0
PLANE = YOUNG / (1 - POISSON**2)
D = PLANE * HEIGHT**3 / 12
C = EXPANSION * (1 + POISSON) * DIFFERENCE / HEIGHT
BETA = (SOIL / (4 * D))**0.25


def shape(ratio):
    """F of an edge crack of this part of the depth, in bending."""
    return (1.99 - 2.47 * ratio + 12.97 * ratio**2 - 23.17 * ratio**3 + 24.80 * ratio**4) / math.sqrt(math.pi)


def compliance(crack, steps=100):
    """theta / M, by Simpson's rule."""
    width = crack / HEIGHT / steps
    total = sum((1 if k in (0, steps) else 4 if k % 2 else 2) * k * width * shape(k * width)**2
                for k in range(steps + 1))
    return 72 * math.pi / (PLANE * HEIGHT**2) * total * width / 3


def solve(matrix, right):
    """Two equations, by Cramer's rule."""
    (a, b), (c, d) = matrix
    return (right[0] * d - b * right[1]) / (a * d - b * c), (a * right[1] - right[0] * c) / (a * d - b * c)


def functions(x):
    """cosh cos, sinh sin and the two others that the derivatives of these two need, of beta x."""
    z = BETA * x
    return math.cosh(z) * math.cos(z), math.sinh(z) * math.sin(z), math.cosh(z) * math.sin(z), math.sinh(z) * math.cos(z)


def curled(crack):
    """Deflection as a function of x, and the moment at x = 0: w = P cosh cos + Q sinh sin + R (cosh sin + sinh cos), whose third
    derivative is zero at x = 0; the slope there is 2 beta R."""
    def deflection(p, q, r, x):
        a, b, c, d = functions(x)
        return p * a + q * b + r * (c + d)

    def ends(slope):
        """P and Q for a slope at x = 0, so that the end is free."""
        r = slope / (2 * BETA)
        a, b, c, d = functions(LENGTH / 2)
        # w'' / (2 beta^2): cosh cos -> -sinh sin, sinh sin -> cosh cos, cosh sin + sinh cos -> sinh cos - cosh sin;
        # w''' / (2 beta^3): -(cosh sin + sinh cos), sinh cos - cosh sin, -2 sinh sin.
        p, q = solve([(-b, a), (-(c + d), d - c)], [-C / (2 * BETA**2) - r * (d - c), 2 * r * b])
        return p, q, r

    def moment(slope):
        return D * (2 * BETA**2 * ends(slope)[1] + C)

    if not crack:
        return lambda x: deflection(*ends(0.0), x), moment(0.0)
    flat, change = moment(0.0), moment(1.0) - moment(0.0)  # linear in the slope
    half = 0.5 * compliance(crack)
    here = flat / (1 - half * change)
    constants = ends(half * here)
    return lambda x: deflection(*constants, x), here


def factor(crack):
    """Moment in the cracked section and stress intensity factor."""
    moment = curled(crack)[1]
    return moment, 6 * moment / HEIGHT**2 * math.sqrt(math.pi * crack) * shape(crack / HEIGHT)


def calculate():
    sunk = DENSITY * 9.81 * HEIGHT / SOIL
    deflection = curled(CRACK)[0]
    result = {"uncracked": curled(0.0)[1], "sunk": -sunk, "end": deflection(LENGTH / 2) - sunk, "lift": deflection(0.0)}
    result["moment"], result["factor"] = factor(CRACK)
    result["deeper_moment"], result["deeper_factor"] = factor(2 * CRACK)
    return result


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.6g}")
