"""Cracks that grew: their paths over the mesh, and the load, or the length over cycles of load."""
import numpy as np

from . import fields, style, vtu
from .curves import short_name
from .results import NothingToDraw
from .units import Units


def grown(results):
    """Points of each path by the name of its crack; none where no crack grows."""
    return {name: np.array(path) for name, path in results.summary.get("growth", {}).get("paths", {}).items()}


def curves_of(results):
    """For each tip the columns of cracks.csv, as arrays."""
    table = results.table("cracks.csv")
    if table is None or len(table["tip"]) == 0:
        return {}
    return {name: {key: column[table["tip"] == name] for key, column in table.items()} for name in dict.fromkeys(table["tip"])}


@style.styled
def cracks(results, units=None, window=None):
    """Above, the paths over the cells of the last mesh, with a mark at each point; below, the load factor over the length of the crack, or
    its length over the cycles of load."""
    units = units or Units()
    paths, tips, grid = grown(results), curves_of(results), results.cells()
    if not paths or not tips or grid is None:
        raise NothingToDraw(f"{results.directory}: no crack has grown, or it has no mesh to draw (cells.vtu)")
    place = units.scale("length", np.abs(grid.points if window is None else window).max())
    low, high = (grid.points.min(axis=0), grid.points.max(axis=0)) if window is None else (window[::2], window[1::2])
    width, height = style.map_size(low, high)
    ended = results.summary["growth"].get("ended")
    figure = style.new_figure(width, height + 2.2, results.title, f"growth ended: {ended}" if ended else "growth has not ended")
    above, below = figure.subplots(2, 1, height_ratios=(height, 2.2))
    points = place.factor * grid.points
    is_cell = grid.types == vtu.POLYGON
    style.draw_cells(above, grid, factor=place.factor, linewidths=0.25 if is_cell.sum() < 4000 else 0.12, edgecolors="0.45")
    boundary = grid.cells(vtu.LINE)
    if len(boundary):
        style.draw_outline(above, points, boundary, linewidths=1.2, colors="black")
    for path in paths.values():
        above.plot(*place.factor * path.T, "o-", color=style.RED, linewidth=1.3, markersize=2.5, markeredgewidth=0)
    fields.finish_map(above, place, window, height)
    draw_curves(below, tips, units)
    return figure


def draw_curves(axis, tips, units):
    cycled = any(np.isfinite(tip["cycles"]).any() for tip in tips.values() if "cycles" in tip)
    largest = max(tip["length"].max() for tip in tips.values())
    length = units.scale("length", largest)
    for (name, tip), (colour, dashes, mark) in zip(tips.items(), style.CURVES):
        x, y = (tip["cycles"], length.factor * tip["length"]) if cycled else (length.factor * tip["length"], tip["load_factor"])
        axis.plot(x, y, color=colour, linestyle=dashes, marker=mark if len(x) <= 40 else None, markersize=3, label=style.label(short_name(name)))
    if cycled:
        axis.set(xlabel="cycles of load", ylabel=length.label("length of the crack"))
    else:
        axis.set(xlabel=length.label("length of the crack"), ylabel="load factor",
                 ylim=(0, 1.1 * max(tip["load_factor"].max() for tip in tips.values())))
    axis.grid(True)
    style.plain_frame(axis)
    if len(tips) > 1:
        axis.legend()
