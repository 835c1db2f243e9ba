"""Makes a model that fails smaller: bodies, loads, supports, laws, steps are left out and numbers rounded as long as the same
twin differs.

    reduce.py SCABO DIR/seed_N TWIN [-o SMALL.yaml]      TWIN: units, turned, reordered, finer; or status

With `status` only the status of the model itself is kept, for models that are not solved."""
import argparse
import copy
import pathlib
import sys
import tempfile

import yaml

import compare
import dress
from change import Change, changed
from dice import Dice, short
from outcome import run, write
from twins import finer, reordered, same_mesh_when_turned, twin_dice, twins


class Failure:
    """What is to be kept: the twin that differs, and whether by status or by forces."""

    def __init__(self, program, twin, change, folder, strict):
        self.program, self.twin, self.change, self.folder, self.strict, self.runs = program, twin, change, folder, strict, 0

    def of(self, model):
        """A word for the kind of failure; empty if there is none."""
        self.runs += 1
        base = self.solve(model, Change(), model)
        if self.twin == "status":
            return base.status
        if base.status == "refused":
            return ""
        other = self.solve(self.made(model), self.change, model)
        strict = self.strict and (self.twin != "turned" or same_mesh_when_turned(model, self.change))
        found = compare.differences(base, other, strict)
        if not found or other.status == "refused":
            return ""
        return found[0] if found[0].startswith("status") else "pairs" if "inf" in found[0] else "forces"

    def made(self, model):
        if self.twin == "finer":
            return finer(model)
        return reordered(model, Dice(1)) if self.twin == "reordered" else changed(model, self.change)

    def solve(self, model, change, base):
        path = pathlib.Path(self.folder) / "model.yaml"
        write(model, path)
        return run(self.program, path, change, base)


def smaller(model):
    """All models with one thing less, the largest things first."""
    for name in list(model["bodies"]):
        if len(model["bodies"]) > 1:
            yield without_body(model, name)
    for section in ("steps", "loads", "supports", "springs", "ties", "contacts", "contact_properties", "curves", "materials", "output", "analysis"):
        if section in model:
            yield {key: value for key, value in model.items() if key != section}
    for section in ("loads", "contacts", "ties", "materials"):
        for name in list(model.get(section, {})):
            yield edited(model, lambda m: m[section].pop(name))
    for section in ("supports", "springs", "steps"):
        for i in range(len(model.get(section, []))):
            yield edited(model, lambda m: m[section].pop(i))
    for name, body in model["bodies"].items():
        for key in ("refine", "kind"):
            if key in body.get("mesh", {}):
                yield edited(model, lambda m: m["bodies"][name]["mesh"].pop(key))
        if "mesh" in body:
            yield edited(model, lambda m: m["bodies"][name]["mesh"].update(size=short(2 * body["mesh"]["size"], 2)))
            if body["mesh"].get("order") != 2:
                yield edited(model, lambda m: m["bodies"][name]["mesh"].update(order=2))
            if body["material"] != next(iter(model["materials"])):
                yield edited(model, lambda m: m["bodies"][name].update(material=next(iter(model["materials"]))))
    for name, contact in model.get("contacts", {}).items():
        for key in contact:
            if key != "between":
                yield edited(model, lambda m: m["contacts"][name].pop(key))
        if isinstance(contact.get("friction"), dict):
            yield edited(model, lambda m: m["contacts"][name].update(friction=0.5))
    yield from rounded(model)


def rounded(model):
    for name, material in model.get("materials", {}).items():
        if material != {"young": 1e9, "poisson": 0.3, "density": 2000.0, "expansion": 1e-5}:
            yield edited(model, lambda m: m["materials"].update({name: {"young": 1e9, "poisson": 0.3, "density": 2000.0, "expansion": 1e-5}}))
    for i, step in enumerate(model.get("steps", [])):
        if step.get("increments", 1) != 1:
            yield edited(model, lambda m: m["steps"][i].update(increments=1))
    for name, load in model.get("loads", {}).items():
        for key, value in load.items():
            if isinstance(value, float) and value != short(value, 1):
                yield edited(model, lambda m: m["loads"][name].update({key: short(value, 1)}))
            if isinstance(value, list) and any(v and v != short(v, 1) for v in value):
                yield edited(model, lambda m: m["loads"][name].update({key: [short(v, 1) for v in value]}))


def edited(model, change):
    made = copy.deepcopy(model)
    change(made)
    return made


def without_body(model, name):
    made = copy.deepcopy(model)
    del made["bodies"][name]
    gone = lambda place: isinstance(place, str) and place.split(".")[0] == name
    for section in ("supports", "springs"):
        made[section] = [item for item in made.get(section, []) if not gone(item.get("on"))]
    made["loads"] = {key: load for key, load in made.get("loads", {}).items() if not gone(load.get("on"))}
    for section in ("contacts", "ties"):
        made[section] = {key: c for key, c in made.get(section, {}).items() if c["between"] == "all" or not any(map(gone, c["between"]))}
    return tidy(made)


def tidy(model):
    """Steps name only what is there, and are left out where nothing is left of them."""
    names = {*model.get("loads", {}), *(item.get("name") for key in ("supports", "springs") for item in model.get(key, []))}
    for step in model.get("steps", []):
        if "loads" in step:
            step["loads"] = {name: value for name, value in step["loads"].items() if name in names}
        if "friction" in step:
            step["friction"] = {name: value for name, value in step["friction"].items() if name in model.get("contacts", {})}
    return {key: value for key, value in model.items() if value not in ([], {})}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scabo")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("twin")
    parser.add_argument("-o", dest="output", type=pathlib.Path, default=pathlib.Path("small.yaml"))
    arguments = parser.parse_args()
    model = yaml.safe_load((arguments.folder / "base.yaml").read_text(encoding="utf-8"))
    seed = int(arguments.folder.name.split("_")[1])
    change = twins(dress.model(seed)[1], twin_dice(seed)).get(arguments.twin, (None, Change()))[1]
    with tempfile.TemporaryDirectory() as folder:
        failure = Failure(arguments.scabo, arguments.twin, change, folder, arguments.twin != "finer")
        kind = failure.of(model)
        if not kind:
            sys.exit("It does not fail.")
        print(kind)
        while True:
            for candidate in smaller(model):
                candidate = tidy(candidate)
                if candidate != model and failure.of(candidate) == kind:
                    model = candidate
                    print(failure.runs, len(model["bodies"]), "bodies", flush=True)
                    break
            else:
                break
    write(model, arguments.output)


if __name__ == "__main__":
    main()
