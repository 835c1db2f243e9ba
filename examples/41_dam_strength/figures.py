#!/usr/bin/env python3
"""The dam: vertical stress at the last equilibrium with reduced friction."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import plt

HERE = pathlib.Path(__file__).resolve().parent


def main():
    options = pictures.options_of(__doc__, HERE, "dam_strength.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    limit, by_hand = summary["limit"], hand.calculate()["factor"]
    print(f"limit {limit['solved']:.4f} to {limit['beyond']:.4f}, by hand {by_hand:.4f}")
    path = options.output / "dam_strength.png"
    picture(options).savefig(path)
    print(path)


def picture(options):
    figure, axis = plt.subplots(figsize=(7.2, 4.4), layout="constrained")
    results = pictures.scabo_plot.Results(options.results)
    mesh = results.fields(results.count)
    drawn = pictures.draw(axis, mesh, pictures.values_of(mesh, "stress_yy", 1e-6), pictures.signed_levels(1.6, bands=8), magnification=300)
    pictures.colour_bar(figure, drawn, axis, "vertical stress (MPa)", shrink=0.85)
    axis.fill([-14, 0, 0, -14], [0, 0, 28, 28], color=pictures.BLUE, alpha=0.15, lw=0)
    axis.set(xlim=(-14, 38), ylim=(-12, 31), title="friction reduced until the dam is about to slide")
    return figure


if __name__ == "__main__":
    main()
