#!/usr/bin/env python3
"""The flange: stress in both halves of its section, pressure of the gasket before and under pressure."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import plt

HERE = pathlib.Path(__file__).resolve().parent


def main():
    options = pictures.options_of(__doc__, HERE, "flange.results")
    pictures.run(options.scabo, HERE / "model.yaml", options.results)
    figure = plt.figure(figsize=(10.6, 3.3), layout="constrained")
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.7, 1]})
    results = pictures.scabo_plot.Results(options.results, mirrored=True)
    mesh = results.fields(results.number(-1))
    drawn = pictures.draw(left, mesh, pictures.values_of(mesh, "stress_zz", 1e-6), pictures.signed_levels(40, bands=8), magnification=40, factor=1e3, unit="mm")
    left.set(title="under pressure")
    pictures.colour_bar(figure, drawn, left, "hoop stress (MPa)", shrink=0.9)
    for number, colour, name in ((2, pictures.BLUE, "tightened"), (-1, pictures.RED, "under pressure")):
        seal = pictures.pairs_of(options.results, number)["seal"]
        right.plot(1e3 * seal["x"], 1e-6 * seal["pressure"], color=colour, label=name)
    right.axhline(3, color=pictures.GREY, ls="--", label="fluid", zorder=0)
    right.set(xlabel="radius (mm)", ylabel="pressure of the gasket (MPa)", title="gasket", ylim=(0, None))
    right.legend()
    right.grid(True)
    path = options.output / "flange.png"
    figure.savefig(path)
    print(path)


if __name__ == "__main__":
    main()
