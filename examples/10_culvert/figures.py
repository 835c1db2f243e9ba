#!/usr/bin/env python3
"""A pipe in an embankment: settlement with the super-elements, stress in the pipe, and the pressure of the soil on it."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
CENTRE = (0.0, 1.2)  # m, of the pipe, as in model.yaml
STEPS = {"weight": pictures.BLUE, "traffic": pictures.RED}


def main():
    options = pictures.options_of(__doc__, HERE, "culvert.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    model = summary["model"]
    print(f"{model['super_elements']} super-elements, {model['dofs']} degrees of freedom, {model['contact_pairs']} contact pairs")
    for number, increment in enumerate(summary["increments"], 1):
        wall, base = increment["contacts"]["wall"], increment["reactions"]["ground.base"][1]
        settlement = -pictures.fields(options.results, number).point_data["displacement"][:, 1].min()
        print(f"step {number}: {base / 1e3:.2f} kN/m on the base, {wall['normal_force'] / 1e3:.1f} kN/m on the pipe, {wall['open']} pairs "
              f"open, {wall['stick']} stick, {wall['slip']} slip; largest pressure {wall['max_pressure'] / 1e3:.0f} kPa, largest "
              f"settlement {1e3 * settlement:.1f} mm")
    path = options.output / "culvert.png"
    picture(options).savefig(path)
    print(path)


def hoop_stress(mesh):
    """Around the centre of the pipe, Pa."""
    x, y = (mesh.points[:, :2] - CENTRE).T
    xx, yy, xy = (pictures.values_of(mesh, f"stress_{component}") for component in ("xx", "yy", "xy"))
    return (xx * y**2 + yy * x**2 - 2 * xy * x * y) / (x**2 + y**2)


def picture(options):
    figure = plt.figure(figsize=(13.2, 4.6), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1.75, 1.05, 1]})
    mesh = pictures.fields(options.results, 2)
    drawn = pictures.draw(left, mesh, -1e3 * mesh.point_data["displacement"][:, 1], np.linspace(0, 45, 10))
    pictures.draw_cells(left, options.results)
    left.add_patch(plt.Polygon([(-15, -3.5), (-8, -5), (-1, -4), (-6, -2.2)], fill=False, linewidth=1.6, edgecolor=pictures.BLUE))
    left.annotate("soft clay", (-13, -3.9), (-18, -6.4), color=pictures.BLUE, bbox=pictures.BOX_ON_LINES,
                  arrowprops={"arrowstyle": "-", "lw": 0.8, "color": pictures.BLUE})
    pictures.colour_bar(figure, drawn, left, "settlement (mm)", count=4, location="bottom", shrink=0.7)
    left.set(title="weight and traffic: settlement, and the super-elements")

    drawn = pictures.draw(middle, mesh, 1e-6 * hoop_stress(mesh), pictures.signed_levels(3, bands=6), magnification=10)
    pictures.draw_cells(middle, options.results, 10)
    pictures.colour_bar(figure, drawn, middle, "hoop stress (MPa)", location="bottom", shrink=0.9)
    middle.set(xlim=(-1.45, 1.35), ylim=(-0.45, 2.25), title="the pipe: bending, and the soil around it")

    for number, (step, colour) in enumerate(STEPS.items(), 1):
        wall = pictures.pairs_of(options.results, number)["wall"]
        angle = np.degrees(np.arctan2(wall["x"] - CENTRE[0], wall["y"] - CENTRE[1]))
        order = np.argsort(angle)
        right.plot(angle[order], wall["pressure"][order] / 1e3, color=colour,
                   linestyle="--" if number == 1 else "-", label=f"after step {step}")
    right.set(xlabel="angle from the crown, clockwise (degrees)", ylabel="pressure of the soil on the pipe (kPa)", xlim=(-180, 180),
              xticks=range(-180, 181, 90), title="what the pipe carries")
    right.legend()
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
