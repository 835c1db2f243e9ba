#!/usr/bin/env python3
"""The lap joint of model.yaml by hand: the normal force is that of two bolts, and the joint slips as a whole at mu times it,
whatever the stiffness of plates and bolts. N, for one of the two interfaces. Standard library only."""
BOLTS, PRELOAD, MU = 2, 100e3, 0.3


def calculate():
    return {"normal": BOLTS * PRELOAD, "slip": MU * BOLTS * PRELOAD}


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.6g}")
