"""The mesh as it was divided."""
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.patches import Patch

from . import fields, geometry, style, vtu
from .curves import short_name
from .results import NothingToDraw
from .units import Units

MOST_DOTS = 700  # nodes that are marked

@style.styled
def mesh(results, units=None, window=None):
    """The cells of all bodies as they were divided, undeformed, with a tint for each material and a dot at each node where they are few;
    cracks that grew are drawn over them, with a mark at each point."""
    units = units or Units()
    grid = results.cells()
    if grid is None:
        return mesh_of_fields(results, units, window)
    place = units.scale("length", np.abs(grid.points if window is None else window).max())
    points = place.factor * grid.points
    materials = np.asarray(grid.cell_data["material"])
    is_cell = grid.types == vtu.POLYGON
    kinds = np.unique(materials[is_cell])
    tints = {kind: str(0.97 - 0.2 * k / max(1, len(kinds) - 1) if len(kinds) > 1 else 0.94) for k, kind in enumerate(kinds)}
    finite = grid.cell_data["finite_element"][is_cell]
    counts = [counted(number, noun) for number, noun in ((int((finite == 0).sum()), "super-element"), (int(finite.sum()), "finite element"))
              if number]
    legend = [(Patch(facecolor=tints[kind], edgecolor="0.3", linewidth=0.6), name_of_material(results, kind)) for kind in kinds]
    if len(kinds) == 1:
        legend = []
    low, high = (grid.points.min(axis=0), grid.points.max(axis=0)) if window is None else (window[::2], window[1::2])
    width, height = style.map_size(low, high)
    model = results.summary["model"]
    subtitle = f"mesh: {', '.join(counts) or 'boundary elements'}; {model['nodes']} nodes, {model['dofs']} degrees of freedom"
    figure = style.new_figure(width, height, results.title, subtitle, legend[:6])
    axis = figure.add_subplot()
    lines = 0.4 if len(materials) < 4000 else 0.15
    for kind in kinds:
        bodies = [points[cell] for cell, of in zip(grid.lists(vtu.POLYGON), materials[is_cell]) if of == kind]
        axis.add_collection(PolyCollection(bodies, facecolors=tints[kind], edgecolors="0.25", linewidths=lines))
    boundary = grid.cells(vtu.LINE)
    if len(boundary):
        style.draw_outline(axis, points, boundary, linewidths=1.6, colors=style.BLUE)
    if len(points) <= MOST_DOTS:
        axis.plot(*points[np.unique(grid.connectivity)].T, ".", color="black", markersize=2.5, markeredgewidth=0)
    for path in results.summary.get("growth", {}).get("paths", {}).values():
        axis.plot(*place.factor * np.array(path).T, "o-", color=style.RED, linewidth=1.2, markersize=2.5, markeredgewidth=0)
    finish_mesh(axis, results, place, window, height)
    return figure


def name_of_material(results, number):
    """As in the model file; cells.vtu has its number, from 1."""
    materials = results.summary["model"].get("materials", [])
    return short_name(materials[int(number) - 1]["name"]) if 1 <= number <= len(materials) else f"material {int(number)}"


def mesh_of_fields(results, units, window):
    """Where no body has several cells: the boundary of every super-element with its nodes; dashed what has none, the faces of cracks and
    the end of what is drawn of unbounded ground."""
    grid = results.last_fields()
    if grid is None:
        raise NothingToDraw(f"{results.directory}: has neither cells.vtu nor fields, so there is no mesh to draw")
    place = units.scale("length", np.abs(grid.points if window is None else window).max())
    points = place.factor * grid.points
    sides = geometry.outline(geometry.triangles(grid))
    low, high = (grid.points.min(axis=0), grid.points.max(axis=0)) if window is None else (window[::2], window[1::2])
    width, height = style.map_size(low, high)
    model = results.summary["model"]
    figure = style.new_figure(width, height, results.title, f"mesh: {counted(model['super_elements'], 'super-element')}, divided on "
                                                            f"the boundary only; {model['nodes']} nodes, {model['dofs']} degrees of freedom")
    axis = figure.add_subplot()
    bodies = grid.point_data["body"]
    firsts = np.intersect1d(np.flatnonzero(np.diff(bodies, prepend=0)), sides)  # not those of rigid bodies
    nodes = np.concatenate([geometry.nodes_on(sides, first) for first in firsts] or [np.zeros(0, dtype=int)])
    divided = geometry.boundary_sides(sides, nodes)
    style.draw_outline(axis, points, divided)
    style.draw_outline(axis, points, sides[~np.isin(sides, divided).all(axis=1)], colors="0.5", linestyles=(0, (4, 3)))
    if len(nodes) <= MOST_DOTS:
        axis.plot(*points[nodes].T, ".", color="black", markersize=3.5, markeredgewidth=0)
    finish_mesh(axis, results, place, window, height)
    return figure


def counted(number, noun):
    return f"{number} {noun}{'s' * (number != 1)}"


def finish_mesh(axis, results, place, window, height):
    grid = results.last_fields()
    if grid is not None:
        fields.draw_rigid(axis, place.factor * grid.points, grid)
    fields.finish_map(axis, place, window, height)
