#!/usr/bin/env python3
"""The retaining wall of model.yaml by hand: thrust of the soil at rest and active, resultants in the base, and the
coefficient of friction at which it slides. N/m and m, for each metre of wall. Standard library only."""
import math

H, PHI, K0, SOIL = 4.0, math.radians(30), 0.5, 18e3
WEIGHT = 2400 * 9.81 * (1 * H + 0.5 * 1 * H)
ARM = (1 * H * 1.5 + 0.5 * H * 2 / 3) / (1.5 * H)  # of the weight, from the toe


def active_by_coulomb():
    """Largest thrust of a wedge under the plane at the angle a, its weight and the friction on the plane in balance."""
    def of(a):
        return SOIL * H**2 / (2 * math.tan(a)) * math.tan(a - PHI)
    return max(of(math.radians(i / 100)) for i in range(3001, 9000))


def centre(thrust, height):
    """Of the pressure in the base, from the toe."""
    return (WEIGHT * ARM - thrust * height) / WEIGHT


def calculate():
    at_rest, active = K0 * SOIL * H**2 / 2, math.tan(math.pi / 4 - PHI / 2)**2 * SOIL * H**2 / 2
    assert abs(active_by_coulomb() / active - 1) < 1e-6, "Rankine and Coulomb agree"
    return {"weight": WEIGHT, "at_rest": at_rest, "active": active, "height": H / 3, "centre": centre(active, H / 3),
            "friction": active / WEIGHT}


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.6g}")
