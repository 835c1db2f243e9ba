#!/usr/bin/env python3
"""The shaken wall: the wall when its upper part is farthest back, and slip against time with the hand calculation."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
MAGNIFIED = 8
FIELDS_AT = 26  # increment at 0.25 s, after the one at rest; `every: 13` has it


def main():
    options = pictures.options_of(__doc__, HERE, "shaken_wall.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    history = pictures.table_of(options.results, "history.csv")
    print(f"back {1e3 * history['upper'].min():.5f} mm, left {1e3 * history['upper'][-1]:.5f} mm")
    path = options.output / "shaken_wall.png"
    picture(summary, history, pictures.fields(options.results, FIELDS_AT)).savefig(path)
    print(path)


def picture(summary, history, grid):
    figure = plt.figure(figsize=(9.6, 3.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    moved = pictures.moved_points(grid, MAGNIFIED)
    for stone in pictures.geometry.rigid_outlines(grid):
        left.fill(*moved[stone].T, facecolor="0.9", edgecolor="0.3", lw=0.8)
    left.set(title=f"farthest back, 0.25 s ($\\times$ {MAGNIFIED})", ylim=(-0.2, 1.3))
    pictures.label_map(left)
    calculated = np.array(hand.calculate()["path"])
    right.plot(calculated[:, 0], 1e3 * calculated[:, 1], color=pictures.GREY, lw=2.5, label="by hand")
    times = [increment.get("time", 0.0) for increment in summary["increments"]]
    right.plot(times, 1e3 * history["upper"], "o", ms=2.5, color=pictures.BLUE, label="run")
    right.plot(times, 1e3 * history["lower"], color=pictures.RED, lw=1, label="below the damp course")
    right.set(xlabel="time (s)", ylabel="slip (mm)", title="the wall, relative to the ground", ylim=(-38, 4))
    right.legend(loc="lower right")
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
