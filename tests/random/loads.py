"""Loads and steps of a random model."""
from dice import short


def load(dice, scene, made, rigid, pressure):
    """First what presses the bodies together, then one to three other loads."""
    press(dice, scene, made, rigid, pressure)
    others = {"traction": 3, "pressure": 2, "table": 1.5, "corner": 1, "edge_force": 1, "moment": 0.7, "inclined": 1 if scene.gravity else 0,
              "body_force": 0.5, "temperature": 1, "hot_table": 0.3, "field": 0.3, "water": 0.6, "pore": 0.5, "at_rest": 0.5}
    for number in range(dice.whole(1, 3)):
        kind = dice.weighted(others)
        MAKERS[kind](dice, scene, made, rigid, pressure, f"{kind}_{number + 1}")


def elastic(place, rigid):
    return place.split(".")[0] not in rigid


def press(dice, scene, made, rigid, pressure):
    if scene.gravity and dice.chance(0.7):
        made["loads"]["weight"] = {"gravity": [0.0, short(-dice.choice([9.81, 9.81, 30, 100]))]}
    for number, place in enumerate(scene.top):
        name, body = f"press_{number + 1}", place.split(".")[0]
        if body in scene.fixed and body in rigid:
            continue
        if scene.name == "vice" and body in rigid and dice.chance(0.5):
            made["supports"].append({"on": body, "displacement": [short(-1e-4 * dice.log(0.1, 3)), 0.0], "name": name})
            continue
        if not scene.clamped and len(scene.top) < 3 and elastic(place, rigid) and dice.chance(0.12):
            made["supports"].append({"on": place, "displacement": {"normal": short(-1e-4 * dice.log(0.1, 3))}, "name": name})
        else:
            made["loads"][name] = {"on": place, "pressure": short(pressure * dice.log(0.5, 2))}
    if not scene.top and not scene.gravity:
        raise AssertionError(scene.name)


def a_face(dice, scene, rigid):
    """An edge for a load: mostly one of the sides; of an elastic body if there is one."""
    places = scene.side if scene.side and (dice.chance(0.7) or not scene.top) else scene.top
    free = [place for place in places if elastic(place, rigid)] or [place for place in scene.top + scene.side if elastic(place, rigid)]
    return dice.choice(free) if free else None


def traction(dice, scene, made, rigid, pressure, name):
    place = a_face(dice, scene, rigid)
    if place:
        made["loads"][name] = {"on": place, "traction": [short(0.3 * pressure * dice.uniform(-1, 1)) for _ in "xy"]}


def side_pressure(dice, scene, made, rigid, pressure, name):
    place = a_face(dice, scene, rigid)
    if place:
        made["loads"][name] = {"on": place, "pressure": short(pressure * dice.log(0.05, 1) * (1 if dice.chance(0.85) else -0.2))}


def table(dice, scene, made, rigid, pressure, name):
    """Over a part of a straight edge, by points or by lengths."""
    place = a_face(dice, scene, rigid)
    if not place or not scene.edge(place).straight:
        return
    edge = scene.edge(place)
    parts = sorted(dice.uniform(0, 1) for _ in range(dice.whole(2, 3)))
    if dice.chance(0.5):
        parts = [0.0, *parts[1:-1], 1.0]
    values = [short(0.4 * pressure * dice.uniform(-0.3, 1)) for _ in parts]
    if dice.chance(0.5):
        where = {"at": [list(edge.at(part)) for part in parts]}
    else:
        where = {"over": "length", "at": [part * edge.length for part in parts]}
    if dice.chance(0.6):
        made["loads"][name] = {"on": place, "pressure": {**where, "values": values}}
    else:
        made["loads"][name] = {"on": place, "traction": {**where, "values": [[value, short(-0.3 * value)] for value in values]}}


def corner(dice, scene, made, rigid, pressure, name):
    """On a corner; on a rigid body at its centroid or a corner."""
    place = a_face(dice, scene, rigid)
    if not place:
        return
    body, _, edge = place.partition(".")
    shape = scene.shapes[body]
    corners = ["bottom_left", "bottom_right", "top_right", "top_left"] if "rectangle" in shape else ["vertex_1", "vertex_2"]
    force = [short(0.05 * pressure * dice.uniform(-1, 1)), short(-0.05 * pressure * dice.uniform(0, 1))]
    made["loads"][name] = {"on": f"{body}.{dice.choice(corners)}", "force": force}


def edge_force(dice, scene, made, rigid, pressure, name):
    places = [place.split(".")[0] for place in scene.side + scene.top if not elastic(place, rigid)]
    free = [body for body in places if body not in scene.fixed]
    place = dice.choice(free) if free and dice.chance(0.7) else a_face(dice, scene, rigid)
    if place:
        made["loads"][name] = {"on": place, "force": [short(0.2 * pressure * dice.uniform(-1, 1)), short(-0.2 * pressure * dice.uniform(0, 1))]}


def moment(dice, scene, made, rigid, pressure, name):
    place = a_face(dice, scene, rigid)
    if place and scene.edge(place).straight:
        made["loads"][name] = {"on": place, "moment": short(0.05 * pressure * scene.edge(place).length ** 2 * dice.uniform(-1, 1))}


def inclined(dice, scene, made, rigid, pressure, name):
    made["loads"][name] = {"gravity": [short(3 * dice.uniform(-1, 1)), 0.0]}


def some_body(dice, made, rigid):
    return dice.choice([name for name in made["bodies"] if name not in rigid])


