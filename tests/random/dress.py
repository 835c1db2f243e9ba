"""Makes a model of a `Scene`: materials, meshes, supports, springs and laws of contact."""
import families
import geometry
import inside
import loads
from dice import Dice, short


def model(seed):
    """The random model of a seed: its family, and what a model file says."""
    dice = Dice(seed)
    scene = dice.weighted(families.FAMILIES)(dice)
    found = materials(dice)
    pressure = contact_pressure(dice, found) if scene.points else dice.log(2e4, 5e5)
    made = {"scabo": 1, "title": f"{scene.name} {seed}", "analysis": {"plane": dice.choice(["stress", "strain"]), "thickness": 1.0},
            "materials": found, "bodies": {}, "supports": [], "springs": [], "loads": {}, "contacts": {}, "ties": {},
            "steps": [], "output": {"fields": []}}
    if dice.chance(0.3):
        made["analysis"]["thickness"] = dice.choice([0.1, 0.5, 2.0])
    rigid = rigid_bodies(dice, scene)
    for name, shape in scene.shapes.items():
        made["bodies"][name] = body(dice, found, shape, name in rigid, scene)
    hold(dice, scene, made, rigid, pressure)
    join(dice, scene, made, rigid, pressure)
    inside.flaws(dice, made)
    loads.load(dice, scene, made, rigid, pressure)
    loads.steps(dice, made)
    loads.stages(dice, scene, made)
    return scene.name, {key: value for key, value in made.items() if value not in ([], {})}


def materials(dice):
    """Up to three; often one of them is much softer or stiffer than the first."""
    young, found = dice.log(1e9, 5e10), {}
    ratios = [1.0] + [10 ** dice.uniform(-3, 6) if dice.chance(0.5) else dice.log(0.3, 3) for _ in range(dice.whole(0, 2))]
    for i, ratio in enumerate(ratios):
        stiff = short(young * ratio)
        if dice.chance(0.08):
            law = {"orthotropic": {"E1": stiff, "E2": short(stiff * dice.log(0.1, 1)), "E3": short(stiff * 0.3), "nu12": 0.2,
                                   "nu13": 0.1, "nu23": 0.2, "G12": short(stiff * dice.log(0.05, 0.4)),
                                   "angle": dice.number(0, 180)}}
        else:
            law = {"young": stiff, "poisson": dice.choice([0, 0.2, 0.3, 0.3, 0.45, 0.49])}
        found[f"m{i + 1}"] = {**law, "density": dice.choice([2000.0, 2400.0, 7800.0]), "expansion": 1e-5}
    return found


def rigid_bodies(dice, scene):
    """No two neighbours are rigid: there is no contact between them."""
    found = set()
    for name in dice.shuffled(scene.shapes):
        likely = 0.5 if name in scene.fixed and len(scene.neighbours(name)) > 0 and is_ground(name) else 0.07
        if dice.chance(likely) and not scene.neighbours(name) & found and len(found) + 1 < len(scene.shapes) and not scene.symmetric:
            found.add(name)
    return found


def is_ground(name):
    return name in ("floor", "anvil", "jaw", "wall_right", "wall_left")


def contact_pressure(dice, found):
    """So large that round sides touch along a part of their radius: about 0.2 of it."""
    return short(1e-2 * dice.log(0.5, 2) * min(of.get("young") or of["orthotropic"]["E2"] for of in found.values()))


def body(dice, found, shape, rigid, scene):
    if rigid:
        return {"rigid": True, "shape": shape}
    material = "m1" if dice.chance(0.6) else dice.choice(found)
    return {"material": material, "shape": shape, "mesh": mesh(dice, shape, scene)}


