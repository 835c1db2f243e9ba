#!/usr/bin/env python3
"""The tilted wall of model.yaml by hand: its limit by linear programming, with friction in the bed joints and none in the head joints, and
with friction in all of them. Stones of a width of 1."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import blocks
from blocks import np

COURSES, WIDE, LONG, HIGH, MU = 6, 2, 0.5, 0.25, 0.6


def stones():
    """Left and right end, and bottom, of every stone."""
    for course in range(COURSES):
        ends = [LONG * k for k in range(WIDE + 1)] if course % 2 == 0 else [0.0, *(LONG * (k + 0.5) for k in range(WIDE)), WIDE * LONG]
        yield from ((left, right, HIGH * course) for left, right in zip(ends, ends[1:]))


def limit(in_head_joints):
    wall, joints = list(stones()), []
    for upper, (left, right, bottom) in enumerate(wall):
        below = [(-1, -1e9, 1e9)] if bottom == 0 else [(k, a, b) for k, (a, b, y) in enumerate(wall) if y == bottom - HIGH]
        for lower, a, b in below:
            a, b = max(a, left), min(b, right)
            if b > a:
                joints.append((lower, upper, np.array([[a, bottom], [b, bottom]]), np.array([0.0, 1.0]), MU))
        for beside, (_, end, y) in enumerate(wall):
            if y == bottom and end == left:
                joints.append((beside, upper, np.array([[left, bottom], [left, bottom + HIGH]]), np.array([1.0, 0.0]), in_head_joints))
    weights = np.array([right - left for left, right, _ in wall])
    dead, live = np.zeros(3 * len(wall)), np.zeros(3 * len(wall))
    dead[1::3], live[0::3] = -weights, weights
    return blocks.limit([np.array([0.5 * (a + b), y + 0.5 * HIGH]) for a, b, y in wall], joints, dead, live)


def calculate():
    return {"limit": limit(0.0), "dilating": limit(MU)}


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.6g}")
