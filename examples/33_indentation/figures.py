#!/usr/bin/env python3
"""Indentation of a layer: stress under the flat punch, its pressure, and the force of the ball against its depth."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent


def main():
    options = pictures.options_of(__doc__, HERE, "indentation.results")
    pictures.run(options.scabo, HERE / "model.yaml", options.results)
    of_ball = options.results.with_name("ball.results")
    pictures.run(options.scabo, HERE / "ball.yaml", of_ball)
    figure = plt.figure(figsize=(10.6, 3.4), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1.4, 1, 1]})
    mesh = pictures.scabo_plot.Results(options.results, mirrored=True).fields(1)
    drawn = pictures.draw(left, mesh, pictures.values_of(mesh, "stress_yy", 1e-6), pictures.signed_levels(4, bands=8), factor=1e3, unit="mm")
    left.set(title="under the flat punch", xlim=(-4, 4), ylim=(-5, 0.5))
    pictures.colour_bar(figure, drawn, left, "axial stress (MPa)", shrink=0.9)
    seat, touch = pictures.pairs_of(options.results)["seat"], pictures.pairs_of(of_ball)["seat"]
    middle.plot(1e3 * seat["x"], 1e-6 * seat["pressure"], color=pictures.BLUE, label="flat punch")
    middle.plot(1e3 * touch["x"], 1e-6 * touch["pressure"], color=pictures.RED, label="ball")
    middle.set(xlim=(0, 1.3), ylim=(0, 12), xlabel="radius (mm)", ylabel="pressure (MPa)", title="pressure")
    history = pictures.table_of(of_ball, "history.csv")
    depth = np.linspace(0, hand.BALL_DEPTH, 60)
    right.plot(1e6 * np.linspace(0, hand.BALL_DEPTH, 6), np.concatenate([[0], history["force"]]), "o", ms=4, color=pictures.RED, label="run")
    right.plot(1e6 * depth, [hand.ball(d) for d in depth], color=pictures.GREY, label="layer, by hand")
    right.plot(1e6 * depth, [hand.half_space(d) for d in depth], "--", color=pictures.GREY, label="half-space, Hertz")
    right.set(xlabel="depth (µm)", ylabel="force (N)", title="ball")
    for axis in (middle, right):
        axis.legend()
        axis.grid(True)
    path = options.output / "indentation.png"
    figure.savefig(path)
    print(path)


if __name__ == "__main__":
    main()
