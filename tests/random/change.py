"""A model in other units and turned: x' = scale (c + R (x - c)), forces F R f. Times and temperatures stay as they are."""
import copy
import math

from geometry import CORNERS, edge_of, ends


class Change:
    def __init__(self, length=1.0, force=1.0, angle=0.0, centre=(0.0, 0.0), quarters=0):
        """`angle` in degrees; with `quarters` that many right angles instead, rectangles stay rectangles then."""
        self.length, self.force, self.centre, self.quarters = length, force, centre, quarters % 4
        self.degrees = 90.0 * self.quarters if quarters else angle
        exact = {0: (1.0, 0.0), 1: (0.0, 1.0), 2: (-1.0, 0.0), 3: (0.0, -1.0)}
        radians = math.radians(angle)
        self.cos, self.sin = exact[self.quarters] if quarters or angle == 0 else (math.cos(radians), math.sin(radians))
        self.stress = force / length**2

    @property
    def turns(self):
        return self.degrees != 0

    def vector(self, v, scale=1.0):
        return [scale * (self.cos * v[0] - self.sin * v[1]), scale * (self.sin * v[0] + self.cos * v[1])]

    def back(self, v, scale=1.0):
        """The vector that `vector` makes of it."""
        return [(self.cos * v[0] + self.sin * v[1]) / scale, (-self.sin * v[0] + self.cos * v[1]) / scale]

    def point(self, p):
        if not self.turns:
            return [self.length * c for c in p]
        turned = self.vector([p[0] - self.centre[0], p[1] - self.centre[1]])
        return [self.length * (c + d) for c, d in zip(self.centre, turned)]

    def point_back(self, p):
        if not self.turns:
            return [c / self.length for c in p]
        return [c + d for c, d in zip(self.centre, self.back([q / self.length - c for q, c in zip(p, self.centre)]))]

    def place(self, model, place):
        """A place by the name that it gets: right angles give the edges of a rectangle other names."""
        if not isinstance(place, str) or "." not in place or self.quarters == 0:
            return place
        body, name = place.split(".", 1)
        if "rectangle" not in model["bodies"][body]["shape"]:
            return place
        for names in (list(CORNERS), list(CORNERS.values())):
            if name in names:
                return f"{body}.{names[(names.index(name) + self.quarters) % 4]}"
        return place


def changed(model, change):
    """The same model in other units, or turned."""
    made = copy.deepcopy(model)
    if change.length != 1:
        made["analysis"] = {**made.get("analysis", {}), "thickness": made.get("analysis", {}).get("thickness", 1.0) * change.length}
    for material in made.get("materials", {}).values():
        change_material(material, change)
    for body in made["bodies"].values():
        change_body(body, change)
    made["supports"] = [support(item, model, change) for item in made.get("supports", [])]
    made["springs"] = [spring(item, model, change) for item in made.get("springs", [])]
    for name, load in made.get("loads", {}).items():
        made["loads"][name] = changed_load(load, model, change)
    for contact in made.get("contacts", {}).values():
        change_contact(contact, model, change)
    for law in made.get("contact_properties", {}).values():
        change_law(law, change)
    for tie in made.get("ties", {}).values():
        tie["between"] = between(tie["between"], model, change)
    return {key: value for key, value in made.items() if value not in ([], {})}


def change_material(material, change):
    for key in ("young",):
        if key in material:
            material[key] *= change.stress
    if "density" in material:
        material["density"] *= change.force / change.length**4
    if "orthotropic" in material:
        law = material["orthotropic"]
        for key in law:
            if key[0] in "EG":
                law[key] *= change.stress
        law["angle"] = law.get("angle", 0) + change.degrees


def change_body(body, change):
    body["shape"] = changed_shape(body["shape"], change)
    for name, hole in body.get("holes", {}).items():
        body["holes"][name] = changed_shape(hole, change, f"{name}_")
    for region in body.get("regions", {}).values():
        region["shape"] = changed_shape(region["shape"], change)
    for crack in body.get("cracks", []):
        crack["path"] = [change.point(p) for p in crack["path"]]
    mesh = body.get("mesh", {})
    for part in [mesh, *mesh.get("refine", [])]:
        for key in ("size", "min_size"):
            if key in part:
                part[key] *= change.length
        for key in ("centre", "near"):
            if key in part:
                part[key] = change.point(part[key])
        if "on" in part and change.quarters:
            part["on"] = change.place({"bodies": {"b": {"shape": body["shape"]}}}, "b." + part["on"])[2:]


