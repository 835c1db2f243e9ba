"""A model before it is solved: bodies and their cells, names of edges, supports, springs, bars, loads and contacts."""
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path

from . import fields, style
from .curves import short_name
from .units import Units

MOST_NAMES = 60   # edges that are named
MOST_ARROWS = 7   # along one edge
KINDS = ("body", "load", "given edge", "support", "bar", "contact", "edge")
THIN = 0.1        # part of the picture: in a body of this depth, names stand outside
TINTS = ("#dfe7ee", "#f3e6d3", "#e2eddd", "#eee1ea", "#e9e9e2", "#dcebeb")


@style.styled
def model(drawing, units=None, window=None):
    """`drawing`: what the program writes of a model. Edges have the names by which the model file knows them, the user's where there are
    some; arrows show where loads act and along which direction, not how large they are."""
    units = units or Units()
    points = np.array([x for body in drawing["bodies"] for loop in body["loops"] for x in loop] +
                      [x for bar in drawing.get("bars", []) for x in bar["points"]])
    place = units.scale("length", np.abs(points if window is None else window).max())
    low, high = (points.min(axis=0), points.max(axis=0)) if window is None else (np.array(window[::2]), np.array(window[1::2]))
    size = place.factor * max(high - low)
    if window is None:  # room for arrows and names
        low, high = low - 0.08 * max(high - low), high + 0.08 * max(high - low)
    width, height = style.map_size(low, high)
    figure = style.new_figure(width, height, drawing["title"], subtitle_of(drawing), legend_of(drawing))
    axis = figure.add_subplot()
    for number, body in enumerate(drawing["bodies"]):
        draw_body(axis, body, TINTS[number % len(TINTS)], place.factor)
    for kind, colour in (("ties", style.GREEN), ("contacts", style.ORANGE)):
        for entry in drawing[kind]:
            draw_interface(axis, entry, colour, place.factor, kind == "contacts")
    for kind, colour, mark in (("supports", style.BLUE, "-"), ("springs", style.GREEN, ":")):
        for entry in drawing[kind]:
            draw_held(axis, entry, colour, mark, place.factor, size)
    for entry in drawing.get("bars", []):
        draw_bar(axis, entry, place.factor)
    for entry in drawing["loads"]:
        draw_load(axis, entry, place.factor, size)
    axis.set_xlim(place.factor * low[0], place.factor * high[0])
    axis.set_ylim(place.factor * low[1], place.factor * high[1])
    name_edges(axis, drawing["bodies"], place.factor, size)
    fields.finish_map(axis, place, window, height)
    leave_room(figure, axis)
    return figure


def leave_room(figure, axis):
    """Names that would cover others: those of supports move down, those of contacts, and of edges that the user did not name, are left out;
    a body is named without its steps."""
    figure.draw_without_rendering()
    taken = []
    is_free = lambda box: not any(box.overlaps(other) for other in taken)
    for text in sorted((text for text in axis.texts if text.get_text()), key=lambda text: KINDS.index(text.get_gid())):
        if text.get_gid() == "body" and not is_free(text.get_window_extent()):
            text.set_text(text.get_text().split("\n")[0])
        for _ in range(4 if text.get_gid() == "support" else 0):
            if not is_free(text.get_window_extent()):
                text.xyann = (text.xyann[0], text.xyann[1] - 11)
        if text.get_gid() in ("contact", "edge") and not is_free(text.get_window_extent()):
            text.set_visible(False)
        else:
            taken.append(text.get_window_extent())


def subtitle_of(drawing):
    cells = sum(len(body["cells"]) for body in drawing["bodies"])
    elastic = any(not body["rigid"] for body in drawing["bodies"])
    parts = [f"model: {len(drawing['bodies'])} bodies" if len(drawing["bodies"]) != 1 else "model: one body"]
    if elastic:
        parts.append(f"{cells} cells" if cells else "more cells than can be drawn")
    undrawn = [entry["name"] for entry in drawing["loads"] if not entry["along"]]
    if undrawn:
        parts.append("loads without a direction: " + ", ".join(short_name(name) for name in undrawn[:6]) + (" ..." if len(undrawn) > 6 else ""))
    return " \u00b7 ".join(parts)


def legend_of(drawing):
    entries = [("supports", "support", Line2D([], [], color=style.BLUE, linewidth=2)), ("springs", "spring", Line2D([], [], color=style.GREEN, linestyle=":")),
               ("bars", "bar", Line2D([], [], color=style.GREEN, marker="o", markersize=4)), ("loads", "load", Line2D([], [], color=style.RED, marker=">", markersize=5)),
               ("contacts", "contact", Line2D([], [], color=style.ORANGE, linewidth=3)), ("ties", "tie", Line2D([], [], color=style.GREEN, linewidth=3))]
    legend = [(artist, name) for kind, name, artist in entries if drawing.get(kind)]
    if any(body["rigid"] for body in drawing["bodies"]):
        legend.append((Patch(facecolor="0.85", edgecolor="0.4", hatch="////"), "rigid"))
    return legend


def with_stages(entry):
    """A name, and the steps in which a body or support begins and ends."""
    steps = [f"{word} {short_name(entry[word])}" for word in ("from", "until") if word in entry]
    return short_name(entry["name"]) + (f" ({', '.join(steps)})" if steps else "")