def mesh(dice, shape, scene):
    kind = dice.weighted({"superelement": 0.6, "polygons": 0.14, "quadtree": 0.12, "fem": 0.14})
    low, high = geometry.extent(shape)
    narrow = max(0.6 * min(high[0] - low[0], high[1] - low[1]), 0.35 * max(high[0] - low[0], high[1] - low[1]))
    order = dice.whole(1, 2) if kind == "fem" else dice.weighted({1: 0.2, 2: 0.4, 3: 0.15, 4: 0.25})
    parts = {1: (5, 8), 2: (3, 6), 3: (2, 4), 4: (1, 3)}[order]
    made = {"size": short(narrow / dice.uniform(*parts), 2), "order": order}
    if kind != "superelement":
        made["kind"] = kind
    near = [point for point in scene.points if geometry.touches(shape, point)]
    if near:
        made["refine"] = [{"near": list(point), "size": short({1: 0.03, 2: 0.05}.get(order, 0.1) * scene.radius, 2)} for point in near]
    elif dice.chance(0.1):
        name = dice.choice(geometry.edges(shape))
        made["refine"] = [{"on": name, "size": short(made["size"] / 2, 2)}]
    return made


def hold(dice, scene, made, rigid, pressure):
    """Supports and springs of what the ground holds."""
    supports, springs = made["supports"], made["springs"]
    for name, places in scene.fixed.items():
        if name in rigid:
            foundation(dice, scene, made, name, pressure)
            continue
        for edge in places:
            place = f"{name}.{edge}"
            how = dice.weighted({"fixed": 6, "normal": 1, "springs": 1.5, "along": 0.5})
            if how == "springs":
                k = short(stiffness(made, name) / geometry.size(scene.shapes[name]) * dice.log(0.1, 10))
                springs.append({"on": place, "k_n": k, "k_t": short(k * dice.uniform(0.2, 1)), "name": f"spring_{name}"})
            elif how == "normal":
                supports.append({"on": place, "fix": "normal", "name": f"hold_{name}"})
                k = short(stiffness(made, name) / geometry.size(scene.shapes[name]) * dice.log(0.1, 1))
                springs.append({"on": place, "k_t": k, "name": f"shear_{name}"})
            elif how == "along":
                angle = dice.choice([[1, 0], [1, 1], [1, 2]])
                supports.append({"on": place, "fix": {"along": angle}, "name": f"hold_{name}"})
                supports.append({"on": place, "fix": {"along": [-angle[1], angle[0]]}, "name": f"hold_too_{name}"})
            else:
                supports.append({"on": place, "fix": ["x", "y"], "name": f"hold_{name}"})
    supports += [{"symmetry": line} for line in scene.symmetric]
    if "jaw" in rigid and dice.chance(0.5):
        supports.append({"on": "jaw", "fix": "y", "name": "guide"})
    elastic = [name for name in scene.shapes if name not in rigid and "rectangle" in scene.shapes[name]]
    if elastic and dice.chance(0.08):  # alike in all directions
        name = dice.choice(elastic)
        k = short(stiffness(made, name) * dice.log(1e-4, 0.1))
        springs.append({"on": f"{name}.{dice.choice(['top_left', 'top_right'])}", "k_x": k, "k_y": k, "name": "anchor"})


def foundation(dice, scene, made, name, pressure):
    """A rigid body that is held, stands on springs along its edge, or moves in a step."""
    edge = scene.fixed[name][0]
    if dice.chance(0.08):
        move = [short(1e-5 * dice.uniform(-1, 1)) for _ in "xy"]
        made["supports"].append({"on": name, "displacement": move, "rotation": short(1e-5 * dice.uniform(-1, 1)), "at": [0.1, 0.2],
                                 "name": f"move_{name}"})
        return
    if dice.chance(0.15):
        k = short(1e3 * pressure * dice.log(1, 100))
        made["springs"].append({"on": f"{name}.{edge}", "k_n": k, "k_t": k, "name": f"spring_{name}"})
    else:
        made["supports"].append({"on": name, "fix": ["x", "y"], "name": f"hold_{name}"})


def stiffness(made, name):
    """Young's modulus of a body, or of the softest one for a rigid body."""
    all_of = {key: of.get("young") or of["orthotropic"]["E2"] for key, of in made["materials"].items()}
    return all_of.get(made["bodies"][name].get("material"), min(all_of.values()))


