#!/usr/bin/env python3
"""The arch of model.yaml by hand: the largest axle by linear programming (Livesley 1978), with rigid voussoirs. N, m, per metre of width."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import blocks
from blocks import np

COUNT, INNER, OUTER, CENTRE = 21, 6.25, 6.75, -3.75
STONE, FILL, LEVEL, MU, LOADED, UNIT = 22e3, 18e3, 3.6, 0.6, 5, 1e3


def point(radius, angle):
    return np.array([radius * math.sin(angle), CENTRE + radius * math.cos(angle)])


def calculate():
    step = 2 * math.asin(0.8) / COUNT
    angles = [(k - COUNT / 2) * step for k in range(COUNT + 1)]
    centres, dead, live = [], np.zeros(3 * COUNT), np.zeros(3 * COUNT)
    for k in range(COUNT):
        corners = [point(INNER, angles[k]), point(INNER, angles[k + 1]), point(OUTER, angles[k + 1]), point(OUTER, angles[k])]
        area, centre = area_and_centre(corners)
        centres.append(centre)
        top = 0.5 * (corners[2] + corners[3])
        fill = FILL * (corners[2][0] - corners[3][0]) * (LEVEL - top[1])
        dead[3 * k + 1:3 * k + 3] = -STONE * area - fill, -fill * (top[0] - centre[0])
        if k == LOADED:
            live[3 * k + 1:3 * k + 3] = -UNIT, -UNIT * (top[0] - centre[0])
    joints = []
    for k, angle in enumerate(angles):
        normal = np.array([math.cos(angle), -math.sin(angle)])  # from voussoir k - 1 to voussoir k
        joints.append((k - 1, k if k < COUNT else -1, (point(INNER, angle), point(OUTER, angle)), normal, MU))
    return {"axle": blocks.limit(centres, joints, dead, live)}


def area_and_centre(corners):
    area, centre = 0.0, np.zeros(2)
    for a, b in zip(corners, [*corners[1:], corners[0]]):
        part = 0.5 * (a[0] * b[1] - b[0] * a[1])
        area, centre = area + part, centre + part * (a + b) / 3
    return abs(area), centre / area


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.6g}")
