#!/usr/bin/env python3
"""The wall of model.yaml by hand: the part above the damp course is a rigid block that slides on it with Coulomb's friction, while the part
below stays on the ground, which moves with the acceleration A sin(w t) for two cycles and is at rest then.

A slide begins where A sin(w t) exceeds mu g; its velocity relative to the ground changes by -+mu g - A sin(w t) until it is 0. In closed form
but for the times at which the velocity is 0, which are found by bisection. Standard library only. Units of the model: m, s, N."""
import math

GRAVITY, PEAK, PERIOD, CYCLES, END = 9.81, 4.905, 0.4, 2, 1.0
DAMP, FOOT = 0.25, 0.4
LOWER = 2000 * 0.25 * 2 * (0.25 + 0.25 + 0.1)  # kg, below the damp course
UPPER = 2000 * 0.25 * 2 * (0.1 + 0.25 + 0.25)
TURN = 2 * math.pi / PERIOD


def slide(begin, sign, friction):
    """Velocity and displacement since `begin` of a slide in the direction `sign`, as functions of time."""
    slow, shaken = friction * GRAVITY, CYCLES * PERIOD

    def velocity(t):
        return PEAK / TURN * (math.cos(TURN * min(t, shaken)) - math.cos(TURN * begin)) - sign * slow * (t - begin)

    def moved(t):
        end = min(t, shaken)
        on_ground = PEAK / TURN * ((math.sin(TURN * end) - math.sin(TURN * begin)) / TURN - math.cos(TURN * begin) * (end - begin))
        return on_ground + (velocity(end) + sign * slow * (end - begin)) * (t - end) - sign * slow * (t - begin) ** 2 / 2

    return velocity, moved


def stop_of(velocity, sign, low, high):
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if sign * velocity(middle) > 0 else (low, middle)
    return (low + high) / 2


def slides(friction):
    """Begin, end, displacement as a function of time, and displacement before, of each slide."""
    starts = math.asin(friction * GRAVITY / PEAK) / TURN
    found, time, before, sign = [], 0.0, 0.0, -1
    for half in range(2 * CYCLES):
        begin = max(time, half * PERIOD / 2 + starts)
        velocity, moved = slide(begin, sign, friction)
        time = stop_of(velocity, sign, begin + 1e-3 * PERIOD, begin + PERIOD)
        found.append((begin, time, moved, before))
        before += moved(time)
        sign = -sign
    return found


def position(found, t):
    at = 0.0
    for begin, end, moved, before in found:
        if t >= begin:
            at = before + moved(min(t, end))
    return at


def calculate():
    found = slides(DAMP)
    way = sum(abs(moved(end)) for _, end, moved, _ in found)
    without = slides(FOOT)
    return {"back": position(found, 0.25), "left": position(found, END), "shear": LOWER * PEAK + DAMP * UPPER * GRAVITY,
            "heat": DAMP * UPPER * GRAVITY * way, "without": position(without, 0.25), "bound": FOOT * (LOWER + UPPER) * GRAVITY,
            "path": [(t / 500, position(found, t / 500)) for t in range(501)]}


if __name__ == "__main__":
    for name, value in calculate().items():
        if name != "path":
            print(f"{name:8} {value:14.7g}")
