#!/usr/bin/python3
"""Solves the block with a round bottom (round_block.py) with GetFEM and prints the force on the floor.

    getfem_round_block.py [--elements 40]

Eight-node elements whose sides follow the arc; GetFEM's integral contact with a rigid obstacle, an augmented Lagrangian with a linear
multiplier, as in getfem_beams.py. Units: m, GN, GPa.

Output, one line of JSON: normal_force (kN, half of the block), newton_iterations, dofs (multipliers included). Exit status 1 if not converged.
"""
import argparse
import json
import sys

import getfem
import numpy as np

import round_block

MIDDLE, TOP, ROUND = 1, 2, 3
UNIT = 1e-9        # GPa in a Pa
EPSILON = 1e-9     # m


def block_mesh(n):
    nodes, elements = round_block.grid(n)
    # GetFEM counts the nodes of an element row by row: lower left, lower middle, lower right, left, right, upper ones.
    order = (0, 4, 1, 7, 5, 3, 6, 2)
    points = np.array([[nodes[places[k]] for k in order] for places in elements])     # elements x 8 x 2
    mesh = getfem.Mesh("empty", 2)
    mesh.add_convex(getfem.GeoTrans("GT_Q2_INCOMPLETE(2)"), np.ascontiguousarray(points.transpose(2, 1, 0)))
    at = mesh.pts()
    arc = round_block.RADIUS - np.sqrt(round_block.RADIUS**2 - at[0] ** 2)
    for region, on in ((MIDDLE, at[0] < EPSILON), (TOP, at[1] > round_block.HEIGHT - EPSILON), (ROUND, at[1] < arc + EPSILON)):
        mesh.set_region(region, mesh.faces_from_pid(np.flatnonzero(on)))
    return mesh


def solve(n):
    model = getfem.Model("real")
    young, poisson = round_block.YOUNG * UNIT, round_block.POISSON
    model.add_initialized_data("lambda", [young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))])
    model.add_initialized_data("G", [young / (2.0 * (1.0 + poisson))])
    mesh = block_mesh(n)
    field = getfem.MeshFem(mesh, 2)
    field.set_fem(getfem.Fem("FEM_Q2_INCOMPLETE(2)"))
    gauss = getfem.MeshIm(mesh, getfem.Integ("IM_GAUSS_PARALLELEPIPED(2, 4)"))
    model.add_fem_variable("u", field)
    model.add_isotropic_linearized_elasticity_brick(gauss, "u", "lambda", "G")
    model.add_initialized_data("moved", [0.0, -round_block.DOWN])
    model.add_Dirichlet_condition_with_simplification("u", TOP, "moved")
    model.add_normal_Dirichlet_condition_with_multipliers(gauss, "u", 1, MIDDLE)
    scalar = getfem.MeshFem(mesh, 1)
    scalar.set_fem(getfem.Fem("FEM_QK(2, 1)"))
    model.add_filtered_fem_variable("pressure", scalar, ROUND)
    distance = getfem.MeshFem(mesh, 1)
    distance.set_fem(getfem.Fem("FEM_Q2_INCOMPLETE(2)"))
    model.add_initialized_fem_data("distance", distance, distance.basic_dof_nodes()[1])  # from the floor y = 0
    model.add_initialized_data("r", [young])
    gauss = getfem.MeshIm(mesh, getfem.Integ("IM_GAUSS_PARALLELEPIPED(2, 8)"))
    model.add_integral_contact_with_rigid_obstacle_brick(gauss, "u", "pressure", "distance", "r", ROUND)
    iterations, converged = model.solve("max_res", 1e-13, "max_iter", 50, "lsearch", "simplest", "lsolver", "mumps")
    force = getfem.asm("generic", gauss, 0, "pressure", ROUND, model)
    return {"normal_force": float(abs(np.ravel(force)[0])) / UNIT / 1e3, "newton_iterations": int(iterations), "dofs": int(model.nbdof())}, bool(converged)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--elements", type=int, default=40, help="along each side")
    arguments = parser.parse_args()
    getfem.util_trace_level(0)
    figures, converged = solve(arguments.elements)
    print(json.dumps(figures))
    if not converged:
        sys.exit("getfem_round_block.py: Newton's method did not converge")


if __name__ == "__main__":
    main()
