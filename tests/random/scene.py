"""What a random model is made from: bodies with their shapes, what holds them, and where loads may act."""
import dataclasses

import geometry


@dataclasses.dataclass
class Scene:
    """`shapes` by body. `fixed`: bodies that the ground holds, each with the edges at which it does, none: by itself.
    `faces`: edges for loads, `top` those pressed towards the ground, `side` all others. `gravity`: a direction, or none."""
    name: str
    shapes: dict
    fixed: dict
    top: list
    side: list
    gravity: tuple = (0.0, -1.0)
    symmetric: list = dataclasses.field(default_factory=list)  # lines of symmetry, as `supports` have them
    gaps: dict = dataclasses.field(default_factory=dict)       # pairs of edges apart, with their distance
    fits: bool = False                                         # an interference makes sense
    points: list = dataclasses.field(default_factory=list)     # where round sides touch others in a point
    radius: float = 0.0                                        # of the round sides
    clamped: bool = False                                      # joints end at supports: neither interference nor moved edges

    def edge(self, place):
        body, name = place.split(".", 1)
        return geometry.edges(self.shapes[body])[name]

    def joints(self):
        return geometry.touching(self.shapes) + list(self.gaps)

    def neighbours(self, body):
        pairs = [{place.split(".")[0] for place in joint} for joint in self.joints()]
        return {other for pair in pairs if body in pair for other in pair if other != body}


def rectangle(x, y, width, height):
    return {"rectangle": {"corner": [x, y], "size": [width, height]}}


def polygon(points):
    return {"polygon": {"vertices": [[float(c) for c in p] for p in points]}}


def line(to, name=None):
    return {"line": {"to": list(to)}, **({"name": name} if name else {})}


def arc(to, centre, name=None, clockwise=False):
    piece = {"arc": {"to": list(to), "centre": list(centre), **({"direction": "clockwise"} if clockwise else {})}}
    return {**piece, **({"name": name} if name else {})}
