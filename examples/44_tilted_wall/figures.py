#!/usr/bin/env python3
"""The tilted wall: displacements at its last equilibrium, magnified, with the joints that open."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent


def main():
    options = pictures.options_of(__doc__, HERE, "tilted_wall.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    limit, by_hand = summary["limit"], hand.calculate()["limit"]
    print(f"limit {limit['solved']:.5f} to {limit['beyond']:.5f}, by hand {by_hand:.5f}")
    path = options.output / "tilted_wall.png"
    picture(options).savefig(path)
    print(path)


def picture(options):
    figure, axis = plt.subplots(figsize=(6.4, 5.0), layout="constrained")
    results = pictures.scabo_plot.Results(options.results)
    mesh = results.fields(results.count)
    magnification = pictures.geometry.magnification(mesh, part=0.09)
    size = 1e6 * np.hypot(*mesh.point_data["displacement"][:, :2].T)
    drawn = pictures.draw(axis, mesh, size, np.linspace(0, float(np.ceil(size.max())), 9), magnification=magnification)
    pictures.colour_bar(figure, drawn, axis, "displacement (µm)", shrink=0.85)
    axis.set(title="the last equilibrium: joints open along steps")
    return figure


if __name__ == "__main__":
    main()
