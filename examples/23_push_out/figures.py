#!/usr/bin/env python3
"""The bar half out of the jaws, and the force along the way, pushed and pulled."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
HALF_WAY = 20  # number of the increment that ends at 40 mm


def main():
    options = pictures.options_of(__doc__, HERE, "push_out.results")
    pulled = options.results.with_name(options.results.name + "_pulled")
    pictures.run(options.scabo, HERE / "model.yaml", options.results)
    pictures.run(options.scabo, HERE / "model.yaml", pulled, "supports.3.on=bar.right")
    figure = plt.figure(figsize=(10.6, 3.2), layout="constrained")
    left, right = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.5, 1]})
    mesh = pictures.fields(options.results, HALF_WAY)
    drawn = pictures.draw(left, mesh, np.maximum(pictures.values_of(mesh, "stress_yy", -1e-6), 0),
                          np.linspace(0, 160, 9), magnification=1, factor=1e3, unit="mm")
    pictures.colour_bar(figure, drawn, left, r"pressure across, $-\sigma_{yy}$ (MPa)", location="bottom", shrink=0.9)
    left.set(title="pushed by 40 mm (upper half)")
    for results, pushed, colour in ((options.results, True, pictures.BLUE), (pulled, False, pictures.RED)):
        force = 2 * pictures.table_of(results, "history.csv")["force"][3:]
        way = np.linspace(0, 80e-3, len(force))
        right.plot(1e3 * way, force / 1e3, "o", ms=3, color=colour, label="pushed, run" if pushed else "pulled, run")
        right.plot(1e3 * way, [hand.force(s, pushed) / 1e3 for s in way], "-" if pushed else "--", color=colour, lw=1, label="by hand")
    right.set(xlabel="way (mm)", ylabel="force (kN)", ylim=(0, 180), title="force to move the bar")
    right.legend()
    right.grid(True)
    path = options.output / "push_out.png"
    figure.savefig(path)
    print(path)


if __name__ == "__main__":
    main()
