#!/usr/bin/env python3
"""The press fit of model.yaml by hand: Lame's pressure in plane stress, the torque and the push-out force that friction
carries, and the temperature of the hub at which the fit is loose. N, m, K. Standard library only."""
import math

BORE, SEAT, RIM, LENGTH = 20e-3, 50e-3, 100e-3, 60e-3
INTERFERENCE, MU, YOUNG, POISSON, EXPANSION = 50e-6, 0.15, 210e9, 0.3, 12e-6


def calculate():
    # Radial displacements of hub and shaft at the seat, for a pressure of 1: u = a / E ((b^2 + a^2) / (b^2 - a^2) +- nu).
    hub = SEAT / YOUNG * ((RIM**2 + SEAT**2) / (RIM**2 - SEAT**2) + POISSON)
    shaft = SEAT / YOUNG * ((SEAT**2 + BORE**2) / (SEAT**2 - BORE**2) - POISSON)
    pressure = INTERFERENCE / (hub + shaft)
    area = 2 * math.pi * SEAT * LENGTH
    release = INTERFERENCE / (EXPANSION * SEAT)
    return {"pressure": pressure, "push_out": MU * pressure * area, "torque": MU * pressure * area * SEAT, "release": release,
            "pressure_80": pressure * (1 - 80 / release), "gap_90": EXPANSION * SEAT * (90 - release)}


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.6g}")
