#!/usr/bin/env python3
"""The lining of the tunnel: hoop stress, and thrust and moment between full slip and no slip."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
FRICTION = (0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5)
BONDED = "contacts.interface={between: [ground.rim, lining.rim], bond: true}"


def main():
    options = pictures.options_of(__doc__, HERE, "tunnel_lining.results")
    runs = {mu: last_of(options, f"friction_{mu}", f"contacts.interface.friction={mu}") for mu in FRICTION}
    runs["bond"] = last_of(options, "bond", BONDED)
    for mu, row in runs.items():
        print(f"friction {mu}: side {row['side.normal'] / 1e3:.2f} kN, {row['side.moment'] / 1e3:.3f} kN m; "
              f"crown {row['crown.normal'] / 1e3:.2f} kN, {row['crown.moment'] / 1e3:.3f} kN m")
    path = options.output / "tunnel_lining.png"
    picture(options, runs).savefig(path)
    print(path)


def last_of(options, directory, *settings):
    """The last row of history.csv."""
    pictures.run(options.scabo, HERE / "model.yaml", options.results / directory, *settings)
    return {name: values[-1] for name, values in pictures.table_of(options.results / directory, "history.csv").items()}


def picture(options, runs):
    figure = plt.figure(figsize=(10.6, 3.5), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1.25, 1, 1]})
    mesh = pictures.fields(options.results / "friction_0.2", 4)
    x, y = mesh.points[:, 0], mesh.points[:, 1]
    xx, yy, xy = (mesh.point_data[f"stress_{name}"].astype(float) for name in ("xx", "yy", "xy"))
    hoop = (xx * y**2 + yy * x**2 - 2 * xy * x * y) / np.maximum(x**2 + y**2, 1e-12)
    drawn = pictures.draw(left, mesh, hoop / 1e6, pictures.signed_levels(7, bands=7), magnification=100)
    pictures.colour_bar(figure, drawn, left, "hoop stress (MPa)", shrink=0.9)
    left.set(xlim=(-4.2, 4.2), ylim=(-4.2, 4.2), title="friction 0.2")

    numbers = hand.calculate()
    for axis, what, factor, unit in ((middle, "thrust", -1e-3, "thrust, compression positive (kN/m)"), (right, "moment", 1e-3, "moment (kN m/m)")):
        for place, colour, mark in (("side", pictures.BLUE, "o-"), ("crown", pictures.RED, "^--")):
            column = f"{place}.{'normal' if what == 'thrust' else 'moment'}"
            axis.plot(FRICTION, [factor * runs[mu][column] for mu in FRICTION], mark, ms=4, color=colour, label=place)
            for kind, span in (("slip", (0, 0.12)), ("no_slip", (0.38, 0.5))):
                axis.plot(span, 2 * [factor * numbers[f"{kind}_{place}_{what}_elasticity"]], color="black", lw=0.9)
        axis.plot([], [], color="black", lw=0.9, label="closed form: full slip, no slip")
        axis.set(xlabel="coefficient of friction", ylabel=unit, xlim=(-0.01, 0.51))
        axis.grid(True)
    right.legend(loc="center")
    middle.set(title="thrust in the lining", ylim=(500, 1150))
    right.set(title="moment in the lining")
    return figure


if __name__ == "__main__":
    main()
