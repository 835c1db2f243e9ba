"""The fields of a page: one mesh, and its values after the increments that have a place in it."""
import numpy as np

from .choice import in_order_of_importance, listed, mesh_may_change
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
DERIVED = (*GROUPS["principal"], *GROUPS["von_mises"])  # by the page, where it has all stresses


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
    """Adds meshes and values of the quantities that are asked for, up to `budget` bytes beyond those of one increment. Returns what the page
    has to know, or None where the results have no fields. Increments have meshes of their own where bodies come or go, or cracks grow."""
    numbers = [number for number in results.field_numbers() if number <= results.count]
    if not numbers:
        return None
    last = results.fields(numbers[-1])
    if len(geometry.triangles(last)) == 0 and not geometry.rigid_outlines(last):
        return None
    quantities = {key: entry for key, entry in (asked or QUANTITIES).items() if entry[0] in last.point_data}
    if asked and not quantities:
        raise ResultsError(f"--fields: {results.directory} has none of these fields, as the model did not ask for them (`output.fields`)")
    centre = 0.5 * (last.points.min(axis=0) + last.points.max(axis=0))
    meshes = Meshes(results, arrays, centre)
    meshes.of(last, numbers[-1])
    chosen = add_values(results, numbers, meshes, quantities, arrays, budget)
    return {"centre": centre.tolist(), "points": len(last.points), "triangles": len(meshes.corners[0]),
            "bodies": int(max(grid.point_data["body"].max() for grid in meshes.grids)), "increments": sorted(chosen), "ranges": chosen,
            "mesh_of": {number: meshes.index[number] for number in chosen}, "magnification": scale_of(results, sorted(chosen)[-1]),
            "low": np.min([grid.points.min(axis=0) for grid in meshes.grids], axis=0).tolist(),
            "high": np.max([grid.points.max(axis=0) for grid in meshes.grids], axis=0).tolist(),
            "note": note_of(results, numbers, sorted(chosen), meshes),
            "quantities": [{"key": key, "name": revolution.NAMES.get(key, name) if results.revolved else name, "dimension": dimension} for key, (_, _, name, dimension) in quantities.items()]}


class Meshes:
    """The different meshes of the increments, each once, in the order in which they are first asked for."""

    def __init__(self, results, arrays, centre):
        self.results, self.arrays, self.centre = results, arrays, centre
        self.grids, self.corners, self.rigid = [], [], []
        self.index = {}  # by the number of an increment
        self.without_cells = False

    def of(self, grid, number):
        """Its number from 0; the arrays of a new one are added."""
        known = next((k for k, other in enumerate(self.grids) if np.array_equal(other.points, grid.points) and
                      np.array_equal(other.connectivity, grid.connectivity)), None)
        if known is None:
            known = len(self.grids)
            self.add(grid, known)
        self.index[number] = known
        return known

    def add(self, grid, number):
        corners, rigid = geometry.triangles(grid), geometry.rigid_outlines(grid)
        outline = geometry.outline(corners)
        sides, nodes = elements_of(self.results, grid, outline, last=number == 0)
        self.without_cells |= sides is None
        none = np.zeros((0, 2), dtype=int)
        for name, values, kind in (("points", grid.points - self.centre, "f4"), ("triangles", corners, "u4"), ("outline", outline, "u4"),
                                   ("mesh", sides_of_cells(grid), "u4"), ("elements", none if sides is None else sides, "u4"),
                                   ("nodes", none if sides is None else nodes, "u4"), ("body", grid.point_data["body"], "u4"),
                                   ("rigid", np.concatenate(rigid) if rigid else [], "u4"), ("rigid_sizes", [len(polygon) for polygon in rigid], "u4")):
            self.arrays.add(f"{name}_of_mesh_{number}", values, kind)
        self.grids.append(grid)
        self.corners.append(corners)
        self.rigid.append(rigid)


def scale_of(results, number):
    """The magnification of displacements with which the page opens."""
    grid = results.fields(number)
    if results.modal:
        return geometry.magnification(grid, part=0.08, least=0.0)
    return geometry.magnification(grid, results.contacts(number).values())


def note_of(results, written, chosen, meshes):
    """What is missing, in a sentence; empty if nothing is."""
    what = "modes" if results.modal else "increments"
    cells = "Super-elements are drawn on the last mesh only." if meshes.without_cells else ""
    if len(chosen) == results.count:
        return cells
    if len(written) < results.count and len(chosen) == len(written):
        return f"The run wrote fields of {len(written)} of its {results.count} {what}: {listed(chosen)}. {cells}".strip()
    return (f"This page has the fields of {len(chosen)} of {results.count} {what} ({listed(chosen)}), which keeps its size within bounds; "
            "`scabo report --size` sets another bound. All other values are those of every one. {cells}").strip()


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


