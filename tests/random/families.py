"""Families of bodies that touch: each function makes a `Scene` of three to six bodies, about a metre in size."""
import math

from dice import short
from geometry import area, centroid, clip
from scene import Scene, arc, line, polygon, rectangle


def stack(dice):
    """Blocks on top of each other; their joints are level, or planes that are a little inclined."""
    count, floor = dice.whole(2, 5), dice.choice([0.3, 0.5])
    shapes = {"floor": rectangle(-2, -floor, 4, floor)}
    level, equal = dice.chance(0.6), dice.chance(0.5)
    width, middle = dice.number(0.6, 1.6), 0.0
    height, below = 0.0, lambda x: 0.0
    for i in range(count):
        if not equal and i > 0:
            middle += short(dice.uniform(-0.25, 0.25) * width)
            width = dice.number(0.6, 1.6)
        low, high = short(middle - width / 2, 4), short(middle + width / 2, 4)
        thick, slope = dice.choice([0.3, 0.4, 0.5, 0.75, 1.0]), 0.0 if level or i == count - 1 else dice.number(-0.12, 0.12)
        height = below(middle) + thick
        above = (lambda h, m, s: lambda x: h + s * (x - m))(height, middle, slope)
        if level:
            shapes[f"b{i + 1}"] = rectangle(low, below(middle), short(high - low, 6), thick)
        else:
            shapes[f"b{i + 1}"] = polygon([(low, below(low)), (high, below(high)), (high, above(high)), (low, above(low))])
        below = above
    left, right, top = ("left", "right", "top") if level else ("edge_4", "edge_2", "edge_3")
    side = [f"b{i + 1}.{edge}" for i in range(count) for edge in (left, right)]
    return Scene("stack", shapes, {"floor": ["bottom"]}, [f"b{count}.{top}"], side)


def wall(dice):
    """Courses of blocks, also with an opening under a lintel."""
    rows = dice.choice([[2, 1], [1, 2], [2, 2], [3, 2], [2, 3], [1, 2, 1], [2, 1, 2], [1, 1, 2], [-2, 1], [-2, 1, 1], [-2, 1, 2]])
    width, y = dice.number(1.6, 3), 0.0
    shapes = {"floor": rectangle(-0.5, -0.4, width + 1, 0.4)}
    top, side = [], []
    for number, blocks in enumerate(rows):
        height, count = dice.choice([0.3, 0.4, 0.6, 0.8]), abs(blocks)
        cuts = [0.0] + [short(width * (i + dice.uniform(-0.2, 0.2)) / count) for i in range(1, count)] + [width]
        spans = list(zip(cuts, cuts[1:]))
        if blocks < 0:  # two columns with an opening between them
            part = short(width * dice.uniform(0.2, 0.4))
            spans = [(0.0, part), (short(width - part, 6), width)]
        for i, (low, high) in enumerate(spans):
            name = f"b{number + 1}{i + 1}"
            shapes[name] = rectangle(low, y, short(high - low, 6), height)
            side += [f"{name}.left"] * (low == 0) + [f"{name}.right"] * (high == width)
            top += [f"{name}.top"] * (number == len(rows) - 1)
        y = short(y + height, 6)
    return Scene("wall", shapes, {"floor": ["bottom"]}, top, side)


