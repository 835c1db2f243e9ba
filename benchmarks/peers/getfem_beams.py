#!/usr/bin/python3
"""Solves the double cantilever beam of Zhu et al. (2017) with GetFEM and prints its contact force.

    getfem_beams.py [--size 0.1875] [--friction 0.2] [--order 2] [--finest 0.0125]

Two beams 6 x 1.5 m, the upper lying on the lower, both fixed at x = 0, plane stress, thickness 1 m,
E = 10 GPa, nu = 0.3, 100 kN downwards on the corner (6, 3).
Source: Zhu, Gao, Hu, Lin, Lu, The Open Civil Engineering Journal 11 (2017) 896-905.

8-node elements; GetFEM's integral contact brick, an augmented Lagrangian (Alart and Curnier 1991,
not symmetrised) whose multiplier, the traction on the lower beam's top, is continuous and linear. With
--order K above 2: Lagrange's elements of that order, the multiplier one order lower. With --finest: lines of the mesh this
close to each other at the built-in ends, at the faces of the beams and where contact ends, farther apart by a quarter of the distance.

Of the four forms of the brick the first takes 4 Newton iterations, the second does not converge in 60; the other two
converge in 4 to 10, but the integral of their multiplier is not the contact force.

Units: m, GN, GPa. In N and Pa the contact rows of the residual, of size pressure / r, would be ten orders
of magnitude smaller than the forces, and Newton's method would stop before it has found the contact.

Output, one line of JSON: normal_force and tangential_force (kN, on the upper beam, upwards and along
+x positive), newton_iterations, dofs (multipliers included). Exit status 1 if not converged.
"""
import argparse
import json
import sys

import getfem
import numpy as np

LENGTH, HEIGHT = 6.0, 1.5       # of one beam, m
YOUNG, POISSON = 10.0, 0.3      # GPa, -
CONTACT_END = 5.15              # m, as all three programs find it
LOAD = 1e-4                     # GN, downwards on the corner (6, 3)
TOLERANCE = 1e-12               # on the residual: 1e-8 of the load
KILONEWTON = 1e-6               # GN
FIXED, JOINT = 1, 2             # numbers of the two regions on either mesh
EPSILON = 1e-9                  # m, for finding nodes by their place


def lines(length, size, finest, places):
    """Coordinates from 0 to length, as far apart as `size`, or near the places as finest + distance / 4."""
    x = np.linspace(0.0, length, 100001)
    near = np.abs(x[:, None] - np.array(places)).min(axis=1)
    parts = np.concatenate(([0.0], np.cumsum(np.diff(x) / np.minimum(size, finest + 0.25 * near)[1:])))
    return np.interp(np.linspace(0.0, parts[-1], int(np.ceil(parts[-1])) + 1), parts, x)


def beam_mesh(y0, size, finest=None):
    """A mesh of the beam between y0 and y0 + HEIGHT, with its regions FIXED and JOINT: squares, or see the head of this file."""
    if finest:
        x = lines(LENGTH, size, finest, [0.0, CONTACT_END])
        y = y0 + lines(HEIGHT, size, finest, [0.0, HEIGHT])
    else:
        x = np.linspace(0.0, LENGTH, round(LENGTH / size) + 1)
        y = np.linspace(y0, y0 + HEIGHT, round(HEIGHT / size) + 1)
    mesh = getfem.Mesh("cartesian", x, y)
    points = mesh.pts()
    mesh.set_region(FIXED, mesh.faces_from_pid(np.flatnonzero(points[0] < EPSILON)))
    mesh.set_region(JOINT, mesh.faces_from_pid(np.flatnonzero(abs(points[1] - HEIGHT) < EPSILON)))
    return mesh


def vector_field(mesh, element):
    field = getfem.MeshFem(mesh, 2)
    field.set_fem(getfem.Fem(element))
    return field


def solve(size, friction, order=2, finest=None):
    """The figures to print, and whether Newton's method converged."""
    model = getfem.Model("real")
    # GetFEM's Lame constant is that of plane strain; this value of it gives plane stress.
    model.add_initialized_data("lambda", [YOUNG * POISSON / (1.0 - POISSON**2)])
    model.add_initialized_data("G", [YOUNG / (2.0 * (1.0 + POISSON))])
    meshes = {"lower": beam_mesh(0.0, size, finest), "upper": beam_mesh(HEIGHT, size, finest)}
    fields = {}
    for beam, mesh in meshes.items():
        fields[beam] = vector_field(mesh, "FEM_Q2_INCOMPLETE(2)" if order == 2 else f"FEM_QK(2, {order})")
        gauss = getfem.MeshIm(mesh, getfem.Integ(f"IM_GAUSS_PARALLELEPIPED(2, {2 * order})"))   # 3 x 3 points of order 2
        model.add_fem_variable(beam, fields[beam])
        model.add_isotropic_linearized_elasticity_brick(gauss, beam, "lambda", "G")
        model.add_Dirichlet_condition_with_simplification(beam, FIXED)

    x, y = fields["upper"].basic_dof_nodes()
    corner = np.flatnonzero((x > LENGTH - EPSILON) & (y > 2 * HEIGHT - EPSILON))     # dofs x, y
    force = np.zeros(fields["upper"].nbdof())
    force[corner[1]] = -LOAD
    model.add_explicit_rhs("upper", force)

    model.add_filtered_fem_variable("traction", vector_field(meshes["lower"], f"FEM_QK(2, {order - 1})"), JOINT)
    model.add_initialized_data("r", [YOUNG])             # close to E, as the manual advises
    model.add_initialized_data("mu", [friction])
    # Five points to an edge of order 2: the integrand has kinks where contact ends.
    gauss = getfem.MeshIm(meshes["lower"], getfem.Integ(f"IM_GAUSS_PARALLELEPIPED(2, {4 * order})"))
    model.add_integral_contact_between_nonmatching_meshes_brick(
        gauss, "lower", "upper", "traction", "r", "mu", JOINT, JOINT)

    # MUMPS by name: SuperLU, the alternative, crashes in Debian 12's build of GetFEM.
    iterations, converged = model.solve("max_res", TOLERANCE, "max_iter", 50,
                                        "lsearch", "simplest", "lsolver", "mumps")
    on_lower = getfem.asm("generic", gauss, 0, "traction", JOINT, model)
    figures = {"normal_force": -on_lower[1] / KILONEWTON, "tangential_force": -on_lower[0] / KILONEWTON,
               "newton_iterations": int(iterations), "dofs": int(model.nbdof())}
    return figures, bool(converged)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=float, default=0.1875, help="edge of an element, m")
    parser.add_argument("--friction", type=float, default=0.2, help="Coulomb's mu")
    parser.add_argument("--order", type=int, default=2, help="of the elements")
    parser.add_argument("--finest", type=float, help="smallest distance of lines of the mesh, m (default: equal squares)")
    arguments = parser.parse_args()
    getfem.util_trace_level(0)
    figures, converged = solve(arguments.size, arguments.friction, arguments.order, arguments.finest)
    print(json.dumps(figures))
    if not converged:
        sys.exit("getfem_beams.py: Newton's method did not converge")


if __name__ == "__main__":
    main()
