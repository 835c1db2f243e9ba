#!/usr/bin/env python3
"""The shaken block: acceleration of the ground with what friction can pass on, and slip against time with the hand calculation."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent


def main():
    options = pictures.options_of(__doc__, HERE, "shaken_block.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    history = pictures.table_of(options.results, "history.csv")
    print(f"farthest {1e3 * history['moved'].min():.5f} mm, left {1e3 * history['moved'][-1]:.5f} mm")
    path = options.output / "shaken_block.png"
    picture(summary, history).savefig(path)
    print(path)


def picture(summary, history):
    figure = plt.figure(figsize=(9.6, 3.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    times = np.linspace(0, hand.PERIOD, 200)
    left.plot([*times, 2 * hand.PERIOD], [*(hand.PEAK * np.sin(2 * math.pi * times / hand.PERIOD)), 0.0], color=pictures.BLUE)
    for bound in (-hand.SLOW, hand.SLOW):
        left.axhline(bound, color=pictures.GREY, lw=1, ls="--")
    left.text(0.98, hand.SLOW + 0.15, "most that friction gives the block", ha="right", color="0.35", fontsize=8)
    left.set(xlabel="time (s)", ylabel="acceleration (m/s$^2$)", title="the ground")
    left.grid(True)

    calculated = np.array(hand.calculate()["path"])
    right.plot(calculated[:, 0], 1e3 * calculated[:, 1], color=pictures.GREY, lw=2.5, label="by hand")
    in_time = [(increment["time"], 1e3 * moved) for increment, moved in zip(summary["increments"], history["moved"]) if "time" in increment]
    right.plot(*zip(*in_time[::2]), "o", ms=2.5, color=pictures.BLUE, label="run")
    right.set(xlabel="time (s)", ylabel="slip (mm)", title="the block, relative to the ground")
    right.legend(loc="center right")
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
