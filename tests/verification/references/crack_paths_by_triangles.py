#!/usr/bin/env python3
"""Paths of cracks by plain finite elements, which share nothing with Scabo: quadratic triangles of Gmsh, quarter points at the tip, interaction integrals
over a disc around it, maximum hoop stress, a new mesh for every length. A step goes half of its length along the kink; the kink that is left there turns
the whole step. Faces of cracks do not touch.

    OPENBLAS_NUM_THREADS=1 crack_paths_by_triangles.py three_holes [--from-middle 5] [--deep 1.5] [--radius 0.25] [--step 0.05] [--until 4]
    OPENBLAS_NUM_THREADS=1 crack_paths_by_triangles.py in_shear --step 10 --size 20 --until 300
    OPENBLAS_NUM_THREADS=1 crack_paths_by_triangles.py two_notches --step 10 --size 20 --until 160

prints length, tip, K_I and K_II, and the least distance of the path from the edge of the low hole. three_holes: Bittencourt and others 1996, under a unit
force; in_shear and two_notches: beams of benchmarks/growth/courses.py after Arrea and Ingraffea 1982 and Bocca and others 1991. Needs gmsh, numpy and
scipy.
"""
import argparse
import math
import pathlib
import subprocess
import tempfile

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

PLANE_STRESS = True


class Beam:
    """Outline counter-clockwise from the left lower corner, on whose lower edge the crack begins, with holes, point loads and what is held. `middle`: of a
    body with a second crack, which is the first one turned about this point by half a turn."""
    def __init__(self, corners, notch, loads, held, poisson, holes=(), radius=0.0, middle=None):
        self.corners, self.notch, self.loads, self.held, self.poisson, self.holes, self.radius = corners, notch, loads, held, poisson, holes, radius
        self.middle = middle

    def paths(self, path):
        return [path] if self.middle is None else [path, [2 * np.array(self.middle) - x for x in path]]

    def height(self):
        return self.corners[-1][1]


def three_holes(options):
    x = -options.from_middle
    return Beam([(-10, 0), (-9, 0), (x, 0), (9, 0), (10, 0), (10, 8), (0, 8), (-10, 8)], [(x, 0), (x, options.deep)], [((0, 8), -1.0)],
                [((-9, 0), "xy"), ((9, 0), "y")], 0.3, ((-4.0, 2.75), (-4.0, 4.75), (-4.0, 6.75)), options.radius)


def in_shear(_):
    return Beam([(0, 0), (600, 0), (661, 0), (1119, 0), (1322, 0), (1322, 306), (722, 306), (203, 306), (0, 306)], [(661, 0), (661, 82)],
                [((722, 306), -1.0), ((203, 306), -0.13)], [((600, 0), "xy"), ((1119, 0), "y")], 0.18)


def two_notches(_):
    return Beam([(0, 0), (320, 0), (400, 0), (780, 0), (800, 0), (800, 200), (480, 200), (400, 200), (20, 200), (0, 200)], [(400, 0), (400, 40)],
                [((480, 200), -1.0), ((20, 200), -80 / 380)], [((320, 0), "xy"), ((780, 0), "y")], 0.18, middle=(400, 100))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("beam", choices=("three_holes", "in_shear", "two_notches"))
    for name, value in (("from-middle", 5.0), ("deep", 1.5), ("step", 0.05), ("size", 0.125), ("until", 4.0), ("radius", 0.25)):
        parser.add_argument(f"--{name}", type=float, default=value)
    options = parser.parse_args()
    beam = globals()[options.beam](options)
    path = [np.array(point, dtype=float) for point in beam.notch]
    length = np.linalg.norm(path[1] - path[0])
    while length < options.until + 1e-9:
        K = factors(beam, path, options)
        print(f"{length:.4f} {path[-1][0]:.5f} {path[-1][1]:.5f} {K[0]:.5f} {K[1]:+.5f}", flush=True)
        ahead = turned(path[-1] - path[-2], kink(K))
        middle = factors(beam, path + [path[-1] + 0.5 * options.step * ahead], options)
        tip = path[-1] + options.step * turned(ahead, kink(middle))
        if any(np.linalg.norm(tip - hole) < beam.radius for hole in beam.holes) or tip[1] > beam.height() - options.step:
            print("ends in a hole or at the upper edge")
            break
        path.append(tip)
        length += options.step
    if beam.holes:
        print(f"passes the low hole at {distance(np.array(path), np.array(beam.holes[0])) - beam.radius:.4f}")


