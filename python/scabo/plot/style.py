"""One style for all pictures: fonts, colours, marks, levels, headers. Every picture can be read in grey: states of contact differ in
their mark, curves in their dashes, signed contours in lines that are dashed below zero."""
import functools
import textwrap

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PathCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, MaxNLocator
from matplotlib.tri import Triangulation

from . import geometry, vtu

SETTINGS = {"font.size": 9, "axes.titlesize": 9.5, "axes.titlelocation": "left", "axes.labelsize": 9, "legend.fontsize": 8.5,
            "legend.frameon": True, "legend.framealpha": 1.0,
            "legend.facecolor": "white", "legend.edgecolor": "none", "legend.fancybox": False,  # no grid through a legend
            "axes.linewidth": 0.7, "axes.grid": False, "axes.axisbelow": True, "grid.color": "0.88",
            "grid.linewidth": 0.6, "lines.linewidth": 1.3, "axes.formatter.useoffset": False, "axes.formatter.limits": (-4, 5),
            "axes.formatter.use_mathtext": True, "figure.dpi": 130, "savefig.dpi": 200, "pdf.fonttype": 42,
            "figure.constrained_layout.wspace": 0.05}
BLUE, RED, GREEN, ORANGE, GREY = "#2b5c8a", "#c1442e", "#3f9c6b", "#d58a1c", "0.55"
SIGNED, MAGNITUDE = "RdBu_r", "YlOrRd"
CURVES = ((BLUE, "-", "o"), (RED, "--", "^"), (GREEN, "-.", "s"), (ORANGE, ":", "D"), ("0.3", (0, (5, 1, 1, 1, 1, 1)), "v"),
          ("#7a4b94", (0, (8, 2)), "P"))
# state: colour, mark, filled
STATES = {"stick": (BLUE, "o", True), "slip": (RED, "^", True), "open": ("0.35", "s", False)}
WIDTH = 6.7  # inches of text on a page
BOX_ON_LINES = {"boxstyle": "square,pad=0.15", "facecolor": "white", "edgecolor": "none"}  # no lines through a text


def apply():
    """From here on, for programs that only draw pictures."""
    plt.rcParams.update(SETTINGS)


def styled(function):
    """The function draws in this style and leaves that of its caller as it was."""
    @functools.wraps(function)
    def draw(*arguments, **options):
        with plt.rc_context(SETTINGS):
            return function(*arguments, **options)
    return draw


def new_figure(width, height, title, subtitle, legend=()):
    """A figure with `height` inches for axes below its header: the title of the model, what is shown, and a legend of (artist, text)."""
    lines = textwrap.wrap(" ".join(title.split()), int(width * 11), max_lines=3, placeholder=" ...") if title else []
    below = textwrap.wrap(subtitle, int(width * 15.5))
    head = 0.08 + 0.18 * len(lines) + 0.16 * len(below) + (0.22 if legend else 0.0) + 0.06
    figure = plt.figure(figsize=(width, height + head))
    figure.set_layout_engine("constrained", rect=(0, 0, 1, height / (height + head)))
    at = height + head - 0.08
    for text, step, options in [(line, 0.18, {"fontsize": 10.5, "fontweight": "bold"}) for line in lines] + [
            (line, 0.16, {"fontsize": 8.5, "color": "0.25"}) for line in below]:
        figure.text(0.08 / width, at / (height + head), text, va="top", parse_math=False, **options)
        at -= step
    if legend:
        figure.legend([artist for artist, _ in legend], [text for _, text in legend], loc="upper left", ncols=len(legend),
                      bbox_to_anchor=(0.0, (at + 0.05) / (height + head)), handletextpad=0.4, columnspacing=1.6)
    return figure


def label(name):
    """A name in a legend, which leaves out those that begin with `_`."""
    return " " + name if name.startswith("_") else name


def state_marks(counts):
    """Entries of a legend for the states that occur: `stick (28 pairs)`."""
    return [(state_mark(state), f"{state} ({count} pair{'s' * (count != 1)})") for state, count in counts.items() if count]


def state_mark(state, size=5.0):
    colour, mark, filled = STATES[state]
    return Line2D([], [], linestyle="", marker=mark, markersize=size, color=colour, markerfacecolor=colour if filled else "white")


def mark_states(axis, x, y, states, size=4.0, most=60):
    """Marks of the states along a curve. Of more than `most` pairs some are marked, the ends of each run among them."""
    states = np.asarray(states)
    shown = marked(states, most)
    for state, (colour, mark, filled) in STATES.items():
        chosen = shown & (states == state)
        if not chosen.any():
            continue
        axis.plot(np.asarray(x)[chosen], np.asarray(y)[chosen], linestyle="", marker=mark, markersize=size, color=colour,
                  markerfacecolor=colour if filled else "white", markeredgewidth=0.8, zorder=3)


