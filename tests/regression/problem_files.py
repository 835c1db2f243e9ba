"""Discrete contact problems in FCLIB's layout, written by h5py: what other programs write and read. And the residual by which
FCLIB judges a solution, formed here without Scabo."""
import h5py
import numpy as np

VARIABLE_TEXT = h5py.string_dtype()


def csc(A):
    """Compressed columns of a dense matrix."""
    p, i, x = [0], [], []
    for column in np.asarray(A, float).T:
        rows = np.flatnonzero(column)
        i.extend(rows)
        x.extend(column[rows])
        p.append(len(i))
    return dict(nz=-1, p=p, i=i, x=x)


def csr(A):
    transposed = csc(np.asarray(A).T)
    return {**transposed, "nz": -2}


def triplets(A):
    """Columns are p, rows are i, as in CSparse; every entry in two halves, to be added."""
    rows, columns = np.nonzero(A)
    values = np.asarray(A, float)[rows, columns]
    return dict(nz=2 * len(values), p=np.tile(columns, 2), i=np.tile(rows, 2), x=np.tile(values / 2, 2))


def write_matrix(group, A, storage):
    stored = storage(A)
    for name, value in dict(m=A.shape[0], n=A.shape[1], nz=stored["nz"], nzmax=len(stored["x"])).items():
        group.create_dataset(name, data=np.array([value], dtype=np.int32))
    for name in ("p", "i"):
        group.create_dataset(name, data=np.array(stored[name], dtype=np.int32))
    group.create_dataset("x", data=np.array(stored["x"], dtype=float))


def write_local(path, W, q, mu, storage=csc, spacedim=None, V=None, s=None, R=None):
    with h5py.File(path, "w") as file:
        local = file.create_group("fclib_local")
        local.create_dataset("spacedim", data=np.array([spacedim or len(q) // len(mu)], dtype=np.int32))
        write_matrix(local.create_group("W"), np.asarray(W), storage)
        local.create_dataset("vectors/q", data=np.asarray(q, float))
        local.create_dataset("vectors/mu", data=np.asarray(mu, float))
        if V is not None:
            write_matrix(local.create_group("V"), np.asarray(V), storage)
            write_matrix(local.create_group("R"), np.zeros((len(s), len(s))) if R is None else np.asarray(R), storage)
            local.create_dataset("vectors/s", data=np.asarray(s, float))
        local.create_dataset("info/title", data="Written by h5py", dtype=VARIABLE_TEXT)


def write_global(path, M, H, f, w, mu, storage=csc, G=None, b=None, spacedim=None):
    with h5py.File(path, "w") as file:
        whole = file.create_group("fclib_global")
        whole.create_dataset("spacedim", data=np.array([spacedim or len(w) // len(mu)], dtype=np.int32))
        for name, matrix in dict(M=M, H=H, G=G).items():
            if matrix is not None:
                write_matrix(whole.create_group(name), np.asarray(matrix), storage)
        for name, vector in dict(f=f, w=w, mu=mu, b=b).items():
            if vector is not None:
                whole.create_dataset(f"vectors/{name}", data=np.asarray(vector, float))


def on_cone(x, mu):
    """Projection of a force on Coulomb's cone |x_t| <= mu x_n."""
    n, size = x[0], np.linalg.norm(x[1:])
    if size <= mu * n:
        return x
    if mu * size <= -n:
        return np.zeros_like(x)
    normal = (n + mu * size) / (1 + mu * mu)
    return np.concatenate([[normal], mu * normal * x[1:] / size])


def natural_map_residual(u, r, mu, q, W=1.0):
    """Motions as forces: `W` and `q` are scaled so that the mean of the diagonal of W is 1."""
    d = len(r) // len(mu)
    stiffness = 1.0 / np.mean(np.diag(np.atleast_2d(W)))
    u, q = stiffness * np.asarray(u), stiffness * np.asarray(q)
    total = 0.0
    for k, coefficient in enumerate(mu):
        u_k, r_k = u[d * k:d * k + d].copy(), r[d * k:d * k + d]
        u_k[0] += coefficient * np.linalg.norm(u_k[1:])
        total += np.sum((r_k - on_cone(r_k - u_k, coefficient)) ** 2)
    return np.sqrt(total) / np.linalg.norm(q)


def random_problem(pairs, dimension, seed, mu=0.4):
    """Symmetric positive definite W of order 1; some pairs are pressed together, some part."""
    random = np.random.default_rng(seed)
    size = dimension * pairs
    A = random.normal(size=(size, size))
    W = A @ A.T / size + 0.5 * np.eye(size)
    return W, random.normal(size=size), np.full(pairs, mu)