def kink(K):
    """Maximum hoop stress: counter-clockwise from the crack's direction. A closed tip has no K_I."""
    K = np.array([max(K[0], 0.0), K[1]])
    return -2.0 * math.atan2(2.0 * K[1], K[0] + math.sqrt(K[0]**2 + 8.0 * K[1]**2))


def turned(along, angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * along[0] - s * along[1], s * along[0] + c * along[1]]) / np.linalg.norm(along)


def distance(path, centre):
    """Of a point from a path."""
    along = np.diff(path, axis=0)
    part = np.clip(((centre - path[:-1]) * along).sum(axis=1) / (along**2).sum(axis=1), 0, 1)
    return np.linalg.norm(path[:-1] + part[:, None] * along - centre, axis=1).min()


def factors(beam, path, options):
    """K_I and K_II at the tip, for a thickness of 1."""
    last = np.linalg.norm(path[-1] - path[-2])
    gap = min((np.linalg.norm(path[-1] - hole) - beam.radius for hole in beam.holes), default=math.inf)
    inner = 0.9 * min(last, options.step, 2.0 * gap, beam.height() - path[-1][1]) / 2.0  # of the disc, within the last, straight segment, and the body
    nodes, triangles, cracks = mesh(beam, path, inner, options)
    for crack, of_crack in zip(cracks, beam.paths(path)):
        nodes, triangles = opened(nodes, triangles, crack, of_crack)
        quarter_points(nodes, triangles, of_crack[-1])
    return interaction(beam, nodes, triangles, displacements(beam, nodes, triangles), path, inner)


class Geometry:
    """Points and curves in the language of Gmsh."""
    def __init__(self):
        self.points, self.curves = [], []

    def point(self, x, y):
        self.points.append(f"Point({len(self.points) + 1}) = {{{x:.15g}, {y:.15g}, 0}};")
        return len(self.points)

    def curve(self, kind, *ends):
        self.curves.append(f"{kind}({len(self.curves) + 1}) = {{{', '.join(map(str, ends))}}};")
        return len(self.curves)

    def loop(self, kind, ends, centre=()):
        return [self.curve(kind, a, *centre, b) for a, b in zip(ends, ends[1:] + ends[:1])]


