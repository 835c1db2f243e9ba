#!/usr/bin/env python3
"""Writes the double cantilever beam of Zhu et al. (2017) as an input file for CalculiX 2.20 (ccx).

    calculix_beams.py OUT.inp [--size 0.1875] [--friction 0.2]
    ccx OUT            (without .inp; the figures are then in OUT.dat)

Units: m, N, Pa.  Two beams 6 x 1.5 m, the upper lying on the lower, both fixed at x = 0, plane
stress, thickness 1 m, E = 10 GPa, nu = 0.3, 100 kN downwards on the corner (6, 3).
Source: Zhu, Gao, Hu, Lin, Lu, The Open Civil Engineering Journal 11 (2017) 896-905.

8-node elements with full integration (CPS8), surface-to-surface contact, SPOOLES, one increment.
The two contact stiffnesses were tuned, at the default size; iterations and error of the force:

    normal stiffness   1e11          5e11          1e12          2e12          1e13          1e14
    (Pa per m)         8, +0.153 %   11, +0.021 %  13, +0.005 %  14, -0.003 %  18, -0.009 %  32, -0.009 %

with a stick slope of a tenth of it (1e11 for 5e11 and 2e12).  1e12 is the fastest below 0.01 %, where penalty and mesh errors cancel; 1e13 is
used: the force no longer depends on it. Worse were a first increment below the whole load, node-to-surface contact (7 % off),
the iterative solvers (no convergence) and two threads; mortar contact refuses these elements.

Total normal contact force = vertical reaction of the lower beam ("total force" of set FIXED_LOWER
in OUT.dat, upwards positive): the lower beam carries nothing but the contact.
Total tangential force = its horizontal reaction.
"""
import argparse

LENGTH, HEIGHT = 6.0, 1.5       # of one beam, m
YOUNG, POISSON = 10e9, 0.3      # Pa, -
LOAD = 100e3                    # N, downwards on the corner (6, 3)
NORMAL_STIFFNESS = 1e13         # Pa per m of penetration
STICK_SLOPE = 1e12              # Pa per m of slip before the friction bound is reached


class Beam:
    """A regular mesh of 8-node elements; nodes lie on a grid of half the element size."""

    def __init__(self, name, y0, size, first_node, first_element):
        self.name = name
        self.nx, self.ny = round(LENGTH / size), round(HEIGHT / size)
        self.nodes = {}                                  # (i, j) on the half grid -> number
        self.coordinates = {}                            # number -> (x, y)
        for j in range(2 * self.ny + 1):
            for i in range(2 * self.nx + 1):
                if i % 2 and j % 2:
                    continue                             # no node in the middle of an element
                number = first_node + len(self.nodes)
                self.nodes[i, j] = number
                self.coordinates[number] = (LENGTH * i / (2 * self.nx), y0 + HEIGHT * j / (2 * self.ny))
        self.elements = {}                               # number -> 8 nodes, corners, then mid-sides
        self.bottom, self.top = [], []                   # elements along the edges
        for b in range(self.ny):
            for a in range(self.nx):
                i, j = 2 * a, 2 * b
                number = first_element + len(self.elements)
                places = [(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2),
                          (i + 1, j), (i + 2, j + 1), (i + 1, j + 2), (i, j + 1)]
                self.elements[number] = [self.nodes[p] for p in places]
                if b == 0:
                    self.bottom.append(number)
                if b == self.ny - 1:
                    self.top.append(number)

    def left(self):
        return [n for (i, _), n in self.nodes.items() if i == 0]

    def top_right(self):
        return self.nodes[2 * self.nx, 2 * self.ny]


def deck(size, friction):
    """The input file as one string."""
    lower = Beam("LOWER", 0.0, size, 1, 1)
    upper = Beam("UPPER", HEIGHT, size, len(lower.nodes) + 1, len(lower.elements) + 1)
    lines = ["*HEADING", "Double cantilever beam, Zhu et al. 2017; m, N, Pa"]
    for beam in (lower, upper):
        lines.append("*NODE")
        lines += [f"{n}, {x:.10g}, {y:.10g}" for n, (x, y) in beam.coordinates.items()]
        lines.append(f"*ELEMENT, TYPE=CPS8, ELSET={beam.name}")
        lines += [f"{e}, " + ", ".join(map(str, nodes)) for e, nodes in beam.elements.items()]
        lines.append(f"*NSET, NSET=FIXED_{beam.name}")
        lines += [f"{n}," for n in beam.left()]
    lines += ["*SURFACE, NAME=LOWER_TOP, TYPE=ELEMENT"] + [f"{e}, S3" for e in lower.top]
    lines += ["*SURFACE, NAME=UPPER_BOTTOM, TYPE=ELEMENT"] + [f"{e}, S1" for e in upper.bottom]
    lines += ["*MATERIAL, NAME=CONCRETE", "*ELASTIC", f"{YOUNG:g}, {POISSON:g}"]
    for beam in (lower, upper):
        lines += [f"*SOLID SECTION, ELSET={beam.name}, MATERIAL=CONCRETE", "1.0"]
        lines += ["*BOUNDARY", f"FIXED_{beam.name}, 1, 2"]
    lines += ["*SURFACE INTERACTION, NAME=JOINT",
              "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{NORMAL_STIFFNESS:g}"]
    if friction > 0:
        lines += ["*FRICTION", f"{friction:g}, {STICK_SLOPE:g}"]
    lines += ["*CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE", "UPPER_BOTTOM, LOWER_TOP",
              "*STEP", "*STATIC", "1.0, 1.0",
              "*CLOAD", f"{upper.top_right()}, 2, {-LOAD:g}",
              "*NODE PRINT, NSET=FIXED_LOWER, TOTALS=ONLY", "RF",
              "*NODE FILE", "U", "*EL FILE", "S", "*CONTACT FILE", "CDIS, CSTR",
              "*END STEP", ""]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", metavar="OUT.inp")
    parser.add_argument("--size", type=float, default=0.1875, help="edge of an element, m")
    parser.add_argument("--friction", type=float, default=0.2, help="Coulomb's mu")
    arguments = parser.parse_args()
    with open(arguments.out, "w", encoding="ascii") as out:
        out.write(deck(arguments.size, arguments.friction))


if __name__ == "__main__":
    main()
