#!/usr/bin/env python3
"""Estimates that `scabo run` makes before the work (src/scabo/run/plan.hpp), against memory and processor time measured afterwards; and
their constants, found from such figures.

    benchmarks/plan.py [--scabo build/bin/scabo] [--largest DOFS] [--runs build/bench-large/runs.json] [--fit] [--keep FILE]

Runs the models MESHES, one thread, and takes the runs that benchmarks/large/run.py has kept besides. Prints measured figures and, for
every stage, estimate / measured (of stages of 0.05 s and more; each within a factor of two is the aim). --keep writes the runs of MESHES
to a file, which --runs takes too.

--fit chooses the constants of times that make the sum of log(estimate / measured)^2 least, stage by stage, and writes them into
plan.hpp with two digits. The formulas stand here a second time for that; they are compared with the estimates of the
program first. Constants that no run here depends on stay.
"""
import argparse
import json
import math
import pathlib
import re
import sys

import numpy
import scipy.optimize

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "benchmarks" / "large"))
import measure  # noqa: E402
import run as large  # noqa: E402

HEADER = ROOT / "src" / "scabo" / "run" / "plan.hpp"
MODEL = """scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 210e9, poisson: 0.3}}}}
bodies:
  upper: {{material: steel, shape: {{rectangle: {{corner: [0, 1], size: [{width}, 1]}}}}, mesh: {{{mesh}}}}}
  lower: {{material: steel, shape: {{rectangle: {{corner: [-1, -1], size: [4, 2]}}}}, mesh: {{{mesh}}}}}
supports: [{{on: lower.bottom, fix: [x, y]}}]
loads: {{down: {{on: upper.top, pressure: 100e6}}, push: {{on: upper.left, traction: [1e6, 0]}}}}
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: 0.5}}}}
"""
MESHES = [  # degrees of freedom (about), kind, mesh, width of the contact
    (1_200, "superelement", "size: 0.05", 1),
    (4_900, "quadtree", "kind: quadtree, size: 0.0625, order: 1", 1),
    (12_000, "polygons", "kind: polygons, size: 0.05, order: 2", 1),
    (2_600, "superelement", "size: 0.025", 1),
    (3_600, "superelement", "size: 0.02", 2),
    (5_900, "superelement", "size: 0.0125", 2),
    (60_000, "quadtree", "kind: quadtree, size: 0.03125, order: 2", 1),
    (220_000, "quadtree", "kind: quadtree, size: 0.015625, order: 2", 1),
    (840_000, "quadtree", "kind: quadtree, size: 0.0078125, order: 2", 0.5),
]
STAGES = ("mesh", "super_elements", "factorise", "condense", "increments", "fields")
MEASURABLE = 0.05    # s
BLOCKS = 4           # symmetry blocks of the rectangles that are one super-element


def measured_of(run):
    of = run["processor_of"]
    return {"mesh": of["mesh"], "super_elements": of["super_elements"] + of["assemble"], "factorise": of["factorise"],
            "condense": of["condense"], "increments": of["newton"], "fields": of["fields"]}


def terms_of(run, costs):
    """stage -> {constant: what it is multiplied by; "": what does not depend on the constants to be found}, and the same for memory."""
    pairs, one = run["model"]["contact_pairs"], run["kind"] == "superelement"
    stages, memory = {stage: {} for stage in STAGES}, {"base_bytes": 1.0}

    def add(where, constant, value):
        where[constant] = where.get(constant, 0.0) + value

    known = set()  # equal bodies are one super-element
    for n in (2.0 * nodes for nodes in run["nodes_of_bodies"]):
        k, log = min(2.0 * pairs, n), math.log2(n)
        if one:
            is_new, b = n not in known, BLOCKS
            known.add(n)
            add(memory, "", 8.0 * n * n)
            if is_new:
                add(memory, "block_bytes", n * n / b)
                add(stages["super_elements"], "dense_seconds", n**3 / b**2)
                add(stages["fields"], "dense_field_seconds", n**3 / b**2)
            add(stages["factorise"], "dense_factor_seconds", n**3)
            add(stages["condense"], "dense_condense_seconds", n * n * k)
        else:
            add(memory, "sparse_bytes", n)
            add(memory, "fill_bytes", n * log)
            add(stages["mesh"], "fem_mesh_seconds" if run["kind"] == "fem" else "mesh_seconds", n)
            add(stages["super_elements"], "cell_seconds", n)
            if run["kind"] == "polygons":
                add(memory, "own_cell_bytes", n)
                add(stages["mesh"], "own_mesh_seconds", n)
                add(stages["super_elements"], "own_cell_seconds", n)
                add(stages["factorise"], "own_factor_seconds", n**1.5)
                add(stages["fields"], "own_field_seconds", n)
            add(stages["factorise"], "order_seconds", n * log)
            add(stages["factorise"], "factor_seconds", n**1.5)
            add(stages["condense"], "sweep_seconds", n)
            add(stages["condense"], "condense_seconds", k * math.sqrt(n))
            add(stages["condense"], "flexibility_seconds", k * k)
            add(stages["increments"], "solve_seconds", 2.0 * n * log)
        add(stages["fields"], "fem_field_seconds" if run["kind"] == "fem" else "field_seconds", n)
    components = 2.0 * pairs
    add(memory, "contact_bytes", min(2.0 * components**2, components**2))
    add(stages["increments"], "contact_seconds", components**2)  # two bodies
    return stages, memory


def value_of(terms, costs):
    return sum(factor * (costs[name] if name else 1.0) for name, factor in terms.items())


