"""Stacks of rigid bodies as discrete contact problems: towers, walls in running bond, piles. W = H' M^-1 H, q = H' v: far fewer motions than
contacts, so that W is rank-deficient, and q in the range of H', so that a solution exists (r = 0 is one where v is at rest).

Unknowns are impulses and velocities of one time step. v = gravity times the step and a random velocity of each body; unit cubes of
density 1 (or spheres of radius 1/2, mass 1), times the factor of the masses. A body's motion is [velocity of its centre, rate of turn].

    stacks.py FOLDER            writes all of them as HDF5 files of FCLIB (local form)
    stacks.py FOLDER --large    the large ones instead
"""
import dataclasses
import pathlib
import sys

import h5py
import numpy
import scipy.sparse

STEP = 0.01 * 9.81      # m/s: gravity times the step
GROUND = -1


@dataclasses.dataclass
class Stack:
    dimension: int
    centres: numpy.ndarray           # bodies x 3
    masses: numpy.ndarray
    inertias: numpy.ndarray          # about every axis alike: those of cubes and of spheres
    contacts: list                   # (lower body, upper body, point, normal towards the upper one)


def tangents(normal):
    other = numpy.eye(3)[numpy.argmin(abs(normal))]
    first = numpy.cross(normal, other)
    first /= numpy.linalg.norm(first)
    return first, numpy.cross(normal, first)


def problem(stack, mu, random, speed=0.05):
    """W (sparse), q, mu of the stack. In the plane: motions x, y and the turn about z; normal, tangent."""
    d, bodies = stack.dimension, len(stack.masses)
    rows, columns, values = [], [], []
    for i, (lower, upper, point, normal) in enumerate(stack.contacts):
        directions = (normal,) + tangents(normal) if d == 3 else (normal, numpy.array([-normal[1], normal[0], 0.0]))
        for sign, body in ((1.0, upper), (-1.0, lower)):
            if body == GROUND:
                continue
            for k, direction in enumerate(directions):
                arm = numpy.cross(point - stack.centres[body], direction)
                for j, value in enumerate((*direction, *arm)):
                    if value != 0.0:
                        rows.append(6 * body + j)
                        columns.append(d * i + k)
                        values.append(sign * value)
    H = scipy.sparse.coo_matrix((values, (rows, columns)), shape=(6 * bodies, d * len(stack.contacts))).tocsr()
    inverse = numpy.repeat(numpy.column_stack([1.0 / stack.masses, 1.0 / stack.inertias]), 3, axis=1).ravel()
    W = (H.T @ scipy.sparse.diags(inverse) @ H).tocsc()
    W.sort_indices()
    v = numpy.zeros((bodies, 6))
    up = 2 if d == 3 else 1
    v[:, up] -= STEP
    moving = [0, 1, 2, 3, 4, 5] if d == 3 else [0, 1, 5]
    v[:, moving] += speed * random.standard_normal((bodies, len(moving)))
    return W, H.T @ v.ravel(), numpy.full(len(stack.contacts), mu)


def cubes(dimension, centres, masses, contacts):
    masses = numpy.asarray(masses, float)
    return Stack(dimension, numpy.array(centres), masses, masses / 6.0, contacts)


def face(dimension, points, low, high, height, turn=0.0, about=(0.0, 0.0)):
    """Contact points on the face between (low) and (high), `points` a side; turned about a vertical axis."""
    xs = numpy.linspace(low[0], high[0], points)
    ys = numpy.linspace(low[1], high[1], points) if dimension == 3 else [0.0]
    c, s = numpy.cos(turn), numpy.sin(turn)
    for x in xs:
        for y in ys:
            dx, dy = x - about[0], y - about[1]
            if dimension == 3:
                yield numpy.array([about[0] + c * dx - s * dy, about[1] + s * dx + c * dy, height])
            else:
                yield numpy.array([x, height, 0.0])


def tower(random, blocks, points, dimension=3, ratio=1.0):
    """Cubes one on another, each moved and turned a little; masses grow by `ratio` from the lowest to the highest."""
    up = numpy.array([0.0, 0.0, 1.0]) if dimension == 3 else numpy.array([0.0, 1.0, 0.0])
    masses = ratio ** (numpy.arange(blocks) / max(blocks - 1, 1))
    centres, contacts, shift = [], [], numpy.zeros(2)
    for k in range(blocks):
        shift = shift + (0.05 * random.uniform(-1.0, 1.0, 2) if k > 0 else 0.0)
        centre = up * (k + 0.5) + (numpy.array([*shift, 0.0]) if dimension == 3 else numpy.array([shift[0], 0.0, 0.0]))
        centres.append(centre)
        for point in face(dimension, points, shift - 0.5, shift + 0.5, float(k), random.uniform(-0.1, 0.1) if k > 0 else 0.0, shift):
            contacts.append((k - 1, k, point, up))
    return cubes(dimension, centres, masses, contacts)


