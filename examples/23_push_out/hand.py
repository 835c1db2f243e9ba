#!/usr/bin/env python3
"""The bar of model.yaml by hand: bar and jaw are thin layers of the heights h and H, whose interference compresses both, and
Coulomb's friction moves along the overlap. N, m. Standard library only.

    p (h + H) / E = delta + nu (h s + H S) / E          across: s, S are the axial pressures in bar and jaw
    h s + H S     = mu p L                              pushed: what bar and jaw carry along is together the whole friction
                  = 0                                   pulled: the bar is in tension by as much as the jaw is compressed

L is the overlap. Beyond it nothing is pressed: that stress spreads a little into what sticks out is left out."""

HALF, JAW, LENGTH, WIDTH = 10e-3, 10e-3, 100e-3, 40e-3
INTERFERENCE, MU, YOUNG, POISSON = 10e-6, 0.15, 210e9, 0.3


def pressure(overlap, pushed):
    return YOUNG * INTERFERENCE / (HALF + JAW - (POISSON * MU * overlap if pushed else 0))


def force(way, pushed):
    """Of both halves."""
    overlap = LENGTH - way
    return 2 * MU * pressure(overlap, pushed) * overlap * WIDTH


def work(way, pushed, parts=1000):
    """Against friction, by Simpson's rule."""
    step = way / parts
    return step / 6 * sum(force(k * step, pushed) + 4 * force((k + 0.5) * step, pushed) + force((k + 1) * step, pushed)
                          for k in range(parts))


def calculate():
    numbers = {"pressure": pressure(0, True)}
    for name, pushed in (("pushed", True), ("pulled", False)):
        numbers |= {f"{name}_{round(1e3 * way)}": force(way, pushed) for way in (0, 20e-3, 40e-3, 60e-3)}
        numbers[f"{name}_work"] = work(80e-3, pushed)
    return numbers


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:12} {value:14.6g}")
