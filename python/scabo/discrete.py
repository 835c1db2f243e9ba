"""Discrete contact problems."""
from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _core
from .arguments import real_array, threads_of
from .errors import Collapse, Infeasible, Mechanism, NotConverged

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["DiscreteSolution", "solve_contact"]

_STATES = np.array(["open", "stick", "slip"])


class DiscreteSolution:
    """Solution of a discrete contact problem; arrays show the memory of the solver without a copy."""

    def __init__(self, core: _core.DiscreteSolution, dimension: int) -> None:
        self._core = core
        self._dimension = dimension

    @property
    def status(self) -> str:
        """solved, not_converged, mechanism, collapse or infeasible."""
        return self._core.status

    @property
    def forces(self) -> np.ndarray:
        """p on B, (N, d): normal (compression is positive) and tangential."""
        return self._core.forces.reshape(-1, self._dimension)

    @property
    def gap(self) -> np.ndarray:
        """Normal motion u_n of every pair, (N): more than 0 where it is open."""
        return self._core.gap

    @property
    def slip(self) -> np.ndarray:
        """Tangential motion u_t, (N, d - 1)."""
        return self._core.slip.reshape(-1, self._dimension - 1)

    @property
    def state(self) -> np.ndarray:
        """"open", "stick" or "slip" of every pair."""
        return _STATES[self._core.states]

    @property
    def rigid_motions(self) -> np.ndarray:
        """a, (m)."""
        return self._core.rigid_motions

    @property
    def certificate(self) -> dict[str, float]:
        """What was checked after the solve, free of units (docs/methods/08_certificate.md)."""
        return self._core.certificate

    @property
    def natural_map_residual(self) -> float:
        """Residual of the natural map, free of units (docs/methods/13_problem_files.md)."""
        return self._core.natural_map_residual

    @property
    def iterations(self) -> int:
        """Newton iterations of all attempts."""
        return self._core.iterations

    @property
    def reason(self) -> str:
        """Why it is not solved; empty if it is."""
        return self._core.reason

    @property
    def unrestrained_motion(self) -> np.ndarray:
        """Of a mechanism or a collapse: the rigid motion that is not restrained, (m); otherwise empty."""
        return self._core.unrestrained_motion

    @property
    def proof(self) -> np.ndarray:
        """Of an infeasible problem: forces that prove it, (N, d); otherwise empty."""
        return self._core.proof.reshape(-1, self._dimension)

    def __repr__(self) -> str:
        return f"<scabo.DiscreteSolution: {self.status}, {len(self.gap)} pairs>"


def solve_contact(W: Any, q: ArrayLike, mu: ArrayLike, *, dimension: int = 2, G: ArrayLike | None = None,
                  f: ArrayLike | None = None, cohesion: ArrayLike | None = None, tension: ArrayLike | None = None,
                  start: ArrayLike | None = None, start_motions: ArrayLike | None = None, tolerance: float = 1e-10,
                  judge: Literal["certificate", "natural_map"] | None = None, iterations: int = 50,
                  force_scale: float = 0.0, time_limit: float | None = None, threads: int = 1) -> DiscreteSolution:
    """Solves a discrete problem of frictional contact, as ``scabo contact`` does:

        u = q + W p + G a,   0 = G' p + f,
        u_n >= 0,  p_n >= -tension,  (p_n + tension) u_n = 0,
        |p_t| <= cohesion + mu (p_n)+, and p_t opposes u_t where it slips

    N pairs with [normal, tangent] (d = 2) or [normal, tangent 1, tangent 2] (d = 3) each; u are relative motions of B
    with regard to A, p forces on B.

    W            (dN, dN), symmetric: an array, or a sparse matrix of SciPy; motion per force
    q            (dN): motion without contact forces (initial gaps included)
    mu           (N) or one number: coefficients of friction, 0 or more
    G, f         (dN, m), (m): motion of the pairs per rigid motion, and the loads on them
    cohesion     (N) or one number: force, 0 or more
    tension      (N) or one number: force, 0 or more; infinite: bonded
    start        (dN): forces from which Newton starts, as those of the increment before
    tolerance    what counts as solved, free of units
    judge        the figure that must be within the tolerance. None: the certificate of problems with G or force_scale,
                 the natural map of all others (docs/methods/12_contact_solver.md)
    iterations   of Newton's method in one attempt
    force_scale  largest applied force, part of the scale of forces; 0 if it is not known
    time_limit   seconds, after which the search ends

    Raises ``NotConverged``, ``Mechanism`` or ``Infeasible``, each with the best iterate in ``result``; ValueError for
    arguments that do not fit.
    """
    if dimension not in (2, 3):
        raise ValueError(f"dimension must be 2 or 3, not {dimension!r}")
    motions = _vector("q", q)
    size = motions.size
    if size % dimension:
        raise ValueError(f"q has {size} entries, which is not a multiple of the dimension, {dimension}")
    pairs = size // dimension
    dense, columns = _operator(W, size)
    friction = _of_pairs("mu", mu, pairs)
    map_of_bodies = None if G is None else _matrix("G", G, size)
    count = 0 if map_of_bodies is None else map_of_bodies.shape[1]
    loads = np.zeros(count) if f is None else _vector("f", f, count)
    if judge not in (None, "certificate", "natural_map"):
        raise ValueError(f"judge must be 'certificate' or 'natural_map', not {judge!r}")
    if not (math.isfinite(force_scale) and force_scale >= 0.0):
        raise ValueError(f"force_scale must be 0 or more, not {force_scale!r}")
    if not 1e-15 <= tolerance <= 0.1:
        raise ValueError(f"tolerance must be from 1e-15 to 0.1, not {tolerance!r}")
    if iterations < 1:
        raise ValueError(f"iterations must be 1 or more, not {iterations!r}")
    if time_limit is not None and not time_limit > 0.0:
        raise ValueError(f"time_limit must be more than 0, not {time_limit!r}")
    by_certificate = judge == "certificate" or (judge is None and (count > 0 or force_scale > 0.0))
    nothing = np.zeros(0)
    core = _core.solve_contact(
        dense, columns, motions, friction, dimension,
        nothing if cohesion is None else _of_pairs("cohesion", cohesion, pairs),
        nothing if tension is None else _of_pairs("tension", tension, pairs, finite=False), map_of_bodies, loads,
        nothing if start is None else _vector("start", start, size),
        nothing if start_motions is None else _vector("start_motions", start_motions, count), tolerance, by_certificate,
        iterations, force_scale, time_limit or 0.0, threads_of(threads))
    solution = DiscreteSolution(core, dimension)
    kinds = {"not_converged": NotConverged, "mechanism": Mechanism, "collapse": Collapse, "infeasible": Infeasible}
    if solution.status in kinds:
        raise kinds[solution.status](f"{solution.status.replace('_', ' ')}: {solution.reason}", solution)
    return solution


