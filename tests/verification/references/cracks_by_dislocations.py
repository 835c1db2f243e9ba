"""Stress intensity factors of straight, curved, kinked and branched cracks in the infinite plane, by distributed
dislocations: the reference of tests/verification/crack_paths_test.cpp. It shares nothing with Scabo; NumPy alone.

    /usr/bin/python3 tests/verification/references/cracks_by_dislocations.py

prints closed forms beside what is computed, and the reference numbers for two discretisations, whose difference tells
what they are good for. Takes a minute or two.

Equation (Savruk 1981; Muskhelishvili's functions Phi, Psi of a density of dislocations g' on paths t): for all t' on
the paths

    1/pi int [ K g' dt + L conj(g' dt) ] = p(t'),    K = (1/(t - t') + e/conj(t - t')) / 2,
    L = (1/conj(t - t') - e (t - t')/conj(t - t')^2) / 2,    e = conj(dt')/dt',

with p = -(N - iT), N and T the normal and shear stress of the body without cracks on the path, and int g' dt = 0 over
every crack with all its branches (displacements have one value). Factors follow from g' -> -+(K_I - i K_II) /
sqrt(2 pi s) at the distance s from the end and the start of a path.

- Smooth cracks: g' = phi(x) / sqrt(1 - x^2) and the rule of Gauss and Chebyshev (Erdogan, Gupta 1972).
- Kinked and branched ones: straight segments between joints and tips. Each is cut into panels that get smaller
  geometrically towards a joint, where g' is singular like r^(lambda - 1), with Legendre polynomials on each. A panel
  at a tip has g' = phi(v) / v, phi even, v^2 the distance over its length. On straight panels both kernels are rational in t:
  Neumann's integral int P_n(t) / (t - z) dt = -2 Q_n(z) gives all integrals exactly, however near t' is. More
  collocation points than unknowns; least squares.
"""
import numpy as np

PI = np.pi


def stress_on(tangent, remote):
    """N - iT on a line of the unit tangent (complex), of the stress (xx, yy, xy)."""
    xx, yy, xy = remote
    n = 1j * tangent
    force = xx * n.real + xy * n.imag + 1j * (xy * n.real + yy * n.imag)
    return (force * np.conj(n)).real - 1j * (force * np.conj(tangent)).real


# ---- smooth cracks --------------------------------------------------------------------------------------


def smooth(paths, remote, n):
    """[(K at the start, K at the end), ...], K = K_I + i K_II, of paths: (t(x), dt/dx(x)), x on [-1, 1]."""
    k = np.arange(1, n + 1)
    x, y = np.cos(PI * (2 * k - 1) / (2 * n)), np.cos(PI * k[:-1] / n)
    count = len(paths)
    A, b = np.zeros((2 * n * count, 2 * n * count)), np.zeros(2 * n * count)

    def put(row, column, of_phi, of_conjugate):
        """Rows of Re and Im of of_phi * phi + of_conjugate * conj(phi) for complex unknowns phi."""
        c = 2 * column
        A[2 * row, c : c + 2 * n : 2] = (of_phi + of_conjugate).real
        A[2 * row + 1, c : c + 2 * n : 2] = (of_phi + of_conjugate).imag
        A[2 * row, c + 1 : c + 2 * n : 2] = (1j * (of_phi - of_conjugate)).real
        A[2 * row + 1, c + 1 : c + 2 * n : 2] = (1j * (of_phi - of_conjugate)).imag

    for i, (t_of, dt_of) in enumerate(paths):
        for r in range(n - 1):
            at, slope = t_of(y[r]), dt_of(y[r])
            e, row = np.conj(slope) / slope, i * n + r
            for j, (s_of, ds_of) in enumerate(paths):
                d, ds = s_of(x) - at, ds_of(x)
                K = 0.5 * (1 / d + e / np.conj(d))
                L = 0.5 * (1 / np.conj(d) - e * d / np.conj(d) ** 2)
                put(row, j * n, K * ds / n, L * np.conj(ds) / n)  # weights pi / n, over pi
            p = -stress_on(slope / abs(slope), remote)
            b[2 * row], b[2 * row + 1] = p.real, p.imag
        put(i * n + n - 1, i * n, dt_of(x) / n, 0 * x)
    phi = np.linalg.solve(A, b)
    phi = (phi[::2] + 1j * phi[1::2]).reshape(count, n)
    found = []
    for (_, dt_of), values in zip(paths, phi):
        # The polynomial through phi at the points of Gauss and Chebyshev, at the ends (Krenk).
        half = PI * (2 * k - 1) / (4 * n)
        end = np.sum(np.sin((2 * n - 1) * half) / np.sin(half) * values) / n
        start = np.sum((np.sin((2 * n - 1) * half) / np.sin(half))[::-1] * values) / n
        # s = |dt/dx| (1 - x), sqrt(1 - x^2) = sqrt(2 (1 - x))
        found.append((np.conj(start) * np.sqrt(PI * abs(dt_of(-1.0))), -np.conj(end) * np.sqrt(PI * abs(dt_of(1.0)))))
    return found