def marked(states, most):
    """Which pairs get a mark."""
    shown = np.zeros(len(states), dtype=bool)
    shown[:: max(1, -(-len(states) // most))] = True
    changes = np.flatnonzero(states[1:] != states[:-1])
    if 2 * len(changes) <= most:
        shown[changes] = shown[changes + 1] = True
    shown[[0, -1]] = True
    return shown


def few_ticks(axis, x=5, y=5):
    """Round numbers, no more than so many."""
    if axis.get_xscale() == "linear":
        axis.xaxis.set_major_locator(MaxNLocator(nbins=x, steps=[1, 2, 2.5, 5, 10]))
    if axis.get_yscale() == "linear":
        axis.yaxis.set_major_locator(MaxNLocator(nbins=y, steps=[1, 2, 2.5, 5, 10]))


def nothing_but_zero(axis, text=""):
    """An axis of which all values are zero: its scale means nothing, and a text above the line at zero says what the zero means."""
    axis.set_ylim(-1, 1)
    axis.yaxis.set_major_locator(FixedLocator([0]))
    if text:
        axis.annotate(text, (0.5, 0.5), xytext=(0, 7), xycoords="axes fraction", textcoords="offset points", ha="center", va="bottom",
                      fontsize=8, color="0.25")


def plain_frame(axis):
    for side in ("top", "right"):
        axis.spines[side].set_visible(False)


def levels_of(low, high, bands=10):
    """Round levels from `low` to `high`; symmetric about zero where the values are on both sides of it, and from zero where they are
    on one side and reach near it."""
    largest = max(abs(low), abs(high))
    if largest == 0.0:
        return np.array([-1.0, 1.0]) * 1e-30
    if high - low <= 1e-6 * largest:  # one value everywhere
        return np.array([low - 0.05 * largest, high + 0.05 * largest])
    nice = lambda start, end: MaxNLocator(nbins=bands, steps=[1, 2, 2.5, 5, 10]).tick_values(start, end)
    if low < -0.05 * high and high > 0.05 * -low:
        step = np.diff(nice(0, largest))[0] * (0.5 if bands > 6 else 1.0)
        count = int(np.ceil(largest / step - 1e-9))
        while count > 8:
            step, count = 2 * step, int(np.ceil(largest / (2 * step) - 1e-9))
        return step * np.arange(-count - 0.5, count + 1.0)  # the band in the middle, around zero, is white
    if low >= 0 or high > 0.05 * -low:
        return nice(0.0 if low < 0.6 * high else low, high)
    return nice(low, 0.0 if high > 0.6 * low else high)


def signed_levels(largest, bands=10):
    """From -largest to largest; the band in the middle, around zero, is white."""
    return np.linspace(-largest, largest, 2 * bands + 2)


def contours(axis, points, corners, values, levels, extend=None, lines=True):
    """Filled contours, with lines at every second level; levels on both sides of zero mean a signed quantity. Triangles with a value that is not a number are left out."""
    values = np.asarray(values, dtype=float).reshape(-1)
    shown = Triangulation(*points.T, corners[np.isfinite(values[corners]).all(axis=1)])
    values = np.where(np.isfinite(values), values, 0.0)
    signed = levels[0] < 0 < levels[-1]
    colours = SIGNED if signed else MAGNITUDE if levels[-1] > 0 else MAGNITUDE + "_r"
    drawn = axis.tricontourf(shown, values, levels=levels, cmap=colours, extend=extend or ("both" if signed else "max"))
    if lines and len(levels) > 3:  # which side of zero a dark colour is on, told without colour too
        within = values[np.unique(shown.triangles)]
        chosen = [level for level in levels[1:-1:2] if len(within) and within.min() < level < within.max()]
        dashes = ["solid" if level >= 0 else (0, (14, 8)) for level in chosen]  # in widths of the line
        if chosen:
            axis.tricontour(shown, values, levels=chosen, colors="black", linewidths=0.35, linestyles=dashes, alpha=0.7)
    return drawn


def close_gaps(figure):
    """Before a figure is saved as PDF or SVG, in which viewers show the paper between the bands of contours."""
    for axis in figure.axes:
        for part in axis.collections:
            if isinstance(part, PathCollection) and len(part.get_facecolor()):  # not the lines
                part.set_edgecolor("face")
                part.set_linewidth(0.1)


def draw_hatched(axis, polygons, facecolors="0.93"):
    """Rigid bodies, in one colour or one for each."""
    if polygons:
        axis.add_collection(PolyCollection(polygons, facecolors=facecolors, edgecolors="0.2", hatch="////", linewidths=0.6))


def draw_outline(axis, points, sides, **options):
    """Sides S x 2 of numbers of points."""
    axis.add_collection(LineCollection(points[sides], **{"colors": "black", "linewidths": 0.6, "capstyle": "projecting", **options}))


def draw_cells(axis, cells, magnification=0.0, factor=1.0, **options):
    """The sides of the cells of a cells.vtu, coordinates times `factor`."""
    points = factor * geometry.moved(cells, magnification)
    axis.add_collection(PolyCollection([points[cell] for cell in cells.lists(vtu.POLYGON)],
                                       **{"facecolors": "none", "edgecolors": "black", "linewidths": 0.35, "alpha": 0.6, **options}))


def map_frame(axis, label_x, label_y):
    axis.set(xlabel=label_x, ylabel=label_y, aspect="equal")
    axis.use_sticky_edges = False
    axis.margins(0.03)
    plain_frame(axis)


def map_ticks(axis, height, across=7, up=7):
    """Round numbers along a map of `height` inches with its labels, whose limits are set: as many as have room beside each other."""
    (left, right), (bottom, top) = axis.get_xlim(), axis.get_ylim()
    width = (height - 0.55) * (right - left) / (top - bottom)
    few_ticks(axis, int(np.clip(2 * width, 1, across)), max(3, min(up, int(2 * height))))


def map_size(low, high, width=WIDTH, beside=0.0, least=1.2, most=6.8):
    """Width and height in inches of a map of the box from `low` to `high`, with its labels, and `beside` inches to its right."""
    across, up = np.maximum(np.asarray(high) - np.asarray(low), 1e-300)
    labels = 0.7 + beside
    height = float(np.clip((width - labels) * up / across, least, most))
    narrow = float(np.clip(most * across / up + labels, 3.6, width)) if height == most else width
    return narrow, height + 0.55