def join(dice, scene, made, rigid, pressure):
    """Contacts, with one law for all or one for each, and now and then a tie."""
    joints = [joint for joint in scene.joints() if not {place.split(".")[0] for place in joint} <= rigid]
    motion = pressure / min(stiffness(made, body) for body in scene.shapes if body not in rigid)
    ties = set()
    if dice.chance(0.2):
        elastic = [joint for joint in joints if joint not in scene.gaps and not {place.split(".")[0] for place in joint} & rigid]
        for joint in dice.shuffled(elastic)[: dice.whole(1, 2)]:
            ties.add(joint)
            made["ties"][f"tie_{len(ties)}"] = {"between": list(joint)}
    low = 0.2 if scene.name in ("stack", "wall", "arch", "vice", "pieces") else 0.0
    if not scene.gaps and dice.chance(0.25):
        made["contacts"]["all"] = {"between": "all", **law(dice, pressure, motion, low, along=False)}
        return
    if dice.chance(0.2):
        made["contact_properties"] = {"p1": law(dice, pressure, motion, low, along=False)}
    common = law(dice, pressure, motion, low, along=False) if dice.chance(0.4) else None
    for number, joint in enumerate(joints):
        if joint in ties:
            continue
        straight = all(scene.edge(place).straight for place in joint)
        own = common or law(dice, pressure, motion, low, along=straight)
        if "contact_properties" in made and dice.chance(0.5):
            own = {"property": "p1"}
        contact = {"between": list(joint), **own}
        if joint in scene.gaps:
            contact = {"between": list(joint), "friction": own.get("friction", 0.3)}
        bonded = own.get("bond") or "property" in own and made["contact_properties"]["p1"].get("bond")
        if not bonded and not scene.clamped and dice.chance(0.3 if scene.fits else 0.08):
            contact["gap"] = short(dice.choice([-1, -1, 1]) * motion * dice.log(0.05, 3) * 0.5)
        plain = isinstance(contact.get("friction", 0), (int, float)) or "forward" in contact["friction"]
        if straight and plain and not contact.keys() & {"gap", "bond", "cohesion", "property"} and dice.chance(0.04):
            contact["slip"] = "large"
        made["contacts"][f"c{number + 1}"] = contact
    if "contact_properties" in made and not any("property" in c for c in made["contacts"].values()):
        del made["contact_properties"]


def law(dice, pressure, motion, low, along):
    """One of the laws; coefficients of friction are at least `low` where bodies need it, mostly."""
    low = low if dice.chance(0.85) else 0.0
    friction = dice.choice([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0, 1.5]) if dice.chance(0.9) else dice.number(0, 2)
    friction = max(friction, low)
    kind = dice.weighted({"coulomb": 5, "frictionless": 1 if low == 0 else 0.2, "direction": 1.2, "cohesion": 1.6, "weakening": 1.2,
                          "along": 0.6 if along else 0, "bond": 0.8, "tresca": 0.6})
    if kind == "frictionless":
        return {}
    if kind == "direction":
        return {"friction": {"forward": friction, "backward": max(low, dice.number(0, 1))}}
    if kind == "cohesion":
        cohesion = short(pressure * dice.log(0.1, 3))
        tension = {"tension": short(cohesion * dice.uniform(0.2, 1))} if dice.chance(0.6) else {}
        return {"friction": friction, "cohesion": cohesion, **tension}
    if kind == "weakening":
        slip = 0 if dice.chance(0.25) else short(motion * dice.log(0.1, 10))
        high = {"forward": friction, "backward": short(friction * 1.2)} if dice.chance(0.15) else friction
        return {"friction": {"static": high, "dynamic": short(friction * dice.uniform(0.5, 0.95)), "slip_distance": slip}}
    if kind == "along":
        return {"friction": {"along": [[0, friction], [dice.number(0.3, 0.7), dice.number(max(low, 0.1), 1)], [1, dice.number(max(low, 0.1), 1)]]}}
    if kind == "bond":
        return {"bond": True}
    if kind == "tresca":
        return {"shear_strength": short(pressure * dice.log(0.05, 2))}
    return {"friction": friction}
