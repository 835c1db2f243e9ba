"""What the examples' pictures have in common: running scabo, reading its fields, and one style.

Signed quantities have colours that diverge from white at zero (red: tension, blue: compression), and lines that are dashed below
zero; others go from light to dark. Axes name their quantity and unit; a map of a deformed body says how much it is magnified."""
import argparse
import json
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import meshio
import numpy as np
import running
from matplotlib.collections import LineCollection
from matplotlib.tri import Triangulation

plt.rcParams.update({"font.size": 9, "axes.titlesize": 9.5, "axes.titlelocation": "left", "axes.labelsize": 9,
                     "legend.fontsize": 8.5, "legend.frameon": False, "axes.linewidth": 0.7, "axes.grid": False,
                     "axes.axisbelow": True, "figure.constrained_layout.wspace": 0.05, "grid.color": "0.88", "grid.linewidth": 0.6, "lines.linewidth": 1.3,
                     "figure.dpi": 130, "savefig.dpi": 130})

BLUE, RED, GREEN, GREY = "#2b5c8a", "#c1442e", "#3f9c6b", "0.55"
SIGNED, MAGNITUDE = "RdBu_r", "YlOrRd"


def options_of(description, example, results):
    """--scabo, -o and --results of a figures.py."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--scabo", default="scabo", help="the program (default: scabo on the PATH)")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=example / "figures", metavar="DIR",
                        help="where the pictures go (default: %(default)s)")
    parser.add_argument("--results", type=pathlib.Path, default=pathlib.Path(results), metavar="DIR",
                        help="where the results of the runs go (default: %(default)s)")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    return options


def run(scabo, model, directory, *settings):
    """The summary."""
    running.run(scabo, model, directory, settings)
    return json.loads((directory / "summary.json").read_text(encoding="utf-8"))


def fields(directory, number=1):
    return meshio.read(directory / f"fields_{number:04d}.vtu")


def values_of(mesh, name, factor=1.0):
    """A scalar at the points."""
    return factor * np.asarray(mesh.point_data[name], dtype=float).reshape(-1)


def triangles_of(mesh):
    """Quadrilaterals are halved."""
    triangles = []
    for cells in mesh.cells:
        triangles.append(cells.data[:, :3])
        if cells.data.shape[1] == 4:
            triangles.append(cells.data[:, [0, 2, 3]])
    return np.concatenate(triangles)


def outline(triangles):
    """Sides that belong to one triangle only."""
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    sides, times = np.unique(sides, axis=0, return_counts=True)
    return sides[times == 1]


def cells_of(mesh):
    """The triangles of every super-element. A file has one block of quadrilaterals and one of triangles for each."""
    cells, before = [], "triangle"
    for block in mesh.cells:
        triangles = [block.data[:, :3]] + ([block.data[:, [0, 2, 3]]] if block.data.shape[1] == 4 else [])
        if block.type == "triangle" and before == "quad":
            cells[-1] += triangles
        else:
            cells.append(triangles)
        before = block.type
    return [np.concatenate(triangles) for triangles in cells]


def draw_cells(axis, mesh, magnification=0.0, **style):
    """The sides of all super-elements."""
    moved = moved_points(mesh, magnification)
    sides = [moved[outline(triangles)] for triangles in cells_of(mesh)]
    axis.add_collection(LineCollection(np.concatenate(sides), **{"colors": "black", "linewidths": 0.35, "alpha": 0.6, **style}))


def moved_points(mesh, magnification):
    return mesh.points[:, :2] + magnification * mesh.point_data["displacement"][:, :2]


def signed_levels(largest, bands=10):
    """From -largest to largest; the band in the middle, around zero, is white."""
    return np.linspace(-largest, largest, 2 * bands + 2)


def draw(axis, mesh, values, levels, magnification=0.0):
    """Filled contours of `values` at the points on the deformed body; where they are not a number, nothing. Levels on both sides of
    zero: a signed quantity."""
    signed = levels[0] < 0 < levels[-1]
    triangles = triangles_of(mesh)
    moved = moved_points(mesh, magnification)
    values = np.asarray(values, dtype=float).reshape(-1)
    shown = Triangulation(*moved.T, triangles[np.isfinite(values[triangles]).all(axis=1)])
    drawn = axis.tricontourf(shown, np.nan_to_num(values), levels=levels, cmap=SIGNED if signed else MAGNITUDE,
                             extend="both" if signed else "max")
    if signed:  # which side of zero a dark colour is on, told without colour too
        axis.tricontour(shown, np.nan_to_num(values), levels=levels[1:-1:2], colors="black", linewidths=0.3, alpha=0.7)
    axis.add_collection(LineCollection(moved[outline(triangles)], colors="black", linewidths=0.6, capstyle="projecting"))
    label_map(axis, magnification)
    return drawn


def label_map(axis, magnification=0.0, unit="m"):
    """Axes of a map: coordinates with their unit, and by how much displacements are magnified."""
    moved = f"; displacements × {magnification:g}" if magnification else ""
    axis.set(xlabel=f"x ({unit}){moved}", ylabel=f"y ({unit})", aspect="equal")
    axis.use_sticky_edges = False
    axis.margins(0.03)
    for side in ("top", "right"):
        axis.spines[side].set_visible(False)


def colour_bar(figure, drawn, axis, label, count=5, **options):
    """With `count` ticks, the first and the last level among them."""
    ticks = np.linspace(drawn.levels[0], drawn.levels[-1], count)
    return figure.colorbar(drawn, ax=axis, label=label, ticks=ticks, **options)
