"""Converged energies and frequencies that tests compare with, by a program that shares nothing with Scabo: hp finite
elements on quadrilaterals, graded towards corners, with NumPy and SciPy alone. Prints every number for two orders, whose
difference tells what it is good for. Takes about a minute; run it by hand:

    /usr/bin/python3 tests/verification/converged_numbers.py
"""
import numpy as np
import scipy.integrate
import scipy.optimize
import scipy.sparse as sp
import scipy.sparse.linalg as spl
from numpy.polynomial import legendre


def lobatto(p):
    """Points of Gauss, Lobatto and Legendre of order p on [-1, 1]."""
    inner = legendre.Legendre.basis(p).deriv().roots()
    return np.concatenate([[-1.0], np.sort(np.real(inner)), [1.0]])


def lagrange(points, at):
    """Values and derivatives of the Lagrange polynomials, [at, point]."""
    p = len(points) - 1
    V = legendre.legvander(points, p)
    inverse = np.linalg.inv(V)
    slopes = np.stack([legendre.Legendre.basis(k).deriv()(at) if k else 0 * at for k in range(p + 1)], axis=1)
    return legendre.legvander(at, p) @ inverse, slopes @ inverse


def graded(n, ends, ratio=0.15):
    """Break points on [0, 1], graded geometrically by n layers towards the ends named ('0', '1', '01')."""
    layers = [ratio**k for k in range(n, 0, -1)]
    if ends == "0":
        return np.array([0.0] + layers + [1.0])
    if ends == "1":
        return 1.0 - graded(n, "0", ratio)[::-1]
    half = 0.5 * graded(n, "0", ratio)
    return np.concatenate([half, 1.0 - half[-2::-1]])


