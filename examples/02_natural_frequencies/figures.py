#!/usr/bin/env python3
"""Draws the first mode shapes of the cantilever, one super-element, with their frequencies beside those of 8-node finite
elements."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
MODEL = HERE / "model.yaml"
FEM_MESH = "{kind: fem, size: 0.0625}"
SHOWN = 8
LARGEST = 0.35  # m: how far the largest displacement is drawn


def main():
    options = pictures.options_of(__doc__, HERE, "natural_frequencies.results")
    sbfem = run(options.scabo, options.results / "super_element")
    fem = run(options.scabo, options.results / "fem", f"bodies.beam.mesh={FEM_MESH}")
    print(" mode  one super-element  finite elements  difference")
    for number, (ours, theirs) in enumerate(zip(sbfem, fem), start=1):
        print(f"{number:5}  {ours:14.2f} Hz  {theirs:12.2f} Hz  {100 * (ours / theirs - 1):8.2f} %")
    path = options.output / "mode_shapes.png"
    mode_shapes(options.results / "super_element", sbfem, fem).savefig(path)
    print(path)


def run(scabo, directory, *settings):
    return pictures.run(scabo, MODEL, directory, *settings)["frequencies"]


def mode_shapes(directory, frequencies, fem):
    figure = plt.figure(figsize=(9.2, 7.4), layout="constrained")
    axes = figure.subplots(SHOWN // 2, 2, sharex=True, sharey=True)
    for number, axis in enumerate(axes.flat, start=1):
        mesh = pictures.fields(directory, number)
        size = np.linalg.norm(mesh.point_data["displacement"], axis=1)
        triangles = pictures.triangles_of(mesh)
        for side in pictures.outline(triangles):
            axis.plot(*mesh.points[side, :2].T, color="0.6", linewidth=0.7, linestyle="--")
        drawn = pictures.draw(axis, mesh, size, np.linspace(0, 1.0001, 21), magnification=LARGEST)
        axis.plot([0, 0], [-0.15, 1.15], color="black", linewidth=3, solid_capstyle="butt")
        axis.set_title(f"{number}: {frequencies[number - 1]:.1f} Hz  (finite elements {fem[number - 1]:.1f} Hz)")
        axis.set(xlim=(-0.1, 5.4), ylim=(-0.45, 1.45), xlabel="", ylabel="", yticks=[0, 1])
    for axis in axes[-1]:
        axis.set_xlabel("x (m)")
    for axis in axes[:, 0]:
        axis.set_ylabel("y (m)")
    figure.colorbar(drawn, ax=axes, location="bottom", shrink=0.5, aspect=40, ticks=[0, 0.5, 1],
                    label=f"displacement / largest one of a boundary node, which is drawn as {LARGEST:g} m")
    return figure


if __name__ == "__main__":
    main()
