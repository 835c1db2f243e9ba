"""Cracks that grew: their paths over the mesh, and the load over their length, opening and the displacement of the load, or their length over
cycles of load."""
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
    """Above, the paths over the cells of the last mesh, with a mark at each point. Below, the load factor over the length of the crack, its
    opening, and the displacement of the load; or its length over the cycles of load."""
    units = units or Units()
    paths, tips, grid = grown(results), curves_of(results), results.cells()
    if not paths or not tips or grid is None:
        raise NothingToDraw(f"{results.directory}: no crack has grown, or it has no mesh to draw (cells.vtu)")
    place = units.scale("length", np.abs(grid.points if window is None else window).max())
    low, high = (grid.points.min(axis=0), grid.points.max(axis=0)) if window is None else (window[::2], window[1::2])
    width, height = style.map_size(low, high)
    panels = panels_of(tips)
    width = max(width, 2.2 * len(panels) + 0.4)
    ended = results.summary["growth"].get("ended")
    figure = style.new_figure(width, height + 2.2, results.title, f"growth ended: {ended}" if ended else "growth has not ended")
    axes = figure.subplot_mosaic([["map"] * len(panels), panels], height_ratios=(height, 2.2))
    above = axes["map"]
    points = place.factor * grid.points
    is_cell = grid.types == vtu.POLYGON
    style.draw_cells(above, grid, factor=place.factor, linewidths=0.25 if is_cell.sum() < 4000 else 0.12, edgecolors="0.45")
    boundary = grid.cells(vtu.LINE)
    if len(boundary):
        style.draw_outline(above, points, boundary, linewidths=1.2, colors="black")
    for path in paths.values():
        above.plot(*place.factor * path.T, "o-", color=style.RED, linewidth=1.3, markersize=2.5, markeredgewidth=0)
    fields.finish_map(above, place, window, height)
    for panel in panels:
        PANELS[panel](axes[panel], tips, units)
        if panel in ("opening", "displacement"):
            axes[panel].set_ylabel("")  # that of the first panel
    if len(tips) > 1:
        axes[panels[0]].legend()
    return figure


def panels_of(tips):
    """What is drawn of these tips."""
    if any(has(tip, "cycles") for tip in tips.values()):
        return ["cycles"]
    conjugate = [name for name in ("displacement", "reaction") if any(has(tip, name) for tip in tips.values())]
    return ["length", "opening", *conjugate][:3]


def has(tip, column):
    return column in tip and bool(np.isfinite(tip[column]).any())


def largest_of(tips, column):
    return max((np.nanmax(np.abs(tip[column])) for tip in tips.values() if has(tip, column)), default=0.0)


def draw_cycles(axis, tips, units):
    length = units.scale("length", largest_of(tips, "length"))
    draw(axis, [(tip["cycles"], length.factor * tip["length"]) for tip in tips.values()], tips)
    axis.set(xlabel="cycles of load", ylabel=length.label("length of the crack"))


def draw_over(column, name):
    """The load factor over a length of cracks.csv."""
    def over(axis, tips, units):
        scale = units.scale("length", largest_of(tips, column))
        draw(axis, [(scale.factor * tip[column], tip["load_factor"]) for tip in tips.values()], tips)
        axis.set(xlabel=scale.label(name, "\n"), ylabel="load factor", ylim=(0, 1.1 * max(0.0, largest_of(tips, "load_factor"))))
    return over


def of_states(tips, column):
    """Load factor and a column that all tips of a state share, state by state."""
    states = {}
    for tip in tips.values():
        for at, factor, value in zip(tip["increment"], tip["load_factor"], tip[column]):
            states[at] = factor, value
    return np.array([states[at] for at in sorted(states)]).T


def draw_displacement(axis, tips, units):
    """The load factor over the displacement of the loads."""
    factor, value = of_states(tips, "displacement")
    scale = units.scale("energy", np.nanmax(np.abs(value)))
    draw(axis, [(scale.factor * value, factor)], [""])
    axis.set(xlabel=scale.label("displacement of the load,\nwork at factor 1", "\n"), ylabel="load factor", ylim=(0, 1.1 * max(0.0, factor.max())),
             xlim=(min(0.0, axis.get_xlim()[0]), None))


def draw_reaction(axis, tips, units):
    """The reaction over the factor of supports that move."""
    factor, value = of_states(tips, "reaction")
    scale = units.scale("energy", np.nanmax(np.abs(value)))
    draw(axis, [(factor, scale.factor * value)], [""])
    axis.set(xlabel="factor of the supports", ylabel=scale.label("reaction, work at factor 1"), xlim=(0, None), ylim=(0, None))


PANELS = {"cycles": draw_cycles, "length": draw_over("length", "length of the crack"), "opening": draw_over("opening", "its largest opening"),
          "displacement": draw_displacement, "reaction": draw_reaction}


def draw(axis, curves, tips):
    for (x, y), name, (colour, dashes, mark) in zip(curves, tips, style.CURVES):
        axis.plot(x, y, color=colour, linestyle=dashes, marker=mark if len(x) <= 40 else None, markersize=3, label=style.label(short_name(name)))
    axis.grid(True)
    style.plain_frame(axis)
