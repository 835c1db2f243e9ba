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
    figure, axes = plt.subplots(1, 4, figsize=(12.4, 3.5), gridspec_kw={"width_ratios": [1, 1, 1, 1.15]})
    figure.subplots_adjust(left=0.01, right=0.985, top=0.88, bottom=0.15, wspace=0.25)
    for number, (axis, name) in enumerate(zip(axes, NAMES), start=1):
        mesh = pictures.fields(options.results / "panel", number)
        top = TOPS[number - 1]
        drawn = pictures.draw(axis, mesh, mesh.point_data["principal_1"] / 1e6, np.linspace(0, top, 21), cmap="magma_r",
                              magnification=MAGNIFICATIONS[number - 1])
        figure.colorbar(drawn, ax=axis, shrink=0.75, ticks=[0, top / 2, top])
        axis.set_title(f"{name}\nprincipal tension, MPa")
        axis.set_axis_off()
    for number, name in enumerate(NAMES, start=1):
        mesh = pictures.fields(options.results / "panel", number)
        from_corner = mesh.points[:, :2] - 1.0
        diagonal = (np.abs(from_corner[:, 0] + from_corner[:, 1]) < 1e-9) & (from_corner[:, 0] < -1e-9)
        r = np.linalg.norm(from_corner[diagonal], axis=1)
        order = np.argsort(r)
        axes[3].loglog(r[order], mesh.point_data["principal_1"][diagonal].reshape(-1)[order] / 1e6, "o-", markersize=3, linewidth=0.9,
                       label=name)
    exponent = summary["increments"][0]["cracks"]["panel.corner"]["exponents"][0][0]
    r = np.array([0.01, 0.1])
    axes[3].loglog(r, 0.3 * r ** (exponent - 1), "k--", linewidth=0.8, label=f"slope {exponent - 1:.3f}")
    axes[3].set_xlabel("distance from the corner, m")
    axes[3].set_title("principal tension, MPa, on the diagonal")
    axes[3].legend(frameon=False)
    axes[3].grid(linewidth=0.3, which="both")
    return figure


if __name__ == "__main__":
    main()
