#!/usr/bin/env python3
"""The sheet-pile wall of model.yaml by hand: thrusts of ground at rest, K0 gamma z^2 / 2. N, m, per metre of length. Standard library only."""
DEPTH, DIG, THICKNESS, K0, GAMMA = 12.0, 4.0, 0.4, 0.5, 18e3


def calculate():
    back, pit = 0.5 * K0 * GAMMA * DEPTH**2, 0.5 * K0 * GAMMA * DIG**2
    # The wall takes the place of ground: above the level of the pit it weighs as much.
    return {"back": back, "front": back - pit, "wall": -GAMMA * THICKNESS * DIG, "balance": 0.0}


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.6g}")
