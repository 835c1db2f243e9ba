"""Models of block towers and walls, and what statics says of them. Lengths in m, forces in N.

A tower is a stack of blocks 1 x 1; a wall has courses of blocks 1 x 0.5 in running bond, with half blocks at the ends of every
second course. Both stand on a rigid floor under their own weight, and a uniform pressure pushes their left side.

Collapse of the whole (width B, height H, weight rho g per volume), for a push q per area:

    the first course slides     q H = mu rho g B H      q = mu rho g B       (every joint slides at the same q)
    it turns about its toe      q H^2 / 2 = rho g B H B / 2      q = rho g B^2 / H
"""
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


def collapse_load(columns, courses, friction):
    """Push (Pa) at which the whole slides or turns, whichever comes first."""
    width, height = float(columns), courses * height_of(columns)
    weight = DENSITY * GRAVITY
    return min(friction * weight * width, weight * width**2 / height)


def model(columns, courses, friction, push, increments=1):
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
        loads.append(f"  push_{z}: {{on: b{z}_0.left, traction: [{push!r}, 0]}}")
    pushes = ", ".join(f"push_{z}: 1" for z in range(courses))
    return "\n".join([
        "scabo: 1", f"title: {columns} x {courses} blocks",
        "materials: {stone: {young: 5e9, poisson: 0.2, density: 2000}}", "bodies:", *bodies,
        "supports: [{on: floor, fix: [x, y]}]", "loads:", f"  weight: {{gravity: [0, {-GRAVITY}]}}", *loads, "contacts:",
        *(f"  c{i}: {{between: [{a}, {b}], friction: {friction}}}" for i, (a, b) in enumerate(contacts)), "steps:",
        *([f"  - {{name: push, loads: {{weight: 1, {pushes}}}}}"] if increments == 1 else
          ["  - {name: weight, loads: {weight: 1}}",
           f"  - {{name: push, increments: {increments}, loads: {{weight: 1, {pushes}}}}}"]), ""])
