"""Arrays from grids: triangles, outlines, distances, and how much to magnify displacements. Nothing is drawn here."""
import numpy as np

from . import vtu


def triangles(grid):
    """All elastic cells as triangles, T x 3; midside nodes of quadratic cells are corners of triangles too."""
    linear, quads = grid.cells(vtu.TRIANGLE), grid.cells(vtu.QUAD)
    quadratic, serendipity = grid.cells(vtu.QUADRATIC_TRIANGLE), grid.cells(vtu.QUADRATIC_QUAD)
    parts = [linear[:, [0, 1, 2]]]
    if len(quads):  # along the shorter diagonal: along the longer one, contours of narrow cells are ragged
        first, second = (np.hypot(*(grid.points[quads[:, k + 2]] - grid.points[quads[:, k]]).T) for k in (0, 1))
        other = second < first * (1 - 1e-6)
        quads = np.where(other[:, None], np.roll(quads, -1, axis=1), quads)
        parts += [quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]
    if len(quadratic):
        parts += [quadratic[:, corners] for corners in ([0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5])]
    if len(serendipity):
        parts += [serendipity[:, corners] for corners in
                  ([0, 4, 7], [4, 1, 5], [5, 2, 6], [6, 3, 7], [4, 5, 7], [5, 6, 7])]
    return np.concatenate(parts).astype(int)


def outline(corners):
    """Sides that belong to one triangle of T x 3 only: S x 2. Bodies share no points, so that each has its own."""
    sides, times = distinct_sides(corners[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2))
    return sides[times == 1]


def distinct_sides(sides):
    """Each of S x 2 sides once, in ascending order, its smaller point first, and how often it occurs in either direction."""
    if len(sides) == 0:
        return np.zeros((0, 2), dtype=int), np.zeros(0, dtype=int)
    low, high = sides.min(axis=1).astype(np.int64), sides.max(axis=1).astype(np.int64)
    count = int(high.max()) + 1
    keys, times = np.unique(low * count + high, return_counts=True)  # one number for each: ten times as fast as rows
    return np.column_stack([keys // count, keys % count]), times


def nodes_on(sides, first):
    """Numbers of the nodes of a super-element whose outline is in `sides` and whose first point is `first`: its points begin with them,
    in the order of its boundary; between two of them there may be one more point. Other points of an outline are those at which a crack or
    unbounded ground was sampled."""
    along = {}
    for one, other in sides.tolist():
        along.setdefault(one, set()).add(other)
        along.setdefault(other, set()).add(one)
    last = first
    while last in along and (last + 1 in along[last] or any(last + 1 in along[point] for point in along[last] if point > last + 1)):
        last += 1
    return np.arange(first, last + 1)


def boundary_sides(sides, nodes):
    """Those of the sides that are boundary elements, or parts of them: from nodes to nodes or to points between two nodes."""
    is_node = np.isin(sides, nodes)
    mixed = is_node[:, 0] != is_node[:, 1]
    points, times = np.unique(sides[mixed][~is_node[mixed]], return_counts=True)
    return sides[(is_node | np.isin(sides, points[times == 2])).all(axis=1)]


def rigid_outlines(grid):
    """Points of each rigid body, which a file of fields has as one polygon."""
    return grid.lists(vtu.POLYGON)


def moved(grid, magnification=0.0):
    """Points n x 2 with their displacements magnified."""
    if not magnification or "displacement" not in grid.point_data:
        return grid.points
    return grid.points + magnification * grid.point_data["displacement"][:, :2]


def extent(points):
    """Diagonal of the box around the points."""
    return float(np.hypot(*np.ptp(points, axis=0))) if len(points) else 0.0


def magnification(grid, contacts=(), part=0.04, overlap=0.004, least=1.0, window=None):
    """1, 2 or 5 times a power of ten, so that the largest displacement is drawn as `part` of the model's diagonal or less; `least`
    where displacements are larger than that. A translation of all points is not counted: only what can be seen. `contacts`: tables of pairs
    (results.py), whose sides are not drawn through each other by more than `overlap` of the diagonal. `window`: x0, x1, y0, y1, with the points
    and the diagonal of which it is done."""
    displacement = grid.point_data.get("displacement")
    if displacement is None or len(displacement) == 0:
        return 0.0
    size = extent(grid.points)
    if window is not None:
        x, y = grid.points.T
        inside = (x >= window[0]) & (x <= window[1]) & (y >= window[2]) & (y <= window[3])
        displacement = displacement[inside] if inside.any() else displacement
        size = min(size, float(np.hypot(window[1] - window[0], window[3] - window[2])))
    seen = displacement[:, :2] - displacement[:, :2].mean(axis=0)
    largest = np.hypot(*seen.T).max()
    whole = np.hypot(*displacement[:, :2].T).max()
    if not np.isfinite(largest) or largest <= 1e-9 * whole or largest <= 1e-15 * size:
        return 1.0
    factor = part * size / largest
    for rows in contacts:  # gap = initial gap + opening; drawn: initial gap + factor * opening
        opening = rows["normal_displacement_b"] - rows["normal_displacement_a"]
        closing = opening < 0
        if closing.any():
            factor = min(factor, np.min((overlap * size + np.maximum(rows["gap"] - opening, 0.0)[closing]) / -opening[closing]))
    power = 10.0 ** np.floor(np.log10(factor))
    return max(least, max(step * power for step in (1, 2, 5) if step * power <= factor * (1 + 1e-9)))


def areas(points, corners):
    """Area of each triangle."""
    first, second = (points[corners[:, k]] - points[corners[:, 0]] for k in (1, 2))
    return 0.5 * np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])


def arc_length(x, y):
    """Distance of each point of a line from its first one, along the line."""
    return np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])


def typical_range(values, weights, part=0.004):
    """Smallest and largest value without the `part` of the weight at either end, where stress grows without bound at corners; the
    true ones where they are not far away."""
    finite = np.isfinite(values) & (weights > 0)
    values, weights = values[finite], weights[finite]
    if len(values) == 0:
        return 0.0, 0.0
    order = np.argsort(values)
    values, share = values[order], np.cumsum(weights[order]) / weights.sum()
    low, high = values[np.searchsorted(share, part)], values[min(np.searchsorted(share, 1 - part), len(values) - 1)]
    span = high - low
    low = values[0] if low - values[0] <= 0.5 * span else low
    high = values[-1] if values[-1] - high <= 0.5 * span else high
    return float(low), float(high)
