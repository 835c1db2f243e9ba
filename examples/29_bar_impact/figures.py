#!/usr/bin/env python3
"""The bar that hits a wall: force of the wall, stress in its middle and displacements of three of its points against time, with the closed form."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent


def main():
    options = pictures.options_of(__doc__, HERE, "bar_impact.results")
    pictures.run(options.scabo, HERE / "model.yaml", options.results)
    history = pictures.table_of(options.results, "history.csv")
    print(f"force of the wall at 0.3 ms: {1e-3 * history['force'][59]:.3f} kN")
    path = options.output / "bar_impact.png"
    picture(history).savefig(path)
    print(path)


def picture(history):
    figure = plt.figure(figsize=(9.6, 3.4), layout="constrained")
    axes = figure.subplots(1, 3)
    times, smooth = 1e3 * history["time"], np.linspace(0, 6e-4, 1201)
    for axis, title, unit, exact, name in ((axes[0], "force of the wall", "kN", [1e-3 * hand.force(t) for t in smooth], "force"),
                                           (axes[1], "stress in the middle", "MPa", [1e-6 * hand.stress(0.5, t) for t in smooth], "stress")):
        axis.plot(1e3 * smooth, exact, color=pictures.GREY, lw=2.5, label="by hand")
        axis.plot(times, history[name] * (1e-3 if unit == "kN" else 1e-6), "o", ms=2.5, color=pictures.BLUE, label="run")
        axis.set(xlabel="time (ms)", ylabel=f"{title} ({unit})", title=title)
    axes[0].legend(loc="lower center")
    for x, name, label in ((0.0, "near", "end at the wall"), (0.5, "middle", "middle"), (1.0, "end", "free end")):
        exact = [1e3 * hand.displacement(x, t) for t in smooth]
        axes[2].plot(1e3 * smooth, exact, color=pictures.GREY, lw=2.5)
        axes[2].plot(times, 1e3 * history[name], "o", ms=2, color=pictures.BLUE)
        axes[2].text(0.28, 1e3 * hand.displacement(x, 2.8e-4) + (0.05 if x < 0.75 else -0.2), label, ha="center", fontsize=8)
    axes[2].set(xlabel="time (ms)", ylabel="displacement (mm)", title="three points of the bar", ylim=(-1.75, 0.1))
    for axis in axes:
        axis.grid(True)
    return figure


if __name__ == "__main__":
    main()