def line(a, b):
    return lambda x: 0.5 * (a + b) + 0.5 * (b - a) * x, lambda x: 0.5 * (b - a) + 0 * x


def arc(radius, half_angle):
    """Around the origin, symmetric about the y axis above, from right to left."""
    return (lambda x: 1j * radius * np.exp(1j * half_angle * x),
            lambda x: -radius * half_angle * np.exp(1j * half_angle * x))


# ---- straight segments with joints ----------------------------------------------------------------------


def legendre_integrals(z, n):
    """I[k] = int P_k(s) / (s - z) ds and J[k] = dI[k]/dz, s from -1 to 1, k < n: principal values for z within."""
    z = np.asarray(z, complex)
    I, J = np.zeros((n,) + z.shape, complex), np.zeros((n,) + z.shape, complex)
    far = np.abs(z - 1) + np.abs(z + 1) > 2.02  # the ellipse of the foci -1 and 1 and half axes 1.01 and 0.14
    near = z[~far]
    if near.size:  # upward: I_0 = ln((1 - z) / (-1 - z)), (k + 1) I_k+1 = (2 k + 1) z I_k - k I_k-1 + 2 delta_k0
        with np.errstate(divide="ignore", invalid="ignore"):
            logarithm = np.where(np.abs(near.imag) > 0, np.log((near - 1) / (near + 1)),
                                 np.log(np.abs((near - 1) / (near + 1))))
        rows = [logarithm, 2 + near * logarithm]
        for k in range(1, n + 1):
            rows.append(((2 * k + 1) * near * rows[k] - k * rows[k - 1]) / (k + 1))
        for k in range(n):
            I[k][~far] = rows[k]
            J[k][~far] = (k + 1) * (near * rows[k] - rows[k + 1]) / (1 - near**2)
    if far.any():  # by quadrature: two hundred points are exact outside this ellipse
        s, w = np.polynomial.legendre.leggauss(200)
        P = np.polynomial.legendre.legvander(s, n - 1) * w[:, None]
        d = 1.0 / (s[None, :] - z[far][:, None])
        I[:, far] = (d @ P).T
        J[:, far] = ((d * d) @ P).T
    return I, J


class Segment:
    """From the complex point a to b; each a 'tip' or a 'joint'."""

    def __init__(self, a, b, at_a, at_b):
        self.a, self.b, self.at = a, b, (at_a, at_b)

    def panels(self, layers, ratio):
        """(start, length, direction, tip?): a tip is at the start of its panel, which then runs backwards."""
        def half(origin, other, kind):
            middle = 0.5 * (other - origin)
            length, direction = abs(middle), middle / abs(middle)
            if kind == "tip":
                return [(origin, length, direction, True)]
            breaks = length * np.concatenate([[0.0], ratio ** np.arange(layers, -1, -1.0)])
            return [(origin + direction * r0, r1 - r0, direction, False) for r0, r1 in zip(breaks, breaks[1:])]
        return half(self.a, self.b, self.at[0]), half(self.b, self.a, self.at[1])


