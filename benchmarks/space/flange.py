"""A bolted flange on an elastic block: the model of Scabo, and the same mesh and conditions as a deck of CalculiX.

A half of the flange beside one bolt, whose lower end is held in the plane of the joint. The bolt is tightened, then the edge of the flange is pulled, so
that the flange pries about its other edge. Without friction. Units: mm, N, MPa.
"""
import math
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python" / "scabo"))
from plot import vtu  # noqa: E402

YOUNG, POISSON = 210e3, 0.3
LENGTH, WIDTH, THICK, DEEP = 70.0, 50.0, 18.0, 20.0
BOLT, HEAD, HEIGHT, HOLE, AT = 8.0, 13.0, 10.0, 9.0, (40.0, 25.0)
PRELOAD, PULL, CUT = 40e3, 12e3, 9.0


def model(fine):
    near = f"[{{near: [{AT[0]}, {AT[1]}, 0], size: {fine}, growth: 0.3}}]"
    return f"""scabo: 1
title: A bolted flange on a block
analysis: {{space: true}}
materials: {{steel: {{young: {YOUNG}, poisson: {POISSON}}}}}
bodies:
  block: {{material: steel, shape: {{box: {{corner: [0, 0, {-DEEP}], size: [{LENGTH}, {WIDTH}, {DEEP}]}}}}, mesh: {{size: {1.5 * fine}}}}}
  flange:
    material: steel
    shape:
      extrude:
        profile: {{rectangle: {{corner: [0, 0], size: [{LENGTH}, {WIDTH}]}}}}
        holes: {{hole: {{circle: {{centre: [{AT[0]}, {AT[1]}], radius: {HOLE}}}}}}}
        plane: xy
        from: 0
        to: {THICK}
    mesh: {{size: {1.5 * fine}, refine: {near}}}
  bolt:
    material: steel
    shape: {{cylinder: {{from: [{AT[0]}, {AT[1]}, 0], to: [{AT[0]}, {AT[1]}, {THICK}], radius: {BOLT}}}}}
    mesh: {{size: {fine}}}
    preload: {{cut: {{point: [{AT[0]}, {AT[1]}, {CUT}], normal: [0, 0, 1]}}, force: {PRELOAD}, tightened: tighten}}
  head: {{material: steel, shape: {{cylinder: {{from: [{AT[0]}, {AT[1]}, {THICK}], to: [{AT[0]}, {AT[1]}, {THICK + HEIGHT}], radius: {HEAD}}}}}, mesh: {{size: {fine}}}}}
supports:
  - {{on: block.bottom, fix: [x, y, z], name: ground}}
  - {{on: flange.left, fix: x}}
  - {{on: flange.bottom, fix: y}}
  - {{on: flange.top, fix: y}}
  - {{on: bolt.bottom, fix: [x, y, z], name: anchor}}
loads:
  pull: {{on: flange.left, force: [0, 0, {PULL}]}}
contacts:
  joint: {{between: [block.top, flange.start], friction: 0}}
  washer: {{between: [flange.end, head.bottom], friction: 0}}
ties: {{neck: {{between: [bolt.top, head.bottom]}}}}
steps:
  - {{name: tighten, loads: {{pull: 0}}}}
  - {{name: load, loads: {{pull: 1}}}}
"""


SIDES = ([0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0])  # corners, as Abaqus numbers them
MIDDLES = ([4, 5, 6], [7, 8, 4], [8, 9, 5], [9, 7, 6])  # of the same sides


def sides_on(cells, points, is_on):
    """(cell, side from 1) of all sides whose corners are all on a face."""
    found = []
    for side, corners in enumerate(SIDES, start=1):
        found += [(cell, side) for cell in np.flatnonzero(is_on(points[cells[:, corners]]).all(axis=1))]
    return found


def opened(cells, points, of_bolt):
    """Cells whose nodes on the cut are others above it than below, the points with these, and the pairs (above, below). *PRE-TENSION SECTION of
    CalculiX 2.20 opens elements with a side on the section only, and tetrahedra also have nodes and edges there: equations do what it does for hexahedra."""
    above = of_bolt & (points[cells[:, :4], 2].mean(axis=1) > CUT)
    both = np.intersect1d(cells[above], cells[of_bolt & ~above])
    number = {node: len(points) + k for k, node in enumerate(both)}
    cells = cells.copy()
    cells[above] = [[number.get(node, node) for node in cell] for cell in cells[above]]
    return cells, np.vstack([points, points[both]]), [(number[node], node) for node in both]


