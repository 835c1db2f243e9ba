#!/usr/bin/env python3
"""Error against degrees of freedom, refined for a tolerance and with equal cells: a re-entrant corner and a contact of Hertz.

    benchmarks/adaptive/run.py --scabo build/bin/scabo -o benchmarks/adaptive

prints a table and draws adaptive.png. The error is that in the energy norm, from the energy: at the corner against one
super-element with its scaling centre there (order 12), under the cylinder against cubic polygons refined to 3e-4."""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "examples"))

CORNER = """scabo: 1
analysis: {type: static, plane: strain}
materials: {steel: {young: 1e3, poisson: 0.3}}
bodies:
  part:
    material: steel
    shape:
      polygon:
        vertices: [[-1, -1], [0, -1], [0, 0], [1, 0], [1, 1], [-1, 1]]
        names: {bottom: edge_1, right: edge_4, left: edge_6}
    mesh: {size: 0.25, order: 12, centre: [0, 0]}
supports: [{on: part.bottom, fix: y}, {on: part.left, fix: x}]
loads: {pull: {on: part.right, traction: [1, 0]}}
"""
HERTZ = """scabo: 1
analysis: {type: static, plane: strain}
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies:
  part:
    material: steel
    shape: {rectangle: {corner: [-1, -1], size: [2, 1]}}
    mesh: {kind: polygons, size: 0.25, order: 3, tolerance: 3e-4}
  cylinder:
    rigid: true
    shape: {outline: [{arc: {from: [-1, 1], to: [1, 1], centre: [0, 1]}, name: tread}, {line: {to: [-1, 1]}}]}
supports: [{on: part.bottom, fix: [x, y]}, {on: cylinder, displacement: [0, -0.003]}]
contacts: {joint: {between: [part.top, cylinder.tread], friction: 0}}
"""
TOLERANCES = {1: (0.1, 0.05, 0.025, 0.0125), 2: (0.1, 0.03, 0.01, 3e-3, 1e-3)}
SIZES = {1: (0.5, 0.25, 0.125, 0.0625, 0.03125), 2: (0.5, 0.25, 0.125, 0.0625, 0.03125)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scabo", default="scabo", help="the program (default: scabo on the PATH)")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=HERE, metavar="DIR",
                        help="where the picture goes (default: %(default)s)")
    options = parser.parse_args()
    rows = {}
    print("| problem | cells | order | degrees of freedom | error | estimated | s |")
    print("|---|---|---|---|---|---|---|")
    for name, model in (("corner", CORNER), ("Hertz", HERTZ)):
        exact = solve(options.scabo, model)["energy"]
        for order in (1, 2):
            for kind, cells, values in (("quadtree", "equal squares", SIZES), ("quadtree", "quadtree, refined", TOLERANCES),
                                        ("polygons", "polygons, refined", TOLERANCES)):
                for value in values[order][:3 if values is TOLERANCES and (name, order) == ("Hertz", 1) else None]:
                    key = f"size: {value}" if values is SIZES else f"size: 0.5, tolerance: {value}"
                    found = solve(options.scabo, model, f"bodies.part.mesh={{kind: {kind}, order: {order}, {key}}}")
                    error = math.sqrt(abs(found["energy"] / exact - 1.0))
                    rows.setdefault((name, order, cells), []).append((found["dofs"], error, found["estimate"]))
                    print(f"| {name} | {cells} | {order} | {found['dofs']} | {error:.2e} | {found['estimate']:.2e} | "
                          f"{found['seconds']:.2f} |", flush=True)
    draw(rows, options.output / "adaptive.png")


def solve(scabo, model, *settings):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "model.yaml"
        path.write_text(model + "output: {error: true, fields: []}\n", encoding="utf-8")
        command = [scabo, "run", str(path), "-o", f"{folder}/results", "--quiet", "--threads", "1"]
        for setting in settings:
            command += ["--set", setting]
        done = subprocess.run(command, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            sys.exit(f"failed: {' '.join(command)}\n{done.stderr}")
        summary = json.loads((pathlib.Path(folder) / "results" / "summary.json").read_text(encoding="utf-8"))
    last = summary["increments"][-1]
    return {"dofs": summary["model"]["dofs"], "energy": last["energy"]["elastic"],
            "estimate": last["error"]["relative_energy_norm"], "seconds": summary["timing"]["total"]}


def draw(rows, path):
    from pictures import BLUE, GREEN, RED, plt
    styles = {"equal squares": (RED, "s"), "quadtree, refined": (BLUE, "o"), "polygons, refined": (GREEN, "^")}
    figure, all_axes = plt.subplots(1, 2, figsize=(8.4, 4.4), sharey=True, layout="constrained")
    titles = {"corner": "Re-entrant corner, exponent 0.5445", "Hertz": "Rigid cylinder on a block"}
    for axes, (name, title) in zip(all_axes, titles.items()):
        for (problem, order, cells), points in rows.items():
            if problem != name:
                continue
            colour, marker = styles[cells]
            axes.loglog([p[0] for p in points], [p[1] for p in points], marker=marker, ms=4, color=colour,
                        ls="-" if order == 2 else "--", label=f"{cells}, order {order}")
        for order, start in ((1, (130, 6e-3)), (2, (130, 2e-3))):
            ends = (start[0], 4 * start[0])
            axes.loglog(ends, (start[1], start[1] * 4 ** (-order / 2)), color="0.4", lw=0.9)
            axes.annotate(f"{'−1/2' if order == 1 else '−1'}", (ends[1], start[1] * 4 ** (-order / 2)), fontsize=8,
                          color="0.3", xytext=(3, 0), textcoords="offset points", va="center")
        axes.set(xlabel="degrees of freedom", title=title, xlim=(20, 6e4), ylim=(2e-4, 1.5))
        axes.grid(True)
    all_axes[0].set_ylabel("error in the energy norm, relative")
    figure.legend(*all_axes[0].get_legend_handles_labels(), loc="lower center", ncol=3)
    figure.get_layout_engine().set(rect=(0, 0.13, 1, 0.87))
    figure.savefig(path)


if __name__ == "__main__":
    main()
