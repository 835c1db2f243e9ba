#!/usr/bin/python3
"""A block that only contact holds, in CalculiX, GetFEM and FEniCS: what each does with a push that friction can carry, and
with one that it cannot.

    held_by_contact.py calculix|getfem|fenics [--push 1e6] [--start 1]

A steel block, 2 x 1 m, rests on another one that is fixed at its bottom: E = 210 GPa, nu = 0.3, plane stress, thickness
1 m, friction 0.3. Its top carries 10 MPa downwards and PUSH (Pa) to the right. By equilibrium the joint carries 20 MN and
-2 m2 PUSH, and the block slides from 3e6 on. The contact of each program is that of its program for the beams beside
this one, with the same stiffness relative to Young's modulus.

GetFEM begins with the pressure of the load times START as its multiplier: with 0 its first equations are singular, as nothing
holds the block, and it does not converge.

Prints what the program found (MN on the block, upwards and to the right positive), or how it ended.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

YOUNG, POISSON, FRICTION = 210e9, 0.3, 0.3  # Pa, -, -
LENGTH, HEIGHT, SIZE = 2.0, 1.0, 0.125      # of a block and of an element, m
PRESSURE = 10e6                             # Pa
PENALTY = 1e3 * YOUNG                       # Pa per m
PATIENCE = 300                              # seconds


def simpson(nodes):
    """Lengths that belong to the nodes of quadratic sides from left to right."""
    lengths = np.full(nodes, SIZE / 3)
    lengths[1::2] = 2 * SIZE / 3
    lengths[[0, -1]] = SIZE / 6
    return lengths


def calculix(push, start):
    import calculix_beams as beams
    beams.LENGTH, beams.HEIGHT = LENGTH, HEIGHT
    beams.NORMAL_STIFFNESS, beams.STICK_SLOPE, beams.YOUNG = PENALTY, 0.1 * PENALTY, YOUNG
    lines = beams.deck(SIZE, FRICTION).splitlines()
    lower = beams.Beam("LOWER", 0.0, SIZE, 1, 1)
    upper = beams.Beam("UPPER", HEIGHT, SIZE, len(lower.nodes) + 1, len(lower.elements) + 1)
    top = [number for (_, j), number in sorted(upper.nodes.items()) if j == 2 * upper.ny]
    loads = [f"{node}, {axis}, {of * length:.10g}" for node, length in zip(top, simpson(len(top)))
             for axis, of in ((1, push), (2, -PRESSURE))]
    bottom = ["*NSET, NSET=BOTTOM"] + [f"{number}," for (_, j), number in lower.nodes.items() if j == 0]
    deck = "\n".join(lines).replace("*BOUNDARY\nFIXED_LOWER, 1, 2", "\n".join(bottom) + "\n*BOUNDARY\nBOTTOM, 1, 2")
    deck = deck.replace("*BOUNDARY\nFIXED_UPPER, 1, 2\n", "").replace("NSET=FIXED_LOWER, TOTALS", "NSET=BOTTOM, TOTALS")
    deck = re.sub(r"\*CLOAD\n.*\n", "*CLOAD\n" + "\n".join(loads) + "\n", deck)
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "block.inp").write_text(deck + "\n", encoding="ascii")
        try:
            run = subprocess.run(["ccx", "block"], cwd=folder, capture_output=True, text=True, timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            return f"no end after {PATIENCE} s"
        found = re.search(r"total force.*\n\s*\n\s*(\S+)\s+(\S+)", pathlib.Path(folder, "block.dat").read_text())
        errors = [line.strip() for line in (run.stdout + run.stderr).splitlines() if "ERROR" in line or "diverg" in line]
    if run.returncode or not found:
        return f"exit status {run.returncode}: {'; '.join(errors[-3:])}"
    return float(found[2]) / 1e6, float(found[1]) / 1e6  # reactions of the lower block are the forces on the upper one


def getfem(push, start):
    import getfem
    import getfem_beams as beams
    getfem.util_trace_level(0)
    beams.LENGTH, beams.HEIGHT = LENGTH, HEIGHT
    young, unit = YOUNG / 1e9, 1e-9  # GPa and GN, as for the beams
    model = getfem.Model("real")
    model.add_initialized_data("lambda", [young * POISSON / (1.0 - POISSON**2)])
    model.add_initialized_data("G", [young / (2.0 * (1.0 + POISSON))])
    meshes = {"lower": beams.beam_mesh(0.0, SIZE), "upper": beams.beam_mesh(HEIGHT, SIZE)}
    for block, mesh in meshes.items():
        gauss = getfem.MeshIm(mesh, getfem.Integ("IM_GAUSS_PARALLELEPIPED(2, 4)"))
        model.add_fem_variable(block, beams.vector_field(mesh, "FEM_Q2_INCOMPLETE(2)"))
        model.add_isotropic_linearized_elasticity_brick(gauss, block, "lambda", "G")
    for mesh, y, region in ((meshes["lower"], 0.0, 3), (meshes["upper"], 2 * HEIGHT, 4)):
        mesh.set_region(region, mesh.faces_from_pid(np.flatnonzero(abs(mesh.pts()[1] - y) < 1e-9)))
    model.add_Dirichlet_condition_with_simplification("lower", 3)
    model.add_initialized_data("top", [push * unit, -PRESSURE * unit])
    model.add_source_term_brick(gauss, "upper", "top", 4)
    model.add_filtered_fem_variable("traction", beams.vector_field(meshes["lower"], "FEM_QK(2, 1)"), beams.JOINT)
    model.add_initialized_data("r", [young])
    model.add_initialized_data("mu", [FRICTION])
    gauss = getfem.MeshIm(meshes["lower"], getfem.Integ("IM_GAUSS_PARALLELEPIPED(2, 8)"))
    model.add_integral_contact_between_nonmatching_meshes_brick(
        gauss, "lower", "upper", "traction", "r", "mu", beams.JOINT, beams.JOINT)
    traction = model.variable("traction")
    traction[1::2] = -start * PRESSURE * unit
    model.set_variable("traction", traction)
    iterations, converged = model.solve("max_res", 1e-10, "max_iter", 100, "lsearch", "simplest", "lsolver", "mumps")
    if not converged:
        return f"not converged after {iterations} iterations"
    on_lower = getfem.asm("generic", gauss, 0, "traction", beams.JOINT, model)
    return -on_lower[1] / unit / 1e6, -on_lower[0] / unit / 1e6


def fenics(push, start):
    import dolfin
    import fenics_beams as beams
    dolfin.set_log_level(dolfin.LogLevel.ERROR)
    beams.LENGTH, beams.HEIGHT, beams.YOUNG = LENGTH, HEIGHT, YOUNG
    beams.FIXED = ("near(x[1], 0.0)", "false")  # the upper block has no support

    def load(places, of_component, force):
        for component, of in zip(of_component, (push, -PRESSURE)):
            top = component[abs(places[component, 1] - 2 * HEIGHT) < 1e-9]
            top = top[np.argsort(places[top, 0])]
            force[top] = of * simpson(len(top))

    figures, converged = beams.solve(SIZE, FRICTION, PENALTY, load)
    if not converged:
        return "Newton's method, which is the user's own, did not converge"
    return figures["normal_force"] / 1e3, figures["tangential_force"] / 1e3


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", choices=["calculix", "getfem", "fenics"])
    parser.add_argument("--push", type=float, default=1e6, help="traction on the top, Pa")
    parser.add_argument("--start", type=float, default=1.0, help="GetFEM: part of the pressure with which it begins")
    arguments = parser.parse_args()
    found = {"calculix": calculix, "getfem": getfem, "fenics": fenics}[arguments.program](arguments.push, arguments.start)
    if isinstance(found, str):
        sys.exit(f"{arguments.program}: {found}")
    print(f"{arguments.program}: {found[0]:.6f} MN, {found[1]:.6f} MN")


if __name__ == "__main__":
    main()
