#!/usr/bin/env python3
"""The dam under high water, and its sliding factor against the level of the water, by hand and from runs."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
LEVELS = (13, 17, 19)


def main():
    options = pictures.options_of(__doc__, HERE, "dam_sliding.results")
    factors = {}
    for level in LEVELS:
        directory = options.results / f"level_{level}"
        pictures.run(options.scabo, HERE / "model.yaml", directory, f"parameters.level={level}")
        history = pictures.table_of(directory, "history.csv")
        ends = {10: 2, 15: 4, level: 8}  # rows of history.csv in which one level acts alone
        factors |= {at: hand.MU * history["pressing"][row] / -history["thrust"][row] for at, row in ends.items()}
        print(f"water at {level} m: sliding factor {factors[level]:.4f}")
    path = options.output / "dam_sliding.png"
    picture(options, factors).savefig(path)
    print(path)


def picture(options, factors):
    figure = plt.figure(figsize=(9.6, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.15, 1]})
    mesh = pictures.fields(options.results / "level_19", 9)
    drawn = pictures.draw(left, mesh, pictures.values_of(mesh, "stress_yy", 1e-6), pictures.signed_levels(1.0, bands=8), magnification=1000)
    pictures.colour_bar(figure, drawn, left, "vertical stress (MPa)", shrink=0.85)
    left.fill([-15, 0, 0, -15], [0, 0, 19, 19], color=pictures.BLUE, alpha=0.15, lw=0)
    left.set(xlim=(-8, 20), ylim=(-8, 21), title="water at 19 m: stress")

    levels = np.linspace(9, 21, 200)
    right.plot(levels, hand.MU * (hand.WEIGHT - hand.uplift(levels)) / hand.thrust(levels), color=pictures.GREY, label="by hand")
    right.plot(list(factors), list(factors.values()), "o", color=pictures.BLUE, label="runs")
    slides = hand.calculate()["level"]
    right.axvline(slides, color=pictures.RED, ls="--", lw=1)
    right.annotate(f"slides at {slides:.2f} m", (slides, 3.0), (-4, 0), textcoords="offset points", rotation=90, ha="right", va="center", color=pictures.RED)
    right.axhline(1, color="black", lw=0.7)
    right.set(xlabel="level of the water (m)", ylabel="friction over thrust", xlim=(9, 21), ylim=(0, 5.5), title="sliding factor")
    right.legend()
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
