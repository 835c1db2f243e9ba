"""Models of block towers and walls, and what statics says of them. Lengths in m, forces in N.

A tower is a stack of blocks 1 x 1; a wall has courses of blocks 1 x 0.5 in running bond, with half blocks at the ends of every
second course. Both stand on a rigid floor under their own weight, and a uniform pressure pushes their left side.

Collapse of the whole (width B, height H, weight rho g per volume), for a push q per area:

    the first course slides     q H = mu rho g B H      q = mu rho g B       (every joint slides at the same q)
    it turns about its toe      q H^2 / 2 = rho g B H B / 2      q = rho g B^2 / H

A wall of separate blocks may fall before: parts of it turn, along steps in its bond. Limit analysis takes all of that into
account, see limit_load.

Instead of the push, every block may be accelerated along the wall ("shaken"), as by an earthquake: by a per weight, a in g,

    the first course slides     a = mu         it turns about its toe      a = B / H
"""
import functools
import sys

DENSITY, GRAVITY = 2000.0, 9.81


def courses_of(columns, courses, height):
    """Spans [(left, right), ...] of every course, from the ground up. One column: a tower."""
    whole = [(float(i), i + 1.0) for i in range(columns)]
    shifted = [(0.0, 0.5)] + [(i + 0.5, i + 1.5) for i in range(columns - 1)] + [(columns - 0.5, float(columns))]
    return [whole if columns == 1 or z % 2 == 0 else shifted for z in range(courses)]


def blocks(columns, courses):
    return sum(len(course) for course in courses_of(columns, courses, height_of(columns)))


def height_of(columns):
    return 1.0 if columns == 1 else 0.5


def collapse_load(columns, courses, friction, shaken=False):
    """Push (Pa), or acceleration (g), at which the whole slides or turns, whichever comes first."""
    width, height = float(columns), courses * height_of(columns)
    weight = DENSITY * GRAVITY
    if shaken:
        return min(friction, width / height)
    return min(friction * weight * width, weight * width**2 / height)


def model(columns, courses, friction, push, increments=1, shaken=False):
    """The model file as text. Weight first, in one increment, then the push in as many as asked for (1: both at once)."""
    height = height_of(columns)
    spans = courses_of(columns, courses, height)
    bodies, contacts, loads = [], [], []
    bodies.append(f"  floor: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [{columns + 2}, 1]}}}}}}")
    for z, course in enumerate(spans):
        for k, (left, right) in enumerate(course):
            bodies.append(f"  b{z}_{k}: {{material: stone, shape: {{rectangle: {{corner: [{left}, {z * height}], "
                          f"size: [{right - left}, {height}]}}}}, mesh: {{size: 0.25, order: 1}}}}")
            if k > 0:
                contacts.append((f"b{z}_{k - 1}.right", f"b{z}_{k}.left"))
            if z == 0:
                contacts.append(("floor.top", f"b{z}_{k}.bottom"))
            else:
                contacts += [(f"b{z - 1}_{j}.top", f"b{z}_{k}.bottom") for j, (a, b) in enumerate(spans[z - 1])
                             if min(b, right) - max(a, left) > 0.1]
        if not shaken:
            loads.append(f"  push_{z}: {{on: b{z}_0.left, traction: [{push!r}, 0]}}")
    if shaken:
        loads.append(f"  push_0: {{gravity: [{push * GRAVITY!r}, 0]}}")
    pushes = ", ".join(f"push_{z}: 1" for z in range(len(loads)))
    return "\n".join([
        "scabo: 1", f"title: {columns} x {courses} blocks",
        "materials: {stone: {young: 5e9, poisson: 0.2, density: 2000}}", "bodies:", *bodies,
        "supports: [{on: floor, fix: [x, y]}]", "loads:", f"  weight: {{gravity: [0, {-GRAVITY}]}}", *loads, "contacts:",
        *(f"  c{i}: {{between: [{a}, {b}], friction: {friction}}}" for i, (a, b) in enumerate(contacts)), "steps:",
        *([f"  - {{name: push, loads: {{weight: 1, {pushes}}}}}"] if increments == 1 else
          ["  - {name: weight, loads: {weight: 1}}",
           f"  - {{name: push, increments: {increments}, loads: {{weight: 1, {pushes}}}}}"]), ""])