class Plane:
    """Elastic plane of patches, each the bilinear image of the unit square cut at break points, elements of order p."""

    def __init__(self, D, p):
        self.D, self.p, self.elements, self.nodes, self.index = D, p, [], [], {}
        self.t = 0.5 * (lobatto(p) + 1)
        x, w = legendre.leggauss(p + 2)
        N, dN = lagrange(lobatto(p), x)
        one = np.ones_like(x)
        self.N = np.einsum("qi,rj->qrij", N, N).reshape(len(x) ** 2, -1)
        self.N_x = np.einsum("qi,rj->qrij", dN, N).reshape(len(x) ** 2, -1)
        self.N_y = np.einsum("qi,rj->qrij", N, dN).reshape(len(x) ** 2, -1)
        self.w = np.outer(w, w).ravel()
        self.xi, self.eta = np.outer(x, one).ravel(), np.outer(one, x).ravel()

    def add(self, corners, a_breaks, b_breaks, key):
        """Corners counter-clockwise from (0, 0) of the unit square; `key(a, b)` names a node."""
        c = np.array(corners, float)
        at = lambda a, b: (1 - a) * (1 - b) * c[0] + a * (1 - b) * c[1] + a * b * c[2] + (1 - a) * b * c[3]
        for a0, a1 in zip(a_breaks, a_breaks[1:]):
            for b0, b1 in zip(b_breaks, b_breaks[1:]):
                nodes = []
                for s in self.t:
                    for r in self.t:
                        a, b = a0 + s * (a1 - a0), b0 + r * (b1 - b0)
                        name = key(a, b)
                        if name not in self.index:
                            self.index[name] = len(self.nodes)
                            self.nodes.append(at(a, b))
                        nodes.append(self.index[name])
                self.elements.append((np.array(nodes), np.array([at(a0, b0), at(a1, b0), at(a1, b1), at(a0, b1)])))

    def matrices(self, density=0.0):
        rows, cols, stiff, mass, self.parts = [], [], [], [], []
        m = self.N.shape[1]
        for nodes, c in self.elements:
            x, e = self.xi, self.eta
            x_xi = 0.25 * (np.outer(1 - e, c[1] - c[0]) + np.outer(1 + e, c[2] - c[3]))
            x_eta = 0.25 * (np.outer(1 - x, c[3] - c[0]) + np.outer(1 + x, c[2] - c[1]))
            J = x_xi[:, 0] * x_eta[:, 1] - x_xi[:, 1] * x_eta[:, 0]
            dx = (self.N_x * x_eta[:, 1:] - self.N_y * x_xi[:, 1:]) / J[:, None]
            dy = (-self.N_x * x_eta[:, :1] + self.N_y * x_xi[:, :1]) / J[:, None]
            wj = self.w * J
            D = self.D
            xx, xy, yy = (dx.T * wj) @ dx, (dx.T * wj) @ dy, (dy.T * wj) @ dy
            k = np.empty((m, 2, m, 2))
            k[:, 0, :, 0] = D[0, 0] * xx + D[2, 2] * yy
            k[:, 1, :, 1] = D[1, 1] * yy + D[2, 2] * xx
            k[:, 0, :, 1] = D[0, 1] * xy + D[2, 2] * xy.T
            k[:, 1, :, 0] = k[:, 0, :, 1].T
            dofs = (2 * nodes[:, None] + np.arange(2)).ravel()
            rows.append(np.repeat(dofs, 2 * m))
            cols.append(np.tile(dofs, 2 * m))
            stiff.append(k.reshape(-1))
            self.parts.append((dofs, k.reshape(2 * m, 2 * m)))
            if density:
                one = density * (self.N.T * wj) @ self.N
                both = np.zeros((m, 2, m, 2))
                both[:, 0, :, 0] = both[:, 1, :, 1] = one
                mass.append(both.reshape(-1))
        n = 2 * len(self.nodes)
        where = (np.concatenate(rows), np.concatenate(cols))
        K = sp.csc_matrix((np.concatenate(stiff), where), shape=(n, n))
        return (K, sp.csc_matrix((np.concatenate(mass), where), shape=(n, n))) if density else K

    def line_load(self, on, traction):
        """Nodal forces of a uniform traction on element sides whose two ends satisfy `on`."""
        f = np.zeros(2 * len(self.nodes))
        p = self.p
        x, w = legendre.leggauss(p + 2)
        weights = w @ lagrange(lobatto(p), x)[0]
        sides = (lambda i: i * (p + 1), lambda i: i * (p + 1) + p, lambda i: i, lambda i: p * (p + 1) + i)
        for nodes, _ in self.elements:
            for side in sides:
                chain = [nodes[side(i)] for i in range(p + 1)]
                ends = self.nodes[chain[0]], self.nodes[chain[-1]]
                if all(on(x) for x in ends):
                    length = np.linalg.norm(ends[1] - ends[0])
                    for node, weight in zip(chain, weights):
                        f[2 * node : 2 * node + 2] += 0.5 * length * weight * np.array(traction)
        return f

    def free(self, held):
        """Degrees of freedom that `held(x)`, a pair of booleans, leaves."""
        return np.array([2 * i + c for i, x in enumerate(self.nodes) for c in range(2) if not held(x)[c]])


def elasticity(E, nu, plane):
    if plane == "strain":
        E, nu = E / (1 - nu * nu), nu / (1 - nu)
    return E / (1 - nu * nu) * np.array([[1, nu, 0], [nu, 1, 0], [0, 0, 0.5 * (1 - nu)]])


def energy(plane, f, held):
    """f'u - u'K u / 2, of second order in the error of u; K u of slender elements element by element about their mean
    displacement, as a translation of theirs would drown the rest in rounding."""
    free = plane.free(held)
    K = plane.matrices()[free][:, free]
    scale = sp.diags(1.0 / np.sqrt(K.diagonal()))
    factor = spl.splu((scale @ K @ scale).tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True},
                      diag_pivot_thresh=0.0)
    u = np.zeros_like(f)

    def forces():
        total, stored = np.zeros_like(f), 0.0
        for dofs, k in plane.parts:
            local = u[dofs].reshape(-1, 2)
            local = (local - local.mean(axis=0)).ravel()
            answer = k @ local
            stored += 0.5 * local @ answer
            np.add.at(total, dofs, answer)
        return total, stored

    for _ in range(4):
        u[free] += scale @ factor.solve(scale @ (f - forces()[0])[free])
    return f @ u - forces()[1]