def _vector(name: str, values: ArrayLike, size: int | None = None) -> np.ndarray:
    array = real_array(name, values).reshape(-1)
    if size is not None and array.size != size:
        raise ValueError(f"{name} must have {size} entries, not {array.size}")
    return _finite(name, array)


def _matrix(name: str, values: Any, rows: int) -> np.ndarray:
    array = real_array(name, values.toarray() if hasattr(values, "toarray") else values)
    if array.ndim != 2 or array.shape[0] != rows:
        raise ValueError(f"{name} must be a matrix with {rows} rows, not of shape {array.shape}")
    return _finite(name, array)


def _finite(name: str, array: np.ndarray) -> np.ndarray:
    if not np.isfinite(array).all():
        raise ValueError(f"{name} contains numbers that are not finite")
    return array


def _of_pairs(name: str, values: ArrayLike, pairs: int, finite: bool = True) -> np.ndarray:
    array = real_array(name, values)
    if array.ndim == 0:
        array = np.full(pairs, float(array))
    if array.shape != (pairs,):
        raise ValueError(f"{name} must be one number, or one for each of the {pairs} pairs, not of shape {array.shape}")
    if np.isnan(array).any() or (array < 0.0).any() or (finite and np.isinf(array).any()):
        raise ValueError(f"{name} must be 0 or more{' and finite' if finite else ''} for every pair")
    return array


def _operator(W: Any, size: int) -> tuple[np.ndarray | None, tuple[np.ndarray, np.ndarray, np.ndarray] | None]:
    """W as a dense array, or as the columns of a sparse matrix."""
    if tuple(getattr(W, "shape", np.shape(W))) != (size, size):
        raise ValueError(f"W must have the shape ({size}, {size}), as q has {size} entries, not {np.shape(W)}")
    if not hasattr(W, "tocsc"):
        dense = _finite("W", real_array("W", W))
        if size:
            i, j = np.unravel_index(np.argmax(np.abs(dense - dense.T)), dense.shape)
            _symmetric(i, j, dense[i, j], dense[j, i], np.abs(dense).max())
        return dense, None
    columns = W.tocsc()
    columns.sort_indices()
    data = _finite("W", real_array("W", columns.data))
    if data.size:
        column = np.repeat(np.arange(size), np.diff(columns.indptr))
        places, entry = np.unique(columns.indices.astype(np.int64) * size + column, return_inverse=True)
        values = np.bincount(entry, data)
        i, j = places // size, places % size
        mirrored = np.minimum(np.searchsorted(places, j * size + i), places.size - 1)
        across = np.where(places[mirrored] == j * size + i, values[mirrored], 0.0)
        worst = np.argmax(np.abs(values - across))
        _symmetric(i[worst], j[worst], values[worst], across[worst], np.abs(values).max())
    return None, (columns.indptr, columns.indices, data)


def _symmetric(i: int, j: int, entry: float, across: float, largest: float) -> None:
    """Refuses W if its entry (i, j), which differs most from that across the diagonal, differs by more than what rounding
    and single precision leave."""
    if abs(entry - across) > 1e-6 * largest:
        raise ValueError(f"W must be symmetric, but W[{i}, {j}] is {entry:g} and W[{j}, {i}] is {across:g}")
