"""Contours of stress and displacement on the deformed bodies."""
import dataclasses

import numpy as np
from matplotlib.collections import PolyCollection

from . import geometry, revolution, style, vtu
from .results import NothingToDraw, ResultsError
from .units import Units

# name on the command line: array in the file, or component of the displacement; what it is called; dimension
COMPONENTS = {
    "von_mises": ("von_mises", "von Mises stress", "stress"),
    "principal_1": ("principal_1", "first principal stress", "stress"),
    "principal_2": ("principal_2", "second principal stress", "stress"),
    "principal_3": ("principal_3", "third principal stress", "stress"),
    "xx": ("stress_xx", "stress xx", "stress"),
    "yy": ("stress_yy", "stress yy", "stress"),
    "xy": ("stress_xy", "stress xy", "stress"),
    "zz": ("stress_zz", "stress zz", "stress"),
    "ux": (0, "displacement along x", "length"),
    "uy": (1, "displacement along y", "length"),
    "displacement": (None, "displacement", "length"),
}
MANY = 3000  # sides of an outline that is drawn in its undeformed place too


def field_values(grid, component):
    """One number for each point of the grid, in the units of the file; not a number in rigid bodies, which have no stress."""
    array, name, dimension = COMPONENTS[component]
    if dimension == "length":
        if "displacement" not in grid.point_data:
            raise NothingToDraw("the fields have no displacement: `output: {fields: [...]}` in the model file leaves it out")
        displacement = grid.point_data["displacement"][:, :2].astype(float)
        return np.hypot(*displacement.T) if array is None else displacement[:, array]
    if array not in grid.point_data:
        raise NothingToDraw(f"the fields have no {name}: `output: {{fields: [...]}}` in the model file leaves it out")
    values = grid.point_data[array].astype(float)
    for points in geometry.rigid_outlines(grid):
        values[points] = np.nan
    return values


def default_component(grid):
    """The first stress that the file has."""
    return next((name for name, (array, _, dimension) in COMPONENTS.items() if dimension == "stress" and array in grid.point_data),
                "displacement")


def field_range(grid, corners, values, dimension):
    """Typical smallest and largest value in the triangles; stress that is only rounding beside the largest one is zero."""
    weights = np.zeros(len(values))
    np.add.at(weights, corners, geometry.areas(grid.points, corners)[:, None] / 3)
    low, high = geometry.typical_range(values, weights)
    if dimension == "stress" and "von_mises" in grid.point_data:
        rounding = 1e-6 * float(np.nanmax(np.abs(grid.point_data["von_mises"]), initial=0.0))
        if max(abs(low), abs(high)) <= rounding:
            return 0.0, 0.0
    return low, high


@dataclasses.dataclass(frozen=True)
class Field:
    """What a map shows, in the units of the files."""
    increment: str            # `step 2, increment 1`
    name: str
    dimension: str
    grid: vtu.Grid
    points: np.ndarray        # n x 2, displacements magnified
    magnification: float
    triangles: np.ndarray     # T x 3, of all elastic bodies
    values: np.ndarray        # n
    range: tuple              # typical smallest and largest value of what is seen
    largest: int              # the point seen with the value of the largest size; -1 where there is none
    seen: np.ndarray          # numbers of the points seen


def field_of(results, increment=-1, component=None, magnification=None, window=None):
    """Raises ResultsError where the results have no such thing."""
    number = results.number(increment)
    grid = results.fields(number)
    component = component or ("displacement" if results.modal else default_component(grid))
    if component not in COMPONENTS:
        raise ResultsError(f"--component {component}: there are {', '.join(COMPONENTS)}")
    _, name, dimension = COMPONENTS[component]
    if results.revolved:
        name = revolution.NAMES.get(component, name)
    if results.modal:  # its size means nothing
        name, dimension = name + " of the mode" if dimension == "length" else name, "number"
    values = field_values(grid, component)
    if magnification is None:
        magnification = geometry.magnification(grid, part=0.08, least=0.0, window=window) if results.modal else \
            geometry.magnification(grid, results.contacts(number).values(), window=window)
    points = geometry.moved(grid, magnification)
    corners = geometry.triangles(grid)
    if len(corners) == 0:
        raise NothingToDraw(f"{results.directory}: has no elastic body in its fields")
    inside = corners
    if window is not None:
        x, y = points.T
        within = (x >= window[0]) & (x <= window[1]) & (y >= window[2]) & (y <= window[3])
        inside = corners[within[corners].any(axis=1)]
        if len(inside) == 0:
            raise ResultsError("--window: no part of a body lies in it; give x0,x1,y0,y1 in the units of the model")
    seen = np.unique(inside)
    finite = seen[np.isfinite(values[seen])]
    largest = int(finite[np.argmax(np.abs(values[finite]))]) if len(finite) else -1
    low, high = field_range(grid, inside, values, dimension)
    if low == high == 0.0:
        values = np.where(np.isfinite(values), 0.0, values)
    return Field(results.name_of(number), name, dimension, grid, points, magnification, corners, values, (low, high), largest, seen)


WITHOUT_BOUND = 1e3  # times the typical largest stress: that of a point very near to a crack tip