def mesh(beam, path, inner, options):
    """Nodes, quadratic triangles and the edges of each crack, which is a line inside."""
    geometry, listed = Geometry(), lambda numbers: ", ".join(map(str, numbers))
    corners = [geometry.point(*x) for x in beam.corners]
    loops, cracks, tips = [geometry.loop("Line", corners)], [], []
    for points in beam.paths(path):
        crack = [corners[beam.corners.index(tuple(points[0]))]] + [geometry.point(*x) for x in points[1:]]
        cracks.append([geometry.curve("Line", a, b) for a, b in zip(crack, crack[1:])])
        tips.append(crack[-1])
    of_crack = sum(cracks, [])
    for x, y in beam.holes:
        around = [geometry.point(x + beam.radius * c, y + beam.radius * s) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
        loops.append(geometry.loop("Circle", around, (geometry.point(x, y),)))
    loaded = [corners[beam.corners.index(x)] for x, _ in [*beam.loads, *beam.held]]
    text = geometry.points + geometry.curves
    text += [f"Curve Loop({k + 1}) = {{{listed(loop)}}};" for k, loop in enumerate(loops)]
    text += [f"Plane Surface(1) = {{{listed(range(1, len(loops) + 1))}}};", f"Curve{{{listed(of_crack)}}} In Surface{{1}};"]
    near = {1: (f"PointsList = {{{listed(tips)}}}", inner / 5.0, 0.18), 2: (f"CurvesList = {{{listed(of_crack)}}}", min(options.size / 2, options.step), 0.2),
            3: (f"PointsList = {{{listed(loaded)}}}", options.size / 2, 0.3)}
    if beam.holes:
        near[4] = (f"CurvesList = {{{listed(c for loop in loops[1:] for c in loop)}}}", min(options.size / 2, beam.radius / 4), 0.2)
    for k, (of, size, growth) in near.items():
        text += [f"Field[{2 * k}] = Distance;", f"Field[{2 * k}].{of};", f"Field[{2 * k}].NumPointsPerCurve = 60;", f"Field[{2 * k + 1}] = MathEval;",
                 f'Field[{2 * k + 1}].F = "{size:.8g} + {growth} * F{2 * k}";']
    text += ["Field[20] = MathEval;", f'Field[20].F = "{4 * options.size:.8g}";', "Field[21] = Min;", f"Field[21].FieldsList = {{20, {listed(2 * k + 1 for k in near)}}};",
             "Background Field = 21;", "Mesh.CharacteristicLengthExtendFromBoundary = 0;", "Mesh.CharacteristicLengthFromPoints = 0;", "Mesh.ElementOrder = 2;",
             "Mesh.MshFileVersion = 2.2;", "Physical Surface(1) = {1};"]
    text += [f"Physical Curve({k + 2}) = {{{listed(curves)}}};" for k, curves in enumerate(cracks)]
    with tempfile.TemporaryDirectory() as directory:
        written, result = pathlib.Path(directory) / "beam.geo", pathlib.Path(directory) / "beam.msh"
        written.write_text("\n".join(text), encoding="utf-8")
        subprocess.run(["gmsh", "-2", "-v", "1", written, "-o", result], check=True)
        return read(result.read_text(encoding="utf-8").split("\n"))


def read(text):
    start = text.index("$Nodes")
    count = int(text[start + 1])
    rows = [text[start + 2 + k].split() for k in range(count)]
    number = {row[0]: k for k, row in enumerate(rows)}
    nodes = np.array([[float(row[1]), float(row[2])] for row in rows])
    start = text.index("$Elements")
    triangles, cracks = [], {}
    for row in (text[start + 2 + k].split() for k in range(int(text[start + 1]))):
        ends = [number[n] for n in row[3 + int(row[2]):]]
        if row[1] == "9":
            triangles.append(ends)
        elif row[1] == "8":
            cracks.setdefault(row[3], []).append(ends[:2])
    used = np.unique(np.array(triangles))
    place = np.full(count, -1)
    place[used] = np.arange(len(used))
    return nodes[used], place[np.array(triangles)], [{frozenset(int(place[n]) for n in edge) for edge in crack} for _, crack in sorted(cracks.items())]


def opened(nodes, triangles, crack, path):
    """Nodes of the crack twice, but its tip: triangles to its right have those that are added."""
    tip = int(np.argmin(np.linalg.norm(nodes - path[-1], axis=1)))
    order = {n: along(np.array(path), nodes[n]) for edge in crack for n in edge}
    swapped, extra, right = triangles.copy(), [], {n: set() for n in order if n != tip}

    def added(x):
        extra.append(x)
        return len(nodes) + len(extra) - 1

    for t, triangle in enumerate(triangles):
        for k in range(3):
            first, last = int(triangle[k]), int(triangle[(k + 1) % 3])
            if frozenset((first, last)) in crack and order[first] > order[last]:  # counter-clockwise: the crack goes the other way
                swapped[t][3 + k] = added(nodes[triangle[3 + k]])
                for n in {first, last} - {tip}:
                    right[n].add(t)
    for n, group in right.items():
        around = set(np.nonzero((triangles[:, :3] == n).any(axis=1))[0])
        while more := {t for t in around - group if any(is_beside(triangles[t], triangles[other], n, crack) for other in group)}:
            group |= more
        copy = added(nodes[n])
        for t in group:
            swapped[t][list(triangles[t]).index(n)] = copy
    return np.vstack([nodes, np.array(extra)]), swapped


def is_beside(one, other, node, crack):
    """Whether two triangles have a side at a node in common that is not one of the crack."""
    side = frozenset(map(int, one[:3])) & frozenset(map(int, other[:3]))
    return len(side) == 2 and node in side and side not in crack


def along(points, x):
    """How far along a path a point of it lies."""
    best, sum_, at = math.inf, 0.0, 0.0
    for a, b in zip(points, points[1:]):
        length = np.linalg.norm(b - a)
        part = min(max(np.dot(x - a, b - a) / length**2, 0.0), 1.0)
        off = np.linalg.norm(a + part * (b - a) - x)
        if off < best - 1e-12:
            best, at = off, sum_ + part * length
        sum_ += length
    return at


def quarter_points(nodes, triangles, tip):
    corner = int(np.argmin(np.linalg.norm(nodes - tip, axis=1)))
    for triangle in triangles[(triangles[:, :3] == corner).any(axis=1)]:
        k = list(triangle[:3]).index(corner)
        for far, middle in ((triangle[(k + 1) % 3], triangle[3 + k]), (triangle[(k + 2) % 3], triangle[3 + (k + 2) % 3])):
            nodes[middle] = 0.75 * nodes[corner] + 0.25 * nodes[far]


GAUSS = np.array([[0.445948490915965] * 2, [0.108103018168070, 0.445948490915965], [0.445948490915965, 0.108103018168070],
                  [0.091576213509771] * 2, [0.816847572980459, 0.091576213509771], [0.091576213509771, 0.816847572980459]])
WEIGHTS = np.array([0.223381589678011] * 3 + [0.109951743655322] * 3) / 2


def shape(r, s):
    """Of a quadratic triangle: values and derivatives by r and s."""
    t = 1 - r - s
    N = np.array([t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1), 4 * r * t, 4 * r * s, 4 * s * t])
    by_r = np.array([1 - 4 * t, 4 * r - 1, 0, 4 * (t - r), 4 * s, -4 * s])
    by_s = np.array([1 - 4 * t, 0, 4 * s - 1, -4 * r, 4 * r, 4 * (t - s)])
    return N, np.array([by_r, by_s])


