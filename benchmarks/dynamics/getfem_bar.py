#!/usr/bin/env python3
"""The bar of bar.py in GetFEM: four-node elements, contact by multipliers (its basic contact brick), a theta scheme or Newmark's.

    getfem_bar.py ELEMENTS STEP SCHEME     SCHEME: newmark, or theta:NUMBER

Prints a JSON object: processor seconds of the time steps alone, times and forces, kinetic energy at the end.
"""
import json
import sys
import time

import getfem as gf
import numpy as np

YOUNG, DENSITY, GAP, LENGTH, SPEED, END = 900.0, 1.0, 5.0, 10.0, 10.0, 1.5


def main():
    elements, step, scheme = int(sys.argv[1]), float(sys.argv[2]), sys.argv[3]
    gf.util_trace_level(0)
    mesh = gf.Mesh("cartesian", np.linspace(0.0, LENGTH, elements + 1), np.linspace(0.0, 1.0, max(1, round(elements / LENGTH)) + 1))
    mesh.set_region(1, mesh.outer_faces_with_direction([-1.0, 0.0], 0.01))
    fem = gf.MeshFem(mesh, 2)
    fem.set_fem(gf.Fem("FEM_QK(2,1)"))
    integration = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(2,3)"))
    model = gf.Model("real")
    model.add_fem_variable("u", fem)
    for name, value in (("lambda", 0.0), ("mu", YOUNG / 2), ("rho", DENSITY), ("r", YOUNG)):
        model.add_initialized_data(name, [value])
    model.add_isotropic_linearized_elasticity_brick(integration, "u", "lambda", "mu")
    if scheme == "newmark":
        model.add_Newmark_scheme("u", 0.25, 0.5)
    else:
        model.add_theta_method_for_second_order("u", float(scheme.split(":")[1]))
    model.add_mass_brick(integration, "Dot2_u", "rho")
    normal = fem.basic_dof_on_region(1)[::2]
    rows = gf.Spmat("empty", len(normal), fem.nbdof())
    for row, dof in enumerate(normal):
        rows.add(row, int(dof), -1.0)
    model.add_variable("force", len(normal))
    model.add_initialized_data("gap", GAP * np.ones(len(normal)))
    model.add_basic_contact_brick("u", "force", "r", rows, "gap")
    model.set_time_step(step)
    velocity = np.zeros(fem.nbdof())
    velocity[0::2] = -SPEED
    model.set_variable("Previous_u", np.zeros(fem.nbdof()))
    model.set_variable("Previous_Dot_u", velocity)
    tolerance = 1e-9 / step**2  # of the residual, whose largest terms are those of the mass
    model.perform_init_time_derivative(step / 2.0)
    model.solve("max_res", tolerance)
    begin = time.process_time()
    forces = []
    for _ in range(round(END / step)):
        solved = model.solve("max_res", tolerance, "max_iter", 100)
        assert solved[1], "a step was not solved"
        forces.append(-float(np.sum(model.variable("force"))))
        model.shift_variables_for_time_integration()
    seconds = time.process_time() - begin
    v = model.variable("Previous_Dot_u")
    kinetic = 0.5 * DENSITY * float(v @ gf.asm_mass_matrix(integration, fem).mult(v))
    times = [(k + 1) * step for k in range(len(forces))]
    print(json.dumps({"seconds": seconds, "times": times, "forces": forces, "kinetic": kinetic}))


if __name__ == "__main__":
    main()
