"""Bodies in space, coloured by a field, and their contact faces as maps. What is hidden is found in an image of depths."""
import dataclasses
import math

import numpy as np
from matplotlib import colormaps
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize
from matplotlib.lines import Line2D

from . import contacts as plane_contacts
from . import fields, geometry, paths, style
from .cuts import cut_surface
from .mechanisms import described
from .motions import AT_REST, needed_mechanism
from .motions import magnification_of as magnification_of_motion
from .results import ResultsError
from .tetrahedra import COMPONENTS, magnification_of, maps_of, outer_facets, sharp_edges, tetrahedra_of, triangles_of, values_of
from .units import Units

VIEW = (-60.0, 25.0)  # degrees: from which side and how high the eye looks
PIXELS = 1100         # along the longer side of a picture


def directions(azimuth, elevation):
    """Rows: to the right, upwards, and towards the eye."""
    a, e = math.radians(azimuth), math.radians(elevation)
    return np.array([[-math.sin(a), math.cos(a), 0.0], [-math.sin(e) * math.cos(a), -math.sin(e) * math.sin(a), math.cos(e)],
                     [math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)]])


@dataclasses.dataclass(frozen=True)
class Image:
    """What the eye sees: for each pixel a value, how far towards the eye its point lies (minus infinity: nothing), and light from 0 to 1."""
    values: np.ndarray
    depth: np.ndarray
    light: np.ndarray
    low: np.ndarray   # left and lower edge of the image
    pixel: float

    @property
    def extent(self):
        rows, columns = self.depth.shape
        return self.low[0], self.low[0] + columns * self.pixel, self.low[1], self.low[1] + rows * self.pixel


def seen_image(seen, corners, values, pixels=PIXELS):
    """`seen`: points as the eye sees them, n x 3; of triangles that turn their back nothing is seen."""
    low, high = seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)
    pixel = float((high - low).max()) / pixels
    columns, rows = (np.ceil((high - low) / pixel).astype(int) + 1)
    image = Image(np.full((rows, columns), np.nan), np.full((rows, columns), -np.inf), np.zeros((rows, columns)), low, pixel)
    normals = np.cross(seen[corners[:, 1]] - seen[corners[:, 0]], seen[corners[:, 2]] - seen[corners[:, 0]])
    lights = normals[:, 2] / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)
    places = (seen[:, :2] - low) / pixel
    for (a, b, c), area, light in zip(corners, normals[:, 2] / pixel**2, lights):
        if area <= 0.0:
            continue
        x = places[[a, b, c]]
        first, last = np.floor(x.min(axis=0)).astype(int), np.ceil(x.max(axis=0)).astype(int)
        columns_of, rows_of = np.arange(first[0], min(last[0], columns)), np.arange(first[1], min(last[1], rows))
        at_x, at_y = columns_of[None, :] + 0.5, rows_of[:, None] + 0.5
        lambdas = [((x[j, 0] - at_x) * (x[k, 1] - at_y) - (x[j, 1] - at_y) * (x[k, 0] - at_x)) / area for j, k in ((1, 2), (2, 0), (0, 1))]
        inside = np.minimum(np.minimum(lambdas[0], lambdas[1]), lambdas[2]) >= -1e-9
        if not inside.any():
            continue
        depth = sum(part * seen[node, 2] for part, node in zip(lambdas, (a, b, c)))
        part = np.s_[rows_of[0]:rows_of[-1] + 1, columns_of[0]:columns_of[-1] + 1]
        nearer = inside & (depth > image.depth[part])
        image.depth[part][nearer] = depth[nearer]
        image.values[part][nearer] = sum(part_of * values[node] for part_of, node in zip(lambdas, (a, b, c)))[nearer]
        image.light[part][nearer] = light
    return image


