#!/usr/bin/env python3
"""The block of model.yaml by hand: a rigid block that slides with Coulomb's friction while the ground moves with the acceleration
A sin(w t) for one cycle, and is at rest then.

It starts to slide when A sin(w t) exceeds mu g, and from then on its velocity relative to the ground changes by mu g - A sin(w t) until it
is 0; and likewise forward, with the other sign of friction. Between, it stays if |A sin(w t)| <= mu g. All of it is in closed form
but for the times at which the velocity is 0, which are found by bisection. Standard library only. Units of the model: m, s, N."""
import math

GRAVITY, FRICTION, PEAK, PERIOD, MASS = 9.81, 0.3, 4.905, 0.5, 2000.0
TURN = 2 * math.pi / PERIOD
SLOW = FRICTION * GRAVITY


def slide(begin, sign):
    """Velocity and displacement since `begin` of a slide in the direction `sign`, as functions of time."""
    def velocity(t):
        end = min(t, PERIOD)
        return -PEAK / TURN * (math.cos(TURN * begin) - math.cos(TURN * end)) - sign * SLOW * (t - begin)

    def moved(t):
        end = min(t, PERIOD)
        of_ground = PEAK / TURN * (math.cos(TURN * begin) * (end - begin) - (math.sin(TURN * end) - math.sin(TURN * begin)) / TURN)
        after = -PEAK / TURN * (math.cos(TURN * begin) - math.cos(TURN * end)) * (t - end)
        return -of_ground + after - sign * SLOW * (t - begin) ** 2 / 2

    return velocity, moved


def stop_of(velocity, sign, low, high):
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if sign * velocity(middle) > 0 else (low, middle)
    return (low + high) / 2


def calculate():
    starts = math.asin(SLOW / PEAK) / TURN
    velocity, back = slide(starts, -1)
    turned = stop_of(velocity, -1, PERIOD / 4, PERIOD)
    farthest = back(turned)
    again = max(turned, PERIOD / 2 + starts)  # the ground pulls it the other way
    velocity, forth = slide(again, 1)
    stopped = stop_of(velocity, 1, 0.75 * PERIOD, 2 * PERIOD)
    left = farthest + forth(stopped)
    path = []
    for k in range(401):
        t = k / 400 * 2 * PERIOD
        path.append((t, 0.0 if t < starts else back(t) if t < turned else farthest if t < again else
                     farthest + forth(t) if t < stopped else left))
    return {"starts": starts, "turned": turned, "again": again, "stopped": stopped, "farthest": farthest, "left": left,
            "shear": SLOW * MASS, "heat": SLOW * MASS * (abs(farthest) + abs(left - farthest)), "path": path}


if __name__ == "__main__":
    for name, value in calculate().items():
        if name != "path":
            print(f"{name:8} {value:14.7g}")
