"""Discrete frictional contact problems for the benchmark: reading, and the one judge of all solutions.

A problem file is HDF5 in the layout of FCLIB (https://github.com/FrictionalContactLibrary): the local form `fclib_local`
(W, q, mu) or the global form `fclib_global` (M, H, w, f, mu), which is condensed here: W = H' M^-1 H,
q = w + H' M^-1 f. For each contact, normal first,

    u = W r + q,   0 <= u_n  perpendicular to  r_n >= 0,   |r_t| <= mu r_n,  r_t opposite to u_t when sliding

Nothing here is shared with Scabo or with Siconos.
"""
import dataclasses
import pathlib

import h5py
import numpy
import scipy.sparse
import scipy.sparse.linalg


@dataclasses.dataclass
class Problem:
    name: str
    dimension: int                          # 2 or 3
    W: scipy.sparse.csr_matrix              # motion per force
    q: numpy.ndarray
    mu: numpy.ndarray

    @property
    def contacts(self):
        return len(self.mu)


def _matrix(group):
    """FCLIB's matrices: nz = -1 compressed columns, -2 compressed rows, otherwise triplets (p columns, i rows)."""
    integer = lambda key: int(numpy.ravel(group[key])[0])
    rows, columns, kind = integer("m"), integer("n"), integer("nz")
    p, i, x = (numpy.ravel(group[key]) for key in ("p", "i", "x"))
    if kind == -1:
        return scipy.sparse.csc_matrix((x, i, p), shape=(rows, columns)).tocsr()
    if kind == -2:
        return scipy.sparse.csr_matrix((x, i, p), shape=(rows, columns))
    return scipy.sparse.coo_matrix((x[:kind], (i[:kind], p[:kind])), shape=(rows, columns)).tocsr()


def read(path):
    path = pathlib.Path(path)
    with h5py.File(path) as file:
        local = "fclib_local" in file
        group = file["fclib_local" if local else "fclib_global"]
        dimension = int(numpy.ravel(group["spacedim"])[0])
        vector = lambda key: numpy.ravel(group["vectors"][key]).astype(float)
        mu = vector("mu")
        if local:
            W, q = _matrix(group["W"]), vector("q")
        else:
            M, H = _matrix(group["M"]).tocsc(), _matrix(group["H"]).tocsc()
            solve = scipy.sparse.linalg.splu(M).solve
            W = scipy.sparse.csr_matrix(H.T @ scipy.sparse.csc_matrix(solve(H.toarray())))
            q = vector("w") + H.T @ solve(vector("f"))
    return Problem(path.stem, dimension, W, q, mu)


def project_on_cone(x, mu):
    """Rows of x (N x d) to the nearest point of their cone |x_t| <= mu x_n."""
    n, t = x[:, 0], x[:, 1:]
    length = numpy.linalg.norm(t, axis=1)
    onto_side = (n + mu * length) / (1.0 + mu**2)                      # normal part of the foot on the cone's side
    inside, polar = length <= mu * n, mu * length <= -n
    normal = numpy.where(inside, n, numpy.where(polar, 0.0, onto_side))
    scale = numpy.where(inside, 1.0, mu * normal / numpy.where(length > 0.0, length, 1.0))
    return numpy.column_stack([normal, scale[:, None] * t])


def natural_map(problem, r):
    """| r - P_K( r - (u + mu |u_t| n) ) | / |q|, W and q scaled so that the mean of W_ii is 1; absolute where q = 0."""
    r = numpy.asarray(r, float)
    if r.shape != problem.q.shape or not numpy.all(numpy.isfinite(r)):
        return float("inf")
    mean = numpy.mean(problem.W.diagonal()) if len(r) > 0 else 1.0
    stiffness = 1.0 / mean if mean > 0.0 else 1.0
    u = stiffness * (problem.W @ r + problem.q).reshape(-1, problem.dimension)
    r = r.reshape(-1, problem.dimension)
    u = u.copy()
    u[:, 0] += problem.mu * numpy.linalg.norm(u[:, 1:], axis=1)
    size = stiffness * numpy.linalg.norm(problem.q)
    return float(numpy.linalg.norm(r - project_on_cone(r - u, problem.mu)) / (size if size > 0.0 else 1.0))
