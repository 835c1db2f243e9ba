#!/usr/bin/env python3
"""The cracked plate: the stress of the wave around the crack, and the stress intensity factor against time with the closed form."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
FIELDS_AT = 36  # increment at 18 microseconds


def main():
    options = pictures.options_of(__doc__, HERE, "cracked_plate.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    history = pictures.table_of(options.results, "history.csv")
    print(f"K_I at 27 microseconds: {1e-6 * history['K_I'][53]:.3f} MPa m^0.5")
    path = options.output / "cracked_plate.png"
    picture(summary, history, pictures.fields(options.results, FIELDS_AT)).savefig(path)
    print(path)


def picture(summary, history, grid):
    figure = plt.figure(figsize=(9.6, 4.0), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(1, 1.1))
    stress = np.clip(pictures.values_of(grid, "stress_yy", 1e-6), -200, 200)
    drawn = pictures.draw(left, grid, stress, pictures.signed_levels(200, bands=20), magnification=20)
    pictures.colour_bar(figure, drawn, left, "stress across the crack, $\\sigma_{yy}$ (MPa)", shrink=0.9)
    left.set_title("at 18 µs")
    times = np.array([increment["time"] for increment in summary["increments"]])
    smooth = np.linspace(0, times[-1], 400)
    right.plot(1e6 * smooth, [1e-6 * hand.factor(t) for t in smooth], color=pictures.GREY, lw=2.5, label="by hand, until the other tip is heard")
    right.plot(1e6 * times, 1e-6 * history["K_I"], "o", ms=2.5, color=pictures.BLUE, label="run")
    right.axvline(1e6 * hand.OTHER_TIP, color="0.5", lw=1, ls="--")
    right.set(xlabel="time (µs)", ylabel="$K_I$ (MPa m$^{0.5}$)", title="the tip of the crack")
    right.legend(loc="upper left")
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
