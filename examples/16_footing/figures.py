#!/usr/bin/env python3
"""A footing on half-plane ground: the meshed near field, stress across the tie, and the pressure beside that of a rigid punch."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
FORCE, HALF_WIDTH = 300e3, 1.0


def main():
    options = pictures.options_of(__doc__, HERE, "footing.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results / "model")
    pictures.run(options.scabo, HERE / "model.yaml", options.results / "smooth", "contacts.seat.friction=0", "loads.wind.traction=[0, 0]")
    seat = summary["increments"][-1]["contacts"]["seat"]
    print(f"storm: normal force {seat['normal_force'] / 1e3:.3f} kN/m, tangential {seat['tangential_force'] / 1e3:.3f} kN/m, "
          f"{seat['stick']} pairs stick, {seat['slip']} slip, {seat['open']} open")
    for x, ratio in deviations(options.results / "smooth"):
        print(f"without friction, x = {x:.2f} m: pressure {ratio:.4f} of that under a rigid punch")
    path = options.output / "footing.png"
    picture(options, summary).savefig(path)
    print(path)


def punch(x):
    """Pressure under a rigid frictionless punch, Sadowsky (1928)."""
    return FORCE / (np.pi * np.sqrt(HALF_WIDTH**2 - x**2))


def deviations(directory):
    seat = pictures.pairs_of(directory, 1)["seat"]
    return [(x, p / punch(x)) for x, p in zip(seat["x"], seat["pressure"]) if -1e-9 <= x <= 0.81][::3]


def picture(options, summary):
    figure = plt.figure(figsize=(13.2, 4.4), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1.3, 1.3, 1]})
    last = pictures.fields(options.results / "model", len(summary["increments"]))
    levels = pictures.signed_levels(160, bands=8)
    for axes, limits, title, moved in (
            (left, (-9, 9, -11, 1.5), "storm: stress in the near field and beyond", {"magnification": 20}),
            (middle, (-2.2, 2.2, -2.2, 1.0), "under the footing, with the cells", {})):
        drawn = pictures.draw(axes, last, pictures.values_of(last, "stress_yy", 1e-3), levels, **moved)
        axes.set(xlim=limits[:2], ylim=limits[2:], title=title)
    pictures.draw_cells(middle, options.results / "model")
    pictures.colour_bar(figure, drawn, middle, "vertical stress (kPa)", location="bottom", shrink=0.9)
    x = np.linspace(-0.985, 0.985, 400)
    right.plot(x, punch(x) * 1e-3, color=pictures.GREY, label="rigid punch, closed form")
    for directory, when, style, colour, name in (("smooth", 1, ".", "black", "wall, no friction"),
                                                 ("model", 1, "-", pictures.BLUE, "wall"),
                                                 ("model", 5, "-", pictures.RED, "wall and wind")):
        seat = pictures.pairs_of(options.results / directory, when)["seat"]
        right.plot(seat["x"], seat["pressure"] * 1e-3, style, color=colour, label=name)
    right.set(xlabel="x (m)", ylabel="pressure under the footing (kPa)", xlim=(-1, 1), ylim=(0, 600), xticks=[-1, -0.5, 0, 0.5, 1], title="pressure in the joint")
    right.legend(loc="upper center")
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
