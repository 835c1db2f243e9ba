#!/usr/bin/env python3
"""Fatigue at a hole: the cracks over the cells of the last mesh, and their length over the cycles."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
R, FIRST, LAST, STRESS = 0.01, 0.001, 0.008, 80e6


def main():
    options = pictures.options_of(__doc__, HERE, "fatigue.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    table = pictures.table_of(options.results, "cracks.csv")
    one = np.array([tip == "plate.right.end" for tip in table["tip"]])
    length, cycles = table["length"][one], table["cycles"][one]
    factor = table["K_I"][one] / STRESS / np.sqrt(np.pi * length)
    print(f"F from {factor[0]:.3f} to {factor[-1]:.3f}; {cycles[-1]:.0f} cycles, by hand {hand.life(FIRST, LAST):.0f}")
    figure = plt.figure(figsize=(9.0, 3.8), layout="constrained")
    left, right = figure.subplots(1, 2)
    pictures.draw_cells(left, options.results, factor=1e3, linewidths=0.3)
    for path in summary["growth"]["paths"].values():
        left.plot(*(np.array(path) * 1e3).T, color=pictures.RED, lw=2)
    left.set(xlim=(-25, 25), ylim=(-20, 20), aspect="equal", xlabel="x (mm)", ylabel="y (mm)", title="cracks at the hole")
    right.plot(cycles, length * 1e3, "o-", color=pictures.RED, ms=3, label="computed")
    lengths = np.linspace(FIRST, LAST, 40)
    right.plot([hand.life(FIRST, l) if l > FIRST else 0 for l in lengths], lengths * 1e3, "--", color=pictures.BLUE, label="by Bowie's factors")
    right.set(xlabel="cycles", ylabel="length of a crack (mm)", title="life", xlim=(0, None), ylim=(0, None))
    right.grid(True)
    right.legend()
    figure.savefig(options.output / "fatigue.png")
    print(options.output / "fatigue.png")


if __name__ == "__main__":
    main()
