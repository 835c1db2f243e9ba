#!/usr/bin/env python3
"""A roller on a block whose quadtrees refine themselves: the meshes, the stress under the contact, the pressure against Hertz's, and
its error against the degrees of freedom, with equal cells too."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
MODEL = HERE / "model.yaml"
FORCE, RADIUS = 1e6, 0.05  # N/m, m, as in model.yaml
MODULUS = 1 / ((1 - 0.3**2) / 210e9 + (1 - 0.3**2) / 70e9)
HALF_WIDTH = np.sqrt(4 * FORCE * RADIUS / (np.pi * MODULUS))
PEAK = 2 * FORCE / (np.pi * HALF_WIDTH)
BODY = "0.92"
TOLERANCES = (0.05, 0.02, 0.01, 0.005)
EQUAL = (0.01, 0.005, 0.0025)  # m


def main():
    options = pictures.options_of(__doc__, HERE, "hertz.results")
    print(f"Hertz: pressure {PEAK / 1e6:.2f} MPa, half width {1e3 * HALF_WIDTH:.4f} mm")
    curves = {"refined": [solve(options, f"refined_{value}", f"size: 0.05, tolerance: {value}", f"size: 0.01, tolerance: {value}")
                          for value in TOLERANCES],
              "equal cells": [solve(options, f"equal_{size}", f"size: {size}", f"size: {size}") for size in EQUAL]}
    for name, figure in (("hertz", picture(options)), ("convergence", convergence(curves))):
        figure.savefig(options.output / f"{name}.png")
        print(options.output / f"{name}.png")


def solve(options, name, block, roller):
    """Degrees of freedom, and the error of the pressure over that of Hertz."""
    summary = pictures.run(options.scabo, MODEL, options.results / name, f"bodies.block.mesh={{kind: quadtree, {block}}}",
                           f"bodies.roller.mesh={{kind: quadtree, {roller}}}")
    x, pressure = pressure_of(options.results / name)
    dofs, error = summary["model"]["dofs"], error_of(x, pressure)
    inside = np.count_nonzero(pressure)
    print(f"{name:14} {dofs:7} dofs, {len(summary['passes']) or 1:2} meshes, {inside:3} pairs in contact: largest pressure {100 * (pressure.max() / PEAK - 1):+.2f} %, "
          f"half width {100 * (half_width(x, pressure) / HALF_WIDTH - 1) if inside > 4 else np.nan:+.2f} %, pressure over the width {100 * error:.2f} %")
    return dofs, error


def pressure_of(directory):
    touch = pictures.pairs_of(directory)["touch"]
    order = np.argsort(touch["x"])
    return touch["x"][order], touch["pressure"][order]


def hertz(x):
    return PEAK * np.sqrt(np.maximum(0, 1 - (x / HALF_WIDTH)**2))


def half_width(x, pressure):
    """The square of Hertz's pressure is linear in x^2: where the straight line through the squares reaches zero."""
    inside = pressure > 0
    slope, peak = np.polyfit(x[inside]**2, pressure[inside]**2, 1)
    return np.sqrt(-peak / slope)


def error_of(x, pressure):
    """Root mean square of the difference of linearly interpolated pressures, over that of Hertz's pressure."""
    fine = np.linspace(-2 * HALF_WIDTH, 2 * HALF_WIDTH, 4001)
    return np.sqrt(np.sum((np.interp(fine, x, pressure) - hertz(fine))**2) / np.sum(hertz(fine)**2))


def picture(options):
    figure = plt.figure(figsize=(13.2, 4.6), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1.25, 1.05, 1]})
    results = options.results / "refined_0.01"
    mesh = pictures.fields(results)
    stress = pictures.values_of(mesh, "von_mises", 1e-6)
    left.fill([-200, 200, 200, -200], [0, 0, -200, -200], color=BODY)
    angle = np.linspace(np.pi, 2 * np.pi, 181)
    left.fill(1e3 * RADIUS * np.cos(angle), 1e3 * (RADIUS + RADIUS * np.sin(angle)), color=BODY)
    pictures.draw_cells(left, results, factor=1e3)
    pictures.label_map(left, unit="mm")
    left.annotate("the next picture", (0, 0), (58, 22), color=pictures.RED, arrowprops={"arrowstyle": "->", "color": pictures.RED})
    left.set(xlim=(-125, 125), ylim=(-165, 60), title="cells of the roller and of the middle of the block")

    drawn = pictures.draw(middle, mesh, stress, np.linspace(0, 350, 15), factor=1e3, unit="mm")
    pictures.draw_cells(middle, results, factor=1e3)
    pictures.colour_bar(figure, drawn, middle, "von Mises stress (MPa)", count=8, location="bottom", shrink=0.9)
    middle.set(xlim=(-2.2, 2.2), ylim=(-2.4, 1.6), title="the contact: cells and stress")

    x, pressure = pressure_of(results)
    s = np.linspace(-1, 1, 401)
    right.plot(s * 1e3 * HALF_WIDTH, hertz(s * HALF_WIDTH) / 1e6, color=pictures.GREY, label="Hertz")
    right.plot(1e3 * x, pressure / 1e6, "o", color=pictures.RED, markersize=3.5, label="Scabo, every pair of nodes")
    right.set(xlim=(-1.6, 1.6), ylim=(0, 750), xlabel="x (mm)", ylabel="pressure (MPa)", title="pressure between roller and block")
    right.legend(loc="upper left")
    right.grid(True)
    return figure


def convergence(curves):
    figure, axis = plt.subplots(figsize=(5.6, 3.6), layout="constrained")
    for (name, points), style, colour in zip(curves.items(), ("o-", "s--"), (pictures.RED, pictures.BLUE)):
        axis.loglog(*zip(*points), style, color=colour, markersize=4, label=name)
    axis.set(xlabel="degrees of freedom", ylabel="error of the pressure / pressure of Hertz")
    axis.set_xticks([2000, 5000, 10_000, 20_000, 50_000, 100_000], labels=["2,000", "5,000", "10,000", "20,000", "50,000", "100,000"])
    axis.xaxis.set_minor_locator(plt.NullLocator())
    axis.legend()
    axis.grid(True, which="both")
    return figure


if __name__ == "__main__":
    main()
