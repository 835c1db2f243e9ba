#!/usr/bin/env python3
"""Wing cracks: their path over the cells of the last mesh, and the load over their length."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
C, MU, K_IC = 0.01, 0.3, 1e6
FIRST = np.sqrt(0.75) * K_IC / (0.5 * (1 - MU) * np.sqrt(np.pi * C)) / 1e6  # MPa
STRAIGHT = ((0.02, 0.37755), (0.1, 0.30960), (0.5, 0.15240))  # length over c, k_1 over P sqrt(pi c) of straight wings


def main():
    options = pictures.options_of(__doc__, HERE, "wing_cracks.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    path, table = np.array(summary["growth"]["paths"]["plate.flaw"]) * 1e3, pictures.table_of(options.results, "cracks.csv")
    end = np.array([tip.endswith("end") for tip in table["tip"]])
    length, load = (table["length"][end] - 2 * C) / 2 / C, table["load_factor"][end]
    kinks = np.degrees(table["kink"][end])
    along = path[-1] - path[-2]
    print(f"first load {load[0]:.3f} MPa, by hand {FIRST:.3f}; kink {kinks[0]:.2f} degrees; wings of {length[1]:.2f} c at {load[1]:.2f} MPa; "
          f"of {length[-1]:.2f} c at {load[-1]:.2f} MPa, {np.degrees(np.arctan2(abs(along[0]), along[1])):.1f} degrees from the load")
    figure = plt.figure(figsize=(9.0, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    pictures.draw_cells(left, options.results, factor=1e3, linewidths=0.3)
    flaw = path[np.abs(path[:, 0] - path[:, 1]) < 1e-6]
    left.plot(*path.T, color=pictures.RED, lw=1.5)
    left.plot(*flaw.T, color=pictures.BLUE, lw=2)
    for side in (-1, 1):
        left.annotate("", (0, side * 16.3), (0, side * 19.3), arrowprops={"arrowstyle": "-|>", "color": pictures.GREY})
    left.set(xlim=(-20, 20), ylim=(-20, 20), aspect="equal", xlabel="x (mm)", ylabel="y (mm)", title="closed crack (blue) and wings (red)")
    right.plot(length, load, "o-", color=pictures.RED, ms=3, label="computed")
    right.plot(0, FIRST, "D", color="k", ms=5, label="first load by hand")
    right.plot([part for part, _ in STRAIGHT], [K_IC / (k * np.sqrt(np.pi * C)) / 1e6 for _, k in STRAIGHT], "s", mfc="none", color=pictures.BLUE,
               label="straight wings of 70.5 degrees")
    right.set(xlabel="length of a wing over half length of the crack", ylabel="pressure (MPa)", title="load at which the wings grow", xlim=(-0.02, None), ylim=(0, None))
    right.grid(True)
    right.legend(loc="lower right")
    figure.savefig(options.output / "wing_cracks.png")
    print(options.output / "wing_cracks.png")


if __name__ == "__main__":
    main()