def cook(p, layers):
    """Cook's membrane, E = 1, nu = 1/3, plane stress, traction 1/16 upwards on the right."""
    plane = Plane(elasticity(1.0, 1.0 / 3.0, "stress"), p)
    along = np.concatenate([0.5 * graded(layers, "0"), 0.5 + 0.5 * graded(3, "1")[1:]])  # little at the free corners
    plane.add([[0, 0], [48, 44], [48, 60], [0, 44]], along, graded(layers, "01"), lambda a, b: (a, b))
    f = plane.line_load(lambda x: abs(x[0] - 48) < 1e-9, [0, 1 / 16])
    return energy(plane, f, lambda x: (x[0] == 0, x[0] == 0))


def square_hole(p, layers):
    """Ground around the hole |x|, |y| < 1, E = 1, nu = 0.3, plane strain, pressure 1e-3 on top and bottom; a quarter, as
    far as 1e6, where the displacement, falling like 1/r, is held at 0."""
    plane = Plane(elasticity(1.0, 0.3, "strain"), p)
    far = 1e6
    outwards = np.concatenate([graded(layers, "0") + 1.0, np.geomspace(2, far, 21)[1:]])
    b = (outwards - 1) / (far - 1)
    key = lambda which: lambda a, b: (a, round(which + b, 12))
    # From the symmetry line up the right side to the corner, and from there along the top.
    plane.add([[1, 0], [far, 0], [far, far], [1, 1]], b, graded(layers, "1"), key(0))
    plane.add([[1, 1], [far, far], [0, far], [0, 1]], b, graded(layers, "0"), key(1))
    f = plane.line_load(lambda x: abs(x[1] - 1) < 1e-12 and x[0] < 1 + 1e-12, [0, 1e-3])
    held = lambda x: (abs(x[0]) < 1e-9 * x[1] or max(x) > 0.999 * far, abs(x[1]) < 1e-9 * x[0] or max(x) > 0.999 * far)
    return 4 * energy(plane, f, held)


def frequencies(width, clamped, p, layers):
    """Of a steel plate width x 1, E = 210e9, nu = 0.3, rho = 7800, plane stress, clamped at the left or free."""
    plane = Plane(elasticity(210e9, 0.3, "stress"), p)
    if clamped:
        along = np.concatenate([graded(layers, "0"), np.arange(2, width + 1)]) / width
        across = graded(layers, "01")
    else:
        along = across = np.array([0.0, 0.5, 1.0])
    plane.add([[0, 0], [width, 0], [width, 1], [0, 1]], along, across, lambda a, b: (a, b))
    K, M = plane.matrices(7800.0)
    free = plane.free(lambda x: (clamped and x[0] == 0,) * 2)
    K, M = K[free][:, free], M[free][:, free]
    shift = 0.0 if clamped else -(2 * np.pi * 100) ** 2
    values = np.sort(spl.eigsh(K, 10 if clamped else 13, M, sigma=shift, which="LM")[0])
    return np.sqrt(values[0 if clamped else 3 :]) / (2 * np.pi)


def first_frequency(width, held, plane_of, p, layers):
    """First elastic one of the same plate; `held`: components that the edges left, right, bottom, top hold."""
    plane = Plane(elasticity(210e9, 0.3, plane_of), p)
    along = graded(layers, "01") if width <= 2 else np.concatenate(
        [graded(layers, "0"), np.arange(2, width), width - graded(layers, "0")[-2::-1]]) / width
    plane.add([[0, 0], [width, 0], [width, 1], [0, 1]], along, graded(layers, "01"), lambda a, b: (a, b))
    K, M = plane.matrices(7800.0)

    def holds(x):
        on = (x[0] == 0, x[0] == width, x[1] == 0, x[1] == 1)
        return tuple(any(at and component in edge for at, edge in zip(on, held)) for component in "xy")

    free = plane.free(holds)
    K, M = K[free][:, free], M[free][:, free]
    values = np.sort(spl.eigsh(K, 5, M, sigma=-(2 * np.pi * 20) ** 2, which="LM")[0])
    return np.sqrt(values[values > 1e3][0]) / (2 * np.pi)


