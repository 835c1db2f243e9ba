#!/usr/bin/env python3
"""A cracked disc under a diametral load: stress with the cells, the cell at a tip, and stress intensity factors against the angle."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
MODEL = HERE / "model.yaml"
CASES = json.loads((HERE / "check.json").read_text(encoding="utf-8"))["cases"]
FORCE, RADIUS, THICKNESS = 20e3, 0.05, 0.02  # N, m, m, as in model.yaml
STYLES = {0.3: "-", 0.5: "--"}
MAGNIFICATION = 50


def main():
    options = pictures.options_of(__doc__, HERE, "brazilian_disc.results")
    print(" a/R    angle   degrees of freedom      N_I      digits      N_II     digits")
    for case in CASES:
        summary, first, second = solve(options, case["a_over_R"], case["angle"])
        print(f"{case['a_over_R']:4} {case['angle']:8.3f} {summary['model']['dofs']:12} {first:16.6f} {case['N_I']:10.6f} {second:10.6f} "
              f"{case['N_II']:10.6f}")
    curves = {}
    for ratio in STYLES:
        last = next(case["angle"] for case in CASES if case["a_over_R"] == ratio and case["angle"] and not case["N_I"])
        angles = np.linspace(0, last, 12)
        curves[ratio] = angles, np.array([solve(options, ratio, angle)[1:] for angle in angles])
    path = options.output / "brazilian_disc.png"
    picture(options, curves).savefig(path)
    print(path)


def solve(options, ratio, angle):
    """The summary, N_I and |N_II| of the tip at the end."""
    a = ratio * RADIUS
    x, y = a * np.sin(np.radians(angle)), a * np.cos(np.radians(angle))
    near = f"{{near: [{x:.15g}, {y:.15g}], size: 0.005}}, {{near: [{-x:.15g}, {-y:.15g}], size: 0.005}}"
    summary = pictures.run(options.scabo, MODEL, options.results / f"{ratio}_{angle:.3f}",
                           f"bodies.disc.cracks.0.path=[[{-x:.15g}, {-y:.15g}], [{x:.15g}, {y:.15g}]]", f"bodies.disc.mesh.refine=[{near}]")
    tip = summary["increments"][-1]["cracks"]["disc.flaw.end"]
    unit = FORCE / (np.pi * RADIUS * THICKNESS) * np.sqrt(np.pi * a)
    return summary, tip["K_I"] / unit, abs(tip["K_II"]) / unit


def picture(options, curves):
    figure = plt.figure(figsize=(13.2, 4.9), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1, 1, 1.05]})
    mesh = pictures.fields(options.results / "0.3_15.000")
    mesh.points = 1e3 * mesh.points
    mesh.point_data["displacement"] = 1e3 * mesh.point_data["displacement"]
    stress = pictures.values_of(mesh, "stress_xx", 1e-6)
    for axis, magnification in ((left, 0), (middle, MAGNIFICATION)):
        drawn = pictures.draw(axis, mesh, stress, pictures.signed_levels(20, bands=10), magnification)
        pictures.label_map(axis, magnification, unit="mm")
    pictures.draw_cells(left, options.results / "0.3_15.000", factor=1e3)
    for sign in (1, -1):
        left.annotate("", (0, 50 * sign), (0, 62 * sign), arrowprops={"arrowstyle": "-|>", "color": "black", "lw": 1.4})
    left.text(3, 55, "20 kN")
    left.set(xlim=(-53, 53), ylim=(-64, 64), title="the disc, $a/R$ = 0.3 at 15 degrees, and its cells")
    middle.set(xlim=(-15, 15), ylim=(-22, 16), title="the crack opens and slides")
    pictures.colour_bar(figure, drawn, [left, middle], "horizontal stress (MPa)", location="bottom", shrink=0.6)

    for ratio, (angles, factors) in curves.items():
        for mode, name, colour in ((0, "N_I", pictures.RED), (1, "N_{II}", pictures.BLUE)):
            right.plot(angles, factors[:, mode], STYLES[ratio], color=colour, label=f"${name}$, $a/R$ = {ratio}")
    for mode in ("N_I", "N_II"):
        right.plot([case["angle"] for case in CASES], [case[mode] for case in CASES], "o", color="black", markersize=6, markerfacecolor="none",
                   label="dislocations" if mode == "N_I" else None)
    right.set(xlabel="angle between crack and load (degrees)", ylabel=r"$K \;/\; (P / (\pi R t) \sqrt{\pi a})$", xlim=(-0.8, 30), ylim=(-0.08, 2.5),
              title="stress intensity factors, until the crack closes")
    right.legend(ncols=2, loc="upper left")
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