def gradients(x):
    """For all triangles, of coordinates (n, 6, 2), at each Gauss point: derivatives by x and y (n, 2, 6) and weight times area (n)."""
    for (r, s), weight in zip(GAUSS, WEIGHTS):
        N, D = shape(r, s)
        J = np.einsum("ki,nij->nkj", D, x)
        area = J[:, 0, 0] * J[:, 1, 1] - J[:, 0, 1] * J[:, 1, 0]
        inverse = np.stack([np.stack([J[:, 1, 1], -J[:, 0, 1]], axis=1), np.stack([-J[:, 1, 0], J[:, 0, 0]], axis=1)], axis=1) / area[:, None, None]
        yield N, inverse @ D, weight * area


def elasticity(poisson):
    E, nu = 1.0, poisson
    if not PLANE_STRESS:
        E, nu = E / (1 - nu**2), nu / (1 - nu)
    return E / (1 - nu**2) * np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]]), E


def displacements(beam, nodes, triangles):
    D, _ = elasticity(beam.poisson)
    K = np.zeros((len(triangles), 12, 12))
    for _, G, weight in gradients(nodes[triangles]):
        B = np.zeros((len(triangles), 3, 12))
        B[:, 0, 0::2], B[:, 1, 1::2], B[:, 2, 0::2], B[:, 2, 1::2] = G[:, 0], G[:, 1], G[:, 1], G[:, 0]
        K += B.transpose(0, 2, 1) @ (weight[:, None, None] * (D @ B))
    dofs = np.stack([2 * triangles, 2 * triangles + 1], axis=2).reshape(len(triangles), 12)
    n = 2 * len(nodes)
    rows, columns = np.repeat(dofs, 12, axis=1).ravel(), np.tile(dofs, (1, 12)).ravel()
    K = scipy.sparse.csc_matrix((K.ravel(), (rows, columns)), shape=(n, n))

    def node(x, y):
        return int(np.argmin(np.linalg.norm(nodes - (x, y), axis=1)))

    held = [2 * node(*x) + "xy".index(axis) for x, axes in beam.held for axis in axes]
    free = np.setdiff1d(np.arange(n), held)
    f, u = np.zeros(n), np.zeros(n)
    for x, force in beam.loads:
        f[2 * node(*x) + 1] = force
    u[free] = scipy.sparse.linalg.spsolve(K[free][:, free], f[free])
    return u.reshape(-1, 2)


