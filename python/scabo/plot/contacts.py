"""Pressure, shear, gap and slip along contacts, with the state of every pair; or, of many contacts, a map of them."""
import dataclasses

import numpy as np
from matplotlib.collections import LineCollection

from . import geometry, style
from .results import NothingToDraw, ResultsError, without_rounding
from .units import Units

CURVES = (("pressure", "pressure", "stress"), ("shear", "shear", "stress"), ("gap", "gap", "length"), ("slip", "slip", "length"))
MOST_CONTACTS = 3  # side by side


@dataclasses.dataclass(frozen=True)
class Line:
    """One contact after one increment, in the units of the file; arrays have one value for each pair, in the order of the file."""
    name: str
    distance: np.ndarray  # from pair 1, along the contact
    x: np.ndarray
    y: np.ndarray
    values: dict          # pressure, shear, gap, slip
    states: np.ndarray    # open, stick or slip


def lines_of(results, number, names=()):
    """The contacts of one increment, all or those named."""
    contacts = results.contacts(number)
    if not contacts:
        raise NothingToDraw(f"{results.directory}: has no contact.csv with pairs of {results.name_of(number)}; the model has no contact")
    for name in names:
        if name not in contacts:
            have = list(contacts)
            raise ResultsError(f"--contact {name}: there is no such contact; there {'is' if len(have) == 1 else 'are'} "
                               + ", ".join(have[:12]) + (f" and {len(have) - 12} more" if len(have) > 12 else ""))
    chosen = {name: contacts[name] for name in names} if names else contacts
    return [Line(name, geometry.arc_length(rows["x"], rows["y"]), rows["x"], rows["y"],
                 {"pressure": rows["pressure"], "shear": rows["shear"], "gap": without_rounding(rows, "gap", "normal"),
                  "slip": without_rounding(rows, "slip", "tangential")}, rows["state"]) for name, rows in chosen.items()]


def counts_of(lines):
    """Number of pairs in each state."""
    return {state: sum(int((line.states == state).sum()) for line in lines) for state in style.STATES}


@style.styled
def contact(results, increment=-1, contacts=(), component=None, units=None):
    """Curves over the distance along each contact for up to three contacts, or for those named in `contacts`; a map for more.
    `component`: only one of pressure, shear, gap and slip."""
    if results.modal:
        raise NothingToDraw(f"{results.directory}: is a modal analysis, which has no contact")
    units = units or Units()
    number = results.number(increment)
    names = [name for name, _, _ in CURVES]
    if component is not None and component not in names:
        raise ResultsError(f"--component {component}: along a contact there are {', '.join(names)}")
    lines = lines_of(results, number, contacts)
    if len(lines) > MOST_CONTACTS:
        return contact_map(results, number, lines, units, component or "pressure")
    return contact_curves(results, number, lines, units, [curve for curve in CURVES if component in (None, curve[0])])


NO_SHEAR = 1e-3  # part of the largest pressure; smaller shear is that of the mesh, and its axis ends there


