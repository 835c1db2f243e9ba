#!/usr/bin/env python3
"""The beam with three holes: the paths of three notches over the cells of the last mesh, beside points of plain finite elements, and the load that each
crack needs."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
NOTCHES = ((6, 1.0), (5, 1.5), (4.97, 1.5))  # from the middle, deep
CHECK = {notch["from_middle"]: notch for notch in json.loads((HERE / "check.json").read_text(encoding="utf-8"))["notches"]}
HOLES = {"low": 2.75, "middle": 4.75, "high": 6.75}


def main():
    options = pictures.options_of(__doc__, HERE, "three_holes")
    figure = plt.figure(figsize=(12.0, 3.9), layout="constrained")
    axes = figure.subplots(1, 4, width_ratios=(1, 1, 1, 1.15))
    for axis, (middle, deep), colour, dashes in zip(axes, NOTCHES, (pictures.BLUE, pictures.RED, pictures.GREY), ("-", "--", ":")):
        directory = options.results.with_name(f"{options.results.name}_{middle}.results")
        summary = pictures.run(options.scabo, HERE / "model.yaml", directory, f"parameters.from_middle={middle}", f"parameters.deep={deep}")
        path, table = np.array(summary["growth"]["paths"]["beam.notch"]), pictures.table_of(directory, "cracks.csv")
        distances = {name: distance(path, (-4.0, height)) - 0.25 for name, height in HOLES.items()}
        print(f"notch {middle}/{deep}: starts at {table['load_factor'][0]:.0f} lb, tenth step ends at ({table['x'][10]:.3f}, {table['y'][10]:.3f}), "
              f"passes the low hole at {distances['low']:.3f}; {summary['growth']['ended']}")
        pictures.draw_cells(axis, directory, linewidths=0.3)
        axis.plot(*path.T, "o-", color=colour, ms=2, lw=1.3)
        if "by_triangles" in CHECK[middle]:
            axis.plot(*np.array(CHECK[middle]["by_triangles"]).T, "s", color="k", mfc="none", ms=5, label="plain finite elements")
            axis.legend(loc="upper left", fontsize=7)
        axis.set(xlim=(-7, -2), ylim=(0, 8), aspect="equal", xlabel="x (in)", ylabel="y (in)", title=f"notch {deep:g} deep, {middle} from the middle")
        axes[3].plot(table["length"], table["load_factor"], dashes, color=colour, marker="o", ms=2.5, label=f"{middle} from the middle")
    axes[3].set(xlabel="length of the crack (in)", ylabel="load (lb)", title="load at which it grows", ylim=(0, None))
    axes[3].grid(True)
    axes[3].legend()
    figure.savefig(options.output / "three_holes.png")
    print(options.output / "three_holes.png")


def distance(path, centre):
    """Of a point from a path."""
    along = np.diff(path, axis=0)
    part = np.clip(((centre - path[:-1]) * along).sum(axis=1) / (along**2).sum(axis=1), 0, 1)
    return np.linalg.norm(path[:-1] + part[:, None] * along - centre, axis=1).min()


if __name__ == "__main__":
    main()
