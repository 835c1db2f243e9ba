"""The fields of a page: one mesh, and its values after the increments that have a place in it."""
import numpy as np

from .choice import in_order_of_importance, listed, mesh_may_change
from .packing import pack
from .reading import ResultsError, geometry, revolution, vtu

# key: array of the file and its component, name, dimension
QUANTITIES = {
    "ux": ("displacement", 0, "displacement along x", "length"),
    "uy": ("displacement", 1, "displacement along y", "length"),
    "von_mises": ("von_mises", None, "von Mises stress", "stress"),
    "principal_1": ("principal_1", None, "first principal stress", "stress"),
    "principal_2": ("principal_2", None, "second principal stress", "stress"),
    "principal_3": ("principal_3", None, "third principal stress", "stress"),
    "xx": ("stress_xx", None, "stress xx", "stress"),
    "yy": ("stress_yy", None, "stress yy", "stress"),
    "xy": ("stress_xy", None, "stress xy", "stress"),
    "zz": ("stress_zz", None, "stress zz", "stress"),
}
LINEAR_CORNERS = {vtu.TRIANGLE: 3, vtu.QUAD: 4, vtu.QUADRATIC_TRIANGLE: 3, vtu.QUADRATIC_QUAD: 4}


GROUPS = {"displacement": ("ux", "uy"), "stress": ("xx", "yy", "xy", "zz"), "principal": ("principal_1", "principal_2", "principal_3"),
          "von_mises": ("von_mises",)}  # as in output.fields of a model


def asked_for(names):
    """The quantities of names as in "displacement,von_mises"; None: all. Raises ResultsError."""
    if names is None:
        return None
    listed_names = [name.strip() for name in names.split(",")]
    for name in listed_names:
        if name not in GROUPS:
            raise ResultsError(f"--fields {names}: there are no fields '{name}': give some of {', '.join(GROUPS)}, with commas between them")
    wanted = {key for name in listed_names for key in GROUPS[name]}
    return {key: entry for key, entry in QUANTITIES.items() if key in wanted}


def add_fields(results, arrays, budget, asked=None):
    """Adds mesh and values of the quantities that are asked for, values up to `budget` bytes beyond those of one increment. Returns what the page has to know, or None where
    the results have no fields."""
    numbers = [number for number in results.field_numbers() if number <= results.count]
    if not numbers:
        return None
    first = results.fields(numbers[-1])
    corners = geometry.triangles(first)
    rigid = geometry.rigid_outlines(first)
    if len(corners) == 0 and not rigid:
        return None
    centre = 0.5 * (first.points.min(axis=0) + first.points.max(axis=0))
    arrays.add("points", first.points - centre)
    arrays.add("triangles", corners, "u4")
    outline = geometry.outline(corners)
    arrays.add("outline", outline, "u4")
    arrays.add("mesh", sides_of_cells(first), "u4")
    add_elements(results, first, outline, arrays)
    arrays.add("body", first.point_data["body"], "u4")
    arrays.add("rigid", np.concatenate(rigid) if rigid else [], "u4")
    arrays.add("rigid_sizes", [len(polygon) for polygon in rigid], "u4")
    quantities = {key: entry for key, entry in (asked or QUANTITIES).items() if entry[0] in first.point_data}
    if asked and not quantities:
        raise ResultsError(f"--fields: {results.directory} has none of these fields, as the model did not ask for them (`output.fields`)")
    chosen, of_other_meshes = add_values(results, numbers, first, quantities, corners, rigid, arrays, budget)
    return {"centre": centre.tolist(), "points": len(first.points), "triangles": len(corners), "bodies": int(first.point_data["body"].max()), "increments": sorted(chosen), "ranges": chosen,
            "magnification": scale_of(results, sorted(chosen)[-1]), "low": first.points.min(axis=0).tolist(),
            "high": first.points.max(axis=0).tolist(), "note": note_of(results, numbers, sorted(chosen), of_other_meshes),
            "quantities": [{"key": key, "name": revolution.NAMES.get(key, name) if results.revolved else name, "dimension": dimension} for key, (_, _, name, dimension) in quantities.items()]}


def scale_of(results, number):
    """The magnification of displacements with which the page opens."""
    grid = results.fields(number)
    if results.modal:
        return geometry.magnification(grid, part=0.08, least=0.0)
    return geometry.magnification(grid, results.contacts(number).values())


def note_of(results, written, chosen, of_other_meshes):
    """What is missing, in a sentence; empty if nothing is."""
    what = "modes" if results.modal else "increments"
    if len(chosen) == results.count:
        return ""
    if of_other_meshes:
        return (f"This page has the fields of {listed(chosen)} of {results.count} {what}, those with the mesh of the last one: bodies are added or "
                "removed in this run, or bodies are divided again. All other values are those of every one.")
    if len(written) < results.count and len(chosen) == len(written):
        return f"The run wrote fields of {len(written)} of its {results.count} {what}: {listed(chosen)}."
    return (f"This page has the fields of {len(chosen)} of {results.count} {what} ({listed(chosen)}), which keeps its size within bounds; "
            "`scabo report --size` sets another bound. All other values are those of every one.")