def visible_pieces(image, chains, seen, beyond=None, pieces=12):
    """Pieces of lines through the points of chains that no body hides, S x 2 x 2. `beyond`: how far points lie beyond a plane, to which the lines
    lead."""
    t = np.linspace(0.0, 1.0, pieces + 1)
    shapes = np.array([(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)])  # through both ends and the middle
    lines = np.einsum("ijk,jt->itk", seen[chains], shapes)
    middles = 0.5 * (lines[:, 1:] + lines[:, :-1])
    at = np.floor((middles[..., :2] - image.low) / image.pixel).astype(int)
    rows, columns = image.depth.shape
    # An edge lies on the outline of what is seen: the farthest of the pixels around it decides.
    around = np.min([image.depth[np.clip(at[..., 1] + i, 0, rows - 1), np.clip(at[..., 0] + j, 0, columns - 1)]
                     for i in (-1, 0, 1) for j in (-1, 0, 1)], axis=0)
    shown = middles[..., 2] > around - 3.0 * image.pixel
    if beyond is not None:
        far = np.einsum("ij,jt->it", beyond[chains], shapes)
        shown &= far[:, 1:] + far[:, :-1] <= 0.0
    return np.stack([lines[:, :-1, :2], lines[:, 1:, :2]], axis=2)[shown]


def visible_lines(image, lines):
    """Of straight lines L x 2 x 3."""
    count = len(lines)
    points = np.concatenate([lines[:, 0], lines.mean(axis=1), lines[:, 1]])
    return visible_pieces(image, np.arange(3 * count).reshape(3, count).T, points)


@style.styled
def stress(results, increment=-1, component=None, magnification=None, units=None, view=None, cut=None):
    """The deformed bodies, seen from `view`, azimuth and elevation in degrees, coloured by one of COMPONENTS. `cut`: a point of a plane and its
    normal, in the units of the model; what lies on the side to which this points is taken away, before the deformation."""
    units = units or Units()
    number = results.number(increment)
    grid = results.fields(number)
    component = component or "von_mises"
    if component not in COMPONENTS:
        raise ResultsError(f"--component {component}: there are {', '.join(COMPONENTS)}")
    name, dimension = COMPONENTS[component]
    if magnification is None:
        magnification = magnification_of(grid)
    values = values_of(grid, component)
    facets = outer_facets(grid)
    corners = triangles_of(facets)
    view = view or VIEW
    axes = directions(*view)
    place = units.scale("length", np.abs(grid.points).max())
    seen = place.factor * (grid.points + magnification * grid.point_data["displacement"]) @ axes.T
    beyond, lines = None, np.zeros((0, 2, 2))
    if cut is None:
        image = seen_image(seen, corners, values)
    else:
        left = cut_surface(grid.points, corners, tetrahedra_of(grid, fine=True), *cut)
        if not len(left.outline):
            raise ResultsError("--cut: the plane cuts no body")
        image = seen_image(left.of(seen), left.corners, left.of(values))
        beyond = (grid.points - cut[0]) @ np.asarray(cut[1], dtype=float)
        lines = visible_lines(image, left.of(seen)[left.outline])
    shown = image.values[np.isfinite(image.values)]
    low, high = geometry.typical_range(shown, np.ones(len(shown)))
    if dimension == "stress" and max(abs(low), abs(high)) <= 1e-6 * float(np.abs(grid.point_data["von_mises"]).max()):
        low = high = 0.0
    scale = units.scale(dimension, max(abs(low), abs(high)))
    levels = style.levels_of(scale.factor * low, scale.factor * high)
    largest = int(np.argmax(np.abs(values)))
    at = ", ".join(f"{place.factor * x:.4g}" for x in grid.points[largest])
    shape = f"deformation × {magnification:g}" if magnification else "undeformed"
    signed = " in size" * bool((values < 0).any())
    below = f"{results.name_of(number)}\u00a0· {name} ({shape})\u00a0· largest{signed} {scale.text(values[largest])} at ({at})"
    width, height = style.map_size(seen[:, :2].min(axis=0), seen[:, :2].max(axis=0), beside=0.95)
    figure = style.new_figure(width, height, results.title, below)
    axis = figure.add_subplot()
    draw_image(figure, axis, image, scale.factor * image.values, levels, scale.label(name))
    axis.add_collection(LineCollection(visible_pieces(image, sharp_edges(grid.points, facets), seen, beyond), colors="black", linewidths=0.7))
    axis.add_collection(LineCollection(lines, colors="black", linewidths=0.7))
    draw_scale(axis, image.extent, axes, place.unit)
    return figure