@functools.lru_cache(None)
def limit_load(columns, courses, friction, shaken=False):
    """Largest push (Pa), or acceleration (g), for which forces within the friction cones balance every block: the static theorem of limit analysis
    as a linear programme (Livesley, Int. J. Numer. Methods Eng. 12 (1978) 1853). Above it nothing can stand; below it a wall
    whose joints slide without opening may still fall. Every joint carries forces at its two ends. Needs SciPy."""
    try:
        import numpy
        import scipy.optimize
        import scipy.sparse
    except ImportError as error:
        sys.exit(f"{error}: limit loads need NumPy and SciPy (Debian: python3-scipy, for /usr/bin/python3)")

    height = height_of(columns)
    spans = courses_of(columns, courses, height)
    number = {}
    for z, course in enumerate(spans):
        for k in range(len(course)):
            number[z, k] = len(number)
    middle = {number[z, k]: ((a + b) / 2, (z + 0.5) * height) for z, course in enumerate(spans) for k, (a, b) in enumerate(course)}
    entries, count = [], 0  # (equation, unknown, value); unknowns: normal and tangential force of each joint end

    def touch(below, above, x, y, normal):
        nonlocal count
        tangent = (-normal[1], normal[0])
        for body, sign in ((below, -1.0), (above, 1.0)):
            if body is None:
                continue
            arm = (x - middle[body][0], y - middle[body][1])
            for k, (f_x, f_y) in enumerate((normal, tangent)):
                for row, value in enumerate((f_x, f_y, arm[0] * f_y - arm[1] * f_x)):
                    entries.append((3 * body + row, 2 * count + k, sign * value))
        count += 1

    for z, course in enumerate(spans):
        for k, (a, b) in enumerate(course):
            if k > 0:
                for y in (z * height, (z + 1) * height):
                    touch(number[z, k - 1], number[z, k], a, y, (1.0, 0.0))
            if z == 0:
                for x in (a, b):
                    touch(None, number[z, k], x, 0.0, (0.0, 1.0))
                continue
            for j, (c, d) in enumerate(spans[z - 1]):
                if min(b, d) - max(a, c) > 0.1:
                    for x in (max(a, c), min(b, d)):
                        touch(number[z - 1, j], number[z, k], x, z * height, (0.0, 1.0))
    # In units in which a block weighs about 1 and the push for the whole to slide or turn is 1.
    weight, push = numpy.zeros(3 * len(number)), numpy.zeros(3 * len(number))
    unit = collapse_load(columns, courses, friction, shaken) / (1.0 if shaken else DENSITY * GRAVITY)
    for (z, k), body in number.items():
        a, b = spans[z][k]
        weight[3 * body + 1] = -(b - a)
        if shaken:
            push[3 * body] = unit * (b - a)
        elif k == 0:
            push[3 * body] = unit
    rows, columns_of, values = zip(*entries)
    balance = scipy.sparse.coo_matrix((values, (rows, columns_of)), shape=(len(weight), 2 * count))
    equal = scipy.sparse.hstack([balance, push[:, None]])
    ends = numpy.arange(count)
    cones = scipy.sparse.coo_matrix(
        (numpy.r_[numpy.ones(count), -numpy.ones(count), numpy.full(2 * count, -friction)],
         (numpy.r_[ends, ends + count, ends, ends + count],
          numpy.r_[2 * ends + 1, 2 * ends + 1, 2 * ends, 2 * ends])), shape=(2 * count, 2 * count + 1))
    objective = numpy.zeros(2 * count + 1)
    objective[-1] = -1.0
    bounds = [(0, None), (None, None)] * count + [(0, None)]
    found = scipy.optimize.linprog(objective, cones, numpy.zeros(2 * count), equal, -weight, bounds, method="highs-ipm")
    if found.status != 0:
        raise ArithmeticError(f"{columns} x {courses} blocks, friction {friction}: {found.message}")
    return -found.fun * collapse_load(columns, courses, friction, shaken)
