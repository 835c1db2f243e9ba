#!/usr/bin/env python3
"""The heated hub of model.yaml by hand: Lame's pressure in plane stress, the torque that friction carries, and the growth of a free ring,
whose bore grows by its mean temperature, however that depends on the radius. N, m, K. Standard library only."""
import math

SEAT, RIM, LENGTH, INTERFERENCE, MU = 30e-3, 60e-3, 40e-3, 25e-6, 0.12
STEEL, ALUMINIUM, EXPANSION = (210e9, 0.3), (70e9, 0.33), 23e-6
RINGS = ((30e-3, 40e-3, 60.0), (40e-3, 50e-3, 40.0), (50e-3, 60e-3, 20.0))     # inner and outer radius, temperature


def calculate():
    # Radial displacements at the seat for a pressure of 1.
    young, poisson = ALUMINIUM
    hub = SEAT / young * ((RIM**2 + SEAT**2) / (RIM**2 - SEAT**2) + poisson)
    young, poisson = STEEL
    shaft = SEAT / young * (1 - poisson)
    force = INTERFERENCE / (hub + shaft) * 2 * math.pi * SEAT * LENGTH
    # A free ring in plane stress: u(a) = 2 alpha a / (b^2 - a^2) times the integral of T r dr.
    mean = sum(temperature * (outer**2 - inner**2) for inner, outer, temperature in RINGS) / (RIM**2 - SEAT**2)
    growth = EXPANSION * SEAT * mean
    return {"force": force, "torque": MU * force * SEAT, "force_half": force * (1 - 0.5 * growth / INTERFERENCE), "mean": mean,
            "gap": growth - INTERFERENCE}


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.6g}")
