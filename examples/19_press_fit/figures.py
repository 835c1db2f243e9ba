#!/usr/bin/env python3
"""The press fit: stress, torque against rotation, pressure against the temperature of the hub."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent


def main():
    options = pictures.options_of(__doc__, HERE, "press_fit.results")
    pictures.run(options.scabo, HERE / "model.yaml", options.results)
    history = pictures.table_of(options.results, "history.csv")
    area = 2 * np.pi * hand.SEAT * hand.LENGTH
    print(f"mean pressure {history['pressing'][0] / area / 1e6:.3f} MPa, torque {-history['torque'][8] / 1e3:.4f} kN m, open by "
          f"{1e6 * history['gap'][-1]:.3f} um at 90 K")
    path = options.output / "press_fit.png"
    picture(options, history, area).savefig(path)
    print(path)


def picture(options, history, area):
    figure = plt.figure(figsize=(10.6, 3.3), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1.15, 1, 1]})
    mesh = pictures.fields(options.results, 1)
    hoop = hoop_stress(mesh)
    drawn = pictures.draw(left, mesh, hoop / 1e6, pictures.signed_levels(180, bands=8), factor=1e3, unit="mm")
    pictures.colour_bar(figure, drawn, left, "hoop stress (MPa)", shrink=0.9)
    left.set(title="pressed on")
    numbers = hand.calculate()
    # The rim of the hub turns by u / r.
    middle.plot(1e3 * np.linspace(0, 120e-6, 9) / hand.RIM, -history["torque"][:9] / 1e3, "o-", ms=4, color=pictures.BLUE, label="run")
    middle.axhline(numbers["torque"] / 1e3, color=pictures.GREY, label="by hand")
    middle.set(xlabel="rotation of the hub (mrad)", ylabel="torque (kN m)", ylim=(0, 12), title="turned until it slips")
    right.plot(np.linspace(0, 90, 10), history["pressing"][8:] / area / 1e6, "o", ms=4, color=pictures.BLUE, label="run")
    right.plot([0, numbers["release"], 90], [numbers["pressure"] / 1e6, 0, 0], color=pictures.GREY, label="by hand", zorder=0)
    right.set(xlabel="temperature of the hub (K)", ylabel="pressure (MPa)", ylim=(-2, 75), title="heated until it is loose")
    for axis in (middle, right):
        axis.legend(loc="lower right" if axis is middle else "lower left")  # where no curve is
        axis.grid(True)
    return figure


def hoop_stress(mesh):
    x, y = mesh.points[:, 0], mesh.points[:, 1]
    xx, yy, xy = (mesh.point_data[f"stress_{name}"].astype(float) for name in ("xx", "yy", "xy"))
    return (xx * y**2 + yy * x**2 - 2 * xy * x * y) / (x**2 + y**2)


if __name__ == "__main__":
    main()