def panel_integrals(panel, offset, n):
    """int basis_k / (t - z) dt and int basis_k / (t - z)^2 dt over a straight panel, dt along its direction, for z =
    start + direction * offset: real offsets are on the line of the panel."""
    _, length, direction, tip = panel
    if not tip:  # t = start + direction length (1 + s) / 2
        scale = 0.5 * length
        I, J = legendre_integrals(offset / scale - 1, n)
        return I, J / (scale * direction)
    # t = start + direction length v^2, g' = phi(v) / v, phi = P_2k, v from 0 to 1: the integral is 1/c int phi / (v - c) dv
    # over [-1, 1], c^2 = offset / length
    c = np.sqrt(offset / length)
    I, J = legendre_integrals(c, 2 * n)
    I, J = I[::2], J[::2]
    return I / c, (J / c - I / c**2) / (2 * c * length * direction)


def joined(cracks, remote, n, layers, ratio=0.2):
    """K_I + i K_II at every tip, in the order of the segments of all cracks: [[Segment, ...], ...]."""
    panels, owner = [], []  # crack, segment, and the sign of the direction of a panel against that of its segment
    for i, crack in enumerate(cracks):
        for segment in crack:
            for sign, half in zip((1.0, -1.0), segment.panels(layers, ratio)):
                panels += half
                owner += [(i, segment, sign)] * len(half)
    x, w = np.polynomial.legendre.leggauss(2 * (n + 4))
    y, v = np.polynomial.legendre.leggauss(n + 4)
    points, tangents, weights, of_segment = [], [], [], []
    for (start, length, direction, tip), (_, segment, sign) in zip(panels, owner):
        if tip:
            r, weight = x[n + 4 :] ** 2 * length, w[n + 4 :] * 2 * x[n + 4 :] * length
        else:
            r, weight = 0.5 * (1 + y) * length, 0.5 * v * length
        points.append(start + direction * r)
        tangents.append(np.full(len(r), sign * direction))
        # Least squares in L2 with the weight r^0.8, in which the Hilbert transform is bounded and r^(lambda - 1) is small
        # near the joint; in L2 itself it is hardly integrable for a large kink, and the innermost panel counts.
        weights.append(weight * length**0.8)
        of_segment += [id(segment)] * len(r)
    t, tangent, weight, of_segment = map(np.concatenate, (points, tangents, weights, [of_segment]))
    e = np.conj(tangent) / tangent
    N = n * len(panels)
    first, second = np.zeros((len(t) + len(cracks), N), complex), np.zeros((len(t) + len(cracks), N), complex)
    for j, (panel, (crack, segment, sign)) in enumerate(zip(panels, owner)):
        start, length, direction, tip = panel
        fold = np.conj(direction) / direction  # conj(t) - conj(t') = fold (t - image)
        offset = (t - start) / direction
        on_line = of_segment == id(segment)
        offset = np.where(on_line, offset.real + 0j, offset)
        image = np.where(on_line, t, start + direction * np.conj(offset))
        here, _ = panel_integrals(panel, offset, n)
        there, twice = panel_integrals(panel, np.conj(offset), n)
        there = np.where(on_line, here, there)
        # conj(dt) = fold dt; everything below is int ... dt with the unknown's own direction, sign taken out
        rows = slice(0, len(t)), slice(j * n, (j + 1) * n)
        first[rows] = sign * (0.5 / PI * (here + e * there / fold)).T
        second[rows] = sign * (0.5 / PI * (there - e / fold * (there + np.where(on_line, 0, (image - t) * twice)))).T
        ones = np.zeros(n)
        ones[0] = 2 * length if tip else length
        first[len(t) + crack, j * n : (j + 1) * n] = sign * ones * direction
    scale = np.concatenate([np.sqrt(weight), np.full(len(cracks), 10.0)])
    b = np.concatenate([-stress_on(tangent, remote), np.zeros(len(cracks))]) * scale
    columns = np.repeat([panel[1] ** -0.9 for panel in panels], n)
    first, second = first * scale[:, None] * columns, second * scale[:, None] * columns
    A = np.block([[(first + second).real, (1j * (first - second)).real],
                  [(first + second).imag, (1j * (first - second)).imag]])
    solution = np.linalg.lstsq(A, np.concatenate([b.real, b.imag]), rcond=1e-15)[0]
    g = (solution[:N] + 1j * solution[N:]) * columns
    found = []
    even = np.array([np.polynomial.legendre.Legendre.basis(2 * k)(0.0) for k in range(n)])
    for j, ((start, length, direction, tip), (_, _, sign)) in enumerate(zip(panels, owner)):
        if tip:  # g' = phi / v, v = sqrt(s / length)
            limit = np.sum(even * g[j * n : (j + 1) * n]) * np.sqrt(length)
            found.append(sign * np.conj(limit) * np.sqrt(2 * PI))
    return found


