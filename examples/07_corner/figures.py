#!/usr/bin/env python3
"""The L-shaped panel under weight, water and cold: stress in the panel, and its growth towards the corner."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
NAMES = ["weight", "weight and water", "weight and cold"]
TOPS = [0.1, 2.0, 2.0]           # MPa
MAGNIFICATIONS = [2e4, 1e3, 1e3]


def main():
    options = pictures.options_of(__doc__, HERE, "corner.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results / "panel")
    for name, increment in zip(NAMES, summary["increments"]):
        corner = increment["cracks"]["panel.corner"]
        exponents = ", ".join(f"{real:.6f}" for real, _ in corner["exponents"])
        print(f"{name:20} singular exponents {exponents}; K_tt = {corner['K_tt']:.5g}, K_rt = {corner['K_rt']:.5g} "
              f"at {corner['reference_length']:.3g} m")
    path = options.output / "panel.png"
    picture(options, summary).savefig(path)
    print(path)


def picture(options, summary):
    figure = plt.figure(figsize=(9.4, 8.2), layout="constrained")
    axes = figure.subplots(2, 2).flat
    for number, (axis, name) in enumerate(zip(axes, NAMES), start=1):
        mesh = pictures.fields(options.results / "panel", number)
        drawn = pictures.draw(axis, mesh, pictures.values_of(mesh, "principal_1", 1e-6), pictures.signed_levels(TOPS[number - 1]),
                              magnification=MAGNIFICATIONS[number - 1])
        pictures.colour_bar(figure, drawn, axis, "first principal stress (MPa)", shrink=0.85)
        axis.set_title(name)
    for number, (name, style, colour) in enumerate(zip(NAMES, ("s-", "o-", "^-"), (pictures.GREY, pictures.BLUE, pictures.RED)), start=1):
        mesh = pictures.fields(options.results / "panel", number)
        from_corner = mesh.points[:, :2] - 1.0
        diagonal = (np.abs(from_corner[:, 0] + from_corner[:, 1]) < 1e-9) & (from_corner[:, 0] < -1e-9)
        r = np.linalg.norm(from_corner[diagonal], axis=1)
        order = np.argsort(r)
        stress = pictures.values_of(mesh, "principal_1", 1e-6)[diagonal][order]
        tension = np.where(stress > 0, stress, np.nan)  # a logarithm has no room for compression
        axes[3].loglog(r[order], tension, style, color=colour, markersize=3, linewidth=0.9, label=name)
    exponent = summary["increments"][0]["cracks"]["panel.corner"]["exponents"][0][0]
    r = np.array([0.01, 0.1])
    axes[3].loglog(r, 0.3 * r ** (exponent - 1), "k--", linewidth=0.8, label=f"slope {exponent - 1:.3f}")
    axes[3].set(xlabel="distance from the corner (m)", ylabel="first principal stress (MPa)", ylim=(1e-3, 10),
                title="on the diagonal, where it is tension")
    axes[3].legend(loc="lower left")
    axes[3].grid(True, which="major")
    return figure


if __name__ == "__main__":
    main()