def draw_body(axis, body, tint, factor):
    """Filled, holes left open, with its cells; of an unbounded one the outline alone."""
    codes, corners = [], []
    for loop in body["loops"]:
        corners += [*loop, loop[0]]
        codes += [Path.MOVETO, *[Path.LINETO] * (len(loop) - 1), Path.CLOSEPOLY]
    look = {"facecolor": "0.85", "hatch": "////", "edgecolor": "0.4"} if body["rigid"] else {"facecolor": tint, "edgecolor": "0.15"}
    if body["unbounded"]:
        look = {"facecolor": "none", "edgecolor": "0.15", "linestyle": "--"}
    axis.add_patch(PathPatch(Path(factor * np.array(corners), codes), linewidth=1.0, **look))
    if body["cells"]:
        axis.add_collection(LineCollection([factor * np.array([*cell, cell[0]]) for cell in body["cells"]], colors="0.6", linewidths=0.3))
    middle = factor * np.array(body["loops"][0]).mean(axis=0)
    axis.text(*middle, with_stages(body).replace(" (", "\n("), ha="center", va="center", fontweight="bold", fontsize=8.5, bbox=style.BOX_ON_LINES,
              parse_math=False, clip_on=True, gid="body")


def draw_interface(axis, entry, colour, factor, named):
    points = factor * np.array(entry["points"]).reshape(-1, 2)
    if not len(points):
        return
    axis.plot(*points.T, color=colour, linewidth=3, alpha=0.75, solid_capstyle="butt", marker="o" if len(points) == 1 else None)
    if named:
        axis.annotate(short_name(entry["name"]), points[len(points) // 2], xytext=(0, -9), textcoords="offset points", color=colour, fontsize=8,
                      ha="center", va="top", parse_math=False, annotation_clip=True, gid="contact")


def spread(points, most):
    """Of many points some, evenly along them."""
    if len(points) == 1:
        return points
    steps = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    at = (np.arange(most) + 0.5) / most * steps[-1]
    return np.column_stack([np.interp(at, steps, points[:, k]) for k in range(2)])


def draw_held(axis, entry, colour, dashes, factor, size):
    """A short line across each direction that is held, at some points; the name of a support that begins or ends."""
    points = factor * np.array(entry["points"]).reshape(-1, 2)
    if not len(points):
        return
    if "from" in entry or "until" in entry:
        axis.annotate(with_stages(entry), points[np.argmin(points[:, 1])], xytext=(0, -11), textcoords="offset points", color=colour, fontsize=8,
                      ha="center", va="top", parse_math=False, annotation_clip=True, gid="support")
    for along in entry["along"]:
        half = 0.02 * size * np.array([-along[1], along[0]])
        back = 0.012 * size * np.array(along)
        for x in spread(points, MOST_ARROWS):
            for sign in (-1, 1):
                axis.plot(*np.array([x + sign * back - half, x + sign * back + half]).T, color=colour, linestyle=dashes, linewidth=1.4, clip_on=True)


def draw_bar(axis, entry, factor):
    """From end to end, with a dot where it ends."""
    points = factor * np.array(entry["points"]).reshape(-1, 2)
    axis.plot(*points.T, color=style.GREEN, linewidth=1.6, marker="o", markersize=4, clip_on=True, zorder=5)
    axis.annotate(short_name(entry["name"]), points.mean(axis=0), color=style.GREEN, fontsize=8, textcoords="offset points", xytext=(4, 2), annotation_clip=True, gid="bar")


def draw_load(axis, entry, factor, size):
    """Arrows that end where the load acts."""
    points = factor * np.array(entry["points"]).reshape(-1, 2)
    if not len(points) or not entry["along"]:
        return
    along = np.array(entry["along"][0])
    shown = spread(points, MOST_ARROWS) if len(points) > 1 and entry["on_edge"] else points[:40]
    for x in shown:
        axis.annotate("", x, x - 0.07 * size * along, arrowprops={"arrowstyle": "-|>", "color": style.RED, "linewidth": 1.1}, annotation_clip=True)
    axis.annotate(short_name(entry["name"]), shown[len(shown) // 2] - 0.075 * size * along, color=style.RED, fontsize=8, ha="center",
                  va="bottom" if along[1] < 0 else "top" if along[1] > 0 else "center", parse_math=False, annotation_clip=True, gid="load")


def name_edges(axis, bodies, factor, size):
    """Inside the body, or outside where it is thin, beside the middle of each edge; of many only those that the user named."""
    edges = [(edge, np.ptp(np.array(body["loops"][0]), axis=0)) for body in bodies for edge in body["edges"]]
    if len(edges) > MOST_NAMES:
        edges = [(edge, extent) for edge, extent in edges if edge["given"]][:MOST_NAMES]
    for edge, extent in edges:
        inwards = -np.array(edge["normal"])
        if factor * np.abs(inwards * extent).sum() < THIN * size:
            inwards = -inwards
        x = factor * np.array(edge["at"]) + 0.012 * size * inwards
        axis.text(*x, short_name(edge["name"]), fontsize=7, color="0.25", parse_math=False, clip_on=True, gid="given edge" if edge["given"] else "edge",
                  ha="center" if abs(inwards[0]) < 0.4 else "left" if inwards[0] > 0 else "right",
                  va="center" if abs(inwards[1]) < 0.4 else "bottom" if inwards[1] > 0 else "top")
