#!/usr/bin/env python3
"""Concrete from an image: the quadtree, vertical and horizontal stress, and the effective modulus between its bounds."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from matplotlib.patches import Rectangle
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
SIDE, THICKNESS, STRAIN = 0.128, 0.1, 0.5e-3  # m, m, as in model.yaml
MORTAR, GRAVEL = 20e9, 60e9  # Pa
ZOOM = 70, 42, 30  # mm: corner and side of the square that is drawn large


def main():
    options = pictures.options_of(__doc__, HERE, "concrete.results")
    image = np.flipud(plt.imread(HERE / "section.png"))
    share = float((image > 0.5).mean())
    print(f"aggregate {share:.6f}; modulus, GPa: Reuss {1e-9 / (share / GRAVEL + (1 - share) / MORTAR):.4f}, "
          f"Voigt {1e-9 * (share * GRAVEL + (1 - share) * MORTAR):.4f}")
    for order in (1, 2):
        summary = pictures.run(options.scabo, HERE / "model.yaml", options.results / f"order_{order}", f"bodies.specimen.mesh.order={order}")
        base, plate = (summary["increments"][-1]["reactions"][name][1] for name in ("base", "plate"))
        print(f"order {order}: {summary['model']['super_elements']} super-elements, {summary['model']['dofs']} degrees of freedom, {base / 1e3:.3f} kN "
              f"and {plate / 1e3:.3f} kN, modulus {1e-9 * base / (SIDE * THICKNESS * STRAIN):.4f} GPa, {summary['timing']['total']:.1f} s")
    path = options.output / "concrete.png"
    picture(options.results / "order_2", image).savefig(path)
    print(path)


def picture(results, image):
    figure = plt.figure(figsize=(13.2, 4.0), layout="constrained")
    (left, zoom, middle, right), bars = figure.subplots(2, 4, gridspec_kw={"height_ratios": [22, 1]})
    mesh = pictures.fields(results)
    mesh.points = 1e3 * mesh.points
    extent = (0, 1e3 * SIDE, 0, 1e3 * SIDE)
    x, y, side = ZOOM
    for axis in (left, zoom):
        axis.imshow(1 - 0.45 * image, extent=extent, origin="lower", cmap="gray", vmin=0, vmax=1, interpolation="nearest")
    pictures.draw_cells(zoom, results, factor=1e3)
    left.add_patch(Rectangle((x, y), side, side, fill=False, edgecolor=pictures.RED, linewidth=1.5))
    zoom.set(xlim=(x, x + side), ylim=(y, y + side), title="cells in the red square")
    left.set(title="section.png: gravel (dark), mortar")

    vertical = pictures.draw(middle, mesh, -pictures.values_of(mesh, "stress_yy", 1e-6), np.linspace(8, 32, 13))
    horizontal = pictures.draw(right, mesh, pictures.values_of(mesh, "stress_xx", 1e-6), pictures.signed_levels(4, bands=8))
    middle.set(title="vertical compression")
    right.set(title="horizontal stress")
    for axis in (middle, right):
        axis.contour(image, levels=[0.5], extent=extent, colors="black", linewidths=0.35)
        axis.set(xlim=(-2, 130), ylim=(-2, 130))
    for axis in (left, zoom, middle, right):
        pictures.label_map(axis, unit="mm")
    for bar in bars[:2]:
        bar.set_axis_off()
    figure.colorbar(vertical, cax=bars[2], orientation="horizontal", label="vertical compression (MPa)", ticks=range(8, 33, 4))
    figure.colorbar(horizontal, cax=bars[3], orientation="horizontal", label="horizontal stress (MPa)",
                    ticks=np.linspace(*horizontal.levels[[0, -1]], 5))
    return figure


if __name__ == "__main__":
    main()
