#!/usr/bin/env python3
"""Draws figures 5, 6 and 7 of Zhu et al. 2017 from runs of the double cantilever beam: one super-element for each
beam (SBFEM) against 8-node finite elements about as small as the paper's in ANSYS (FEM)."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
import runs
from pictures import np, plt

FEM_SIZE = 0.1053  # m: 57 x 15 = 855 elements for each beam; the paper has 1698 for both
MAGNIFICATION = 100
UPPER, LOWER = pictures.RED, pictures.BLUE


def main():
    options = pictures.options_of(__doc__, runs.HERE, "double_cantilever.results")
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
    """Figure 5: first principal stress on the deformed beams, what friction changes of it, and the slip between the beams."""
    frictions = list(results)
    meshes = {mu: pictures.fields(run.directory) for mu, run in results.items()}
    stress = {mu: pictures.values_of(mesh, "principal_1", 1e-6) for mu, mesh in meshes.items()}
    figure = plt.figure(figsize=(5.9, 10.6))
    place = lambda left, bottom, width, height: figure.add_axes([left / 5.9, bottom / 10.6, width / 5.9, height / 10.6])
    axes = [place(0.6, bottom, 4.2, 2.5) for bottom in (7.85, 4.98, 2.11)] + [place(0.6, 0.45, 4.2, 1.0)]
    bars = [place(4.95, bottom, 0.12, 2.1) for bottom in (7.95, 5.08, 2.21)]
    # At the built-in corners the stress grows without bound as elements get smaller: the scale leaves them out.
    plain = frictions[0]
    drawn = draw_beams(axes[0], meshes[plain], stress[plain], pictures.signed_levels(0.8))
    pictures.colour_bar(figure, drawn, axes[0], "stress (MPa)", cax=bars[0])
    axes[0].set_title(f"first principal stress, $\\mu$ = {plain:g}")
    for axis, bar, mu in zip(axes[1:], bars[1:], frictions[1:]):
        drawn = draw_beams(axis, meshes[mu], stress[mu] - stress[plain], pictures.signed_levels(0.08))
        pictures.colour_bar(figure, drawn, axis, "change of stress (MPa)", cax=bar)
        axis.set_title(f"its change by friction, from $\\mu$ = {plain:g} to $\\mu$ = {mu:g}")
    for axis in axes[:2]:
        axis.set_xlabel("")
        axis.tick_params(labelbottom=False)
    for (mu, run), style, colour in zip(results.items(), ("-", "--", ":"), (pictures.GREY, pictures.BLUE, pictures.RED)):
        axes[3].plot(*curve(run.pairs(), "slip", 1e3), style, color=colour, label=f"$\\mu$ = {mu:g}")
    axes[3].set(xlabel="x (m)", ylabel="slip (mm)", xlim=(-0.15, 6.45), title="slip of the upper beam on the lower one")
    axes[3].grid(True)
    axes[3].legend()
    return figure


def draw_beams(axis, mesh, values, levels):
    """Both beams with the wall and the load."""
    drawn = pictures.draw(axis, mesh, values, levels, MAGNIFICATION)
    moved = pictures.moved_points(mesh, MAGNIFICATION)
    tip = moved[np.argmax(mesh.points[:, 0] + mesh.points[:, 1])]
    axis.annotate("100 kN", tip, tip + [0.0, 0.62], ha="center", va="center", fontsize=8,
                  arrowprops={"arrowstyle": "-|>", "color": "black"})
    axis.plot([0, 0], [-0.12, 3.12], color="black", linewidth=3, solid_capstyle="butt")
    axis.set(xlim=(-0.15, 6.45), ylim=(-0.3, 3.7), yticks=[0, 1.5, 3])
    return drawn


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
    axes[0, 0].set_ylabel("normal displacement (mm)")
    axes[1, 0].set_ylabel("opening (\u00b5m)")
    figure.align_ylabels(axes[:, 0])
    return finish(figure, axes, sbfem, bottom=0.19)


def tangential_displacements(sbfem, fem):
    """Figure 7: tangential displacement of the contact nodes."""
    figure, axes = plt.subplots(1, len(sbfem), figsize=(9.6, 4.0), sharey=True)
    for axis, mu in zip(axes, sbfem):
        draw_displacements(axis, sbfem[mu], fem[mu], "tangential")
        axis.set_xlabel("x (m)")
    axes[0].set_ylabel("tangential displacement (mm)")
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
        axes[0, column].set_title(f"$\\mu$ = {mu:g}")
        for axis in axes[:, column]:
            axis.axvspan(min(touching), max(touching), color="0.9", linewidth=0, label="in contact")
            axis.set_xlim(0, 6.05)
            axis.grid(True)
    labelled = {}
    for axis in axes[:, 0]:
        labelled |= {label: handle for handle, label in zip(*axis.get_legend_handles_labels())}
    labelled["in contact"] = labelled.pop("in contact")
    columns = 5 if len(labelled) == 5 else 4
    figure.legend(labelled.values(), labelled.keys(), loc="lower center", ncol=columns)
    figure.subplots_adjust(left=0.075, right=0.985, top=0.93, bottom=bottom, wspace=0.08, hspace=0.1)
    return figure


if __name__ == "__main__":
    main()
