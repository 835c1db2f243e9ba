"""Edges of the shapes of model files, and which of them touch. Bodies lie to the left of their edges."""
import dataclasses
import math

CORNERS = {"bottom": "bottom_left", "right": "bottom_right", "top": "top_right", "left": "top_left"}  # where edges begin


@dataclasses.dataclass(frozen=True)
class Edge:
    start: tuple
    end: tuple
    centre: tuple = None   # of an arc
    turn: int = 1          # of an arc: +1 counter-clockwise, -1 clockwise

    @property
    def straight(self):
        return self.centre is None

    @property
    def radius(self):
        return math.dist(self.start, self.centre)

    @property
    def angle(self):
        """Of an arc, positive."""
        first, last = (math.atan2(p[1] - self.centre[1], p[0] - self.centre[0]) for p in (self.start, self.end))
        angle = (self.turn * (last - first)) % (2 * math.pi)
        return angle if angle > 1e-9 else 2 * math.pi

    @property
    def length(self):
        return math.dist(self.start, self.end) if self.straight else self.radius * self.angle

    @property
    def tangent(self):
        """Of a straight edge; the outward normal is the tangent turned by -90 degrees."""
        return tuple((b - a) / self.length for a, b in zip(self.start, self.end))

    @property
    def normal(self):
        return self.tangent[1], -self.tangent[0]

    def at(self, part):
        """Point of a straight edge."""
        return tuple(a + part * (b - a) for a, b in zip(self.start, self.end))


def rectangle_corners(shape):
    (x, y), (width, height) = shape["corner"], shape["size"]
    return [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]


def edges(shape):
    """The edges of a shape by name, of a rectangle, a polygon or an outline that go round counter-clockwise."""
    if "rectangle" in shape:
        points, names = rectangle_corners(shape["rectangle"]), list(CORNERS)
        return {name: Edge(points[i], points[(i + 1) % 4]) for i, name in enumerate(names)}
    if "polygon" in shape:
        points = [tuple(p) for p in shape["polygon"]["vertices"]]
        return {f"edge_{i + 1}": Edge(p, points[(i + 1) % len(points)]) for i, p in enumerate(points)}
    pieces, found = shape["outline"], {}
    start = tuple(ends(pieces[-1])["to"])
    for i, piece in enumerate(pieces):
        end = tuple(ends(piece)["to"])
        if "arc" in piece:
            arc = piece["arc"]
            turn = -1 if arc.get("direction") == "clockwise" else 1
            edge = Edge(start, end, tuple(arc["centre"]), turn)
        else:
            edge = Edge(start, end)
        found[piece.get("name", f"edge_{i + 1}")] = edge
        start = end
    return found


def edge_of(shape, name):
    """An edge by any of its names."""
    names = shape.get("polygon", shape).get("names", {})
    return edges(shape)[names.get(name, name)]


def ends(piece):
    return piece["line"] if "line" in piece else piece["arc"]


def extent(shape):
    """The low and the high corner of a box around the ends of all edges."""
    points = [edge.start for edge in edges(shape).values()]
    return tuple(min(p[k] for p in points) for k in (0, 1)), tuple(max(p[k] for p in points) for k in (0, 1))


def size(shape):
    """Square root of the area of that box: half of an arc that bulges out of it does not matter here."""
    low, high = extent(shape)
    return math.sqrt((high[0] - low[0]) * (high[1] - low[1]))


def overlap(one, other):
    """Length along which two edges of different bodies lie on each other."""
    if one.straight != other.straight:
        return 0.0
    if one.straight:
        t = one.tangent
        if abs(t[0] * other.tangent[1] - t[1] * other.tangent[0]) > 1e-9 or t[0] * other.tangent[0] + t[1] * other.tangent[1] > 0:
            return 0.0
        along, across = [], []
        for p in (other.start, other.end):
            d = p[0] - one.start[0], p[1] - one.start[1]
            along.append(d[0] * t[0] + d[1] * t[1])
            across.append(abs(d[0] * t[1] - d[1] * t[0]))
        if max(across) > 1e-9 * (1 + one.length):
            return 0.0
        return max(0.0, min(one.length, max(along)) - max(0.0, min(along)))
    same = math.dist(one.centre, other.centre) < 1e-9 and abs(one.radius - other.radius) < 1e-9 and one.turn != other.turn
    return one.radius * min(one.angle, other.angle) if same and facing(one, other) else 0.0


def facing(one, other):
    """Whether two arcs of one circle have a part in common: the middle of the shorter one is on the other."""
    short, long = sorted((one, other), key=lambda edge: edge.angle)
    first = math.atan2(short.start[1] - short.centre[1], short.start[0] - short.centre[0])
    middle = first + short.turn * short.angle / 2
    begin = math.atan2(long.start[1] - long.centre[1], long.start[0] - long.centre[0])
    return (long.turn * (middle - begin)) % (2 * math.pi) < long.angle


def touches(shape, point):
    """Whether a point is on an edge."""
    for edge in edges(shape).values():
        if edge.straight:
            along = sum((p - a) * t for p, a, t in zip(point, edge.start, edge.tangent))
            if 0 <= along <= edge.length and math.dist(edge.at(along / edge.length), point) < 1e-3:
                return True
        elif abs(math.dist(edge.centre, point) - edge.radius) < 1e-3:
            return True
    return False


def touching(shapes):
    """All pairs of places, `body.edge`, of different bodies that lie on each other."""
    all_edges = [(body, name, edge) for body, shape in shapes.items() for name, edge in edges(shape).items()]
    found = []
    for i, (body, name, edge) in enumerate(all_edges):
        for other_body, other_name, other in all_edges[i + 1:]:
            shorter = min(edge.length, other.length)
            if other_body != body and overlap(edge, other) > 0.01 * shorter:
                found.append((f"{body}.{name}", f"{other_body}.{other_name}"))
    return found


def clip(polygon, normal, offset):
    """The part of a convex polygon where normal . x <= offset."""
    kept = []
    for i, p in enumerate(polygon):
        q = polygon[(i + 1) % len(polygon)]
        a, b = (normal[0] * r[0] + normal[1] * r[1] - offset for r in (p, q))
        if a <= 0:
            kept.append(p)
        if a * b < 0:
            kept.append(tuple(s + a / (a - b) * (e - s) for s, e in zip(p, q)))
    return kept


def centroid(polygon):
    area = x = y = 0.0
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        cross = p[0] * q[1] - p[1] * q[0]
        area, x, y = area + cross, x + (p[0] + q[0]) * cross, y + (p[1] + q[1]) * cross
    return x / (3 * area), y / (3 * area)


def area(polygon):
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(polygon, polygon[1:] + polygon[:1])) / 2
