"""What the examples' pictures have in common: running scabo, reading its fields, drawing them."""
import argparse
import json
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import meshio
import numpy as np
import running
from matplotlib.tri import Triangulation

plt.rcParams.update({"font.size": 9, "axes.titlesize": 9.5, "axes.labelsize": 9, "legend.fontsize": 8.5,
                     "axes.linewidth": 0.7, "figure.dpi": 130, "savefig.dpi": 130})


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


def draw(axis, mesh, values, levels, magnification=0.0, cmap="viridis"):
    """Filled contours of `values` at the points on the deformed body; where they are not a number, nothing."""
    triangles = triangles_of(mesh)
    moved = mesh.points[:, :2] + magnification * mesh.point_data["displacement"][:, :2]
    values = np.asarray(values, dtype=float).reshape(-1)
    shown = triangles[np.isfinite(values[triangles]).all(axis=1)]
    drawn = axis.tricontourf(Triangulation(*moved.T, shown), np.nan_to_num(values), levels=levels, cmap=cmap, extend="both")
    for side in outline(triangles):
        axis.plot(*moved[side].T, color="black", linewidth=0.6)
    axis.set_aspect("equal")
    return drawn
