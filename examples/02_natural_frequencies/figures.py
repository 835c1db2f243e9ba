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
    figure, axes = plt.subplots(SHOWN // 2, 2, figsize=(9.2, 6.6), sharex=True, sharey=True)
    figure.subplots_adjust(left=0.02, right=0.98, top=0.95, bottom=0.11, hspace=0.22, wspace=0.04)
    for number, axis in enumerate(axes.flat, start=1):
        mesh = pictures.fields(directory, number)
        displacement = mesh.point_data["displacement"][:, :2]
        at_rest, moved = mesh.points[:, :2], mesh.points[:, :2] + LARGEST * displacement
        triangles = pictures.triangles_of(mesh)
        drawn = axis.tricontourf(pictures.Triangulation(*moved.T, triangles), np.linalg.norm(displacement, axis=1),
                                 levels=np.linspace(0, 1.0001, 21), cmap="viridis", extend="max")
        for side in pictures.outline(triangles):
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


if __name__ == "__main__":
    main()
