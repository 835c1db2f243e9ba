#!/usr/bin/env python3
"""Draws the first mode shapes of the cantilever, one super-element, with their frequencies beside those of 8-node finite
elements."""
import argparse
import json
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import meshio
import numpy as np
from matplotlib.tri import Triangulation

HERE = pathlib.Path(__file__).resolve().parent
MODEL = HERE / "model.yaml"
FEM_MESH = "{kind: fem, size: 0.0625}"
SHOWN = 8
LARGEST = 0.35  # m: how far the largest displacement is drawn

plt.rcParams.update({"font.size": 9, "axes.titlesize": 9.5, "figure.dpi": 130, "savefig.dpi": 130})


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scabo", default="scabo", help="the program (default: scabo on the PATH)")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=HERE / "figures", metavar="DIR",
                        help="where the pictures go (default: %(default)s)")
    parser.add_argument("--results", type=pathlib.Path, default=pathlib.Path("natural_frequencies.results"),
                        metavar="DIR", help="where the results of the runs go (default: %(default)s)")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)

    sbfem = run(options.scabo, options.results / "super_element")
    fem = run(options.scabo, options.results / "fem", f"bodies.beam.mesh={FEM_MESH}")
    print(" mode  one super-element  finite elements  difference")
    for number, (ours, theirs) in enumerate(zip(sbfem, fem), start=1):
        print(f"{number:5}  {ours:14.2f} Hz  {theirs:12.2f} Hz  {100 * (ours / theirs - 1):8.2f} %")
    path = options.output / "mode_shapes.png"
    mode_shapes(options.results / "super_element", sbfem, fem).savefig(path)
    print(path)


def run(scabo, directory, *settings):
    """Frequencies; ends the program when scabo fails, which has said why."""
    command = [str(scabo), "run", str(MODEL), "-o", str(directory), "--quiet"]
    for setting in settings:
        command += ["--set", setting]
    try:
        status = subprocess.run(command).returncode
    except OSError as error:
        sys.exit(f"cannot run {scabo}: {error.strerror} (name the program with --scabo)")
    if status != 0:
        sys.exit(f"scabo ended with exit status {status}: {' '.join(command)}")
    return json.loads((directory / "summary.json").read_text(encoding="utf-8"))["frequencies"]


def mode_shapes(directory, frequencies, fem):
    figure, axes = plt.subplots(SHOWN // 2, 2, figsize=(9.2, 6.6), sharex=True, sharey=True)
    figure.subplots_adjust(left=0.02, right=0.98, top=0.95, bottom=0.11, hspace=0.22, wspace=0.04)
    for number, axis in enumerate(axes.flat, start=1):
        mesh = meshio.read(directory / f"fields_{number:04d}.vtu")
        displacement = mesh.point_data["displacement"][:, :2]
        at_rest, moved = mesh.points[:, :2], mesh.points[:, :2] + LARGEST * displacement
        triangles = triangles_of(mesh)
        drawn = axis.tricontourf(Triangulation(*moved.T, triangles), np.linalg.norm(displacement, axis=1),
                                 levels=np.linspace(0, 1.0001, 21), cmap="viridis", extend="max")
        for side in outline(triangles):
            axis.plot(*at_rest[side].T, color="0.6", linewidth=0.7, linestyle="--")
            axis.plot(*moved[side].T, color="black", linewidth=0.8)
        axis.plot([0, 0], [-0.15, 1.15], color="black", linewidth=3, solid_capstyle="butt")
        axis.set_title(f"{number}: {frequencies[number - 1]:.1f} Hz  (finite elements {fem[number - 1]:.1f})", loc="left")
        axis.set_aspect("equal")
        axis.set_axis_off()
        axis.set_xlim(-0.1, 5.4)
        axis.set_ylim(-0.45, 1.45)
    figure.colorbar(drawn, cax=figure.add_axes([0.3, 0.075, 0.4, 0.014]), orientation="horizontal",
                    label="displacement, the largest of a boundary node is 1", ticks=[0, 0.5, 1])
    return figure


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


if __name__ == "__main__":
    main()
