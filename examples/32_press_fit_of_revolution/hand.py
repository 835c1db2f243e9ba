#!/usr/bin/env python3
"""The press fit of model.yaml by hand. N, m. Standard library only.

Lame, both rings free along the axis: u(a) of the hub under p and of the shaft under -p differ by the interference,

    interference = p a / E ((b^2 + a^2) / (b^2 - a^2) + (a^2 + c^2) / (a^2 - c^2))

with the seat a, the rim b and the bore c. Friction mu p acts on the seat, 2 pi a L; that the push makes the shaft thicker is left out."""
import math

BORE, SEAT, RIM, LENGTH = 10e-3, 25e-3, 50e-3, 60e-3
INTERFERENCE, MU, YOUNG, POISSON = 20e-6, 0.15, 210e9, 0.3
AREA = 2 * math.pi * SEAT * LENGTH


def calculate():
    hub = (RIM**2 + SEAT**2) / (RIM**2 - SEAT**2)
    shaft = (SEAT**2 + BORE**2) / (SEAT**2 - BORE**2)
    pressure = YOUNG * INTERFERENCE / (SEAT * (hub + shaft))
    return {"pressure": pressure, "hoop": pressure * hub, "growth": pressure * SEAT / YOUNG * (hub + POISSON),
            "push": MU * pressure * AREA, "friction": MU}


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.6g}")
