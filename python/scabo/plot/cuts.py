"""What a plane leaves of bodies in space: their surface on one side of it, and the section."""
import dataclasses

import numpy as np


@dataclasses.dataclass(frozen=True)
class CutSurface:
    """Triangles between points of edges, each at `part` of the way from the first to the second end, which are numbers of points of the bodies."""
    ends: np.ndarray     # n x 2
    part: np.ndarray     # n
    corners: np.ndarray  # T x 3
    outline: np.ndarray  # L x 2, lines around the section

    def of(self, values):
        """Values at the points of the bodies, interpolated."""
        first, second = values[self.ends[:, 0]], values[self.ends[:, 1]]
        return first + self.part.reshape(-1, *[1] * (first.ndim - 1)) * (second - first)


def cut_surface(points, surface, tetrahedra, point, normal):
    """`surface`: triangles of the boundary. What lies on the side to which the normal points is taken away."""
    distance = (points - np.asarray(point, dtype=float)) @ (np.asarray(normal, dtype=float) / np.linalg.norm(normal))
    away = distance > 0.0
    triangles = [one_of(surface, away, 0)]  # each a list of three n x 2 arrays of ends
    outline = []
    for count in (1, 2):
        a, b, c = rotated(surface[away[surface].sum(axis=1) == count], away, count == 2)
        ab, ac = np.column_stack([a, b]), np.column_stack([a, c])
        if count == 2:  # only a is left
            triangles.append((both(a), ab, ac))
        else:
            triangles += [(both(b), both(c), ac), (both(b), ac, ab)]
        outline.append((ab, ac))
    section = []
    for count in (1, 3):  # one corner is alone
        alone = tetrahedra[away[tetrahedra].sum(axis=1) == count]
        a, b, c, d = np.take_along_axis(alone, np.argsort(away[alone] == (count == 3), axis=1, kind="stable"), axis=1).T
        section.append([np.column_stack([a, other]) for other in (b, c, d)])
    pairs = tetrahedra[away[tetrahedra].sum(axis=1) == 2]
    a, b, c, d = np.take_along_axis(pairs, np.argsort(away[pairs], axis=1, kind="stable"), axis=1).T
    ring = [np.column_stack([i, j]) for i, j in ((a, c), (a, d), (b, d), (b, c))]
    section += [[ring[0], ring[1], ring[2]], [ring[0], ring[2], ring[3]]]
    return assembled(points, distance, normal, triangles, section, outline)


def one_of(surface, away, count):
    return tuple(both(nodes) for nodes in surface[away[surface].sum(axis=1) == count].T)


def both(nodes):
    return np.column_stack([nodes, nodes])


def rotated(corners, away, others_away):
    """The corner that is alone on its side first, without turning the triangle over."""
    first = np.argmax(away[corners] != others_away, axis=1) if len(corners) else np.zeros(0, dtype=int)
    return np.take_along_axis(corners, (first[:, None] + np.arange(3)) % 3, axis=1).T


def assembled(points, distance, normal, triangles, section, outline):
    ends = np.concatenate([part for triangle in triangles + section for part in triangle] + [part for line in outline for part in line])
    gap = distance[ends[:, 1]] - distance[ends[:, 0]]
    part = np.where(gap == 0.0, 0.0, -distance[ends[:, 0]] / np.where(gap == 0.0, 1.0, gap))
    part[ends[:, 0] == ends[:, 1]] = 0.0
    corners, before = [], 0
    for triangle in triangles + section:
        count = len(triangle[0])
        corners.append(before + np.arange(3 * count).reshape(3, count).T)
        before += 3 * count
    lines = []
    for line in outline:
        lines.append(before + np.arange(2 * len(line[0])).reshape(2, -1).T)
        before += 2 * len(line[0])
    surface = CutSurface(ends, part, np.concatenate(corners), np.concatenate(lines))
    x = surface.of(points)
    of_section = np.zeros(len(surface.corners), dtype=bool)
    of_section[sum(len(of) for of in corners[:len(triangles)]):] = True
    a, b, c = x[surface.corners].transpose(1, 0, 2)
    turned = of_section & (np.cross(b - a, c - a) @ np.asarray(normal, dtype=float) < 0.0)
    surface.corners[turned] = surface.corners[turned][:, ::-1]
    return surface
