#!/usr/bin/env python3
"""The block of block.py in GetFEM: four-node elements, contact with friction by multipliers (its basic contact brick), a theta scheme or Newmark's.

    getfem_block.py COLUMNS STEP SCHEME     SCHEME: newmark, or theta:NUMBER

Prints a JSON object: processor seconds of the time steps alone, times, mean displacement of the bottom.
"""
import json
import math
import sys
import time

import getfem as gf
import numpy as np

YOUNG, POISSON, DENSITY, FRICTION, GRAVITY, AMPLITUDE, END = 1e10, 0.2, 1000.0, 0.3, 9.81, 4.905, 0.5
DAMPING = 0.5 / (math.pi * 1e3)  # s, of the stiffness: ratio 0.5 at 1000 Hz


def model_of(columns, scheme):
    """`scheme` None: at rest."""
    mesh = gf.Mesh("cartesian", np.linspace(0.0, 2.0, columns + 1), np.linspace(0.0, 1.0, columns // 2 + 1))
    mesh.set_region(1, mesh.outer_faces_with_direction([0.0, -1.0], 0.01))
    fem = gf.MeshFem(mesh, 2)
    fem.set_fem(gf.Fem("FEM_QK(2,1)"))
    integration = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(2,3)"))
    model = gf.Model("real")
    model.add_fem_variable("u", fem)
    plane_stress = YOUNG * POISSON / (1 - POISSON**2)
    for name, value in (("lambda", plane_stress), ("mu", YOUNG / 2 / (1 + POISSON)), ("rho", DENSITY), ("r", YOUNG), ("friction", FRICTION)):
        model.add_initialized_data(name, [value])
    model.add_isotropic_linearized_elasticity_brick(integration, "u", "lambda", "mu")
    if scheme == "newmark":
        model.add_Newmark_scheme("u", 0.25, 0.5)
    elif scheme:
        model.add_theta_method_for_second_order("u", float(scheme.split(":")[1]))
    if scheme:
        model.add_mass_brick(integration, "Dot2_u", "rho")
        model.add_initialized_data("b", [DAMPING])
        model.add_linear_term(integration, "b*(lambda*Trace(Grad_Dot_u)*Id(2) + mu*(Grad_Dot_u + Grad_Dot_u')):Grad_Test_u")
    model.add_initialized_data("load", [0.0, -DENSITY * GRAVITY])
    model.add_source_term_brick(integration, "u", "load")
    dofs = fem.basic_dof_on_region(1)
    along, up = dofs[::2], dofs[1::2]
    normal, tangential = gf.Spmat("empty", len(up), fem.nbdof()), gf.Spmat("empty", len(up), fem.nbdof())
    for row, (x, y) in enumerate(zip(along, up)):
        normal.add(row, int(y), -1.0)
        tangential.add(row, int(x), 1.0)
    model.add_variable("force", len(up))
    model.add_variable("shear", len(up))
    model.add_initialized_data("gap", np.zeros(len(up)))
    model.add_initialized_data("alpha", np.ones(len(up)))
    model.add_basic_contact_brick("u", "force", "shear", "r", normal, tangential, "friction", "gap", "alpha")
    return model, along, (mesh, fem, integration)  # which GetFEM needs as long as the model


def main():
    columns, step, scheme = int(sys.argv[1]), float(sys.argv[2]), sys.argv[3]
    gf.util_trace_level(0)
    rest, _, of_rest = model_of(columns, None)
    rest.solve("max_res", 1e-9)
    model, along, of_model = model_of(columns, scheme)  # noqa: F841
    model.set_time_step(step)
    model.set_variable("u", rest.variable("u"))
    for name in ("force", "shear"):
        model.set_variable(name, rest.variable(name))
    model.set_variable("Previous_u", rest.variable("u"))
    tolerance = 1e-9  # of the residual over the loads
    model.perform_init_time_derivative(step / 2.0)
    model.solve("max_res", tolerance)
    begin = time.process_time()
    moved, travelled = [], 0.0
    for k in range(round(END / step)):
        ground = AMPLITUDE * math.sin(2.0 * math.pi * (k + 1) * step / END)
        model.set_variable("load", [-DENSITY * ground, -DENSITY * GRAVITY])
        # The brick has friction against the displacement and not its change, whatever displacement it is told to begin from; so
        # each step begins with the bottom where it was, and the whole block is moved along by what the bottom did.
        before = model.variable("Previous_u")
        travelled += (shift := float(np.mean(before[along])))
        before[::2] -= shift
        model.set_variable("Previous_u", before)
        solved = model.solve("max_res", tolerance, "max_iter", 100)
        assert solved[1], f"the step at {k * step:.4g} s was not solved"
        moved.append(travelled + float(np.mean(model.variable("u")[along])))
        model.shift_variables_for_time_integration()
    seconds = time.process_time() - begin
    print(json.dumps({"seconds": seconds, "times": [(k + 1) * step for k in range(len(moved))], "moved": moved}))


if __name__ == "__main__":
    main()