def corner_exponent(sectors, near):
    """Exponent lambda of u = r^lambda f(theta) in a corner with free faces; `sectors`: (from, to, D), radians. Integrates
    f and the traction tau on the ray, tau = L_t' D (lambda L_r f + L_t f'), tau' = -lambda L_r' D (...), from face to face."""
    L = lambda n: np.array([[n[0], 0], [0, n[1]], [n[1], n[0]]])

    def tractions(exponent):
        state = np.concatenate([np.eye(2), np.zeros((2, 2))])
        for start, end, D in sectors:
            def slope(theta, y):
                f, tau = y.reshape(4, 2)[:2], y.reshape(4, 2)[2:]
                r, t = L((np.cos(theta), np.sin(theta))), L((-np.sin(theta), np.cos(theta)))
                f_slope = np.linalg.solve(t.T @ D @ t, tau - exponent * t.T @ D @ r @ f)
                return np.concatenate([f_slope, -exponent * r.T @ D @ (exponent * r @ f + t @ f_slope)]).ravel()
            state = scipy.integrate.solve_ivp(slope, (start, end), state.ravel(), "DOP853", rtol=1e-12, atol=1e-14)
            state = state.y[:, -1].reshape(4, 2)
        return np.linalg.det(state[2:])

    return scipy.optimize.brentq(tractions, near - 0.01, near + 0.01, xtol=1e-12)


def orthotropic(E1, E2, nu12, G12):
    return np.linalg.inv(np.array([[1 / E1, -nu12 / E1, 0], [-nu12 / E1, 1 / E2, 0], [0, 0, 1 / G12]]))


if __name__ == "__main__":
    concrete = elasticity(30, 0.2, "stress")
    # Example 07: concrete from 45 to 270 degrees, below it a laminate of axis 1 along y. Example of Williams: all concrete.
    laminate = orthotropic(50, 10, 0.28, 5)[np.ix_([1, 0, 2], [1, 0, 2])]
    quarter = np.pi / 4
    print("exponent of example 07  %.8f" % corner_exponent(
        [(0, quarter, laminate), (quarter, 6 * quarter, concrete)], 0.6184))
    print("exponent of concrete alone (Williams: 0.544483737)  %.9f" % corner_exponent([(0, 6 * quarter, concrete)], 0.5445))
    np.set_printoptions(precision=10, suppress=True, linewidth=120)
    for p, layers in ((5, 5), (8, 7)):
        print("order", p, "layers", layers)
        print("  elastic energy of Cook's membrane    %.9g (of slender elements rounding leaves 2e-6)" % cook(p, layers))
        print("  elastic energy around a square hole  %.9g" % square_hole(p + 3, layers - 1))
        print("  frequencies of a free square        ", frequencies(1, False, p + 3, 0))
        print("  frequencies of a cantilever 5 x 1   ", frequencies(5, True, p - 1, 5), flush=True)
    both, none, free = "xy", "", ("",) * 4
    for width, held, plane in (
        (5, (both, none, none, none), "stress"), (5, (both, both, none, none), "stress"), (2, (both, none, none, none), "stress"),
        (2, ("x", "x", none, none), "stress"), (1, (both, none, none, none), "stress"), (2, free, "stress"),
        (2, (both, both, none, none), "stress"), (2, (none, none, both, none), "stress"), (1, ("x", "x", none, none), "stress"),
        (2, (none, none, "y", "y"), "stress"), (2, ("x", "x", "y", none), "stress"), (2, (none, none, both, both), "stress"),
        (1, (both, "x", "y", "y"), "stress"), (1, (both, both, "y", "y"), "stress"),
    ):
        print("first frequency", width, held, *("%.4f" % first_frequency(width, held, plane, p, layers) for p, layers in ((5, 4), (7, 6))), flush=True)
