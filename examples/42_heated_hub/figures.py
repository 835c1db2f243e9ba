#!/usr/bin/env python3
"""The heated hub: stress when hot, normal force of the fit and torque over the steps."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent


def main():
    options = pictures.options_of(__doc__, HERE, "heated_hub.results")
    pictures.run(options.scabo, HERE / "model.yaml", options.results)
    history, by_hand = pictures.table_of(options.results, "history.csv"), hand.calculate()
    print(f"normal force {history['pressing'][0] / 1e3:.3f} kN, by hand {by_hand['force'] / 1e3:.3f}; torque {-history['torque'][3]:.2f} N m, by hand {by_hand['torque']:.2f}")
    path = options.output / "heated_hub.png"
    picture(options, history).savefig(path)
    print(path)


def picture(options, history):
    figure = plt.figure(figsize=(9.6, 3.8), layout="constrained")
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.0, 1.2]})
    mesh = pictures.fields(options.results, 1)
    drawn = pictures.draw(left, mesh, pictures.values_of(mesh, "von_mises", 1e-6), np.linspace(0, 80, 9), factor=1e3, unit="mm")
    pictures.colour_bar(figure, drawn, left, "von Mises stress (MPa)", shrink=0.9)
    left.set(title="pressed on")
    by_hand = hand.calculate()
    right.plot(history["time"], history["pressing"] / 1e3, "o-", ms=4, color=pictures.BLUE, label="normal force (kN)")
    right.plot(history["time"], -history["torque"] / 4, "s-", ms=4, color=pictures.RED, label="torque (4 N m)")
    right.axhline(by_hand["force"] / 1e3, color=pictures.GREY, lw=1, label="by hand")
    right.axhline(by_hand["torque"] / 4, color=pictures.GREY, lw=1)
    right.set(xlabel="time, in steps: turned from 1 to 2, heated from 2 to 3", ylim=(-10, 230), title="the fit loosens as it is heated from inside")
    right.legend(loc="lower left")
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
