#!/usr/bin/env python3
"""A wall of 400 blocks under its weight and a push: displaced blocks, and the forces between them."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from matplotlib.collections import LineCollection, PolyCollection
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
MAGNIFICATION = 500
STONE, LAST = "#e9e2d2", 3


def main():
    options = pictures.options_of(__doc__, HERE, "wall.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    model = summary["model"]
    print(f"{model['super_elements']} super-elements, {model['dofs']} degrees of freedom, {model['contact_pairs']} contact pairs, "
          f"{len(summary['increments'][0]['contacts'])} contacts")
    for increment in summary["increments"]:
        contacts = increment["contacts"].values()
        counts = [sum(contact[state] for contact in contacts) for state in ("open", "stick", "slip")]
        x, y = increment["reactions"]["ground"]
        print(f"push {increment['factors']['push']:.1f}: reaction {round(x / 1e3, 6) + 0.0:.6f}, {y / 1e3:.6f} kN; open, stick, slip {counts}; widest joint "
              f"{1e3 * max(contact['max_gap'] for contact in contacts):.4f} mm; certificate {max(increment['certificate'].values()):.1e}; "
              f"{increment['newton_iterations']} iterations")
    path = options.output / "wall.png"
    picture(options).savefig(path)
    print(path)


def forces_of(directory):
    """Middle, force and whether it slips, of every contact that carries one after the last increment. The sign of a force means
    nothing: its line of action is drawn."""
    forces = []
    for pairs in pictures.pairs_of(directory).values():
        x, y, normal, tangential = (pairs[key] for key in ("x", "y", "normal_force", "tangential_force"))
        if normal.sum() > 0:
            force = (tangential.sum(), normal.sum()) if np.ptp(y) < np.ptp(x) else (normal.sum(), -tangential.sum())
            middle = (normal @ x / normal.sum(), normal @ y / normal.sum())
            forces.append((middle, force, (pairs["state"] != "stick").all()))
    return forces


def picture(options):
    figure = plt.figure(figsize=(13.2, 4.0), layout="constrained")
    left, right = figure.subplots(1, 2)
    mesh = pictures.fields(options.results, LAST)
    sides = pictures.outline(pictures.triangles_of(mesh))
    for axis, magnification in ((left, MAGNIFICATION), (right, 0)):
        moved = pictures.moved_points(mesh, magnification)
        blocks = [moved[pictures.geometry.nodes_on(sides, first)] for first in np.flatnonzero(np.diff(mesh.point_data["body"], prepend=0))]
        axis.add_collection(PolyCollection(blocks, facecolors=STONE, edgecolors="black" if magnification else "0.75", linewidths=0.5))
        pictures.label_map(axis, magnification)
        axis.set(xlim=(-0.7, 11.2), ylim=(-0.6, 5.5))
    left.set(title="a push of 0.4 of the weight, to the right: displaced blocks")

    forces = forces_of(options.results)
    largest = max(np.hypot(*force) for _, force, _ in forces)
    for slipping, colour in ((False, pictures.BLUE), (True, pictures.RED)):
        chosen = [(np.array(middle), np.array(force)) for middle, force, slips in forces if slips == slipping]
        lines = [(middle - 0.125 * force / np.hypot(*force), middle + 0.125 * force / np.hypot(*force)) for middle, force in chosen]
        right.add_collection(LineCollection(lines, colors=colour, linewidths=[0.3 + 7 * np.hypot(*force) / largest for _, force in chosen],
                                            label="slips" if slipping else "sticks"))
    right.set(title=f"forces between the blocks: direction; width, at most {largest / 1e3:.0f} kN")
    legend = right.legend(loc="upper right", ncols=2, bbox_to_anchor=(0.97, 1.02))
    for line in legend.get_lines():
        line.set_linewidth(3)
    return figure


if __name__ == "__main__":
    main()
