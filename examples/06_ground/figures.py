#!/usr/bin/env python3
"""A pressure tunnel beside its closed form, and a footing in a trench of a half-plane: stress in the ground, pressure in the joint."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
PRESSURE, RADIUS, YOUNG, POISSON = 1e6, 3.0, 2e9, 0.25


def main():
    options = pictures.options_of(__doc__, HERE, "ground.results")
    pictures.run(options.scabo, HERE / "tunnel.yaml", options.results / "tunnel")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results / "trench")
    tunnel = pictures.fields(options.results / "tunnel")
    wall = np.abs(np.linalg.norm(tunnel.points[:, :2], axis=1) - RADIUS) < 1e-6
    u = np.linalg.norm(tunnel.point_data["displacement"][wall, :2], axis=1).mean()
    exact = PRESSURE * RADIUS * (1 + POISSON) / YOUNG
    print(f"tunnel: the wall moves {1e3 * u:.6f} mm, closed form {1e3 * exact:.6f} mm ({100 * (u / exact - 1):.4f} %)")
    seat = summary["increments"][-1]["contacts"]["seat"]
    print(f"footing: normal force {seat['normal_force'] / 1e6:.4f} MN/m, tangential {abs(seat['tangential_force']) / 1e6:.4f} MN/m, "
          f"{seat['stick']} pairs stick, {seat['slip']} slip, {seat['open']} open")
    path = options.output / "ground.png"
    picture(options, tunnel).savefig(path)
    print(path)


def picture(options, tunnel):
    figure = plt.figure(figsize=(13.0, 4.0), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1, 1.5, 1]})
    x, y = tunnel.points[:, 0], tunnel.points[:, 1]
    ray = (np.abs(y) < 1e-9) & (x > 0)
    radius = np.linspace(RADIUS, 6 * RADIUS, 200)
    left.plot(radius, (RADIUS / radius) ** 2, color=pictures.GREY, label="closed form")
    left.plot(radius, -(RADIUS / radius) ** 2, color=pictures.GREY)
    left.plot(x[ray], pictures.values_of(tunnel, "stress_yy", 1 / PRESSURE)[ray], "x", color=pictures.RED, label="hoop stress")
    left.plot(x[ray], pictures.values_of(tunnel, "stress_xx", 1 / PRESSURE)[ray], "+", color=pictures.BLUE, label="radial stress")
    left.set(xlabel="distance from the axis (m)", ylabel="stress / pressure in the tunnel", title="pressure tunnel")
    left.legend()
    left.grid(True)

    last = pictures.fields(options.results / "trench", 5)
    drawn = pictures.draw(middle, last, pictures.values_of(last, "stress_yy", 1e-6), pictures.signed_levels(1.6, bands=16), magnification=200)
    pictures.colour_bar(figure, drawn, middle, "vertical stress (MPa)", shrink=0.85)
    middle.set(xlim=(-9, 9), ylim=(-11, 1), title="trench, under column and wind")

    for number, style, colour, name in ((1, "o-", pictures.GREY, "column"), (5, "s-", pictures.RED, "column and wind")):
        seat = pictures.pairs_of(options.results / "trench", number)["seat"]
        right.plot(seat["x"], 1e-6 * seat["pressure"], style, color=colour, markersize=3, linewidth=1, label=f"pressure, {name}")
    right.plot(seat["x"], 1e-6 * np.abs(seat["shear"]), "^--", markersize=3, linewidth=0.8, color=pictures.BLUE,
               label="shear, column and wind")
    right.set(xlabel="x (m)", ylabel="traction in the joint (MPa)", title="joint under the footing")
    right.set_ylim(bottom=0)
    right.legend()
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
