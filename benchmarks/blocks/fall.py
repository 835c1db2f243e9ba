#!/usr/bin/env python3
"""Does a wall that is pushed harder and harder fall? An oracle that shares neither equations nor elements with the solver.

    fall.py COLUMNS COURSES FRICTION [--parts 0,0.5,0.9,...]

The walls of blocks.py in motion, by explicit time integration (central differences): square finite elements of four nodes and
0.25 m, lumped masses, and at every pair of nodes a spring five times as stiff as the elements, of which the tangential one slips at
Coulomb's bound. The weight is applied first, then the push in parts of its limit load, each over many periods of the wall.
Damping of all motion at about the first natural frequency, and of the springs and elements, lets the wall come to rest where it
can. For every part one line: "stands" (forces are in balance to 1e-5 of a block's weight) or "falls" (a node has moved by 10 mm
in this part; blocks deform by 0.1 mm), where the list ends. Small displacements, like the solver. Needs NumPy and SciPy.
"""
import argparse
import time

import blocks
import numpy as np
import scipy.sparse as sp

YOUNG, POISSON, SIZE = 5e9, 0.2, 0.25
WAVES = 600.0  # m/s, slower than any: for the first natural frequency
FALLEN, BALANCED = 0.01, 1e-5


def element():
    """Stiffness of a square element in plane strain; nodes along x first."""
    elasticity = YOUNG / (1 + POISSON) / (1 - 2 * POISSON) * np.array(
        [[1 - POISSON, POISSON, 0], [POISSON, 1 - POISSON, 0], [0, 0, 0.5 - POISSON]])
    stiffness = np.zeros((8, 8))
    for x in (-1 / np.sqrt(3), 1 / np.sqrt(3)):
        for y in (-1 / np.sqrt(3), 1 / np.sqrt(3)):
            by_x = np.array([y - 1, 1 - y, -1 - y, 1 + y]) / (2 * SIZE)
            by_y = np.array([x - 1, -1 - x, 1 - x, 1 + x]) / (2 * SIZE)
            strain = np.zeros((3, 8))
            strain[0, ::2] = strain[2, 1::2] = by_x
            strain[1, 1::2] = strain[2, ::2] = by_y
            stiffness += strain.T @ elasticity @ strain * SIZE**2 / 4
    return stiffness


def block(columns, rows):
    """Stiffness and nodal masses of a block of so many elements."""
    count = (columns + 1) * (rows + 1)
    stiffness, mass, of_element = np.zeros((2 * count, 2 * count)), np.zeros(count), element()
    for i in range(columns):
        for j in range(rows):
            first = j * (columns + 1) + i
            nodes = np.array([first, first + 1, first + columns + 1, first + columns + 2])
            dofs = np.c_[2 * nodes, 2 * nodes + 1].ravel()
            stiffness[np.ix_(dofs, dofs)] += of_element
            mass[nodes] += blocks.DENSITY * SIZE**2 / 4
    return stiffness, mass


