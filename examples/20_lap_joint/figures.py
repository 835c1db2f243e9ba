#!/usr/bin/env python3
"""The lap joint: stress while it slips, and the loop of pull against displacement."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent


def main():
    options = pictures.options_of(__doc__, HERE, "lap_joint.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    history = pictures.table_of(options.results, "history.csv")
    lap = summary["increments"][10]["contacts"]["lap"]
    print(f"normal force {history['normal'][10] / 1e3:.4f} kN, slips at {history['pull'][10] / 1e3:.4f} kN; "
          f"{lap['open']} pairs open, {lap['stick']} stick, {lap['slip']} slip")
    path = options.output / "lap_joint.png"
    picture(options, summary, history).savefig(path)
    print(path)


def picture(options, summary, history):
    figure = plt.figure(figsize=(9.6, 4.6), layout="constrained")
    parts = figure.subfigures(2, 1, height_ratios=[1.0, 1.4])
    top = parts[0].subplots()
    mesh = pictures.fields(options.results, 11)
    drawn = pictures.draw(top, mesh, pictures.values_of(mesh, "stress_yy", 1e-6), pictures.signed_levels(80, bands=8), factor=1e3, unit="mm")
    pictures.colour_bar(parts[0], drawn, top, "normal stress (MPa)", orientation="horizontal", aspect=45, shrink=0.6)
    top.set(title="slipping: stress from the plane of symmetry to the washers")
    left, right = parts[1].subplots(1, 2)
    for number, name, colour, style in ((1, "tightened", pictures.BLUE, "-"), (11, "slipping", pictures.RED, "--")):
        lap = pictures.pairs_of(options.results, number)["lap"]
        left.plot(1e3 * lap["x"], lap["pressure"] / 1e6, style, color=colour, label=name)
    left.set(xlabel="x (mm)", ylabel="pressure (MPa)", ylim=(0, 70), title="pressure between the plates")
    pulled = 0.1e-3  # m, of model.yaml
    moved = [1e3 * pulled * increment["factors"].get("pull", 0.0) for increment in summary["increments"]]
    slip = hand.calculate()["slip"] / 1e3
    for sign in (-1, 1):
        right.axhline(sign * slip, color=pictures.GREY, label="mu N, by hand" if sign > 0 else None)
    right.plot(moved, history["pull"] / 1e3, "o-", ms=3, color=pictures.BLUE, label="run")
    right.set(xlabel="displacement of the end (mm)", ylabel="pull (kN)", title="pulled and pushed back")
    for axis in (left, right):
        axis.legend(loc="lower right" if axis is right else "upper center", ncols=2)
        axis.grid(True)
    right.set(xticks=np.linspace(-0.1, 0.1, 5), ylim=(-90, 72))
    return figure


if __name__ == "__main__":
    main()
