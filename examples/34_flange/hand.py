#!/usr/bin/env python3
"""The flange of model.yaml by hand: what the bolts press less what the fluid lifts, on the closed end of the pipe and on the flange up to the
gasket. N, m. Standard library only."""
import math

BOLTS, PRESSURE, GASKET = 200e3, 3e6, 55e-3


def calculate():
    return {"tightened": BOLTS, "pressed": BOLTS - PRESSURE * math.pi * GASKET**2}


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.6g}")
