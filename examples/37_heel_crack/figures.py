#!/usr/bin/env python3
"""The heel crack of a dam: its path, and the weight of water at which it grows, with and without water in the crack."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
RUNS = (("water in the crack", "wet", (), pictures.RED, "-"), ("dry crack", "dry", ("steps.1.loads.uplift=1e-5", "steps.1.growth.until.length=9"), pictures.BLUE, "--"))


def main():
    options = pictures.options_of(__doc__, HERE, "heel_crack")
    figure = plt.figure(figsize=(9.6, 3.8), layout="constrained")
    whole, near, right = figure.subplots(1, 3, width_ratios=(1.15, 0.75, 1.1))
    for label, name, settings, colour, dashes in RUNS:
        directory = options.results.with_name(f"{options.results.name}_{name}.results")
        summary = pictures.run(options.scabo, HERE / "model.yaml", directory, *settings)
        path, table = np.array(summary["growth"]["paths"]["dam.crack"]), pictures.table_of(directory, "cracks.csv")
        turn = path[2] - path[1]
        print(f"{label}: grows at {table['load_factor'][0]:.3f} times the weight of water, turns by {np.degrees(np.arctan2(*turn[::-1])):.1f} degrees; "
              f"{table['load_factor'][3]:.3f} at a length of {table['length'][3]:.0f}, tip at ({path[-1][0]:.2f}, {path[-1][1]:.2f})")
        if name == "wet":
            for axis in (whole, near):
                pictures.draw_cells(axis, directory, linewidths=0.3)
        for axis in (whole, near):
            axis.plot(*path.T, dashes, color=colour, lw=1.8)
        right.plot(table["length"], table["load_factor"], dashes, color=colour, marker="o", ms=2.5, label=label)
    whole.set(xlim=(-40, 110), ylim=(-40, 85), aspect="equal", xlabel="x (m)", ylabel="y (m)", title="dam and rock")
    near.set(xlim=(-3, 12), ylim=(-13, 4), aspect="equal", xlabel="x (m)", ylabel="y (m)", title="heel")
    right.set(xlabel="length of the crack (m)", ylabel="weight of water over that of water", title="when it grows", ylim=(0, None))
    right.grid(True)
    right.legend()
    figure.savefig(options.output / "heel_crack.png")
    print(options.output / "heel_crack.png")


if __name__ == "__main__":
    main()