def sides_of_cells(grid):
    """Sides of all cells, each once: S x 2."""
    parts = []
    for kind, count in LINEAR_CORNERS.items():
        cells = grid.cells(kind)
        if len(cells) == 0:
            continue
        ring = cells[:, :count]
        if kind in (vtu.QUADRATIC_TRIANGLE, vtu.QUADRATIC_QUAD):  # corner, middle, corner ...
            ring = np.stack([ring, cells[:, count:2 * count]], axis=2).reshape(len(cells), -1)
        parts.append(np.stack([ring, np.roll(ring, -1, axis=1)], axis=2).reshape(-1, 2))
    return geometry.distinct_sides(np.concatenate(parts))[0] if parts else np.zeros((0, 2), dtype=int)


def add_elements(results, grid, outline, arrays):
    """Sides of the super-elements, or finite elements, and the nodes of the mesh, by points of the fields."""
    bodies = grid.point_data["body"]
    cells = results.cells()
    if cells is None:
        starts = np.flatnonzero(np.diff(bodies, prepend=0))
        elastic = np.unique(bodies[outline[:, 0]]) if len(outline) else []
        nodes = [geometry.nodes_on(outline, first) for first in starts if bodies[first] in elastic]
        nodes = np.concatenate(nodes) if nodes else np.zeros(0, dtype=int)
        sides = geometry.boundary_sides(outline, nodes)
    else:
        place = places_of_nodes(cells, grid)
        rings = [place[ring] for ring in cells.lists(vtu.POLYGON)]
        sides = [np.stack([ring, np.roll(ring, -1)], axis=1) for ring in rings] + [place[cells.cells(vtu.LINE)[:, :2]]]
        sides = np.concatenate(sides)
        sides = geometry.distinct_sides(sides[(sides >= 0).all(axis=1)])[0]
        nodes = np.unique(sides)
    arrays.add("elements", sides, "u4")
    arrays.add("nodes", nodes, "u4")


def places_of_nodes(cells, grid):
    """For each point of cells.vtu, a node, its number among the points of the fields, which begin with the nodes of every body; -1 where
    the body is absent."""
    owner = np.zeros(len(cells.points), dtype=int)
    owner[cells.connectivity] = np.repeat(cells.cell_data["body"], np.diff(cells.offsets, prepend=0))
    place = np.zeros(len(cells.points), dtype=int)
    for body in np.unique(owner[owner > 0]):
        own, there = np.flatnonzero(owner == body), np.flatnonzero(grid.point_data["body"] == body)
        place[own] = there[0] + own - own[0] if len(there) else -1
    size = geometry.extent(grid.points)
    used = (owner > 0) & (place >= 0)
    if not np.allclose(grid.points[place[used]], cells.points[used], rtol=0, atol=1e-6 * size):
        raise ResultsError("cells.vtu does not belong to the fields beside it; run the model again")
    return place


def values_of(grid, entry, rigid):
    """One number for each point; not a number in rigid bodies, which have no stress."""
    array, component, _, dimension = entry
    values = grid.point_data[array]
    values = np.array(values if component is None else values[:, component], dtype="f4")
    if dimension == "stress":
        for points in rigid:
            values[points] = np.nan
    return values


def add_values(results, numbers, mesh, quantities, corners, rigid, arrays, budget):
    """Returns, for each increment that found a place, the typical and the extreme range of every quantity; and the increments whose fields
    are on another mesh."""
    if results.modal:
        ends = []
    else:
        steps = [entry["step"] for entry in results.increments]
        ends = [number for number in range(1, results.count) if steps[number] != steps[number - 1]]
    wanted = [numbers[k - 1] for k in in_order_of_importance(len(numbers), [numbers.index(end) + 1 for end in ends if end in numbers])]
    shape, chosen, of_other_meshes, spent = mesh.points, {}, [], 0
    weights = np.bincount(corners.reshape(-1), np.repeat(geometry.areas(shape, corners), 3), len(shape)) if len(corners) else np.ones(len(shape))
    for number in wanted:
        if chosen and spent + spent / len(chosen) > budget:
            break
        grid = results.fields(number)
        if not np.array_equal(grid.points, shape):
            if not mesh_may_change(results):
                raise ResultsError(f"{results.directory}: the fields of increment {number} belong to another mesh; run the model again")
            of_other_meshes.append(number)
            continue
        ranges = {}
        loudest = 1e-6 * float(np.nanmax(np.abs(grid.point_data["von_mises"]), initial=0.0)) if "von_mises" in grid.point_data else 0.0
        for key, entry in quantities.items():
            values = values_of(grid, entry, rigid)
            ranges[key] = range_of(values, weights, loudest if entry[3] == "stress" else 0.0)
            text = pack(values, "f4")
            arrays.put(f"{key}_{number}", "f4", len(values), text)
            spent += len(text)
        if "ux" in quantities:
            ranges["displacement"] = range_of(np.hypot(*grid.point_data["displacement"][:, :2].T), weights, 0.0)
        chosen[number] = ranges
    return chosen, of_other_meshes


def range_of(values, weights, rounding):
    """[low, high, least, greatest]: the typical range, for colours, and the extreme values; zeros where there is only rounding."""
    finite = values[np.isfinite(values)]
    if len(finite) == 0:
        return [0.0] * 4
    least, greatest = float(finite.min()), float(finite.max())
    low, high = geometry.typical_range(values, weights)
    if max(abs(low), abs(high)) <= rounding:
        low = high = 0.0
    return [low, high, least, greatest]


