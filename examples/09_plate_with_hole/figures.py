#!/usr/bin/env python3
"""The plate with a hole as polygons and as a quadtree: stress around the hole with the cells, stress from the hole to the edge, and
a table of finer and finer meshes."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
MODEL = HERE / "model.yaml"
CHECK = json.loads((HERE / "check.json").read_text(encoding="utf-8"))
STRESS, RADIUS, HALF_WIDTH = 100e6, 0.03, 0.1  # Pa, m, m, as in model.yaml
KINDS = {"polygons": pictures.BLUE, "quadtree": pictures.RED}


def main():
    options = pictures.options_of(__doc__, HERE, "plate_with_hole.results")
    print("  at the hole   elsewhere   kind       cells    dofs   factor   difference")
    for at_hole in (0.012, 0.006, 0.003):
        for kind in KINDS:
            summary, factor = solve(options, f"{kind}_{at_hole}", kind, at_hole)
            print(f"{1e3 * at_hole:10.0f} mm {5e3 * at_hole:8.0f} mm   {kind:9} {summary['model']['super_elements']:6} "
                  f"{summary['model']['dofs']:7} {factor:8.4f} {100 * (factor / CHECK['converged'] - 1):10.3f} %")
    path = options.output / "plate_with_hole.png"
    picture(options).savefig(path)
    print(path)


def solve(options, name, kind, at_hole):
    """The summary, and the stress at the hole over that at the ends."""
    summary = pictures.run(options.scabo, MODEL, options.results / name,
                           f"bodies.plate.mesh={{kind: {kind}, size: {5 * at_hole}, order: 3, refine: [{{on: bore, size: {at_hole}}}]}}")
    return summary, pictures.table_of(options.results / name, "points.csv")["stress_xx"][0] / STRESS


def picture(options):
    figure = plt.figure(figsize=(13.2, 4.2), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1, 1, 1.05]})
    for axis, kind in ((left, "polygons"), (middle, "quadtree")):
        mesh = pictures.fields(options.results / f"{kind}_0.006")
        drawn = pictures.draw(axis, mesh, pictures.values_of(mesh, "von_mises", 1e-6), np.linspace(0, 360, 19))
        pictures.draw_cells(axis, options.results / f"{kind}_0.006")
        axis.set(xlim=(0.197, 0.403), ylim=(-0.003, 0.203), title=f"kind: {kind}")
    pictures.colour_bar(figure, drawn, [left, middle], "von Mises stress (MPa)", shrink=0.85)

    for kind, style in (("polygons", "-"), ("quadtree", "--")):
        line = pictures.table_of(options.results / f"{kind}_0.006", "lines.csv")
        right.plot((line["y"] - HALF_WIDTH) / RADIUS, line["stress_xx"] / STRESS, style, color=KINDS[kind], label=f"kind: {kind}")
    r = np.linspace(1, HALF_WIDTH / RADIUS, 121)
    right.plot(r, 1 + 0.5 / r**2 + 1.5 / r**4, ":", color=pictures.GREY, label="infinite plate (Kirsch)")
    right.plot(1, CHECK["howland"], "o", color="black", markersize=7, markerfacecolor="none", label="Howland, d/W = 0.3: 3.36")
    right.set(xlabel="distance from the centre of the hole / its radius", ylabel="$\\sigma_{xx}$ / stress at the ends",
              title="from the hole to the edge", ylim=(0, 3.6))
    right.legend()
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
