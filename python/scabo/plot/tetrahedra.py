"""Tetrahedra, wedges and hexahedra of results in space and their contact faces, by NumPy alone: surfaces, edges, values, maps."""
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
# Of cells by VTK's numbers: corners of their sides, counter-clockwise seen from outside; and the edges of their middle nodes.
SIDES_OF_TETRAHEDRON = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
SIDES = {vtu.TETRAHEDRON: SIDES_OF_TETRAHEDRON, vtu.QUADRATIC_TETRAHEDRON: SIDES_OF_TETRAHEDRON,
         vtu.QUADRATIC_WEDGE: [[0, 2, 1], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]],
         vtu.QUADRATIC_HEXAHEDRON: [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]}
EDGES = {vtu.TETRAHEDRON: [], vtu.QUADRATIC_TETRAHEDRON: [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)],
         vtu.QUADRATIC_WEDGE: [(0, 1), (1, 2), (0, 2), (3, 4), (4, 5), (3, 5), (0, 3), (1, 4), (2, 5)],
         vtu.QUADRATIC_HEXAHEDRON: [(0, 1), (1, 2), (2, 3), (0, 3), (4, 5), (5, 6), (6, 7), (4, 7), (0, 4), (1, 5), (2, 6), (3, 7)]}
CORNERS = {vtu.TETRAHEDRON: 4, vtu.QUADRATIC_TETRAHEDRON: 4, vtu.QUADRATIC_WEDGE: 6, vtu.QUADRATIC_HEXAHEDRON: 8}
# Tetrahedra between the corners of a cell.
PARTS = {vtu.TETRAHEDRON: [[0, 1, 2, 3]], vtu.QUADRATIC_TETRAHEDRON: [[0, 1, 2, 3]],
         vtu.QUADRATIC_WEDGE: [[0, 1, 2, 5], [0, 1, 5, 4], [0, 4, 5, 3]],
         vtu.QUADRATIC_HEXAHEDRON: [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]]}
# Those between all points of a quadratic tetrahedron, whose sides are the triangles of its facets.
FINE_PARTS = [[0, 4, 6, 7], [4, 1, 5, 8], [6, 5, 2, 9], [7, 8, 9, 3], [6, 8, 4, 5], [6, 8, 5, 9], [6, 8, 9, 7], [6, 8, 7, 4]]
# Triangles between the points of a facet, by its corners.
TRIANGLES = {3: ([0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]), 4: ([0, 4, 7], [1, 5, 4], [2, 6, 5], [3, 7, 6], [4, 5, 6], [4, 6, 7])}
SHARP = math.cos(math.radians(30)) - 1e-6  # twelve sides of a cylinder turn by 30 degrees up to rounding


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
    """Facets of one cell only: an array of triangles, F x 6, and one of quadrilaterals, F x 8; corners, and the points between them (again
    corners of linear ones)."""
    facets = {3: [np.zeros((0, 6), dtype=int)], 4: [np.zeros((0, 8), dtype=int)]}
    for kind, sides in SIDES.items():
        cells = grid.cells(kind)
        for side in sides if len(cells) else []:
            count = len(side)
            middles = [CORNERS[kind] + EDGES[kind].index(tuple(sorted((side[k], side[(k + 1) % count])))) if EDGES[kind] else side[k] for k in range(count)]
            facets[count].append(cells[:, side + middles])
    if all(len(of) == 1 for of in facets.values()):
        raise NothingToDraw("the fields have no cells")
    return [outer_of(np.concatenate(of), count) for count, of in facets.items()]


def outer_of(facets, corners):
    _, first, times = np.unique(np.sort(facets[:, :corners], axis=1), axis=0, return_index=True, return_counts=True)
    return facets[np.sort(first[times == 1])]


def triangles_of(facets):
    """Those between all points of quadratic facets, and one of a linear triangle."""
    parts = []
    for of in facets:
        corners = of.shape[1] // 2
        linear = of[:, corners] == of[:, 0]
        parts.append(of[linear][:, :3])
        parts += [of[~linear][:, chosen] for chosen in TRIANGLES[corners]]
    return np.concatenate(parts)


