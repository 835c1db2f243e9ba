#!/usr/bin/env python3
"""The stop when it has been pushed, and the force of the pad over that of the jack."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
PUSHED = 18  # number of the increment at whose end the jack has passed 90 kN


def main():
    options = pictures.options_of(__doc__, HERE, "ratchet.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results, f"output.every={PUSHED}")
    figure = plt.figure(figsize=(10.6, 3.4), layout="constrained")
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1, 1.3]})
    mesh = pictures.fields(options.results, PUSHED)
    drawn = pictures.draw(left, mesh, np.clip(pictures.values_of(mesh, "stress_yy", 1e-6), -0.6, 0.6), np.linspace(-0.6, 0.6, 13))
    pictures.colour_bar(figure, drawn, left, "stress upwards, σyy (MPa)")
    left.set(title="pushed by 90 kN")
    jack = [one["factors"]["jack"] * 90 for one in summary["increments"]]
    pad = -pictures.table_of(options.results, "history.csv")["pad"] / 1e3
    by_hand = [force / 1e3 for force in hand.pads([1e3 * force for force in jack])]
    right.plot(jack, by_hand, "-", color=pictures.GREY, lw=1, label="by hand")
    right.plot(jack, pad, "o", ms=4, color=pictures.BLUE, label="run")
    right.set(xlabel="jack (kN)", ylabel="pad (kN)", title="force of the pad")
    right.legend()
    right.grid(True)
    path = options.output / "ratchet.png"
    figure.savefig(path)
    print(path)


if __name__ == "__main__":
    main()