def pulls(cells, points):
    """Nodal forces of the pull, a constant traction: thirds of those of every side in the middles of its edges."""
    forces = {}
    for cell, side in sides_on(cells, points, lambda x: np.abs(x[..., 0]) < 1e-9):
        a, b, c = points[cells[cell, SIDES[side - 1]]]
        area = 0.5 * np.linalg.norm(np.cross(b - a, c - a))
        for node in cells[cell, MIDDLES[side - 1]]:
            forces[node] = forces.get(node, 0.0) + PULL / (WIDTH * THICK) * area / 3
    return forces


def deck(results, penalty):
    """Of the mesh of a results directory; `penalty` in N/mm3."""
    grid = vtu.read_grid(pathlib.Path(results) / "fields_0001.vtu", 3)
    points, cells = grid.points, grid.cells(vtu.QUADRATIC_TETRAHEDRON)
    body = grid.point_data["body"].astype(int)
    names = ("BLOCK", "FLANGE", "BOLT", "HEAD")
    of = {name: body[cells[:, 0]] == k for k, name in enumerate(names, start=1)}
    cells, points, pairs = opened(cells, points, of["BOLT"])
    body = np.concatenate([body, np.full(len(pairs), 3)])
    used = np.isin(np.arange(len(points)), cells)
    reference = len(points) + 1
    lines = ["*HEADING", "Bolted flange; mm, N, MPa", "*NODE, NSET=ALL"]
    lines += [f"{k + 1}, {x:.12g}, {y:.12g}, {z:.12g}" for k, (x, y, z) in enumerate(points.tolist()) if used[k]]
    lines += ["*NODE, NSET=TENSION", f"{reference}, 0., 0., 0."]
    for name in names:
        lines.append(f"*ELEMENT, TYPE=C3D10, ELSET={name}")
        lines += [f"{k + 1}, " + ", ".join(str(node + 1) for node in cells[k]) for k in np.flatnonzero(of[name])]

    def surface(name, body, is_on):
        lines.extend([f"*SURFACE, NAME={name}, TYPE=ELEMENT"] + [f"{cell + 1}, S{side}" for cell, side in sides_on(cells, points, is_on) if of[body][cell]])

    def at(axis, value):
        return lambda x: np.abs(x[..., axis] - value) < 1e-9
    surface("SEAT", "BLOCK", at(2, 0.0))
    surface("UNDER", "FLANGE", at(2, 0.0))
    surface("OVER", "FLANGE", at(2, THICK))
    surface("NECK", "BOLT", at(2, THICK))
    surface("BRIM", "HEAD", at(2, THICK))
    for name, number, axis, value in (("GROUND", 1, 2, -DEEP), ("ANCHOR", 3, 2, 0.0), ("LEFT", 2, 0, 0.0), ("FRONT", 2, 1, 0.0), ("BACK", 2, 1, WIDTH)):
        lines += [f"*NSET, NSET={name}"] + [f"{node + 1}," for node in np.flatnonzero(used & (body == number) & at(axis, value)(points))]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{YOUNG!r}, {POISSON}"] + [f"*SOLID SECTION, ELSET={name}, MATERIAL=STEEL" for name in names]
    lines += ["*SURFACE INTERACTION, NAME=HARD", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{penalty:g}",
              "*CONTACT PAIR, INTERACTION=HARD, TYPE=SURFACE TO SURFACE", "UNDER, SEAT",
              "*CONTACT PAIR, INTERACTION=HARD, TYPE=SURFACE TO SURFACE", "BRIM, OVER",
              "*TIE, NAME=NECK, POSITION TOLERANCE=0.1", "NECK, BRIM"]
    for high, low in pairs:
        lines += [line for k in (1, 2) for line in ("*EQUATION", "2", f"{high + 1}, {k}, 1., {low + 1}, {k}, -1.")]
        lines += ["*EQUATION", "3", f"{high + 1}, 3, 1., {low + 1}, 3, -1., {reference}, 1, 1."]
    lines += ["*BOUNDARY", "GROUND, 1, 3", "ANCHOR, 1, 3", "LEFT, 1", "FRONT, 2", "BACK, 2",
              "*STEP", "*STATIC", "1., 1.", "*CLOAD", f"{reference}, 1, {PRELOAD!r}", "*END STEP",
              "*STEP", "*STATIC", "1., 1.", "*BOUNDARY, FIXED", f"{reference}, 1, 1", "*CLOAD"]
    lines += [f"{node + 1}, 3, {force!r}" for node, force in pulls(cells[of["FLANGE"]], points).items()]
    lines += ["*NODE PRINT, NSET=ANCHOR, TOTALS=ONLY", "RF", "*CONTACT FILE", "CDIS, CSTR", "*END STEP"]
    return "\n".join(lines) + "\n"


def places(count=24, radius=15.0):
    """Points of the joint around the hole, where its pressure is compared."""
    angles = [2 * math.pi * k / count for k in range(count)]
    return np.array([[AT[0] + radius * math.cos(a), AT[1] + radius * math.sin(a)] for a in angles])
