#!/usr/bin/env python3
"""Draws figures 5, 6 and 7 of Zhu et al. 2017 from runs of the double cantilever beam: one super-element for each
beam (SBFEM) against 8-node finite elements about as small as the paper's in ANSYS (FEM)."""
import argparse
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import meshio
import numpy as np
from matplotlib.tri import Triangulation

import runs

FEM_SIZE = 0.1053  # m: 57 x 15 = 855 elements for each beam; the paper has 1698 for both
MAGNIFICATION = 100
UPPER, LOWER = "#c1442e", "#2b5c8a"

plt.rcParams.update({"font.size": 9, "axes.titlesize": 9.5, "axes.labelsize": 9, "legend.fontsize": 8.5,
                     "axes.linewidth": 0.7, "figure.dpi": 130, "savefig.dpi": 130})


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scabo", default="scabo", help="the program (default: scabo on the PATH)")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=runs.HERE / "figures", metavar="DIR",
                        help="where the pictures go (default: %(default)s)")
    parser.add_argument("--results", type=pathlib.Path, default=pathlib.Path("double_cantilever.results"),
                        metavar="DIR", help="where the results of the runs go (default: %(default)s)")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)

    sbfem = {mu: runs.run(options.scabo, options.results / f"mu_{mu}", friction=mu) for mu in runs.FRICTIONS}
    fem = {mu: runs.run(options.scabo, options.results / f"fem_mu_{mu}", friction=mu, kind="fem", size=FEM_SIZE)
           for mu in runs.FRICTIONS}
    for mu in runs.FRICTIONS:
        forces = [f"{run.joint['normal_force'] / 1e3:.2f} / {abs(run.joint['tangential_force']) / 1e3:.2f} kN"
                  for run in (sbfem[mu], fem[mu])]
        print(f"mu = {mu}: SBFEM {forces[0]}, FEM {forces[1]}")

    for number, figure in {5: principal_stress(sbfem),
                           6: normal_displacements(sbfem, fem),
                           7: tangential_displacements(sbfem, fem)}.items():
        path = options.output / f"figure_{number}.png"
        figure.savefig(path)
        print(path)


def principal_stress(results):
    """Figure 5: first principal stress on the deformed beams."""
    beams = {mu: deformed_beams(run) for mu, run in results.items()}
    # At the built-in corners the stress grows without bound as elements get smaller: the scale leaves them out.
    highest = np.percentile(np.concatenate([stress for pair in beams.values() for _, stress in pair]), 99)
    levels = np.linspace(0, 0.2 * np.ceil(highest / 0.2), 17)

    figure, axes = plt.subplots(len(beams), 1, figsize=(6.2, 11.2), sharex=True)
    figure.subplots_adjust(left=0.09, right=0.98, top=0.99, bottom=0.115, hspace=0.06)
    for axis, (mu, pair) in zip(axes, beams.items()):
        for mesh, stress in pair:
            drawn = axis.tricontourf(mesh, stress, levels=levels, cmap="YlOrRd", extend="max")
            sides = outline(mesh.triangles).T
            axis.plot(mesh.x[sides], mesh.y[sides], color="black", linewidth=0.7)
        tip = pair[1][0]
        corner = np.argmax(tip.x + tip.y)
        axis.annotate("100 kN", (tip.x[corner], tip.y[corner]), (tip.x[corner], tip.y[corner] + 0.62),
                      ha="center", va="center", fontsize=8, arrowprops={"arrowstyle": "-|>", "color": "black"})
        axis.plot([0, 0], [-0.12, 3.12], color="black", linewidth=3, solid_capstyle="butt")
        axis.set_aspect("equal")
        axis.set_xlim(-0.15, 6.45)
        axis.set_ylim(-0.3, 3.7)
        axis.text(0, 3.32, f"$\\mu$ = {mu}", fontsize=9.5)
        axis.set_ylabel("y (m)")
        axis.set_yticks([0, 1.5, 3])
        for side in ("top", "right"):
            axis.spines[side].set_visible(False)
    axes[-1].set_xlabel(f"x (m), displacements magnified {MAGNIFICATION} times")
    figure.colorbar(drawn, cax=figure.add_axes([0.09, 0.05, 0.89, 0.012]), orientation="horizontal",
                    label="First principal stress (MPa), tension positive", ticks=levels[::4], format="%.1f")
    return figure