def elements_of(results, grid, outline, last):
    """Sides of the super-elements, or finite elements, and the nodes of the mesh, by points of the fields. None where cells.vtu, which is that
    of the last mesh, is of another one."""
    bodies = grid.point_data["body"]
    cells = results.cells()
    if cells is None:
        starts = np.flatnonzero(np.diff(bodies, prepend=0))
        elastic = np.unique(bodies[outline[:, 0]]) if len(outline) else []
        nodes = [geometry.nodes_on(outline, first) for first in starts if bodies[first] in elastic]
        nodes = np.concatenate(nodes) if nodes else np.zeros(0, dtype=int)
        return geometry.boundary_sides(outline, nodes), nodes
    place = places_of_nodes(cells, grid)
    if place is None:
        if last:
            raise ResultsError("cells.vtu does not belong to the fields beside it; run the model again")
        return None, None
    rings = [place[ring] for ring in cells.lists(vtu.POLYGON)]
    sides = [np.stack([ring, np.roll(ring, -1)], axis=1) for ring in rings] + [place[cells.cells(vtu.LINE)[:, :2]]]
    sides = np.concatenate(sides)
    sides = geometry.distinct_sides(sides[(sides >= 0).all(axis=1)])[0]
    return sides, np.unique(sides)


def places_of_nodes(cells, grid):
    """For each point of cells.vtu, a node, its number among the points of the fields, which begin with the nodes of every body; -1 where
    the body is absent. None where the cells are of another mesh."""
    owner = np.zeros(len(cells.points), dtype=int)
    owner[cells.connectivity] = np.repeat(cells.cell_data["body"], np.diff(cells.offsets, prepend=0))
    place = np.zeros(len(cells.points), dtype=int)
    for body in np.unique(owner[owner > 0]):
        own, there = np.flatnonzero(owner == body), np.flatnonzero(grid.point_data["body"] == body)
        place[own] = there[0] + own - own[0] if len(there) else -1
    size = geometry.extent(grid.points)
    used = (owner > 0) & (place >= 0)
    if place[used].max(initial=-1) >= len(grid.points) or not np.allclose(grid.points[place[used]], cells.points[used], rtol=0, atol=1e-6 * size):
        return None
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


def add_values(results, numbers, meshes, quantities, arrays, budget):
    """Returns, for each increment that found a place, the typical and the extreme range of every quantity."""
    if results.modal:
        ends = []
    else:
        steps = [entry["step"] for entry in results.increments]
        ends = [number for number in range(1, results.count) if steps[number] != steps[number - 1]]
    wanted = [numbers[k - 1] for k in in_order_of_importance(len(numbers), [numbers.index(end) + 1 for end in ends if end in numbers])]
    chosen, spent, weights = {}, 0, {}
    for number in wanted:
        if chosen and spent + spent / len(chosen) > budget:
            break
        grid, before = results.fields(number), arrays.size
        if not mesh_may_change(results) and not np.array_equal(grid.points, meshes.grids[0].points):
            raise ResultsError(f"{results.directory}: the fields of increment {number} belong to another mesh; run the model again")
        mesh = meshes.of(grid, number)
        if mesh not in weights:
            weights[mesh] = weights_of(grid.points, meshes.corners[mesh])
        ranges = {}
        loudest = 1e-6 * float(np.nanmax(np.abs(grid.point_data["von_mises"]), initial=0.0)) if "von_mises" in grid.point_data else 0.0
        for key, entry in quantities.items():
            values = values_of(grid, entry, meshes.rigid[mesh])
            ranges[key] = range_of(values, weights[mesh], loudest if entry[3] == "stress" else 0.0)
            if key not in DERIVED or not set(GROUPS["stress"]) <= set(quantities):
                arrays.add(f"{key}_{number}", values)
        if "ux" in quantities:
            ranges["displacement"] = range_of(np.hypot(*grid.point_data["displacement"][:, :2].T), weights[mesh], 0.0)
        spent += arrays.size - before
        chosen[number] = ranges
    return chosen


def weights_of(points, corners):
    """Of the points: thirds of the areas of their triangles."""
    if len(corners) == 0:
        return np.ones(len(points))
    return np.bincount(corners.reshape(-1), np.repeat(geometry.areas(points, corners), 3), len(points))


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
