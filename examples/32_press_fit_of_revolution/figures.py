#!/usr/bin/env python3
"""The press fit of revolution: hoop stress in the whole section, pressure along the seat, push against the way."""
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
    figure = plt.figure(figsize=(10.6, 3.6), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1.25, 1, 1]})
    mesh = pictures.scabo_plot.Results(options.results, mirrored=True).fields(1)
    drawn = pictures.draw(left, mesh, pictures.values_of(mesh, "stress_zz", 1e-6), pictures.signed_levels(120, bands=8), factor=1e3, unit="mm")
    pictures.colour_bar(figure, drawn, left, "hoop stress (MPa)", shrink=0.9)
    left.set(title="pressed on")
    for number, colour, name in ((1, pictures.BLUE, "pressed on"), (-1, pictures.RED, "sliding")):
        fit = pictures.pairs_of(options.results, number)["fit"]
        middle.plot(1e-6 * fit["pressure"], 1e3 * fit["y"], color=colour, label=name)
    numbers = hand.calculate()
    middle.axvline(1e-6 * numbers["pressure"], color=pictures.GREY, label="Lame", zorder=0)
    middle.set(xlabel="pressure (MPa)", ylabel="y (mm)", title="along the seat", xlim=(0, 90))
    history = pictures.table_of(options.results, "history.csv")
    right.plot(np.linspace(0, 60, 13), 1e-3 * history["push"][1:], "o-", ms=4, color=pictures.BLUE, label="run")
    right.axhline(1e-3 * numbers["push"], color=pictures.GREY, label="by hand", zorder=0)
    right.set(xlabel="way of the pushed end (µm)", ylabel="push, whole circumference (kN)", title="pushed out", ylim=(0, 90))
    for axis in (middle, right):
        axis.legend()
        axis.grid(True)
    path = options.output / "press_fit.png"
    figure.savefig(path)
    print(path)


if __name__ == "__main__":
    main()