def sharp_edges(points, facets):
    """Edges of the facets at which the boundary turns by more than 30 degrees, as chains of points E x 3."""
    normals, ends, of_facet, before = [], [], [], 0
    for of in facets:
        corners = of.shape[1] // 2
        ahead, last = points[of[:, 2 if corners == 4 else 1]] - points[of[:, 0]], points[of[:, corners - 1]] - points[of[:, 1 if corners == 4 else 0]]
        normals.append(np.cross(ahead, last))
        ends += [of[:, [k, corners + k, (k + 1) % corners]] for k in range(corners)]
        of_facet.append(np.tile(before + np.arange(len(of)), corners))
        before += len(of)
    normals, ends, of_facet = np.concatenate(normals), np.concatenate(ends), np.concatenate(of_facet)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    keys = np.sort(ends[:, [0, 2]], axis=1)
    order = np.lexsort(keys.T)
    pairs = np.flatnonzero((keys[order][1:] == keys[order][:-1]).all(axis=1))
    one, other = order[pairs], order[pairs + 1]
    sharp = np.einsum("ij,ij->i", normals[of_facet[one]], normals[of_facet[other]]) < SHARP
    return ends[one[sharp]]


def tetrahedra_of(grid, fine=False):
    """Corners of the tetrahedra that all cells are divided into; `fine`: quadratic tetrahedra along their middle nodes too."""
    parts_of = {**PARTS, vtu.QUADRATIC_TETRAHEDRON: FINE_PARTS} if fine else PARTS
    parts = [grid.cells(kind)[:, corners] for kind, of in parts_of.items() if len(grid.cells(kind)) for corners in of]
    return np.concatenate(parts)


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
    flat: object         # of points m x 3, in the same way
    axes: tuple          # what the two coordinates are called
    corners: np.ndarray  # T x 3, triangles between pairs
    values: dict         # pressure, shear, gap, slip
    states: np.ndarray   # open, stick or slip


def maps_of(results, number, names=()):
    """The contact faces of one increment, all or those named. Contacts of bodies that are not there have none."""
    known = list(results.increments[number - 1]["contacts"])
    if not known:
        raise NothingToDraw(f"{results.directory}: the model has no contact")
    for name in names:
        if name not in known:
            raise ResultsError(f"--contact {name}: there is no such contact; there {'is' if len(known) == 1 else 'are'} {', '.join(known[:12])}")
    grid = results.faces(number)
    there = [name for name in (names or known) if (grid.point_data["contact"] == known.index(name) + 1).any()]
    if not there:
        raise NothingToDraw(f"{results.directory}: the bodies of {'this contact' if len(names) == 1 else 'the contacts'} are not there in increment {number}")
    return [map_of(name, grid, known.index(name) + 1) for name in there]


def map_of(name, grid, contact):
    chosen = grid.point_data["contact"] == contact
    data = {key: values[chosen] for key, values in grid.point_data.items()}
    points = grid.points[chosen]
    new_number = np.cumsum(chosen) - 1
    here = grid.cell_data["contact"] == contact
    squares = grid.cells(vtu.QUAD)[here[grid.types == vtu.QUAD]]
    corners = new_number[np.concatenate([grid.cells(vtu.TRIANGLE)[here[grid.types == vtu.TRIANGLE]], *(squares[:, part] for part in ([0, 1, 2], [0, 2, 3]) if len(squares))])].astype(int)
    normal = data["normal"].mean(axis=0)
    along = int(np.argmax(np.abs(normal)))
    if abs(normal[along]) > 1 - 1e-9:  # the axes themselves
        kept = [k for k in range(3) if k != along]
        flat, axes = (lambda x: x[:, kept]), tuple("xyz"[k] for k in kept)
    else:
        first = np.cross([0, 0, 1], normal) if abs(normal[2]) < 0.9 else np.cross([0, 1, 0], normal)
        first /= np.linalg.norm(first)
        second = np.cross(normal, first)
        middle, across = points.mean(axis=0), np.column_stack([first, second / np.linalg.norm(second)])
        flat = lambda x: (x - middle) @ across
        axes = ("along the face", "across it")
    rounding = 4e-16 * np.abs(points).max()
    cleared = lambda values: np.where(np.abs(values) <= rounding, 0.0, values)
    return FaceMap(name, flat(points), flat, axes, corners,
                   {"pressure": data["pressure"], "shear": np.linalg.norm(data["shear"], axis=1), "gap": cleared(data["gap"]),
                    "slip": cleared(np.linalg.norm(data["slip"], axis=1))}, np.array(["open", "stick", "slip"])[data["state"]])