def changed_shape(shape, change, prefix=""):
    if "rectangle" in shape:
        low = shape["rectangle"]["corner"]
        high = [a + b for a, b in zip(low, shape["rectangle"]["size"])]
        if not change.turns:
            return {"rectangle": {key: change.point(value) for key, value in shape["rectangle"].items()}}
        if change.quarters:
            one, other = change.point(low), change.point(high)
            return {"rectangle": {"corner": [min(a, b) for a, b in zip(one, other)], "size": [abs(a - b) for a, b in zip(one, other)]}}
        vertices = [low, [high[0], low[1]], high, [low[0], high[1]]]
        names = {prefix + name: f"edge_{i + 1}" for i, name in enumerate(CORNERS)}
        names |= {prefix + name: f"vertex_{i + 1}" for i, name in enumerate(CORNERS.values())}
        return {"polygon": {"vertices": [change.point(p) for p in vertices], "names": names}}
    if "polygon" in shape:
        return {"polygon": {**shape["polygon"], "vertices": [change.point(p) for p in shape["polygon"]["vertices"]]}}
    pieces = copy.deepcopy(shape["outline"])
    for piece in pieces:
        of = ends(piece)
        for key in ("from", "to", "centre"):
            if key in of:
                of[key] = change.point(of[key])
    return {**shape, "outline": pieces}


def line_of(symmetry, change):
    if "from" in symmetry:
        one, other = symmetry["from"], symmetry["to"]
    else:
        value = symmetry.get("x", symmetry.get("y"))
        one, other = ([value, 0.0], [value, 1.0]) if "x" in symmetry else ([0.0, value], [1.0, value])
    return {"from": change.point(one), "to": change.point(other)}


def support(item, model, change):
    if "symmetry" in item:
        if not change.turns:
            return {"symmetry": {key: value * change.length for key, value in item["symmetry"].items()}}
        return {"symmetry": line_of(item["symmetry"], change)}
    made = {**item, "on": change.place(model, item["on"])}
    if change.turns and "fix" in item:
        fix = item["fix"]
        if fix in ("x", "y"):
            made["fix"] = {"along": change.vector([1, 0] if fix == "x" else [0, 1])}
        elif isinstance(fix, dict):
            made["fix"] = {"along": change.vector(fix["along"])}
    if "displacement" in item:
        made["displacement"] = moved(item["displacement"], change)
    if "at" in item:
        made["at"] = change.point(item["at"])
    return made


def moved(displacement, change):
    if isinstance(displacement, dict):
        made = {key: value * change.length for key, value in displacement.items() if key != "along"}
        return {**made, "along": change.vector(displacement["along"])} if "along" in displacement else made
    if not change.turns:
        return [None if value is None else value * change.length for value in displacement]
    if None not in displacement:
        return change.vector(displacement, change.length)
    direction = [1, 0] if displacement[1] is None else [0, 1]
    value = displacement[0] if displacement[1] is None else displacement[1]
    return {"along": change.vector(direction), "value": value * change.length}


def spring(item, model, change):
    """Springs at points are alike along x and y."""
    made = {**item, "on": change.place(model, item["on"])}
    for key, scale in (("k_n", change.stress / change.length), ("k_t", change.stress / change.length),
                       ("k_x", change.force / change.length), ("k_y", change.force / change.length)):
        if key in item:
            made[key] = item[key] * scale
    if "at_rest" in item:
        if "k_x" in item:
            made["at_rest"] = change.vector(item["at_rest"], change.length)
        else:
            made["at_rest"] = [None if value is None else value * change.length for value in item["at_rest"]]
    return made


def changed_load(load, model, change):
    made = {**load}
    if "on" in load:
        made["on"] = change.place(model, load["on"])
    if "moment" in load:
        made["moment"] = load["moment"] * change.force * change.length
    if "force" in load:
        made["force"] = change.vector(load["force"], change.force)
    if "gravity" in load:
        made["gravity"] = change.vector(load["gravity"], change.length)
    for key in ("traction", "pressure"):
        if key in load:
            made[key] = along_edge(load[key], load.get("on"), model, change)
    if "water" in load:
        made["water"] = ground(load["water"], change, "level")
    if "body_force" in load:
        made["body_force"] = forces_inside(load["body_force"], change)
    if "temperature" in load:
        made["temperature"] = temperature(load["temperature"], change)
    if "field" in load:
        made["field"] = field(load["field"], change)
    return made


