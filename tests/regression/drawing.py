"""The same model drawn in other units, turned, and with its bodies and the sides of its contacts in another order."""
import dataclasses
import json
import math


@dataclasses.dataclass(frozen=True)
class Drawing:
    """`metre`: a metre in the unit of length; forces stay in N. `angle`: by which all is turned, rad."""
    metre: float = 1.0
    angle: float = 0.0
    backwards: bool = False  # bodies and contacts from the last to the first
    swapped: bool = False    # sides of contacts

    def vector(self, x, y):
        c, s = math.cos(self.angle), math.sin(self.angle)
        return [c * x - s * y, s * x + c * y]

    def point(self, x, y):
        return [self.metre * component for component in self.vector(x, y)]

    def length(self, metres):
        return self.metre * metres

    def stress(self, pascals):
        return pascals / self.metre**2

    def per_volume(self, value):
        return value / self.metre**3

    def traction(self, x, y):
        return [self.stress(component) for component in self.vector(x, y)]

    def box(self, x, y, width, height):
        """A rectangle with the edges that a rectangle has."""
        corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
        return self.polygon(corners, bottom="edge_1", right="edge_2", top="edge_3", left="edge_4")

    def polygon(self, corners, **names):
        return {"polygon": {"vertices": [self.point(*corner) for corner in corners], "names": names}}

    def arc(self, name, start, end, centre):
        return {"name": name, "arc": {"from": self.point(*start), "to": self.point(*end), "centre": self.point(*centre)}}

    def line(self, name, end):
        return {"name": name, "line": {"to": self.point(*end)}}

    def fixed(self, on, *directions):
        """Supports of a place along directions (x, y) of the model as it is not turned."""
        return [{"on": on, "fix": {"along": self.vector(*direction)}} for direction in directions]

    def text(self, model):
        """The model file; JSON is YAML."""
        model = {"scabo": 1, **model}
        analysis = dict(model.get("analysis", {}))
        analysis["thickness"] = self.length(analysis.get("thickness", 1.0))
        model["analysis"] = analysis
        for key in ("bodies", "contacts"):
            if self.backwards:
                model[key] = dict(reversed(model[key].items()))
        if self.swapped:
            model["contacts"] = {
                name: {**contact, "between": contact["between"][::-1]} if isinstance(contact["between"], list) else contact
                for name, contact in model["contacts"].items()}
        return json.dumps(model, indent=1)


# As drawn, in millimetres, kilometres and another unit, turned, the other way round.
TWINS = [
    Drawing(),
    Drawing(metre=1e3),
    Drawing(metre=1e-3),
    Drawing(metre=7.3, angle=0.4),
    Drawing(angle=math.pi / 2),
    Drawing(angle=-2.1, backwards=True),
    Drawing(swapped=True),
    Drawing(metre=1e3, angle=3.0, swapped=True, backwards=True),
]
