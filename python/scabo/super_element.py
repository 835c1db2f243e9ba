"""Single super-elements."""
from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

import numpy as np

from . import _core
from .arguments import real_array, threads_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["SuperElement", "boundary_nodes"]


def boundary_nodes(vertices: ArrayLike, size: float, order: int = 2) -> np.ndarray:
    """Nodes of the boundary of a polygon, counter-clockwise, (n, 2): every edge is divided into elements of equal length,
    at most ``size``, with their nodes at the Gauss-Lobatto-Legendre points of ``order``."""
    corners = real_array("vertices", vertices)
    if corners.ndim != 2 or corners.shape[1] != 2 or len(corners) < 3:
        raise ValueError("vertices must be three or more points, as in [[x, y], ...]")
    if not np.isfinite(corners).all():
        raise ValueError("the coordinates of all vertices must be finite")
    if not size > 0.0:
        raise ValueError(f"size must be more than 0, not {size!r}")
    local = 0.5 * (1.0 + np.array(_core.lobatto_points(_order(order))))[:-1]
    nodes = []
    for start, end in zip(corners, np.roll(corners, -1, axis=0)):
        elements = max(1, math.ceil(np.linalg.norm(end - start) / size * (1.0 - 1e-12)))
        t = (np.arange(elements)[:, None] + local) / elements
        nodes.append(start + t.reshape(-1, 1) * (end - start))
    return np.concatenate(nodes)


class SuperElement:
    """A super-element: stiffness by ring doubling, exponents, and the field inside (docs/methods/01 to 03).

    >>> element = scabo.SuperElement(scabo.boundary_nodes([[0, 0], [2, 0], [2, 1], [0, 1]], 0.25), young=210e9, poisson=0.3)
    >>> element.stiffness.shape
    (96, 96)

    nodes
        Boundary nodes, counter-clockwise, (n, 2). Boundary element k has the nodes k order ... (k + 1) order; its inner
        nodes are at the Gauss-Lobatto-Legendre points (``boundary_nodes``). The last element ends at the first node, or
        in an open super-element (a crack, a corner) at the last one.
    young, poisson
        Isotropic material: force / length^2 and a number.
    plane
        "stress" or "strain".
    order
        Of the boundary elements, 1 to 16.
    centre
        Scaling centre, from which the whole boundary must be visible; None: the centroid. An open super-element needs one.
    open
        The boundary does not close; from its ends straight side faces lead to the scaling centre.
    unbounded
        The domain outside of the boundary, to infinity.

    Displacements and forces are [x, y] for node after node. Raises ValueError for what cannot be solved.
    """

    def __init__(self, nodes: ArrayLike, young: float, poisson: float, *, plane: Literal["stress", "strain"] = "stress",
                 order: int = 2, thickness: float = 1.0, centre: ArrayLike | None = None, open: bool = False,
                 unbounded: bool = False, threads: int = 1) -> None:
        self._nodes = real_array("nodes", nodes).copy()
        if self._nodes.ndim != 2 or self._nodes.shape[1] != 2:
            raise ValueError(f"nodes must have the shape (n, 2), not {self._nodes.shape}")
        if not np.isfinite(self._nodes).all():
            raise ValueError("the coordinates of all nodes must be finite")
        count, order = len(self._nodes), _order(order)
        least = order if open else 3
        if count < least + open or (count - bool(open)) % order:
            raise ValueError(f"{count} nodes do not make {'an open' if open else 'a closed'} boundary of elements of order "
                             f"{order}: it has {'1 + ' if open else ''}a multiple of {order}")
        if plane not in ("stress", "strain"):
            raise ValueError(f"plane must be 'stress' or 'strain', not {plane!r}")
        for name, value in (("young", young), ("thickness", thickness)):
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{name} must be more than 0, not {value!r}")
        if not -1.0 < poisson <= 0.5 or (plane == "strain" and poisson == 0.5):
            raise ValueError(f"poisson must be more than -1 and at most 0.5, in plane strain less, not {poisson!r}")
        if centre is None:
            if open:
                raise ValueError("an open super-element needs its scaling centre: the tip of the crack or corner")
            centre = _centroid(self._nodes)
        self._centre = real_array("centre", centre).copy()
        if self._centre.shape != (2,) or not np.isfinite(self._centre).all():
            raise ValueError("centre must be a point, as in [x, y]")
        at = (float(self._centre[0]), float(self._centre[1]))
        self._core = _core.SuperElement(self._nodes, at, bool(open), order, young, poisson, plane == "strain", thickness,
                                        bool(unbounded), threads_of(threads))

    @property
    def nodes(self) -> np.ndarray:
        """Boundary nodes, (n, 2)."""
        return self._nodes

    @property
    def centre(self) -> np.ndarray:
        """Scaling centre, [x, y]."""
        return self._centre

    @property
    def stiffness(self) -> np.ndarray:
        """K, (2 n, 2 n), force per displacement, symmetric; without a copy."""
        return self._core.stiffness

    @property
    def exponents(self) -> np.ndarray:
        """All 2 n exponents of u ~ xi^lambda, complex, in ascending real part; exactly 0 for the translations. Between 0
        and 1: stress is infinite at the scaling centre."""
        return self._core.exponents

    @property
    def coefficient_matrices(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """E0, E1 and E2 of the scaled boundary equation, (2 n, 2 n) each."""
        return self._core.coefficients()

    def field(self, displacement: ArrayLike, points: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """Displacement (m, 2) and stress (m, 3): xx, yy, xy, at points (m, 2) inside, from the displacements of the nodes,
        (2 n) or (n, 2). Not a number for points outside."""
        u = real_array("displacement", displacement).reshape(-1)
        if u.size != self._nodes.size:
            raise ValueError(f"there are {self._nodes.size} displacements of nodes, not {u.size}")
        at = real_array("points", points)
        if at.ndim != 2 or at.shape[1] != 2:
            raise ValueError(f"points must have the shape (m, 2), not {at.shape}")
        return self._core.values(u, at - self._centre)

    def __repr__(self) -> str:
        return f"<scabo.SuperElement: {self._nodes.size} degrees of freedom>"


def _order(order: int) -> int:
    if isinstance(order, bool) or not isinstance(order, (int, np.integer)) or not 1 <= order <= 16:
        raise ValueError(f"order must be a whole number from 1 to 16, not {order!r}")
    return int(order)


def _centroid(nodes: np.ndarray) -> np.ndarray:
    """Of the polygon of the nodes."""
    origin = nodes.mean(axis=0)
    x, y = (nodes - origin).T
    cross = x * np.roll(y, -1) - y * np.roll(x, -1)
    area = cross.sum()
    if not area > 0.0:
        raise ValueError("the nodes do not go round an area counter-clockwise")
    return origin + np.array([((x + np.roll(x, -1)) * cross).sum(), ((y + np.roll(y, -1)) * cross).sum()]) / (3.0 * area)
