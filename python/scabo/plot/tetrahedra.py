"""Tetrahedra of results in space and their contact faces, by NumPy alone: surfaces, edges, values, maps."""
import dataclasses
import math

import numpy as np

from . import vtu
from .results import NothingToDraw, ResultsError

STRESSES = {"xx": 0, "yy": 1, "zz": 2, "xy": 3, "yz": 4, "xz": 5}
COMPONENTS = {"von_mises": ("von Mises stress", "stress"), "principal_1": ("first principal stress", "stress"),
              "principal_2": ("second principal stress", "stress"), "principal_3": ("third principal stress", "stress"),
              **{name: (f"stress {name}", "stress") for name in STRESSES},
              "ux": ("displacement along x", "length"), "uy": ("displacement along y", "length"), "uz": ("displacement along z", "length"),
              "displacement": ("displacement", "length")}
SIDES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])  # of a tetrahedron, counter-clockwise seen from outside
MIDDLES = {(0, 1): 4, (1, 2): 5, (0, 2): 6, (0, 3): 7, (1, 3): 8, (2, 3): 9}
SHARP = math.cos(math.radians(30))


def values_of(grid, component):
    """One number for each point, in the units of the file."""
    if component in STRESSES:
        return grid.point_data["stress"][:, STRESSES[component]].astype(float)
    if component == "displacement":
        return np.linalg.norm(grid.point_data["displacement"], axis=1)
    if component in ("ux", "uy", "uz"):
        return grid.point_data["displacement"][:, "xyz".index(component[1])].astype(float)
    return grid.point_data[component].astype(float)


def outer_facets(grid):
    """Facets of one tetrahedron only, six points each, F x 6: corners, and the points between them (again corners of linear ones)."""
    facets = []
    for kind in (vtu.TETRAHEDRON, vtu.QUADRATIC_TETRAHEDRON):
        cells = grid.cells(kind)
        if len(cells) == 0:
            continue
        for side in SIDES:
            corners = cells[:, side]
            middles = corners if kind == vtu.TETRAHEDRON else \
                cells[:, [MIDDLES[tuple(sorted((side[k], side[(k + 1) % 3])))] for k in range(3)]]
            facets.append(np.column_stack([corners, middles]))
    if not facets:
        raise NothingToDraw("the fields have no tetrahedra")
    facets = np.concatenate(facets)
    _, first, times = np.unique(np.sort(facets[:, :3], axis=1), axis=0, return_index=True, return_counts=True)
    return facets[np.sort(first[times == 1])]


def triangles_of(facets):
    """Four triangles of each quadratic facet, one of a linear one."""
    linear = facets[:, 3] == facets[:, 0]
    parts = [facets[linear][:, :3]]
    parts += [facets[~linear][:, corners] for corners in ([0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5])]
    return np.concatenate(parts)


def sharp_edges(points, facets):
    """Edges of the facets at which the boundary turns by more than 30 degrees, as chains of points E x 3."""
    normals = np.cross(points[facets[:, 1]] - points[facets[:, 0]], points[facets[:, 2]] - points[facets[:, 0]])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    ends = np.concatenate([facets[:, [k, 3 + k, (k + 1) % 3]] for k in range(3)])
    of_facet = np.tile(np.arange(len(facets)), 3)
    keys = np.sort(ends[:, [0, 2]], axis=1)
    order = np.lexsort(keys.T)
    pairs = np.flatnonzero((keys[order][1:] == keys[order][:-1]).all(axis=1))
    one, other = order[pairs], order[pairs + 1]
    sharp = np.einsum("ij,ij->i", normals[of_facet[one]], normals[of_facet[other]]) < SHARP
    return ends[one[sharp]]


def magnification_of(grid, part=0.05):
    """1, 2 or 5 times a power of ten, so that the largest displacement is drawn as `part` of the model's diagonal or less."""
    displacement = grid.point_data["displacement"]
    size = float(np.linalg.norm(np.ptp(grid.points, axis=0)))
    largest = float(np.linalg.norm(displacement - displacement.mean(axis=0), axis=1).max())
    if not largest > 1e-15 * size:
        return 1.0
    factor = part * size / largest
    power = 10.0 ** np.floor(np.log10(factor))
    return max(1.0, max(step * power for step in (1, 2, 5) if step * power <= factor * (1 + 1e-9)))


@dataclasses.dataclass(frozen=True)
class FaceMap:
    """A contact face after one increment, in the units of the file, with one value for each pair."""
    name: str
    places: np.ndarray   # n x 2, in the plane of the face
    axes: tuple          # what the two coordinates are called
    corners: np.ndarray  # T x 3, triangles between pairs
    values: dict         # pressure, shear, gap, slip
    states: np.ndarray   # open, stick or slip


def maps_of(results, number, names=()):
    """The contact faces of one increment, all or those named."""
    known = list(results.increments[number - 1]["contacts"])
    if not known:
        raise NothingToDraw(f"{results.directory}: the model has no contact")
    for name in names:
        if name not in known:
            raise ResultsError(f"--contact {name}: there is no such contact; there {'is' if len(known) == 1 else 'are'} {', '.join(known[:12])}")
    grid = results.faces(number)
    return [map_of(name, grid, known.index(name) + 1) for name in (names or known)]


def map_of(name, grid, contact):
    chosen = grid.point_data["contact"] == contact
    data = {key: values[chosen] for key, values in grid.point_data.items()}
    points = grid.points[chosen]
    new_number = np.cumsum(chosen) - 1
    corners = new_number[grid.cells(vtu.TRIANGLE)[grid.cell_data["contact"] == contact]].astype(int)
    normal = data["normal"].mean(axis=0)
    along = int(np.argmax(np.abs(normal)))
    if abs(normal[along]) > 1 - 1e-9:  # the axes themselves
        kept = [k for k in range(3) if k != along]
        places, axes = points[:, kept], tuple("xyz"[k] for k in kept)
    else:
        first = np.cross([0, 0, 1], normal) if abs(normal[2]) < 0.9 else np.cross([0, 1, 0], normal)
        first /= np.linalg.norm(first)
        second = np.cross(normal, first)
        places = (points - points.mean(axis=0)) @ np.column_stack([first, second / np.linalg.norm(second)])
        axes = ("along the face", "across it")
    rounding = 4e-16 * np.abs(points).max()
    cleared = lambda values: np.where(np.abs(values) <= rounding, 0.0, values)
    return FaceMap(name, places, axes, corners,
                   {"pressure": data["pressure"], "shear": np.linalg.norm(data["shear"], axis=1), "gap": cleared(data["gap"]),
                    "slip": cleared(np.linalg.norm(data["slip"], axis=1))}, np.array(["open", "stick", "slip"])[data["state"]])