@style.styled
def stress(results, increment=-1, component=None, magnification=None, units=None, window=None):
    """Contours of a component of COMPONENTS on the deformed bodies.

    `magnification` of displacements: None chooses one, 0 draws the undeformed shape. `window`: x0, x1, y0, y1 in the model's units."""
    units = units or Units()
    number = results.number(increment)
    if len(geometry.triangles(results.fields(number))) == 0:
        return rigid_bodies(results, number, magnification, units, window)
    field = field_of(results, increment, component, magnification, window)
    scale = units.scale(field.dimension, max(map(abs, field.range)))
    place = units.scale("length", np.abs(field.points if window is None else window).max())
    levels = style.levels_of(scale.factor * field.range[0], scale.factor * field.range[1])

    low, high = (field.points.min(axis=0), field.points.max(axis=0)) if window is None else (window[::2], window[1::2])
    wide = high[1] - low[1] < 0.45 * (high[0] - low[0])  # the colour bar is then below
    width, height = style.map_size(low, high, beside=0.0 if wide else 0.95)
    figure = style.new_figure(width, height + (0.75 if wide else 0.0), results.title, described(field, scale, place))
    axis = figure.add_subplot()
    points = place.factor * field.points
    values = within_rounding(scale.factor * field.values, levels)
    drawn = style.contours(axis, points, field.triangles, values, levels, ends_of(values[field.seen], levels))
    sides = geometry.outline(field.triangles)
    if field.magnification and len(sides) <= MANY:
        style.draw_outline(axis, place.factor * field.grid.points, sides, colors="0.6", linewidths=0.4, linestyles=(0, (4, 3)), zorder=0.5)
    style.draw_outline(axis, points, sides, linewidths=0.6 if len(sides) <= MANY else 0.3)
    draw_rigid(axis, points, field.grid)
    finish_map(axis, place, window, height)
    bar = figure.colorbar(drawn, ax=axis, label=scale.label(field.name), location="bottom" if wide else "right", shrink=0.8 if wide else 0.9,
                          aspect=35 if wide else 25, pad=0.02, extendfrac=0.03)
    bar.set_ticks(bar_ticks(levels))
    return figure


def rigid_bodies(results, number, magnification, units, window):
    """Bodies that are all rigid, where they were (dashed) and moved."""
    grid = results.fields(number)
    if not geometry.rigid_outlines(grid):
        raise NothingToDraw(f"{results.directory}: has no body in its fields")
    if magnification is None:
        magnification = geometry.magnification(grid, results.contacts(number).values(), window=window)
    points = geometry.moved(grid, magnification)
    place = units.scale("length", np.abs(points if window is None else window).max())
    low, high = (points.min(axis=0), points.max(axis=0)) if window is None else (window[::2], window[1::2])
    width, height = style.map_size(low, high)
    moved = f"displacements × {magnification:g}" if magnification else "undeformed"
    figure = style.new_figure(width, height, results.title, f"{results.name_of(number)}\u00a0· rigid bodies ({moved})")
    axis = figure.add_subplot()
    for body in geometry.rigid_outlines(grid):
        sides = np.column_stack([body, np.roll(body, -1)])
        style.draw_outline(axis, place.factor * grid.points, sides, colors="0.6", linewidths=0.4, linestyles=(0, (4, 3)), zorder=0.5)
    draw_rigid(axis, place.factor * points, grid)
    finish_map(axis, place, window, height)
    return figure


def described(field, scale, place):
    """`step 1, increment 4 · von Mises stress (displacements × 50) · largest 6.1 MPa at (0, 1.5)`"""
    shape = f"deformation × {field.magnification:g}" if field.magnification else "undeformed"
    parts = [field.increment, f"{field.name} ({shape})"]
    if field.largest >= 0:
        signed = bool((field.values[field.seen] < 0).any())
        rounding = 1e-12 * geometry.extent(field.grid.points)
        at = ",\u00a0".join(f"{place.factor * value if abs(value) > rounding else 0.0:.4g}" for value in field.grid.points[field.largest])
        if field.dimension == "stress" and abs(field.values[field.largest]) > WITHOUT_BOUND * max(map(abs, field.range)) > 0:
            parts.append(f"grows without bound at ({at})")  # a number would only say how near to it the nearest point is
        else:
            parts.append(f"largest{' in size' * signed} {scale.text(field.values[field.largest])} at ({at})")
    return "\u00a0· ".join(parts)


def within_rounding(values, levels):
    """The values, without the rounding by which some lie beyond the first or the last level, as that of single numbers in a file."""
    rounding = 1e-6 * (levels[-1] - levels[0])
    values = np.where((values > levels[-1]) & (values <= levels[-1] + rounding), levels[-1], values)
    return np.where((values < levels[0]) & (values >= levels[0] - rounding), levels[0], values)


def ends_of(values, levels):
    """Whether values lie beyond the first and the last level: an arrow at the end of the colour bar says so."""
    values = values[np.isfinite(values)]
    below, above = (values < levels[0]).any(), (values > levels[-1]).any()
    return {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}[below, above]


def bar_ticks(levels, most=7):
    """Some of the levels, or, of symmetric ones, the middles of the bands, zero among them."""
    if levels[0] < 0 < levels[-1] and np.isclose(levels[0], -levels[-1]):
        middles = 0.5 * (levels[1:] + levels[:-1])
        half = len(middles) // 2
        every = max(1, -(-half // (most // 2)))
        return [value for k, value in enumerate(middles) if (k - half) % every == 0]
    every = max(1, -(-len(levels) // most))
    return list(levels[::every])


def draw_rigid(axis, points, grid):
    style.draw_hatched(axis, [points[body] for body in geometry.rigid_outlines(grid)])


def finish_map(axis, place, window, height):
    style.map_frame(axis, place.label("x"), place.label("y"))
    axis.autoscale_view()
    if window is not None:
        axis.set(xlim=place.factor * np.array(window[:2]), ylim=place.factor * np.array(window[2:]))
    style.map_ticks(axis, height)
