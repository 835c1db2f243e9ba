#!/usr/bin/env python3
"""The sheet-pile wall: displacement after the excavation, pressures on both sides of the wall."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent


def main():
    options = pictures.options_of(__doc__, HERE, "sheet_pile.results")
    pictures.run(options.scabo, HERE / "model.yaml", options.results)
    history, by_hand = pictures.table_of(options.results, "history.csv"), hand.calculate()
    print(f"thrust behind the wall {history['back'][0] / 1e3:.1f} kN/m at rest, by hand {by_hand['back'] / 1e3:.1f}; {history['back'][-1] / 1e3:.1f} at the end")
    path = options.output / "sheet_pile.png"
    picture(options).savefig(path)
    print(path)


def picture(options):
    figure = plt.figure(figsize=(9.6, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.4, 1.0]})
    mesh = pictures.fields(options.results, 9)
    size = 1e3 * np.hypot(*mesh.point_data["displacement"][:, :2].T)
    drawn = pictures.draw(left, mesh, size, np.linspace(0, 32, 9), magnification=50)
    pictures.colour_bar(figure, drawn, left, "displacement (mm)", shrink=0.9)
    left.set(xlim=(-14, 16), ylim=(-18, 1), title="after the excavation")
    depth = np.linspace(0, hand.DEPTH, 2)
    right.plot(hand.K0 * hand.GAMMA * depth / 1e3, -depth, color=pictures.GREY, label="at rest, by hand")
    pairs = pictures.pairs_of(options.results)
    for name, colour in (("back", pictures.BLUE), ("front", pictures.RED)):
        order = np.argsort(pairs[name]["y"])
        right.plot(pairs[name]["pressure"][order] / 1e3, pairs[name]["y"][order], color=colour, label=f"{name}, at the end")
    right.set(xlabel="pressure on the wall (kPa)", ylabel="y (m)", xlim=(0, 170), title="both sides of the wall")
    right.legend()
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