def check_formulas(runs, costs):
    for run in runs:
        stages, memory = terms_of(run, costs)
        for name, terms, theirs in [(stage, stages[stage], run["plan"]["stages"][stage]) for stage in STAGES] + [("bytes", memory, run["plan"]["bytes"])]:
            ours = value_of(terms, costs)
            if abs(ours - theirs) > 1e-6 * abs(theirs) + 1e-12:
                sys.exit(f"plan.py: {name} of {run['name']}: the program estimates {theirs:g}, the formulas here give {ours:g}; was the program "
                         "built with other constants?")


def fit(lines, costs):
    """Least (log(estimate / measured))^2 over lines of (terms, measured): too much and too little count alike."""
    names = sorted({name for terms, _ in lines for name in terms if name})
    start = numpy.log([max(costs[name], 1e-12) for name in names])

    def residuals(logs):
        now = {**costs, **dict(zip(names, numpy.exp(logs)))}
        return [math.log(value_of(terms, now) / measured) for terms, measured in lines]

    found = scipy.optimize.least_squares(residuals, start, bounds=(start - 7.0, start + 12.0))
    return {name: float(f"{math.exp(value):.1e}") for name, value in zip(names, found.x)}


def fitted(runs, costs):
    """The constants of memory stay: too much of it is better than too little, as a machine that seems large enough must be."""
    costs = dict(costs)
    costs["order_seconds"] = costs["order_seconds"] or 1e-7
    for stage in STAGES:
        lines = []
        for run in runs:
            measured, terms = measured_of(run)[stage], terms_of(run, costs)[0][stage]
            if measured >= MEASURABLE and any(terms):  # some constant
                lines.append((terms, measured))
        costs.update(fit(lines, costs))
    return costs


def constants_in(text):
    return {name: float(value) for name, value in re.findall(r"^  double (\w+) = ([-+.\de]+);", text[:text.index("struct Plan")], re.MULTILINE)}


def with_constants(text, costs, before):
    for name, value in costs.items():
        if value == before[name]:
            continue
        number = f"{value:.0f}.0" if 1.0 <= value < 1e5 else f"{value:.1e}".replace("e-0", "e-").replace("e+0", "e").replace(".0e", "e")
        text = re.sub(rf"^(  double {name} = )[-+.\de]+;( *)///<", lambda at: (at[1] + number + ";").ljust(44) + "///<", text, flags=re.MULTILINE)
    return text


def size_text(value):
    return f"{value / 1e9:.2f} GB" if value >= 1e9 else f"{value / 1e6:.0f} MB"


def print_table(runs, costs, title):
    print(f"\n{title}\n")
    rows, all_ratios = [], {}
    for run in sorted(runs, key=lambda run: run["model"]["dofs"]):
        stages, memory = terms_of(run, costs)
        estimates, measured = {stage: value_of(stages[stage], costs) for stage in STAGES}, measured_of(run)
        ratios = {"memory": value_of(memory, costs) / run["peak"], "time": sum(estimates.values()) / run["processor"]}
        for stage in STAGES:
            ratios[stage] = estimates[stage] / measured[stage] if measured[stage] >= MEASURABLE else None
        for name, ratio in ratios.items():
            all_ratios.setdefault(name, []).extend([ratio] if ratio else [])
        rows.append([run["name"], f"{run['model']['dofs']:,}", f"{run['model']['contact_pairs']:,}", size_text(run["peak"]), f"{run['processor']:.1f} s",
                     *(f"{ratios[name]:.2f}" if ratios[name] else "-" for name in ("memory", "time", *STAGES))])
    names = ["memory", "time", *(stage.replace("_", "-") for stage in STAGES)]
    print(measure.table(["mesh", "degrees of freedom", "pairs", "memory, measured", "time, measured", *names], rows))
    within = {name: f"{sum(0.5 <= ratio <= 2.0 for ratio in ratios)} of {len(ratios)}" for name, ratios in all_ratios.items()}
    print("\nWithin a factor of two: " + ", ".join(f"{name} {text}" for name, text in within.items()) + ".")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--scabo", default=ROOT / "build" / "bin" / "scabo")
    options.add_argument("--largest", type=float, default=1e6, help="degrees of freedom of the models that are run here; 0: none")
    options.add_argument("--runs", type=pathlib.Path, action="append", default=[], help="runs.json of benchmarks/large/run.py, or of --keep")
    options.add_argument("--keep", type=pathlib.Path)
    options.add_argument("--fit", action="store_true")
    options = options.parse_args()
    runs = []
    for path in options.runs:
        for run in json.loads(path.read_text(encoding="utf-8")):
            if len(run["iterations"]) == 1:  # of several increments `newton` is not known
                runs.append({**run, "name": run["name"] if isinstance(run["name"], str) else f"{run['kind']}, order 2"})
    here = []
    for dofs, kind, mesh, width in MESHES:
        if dofs > options.largest:
            continue
        try:
            run = measure.run(options.scabo, MODEL.format(mesh=mesh, width=width))
        except measure.Failure as failure:
            sys.exit(f"plan.py: {mesh}: {failure}")
        here.append({"name": mesh, "kind": kind, **run})
        if options.keep:
            options.keep.write_text(json.dumps(here, indent=1))
    runs += here
    large.settle([(run["kind"], run) for run in runs])
    text = HEADER.read_text(encoding="utf-8")
    costs = constants_in(text)
    check_formulas(here, costs)  # kept runs may be of a program with other constants
    print_table(runs, costs, "Estimate / measured:")
    if options.fit:
        found = fitted(runs, costs)
        print_table(runs, found, "Estimate / measured, with the constants found:")
        print()
        for name, value in found.items():
            if value != costs[name]:
                print(f"{name}: {costs[name]:g} -> {value:g}")
        HEADER.write_text(with_constants(text, found, costs), encoding="utf-8")


if __name__ == "__main__":
    main()