def draw_image(figure, axis, image, values, levels, label):
    signed = levels[0] < 0 < levels[-1]
    colours = colormaps[style.SIGNED if signed else style.MAGNITUDE if levels[-1] > 0 else style.MAGNITUDE + "_r"]
    extend = fields.ends_of(fields.within_rounding(values[np.isfinite(values)], levels), levels)
    norm = BoundaryNorm(levels, colours.N, extend=extend)
    draw_lit(axis, image, colours(norm(np.nan_to_num(values))))
    bar = figure.colorbar(style.plt.cm.ScalarMappable(norm, colours), ax=axis, label=label, shrink=0.9, aspect=25, pad=0.02, extendfrac=0.03)
    bar.set_ticks(fields.bar_ticks(levels))


def draw_lit(axis, image, colour):
    """The image in these colours, one for each pixel."""
    colour[..., :3] *= (0.78 + 0.22 * image.light)[..., None]  # faces at an angle are a little darker
    colour[..., 3] = np.isfinite(image.values)
    axis.imshow(colour, origin="lower", extent=image.extent, interpolation="none")


@style.styled
def mechanism(results, magnification=None, units=None, view=None):
    """The bodies moved, coloured by the largest displacement of each, and their edges where they are (dashed), as mechanisms.mechanism in the
    plane."""
    units = units or Units()
    grid = needed_mechanism(results)
    place = units.scale("length", np.abs(grid.points).max())
    facets = outer_facets(grid)
    if magnification is None:
        magnification = magnification_of_motion(float(np.linalg.norm(np.ptp(grid.points, axis=0))))
    axes = directions(*(view or VIEW))
    before = place.factor * grid.points @ axes.T
    after = before + place.factor * magnification * grid.point_data["displacement"] @ axes.T
    motion = np.zeros(len(grid.points))
    tetrahedra = grid.cell_data["body"] > 0
    for start, end, value in zip(grid.starts()[tetrahedra], grid.offsets[tetrahedra], grid.cell_data["motion"][tetrahedra]):
        motion[grid.connectivity[start:end]] = value
    corners = triangles_of(facets)
    image = seen_image(after, corners, motion)
    edges = sharp_edges(grid.points, facets)
    both = np.concatenate([before[edges.ravel()], after[edges.ravel()], after[corners.ravel()]])[:, :2]
    width, height = style.map_size(both.min(axis=0), both.max(axis=0), beside=0.95)
    legend = [(Line2D([], [], color="0.45", linewidth=0.8, linestyle=(0, (4, 3))), "before")]
    figure = style.new_figure(width, height, results.title, described(results, magnification, units), legend)
    axis = figure.add_subplot()
    light = ListedColormap(colormaps[style.MAGNITUDE](np.linspace(0.05, 0.75, 256)))
    colours = style.plt.cm.ScalarMappable(Normalize(0.0, 1.0), light)
    colour = colours.to_rgba(np.nan_to_num(image.values))
    colour[np.nan_to_num(image.values) <= AT_REST] = (0.96, 0.96, 0.96, 1.0)
    draw_lit(axis, image, colour)
    moved = edges[motion[edges[:, 0]] > AT_REST]
    axis.add_collection(LineCollection(before[moved][:, [0, 2], :2], colors="0.45", linewidths=0.6, linestyles=(0, (4, 3))))
    axis.add_collection(LineCollection(visible_pieces(image, edges, after), colors="black", linewidths=0.7))
    figure.colorbar(colours, ax=axis, label="largest displacement of each body", shrink=0.9, aspect=25, pad=0.02)
    (left, low), (right, high) = both.min(axis=0), both.max(axis=0)
    draw_scale(axis, (left, right, low, high), axes, place.unit)
    return figure


