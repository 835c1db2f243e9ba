#!/usr/bin/env python3
"""The retaining wall on soft and on stiff ground: displacement, and the thrust while friction in its base is lost."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
GROUNDS = {"ground": ("ground of 100 MPa", (), pictures.BLUE, "o-"),
           "rock": ("rock of 20 GPa", ("materials.ground.young=20e9",), pictures.RED, "^--")}


def main():
    options = pictures.options_of(__doc__, HERE, "retaining_wall.results")
    for directory, (name, settings, _, _) in GROUNDS.items():
        pictures.run(options.scabo, HERE / "model.yaml", options.results / directory, *settings)
        history = pictures.table_of(options.results / directory, "history.csv")
        print(f"{name}: thrust {history['thrust'][0] / 1e3:.2f} kN/m when built, {history['thrust'][-1] / 1e3:.2f} kN/m in the end; "
              f"the toe moves by {-1e3 * (history['toe'][-1]):.3f} mm")
    path = options.output / "retaining_wall.png"
    picture(options).savefig(path)
    print(path)


def picture(options):
    figure = plt.figure(figsize=(9.6, 3.9), layout="constrained")
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.25, 1]})
    mesh = pictures.fields(options.results / "ground", 11)
    drawn = pictures.draw(left, mesh, np.maximum(-1e3 * mesh.point_data["displacement"][:, 0], 0), np.linspace(0, 2.0, 9), magnification=100)
    pictures.colour_bar(figure, drawn, left, "displacement to the left (mm)", shrink=0.85)
    width = hand.H * np.tan(np.pi / 4 - hand.PHI / 2)
    left.fill([0, 4, 4, width], [0, 0, hand.H, hand.H], color="0.85", hatch="///", edgecolor="0.6", lw=0)
    left.set(xlim=(-7.1, 4.1), ylim=(-3.5, 4.7), title="wall and wedge just before the wall slides")

    numbers = hand.calculate()
    mu = np.linspace(0.3, 0.75, 50)
    right.plot(mu, mu * hand.WEIGHT / 1e3, color=pictures.GREY, lw=1, label="friction in the base, by hand")
    for at, text, beside in ((numbers["at_rest"], "at rest", (0, 2)), (numbers["active"], "active", (0, -11))):  # below the markers
        right.axhline(at / 1e3, color="black", lw=0.7)
        right.annotate(f"{text}, by hand", (0.74, at / 1e3), beside, textcoords="offset points")
    for directory, (name, _, colour, style) in GROUNDS.items():
        thrust = pictures.table_of(options.results / directory, "history.csv")["thrust"]
        right.plot(np.linspace(0.7, 0.345, len(thrust)), thrust / 1e3, style, ms=4, color=colour, label=f"run, on {name}")
    right.set(xlabel="coefficient of friction in the base", ylabel="thrust of the soil (kN/m)", xlim=(0.75, 0.3), ylim=(40, 105),
              title="thrust while friction is lost")
    right.legend(loc="upper right")
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
