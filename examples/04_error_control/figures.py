#!/usr/bin/env python3
"""Draws the pictures of this page from runs of Cook's membrane: the mesh and the stress that a tolerance leads to, stress along
a section, and error against degrees of freedom beside equal elements."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
import running
from pictures import BLUE, GREY, RED, np, plt

HERE = pathlib.Path(__file__).resolve().parent
MODEL = HERE / "model.yaml"
TOLERANCES = ["1e-1", "3e-2", "1e-2", "3e-3", "1e-3", "3e-4", "1e-4"]
CORNERS = [[0, 0], [48, 44], [48, 60], [0, 44]]
EDGES = ", ".join(f"{{from: {CORNERS[k]}, to: {CORNERS[(k + 1) % 4]}, name: side_{k + 1}}}" for k in range(4))
EQUAL = {1: [16, 8, 4, 2, 1], 2: [16, 8, 4, 2, 1], 4: [32, 16, 8, 4, 2]}  # order: sizes


def main():
    options = pictures.options_of(__doc__, HERE, "error_control.results")
    refined = {}
    for tolerance in TOLERANCES:
        refined[tolerance] = run(options.scabo, options.results / f"tolerance_{tolerance}",
                                 f"bodies.panel.mesh.tolerance={tolerance}")
    equal = {order: [run(options.scabo, options.results / f"order_{order}_size_{size}",
                         f"bodies.panel.mesh={{size: {size}, order: {order}}}", "output.error=true")
                     for size in sizes] for order, sizes in EQUAL.items()}
    with_edges = run(options.scabo, options.results / "edges", f"output.lines=[{EDGES}]")
    for name, figure in {"stress": stress(with_edges), "section": section(refined["1e-3"]),
                         "convergence": convergence(refined, equal)}.items():
        path = options.output / f"{name}.png"
        figure.savefig(path)
        print(path)


class Run:
    def __init__(self, directory):
        self.directory = directory
        self.summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
        self.increment = self.summary["increments"][-1]
        self.dofs = self.summary["model"]["dofs"]
        self.energy = self.increment["energy"]["elastic"]


def run(scabo, directory, *settings):
    running.run(scabo, MODEL, directory, settings)
    return Run(directory)


def boundary_nodes(run):
    """Nodes of the super-element: the first points, up to the second ring of the output."""
    return pictures.scabo_plot.Results(run.directory).last_fields().points[: run.summary["model"]["nodes"]]


def stress(run):
    """Von Mises stress from grid.csv and, along the edges, lines.csv; and the boundary nodes that refinement left."""
    tables = [pictures.table_of(run.directory, "grid.csv"), pictures.table_of(run.directory, "lines.csv")]
    x, y, values = (np.concatenate([table[key] for table in tables]) for key in ("x", "y", "von_mises"))
    figure, axis = plt.subplots(figsize=(6.2, 5.8), layout="constrained")
    levels = np.linspace(0, 0.3, 16)
    drawn = axis.tricontourf(x, y, values, levels=levels, cmap=pictures.MAGNITUDE, extend="max")
    axis.plot(*np.array(CORNERS + CORNERS[:1]).T, color="black", linewidth=0.8)
    nodes = boundary_nodes(run)
    axis.plot(*nodes.T, ".", color=BLUE, markersize=4, clip_on=False)
    axis.plot([-0.7, -0.7], [-1, 45], color="black", linewidth=3)  # the wall, beside the nodes on the edge
    axis.annotate("", (50.2, 60), (50.2, 44), arrowprops={"arrowstyle": "-|>", "color": "black"})
    pictures.label_map(axis, unit="length")
    axis.set(xlim=(-2, 52.5), ylim=(-2, 62))
    pictures.colour_bar(figure, drawn, axis, "von Mises stress (force / length²)", count=6, shrink=0.8, aspect=25)
    return figure


def section(run):
    """Stress along the line from the bottom to the top at x = 24."""
    line = pictures.table_of(run.directory, "lines.csv")
    figure, axis = plt.subplots(figsize=(6.2, 3.2))
    figure.subplots_adjust(left=0.12, right=0.98, top=0.97, bottom=0.15)
    for key, colour, style in (("xx", RED, "-"), ("yy", GREY, "--"), ("xy", BLUE, ":")):
        axis.plot(line["y"], line[f"stress_{key}"], style, color=colour, label=f"$\\sigma_{{{key}}}$")
    axis.axhline(0, color="black", linewidth=0.6)
    axis.set(xlabel="y at x = 24 (length)", ylabel="stress (force / length²)", xlim=(22, 52))
    axis.grid(True)
    axis.legend()
    return figure


def convergence(refined, equal):
    """Estimated and true error against degrees of freedom. True: from the energy of the finest run, by 2 (U - U_h)."""
    finest = refined[TOLERANCES[-1]]
    exact = finest.energy / (1 - finest.increment["error"]["relative_energy_norm"] ** 2)
    true = lambda run: np.sqrt(1 - run.energy / exact)
    figure, axis = plt.subplots(figsize=(6.2, 4.2))
    figure.subplots_adjust(left=0.11, right=0.98, top=0.97, bottom=0.12)
    for (order, runs), marker in zip(equal.items(), "^sv"):
        axis.loglog([r.dofs for r in runs], [true(r) for r in runs], marker + "-", color=GREY, markersize=4, linewidth=0.8,
                    label=f"equal elements of order {order}, true")
    runs = [refined[t] for t in TOLERANCES]
    axis.loglog([r.dofs for r in runs], [r.increment["error"]["relative_energy_norm"] for r in runs], "o", color="white",
                markeredgecolor=RED, markersize=6, label="to a tolerance, estimated")
    axis.loglog([r.dofs for r in runs[:-1]], [true(r) for r in runs[:-1]], "o-", color=RED, markersize=3,
                label="to a tolerance, true")
    axis.set(xlabel="degrees of freedom", ylabel="error / energy norm of the displacement")
    axis.set_xticks([30, 50, 100, 200, 500], labels=["30", "50", "100", "200", "500"])
    axis.xaxis.set_minor_locator(plt.NullLocator())
    axis.grid(True, which="major")
    axis.legend()
    return figure


if __name__ == "__main__":
    main()