def along_edge(value, place, model, change):
    """A traction or pressure, constant or a table."""
    if isinstance(value, dict):
        scaled = [along_edge(v, place, model, change) for v in value["values"]]
        at, over = value["at"], value.get("over")
        if over is None:
            return {"at": [change.point(p) for p in at], "values": scaled}
        if over == "length" or not change.turns:
            return {"over": over, "at": [a * change.length for a in at], "values": scaled}
        body, name = place.split(".", 1)
        edge, k = edge_of(model["bodies"][body]["shape"], name), "xy".index(over)
        points = [edge.at((a - edge.start[k]) / (edge.end[k] - edge.start[k])) for a in at]
        return {"at": [change.point(p) for p in points], "values": scaled}
    return change.vector(value, change.stress) if isinstance(value, list) else value * change.stress


def ground(of, change, level):
    """What depends on the depth below a level: water, and the stress of ground."""
    up = of.get("up", [0.0, 1.0])
    size = math.hypot(*up)
    surface = change.point([of[level] * u / size for u in up])
    turned = change.vector([u / size for u in up])
    made = {**of, level: surface[0] * turned[0] + surface[1] * turned[1], "unit_weight": of["unit_weight"] * change.force / change.length**3}
    if "surcharge" in of:
        made["surcharge"] = of["surcharge"] * change.stress
    return {**made, "up": turned} if change.turns or "up" in of else made


def gradient(constant, x, y, change):
    """c + x X + y Y in the other axes, of numbers; lengths count."""
    turned = change.vector([x, y], 1 / change.length)
    origin = change.point([0.0, 0.0])
    return constant - turned[0] * origin[0] - turned[1] * origin[1], turned


def forces_inside(force, change):
    scale = change.force / change.length**3
    if not isinstance(force, dict):
        return change.vector(force, scale)
    parts = [gradient(force["constant"][k], force["x"][k], force["y"][k], change) for k in (0, 1)]
    return {"constant": change.vector([parts[0][0], parts[1][0]], scale), "x": change.vector([parts[0][1][0], parts[1][1][0]], scale),
            "y": change.vector([parts[0][1][1], parts[1][1][1]], scale)}


def temperature(of, change):
    if "values" not in of:
        constant, turned = gradient(of.get("constant", 0.0), of.get("x", 0.0), of.get("y", 0.0), change)
        return {"constant": constant, "x": turned[0], "y": turned[1]} if "x" in of or "y" in of else {"constant": of["constant"]}
    if not change.turns and "over" in of:
        return {**of, "at": [a * change.length for a in of["at"]]}
    points = [[a, 0.0] if of.get("over") == "x" else [0.0, a] for a in of["at"]] if "over" in of else of["at"]
    return {"at": [change.point(p) for p in points], "values": of["values"]}


def field(of, change):
    if "vertical" in of:
        return {**of, "vertical": ground(of["vertical"], change, "surface")}
    c, s = change.cos, change.sin
    xx, yy, xy = (value * change.stress for value in of["stress"])
    made = {**of, "stress": [c * c * xx + s * s * yy - 2 * s * c * xy, s * s * xx + c * c * yy + 2 * s * c * xy,
                             s * c * (xx - yy) + (c * c - s * s) * xy]}
    return {**made, "szz": of["szz"] * change.stress} if "szz" in of else made


def between(places, model, change):
    return places if places == "all" else [change.place(model, place) for place in places]


def change_contact(contact, model, change):
    places = contact["between"]
    contact["between"] = between(places, model, change)
    for key in ("gap", "reach"):
        if key in contact:
            contact[key] *= change.length
    if "about" in contact:
        contact["about"] = change.point(contact["about"])
    along = contact["friction"].get("along") if isinstance(contact.get("friction"), dict) else None
    change_law(contact, change)
    if along and turned_over(places[0], model, change):
        contact["friction"]["along"] = [[1 - position, value] for position, value in reversed(along)]


def turned_over(place, model, change):
    """Whether the pairs of a straight contact are counted from its other end."""
    body, name = place.split(".", 1)
    tangent = edge_of(model["bodies"][body]["shape"], name).tangent
    return counted_forwards(tangent) != counted_forwards(change.vector(tangent))


def counted_forwards(tangent):
    """From the end with the smaller x, upright: y."""
    return tangent[0] > 0 if abs(tangent[0]) > 1e-9 else tangent[1] > 0


def change_law(law, change):
    for key in ("cohesion", "tension", "shear_strength"):
        if key in law:
            law[key] *= change.stress
    if isinstance(law.get("friction"), dict) and "slip_distance" in law["friction"]:
        law["friction"] = {**law["friction"], "slip_distance": law["friction"]["slip_distance"] * change.length}
