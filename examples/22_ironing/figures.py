#!/usr/bin/env python3
"""Ironing: the stress under the tool when it has been dragged, the forces along the way, and the pressure against Hertz's."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
FRICTION, RADIUS, WAY = 0.2, 10.0, 0.4  # as in model.yaml
MODULUS = 210e9 / (2 * (1 - 0.3**2))


def main():
    options = pictures.options_of(__doc__, HERE, "ironing.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    figure = plt.figure(figsize=(13.2, 4.2), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1.3, 1, 1]})
    draw_stress(figure, left, options.results)
    draw_forces(middle, summary)
    draw_pressure(right, options.results, summary)
    figure.savefig(options.output / "ironing.png")
    print(options.output / "ironing.png")


def draw_stress(figure, axis, results):
    mesh = pictures.fields(results, 44)
    drawn = pictures.draw(axis, mesh, pictures.values_of(mesh, "von_mises", 1e-6), np.linspace(0, 500, 11), magnification=1)
    pictures.colour_bar(figure, drawn, axis, "von Mises stress (MPa)", count=6, location="bottom", shrink=0.9)
    axis.set(xlim=(-0.4, 0.9), ylim=(-0.7, 0.5), title="after 0.4 m")


def draw_forces(axis, summary):
    path = [one for one in summary["increments"] if one["step"] == 2]
    way = [WAY * one["factors"]["drag"] for one in path]
    normal = np.array([one["contacts"]["iron"]["normal_force"] for one in path])
    tangential = np.array([-one["contacts"]["iron"]["tangential_force"] for one in path])
    sliding = normal[8:]
    print(f"normal force {sliding.mean() / 1e6:.3f} MN/m, smooth to {100 * np.ptp(sliding) / sliding.mean():.2f} %; "
          f"tangential force {tangential[8:].mean() / 1e6:.3f} MN/m, to {100 * np.ptp(tangential[8:]) / tangential[8:].mean():.2f} %")
    axis.plot(way, normal / 1e6, color=pictures.BLUE, label="normal")
    axis.plot(way, tangential / FRICTION / 1e6, "--", color=pictures.RED, label="tangential / coefficient of friction")
    for where in [x for x, one in zip(way, path) if one["pairs_found_anew"]["times"]]:
        axis.axvline(where, color="0.85", linewidth=0.8, zorder=0)
    axis.set(xlim=(0, WAY), ylim=(0, 1.25 * normal.max() / 1e6), xlabel="way (m)", ylabel="force (MN/m)",
             title="forces; grey: pairs found anew")
    axis.legend(loc="lower right")


def draw_pressure(axis, results, summary):
    colours = plt.get_cmap("viridis")
    for number, increment in enumerate((3, 17, 30, 43)):
        iron = pictures.pairs_of(results, increment + 1)["iron"]
        order = np.argsort(iron["x"])
        order = order[iron["pressure"][order] > 0]
        axis.plot(iron["x"][order], iron["pressure"][order] / 1e6, "o-", markersize=2.5, linewidth=0.8, color=colours(number / 4),
                  label="Scabo, every pair of nodes" if number == 0 else None)
        force = summary["increments"][increment]["contacts"]["iron"]
        centre, half = force["centre_of_pressure"][0], np.sqrt(4 * force["normal_force"] * RADIUS / (np.pi * MODULUS))
        s = np.linspace(-1, 1, 201)
        axis.plot(centre + half * s, 2 * force["normal_force"] / (np.pi * half) * np.sqrt(1 - s**2) / 1e6, "--", color=pictures.GREY,
                  linewidth=0.9, label="Hertz, of the same force" if number == 0 else None)
    axis.set(xlim=(-0.25, 0.65), ylim=(0, 800), xlabel="x (m)", ylabel="pressure (MPa)", title="pressure on the way")
    axis.legend(loc="upper left")
    axis.grid(True)


if __name__ == "__main__":
    main()
