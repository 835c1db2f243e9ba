#!/usr/bin/python3
"""Solves the double cantilever beam of Zhu et al. (2017) with FEniCS and prints its contact force.

    fenics_beams.py [--size 0.1875] [--friction 0.2] [--penalty 1e13]

Two beams 6 x 1.5 m, the upper lying on the lower, both fixed at x = 0, plane stress, thickness 1 m, E = 10 GPa,
nu = 0.3, 100 kN downwards on the corner (6, 3). Units: m, N, Pa.
Source: Zhu, Gao, Hu, Lin, Lu, The Open Civil Engineering Journal 11 (2017) 896-905.

FEniCS (dolfin 2019.2) has no contact. It gives the stiffness matrix of each beam, quadratic triangles; contact is
written here: pairs of nodes along the joint, which both meshes divide alike, with a penalty stiffness along the normal
and the tangent, Coulomb's law by return mapping, and Newton's method.

Output, one line of JSON: normal_force and tangential_force (kN, on the upper beam, upwards and along +x positive),
newton_iterations, dofs, penetration (m). Exit status 1 if not converged.
"""
import argparse
import json
import sys

import dolfin
import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve

LENGTH, HEIGHT = 6.0, 1.5   # of one beam, m
YOUNG, POISSON = 10e9, 0.3  # Pa, -
LOAD = 100e3                # N, downwards on the corner (6, 3)
FIXED = ("near(x[0], 0.0)", "near(x[0], 0.0)")  # where the lower and the upper beam are held
EPSILON = 1e-9              # m, for finding nodes by their place


def beam(y0, size, held):
    """Stiffness matrix of the beam between y0 and y0 + HEIGHT, fixed where it is held, and the places of its dofs."""
    counts = round(LENGTH / size), round(HEIGHT / size)
    mesh = dolfin.RectangleMesh(dolfin.Point(0.0, y0), dolfin.Point(LENGTH, y0 + HEIGHT), *counts, "crossed")
    space = dolfin.VectorFunctionSpace(mesh, "CG", 2)
    u, v = dolfin.TrialFunction(space), dolfin.TestFunction(space)
    mu = YOUNG / (2 * (1 + POISSON))
    plane_stress = YOUNG * POISSON / (1 - POISSON**2)  # in the place of Lame's lambda

    def strain(w):
        return dolfin.sym(dolfin.grad(w))

    stress = 2 * mu * strain(u) + plane_stress * dolfin.tr(strain(u)) * dolfin.Identity(2)
    K, f = dolfin.PETScMatrix(), dolfin.PETScVector()
    fixed = dolfin.DirichletBC(space, dolfin.Constant((0.0, 0.0)), held)
    nothing = dolfin.dot(dolfin.Constant((0.0, 0.0)), v) * dolfin.dx
    dolfin.assemble_system(dolfin.inner(stress, strain(v)) * dolfin.dx, nothing, fixed, A_tensor=K, b_tensor=f)
    K = sparse.csr_matrix(K.mat().getValuesCSR()[::-1], shape=(space.dim(), space.dim()))
    places = space.tabulate_dof_coordinates()
    of_component = [np.array(space.sub(c).dofmap().dofs()) for c in (0, 1)]
    return K, places, of_component


def joint(places, of_component, size):
    """Dofs x and y of the nodes at y = HEIGHT from left to right, and the length that belongs to each (Simpson)."""
    dofs = []
    for component in of_component:
        of_line = component[abs(places[component, 1] - HEIGHT) < EPSILON]
        dofs.append(of_line[np.argsort(places[of_line, 0])])
    lengths = np.full(len(dofs[0]), size / 3)
    lengths[1::2] = 2 * size / 3
    lengths[[0, -1]] = size / 6
    return dofs, lengths


def load_on_corner(places, of_component, force):
    """Sets the nodal forces of the upper beam."""
    of_y = of_component[1]
    force[of_y[np.linalg.norm(places[of_y] - [LENGTH, 2 * HEIGHT], axis=1) < EPSILON]] = -LOAD


def solve(size, friction, penalty, load=load_on_corner):
    """The figures to print, and whether Newton's method converged."""
    beams = [beam(y0, size, held) for y0, held in zip((0.0, HEIGHT), FIXED)]
    K = sparse.block_diag([of[0] for of in beams], format="csr")
    first_of_upper = beams[0][0].shape[0]
    (lower_x, lower_y), lengths = joint(*beams[0][1:], size)
    (upper_x, upper_y), _ = joint(*beams[1][1:], size)
    pairs, n = len(lengths), K.shape[0]
    rows = np.tile(np.arange(pairs), 2)
    signs = np.repeat([1.0, -1.0], pairs)
    gap = sparse.csr_matrix((signs, (rows, np.r_[upper_y + first_of_upper, lower_y])), (pairs, n))   # opening
    slip = sparse.csr_matrix((signs, (rows, np.r_[upper_x + first_of_upper, lower_x])), (pairs, n))  # of the upper beam

    force = np.zeros(n)
    load(*beams[1][1:], force[first_of_upper:])
    largest = np.abs(force).max()
    u, k = np.zeros(n), penalty * lengths
    for iteration in range(1, 51):
        normal = np.maximum(-k * (gap @ u), 0.0)           # compression is positive
        trial = -k * (slip @ u)                            # friction on the upper beam
        bound = friction * normal
        slides = abs(trial) > bound
        tangential = np.where(slides, np.sign(trial) * bound, trial)
        residual = force - K @ u + gap.T @ normal + slip.T @ tangential
        if np.abs(residual).max() <= 1e-8 * largest and iteration > 1:
            break
        closed = sparse.diags(np.where(gap @ u <= 0.0, k, 0.0))
        sticks = sparse.diags(np.where(slides, 0.0, k))
        # Where a pair slides, its friction changes with the normal force.
        follows = sparse.diags(np.where(slides & (normal > 0.0), friction * np.sign(trial) * k, 0.0))
        u += spsolve((K + gap.T @ closed @ gap + slip.T @ sticks @ slip + slip.T @ follows @ gap).tocsc(), residual)
    else:
        return {}, False
    return {"normal_force": normal.sum() / 1e3, "tangential_force": tangential.sum() / 1e3,
            "newton_iterations": iteration - 1, "dofs": n, "penetration": float(-(gap @ u).min())}, True


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=float, default=0.1875, help="edge of a square of four triangles, m")
    parser.add_argument("--friction", type=float, default=0.2, help="Coulomb's mu")
    parser.add_argument("--penalty", type=float, default=1e13, help="stiffness of the joint, Pa/m")
    arguments = parser.parse_args()
    dolfin.set_log_level(dolfin.LogLevel.ERROR)
    figures, converged = solve(arguments.size, arguments.friction, arguments.penalty)
    print(json.dumps(figures))
    if not converged:
        sys.exit("fenics_beams.py: Newton's method did not converge")


if __name__ == "__main__":
    main()
