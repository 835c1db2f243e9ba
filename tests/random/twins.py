"""Four twins of a model that must give the same: in other units, turned, its parts in another order, with a finer mesh."""
import copy

from change import Change, changed
from dice import Dice

UNITS = [(1000.0, 1.0), (1000.0, 1.0), (1e-3, 1e-3), (0.1, 1.0), (39.37, 0.2248)]  # mm and N, km and kN, decimetres, inches and pounds


def twin_dice(seed):
    return Dice(1_000_003 * seed)


def twins(model, dice):
    """By name, each with the `Change` that leads to it."""
    in_units = Change(*dice.choice(UNITS))
    turned = quarter(dice) if dice.chance(0.3) or not all_turnable(model) else any_angle(dice)
    same = Change()
    return {"units": (changed(model, in_units), in_units), "turned": (changed(model, turned), turned),
            "reordered": (reordered(model, dice), same), "finer": (finer(model), same)}


def quarter(dice):
    return Change(quarters=dice.whole(1, 3), centre=(dice.number(-2, 2), dice.number(-2, 2)))


def any_angle(dice):
    return Change(angle=dice.number(5, 355), centre=(dice.number(-2, 2), dice.number(-2, 2)))


def all_turnable(model):
    """Finite elements of a rectangle are quadrilaterals only along x and y."""
    return not any("rectangle" in body["shape"] and body.get("mesh", {}).get("kind") == "fem" for body in model["bodies"].values())


def reordered(model, dice):
    """Bodies, materials, loads, supports and contacts in another order, and the sides of contacts swapped."""
    made = copy.deepcopy(model)
    for key in ("materials", "bodies", "loads", "contacts", "contact_properties", "ties"):
        if key in made:
            made[key] = {name: made[key][name] for name in dice.shuffled(made[key])}
    for key in ("supports", "springs"):
        if key in made:
            made[key] = dice.shuffled(made[key])
    for key in ("contacts", "ties"):
        for item in made.get(key, {}).values():
            if item["between"] != "all" and dice.chance(0.5):
                item["between"] = item["between"][::-1]
    return made


def finer(model, parts=2):
    """All sizes divided."""
    made = copy.deepcopy(model)
    for body in made["bodies"].values():
        for part in [body["mesh"], *body["mesh"].get("refine", [])] if "mesh" in body else []:
            for key in ("size", "min_size"):
                if key in part:
                    part[key] /= parts
    return made


def same_mesh_when_turned(model, change):
    """Super-elements turn with their body; where other meshes lie depends on the axes, right angles included. A rectangle of
    finite elements stays one with right angles."""
    for body in model["bodies"].values():
        kind = body.get("mesh", {}).get("kind", "superelement")
        rows = kind == "fem" and "rectangle" in body["shape"] and "refine" not in body["mesh"] and change.quarters
        if "mesh" in body and kind != "superelement" and not rows:
            return False
    return True