def wall(random, width, courses, points, dimension=3, ratio=1.0):
    """Running bond of cubes: `width` in the first course, one less in every second; masses grow from course to course."""
    up = numpy.array([0.0, 0.0, 1.0]) if dimension == 3 else numpy.array([0.0, 1.0, 0.0])
    centres, masses, contacts, before = [], [], [], []
    for course in range(courses):
        half = course % 2
        now = []
        for j in range(width - half):
            x, body = j + 0.5 * half, len(centres)
            centres.append(up * (course + 0.5) + numpy.array([x, 0.0, 0.0]))
            masses.append(ratio ** (course / max(courses - 1, 1)))
            now.append((x, body))
            for x_below, below in before if course > 0 else [(x, GROUND)]:
                if abs(x - x_below) > 0.9:
                    continue
                low, high = max(x, x_below) - 0.5, min(x, x_below) + 0.5
                contacts += [(below, body, point, up)
                             for point in face(dimension, points, (low, -0.5), (high, 0.5), float(course))]
        before = now
    return cubes(dimension, centres, masses, contacts)


def pile(random, bodies, points=1, ratio=1.0):
    """Spheres of diameter 1 near the places of a random dense heap; contact where two are closer than 1.25. With 4 points a contact: at the
    corners of a square of side 0.35 between them, so that turning is resisted too."""
    width = max(2.0, (0.9 * bodies) ** (1.0 / 3.0))
    centres = numpy.empty((bodies, 3))
    for b in range(bodies):                       # dropped: as low as those below allow
        below, best = centres[:b], None
        for _ in range(12):
            x, y = random.uniform(0.0, width, 2)
            d2 = (x - below[:, 0]) ** 2 + (y - below[:, 1]) ** 2
            near = d2 < 1.0
            z = (below[near, 2] + numpy.sqrt(1.0 - d2[near])).max(initial=0.5)
            if best is None or z < best[2]:
                best = numpy.array([x, y, z])
        centres[b] = best
    masses = ratio ** random.uniform(0.0, 1.0, bodies)
    contacts = []
    for b in range(bodies):
        near = [(GROUND, centres[b] * [1, 1, 0], numpy.array([0.0, 0.0, 1.0]))] if centres[b][2] < 0.6 else []
        for a in numpy.flatnonzero(((centres[:b] - centres[b]) ** 2).sum(axis=1) < 1.6):
            apart = centres[b] - centres[a]
            distance = numpy.linalg.norm(apart)
            if distance < 1.25:
                near.append((a, 0.5 * (centres[a] + centres[b]), apart / distance))
        for below, point, normal in near:
            if points == 1 or below == GROUND:
                contacts.append((below, b, point, normal))
                continue
            t1, t2 = tangents(normal)
            contacts += [(below, b, point + 0.175 * (s * t1 + t * t2), normal) for s in (-1, 1) for t in (-1, 1)]
    return Stack(3, centres, masses, 0.1 * masses, contacts)


