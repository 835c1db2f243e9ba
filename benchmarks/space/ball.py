"""A steel ball on an aluminium block (Hertz), a quarter of its lower half: the model of Scabo, and the same mesh and conditions as a deck of CalculiX.

The top of the ball is moved down, so that no body is loose without contact. Units: m, N, Pa.
"""
import math
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python" / "scabo"))
from plot import vtu  # noqa: E402

RADIUS, SIDE, DOWN = 0.05, 0.03, 70e-6
STEEL, ALUMINIUM, POISSON = 210e9, 70e9, 0.3
STIFFNESS = 1 / ((1 - POISSON**2) * (1 / STEEL + 1 / ALUMINIUM))  # E*


def hertz_pressure(quarter_of_force):
    """Largest pressure under a force, whatever the bodies do far away."""
    return (6 * 4 * quarter_of_force * STIFFNESS**2 / (math.pi**3 * RADIUS**2)) ** (1 / 3)


def model(fine, growth):
    near = f"[{{near: [0, 0, 0], size: {fine}, growth: {growth}}}, {{near: [1e-3, 1e-3, 0], size: {fine}, growth: {growth}}}]"
    return f"""scabo: 1
title: A ball pressed on a block
analysis: {{space: true}}
materials:
  steel: {{young: {STEEL}, poisson: {POISSON}}}
  aluminium: {{young: {ALUMINIUM}, poisson: {POISSON}}}
bodies:
  block: {{material: aluminium, shape: {{box: {{corner: [0, 0, {-SIDE}], size: [{SIDE}, {SIDE}, {SIDE}]}}}}, mesh: {{size: 0.01, refine: {near}}}}}
  ball: {{material: steel, shape: {{sphere: {{centre: [0, 0, {RADIUS}], radius: {RADIUS}, keep: [+x, +y, -z]}}}}, mesh: {{size: 0.02, refine: {near}}}}}
supports:
  - {{on: block.bottom, fix: z, name: ground}}
  - {{on: block.left, fix: x}}
  - {{on: block.front, fix: y}}
  - {{on: ball.cut_x, fix: x}}
  - {{on: ball.cut_y, fix: y}}
  - {{on: ball.cut_z, displacement: [null, null, {-DOWN}]}}
contacts: {{joint: {{between: [block.top, ball.surface], friction: 0}}}}
"""


def sides_on(cells, points, is_on):
    """(cell, side from 1) of all sides whose corners are all on a face; sides as Abaqus numbers them."""
    found = []
    for side, corners in enumerate(([0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]), start=1):
        found += [(cell, side) for cell in np.flatnonzero(is_on(points[cells[:, corners]]).all(axis=1))]
    return found


def deck(results, penalty):
    """Of the mesh of a results directory; `penalty` in Pa/m."""
    grid = vtu.read_grid(pathlib.Path(results) / "fields_0001.vtu", 3)
    points, cells = grid.points, grid.cells(vtu.QUADRATIC_TETRAHEDRON)
    ball_node = grid.point_data["body"] == 2
    of_ball = ball_node[cells[:, 0]]
    tiny = 1e-9
    lines = ["*HEADING", "Ball on a block; m, N, Pa", "*NODE, NSET=ALL"]
    lines += [f"{k + 1}, {x:.12g}, {y:.12g}, {z:.12g}" for k, (x, y, z) in enumerate(points.tolist())]
    for name, chosen in (("BLOCK", ~of_ball), ("BALL", of_ball)):
        lines.append(f"*ELEMENT, TYPE=C3D10, ELSET={name}")
        lines += [f"{k + 1}, " + ", ".join(str(node + 1) for node in cells[k]) for k in np.flatnonzero(chosen)]
    top = sides_on(cells, points, lambda x: np.abs(x[..., 2]) < tiny)
    surface = sides_on(cells, points, lambda x: np.abs(np.linalg.norm(x - [0, 0, RADIUS], axis=-1) - RADIUS) < tiny)
    for name, sides in (("TOP", [side for side in top if not of_ball[side[0]]]), ("ROUND", [side for side in surface if of_ball[side[0]]])):
        lines += [f"*SURFACE, NAME={name}, TYPE=ELEMENT"] + [f"{cell + 1}, S{side}" for cell, side in sides]
    used = np.isin(np.arange(len(points)), cells)
    x, y, z = points.T
    for name, chosen in (("XSYM", np.abs(x) < tiny), ("YSYM", np.abs(y) < tiny), ("GROUND", ~ball_node & (np.abs(z + SIDE) < tiny)), ("PUSHED", ball_node & (np.abs(z - RADIUS) < tiny))):
        lines += [f"*NSET, NSET={name}"] + [f"{node + 1}," for node in np.flatnonzero(chosen & used)]
    for name, young in (("STEEL", STEEL), ("ALUMINIUM", ALUMINIUM)):
        lines += [f"*MATERIAL, NAME={name}", "*ELASTIC", f"{young!r}, {POISSON}"]
    lines += ["*SOLID SECTION, ELSET=BLOCK, MATERIAL=ALUMINIUM", "*SOLID SECTION, ELSET=BALL, MATERIAL=STEEL",
              "*SURFACE INTERACTION, NAME=HARD", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{penalty:g}",
              "*CONTACT PAIR, INTERACTION=HARD, TYPE=SURFACE TO SURFACE", "ROUND, TOP",
              "*BOUNDARY", "XSYM, 1", "YSYM, 2", "GROUND, 3", "*STEP", "*STATIC", "1., 1.", "*BOUNDARY", f"PUSHED, 3, 3, {-DOWN!r}",
              "*NODE PRINT, NSET=GROUND, TOTALS=ONLY", "RF", "*CONTACT FILE", "CDIS, CSTR", "*END STEP"]
    return "\n".join(lines) + "\n"
