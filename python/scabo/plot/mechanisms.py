"""How bodies begin to move where a run ended as a mechanism or collapse, or beyond a limit."""
import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.lines import Line2D

from . import style
from .motions import AT_REST, magnification_of, motion_of
from .units import Units

OPENS = (0, (1.5, 1))  # dashes of joints that open
MANY = 3000     # sides of outlines, above which lines are thin


@style.styled
def mechanism(results, magnification=None, units=None, window=None):
    """The bodies where they are (dashed) and moved, coloured by the largest displacement of each, rigid ones hatched, and the joints that slip or
    open.

    `magnification` of the motion, whose largest displacement is 1 in the model's unit of length: None chooses one. `window`: x0, x1, y0, y1
    in the model's units."""
    units = units or Units()
    motion = motion_of(results, magnification)
    bodies = motion.grid.points[motion.grid.point_data["pair"] == 0]
    place = units.scale("length", np.abs(bodies if window is None else window).max())
    both = np.concatenate([bodies, motion.points[motion.grid.point_data["pair"] == 0]])
    low, high = (both.min(axis=0), both.max(axis=0)) if window is None else (window[::2], window[1::2])
    wide = high[1] - low[1] < 0.45 * (high[0] - low[0])  # the colour bar is then below
    width, height = style.map_size(low, high, beside=0.0 if wide else 0.95)
    legend = [(Line2D([], [], color="0.45", linewidth=0.8, linestyle=(0, (4, 3))), "before")]
    legend += [(Line2D([], [], color=style.BLUE, linewidth=2.0), "slips")] * bool(len(motion.slips))
    legend += [(Line2D([], [], color=style.GREEN, linewidth=2.0, linestyle=OPENS), "opens")] * bool(len(motion.opens))
    figure = style.new_figure(width, height + (0.75 if wide else 0.0), results.title, described(results, motion.magnification, units), legend)
    axis = figure.add_subplot()
    thin = 1.0 if len(motion.outlines) <= MANY else 0.5
    before, after = place.factor * motion.grid.points, place.factor * motion.points
    light = ListedColormap(colormaps[style.MAGNITUDE](np.linspace(0.05, 0.75, 256)))  # lines are seen on all of it
    colours = ScalarMappable(Normalize(0.0, 1.0), light)
    tints = [colours.to_rgba(value) if value > AT_REST else (0.96, 0.96, 0.96, 1.0) for value in motion.motion]
    axis.add_collection(PolyCollection([after[cell] for cell in motion.cells], facecolors=tints, edgecolors="face", linewidths=0.4))
    style.draw_hatched(axis, [after[cell] for cell, rigid in zip(motion.cells, motion.rigid) if rigid],
                       [tint for tint, rigid in zip(tints, motion.rigid) if rigid])
    style.draw_outline(axis, before, motion.outlines, colors="0.45", linewidths=0.5 * thin, linestyles=(0, (4, 3)), zorder=1.5)
    style.draw_outline(axis, after, motion.outlines, linewidths=0.6 * thin, zorder=2.0)
    for pieces, colour, dashes in ((motion.slips, style.BLUE, "solid"), (motion.opens, style.GREEN, OPENS)):
        if len(pieces):
            axis.add_collection(LineCollection(after[pieces], colors=colour, linewidths=1.8 * thin, linestyles=dashes, zorder=2.5))
    style.map_frame(axis, place.label("x"), place.label("y"))
    axis.autoscale_view()
    if window is not None:
        axis.set(xlim=place.factor * np.array(window[:2]), ylim=place.factor * np.array(window[2:]))
    style.map_ticks(axis, height)
    figure.colorbar(colours, ax=axis, label="largest displacement of each body", location="bottom" if wide else "right",
                    shrink=0.8 if wide else 0.9, aspect=35 if wide else 25, pad=0.02)
    return figure


def described(results, magnification, units):
    """`step 2, increment 1 · mechanism: 3 of 17 bodies move, most of all 'b_3_1' · largest displacement drawn as 500 mm`"""
    summary = results.summary
    last = summary["increments"][-1] if summary.get("increments") else {}
    parts = [results.place_of(last)] if last else []
    limit = summary.get("limit")
    status = f"beyond the limit, {limit['solved']:.5g} to {limit['beyond']:.5g}" if limit else summary["status"]
    parts.append(f"{status}: {summary.get('mechanism', {}).get('text', '')}")
    size = units.scale("length", magnification).text(magnification) if units.length else \
        f"{magnification:g} times the unit of length"
    parts.append(f"largest displacement drawn as {size}")
    return "\u00a0· ".join(parts)
