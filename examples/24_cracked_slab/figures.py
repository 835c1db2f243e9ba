#!/usr/bin/env python3
"""The cracked slab: stress around the crack, deflection, and the stress intensity factor against the depth of the crack, both with
the hand calculation."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
MAGNIFICATION, NOON, WIDTH = 500, 2, 0.6
DEPTHS = (0.05, 0.1, 0.15)  # m


def main():
    options = pictures.options_of(__doc__, HERE, "cracked_slab.results")
    pictures.run(options.scabo, HERE / "model.yaml", options.results, "steps.1.increments=1", "bodies.slab.mesh.size=0.15")
    factors = []
    for depth in DEPTHS:
        summary = pictures.run(options.scabo, HERE / "model.yaml", options.results / f"depth_{depth}", f"parameters.crack={depth}",
                               "steps.1.increments=1", "output.fields=[]")
        factors.append(summary["increments"][-1]["cracks"]["slab.tip"]["K_I"])
        print(f"crack of {1e3 * depth:.0f} mm: K_I = {factors[-1] / 1e6:.4f} MPa m^0.5, by hand {hand.factor(depth)[1] / 1e6:.4f}")
    path = options.output / "cracked_slab.png"
    picture(options, factors).savefig(path)
    print(path)


def picture(options, factors):
    figure = plt.figure(figsize=(13.2, 3.9), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1.5, 1, 1]})
    mesh = pictures.fields(options.results, NOON)
    drawn = pictures.draw(left, mesh, pictures.values_of(mesh, "stress_xx", 1e-6), pictures.signed_levels(2, bands=8), MAGNIFICATION)
    pictures.colour_bar(figure, drawn, left, "stress along the slab (MPa)", location="bottom", shrink=0.9, extend="both")
    left.set(xlim=(-0.02, WIDTH), ylim=(-0.06, 0.28), title="right half of the slab near the crack")

    under = np.flatnonzero(np.abs(mesh.points[:, 1]) < 1e-9)
    under = under[np.argsort(mesh.points[under, 0])]
    middle.plot(mesh.points[under, 0], 1e3 * mesh.point_data["displacement"][under, 1], color=pictures.BLUE, label="run")
    x = np.linspace(0, hand.LENGTH / 2, 60)
    deflection, sunk = hand.curled(hand.CRACK)[0], hand.calculate()["sunk"]
    middle.plot(x, [1e3 * (deflection(at) + sunk) for at in x], "--", color=pictures.RED, label="by hand")
    middle.axhline(1e3 * sunk, color=pictures.GREY, lw=1, label="weight alone")
    middle.set(xlabel="distance from the crack (m)", ylabel="deflection (mm)", title="curling on the soil")

    depths = np.linspace(0.005, 0.15, 60)
    right.plot(1e3 * depths, [hand.factor(depth)[1] / 1e6 for depth in depths], "--", color=pictures.RED, label="by hand")
    right.plot([1e3 * depth for depth in DEPTHS], np.array(factors) / 1e6, "o", color=pictures.BLUE, label="run")
    right.set(xlabel="depth of the crack (mm)", ylabel="$K_I$ (MPa m$^{1/2}$)", ylim=(0, None), title="stress intensity factor")
    for axis in (middle, right):
        axis.legend()
        axis.grid(True)
    return figure


if __name__ == "__main__":
    main()