# ---- what is compared ---------------------------------------------------------------------------------


def path(*points):
    """Segments of a bent crack with two tips."""
    last = len(points) - 2
    return [Segment(complex(*a), complex(*b), "joint" if k else "tip", "tip" if k == last else "joint")
            for k, (a, b) in enumerate(zip(points, points[1:]))]


def branches(*tips):
    """Segments from the origin."""
    return [Segment(0j, complex(*tip), "joint", "tip") for tip in tips]


def around_arc(pieces):
    """Points of a path that touches the arc of radius 2, 90 degrees, symmetric about the y axis, from right to left: at its
    ends and between its corners."""
    step = 0.5 * PI / pieces
    angles = 0.25 * PI + np.concatenate([[0.0], step * (np.arange(pieces) + 0.5), [0.5 * PI]])
    z = 2.0 * np.exp(1j * angles) / np.cos(np.where(np.isin(angles, angles[[0, -1]]), 0.0, 0.5 * step))
    return [(x.real, x.imag) for x in z]


def elliptic(k2):
    """E / K of the squared modulus, by the arithmetic and geometric mean."""
    a, b, total, power = 1.0, np.sqrt(1 - k2), 0.5 * k2, 1.0
    for _ in range(12):
        a, b, c = 0.5 * (a + b), np.sqrt(a * b), 0.5 * (a - b)
        total += power * c * c
        power *= 2
    return 1 - total


def collinear(a, b):
    """K_I / sigma at a and b, of cracks from -b to -a and from a to b."""
    ratio, root = elliptic(1 - (a / b) ** 2), np.sqrt(b * b - a * a)
    return np.sqrt(PI / a) * (b * b * ratio - a * a) / root, np.sqrt(PI / b) * b * b * (1 - ratio) / root


def arc_in_equal_tension(radius, half_angle):
    """K_I, K_II / sigma of a circular arc under tension from all sides (Muskhelishvili)."""
    K = np.sqrt(PI * radius * np.sin(half_angle)) / (1 + np.sin(0.5 * half_angle) ** 2)
    return K * np.cos(0.5 * half_angle), K * np.sin(0.5 * half_angle)


def short_kink(angle):
    """K_I and K_II at the end of a kink of no length over K_I before it (Amestoy, Leblond 1992)."""
    m = angle / 180.0
    first = [1, -3 * PI**2 / 8, PI**2 - 5 * PI**4 / 128, PI**2 / 9 - 11 * PI**4 / 72 + 119 * PI**6 / 15360, 5.07790,
             -2.88312, -0.0925, 2.996, -4.059]
    second = [PI / 2, -4 * PI / 3 - PI**3 / 48, -2 * PI / 3 + 13 * PI**3 / 30 - 59 * PI**5 / 3840, -6.176023, 4.44112,
              -1.5340, -2.0700, 4.684]
    return sum(c * m ** (2 * k) for k, c in enumerate(first)), sum(c * m ** (2 * k + 1) for k, c in enumerate(second))


UP, ALL = (0, 1, 0), (1, 1, 0)
FINE, COARSE = (16, 16), (12, 12)  # terms of a panel, layers at a joint


def show(name, found, other, expected=None):
    print(name)
    for k, (K, coarse) in enumerate(zip(found, other)):
        text = f"  {K.real:11.7f} {K.imag:11.7f}   changed by {abs(K - coarse):.0e}"
        if expected is not None:
            text += f"   differs from the closed form by {abs(K - complex(*expected[k])):.0e}"
        print(text)