class Wall:
    def __init__(self, columns, courses, friction, stiffer):
        height = blocks.height_of(columns)
        self.rows, self.friction = round(height / SIZE), friction
        spans = [[(round(a / SIZE), round(b / SIZE)) for a, b in course] for course in blocks.courses_of(columns, courses, height)]
        self.place_blocks(spans)
        self.join(spans)
        self.spring = stiffer * YOUNG * self.length / SIZE
        at_nodes = np.abs(self.to_nodes) @ np.repeat(self.spring, 2)
        largest = max(np.linalg.eigvalsh(stiffness)[-1] for _, stiffness in self.groups)
        frequency = np.sqrt(((2 * at_nodes + largest) / self.mass).max())
        self.dt, self.delay = 1.28 / frequency, 0.24 / frequency  # of at most 2 without the damping of springs
        self.damping = 2 * np.pi * WAVES / (4 * max(columns, courses * height))
        self.u, self.v, self.tangential = np.zeros(len(self.mass)), np.zeros(len(self.mass)), np.zeros(len(self.length))
        self.load = np.zeros(len(self.mass))

    def place_blocks(self, spans):
        """Nodes of all blocks, equal blocks together; their masses, weights and the lengths on which the push acts."""
        self.groups, self.node, masses, pushed = [], {}, [], []
        for width in sorted({b - a for course in spans for a, b in course}):
            stiffness, mass = block(width, self.rows)
            start = sum(map(len, masses))
            for z, course in enumerate(spans):
                for k, (a, b) in enumerate(course):
                    if b - a != width:
                        continue
                    first = sum(map(len, masses))
                    for j in range(self.rows + 1):
                        for i in range(width + 1):
                            self.node[z, k, a + i, z * self.rows + j] = first + j * (width + 1) + i
                        if k == 0:
                            pushed.append((first + j * (width + 1), SIZE / 2 if j in (0, self.rows) else SIZE))
                    masses.append(mass)
            self.groups.append((slice(2 * start, 2 * sum(map(len, masses))), stiffness))
        self.mass = np.repeat(np.concatenate(masses), 2)
        self.weight, self.push = np.zeros(len(self.mass)), np.zeros(len(self.mass))
        self.weight[1::2] = -blocks.GRAVITY * self.mass[1::2]
        for node, length in pushed:
            self.push[2 * node] += length

    def join(self, spans):
        """Pairs of nodes: relative motions [normal, tangential] by those of the nodes, and the length of joint of each."""
        entries, self.length = [], []

        def joint(below, above, x, y, upright):
            """Between two blocks, or the floor and a block, at these points of the grid."""
            points = [(x, j) for j in y] if upright else [(i, y) for i in x]
            for k, point in enumerate(points):
                for body, sign in ((below, -1.0), (above, 1.0)):
                    if body is not None:
                        node, row = self.node[(*body, *point)], 2 * len(self.length)
                        entries.append((row, 2 * node + (0 if upright else 1), sign))
                        entries.append((row + 1, 2 * node + (1 if upright else 0), sign))
                self.length.append(SIZE / 2 if k in (0, len(points) - 1) else SIZE)

        for z, course in enumerate(spans):
            ground = z * self.rows
            for k, (a, b) in enumerate(course):
                if k > 0:
                    joint((z, k - 1), (z, k), a, range(ground, ground + self.rows + 1), True)
                if z == 0:
                    joint(None, (z, k), range(a, b + 1), 0, False)
                    continue
                for other, (c, d) in enumerate(spans[z - 1]):
                    if min(b, d) > max(a, c):
                        joint((z - 1, other), (z, k), range(max(a, c), min(b, d) + 1), ground, False)
        rows, columns, values = zip(*entries)
        self.length = np.array(self.length)
        self.motion = sp.csr_matrix((values, (rows, columns)), shape=(2 * len(self.length), len(self.mass)))
        self.to_nodes = self.motion.T.tocsr()

    def forces(self, load):
        """Of loads, elements and springs on all nodes. Slips of the step before enter the tangential springs."""
        force, delayed = load.copy(), self.u + self.delay * self.v
        for dofs, stiffness in self.groups:
            force[dofs] -= (delayed[dofs].reshape(-1, len(stiffness)) @ stiffness).ravel()
        normal = np.maximum(0.0, -self.spring * (self.motion @ delayed)[::2])
        bound = self.friction * normal
        self.tangential = np.clip(self.tangential - self.spring * self.dt * (self.motion @ self.v)[1::2], -bound, bound)
        return force + self.to_nodes @ np.c_[normal, self.tangential].ravel()

    def go_on(self, load, steps_of_load, most):
        """Until the wall stands or falls under this load."""
        before, at = self.load, self.u
        for step in range(most):
            part = min(1.0, (step + 1) / steps_of_load)
            force = self.forces(before + part * (load - before))
            if part == 1.0 and step % 500 == 0:
                moved = np.abs(self.u - at).max()
                if moved > FALLEN:
                    return "falls", moved
                if np.abs(force).max() < BALANCED * blocks.DENSITY * blocks.GRAVITY / 2:
                    self.load = load
                    return "stands", moved
            half = 0.5 * self.damping * self.dt
            self.v = ((1 - half) * self.v + self.dt * force / self.mass) / (1 + half)
            self.u = self.u + self.dt * self.v
        self.load = load
        return "not at rest", np.abs(self.u - at).max()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("columns", type=int)
    parser.add_argument("courses", type=int)
    parser.add_argument("friction", type=float)
    parser.add_argument("--parts", default="0,0.5,0.7,0.8,0.85,0.9,0.92,0.94,0.96,0.98,0.99,1.01", help="of the limit load, ascending")
    parser.add_argument("--stiffer", type=float, default=5.0, help="springs of a joint, over elements")
    parser.add_argument("--steps-of-load", type=int, default=20000, help="time steps over which a part is applied")
    parser.add_argument("--most", type=int, default=200000, help="time steps of a part, most")
    options = parser.parse_args()
    wall = Wall(options.columns, options.courses, options.friction, options.stiffer)
    limit, start = blocks.limit_load(options.columns, options.courses, options.friction), time.process_time()
    print(f"{options.columns} x {options.courses}, friction {options.friction}: {len(wall.length)} pairs, steps of {wall.dt:.2g} s", flush=True)
    for part in map(float, options.parts.split(",")):
        end, moved = wall.go_on(wall.weight + part * limit * wall.push, options.steps_of_load, options.most)
        print(f"{part:.3f} {end}, moved by {1e3 * moved:.3g} mm, {time.process_time() - start:.1f} s", flush=True)
        if end == "falls":
            break


if __name__ == "__main__":
    main()