def pieces(dice):
    """A rectangle that straight cuts divide into convex pieces; it is held below and loaded around."""
    width, height = dice.choice([1.6, 2.0, 2.4]), dice.choice([1.0, 1.2, 1.6])
    count = dice.whole(3, 6)
    parts = [[(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]]
    if dice.chance(0.25):  # two cuts cross: all four pieces meet in a point
        point, turn = (dice.number(0.4, 0.6) * width, dice.number(0.4, 0.6) * height), dice.uniform(0, math.pi / 2)
        for angle in (turn, turn + dice.uniform(1.0, 2.0)):
            normal = math.cos(angle), math.sin(angle)
            parts = [half for part in parts for half in halves(part, normal, point)]
    for _ in range(200):
        if len(parts) >= count:
            break
        part = max(parts, key=area)
        angle, middle = dice.uniform(0, math.pi), centroid(part)
        point = tuple(c + dice.uniform(-0.1, 0.1) * width for c in middle)
        cut = halves(part, (math.cos(angle), math.sin(angle)), point)
        if all(shortest(half) > 0.15 * height and area(half) > 0.05 * width * height for half in cut):
            parts.remove(part)
            parts += cut
    shapes = {f"b{i + 1}": polygon(part) for i, part in enumerate(parts)}
    fixed, top, side = {}, [], []
    for body, part in zip(shapes, parts):
        for i, p in enumerate(part):
            q, place = part[(i + 1) % len(part)], f"{body}.edge_{i + 1}"
            if abs(p[1]) + abs(q[1]) < 1e-9:
                fixed[body] = [f"edge_{i + 1}"]
            elif abs(p[1] - height) + abs(q[1] - height) < 1e-9:
                top.append(place)
            elif abs(p[0]) + abs(q[0]) < 1e-9 or abs(p[0] - width) + abs(q[0] - width) < 1e-9:
                side.append(place)
    return Scene("pieces", shapes, fixed, top, side, clamped=True)


def halves(part, normal, point):
    offset = normal[0] * point[0] + normal[1] * point[1]
    return [half for half in (clip(part, normal, offset), clip(part, tuple(-n for n in normal), -offset)) if len(half) > 2]


def shortest(part):
    return min(math.dist(p, q) for p, q in zip(part, part[1:] + part[:1]))


def pin(dice):
    """A pin between two halves of a plate that have half of its bore each, and a block on top."""
    radius, width, height = dice.number(0.2, 0.5), dice.number(1.4, 2.4), dice.number(0.7, 1.2)
    plates = {"lower": {"outline": [line((width / 2, -height), "bottom"), line((width / 2, 0), "right"),
                                    line((radius, 0), "joint_right"), arc((-radius, 0), (0, 0), "groove", True),
                                    line((-width / 2, 0), "joint_left"), line((-width / 2, -height), "left")]},
              "upper": {"outline": [line((width / 2, height), "right"), line((-width / 2, height), "top"),
                                    line((-width / 2, 0), "left"), line((-radius, 0), "joint_left"),
                                    arc((radius, 0), (0, 0), "groove", True), line((width / 2, 0), "joint_right")]}}
    gap = 0.0 if dice.chance(0.7) else short(radius * 10 ** dice.uniform(-4, -2.5))
    r = radius - gap
    plates["pin"] = {"outline": [arc((-r, 0), (0, 0), "above"), arc((r, 0), (0, 0), "below")]}
    gaps = {("lower.groove", "pin.below"): gap, ("upper.groove", "pin.above"): gap} if gap else {}
    top = "upper.top"
    if dice.chance(0.5):
        plates["cap"] = rectangle(short(-width * 0.3), height, short(width * 0.6), 0.3)
        top = "cap.top"
    return Scene("pin", plates, {"lower": ["bottom"]}, [top], ["upper.left", "upper.right", "lower.right"], gaps=gaps, fits=True)


def groove(dice):
    """A block, or a disc, in a groove of a base that stands on a floor or is held; perhaps a block on top."""
    half, depth, width, height = dice.number(0.3, 0.6), dice.number(0.2, 0.5), dice.number(1.6, 2.4), dice.number(0.8, 1.2)
    bottom, opening = (0.0, height - depth), half
    base = [(-width / 2, 0), (width / 2, 0), (width / 2, height), (half, height), bottom, (-half, height), (-width / 2, height)]
    shapes = {"base": polygon(base)}
    names = {1: "bottom", 2: "right", 3: "top_right", 4: "groove_right", 5: "groove_left", 6: "top_left", 7: "left"}
    shapes["base"]["polygon"]["names"] = {name: f"edge_{i}" for i, name in names.items()}
    side, rise = ["base.edge_2", "base.edge_7"], dice.number(0.3, 0.6)
    if dice.chance(0.5):
        wedge = [bottom, (half, height), (half, height + rise), (-half, height + rise), (-half, height)]
        shapes["wedge"] = polygon(wedge)
        above, top = height + rise, "wedge.edge_3"
        side += ["wedge.edge_2", "wedge.edge_4"]
    else:  # it touches the middles of both sides of the groove
        long = math.hypot(half, depth)
        radius = short(0.5 * long * half / depth)
        middle = height - depth + radius * long / half
        cut = dice.number(0.5, 0.9) * radius
        end = math.sqrt(radius**2 - cut**2)
        shapes["disc"] = {"outline": [arc((end, middle + cut), (0, middle), "right"), line((-end, middle + cut), "top"),
                                      arc((0, middle - radius), (0, middle), "left")]}
        above, top = middle + cut, "disc.top"
        half = end
    if dice.chance(0.7):
        shapes["cap"] = rectangle(short(-0.8 * half), above, short(1.6 * half), 0.4)
        top, side = "cap.top", side + ["cap.left", "cap.right"]
    fixed = {"base": ["edge_1"]}
    if dice.chance(0.6) or len(shapes) < 3:
        shapes["floor"], fixed = rectangle(-2, -0.4, 4, 0.4), {"floor": ["bottom"]}
    scene = Scene("groove", shapes, fixed, [top], side)
    if "disc" in shapes:
        scene.gaps = {("base.edge_4", "disc.right"): 0.0, ("base.edge_5", "disc.left"): 0.0}
        scene.points, scene.radius = [(sign * opening / 2, height - depth / 2) for sign in (-1, 1)], radius
    return scene


def wedge(dice):
    """A wedge between two blocks that walls hold; it may stand on a block below, or have one above."""
    half, height, lean = dice.number(0.3, 0.6), dice.number(0.8, 1.4), dice.number(0.05, 0.3)
    thin, width = half - lean * height / 2, dice.number(0.5, 1.0)
    thin = max(thin, 0.1)
    shapes = {"wedge": polygon([(-thin, 0), (thin, 0), (half, height), (-half, height)]),
              "right": polygon([(thin, 0), (half + width, 0), (half + width, height), (half, height)]),
              "left": polygon([(-half - width, 0), (-thin, 0), (-half, height), (-half - width, height)])}
    fixed = {"right": ["edge_2"], "left": ["edge_4"]}
    if dice.chance(0.6):
        shapes["wall_right"] = rectangle(half + width, -0.2, 0.4, height + 0.4)
        shapes["wall_left"] = rectangle(-half - width - 0.4, -0.2, 0.4, height + 0.4)
        fixed = {"wall_right": ["right"], "wall_left": ["left"]}
    if dice.chance(0.5):  # walls do not reach down to it
        shapes["floor"], fixed["floor"] = rectangle(-2.5, -0.2, 5, 0.2), ["bottom"]
        for name in ("wall_right", "wall_left"):
            if name in shapes:
                shapes[name]["rectangle"].update(corner=[shapes[name]["rectangle"]["corner"][0], 0.05], size=[0.4, height])
    top = "wedge.edge_3"
    if len(shapes) < 6 and dice.chance(0.4):
        shapes["cap"], top = rectangle(short(-0.8 * half), height, short(1.6 * half), 0.3), "cap.top"
    return Scene("wedge", shapes, fixed, [top], ["right.edge_3", "left.edge_3"])


def vice(dice):
    """A row of blocks that two jaws press together; only friction holds the blocks across."""
    count, x = dice.whole(1, 4), 0.0
    height = dice.number(0.5, 1.0)
    shapes = {"anvil": rectangle(-0.4, -0.3, 0.4, short(height + 0.6))}
    for i in range(count):
        width = dice.choice([0.3, 0.5, 0.8, 1.0])
        low = 0.0 if dice.chance(0.6) else dice.number(-0.15, 0.15)
        shapes[f"b{i + 1}"] = rectangle(x, low, width, height)
        x = short(x + width, 6)
    shapes["jaw"] = rectangle(x, -0.3, 0.4, short(height + 0.6))
    side = [f"b{i + 1}.{edge}" for i in range(count) for edge in ("top", "bottom")]
    gravity = (0.0, -1.0) if dice.chance(0.4) else None
    return Scene("vice", shapes, {"anvil": ["left"]}, ["jaw.right"], side, gravity=gravity)


def arch(dice):
    """Voussoirs, curved or straight; the first and the last one stand on blocks, or are held."""
    count, inner, thick = dice.whole(3, 5), dice.number(0.8, 1.2), dice.number(0.25, 0.6)
    low = dice.number(0.0, 0.5)
    outer, curved = short(inner + thick, 6), dice.chance(0.6)
    angles = [low + (math.pi - 2 * low) * (i + (dice.uniform(-0.1, 0.1) if 0 < i < count else 0)) / count for i in range(count + 1)]
    at = lambda radius, angle: (radius * math.cos(angle), radius * math.sin(angle))
    shapes = {}
    for i, (a, b) in enumerate(zip(angles, angles[1:])):
        corners = [at(inner, a), at(outer, a), at(outer, b), at(inner, b)]
        if curved:
            shapes[f"v{i + 1}"] = {"outline": [line(corners[1], "near"), arc(corners[2], (0, 0), "back"), line(corners[3], "far"),
                                               arc(corners[0], (0, 0), "face", True)]}
        else:
            shapes[f"v{i + 1}"] = polygon(corners)
    near, back, far = ("near", "back", "far") if curved else ("edge_1", "edge_2", "edge_3")
    fixed = {"v1": [near], f"v{count}": [far]}
    if count < 5 and dice.chance(0.6):  # a quadrilateral below each springer, level at its foot
        a, b = at(inner, low), at(outer, low)
        foot = a[1] - 0.4
        right = [(a[0] - 0.1, foot), (b[0] + 0.1, foot), b, a]
        shapes["right"] = polygon(right)
        shapes["left"] = polygon([(-x, y) for x, y in reversed(right)])
        fixed = {"right": ["edge_1"], "left": ["edge_3"]}
    top = [f"v{i + 1}.{back}" for i in range(count)]
    return Scene("arch", shapes, fixed, top, [f"v{i + 1}.{back}" for i in (0, count - 1)], clamped=True)


def rings(dice):
    """A quarter of rings one in the other, with lines of symmetry; an interference, or pressure from outside."""
    count = dice.whole(3, 4)
    radii, shapes = [0.0 if dice.chance(0.3) else dice.number(0.2, 0.5)], {}
    for i in range(count):
        radii.append(short(radii[-1] + dice.number(0.2, 0.5), 4))
        a, b = radii[-2:]
        if a == 0:
            shapes["r1"] = {"outline": [line((b, 0), "low"), arc((0, b), (0, 0), "outside"), line((0, 0), "high")]}
        else:
            shapes[f"r{i + 1}"] = {"outline": [line((b, 0), "low"), arc((0, b), (0, 0), "outside"), line((0, a), "high"),
                                               arc((a, 0), (0, 0), "inside", True)]}
    side = ["r1.inside"] if radii[0] > 0 else []
    return Scene("rings", shapes, {}, [f"r{count}.outside"], side, gravity=None, symmetric=[{"x": 0}, {"y": 0}], fits=True)


def beams(dice):
    """Beams on top of each other that a wall holds at their left ends, loaded at the other ends."""
    count, y, shapes = dice.whole(3, 5), 0.0, {}
    length = dice.number(2, 3)
    for i in range(count):
        height = dice.choice([0.3, 0.4, 0.5, 0.75])
        shapes[f"b{i + 1}"] = rectangle(0.0, y, length if dice.chance(0.7) else short(length * dice.uniform(0.6, 1)), height)
        y = short(y + height, 6)
    fixed = {body: ["left"] for body in shapes}
    return Scene("beams", shapes, fixed, [f"b{count}.top"], [f"{body}.right" for body in shapes], clamped=True)


def rollers(dice):
    """Discs, or rounded blocks, between a floor and a plate."""
    radius, count = dice.number(0.3, 0.5), dice.whole(1, 3)
    cut = radius if dice.chance(0.3) else short(radius * dice.uniform(0.6, 0.95))
    apart = short(2.2 * radius + dice.uniform(0, 0.3))
    shapes = {"floor": rectangle(-1, -0.4, short(apart * count + 1.5), 0.4)}
    gaps, points = {}, []
    for i in range(count):
        x, name = short(i * apart, 6), f"d{i + 1}"
        gaps[("floor.top", f"{name}.below")] = 0.0
        points.append((x, 0.0))
        if cut == radius:
            shapes[name] = {"outline": [arc((x - radius, radius), (x, radius), "above"), arc((x + radius, radius), (x, radius), "below")]}
            gaps[("plate.bottom", f"{name}.above")] = 0.0
            points.append((x, 2 * radius))
        else:  # flat on top, round below
            end = math.sqrt(radius**2 - cut**2)
            shapes[name] = {"outline": [line((x - end, radius + cut), "above"), arc((x + end, radius + cut), (x, radius), "below")]}
    shapes["plate"] = rectangle(short(-0.9 * radius), short(radius + cut, 6), short(apart * (count - 1) + 1.8 * radius, 6), 0.3)
    side = ["plate.left", "plate.right"]
    return Scene("rollers", shapes, {"floor": ["bottom"]}, ["plate.top"], side, gaps=gaps, points=points, radius=radius)


FAMILIES = {stack: 3, wall: 3, pieces: 3, pin: 1.5, groove: 1.5, wedge: 1.5, vice: 2, arch: 2, rings: 1.2, beams: 1.2, rollers: 0.8}
