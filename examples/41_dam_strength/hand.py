#!/usr/bin/env python3
"""The dam of model.yaml by hand: thrust and effective weight, and the factor by which friction can be reduced, mu (W - U) / H. N, m, per
metre of length. Standard library only."""
import math

CONCRETE, WATER, LEVEL, SEISMIC, ANGLE = 24e3, 9.81e3, 28.0, 0.1, 45.0
OUTLINE = ((0, 0), (24, 0), (5, 26), (5, 30), (0, 30))
HEIGHTS = (0, 7, 14, 20, 24, 26, 27, 27.6, 27.9, 28)                           # where the table of model.yaml has Westergaard's pressure


def westergaard(y):
    return 0.875 * SEISMIC * WATER * math.sqrt(LEVEL * (LEVEL - y))


def calculate():
    area = 0.5 * sum(x * v - u * y for (x, y), (u, v) in zip(OUTLINE, (*OUTLINE[1:], OUTLINE[0])))
    weight, uplift = CONCRETE * area, 0.5 * WATER * LEVEL * 24
    still, quake = 0.5 * WATER * LEVEL**2, SEISMIC * weight
    added = sum(0.5 * (westergaard(low) + westergaard(high)) * (high - low) for low, high in zip(HEIGHTS, HEIGHTS[1:]))
    thrust, normal = still + quake + added, weight - uplift
    return {"still": still, "thrust": thrust, "normal": normal, "factor": math.tan(math.radians(ANGLE)) * normal / thrust}


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.6g}")
