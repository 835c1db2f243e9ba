#!/usr/bin/env python3
"""The sled test: stress in the sled where the push is largest, and the loop of force against travel with the hand calculation."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
AT_PEAK = 29  # row of history.csv


def main():
    options = pictures.options_of(__doc__, HERE, "sled_test.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    history = pictures.table_of(options.results, "history.csv")
    print(f"starts at {history['force'].max():.3f} N forward, {-history['force'].min():.3f} N backward; "
          f"{1e3 * history['heat'][-1]:.4f} mJ of heat")
    path = options.output / "sled_test.png"
    picture(options, summary, history).savefig(path)
    print(path)


def picture(options, summary, history):
    figure = plt.figure(figsize=(9.6, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.15, 1]})
    mesh = pictures.fields(options.results, AT_PEAK + 1)
    drawn = pictures.draw(left, mesh, pictures.values_of(mesh, "stress_xx", 1e-3), pictures.signed_levels(16, bands=4),
                          factor=1e3, unit="mm")
    pictures.colour_bar(figure, drawn, left, "stress along the track (kPa)", location="bottom", shrink=0.9)
    left.axhspan(-6, 0, facecolor="0.85", hatch="///", edgecolor="0.6", lw=0, zorder=0)  # the track, rigid
    left.annotate("", (80.5, 10), (96, 10), arrowprops={"arrowstyle": "-|>", "color": "black"})
    left.text(97, 10, "13 N", va="center", fontsize=8)
    left.set(xlim=(-5, 110), ylim=(-6, 28), title="pushed back, just before it slides")

    travel = [1.0 * increment["factors"].get("carriage", 0.0) for increment in summary["increments"]]
    calculated = np.array(hand.calculate()["path"])
    right.plot(1e3 * calculated[:, 0], calculated[:, 1], color=pictures.GREY, lw=2.5, label="by hand")
    right.plot(travel, history["force"], "o", ms=2.5, color=pictures.BLUE, label="run")
    right.set(xlabel="travel of the carriage (mm)", ylabel="force on the sled (N)", title="pulled, pushed and pulled again", ylim=(-15, 9))
    right.legend(loc="lower right")
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
