"""One run of the program, and its results in the units and axes of the model from which a twin was made."""
import csv
import dataclasses
import json
import math
import os
import pathlib
import re
import resource
import subprocess

import yaml

import geometry

STATUS = {1: "refused", 3: "failed"}
SECONDS = 300  # of the processor, then a run counts as endless; no speed is judged


@dataclasses.dataclass
class Outcome:
    status: str                    # as in summary.json, or refused, failed, endless, crashed
    reason: str = ""
    warnings: dict = dataclasses.field(default_factory=dict)   # by kind
    increments: list = dataclasses.field(default_factory=list)
    pairs: dict = dataclasses.field(default_factory=dict)      # by increment and contact: rows (x, y, normal, tangential, gap with displacements)
    gap: float = 0.0               # the largest that the model gives
    cells: int = 0
    seconds: float = 0.0


def write(model, path):
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        yaml.safe_dump(model, file, sort_keys=False, default_flow_style=None, width=150)


def run(program, path, change, base, *options):
    """Runs a model; `base` is the one that `change` was applied to."""
    results = path.with_suffix(".results")
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    command = [program, "run", str(path), "-o", str(results), "--quiet", "--threads", "1", *options]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    ended = subprocess.run(command, env=environment, text=True, capture_output=True, stdin=subprocess.DEVNULL, preexec_fn=limit)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if ended.returncode < 0:
        return Outcome("endless" if seconds > 0.9 * SECONDS else "crashed", f"signal {-ended.returncode}", seconds=seconds)
    if ended.returncode in STATUS:
        return Outcome(STATUS[ended.returncode], message(ended.stderr), seconds=seconds)
    outcome = read(results, change, base)
    outcome.seconds = seconds
    return outcome


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 5))


def message(text):
    """What went wrong, without the name of the file."""
    lines = [re.sub(r"^\S*\.yaml(:\d+)*:? *", "", line) for line in text.strip().splitlines()]
    return " | ".join(lines[:3])


def read(results, change, base):
    summary = json.loads((results / "summary.json").read_text(encoding="utf-8"))
    keys = {contact["name"]: key_of(contact["between"], change, base) for contact in summary["model"]["contacts"]}
    together = held_together(base)
    found = Outcome(summary["status"], summary["reason"] or "", cells=summary["model"]["super_elements"])
    for kind, text in zip(summary["warning_kinds"], summary["warnings"]):
        found.warnings[kind] = found.warnings.get(kind, "") + text
    found.loose = not_unique(keys, found.warnings.get("undetermined_force", ""))
    for increment in summary["increments"]:
        if increment["converged"]:
            found.increments.append(forces_of(increment, keys, together, change))
    found.last = tuple(summary["increments"][-1][key] for key in ("step", "increment")) if summary["increments"] else (0, 0)
    found.gap = max((abs(contact.get("gap", 0.0)) for contact in base.get("contacts", {}).values()), default=0.0)
    read_pairs(results / "contact.csv", keys, change, found)
    return found


def not_unique(keys, warning):
    """The contacts that a warning calls not unique: those that it names, or all where it names only the first of them."""
    if re.search(r"' and \d+ more\b", warning):
        return set(keys.values())
    return {key for name, key in keys.items() if re.search(rf"\b{re.escape(name)}\b", warning)}


def key_of(between, change, base):
    """The places of a contact by their names in `base`, whichever is first."""
    back = {change.place(base, place): place for place in every_edge(base)} if change.quarters else {}
    return " ".join(sorted(back.get(place, place) for place in between))


def every_edge(model):
    return [f"{name}.{edge}" for name, body in model["bodies"].items() if "rectangle" in body["shape"]
            for edge in ("bottom", "right", "top", "left")]


def held_together(model):
    """Supports that hold a corner together, by name, each with the name of their group: only the sum of their reactions there
    is unique. A corner of a body is that of all bodies to which it is tied."""
    parts = Groups()
    for tie in model.get("ties", {}).values():
        parts.join(*(place.split(".")[0] for place in tie["between"]))
    groups, holder = Groups(), {}
    for name, body, edge in held_edges(model):
        for corner in (edge.start, edge.end):
            key = parts.of(body), tuple(round(x, 9) + 0.0 for x in corner)
            groups.join(holder.setdefault(key, name), name)
    return {name: groups.of(name) for name in groups.above}


def held_edges(model):
    """Of the model from which twins are made: the name of a support, its body and its edge; lines of symmetry hold every edge
    that lies on them."""
    edges = [(body, name, edge) for body, of in model["bodies"].items() for name, edge in geometry.edges(of["shape"]).items()]
    for support in model.get("supports", []):
        for axis, value in support.get("symmetry", {}).items():
            on_line = [point["xy".index(axis)] == value for _, _, edge in edges for point in (edge.start, edge.end)]
            yield from ((f"{body}.{name}", body, edge) for (body, name, edge), start, end in zip(edges, on_line[::2], on_line[1::2])
                        if edge.straight and start and end)
        yield from ((support["name"], body, edge) for body, name, edge in edges if support.get("on") == f"{body}.{name}")


class Groups:
    """What has been joined, however indirectly, has the same representative."""

    def __init__(self):
        self.above = {}

    def of(self, one):
        above = self.above.setdefault(one, one)
        return one if above == one else self.of(above)

    def join(self, *members):
        for member in members:
            self.above[self.of(member)] = self.of(members[0])


def forces_of(increment, keys, together, change):
    """Of an increment: resultants of contacts, and forces of supports and springs."""
    force = lambda v: change.back(v, change.force)
    contacts = {}
    for name, of in increment["contacts"].items():
        value = {"normal": of["normal_force"] / change.force, "tangential": of["tangential_force"] / change.force}
        contacts[keys[name]] = {**value, "size": sum(abs(f) for f in value.values()), "broken": of.get("broken", 0)}
    single = {name: force(v) for name, v in {**increment["reactions"], **increment.get("springs", {})}.items()}
    supports = {}
    for name, v in single.items():
        group = together.get(name, name)
        supports[group] = [one + other for one, other in zip(supports.get(group, (0.0, 0.0)), v)]
    return {"step": increment["step"], "increment": increment["increment"], "end": increment["reached"] == 1, "contacts": contacts,
            "supports": supports, "largest_of_supports": max((math.hypot(*v) for v in single.values()), default=0.0)}


def read_pairs(path, keys, change, found):
    if not path.exists():
        return
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            key = int(row["step"]), int(row["increment"]), keys[row["contact"]]
            place = change.point_back([float(row["x"]), float(row["y"])])
            forces = [float(row[name]) / change.force for name in ("normal_force", "tangential_force")]
            along_normal = [float(row[name]) / change.length for name in ("gap", "normal_displacement_a", "normal_displacement_b")]
            found.pairs.setdefault(key, []).append((*place, *forces, sum(map(abs, along_normal))))