def show_joined(name, cracks, remote, expected=None, fine=FINE, coarse=COARSE):
    show(name, joined(cracks, remote, *fine), joined(cracks, remote, *coarse), expected)


def show_smooth(name, paths, remote, expected=None):
    flat = lambda n: [K for pair in smooth(paths, remote, n) for K in pair]
    show(name, flat(60), flat(40), expected)


def main():
    print("K_I and K_II at each tip, tension of 1\n\nClosed forms")
    c, s = np.cos(0.6), np.sin(0.6)
    inclined = [(np.sqrt(PI) * c * c, np.sqrt(PI) * s * c)] * 2
    show_smooth("inclined crack, Gauss and Chebyshev", [line(-c - 1j * s, c + 1j * s)], UP, inclined)
    show_joined("the same of two segments", [path((-c, -s), (0.3 * c, 0.3 * s), (c, s))], UP, inclined)
    inner, outer = collinear(0.1, 2.1)
    show_smooth("collinear cracks of length 2, 0.2 apart", [line(-2.1 + 0j, -0.1 + 0j), line(0.1 + 0j, 2.1 + 0j)], UP,
                [(outer, 0), (inner, 0), (inner, 0), (outer, 0)])
    K_I, K_II = arc_in_equal_tension(2.0, PI / 4)
    show_smooth("arc, radius 2, 90 degrees, tension from all sides", [arc(2.0, PI / 4)], ALL, [(K_I, -K_II), (K_I, K_II)])
    print("\nKinks of a crack from -1 to 1, tension from all sides, over sqrt(pi): length 1e-4, and the kink of no length")
    for angle in (15.0, 45.0, 70.0):
        end = 1e-4 * np.exp(1j * angle * PI / 180)
        kinked = [Segment(-2 + 0j, 0j, "tip", "joint"), Segment(0j, end, "joint", "tip")]
        K, rough = joined([kinked], ALL, *FINE)[1] / np.sqrt(PI), joined([kinked], ALL, *COARSE)[1] / np.sqrt(PI)
        print("  %g degrees: %.6f %.6f, changed by %.0e; %.6f %.6f" % (angle, K.real, K.imag, abs(K - rough), *short_kink(angle)))
    cross = joined([branches((1, 0), (0, 1), (-1, 0), (0, -1))], ALL, *FINE)[0].real / np.sqrt(PI)
    print("  cross of length 2: %.6f (Rooke, Sneddon 1969: 0.8636)" % cross)

    print("\nReference numbers")
    show_smooth("arc, radius 2, 90 degrees about the y axis, tension along y: right end, left end", [arc(2.0, PI / 4)], UP)
    show_joined("five straight pieces that touch it", [path(*around_arc(4))], UP, fine=(12, 9), coarse=(9, 7))
    show_smooth("two cracks, (-1, 0) to (1, 0) and (0.4, 0.5) to (1.6, 1.3), tension along y",
                [line(-1 + 0j, 1 + 0j), line(0.4 + 0.5j, 1.6 + 1.3j)], UP)
    show_joined("bent crack, (-1, 0), (0, 0), (0.6, 0.6), tension along y", [path((-1, 0), (0, 0), (0.6, 0.6))], UP)
    show_joined("bent twice, (-1, -0.4), (-0.3, 0), (0.3, 0), (1, 0.6), tension along y",
                [path((-1, -0.4), (-0.3, 0), (0.3, 0), (1, 0.6))], UP)
    show_joined("branches from the origin to (-1, 0), (0.6, 0.4), (0.6, -0.4), tension along y",
                [branches((-1, 0), (0.6, 0.4), (0.6, -0.4))], UP)
    show_joined("the same, tension from all sides", [branches((-1, 0), (0.6, 0.4), (0.6, -0.4))], ALL)
    h = np.sqrt(0.75)
    show_joined("star of three branches of length 1, tension from all sides", [branches((0, 1), (-h, -0.5), (h, -0.5))], ALL)


if __name__ == "__main__":
    main()