def stacks(names=()):
    """(name, dimension, W, q, mu): 34 problems, always the same; of `names` only, if there are any."""
    wanted = []
    for blocks, points, mu, ratio in ((14, 3, 0.1, 1), (20, 3, 0.4, 1), (20, 3, 0.8, 1), (30, 3, 0.6, 1), (50, 3, 0.3, 1), (100, 3, 0.5, 1),
                                      (40, 4, 1.5, 1), (20, 3, 0.5, 1000), (60, 2, 0.4, 30), (10, 5, 0.2, 100)):
        wanted.append((f"tower{blocks}_m{points}_mu{mu}" + (f"_ratio{ratio}" if ratio > 1 else ""), mu, 0.05,
                       lambda random, b=blocks, p=points, r=ratio: tower(random, b, p, 3, r)))
    for blocks, mu, ratio in ((75, 0.5, 1), (100, 0.3, 100)):
        wanted.append((f"plane_tower{blocks}_mu{mu}" + (f"_ratio{ratio}" if ratio > 1 else ""), mu, 0.05,
                       lambda random, b=blocks, r=ratio: tower(random, b, 2, 2, r)))
    for width, courses, points, mu, ratio in ((5, 6, 3, 0.4, 1), (5, 6, 3, 0.8, 1000), (5, 6, 3, 0.1, 1000), (8, 8, 3, 0.6, 1), (8, 8, 3, 0.3, 100),
                                              (10, 10, 3, 1.0, 1), (12, 12, 3, 0.5, 1), (10, 10, 3, 0.7, 1000), (6, 10, 4, 1.5, 1)):
        wanted.append((f"wall{width}x{courses}_m{points}_mu{mu}" + (f"_ratio{ratio}" if ratio > 1 else ""), mu, 0.05,
                       lambda random, w=width, c=courses, p=points, r=ratio: wall(random, w, c, p, 3, r)))
    for width, courses, mu, ratio in ((8, 10, 0.4, 1), (12, 16, 0.7, 1), (10, 12, 0.5, 1000)):
        wanted.append((f"plane_wall{width}x{courses}_mu{mu}" + (f"_ratio{ratio}" if ratio > 1 else ""), mu, 0.05,
                       lambda random, w=width, c=courses, r=ratio: wall(random, w, c, 2, 2, r)))
    for bodies, points, mu, ratio in ((50, 1, 0.3, 1), (150, 1, 0.4, 1), (150, 1, 1.0, 1000), (300, 1, 0.2, 1), (500, 1, 0.6, 1),
                                      (30, 4, 0.5, 1), (60, 4, 0.4, 1), (60, 4, 1.2, 1), (100, 4, 0.8, 100), (150, 4, 0.3, 1)):
        wanted.append((f"pile{bodies}" + (f"x{points}" if points > 1 else "") + f"_mu{mu}" + (f"_ratio{ratio}" if ratio > 1 else ""), mu, 0.2,
                       lambda random, b=bodies, p=points, r=ratio: pile(random, b, p, r)))
    yield from made(wanted, 1000, names)


def large(names=()):
    """The same kinds with about ten times as many contacts."""
    wanted = []
    for bodies, points, mu, ratio in ((1500, 1, 0.6, 1), (5000, 1, 0.4, 1), (1500, 1, 1.0, 1000), (1500, 4, 0.3, 1), (600, 4, 1.2, 1)):
        wanted.append((f"pile{bodies}" + (f"x{points}" if points > 1 else "") + f"_mu{mu}" + (f"_ratio{ratio}" if ratio > 1 else ""), mu, 0.2,
                       lambda random, b=bodies, p=points, r=ratio: pile(random, b, p, r)))
    for width, points, mu, ratio in ((30, 2, 0.5, 1), (30, 3, 0.6, 1), (30, 2, 0.7, 100)):
        wanted.append((f"wall{width}x{width}_m{points}_mu{mu}" + (f"_ratio{ratio}" if ratio > 1 else ""), mu, 0.05,
                       lambda random, w=width, p=points, r=ratio: wall(random, w, w, p, 3, r)))
    for blocks, points, mu in ((1000, 2, 0.5), (1000, 3, 0.3)):
        wanted.append((f"tower{blocks}_m{points}_mu{mu}", mu, 0.05, lambda random, b=blocks, p=points: tower(random, b, p)))
    yield from made(wanted, 2000, names)


def made(wanted, first_seed, names):
    for seed, (name, mu, speed, make) in enumerate(wanted):
        if names and name not in names:
            continue
        random = numpy.random.default_rng(first_seed + seed)
        stack = make(random)
        yield (name, stack.dimension, *problem(stack, mu, random, speed))


def write(file, dimension, W, q, mu):
    with h5py.File(file, "w") as out:
        local = out.create_group("fclib_local")
        local["spacedim"] = numpy.int32(dimension)
        matrix = local.create_group("W")
        for key, value in (("m", W.shape[0]), ("n", W.shape[1]), ("nz", -1), ("nzmax", W.nnz)):
            matrix[key] = numpy.int32(value)
        matrix["p"], matrix["i"], matrix["x"] = W.indptr.astype(numpy.int32), W.indices.astype(numpy.int32), W.data
        local["vectors/q"], local["vectors/mu"] = q, mu


def write_all(folder, some=stacks):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for name, dimension, W, q, mu in some():
        write(folder / f"{name}.hdf5", dimension, W, q, mu)
        files.append(folder / f"{name}.hdf5")
    return files


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--large"]):
        sys.exit(__doc__)
    write_all(sys.argv[1], large if sys.argv[2:] else stacks)