def contact_curves(results, number, lines, units, curves, along=None):
    """`along`: what says along which line these values of a face in space are."""
    single = len(lines) == 1 and len(curves) > 1
    rows, columns = (len(curves) // 2, 2) if single else (len(curves), len(lines))
    width = style.WIDTH if columns < 3 else 9.2
    height = 2.3 * rows if single or len(curves) == 1 else 1.75 * rows + 0.3
    subtitle = f"{results.name_of(number)}\u00a0· forces on the second side of the contact; shear and slip positive along\u00a0t"
    legend = style.state_marks(counts_of(lines))
    if along:
        subtitle = f"{results.name_of(number)}\u00a0· {along}"
        legend = [(style.state_mark(state), state) for state, count in counts_of(lines).items() if count]
    if any(part_in_contact(line) is not None for line in lines):
        subtitle += "\u00a0· only the part in contact and its surroundings"
    figure = style.new_figure(width, height, results.title, subtitle, legend)
    together = not single and all(part_in_contact(line) is None for line in lines)
    axes = figure.subplots(rows, columns, sharex="col", sharey="row" if together else "none", squeeze=False)
    grid = axes.reshape(-1, 1) if single else axes  # curve x contact
    largest = {key: max(np.abs(line.values[key]).max() for line in lines) for key, _, _ in CURVES}
    no_shear = largest["shear"] < NO_SHEAR * largest["pressure"]
    if no_shear:
        largest["shear"] = NO_SHEAR * largest["pressure"]
    scales = {key: units.scale(dimension, largest[key]) for key, _, dimension in curves}
    for column, line in enumerate(lines):
        view = part_in_contact(line)
        length = units.scale("length", line.distance[-1] if view is None else 10 * (view[1] - view[0]))
        for row, (key, name, _) in enumerate(curves):
            axis = grid[row, column]
            x, y = length.factor * line.distance, scales[key].factor * line.values[key]
            axis.axhline(0, color="0.6", linewidth=0.6, zorder=0.5)
            axis.plot(x, y, color="0.45", linewidth=0.9, zorder=2)
            shown = slice(None) if view is None else (line.distance >= view[0]) & (line.distance <= view[1])
            style.mark_states(axis, x[shown], y[shown], line.states[shown])
            axis.grid(True)
            style.plain_frame(axis)
            axis.margins(0.04, 0.1)
            if view is not None:
                show_part(axis, x, y, length.factor * np.array(view))
            nothing = not (y[shown].any() or together and any(other.values[key].any() for other in lines))
            if no_shear and key == "shear" and not nothing:
                axis.set_ylim(*(scales[key].factor * largest[key] * np.array([-1, 1])))
            if single or column == 0:
                axis.set_ylabel(scales[key].label(name, "\n"), fontsize=8.5 if single else 8)
            style.few_ticks(axis, 6 if columns < 3 else 4, 5)
            if nothing:
                style.nothing_but_zero(axis, what_zero_means(key, line.states[shown]))
        for axis in grid[-2:, column] if single else grid[-1:, column]:
            nothing = 1e-9 * line.distance[-1]  # rounding of a coordinate that is 0
            start = ", ".join(f"{length.factor * (value if abs(value) > nothing else 0.0):.4g}" for value in (line.x[0], line.y[0]))
            axis.set_xlabel(length.label("distance" if along else f"distance from ({start})"))
        if len(lines) > 1:
            grid[0, column].set_title(line.name)
        elif len(curves) > 1:
            grid[0, column].set_title(f"contact {line.name}")
    figure.align_ylabels()
    return figure


def what_zero_means(key, states):
    """Of a curve that is zero at all pairs."""
    if key == "gap":
        return "no gap" if (states == "open").any() else "no gap: all pairs are closed"
    return f"no {key}: all pairs are open" if key == "pressure" and (states == "open").all() else f"no {key}"


def part_in_contact(line, least=0.05):
    """Where the pairs that are not open lie within less than a twentieth of the contact: that part and as much beside it; otherwise None."""
    touching = line.distance[line.states != "open"]
    if len(touching) < 2:
        return None
    first, last = touching[0], touching[-1]
    beside = 0.6 * (last - first)
    if last - first >= least * line.distance[-1]:
        return None
    return max(first - beside, 0.0), min(last + beside, line.distance[-1])


def show_part(axis, x, y, view):
    """Limits for the part of a curve within `view`."""
    inside = y[(x >= view[0]) & (x <= view[1])]
    low, high = min(inside.min(), 0.0), max(inside.max(), 0.0)
    axis.set_xlim(view)
    axis.set_ylim(low - 0.1 * (high - low), high + 0.1 * (high - low) or 1.0)


def middles(x, y):
    """For each pair of a contact the part of the line that belongs to it: k x 3 x 2, from the middle of one side to that of the other."""
    points = np.column_stack([x, y])
    between = 0.5 * (points[1:] + points[:-1])
    return np.stack([np.concatenate([points[:1], between]), points, np.concatenate([between, points[-1:]])], axis=1)


def contact_map(results, number, lines, units, component):
    """Where contacts are open, stick or slip, and one of their values as the width of a line."""
    pieces = np.concatenate([middles(line.x, line.y) for line in lines])
    states = np.concatenate([line.states for line in lines])
    values = np.concatenate([line.values[component] for line in lines])
    place = units.scale("length", np.abs(pieces).max())
    dimension = next(entry[2] for entry in CURVES if entry[0] == component)
    scale = units.scale(dimension, np.abs(values).max())
    fields = results.last_fields()
    low, high = pieces.reshape(-1, 2).min(axis=0), pieces.reshape(-1, 2).max(axis=0)
    if fields is not None:
        sides = geometry.outline(geometry.triangles(fields))
        low, high = np.minimum(low, fields.points.min(axis=0)), np.maximum(high, fields.points.max(axis=0))
    upright = high[1] - low[1] > high[0] - low[0]
    width, height = style.map_size(low, high, style.WIDTH / 2 if upright else style.WIDTH)
    widths, widest = widths_of(values)
    largest = np.abs(values).max()
    subtitle = (f"{results.name_of(number)}\u00a0· {component} as the width of the line, at most {scale.text(largest)}"
                + (f", widest from {scale.text(widest)} on" if widest < 0.999 * largest else "")
                + f"\u00a0· {len(lines)} contacts; `--contact NAME` draws the curves of one")
    figure = style.new_figure(2 * width if upright else width, height if upright else 2 * height, results.title, subtitle,
                              style.state_marks(counts_of(lines)))
    axes = figure.subplots(1 if upright else 2, 2 if upright else 1, sharex=True, sharey=True)
    for axis in axes:
        if fields is not None:
            style.draw_outline(axis, place.factor * fields.points, sides, colors="0.75", linewidths=0.4, zorder=0.5)
        style.map_frame(axis, place.label("x"), place.label("y"))
    between = np.concatenate([np.diff(line.distance) for line in lines] or [[]])
    spacing = np.median(between) if len(between) else high[0] - low[0]
    size = float(np.clip(0.25 * spacing / max(high[0] - low[0], 1e-300) * 72 * (width - 0.7), 1.8, 5.0))
    points = place.factor * pieces[:, [0, 2]].mean(axis=1)  # where blocks meet in a corner, each of their pairs has a place of its own
    for state, (colour, mark, filled) in style.STATES.items():
        chosen = states == state
        axes[0].plot(*points[chosen].T, linestyle="", marker=mark, markersize=size, color=colour, markerfacecolor=colour if filled else
                     "white", markeredgewidth=0.5)
    axes[0].set_title("state of the pairs")
    axes[1].set_title(component)
    for state, (colour, _, _) in style.STATES.items():
        chosen = (states == state) & (widths > 0)
        axes[1].add_collection(LineCollection(place.factor * pieces[chosen], colors=colour, linewidths=widths[chosen], capstyle="butt"))
    for axis in axes:
        axis.autoscale_view()
        style.map_ticks(axis, height, 7 if not upright else 4, 6)
    if not upright:
        axes[0].set_xlabel("")
    else:
        axes[1].set_ylabel("")
    return figure


def widths_of(values, most=7.0, part=0.98):
    """Widths of lines in points, in proportion to the size of the values, and the size from which on they are widest: single peaks
    would leave nothing to see of the others."""
    sizes = np.abs(values)
    if not sizes.any():
        return np.zeros(len(values)), 0.0
    typical = np.quantile(sizes[sizes > 0], part)
    widest = float(typical if typical < 0.5 * sizes.max() else sizes.max())
    return most * np.minimum(sizes / widest, 1.0), widest
