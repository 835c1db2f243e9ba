#!/usr/bin/env python3
"""The stop of model.yaml by hand: a rigid block between a jack P, a pad S = K u and friction, which is at most
-MU_BACKWARD N against backward slip and MU_FORWARD N against forward slip.

    forward    P = S + MU_FORWARD N
    backward   P = S - MU_BACKWARD N
    at rest    in between: S stays as it is

N, m. Standard library only."""

NORMAL, FORWARD, BACKWARD = 100e3, 0.1, 0.6  # of the pressure on the head, 1 m2
STIFFNESS = 10e6 * 2.0  # of the pad, 2 m high


def pads(jacks):
    """Force of the pad when the jack has passed each of these forces, one after another, monotonically in between."""
    forces, pad = [], 0.0
    for jack in jacks:
        pad = max(pad, jack - FORWARD * NORMAL)
        pad = min(pad, jack + BACKWARD * NORMAL)
        forces.append(pad)
    return forces


def calculate():
    forces = pads([40e3, 0.0, 90e3, 0.0])
    numbers = {}
    for name, force in zip(("pushed", "let_go", "pushed_harder", "let_go_again"), forces):
        numbers[name] = force
        numbers[f"way_{name}"] = force / STIFFNESS
    ways = [0.0] + [force / STIFFNESS for force in forces]
    numbers["work"] = sum(NORMAL * (FORWARD if b > a else BACKWARD) * abs(b - a) for a, b in zip(ways, ways[1:]))
    return numbers


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:18} {value:12.6g}")