def deformed_beams(run):
    """Of each beam the deformed triangulation and the first principal stress at its points, in MPa."""
    mesh = meshio.read(sorted(run.directory.glob("fields_*.vtu"))[-1])
    points = (mesh.points + MAGNIFICATION * mesh.point_data["displacement"])[:, :2]
    values = np.column_stack([points, mesh.point_data["principal_1"].ravel() / 1e6])
    body_of_point = mesh.point_data["body"].ravel()
    beams = []
    for body in (1, 2):
        own = np.flatnonzero(body_of_point == body)
        of_beam = values[own]
        triangles = []
        for cells in mesh.cells:
            corners = cells.data[np.isin(cells.data[:, 0], own)] - own[0]
            if corners.shape[1] == 4:  # four triangles around the centre favour neither diagonal
                centres = len(of_beam) + np.arange(len(corners))
                of_beam = np.vstack([of_beam, of_beam[corners].mean(axis=1)])
                triangles += [np.column_stack([corners[:, k], corners[:, (k + 1) % 4], centres]) for k in range(4)]
            else:
                triangles.append(corners)
        beams.append((Triangulation(of_beam[:, 0], of_beam[:, 1], np.concatenate(triangles)), of_beam[:, 2]))
    return beams


def outline(triangles):
    """Sides that belong to one triangle only."""
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    sides, times = np.unique(sides, axis=0, return_counts=True)
    return sides[times == 1]


def normal_displacements(sbfem, fem):
    """Figure 6: normal displacement of the contact nodes; below it, much smaller, the opening between them."""
    figure, axes = plt.subplots(2, len(sbfem), figsize=(9.6, 5.2), sharex=True, sharey="row",
                                gridspec_kw={"height_ratios": [2, 1]})
    for column, mu in enumerate(sbfem):
        draw_displacements(axes[0, column], sbfem[mu], fem[mu], "normal")
        opening = axes[1, column]
        opening.plot(*curve(sbfem[mu].pairs(), "gap", 1e6), color="black", linewidth=1.3, label="opening, SBFEM")
        opening.plot(*curve(fem[mu].pairs()[1::6], "gap", 1e6), "D", color="black", markersize=3.5,
                     markerfacecolor="none", label="opening, FEM")
        opening.set_xlabel("x (m)")
    axes[0, 0].set_ylabel("Normal displacement (mm)")
    axes[1, 0].set_ylabel("Opening (\u00b5m)")
    figure.align_ylabels(axes[:, 0])
    return finish(figure, axes, sbfem, bottom=0.19)


def tangential_displacements(sbfem, fem):
    """Figure 7: tangential displacement of the contact nodes."""
    figure, axes = plt.subplots(1, len(sbfem), figsize=(9.6, 4.0), sharey=True)
    for axis, mu in zip(axes, sbfem):
        draw_displacements(axis, sbfem[mu], fem[mu], "tangential")
        axis.set_xlabel("x (m)")
    axes[0].set_ylabel("Tangential displacement (mm)")
    return finish(figure, axes[np.newaxis], sbfem, bottom=0.21)


def curve(pairs, column, factor):
    return [pair["x"] for pair in pairs], [factor * pair[column] for pair in pairs]


def draw_displacements(axis, sbfem, fem, direction):
    for side, beam, colour, marker in (("b", "upper beam", UPPER, "o"), ("a", "lower beam", LOWER, "s")):
        column = f"{direction}_displacement_{side}"
        # The finite elements have 3.5 times as many contact nodes; every sixth is drawn, of each beam another.
        some = fem.pairs()[1 if side == "a" else 4::6]
        axis.plot(*curve(sbfem.pairs(), column, 1e3), color=colour, linewidth=1.3, label=f"{beam}, SBFEM")
        axis.plot(*curve(some, column, 1e3), marker, color=colour, markersize=4, markerfacecolor="none",
                  label=f"{beam}, FEM")


def finish(figure, axes, sbfem, bottom):
    """Frames, the part in contact shaded, and one legend for all panels."""
    for column, mu in enumerate(sbfem):
        touching = [pair["x"] for pair in sbfem[mu].pairs() if pair["state"] != "open"]
        axes[0, column].set_title(f"$\\mu$ = {mu}", loc="left")
        for axis in axes[:, column]:
            axis.axvspan(min(touching), max(touching), color="0.9", linewidth=0, label="in contact")
            axis.set_xlim(0, 6.05)
            axis.grid(color="0.88", linewidth=0.6)
            axis.set_axisbelow(True)
    labelled = {}
    for axis in axes[:, 0]:
        labelled |= {label: handle for handle, label in zip(*axis.get_legend_handles_labels())}
    labelled["in contact"] = labelled.pop("in contact")
    columns = 5 if len(labelled) == 5 else 4
    figure.legend(labelled.values(), labelled.keys(), loc="lower center", ncol=columns, frameon=False)
    figure.subplots_adjust(left=0.075, right=0.985, top=0.93, bottom=bottom, wspace=0.08, hspace=0.1)
    return figure


if __name__ == "__main__":
    main()