def draw_scale(axis, extent, axes, unit):
    """The axes, and a length, below the bodies."""
    left, right, low, high = extent
    size = 0.09 * max(right - left, high - low)
    axis.set_axis_off()
    axis.set(xlim=(left - 0.02 * size, right + 0.02 * size), ylim=(low - 2.6 * size, high + 0.2 * size))
    origin = np.array([left + 1.2 * size, low - 1.5 * size])
    for k, name in enumerate("xyz"):
        tip = size * axes[:2, k]
        if np.hypot(*tip) > 0.12 * size:
            axis.annotate("", origin + tip, origin, arrowprops={"arrowstyle": "-|>", "linewidth": 0.8, "color": "black", "shrinkA": 0, "shrinkB": 0})
            axis.text(*(origin + 1.3 * tip), name, ha="center", va="center", fontsize=8.5)
    wanted = 0.25 * (right - left)
    power = 10.0 ** math.floor(math.log10(wanted))
    length = max(step * power for step in (1, 2, 5) if step * power <= wanted * (1 + 1e-9))
    start, height = np.array([right - 0.3 * size - length, low - 1.7 * size]), 0.1 * size
    axis.plot([start[0], start[0], start[0] + length, start[0] + length], [start[1] + height, start[1], start[1], start[1] + height],
              color="black", linewidth=0.8)
    axis.text(start[0] + 0.5 * length, start[1] + height, f"{length:g} {unit}".strip(), ha="center", va="bottom", fontsize=8.5)


QUANTITIES = {"pressure": ("pressure", "stress"), "shear": ("shear", "stress"), "gap": ("gap", "length"), "slip": ("slip", "length")}
MOST_MAPS = 6


@style.styled
def contact(results, increment=-1, contacts=(), component=None, units=None, along=None):
    """Maps of the contact faces, coloured by `component`, pressure by default, with the state of every pair. `along`: both ends of a line; instead of
    maps the curves of all components, or of `component`, along it."""
    units = units or Units()
    number = results.number(increment)
    if along:
        return paths.contact(results, number, along, contacts, component, units)
    component = component or "pressure"
    if component not in QUANTITIES:
        raise ResultsError(f"--component {component}: on a contact face there are {', '.join(QUANTITIES)}")
    maps = maps_of(results, number, contacts)
    if len(maps) > MOST_MAPS:
        raise ResultsError(f"{results.directory}: has {len(maps)} contacts and ties; name up to {MOST_MAPS} of them with --contact")
    name, dimension = QUANTITIES[component]
    all_values = np.concatenate([of.values[component] for of in maps])
    scale = units.scale(dimension, np.abs(all_values).max())
    place = units.scale("length", max(np.abs(of.places).max() for of in maps))
    levels = style.levels_of(scale.factor * all_values.min(), scale.factor * all_values.max())
    columns = 1 if len(maps) == 1 else 2
    rows = -(-len(maps) // columns)
    sizes = [style.map_size(of.places.min(axis=0), of.places.max(axis=0), width=(style.WIDTH - 0.95) / columns, most=5.0) for of in maps]
    figure = style.new_figure(max(4.6, columns * max(size[0] for size in sizes) + 0.95), rows * max(size[1] + 0.2 for size in sizes), results.title,
                              f"{results.name_of(number)}\u00a0· {name}", style.state_marks(plane_contacts.counts_of(maps)))
    axes = figure.subplots(rows, columns, squeeze=False).ravel()
    for axis, of in zip(axes, maps):
        drawn = draw_map(axis, of, scale.factor * of.values[component], levels, place)
    for axis in axes[len(maps):]:
        axis.set_axis_off()
    bar = figure.colorbar(drawn, ax=list(axes), label=scale.label(name), shrink=0.9, aspect=25, pad=0.02, extendfrac=0.03)
    bar.set_ticks(fields.bar_ticks(levels))
    return figure


def draw_map(axis, of, values, levels, place):
    points = place.factor * of.places
    values = fields.within_rounding(values, levels)
    drawn = style.contours(axis, points, of.corners, values, levels, fields.ends_of(values, levels))
    style.draw_outline(axis, points, geometry.outline(of.corners), linewidths=0.6)
    style.mark_states(axis, *points.T, of.states, size=3.5, most=400)
    style.map_frame(axis, place.label(of.axes[0]), place.label(of.axes[1]))
    axis.set_title(of.name)
    axis.autoscale_view()
    return drawn
