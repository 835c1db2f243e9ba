"""A contact as in Hertz's problem, for the three programs: a block whose bottom is round (radius 1,000 m) is moved on a rigid floor.

Half of the block, x from 0 (line of symmetry) to 1 m, height 1 m; plane strain, E = 210 GPa, nu = 0.3, without friction. Its top is moved
down by 80 um and cannot move sideways. About a third of the bottom comes into contact. The result is the force on the floor; the radius is large so that
programs which follow the deformed shape and programs which do not have the same answer.

`grid(n)` are n x n eight-node elements, smaller towards the contact, for GetFEM and CalculiX.
"""
import math

RADIUS, WIDTH, HEIGHT = 1000.0, 1.0, 1.0  # m
YOUNG, POISSON = 210e9, 0.3               # Pa, -
DOWN = 80e-6                              # m
CONTACT_END = 0.274                       # m, as any fine mesh shows


def bottom(x):
    return RADIUS - math.sqrt(RADIUS**2 - x * x)


def grid(n):
    """{(i, j): (x, y)} of the nodes, on a grid of half the element size, and the 8 places of every element: corners, then mid-sides."""
    part = lambda i: 0.5 * (i / (2 * n)) * (1.0 + (i / (2 * n)) ** 2)  # smallest elements half as large as equal ones
    nodes = {}
    for j in range(2 * n + 1):
        for i in range(2 * n + 1):
            if i % 2 and j % 2:
                continue
            # Mid-sides lie in the middle of their sides, on the arc at the bottom.
            s = part(i) if i % 2 == 0 else 0.5 * (part(i - 1) + part(i + 1))
            t = part(j) if j % 2 == 0 else 0.5 * (part(j - 1) + part(j + 1))
            x, below = WIDTH * s, bottom(WIDTH * s)
            nodes[i, j] = (x, below + (HEIGHT - below) * t)
    elements = [[(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2), (i + 1, j), (i + 2, j + 1), (i + 1, j + 2), (i, j + 1)]
                for j in range(0, 2 * n, 2) for i in range(0, 2 * n, 2)]
    return nodes, elements


def scabo_model(size, along, kind="superelement", order=2):
    """`size` of the elements, `along` of those of the round side and at the corner where the held top meets the free side, m; `kind` of mesh.
    One super-element is divided along its boundary, a quadtree inside too: its elements grow by half of the distance from both places.
    Of a `graded` quadtree those of the round side are small only where contact ends."""
    growth = "" if kind == "superelement" else ", growth: 0.5"
    place = "on: round" if kind != "graded" else f"near: [{CONTACT_END!r}, {bottom(CONTACT_END)!r}]"
    kind = "quadtree" if kind == "graded" else kind
    return f"""scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: {YOUNG!r}, poisson: {POISSON!r}}}}}
bodies:
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-0.5, -1], size: [2, 1]}}}}}}
  block:
    material: steel
    shape:
      outline:
        - {{line: {{from: [0, {HEIGHT!r}], to: [0, 0]}}, name: middle}}
        - {{arc: {{to: [{WIDTH!r}, {bottom(WIDTH)!r}], centre: [0, {RADIUS!r}]}}, name: round}}
        - {{line: {{to: [{WIDTH!r}, {HEIGHT!r}]}}, name: side}}
        - {{line: {{to: [0, {HEIGHT!r}]}}, name: top}}
    mesh: {{kind: {kind}, order: {order}, size: {size!r}, refine: [{{{place}, size: {along!r}{growth}}}, {{near: [{WIDTH!r}, {HEIGHT!r}], size: {along!r}{growth}}}]}}
supports:
  - {{on: floor, fix: [x, y]}}
  - {{on: block.middle, fix: [x]}}
  - {{on: block.top, displacement: [0, {-DOWN!r}]}}
contacts: {{joint: {{between: [floor.top, block.round]}}}}
"""


def calculix_deck(n, stiffness):
    """Penalty `stiffness` in Pa per m. The floor is one element, of which all nodes are fixed."""
    nodes, elements = grid(n)
    number = {place: k + 1 for k, place in enumerate(nodes)}
    lines = ["*HEADING", "Block with a round bottom on a floor; m, N, Pa", "*NODE"]
    lines += [f"{number[place]}, {x:.15g}, {y:.15g}" for place, (x, y) in nodes.items()]
    lines.append("*ELEMENT, TYPE=CPE8, ELSET=BLOCK")
    lines += [f"{e + 1}, " + ", ".join(str(number[place]) for place in places) for e, places in enumerate(elements)]
    first, element = len(nodes) + 1, len(elements) + 1
    floor = [(-0.2, -0.5), (1.2, -0.5), (1.2, 0.0), (-0.2, 0.0), (0.5, -0.5), (1.2, -0.25), (0.5, 0.0), (-0.2, -0.25)]
    lines += ["*NODE, NSET=FLOOR"] + [f"{first + k}, {x}, {y}" for k, (x, y) in enumerate(floor)]
    lines += ["*ELEMENT, TYPE=CPE8, ELSET=FLOOR", f"{element}, " + ", ".join(str(first + k) for k in range(8))]
    lines += ["*NSET, NSET=MIDDLE"] + [f"{number[place]}," for place in nodes if place[0] == 0]
    lines += ["*NSET, NSET=TOP"] + [f"{number[place]}," for place in nodes if place[1] == 2 * n]
    lines += ["*SURFACE, NAME=ROUND, TYPE=ELEMENT"] + [f"{e + 1}, S1" for e in range(n)]
    lines += ["*SURFACE, NAME=GROUND, TYPE=ELEMENT", f"{element}, S3"]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{YOUNG:g}, {POISSON:g}"]
    for name in ("BLOCK", "FLOOR"):
        lines += [f"*SOLID SECTION, ELSET={name}, MATERIAL=STEEL", "1.0"]
    lines += ["*BOUNDARY", "FLOOR, 1, 2", "MIDDLE, 1", "TOP, 1",
              "*SURFACE INTERACTION, NAME=FACE", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{stiffness:g}",
              "*CONTACT PAIR, INTERACTION=FACE, TYPE=SURFACE TO SURFACE", "ROUND, GROUND",
              "*STEP", "*STATIC", "1.0, 1.0", "*BOUNDARY", f"TOP, 2, 2, {-DOWN:g}",
              "*NODE PRINT, NSET=FLOOR, TOTALS=ONLY", "RF", "*NODE FILE", "U", "*EL FILE", "S", "*CONTACT FILE", "CDIS, CSTR", "*END STEP", ""]
    return "\n".join(lines)
