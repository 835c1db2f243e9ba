"""How bodies begin to move where a run ended as a mechanism or collapse, or beyond a limit."""
import dataclasses

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.lines import Line2D

from . import geometry, style, vtu
from .results import NothingToDraw
from .units import Units

AT_REST = 1e-4  # of the largest displacement, as in summary.json
PART = 0.06     # of the diagonal of the model, that the largest displacement is drawn as
OPENS = (0, (1.5, 1))  # dashes of joints that open
MANY = 3000     # sides of outlines, above which lines are thin


@dataclasses.dataclass(frozen=True)
class Motion:
    """What the picture shows, in the units of the files; the largest displacement of the file is 1."""
    grid: vtu.Grid
    magnification: float
    points: np.ndarray    # n x 2, moved
    cells: list           # points of each cell of a body
    motion: np.ndarray    # one for each of them: largest displacement of its body
    rigid: np.ndarray     # one for each of them: whether its body is rigid
    outlines: np.ndarray  # sides of all bodies, S x 2
    slips: np.ndarray     # pieces of contacts that slip and do not open, P x 2
    opens: np.ndarray     # pieces that open, whether they slip or not


def motion_of(results, magnification=None):
    """Raises ResultsError where the results have no such thing."""
    grid = results.mechanism()
    if grid is None:
        raise NothingToDraw(f"{results.directory}: has no mechanism.vtu, as only a run has that ends as a mechanism or collapse (status: "
                            f"{results.summary['status']})")
    size = geometry.extent(grid.points[grid.point_data["pair"] == 0])
    if magnification is None:
        magnification = magnification_of(size)
    is_body = grid.cell_data["body"] > 0
    starts, kinds = grid.starts(), grid.types
    cells = [grid.connectivity[start:end] for start, end, kind, body in zip(starts, grid.offsets, kinds, is_body) if
             body and kind == vtu.POLYGON]
    sides = [np.column_stack([cell, np.roll(cell, -1)]) for cell in cells]
    distinct, times = geometry.distinct_sides(np.concatenate(sides) if sides else np.zeros((0, 2), dtype=int))
    lines, of_body = grid.cells(vtu.LINE)[:, :2], is_body[kinds == vtu.LINE]
    joints = lines[~of_body]
    opening, slip = (np.abs(grid.point_data[name]) for name in ("opening", "slip"))
    opens, slides = ((values > AT_REST)[joints].any(axis=1) for values in (opening, slip))
    is_cell = is_body & (kinds == vtu.POLYGON)
    rigid = np.array([body["rigid"] for body in results.summary["model"]["bodies"]], dtype=bool)
    return Motion(grid, magnification, geometry.moved(grid, magnification), cells, grid.cell_data["motion"][is_cell],
                  rigid[grid.cell_data["body"][is_cell] - 1], np.concatenate([distinct[times == 1], lines[of_body]]),
                  joints[slides & ~opens], joints[opens])


def magnification_of(size):
    """1, 2 or 5 times a power of ten, by which a displacement of 1 is drawn as `PART` of the size or less."""
    power = 10.0 ** np.floor(np.log10(PART * size))
    return max(step * power for step in (1, 2, 5) if step * power <= PART * size * (1 + 1e-9))


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
    figure = style.new_figure(width, height + (0.75 if wide else 0.0), results.title, described(results, motion, units), legend)
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


def described(results, motion, units):
    """`step 2, increment 1 · mechanism: 3 of 17 bodies move, most of all 'b_3_1' · largest displacement drawn as 500 mm`"""
    summary = results.summary
    last = summary["increments"][-1] if summary.get("increments") else {}
    parts = [results.place_of(last)] if last else []
    limit = summary.get("limit")
    status = f"beyond the limit, {limit['solved']:.5g} to {limit['beyond']:.5g}" if limit else summary["status"]
    parts.append(f"{status}: {summary.get('mechanism', {}).get('text', '')}")
    size = units.scale("length", motion.magnification).text(motion.magnification) if units.length else \
        f"{motion.magnification:g} times the unit of length"
    parts.append(f"largest displacement drawn as {size}")
    return "\u00a0· ".join(parts)