def field(x, number, modulus, kappa):
    """Of the factor K_I = 1 or K_II = 1 at points from the tip, in its axes: stress, and gradient of the displacement by the points."""
    def u(x):
        r, a = np.hypot(x[:, 0], x[:, 1]), np.arctan2(x[:, 1], x[:, 0])
        by = np.sqrt(r / (2 * math.pi)) / (2 * modulus)
        if number == 0:
            return by[:, None] * np.stack([np.cos(a / 2) * (kappa - np.cos(a)), np.sin(a / 2) * (kappa - np.cos(a))], axis=1)
        return by[:, None] * np.stack([np.sin(a / 2) * (kappa + 2 + np.cos(a)), -np.cos(a / 2) * (kappa - 2 + np.cos(a))], axis=1)

    step = 1e-6 * np.hypot(x[:, 0], x[:, 1])
    gradient = np.empty((len(x), 2, 2))
    for j in (0, 1):
        by = np.zeros_like(x)
        by[:, j] = step
        gradient[:, :, j] = (u(x + by) - u(x - by)) / (2 * step[:, None])
    return gradient


def interaction(beam, nodes, triangles, u, path, radius):
    """K_I and K_II by interaction integrals over the disc, q falling from 1 at the middle of its radius to 0 at its rim."""
    D, E = elasticity(beam.poisson)
    modulus = 1.0 / (2 * (1 + beam.poisson))
    kappa = (3 - beam.poisson) / (1 + beam.poisson) if PLANE_STRESS else 3 - 4 * beam.poisson
    tip, ahead = path[-1], (path[-1] - path[-2]) / np.linalg.norm(path[-1] - path[-2])
    axes = np.array([ahead, [-ahead[1], ahead[0]]])
    x, u = (nodes - tip) @ axes.T, u @ axes.T
    q = np.clip(2.0 - 2.0 * np.linalg.norm(x, axis=1) / radius, 0, 1)
    inside = (np.ptp(q[triangles], axis=1) > 0)
    cells = triangles[inside]
    result = np.zeros(2)
    for N, G, weight in gradients(x[cells]):
        at = np.einsum("i,nij->nj", N, x[cells])
        of_u = np.einsum("nji,nik->nkj", G, u[cells])  # du_k/dx_j
        of_q = np.einsum("nji,ni->nj", G, q[cells])
        stress = stresses(of_u, D)
        for k in (0, 1):
            of_field = field(at, k, modulus, kappa)
            known = stresses(of_field, D)
            work = np.einsum("nij,nij->n", stress, of_field)
            integrand = np.einsum("nij,ni,nj->n", stress, of_field[:, :, 0], of_q) + np.einsum("nij,ni,nj->n", known, of_u[:, :, 0], of_q) - work * of_q[:, 0]
            result[k] += np.dot(integrand, weight)
    return result * E / 2


def stresses(gradient, D):
    strain = np.stack([gradient[:, 0, 0], gradient[:, 1, 1], gradient[:, 0, 1] + gradient[:, 1, 0]], axis=1)
    s = strain @ D.T
    return np.stack([np.stack([s[:, 0], s[:, 2]], axis=1), np.stack([s[:, 2], s[:, 1]], axis=1)], axis=1)


if __name__ == "__main__":
    main()
