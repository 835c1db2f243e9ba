"""What the examples' pictures have in common: running scabo, and maps in the style of `scabo plot`, whose package reads the results and
draws.

Signed quantities have colours that diverge from white at zero (red: tension, blue: compression), and lines that are dashed below
zero; others go from light to dark. Axes name their quantity and unit; a map of a deformed body says how much it is magnified."""
import argparse
import importlib
import json
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as error:
    sys.exit(f"{error}: the pictures need NumPy and Matplotlib (apt install python3-matplotlib, and /usr/bin/python3)")
import running

ROOT = pathlib.Path(__file__).resolve().parents[1]
# The package for pictures: in the sources, or beside the examples where Scabo is installed.
FOLDER, NAME = (ROOT / "python" / "scabo", "plot") if (ROOT / "python").exists() else (ROOT, "scabo_plot")
sys.path.append(str(FOLDER))
scabo_plot = importlib.import_module(NAME)
geometry, style = (importlib.import_module(f"{NAME}.{part}") for part in ("geometry", "style"))

style.apply()
plt.rcParams["savefig.dpi"] = 130

BLUE, RED, GREEN, GREY = style.BLUE, style.RED, style.GREEN, style.GREY
SIGNED, MAGNITUDE = style.SIGNED, style.MAGNITUDE
BOX_ON_LINES = style.BOX_ON_LINES
triangles_of, outline, moved_points, signed_levels = geometry.triangles, geometry.outline, geometry.moved, style.signed_levels


def options_of(description, example, results):
    """--scabo, -o and --results of a figures.py."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--scabo", default="scabo", help="the program (default: scabo on the PATH)")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=example / "figures", metavar="DIR",
                        help="where the pictures go (default: %(default)s)")
    parser.add_argument("--results", type=pathlib.Path, default=pathlib.Path(results), metavar="DIR",
                        help="where the results of the runs go (default: %(default)s)")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    return options


def run(scabo, model, directory, *settings):
    """The summary."""
    running.run(scabo, model, directory, settings)
    return json.loads((directory / "summary.json").read_text(encoding="utf-8"))


def fields(directory, number=1):
    """The grid of one increment: `points` n x 2, `point_data` by name."""
    return scabo_plot.Results(directory).fields(number)


def pairs_of(directory, number=-1):
    """Columns of contact.csv after one increment as arrays, for each contact."""
    results = scabo_plot.Results(directory)
    return results.contacts(results.number(number))


def table_of(directory, name):
    """Columns of a .csv as arrays."""
    return scabo_plot.Results(directory).table(name)


def values_of(mesh, name, factor=1.0):
    """A scalar at the points."""
    return factor * mesh.point_data[name].astype(float)


def draw_cells(axis, directory, magnification=0.0, factor=1.0, **options):
    """The sides of all super-elements after the last increment, coordinates times `factor`."""
    style.draw_cells(axis, scabo_plot.Results(directory).cells(), magnification, factor, **options)


def draw(axis, mesh, values, levels, magnification=0.0, factor=1.0, unit="m"):
    """Filled contours of `values` at the points on the deformed body; where they are not a number, nothing. Levels on both sides of
    zero: a signed quantity. Coordinates times `factor` are in `unit`."""
    triangles, moved = geometry.triangles(mesh), factor * geometry.moved(mesh, magnification)
    drawn = style.contours(axis, moved, triangles, values, levels, lines=levels[0] < 0 < levels[-1])
    style.draw_outline(axis, moved, geometry.outline(triangles))
    label_map(axis, magnification, unit)
    return drawn


def label_map(axis, magnification=0.0, unit="m"):
    """Axes of a map: coordinates with their unit, and by how much displacements are magnified."""
    style.map_frame(axis, f"x ({unit})" + (f"; displacements × {magnification:g}" if magnification else ""), f"y ({unit})")


def colour_bar(figure, drawn, axis, label, count=5, **options):
    """With `count` ticks, the first and the last level among them."""
    ticks = np.linspace(drawn.levels[0], drawn.levels[-1], count)
    return figure.colorbar(drawn, ax=axis, label=label, ticks=ticks, **options)
