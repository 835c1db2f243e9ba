#!/usr/bin/env python3
"""A dam and its foundation from one Gmsh mesh: the mesh, the stress under a flood, and the pressure along the joint."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
STATES = {1: ("weight", pictures.GREY, "-"), 3: ("full reservoir", pictures.BLUE, "-"), 7: ("flood, 1.4 times its pressure", pictures.RED, "--")}


def main():
    options = pictures.options_of(__doc__, HERE, "dam.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    model = summary["model"]
    print(f"{model['super_elements']} super-elements, {model['dofs']} degrees of freedom, {model['contact_pairs']} contact pairs")
    for number, (name, _, _) in STATES.items():
        joint = summary["increments"][number - 1]["contacts"]["joint"]
        print(f"{name}: normal force {joint['normal_force'] / 1e3:.2f} kN/m, tangential {round(joint['tangential_force'] / 1e3, 2) + 0.0:.2f} kN/m; "
              f"{joint['open']} pairs open, {joint['stick']} stick, {joint['slip']} slip; widest {1e3 * joint['max_gap']:.3f} mm")
    path = options.output / "gravity_dam.png"
    picture(options, summary).savefig(path)
    print(path)


def picture(options, summary):
    figure = plt.figure(figsize=(13.2, 4.6), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1.35, 1.15, 1]})
    mesh = pictures.fields(options.results, len(summary["increments"]))
    drawn = pictures.draw(left, mesh, 1e3 * mesh.point_data["displacement"][:, 0], np.linspace(0, 1, 11))
    pictures.draw_cells(left, options.results)
    left.annotate("weak layer", (20, -6), (9, -16.5), color="black", bbox=pictures.BOX_ON_LINES, arrowprops={"arrowstyle": "-", "lw": 0.8})
    pictures.colour_bar(figure, drawn, left, "horizontal displacement (mm)", count=6, location="bottom", shrink=0.8)
    left.set(title="flood: displacement, and the cells of dam.msh")

    drawn = pictures.draw(middle, mesh, pictures.values_of(mesh, "stress_yy", 1e-6), pictures.signed_levels(0.8, bands=8),
                          magnification=500)
    pictures.colour_bar(figure, drawn, middle, "vertical stress (MPa)", location="bottom", shrink=0.9)
    middle.set(xlim=(-5, 21), ylim=(-5, 22), title="flood: stress")

    for number, (name, colour, style) in list(STATES.items())[1:]:
        joint = pictures.pairs_of(options.results, number)["joint"]
        right.plot(joint["x"], joint["pressure"] / 1e6, style, color=colour, label=name)
    right.set(xlabel="distance from the heel (m)", ylabel="pressure (MPa)", xlim=(0, 15), ylim=(0, 0.8), title="pressure along the joint")
    right.legend()
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
