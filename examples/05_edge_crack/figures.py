#!/usr/bin/env python3
"""Stress intensity factors of the edge-cracked plate for several crack lengths beside published ones, with the stress around
the tip; then the same crack under water pressure, in a laminate, and between two materials."""
import json
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
MODEL = HERE / "model.yaml"
CHECK = json.loads((HERE / "check.json").read_text(encoding="utf-8"))
STRESS = 1e6  # Pa

NO_PULL = "loads={water: {on: plate.flaw.left, pressure: 1e6}, also: {on: plate.flaw.right, pressure: 1e6}}"
LAMINATE = ("materials.steel={orthotropic: {E1: 140e9, E2: 10e9, E3: 10e9, nu12: 0.3, nu13: 0.3, nu23: 0.4, G12: 5e9, "
            "angle: 30}}")
BIMATERIAL = ["materials.glass={young: 21e9, poisson: 0.3}",
              "bodies.plate.shape={polygon: {vertices: [[0, 0], [1, 0], [1, 1], [1, 2], [0, 2], [0, 1.5]], "
              "names: {bottom: edge_1, low: edge_2, high: edge_3, top: edge_4, left: edge_6, bottom_right: vertex_2, "
              "top_right: vertex_4}}}"]


def geometry(h, a):
    """Settings for half-height h and crack length a; the width is 1."""
    return [f"bodies.plate.shape.rectangle.size=[1, {2 * h}]",
            f"bodies.plate.cracks=[{{tip: [{a}, {h}], mouth: [0, {h}], name: flaw}}]"]


def main():
    options = pictures.options_of(__doc__, HERE, "edge_crack.results")
    print(" h/W  a/W   dofs       K_I/(s sqrt(pi a))   published   difference")
    points = []
    for number, case in enumerate(CHECK["factors"]):
        h, a = case["h"], case["a"]
        summary = pictures.run(options.scabo, MODEL, options.results / f"case_{number}", *geometry(h, a))
        factor = crack_of(summary)["K_I"] / (STRESS * math.sqrt(math.pi * a))
        points.append((h, a, factor))
        print(f"{h:4} {a:4} {summary['model']['dofs']:6} {factor:20.5f} {case['factor']:13.5f} "
              f"{100 * (factor / case['factor'] - 1):9.4f} %")
    water = crack_of(pictures.run(options.scabo, MODEL, options.results / "water", NO_PULL))
    laminate = crack_of(pictures.run(options.scabo, MODEL, options.results / "laminate", LAMINATE))
    print(f"water pressure in the crack: K_I = {water['K_I'] / 1e6:.4f} MPa m^0.5")
    print(f"laminate at 30 degrees: K_I = {laminate['K_I'] / 1e6:.4f}, K_II = {laminate['K_II'] / 1e6:.4f} MPa m^0.5")
    path = options.output / "edge_crack.png"
    picture(options, points).savefig(path)
    print(path)


def crack_of(summary):
    return summary["increments"][-1]["cracks"]["plate.flaw"]


def picture(options, points):
    figure = plt.figure(figsize=(8.8, 4.8), layout="constrained")
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1, 1.25]})
    mesh = pictures.fields(options.results / "case_0")
    drawn = pictures.draw(left, mesh, pictures.values_of(mesh, "stress_yy", 1e-6), pictures.signed_levels(8, bands=16),
                          magnification=5e3)
    pictures.colour_bar(figure, drawn, left, "stress across the crack, $\\sigma_{yy}$ (MPa)", shrink=0.8)
    left.set_title("pull 1 MPa, a/W = %g" % CHECK["factors"][0]["a"])

    # Tada's fit for a long plate under uniform tension, 0.5 %.
    ratio = np.linspace(0.05, 0.65, 121)
    tangent = np.tan(np.pi * ratio / 2)
    fit = np.sqrt(2 / (np.pi * ratio) * tangent) * (0.752 + 2.02 * ratio + 0.37 * (1 - np.sin(np.pi * ratio / 2)) ** 3) \
        / np.cos(np.pi * ratio / 2)
    right.plot(ratio, fit, color=pictures.GREY, label="long plate, Tada's formula (0.5 %)")
    for case in CHECK["factors"]:
        right.plot(case["a"], case["factor"], "o", color=pictures.BLUE, markersize=9, markerfacecolor="none",
                   label="converged" if case is CHECK["factors"][0] else None)
    right.plot([a for _, a, _ in points], [factor for _, _, factor in points], "x", color=pictures.RED,
               label="Scabo, one super-element")
    right.annotate("h/W = 0.5", (0.5, points[1][2]), (0.36, points[1][2] + 0.25), arrowprops={"arrowstyle": "-", "lw": 0.6})
    right.set(xlabel="crack length a / width W", ylabel=r"$K_I / (\sigma \sqrt{\pi a})$", title="stress intensity factor")
    right.legend(loc="upper left")
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