def body_force(dice, scene, made, rigid, pressure, name):
    value = lambda: [short(0.2 * pressure * dice.uniform(-1, 1)) for _ in "xy"]
    force = value() if dice.chance(0.5) else {"constant": value(), "x": value(), "y": value()}
    made["loads"][name] = {"on": some_body(dice, made, rigid), "body_force": force}


def temperature(dice, scene, made, rigid, pressure, name):
    change = {"constant": short(20 * dice.uniform(-1, 1))}
    if dice.chance(0.5):
        change |= {"x": short(5 * dice.uniform(-1, 1)), "y": short(5 * dice.uniform(-1, 1))}
    on = {"on": some_body(dice, made, rigid)} if dice.chance(0.6) else {}
    made["loads"][name] = {**on, "temperature": change}


def hot_table(dice, scene, made, rigid, pressure, name):
    places = [-3.0, *sorted(short(dice.uniform(-1, 2)) for _ in range(2)), 4.0]
    values = [short(20 * dice.uniform(-1, 1)) for _ in places]
    made["loads"][name] = {"temperature": {"over": dice.choice("xy"), "at": places, "values": values}}


def field(dice, scene, made, rigid, pressure, name):
    on = {"on": some_body(dice, made, rigid)} if dice.chance(0.5) else {}
    if dice.chance(0.6):
        stress = [short(-0.3 * pressure * dice.uniform(0, 1)) for _ in "xy"] + [short(0.05 * pressure * dice.uniform(-1, 1))]
        made["loads"][name] = {**on, "field": {"stress": stress}}
    else:
        made["loads"][name] = {**on, "field": {"vertical": {"unit_weight": short(0.1 * pressure), "surface": 4.0}, "K0": dice.choice([0, 0.5, 1])}}


def water(dice, scene, made, rigid, pressure, name):
    place = a_face(dice, scene, rigid)
    if place:
        made["loads"][name] = {"on": place, "water": {"level": dice.number(0.2, 2), "unit_weight": short(0.3 * pressure)}}


def pore(dice, scene, made, rigid, pressure, name):
    free = [key for key, contact in made["contacts"].items() if not contact.get("bond")]
    if free:
        if dice.chance(0.6):
            made["loads"][name] = {"in": dice.choice(free), "pressure": short(0.2 * pressure * dice.uniform(0, 1))}
        else:
            made["loads"][name] = {"in": dice.choice(free), "water": {"level": dice.number(0.2, 2), "unit_weight": short(0.1 * pressure)}}


def at_rest(dice, scene, made, rigid, pressure, name):
    for spring in made["springs"]:
        if "k_n" in spring and "at_rest" not in spring:
            spring["at_rest"] = [short(1e-5 * dice.uniform(-1, 1)), None if dice.chance(0.5) else short(1e-5 * dice.uniform(-1, 1))]
            return


MAKERS = {"traction": traction, "pressure": side_pressure, "table": table, "corner": corner, "edge_force": edge_force, "moment": moment,
          "inclined": inclined, "body_force": body_force, "temperature": temperature, "hot_table": hot_table, "field": field,
          "water": water, "pore": pore, "at_rest": at_rest}


def steps(dice, made):
    """One step, or first what presses and then the rest; perhaps back again, or with less friction."""
    first = [name for name in made["loads"] if name.startswith(("weight", "press", "field"))]
    moved = [item["name"] for item in made["supports"] if "displacement" in item]
    first += [name for name in moved if name.startswith("press")]
    rest = [name for name in [*made["loads"], *moved] if name not in first]
    rest += [s["name"] for s in made["springs"] if "at_rest" in s]
    several = lambda: dice.weighted({1: 2, 2: 2, 3: 1.5, 4: 1, 5: 0.5, "auto": 0.7})
    if not rest or not first or dice.chance(0.35):
        count = several()
        made["steps"] = [] if count == 1 else [{"increments": count}]
        return
    made["steps"] = [{"name": "press", "increments": dice.whole(1, 2), "loads": {name: 1.0 for name in first}},
                     {"name": "rest", "increments": several(), "loads": {name: 1.0 for name in rest}}]
    for contact in made["contacts"].values():
        if (contact.get("gap") or 0) < 0 and dice.chance(0.3):
            contact["fit_in"] = "press"
    if dice.chance(0.15):
        made["curves"] = {"swing": dice.choice([{"sine": {"amplitude": 0.5, "periods": 1}}, {"table": [[0, 0], [1, 0.8], [3, -0.4], [4, 0.5]]},
                                                {"ramp": {"to": 1, "begin": 0.2, "end": 0.8}}])}
        made["steps"][1]["loads"] = {name: "swing" for name in rest}
        made["steps"][1]["increments"] = 4
    elif dice.chance(0.3):
        made["steps"].append({"name": "back", "increments": dice.whole(1, 3), "loads": {name: dice.choice([0.0, -0.5, 0.3]) for name in rest}})
    weak = [key for key, c in made["contacts"].items() if key != "all" and isinstance(c.get("friction"), (int, float)) and c["friction"] > 0]
    if weak and dice.chance(0.1):
        key = dice.choice(weak)
        made["steps"].append({"name": "soften", "increments": 2, "friction": {key: short(made["contacts"][key]["friction"] * 0.7)}})


def stages(dice, scene, made):
    """The body on top is put in place in the second step, or taken away in the last one."""
    if scene.name not in ("stack", "wall") or len(made["steps"]) < 2 or made["ties"] or not dice.chance(0.12):
        return
    if any(contact.get("slip") for contact in made["contacts"].values()):
        return
    body = scene.top[0].split(".")[0]
    if dice.chance(0.6):
        made["bodies"][body]["added"] = made["steps"][1]["name"]
    else:
        made["bodies"][body]["removed"] = made["steps"][-1]["name"]
