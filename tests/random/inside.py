"""What may lie inside a rectangle of a random model: a crack whose faces are in contact, a hole, another material."""
from dice import short
from scene import arc

CELLS = ("polygons", "quadtree")


def flaws(dice, made):
    for name, body in list(made["bodies"].items()):
        if "mesh" not in body or "rectangle" not in body["shape"] or "refine" in body["mesh"] or not dice.chance(0.08):
            continue
        kind = dice.weighted({"crack": 1, "hole": 1, "region": 1})
        if kind == "crack":
            crack(dice, made, name, body)
        else:
            disc = circle(dice, body["shape"]["rectangle"])
            if kind == "hole":
                body["holes"] = {"bore": disc}
            else:
                body["regions"] = {"core": {"material": dice.choice(made["materials"]), "shape": disc}}


def inner(dice, rectangle, part):
    """A point within the middle part of a rectangle."""
    return [low + side * (0.5 + part * dice.uniform(-0.5, 0.5)) for low, side in zip(rectangle["corner"], rectangle["size"])]


def circle(dice, rectangle):
    """Two arcs: a circle of one arc would begin to the right of its centre however the model is turned."""
    x, y = (short(c) for c in inner(dice, rectangle, 0.2))
    radius = short(0.2 * min(rectangle["size"]), 2)
    return {"outline": [arc((x - radius, y), (x, y)), arc((x + radius, y), (x, y))]}


def crack(dice, made, name, body):
    """Inside, or from the left edge."""
    if body["mesh"].get("kind") not in CELLS:
        return
    corner, size = body["shape"]["rectangle"]["corner"], body["shape"]["rectangle"]["size"]
    level, lean = dice.uniform(0.35, 0.65), dice.uniform(-0.1, 0.1)
    begin, end = (0.0 if dice.chance(0.4) else dice.uniform(0.2, 0.3)), dice.uniform(0.5, 0.75)
    points = [[low + side * part for low, side, part in zip(corner, size, parts)] for parts in ((begin, level), (end, level + lean))]
    body["cracks"] = [{"path": points, "name": "flaw"}]
    if dice.chance(0.8):
        made["contacts"][f"flaw_{name}"] = {"between": [f"{name}.flaw.left", f"{name}.flaw.right"], "friction": dice.choice([0, 0.2, 0.5, 0.8])}
