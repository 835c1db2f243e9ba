#!/usr/bin/env python3
"""Koyna with joints: the dam when its lift joint is widest open, and ground, crest and slips against time."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from matplotlib.collections import PolyCollection
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
MAGNIFIED = 200


def main():
    options = pictures.options_of(__doc__, HERE, "koyna.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    history = pictures.table_of(options.results, "history.csv")
    widest = 3 + 4 * int(np.argmax(history["lift.uy"][3::4]))  # of every fourth increment, which has fields
    print(f"crest {1e3 * np.ptp(history['crest']):.2f} mm, lift {1e3 * history['lift.ux'][-1]:.3f} mm, "
          f"base {1e3 * history['base.ux'][-1]:.3f} mm")
    path = options.output / "koyna.png"
    picture(summary, history, options.results, widest).savefig(path)
    print(path)


def picture(summary, history, results, widest):
    figure = plt.figure(figsize=(9.6, 4.6), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(1, 1.25))
    grid = pictures.fields(results, widest + 1)
    moved = pictures.moved_points(grid, MAGNIFIED)
    triangles = pictures.triangles_of(grid)
    left.add_collection(PolyCollection(moved[triangles], facecolor="0.9", edgecolor="0.9"))
    for line in pictures.outline(triangles):
        left.plot(*moved[line].T, color="0.25", lw=0.9)
    times = np.array([increment.get("time", 0.0) for increment in summary["increments"]])
    left.set(title=f"at {times[widest]:.2f} s, lift joint open at its face ($\\times$ {MAGNIFIED})", xlim=(-40, 110), ylim=(-25, 118))
    pictures.label_map(left)
    crest = history["crest"] - history["crest"][0]
    right.plot(times, 1e3 * crest, color=pictures.BLUE, label="crest")
    right.plot(times, 1e3 * history["lift.uy"], color=pictures.GREEN, label="opening of the lift joint")
    right.plot(times, 1e3 * history["lift.ux"], color=pictures.RED, label="slip of the lift joint")
    right.plot(times, 1e3 * (history["base.ux"] - history["base.ux"][0]), color="0.3", ls="--", label="slip of the base")
    right.plot(times, 100 * history["ground"], color=pictures.GREY, lw=1, label="velocity of the ground (cm/s)")
    right.set(xlabel="time (s)", ylabel="displacement (mm)", title="relative to the ground and to the state at rest")
    right.legend(fontsize=8)
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
