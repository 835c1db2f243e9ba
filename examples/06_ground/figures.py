#!/usr/bin/env python3
"""A pressure tunnel beside its closed form, and a footing in a trench of a half-plane: stress in the ground, pressure in the joint."""
import csv
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
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(11.6, 3.9), gridspec_kw={"width_ratios": [1, 1.5, 1]})
    figure.subplots_adjust(left=0.065, right=0.985, top=0.9, bottom=0.13, wspace=0.27)
    x, y = tunnel.points[:, 0], tunnel.points[:, 1]
    ray = (np.abs(y) < 1e-9) & (x > 0)
    radius = np.linspace(RADIUS, 6 * RADIUS, 200)
    left.plot(radius, (RADIUS / radius) ** 2, color="0.6", label="closed form")
    left.plot(radius, -(RADIUS / radius) ** 2, color="0.6")
    left.plot(x[ray], tunnel.point_data["stress_yy"][ray] / PRESSURE, "x", color="#c1442e", label="around the hole")
    left.plot(x[ray], tunnel.point_data["stress_xx"][ray] / PRESSURE, "+", color="#2b5c8a", label="radial")
    left.set_xlabel("distance from the axis, m")
    left.set_ylabel("stress / pressure")
    left.legend(frameon=False)
    left.grid(linewidth=0.3)
    left.set_title("tunnel")

    last = pictures.fields(options.results / "trench", 5)
    drawn = pictures.draw(middle, last, last.point_data["stress_yy"] / 1e6, np.linspace(-1.5, 0.25, 15), magnification=200)
    figure.colorbar(drawn, ax=middle, label="vertical stress, MPa", shrink=0.9)
    middle.set_xlim(-9, 9)
    middle.set_ylim(-11, 1)
    middle.set_title("trench, column and wind (moved 200 times)")

    with open(options.results / "trench" / "contact.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for step, increment, style, name in (("1", "1", "o-", "column"), ("2", "4", "s-", "column and wind")):
        chosen = [row for row in rows if row["step"] == step and row["increment"] == increment]
        right.plot([float(row["x"]) for row in chosen], [float(row["pressure"]) / 1e6 for row in chosen], style,
                   markersize=3.5, linewidth=1, label=f"pressure, {name}")
    right.plot([float(row["x"]) for row in chosen], [abs(float(row["shear"])) / 1e6 for row in chosen], "^--", markersize=3.5,
               linewidth=0.8, color="0.4", label="shear, column and wind")
    right.set_xlabel("x, m")
    right.set_ylabel("MPa")
    right.set_ylim(bottom=0)
    right.legend(frameon=False)
    right.grid(linewidth=0.3)
    right.set_title("joint under the footing")
    return figure


if __name__ == "__main__":
    main()
