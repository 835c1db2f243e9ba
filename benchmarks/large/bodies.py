#!/usr/bin/env python3
"""One body of many degrees of freedom against as many degrees of freedom in many bodies: time of every stage and memory.

    benchmarks/large/bodies.py [--columns 40] [--courses 25] [--threads 1] [--only one|many|plain] [--seconds 900]
    benchmarks/large/bodies.py --only plain --columns 200 --courses 30        # 6,015 blocks, 100,000 pairs

Many: a wall in running bond on a foundation, its own weight and a push of a tenth of it, every block some 1e3 degrees of
freedom, with a coarse boundary and a fine interior. One: a single body of the size of the wall, on the same
foundation, under the same loads and with as many degrees of freedom. Both are quadtrees of order 1. Plain (not run unless asked
for): the wall of blocks that are one super-element each, on a rigid foundation. Processor seconds by stage
(measure.py); each run is ended after --seconds of processor time.
"""
import argparse
import pathlib
import sys

import measure
from measure import seconds_text
from run import STAGES

HEAD = """scabo: 1
analysis: {{plane: strain}}
materials: {{stone: {{young: 20e9, poisson: 0.2, density: 2300}}}}
bodies:
  foundation:
    material: stone
    shape: {{rectangle: {{corner: [-1, -1], size: [{width!r}, 1]}}}}
    mesh: {{kind: quadtree, size: 0.25, order: 1}}
"""
TAIL = """supports: [{on: foundation.bottom, fix: [x, y]}]
loads: {weight: {gravity: [0.981, -9.81]}}
contacts: {joints: {between: all, friction: 0.6}}
output: {fields: [displacement, stress]}
"""
BLOCK = """  {name}:
    material: stone
    shape: {{rectangle: {{corner: [{x!r}, {y!r}], size: [{width!r}, 0.5]}}}}
    mesh: {{kind: quadtree, size: 0.25, order: 1, refine: [{{near: [{cx!r}, {cy!r}], size: {fine!r}, growth: 0.25}}]}}
    repeat: {{count: [{columns}, {rows}], step: [[{step!r}, 0], [0, 1]]}}
"""

PLAIN = """  {name}:
    material: stone
    shape: {{rectangle: {{corner: [{x!r}, {y!r}], size: [{width!r}, 0.5]}}}}
    mesh: {{size: {element!r}, order: 1}}
    repeat: {{count: [{columns}, {rows}], step: [[{step!r}, 0], [0, 1]]}}
"""


def many(columns, courses, fine):
    return wall(columns, courses, HEAD.format(width=columns + 2.5), BLOCK, {"fine": fine})


def plain(columns, courses, element):
    head = HEAD.format(width=columns + 2.5).replace("    material: stone\n", "    rigid: true\n").replace("    mesh: {kind: quadtree, size: 0.25, order: 1}\n", "")
    return wall(columns, courses, head, PLAIN, {"element": element}).replace("foundation.bottom", "foundation")


def wall(columns, courses, text, block, mesh):
    odd, even = (courses + 1) // 2, courses // 2
    rows = [("whole", 0.0, 0.0, 1, columns, odd, 1), ("shifted", 0.5, 0.5, 1, columns - 1, even, 1),
            ("half", 0.0, 0.5, 0.5, 2, even, columns - 0.5)]  # courses in turn, halves at their ends
    for name, x, y, width, count, courses_of, step in rows:
        if count and courses_of:
            text += block.format(name=name, x=x, y=y, width=width, cx=x + width / 2, cy=y + 0.25, columns=count, rows=courses_of,
                                 step=step, **mesh)
    return text + TAIL


def one(columns, courses, size):
    wall = f"""  wall:
    material: stone
    shape: {{rectangle: {{corner: [0, 0], size: [{columns}, {courses / 2!r}]}}}}
    mesh: {{kind: quadtree, size: {size!r}, order: 1}}
"""
    return HEAD.format(width=columns + 2.5) + wall + TAIL


def main():
    root = pathlib.Path(__file__).resolve().parents[2]
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--scabo", default=root / "build" / "bin" / "scabo")
    options.add_argument("--columns", type=int, default=40)
    options.add_argument("--courses", type=int, default=25)
    options.add_argument("--fine", type=float, default=1 / 128, help="size of the cells in the middle of a block, m")
    options.add_argument("--size", type=float, default=1 / 32, help="size of the cells of the single body, m")
    options.add_argument("--element", type=float, default=0.1, help="length of a boundary element of plain blocks, m")
    options.add_argument("--threads", type=int, default=1)
    options.add_argument("--seconds", type=float, default=900, help="limit of a run, processor seconds")
    options.add_argument("--gigabytes", type=float, default=10, help="limit of a run, address space")
    options.add_argument("--only", choices=["one", "many", "plain"])
    options.add_argument("--model", help="write the model of one run to this file instead of running it")
    options = options.parse_args()
    models = {"many": many(options.columns, options.courses, options.fine),
              "one": one(options.columns, options.courses, options.size)}
    if options.only == "plain":
        models["plain"] = plain(options.columns, options.courses, options.element)
    if options.model:
        pathlib.Path(options.model).write_text(models[options.only or "many"], encoding="utf-8")
        return 0
    head = ["bodies", "degrees of freedom", "pairs", "iterations", *(stage.replace("_", "-") for stage in STAGES), "all, processor s", "wall, s",
            "memory, GB", "files, MB", "certificate"]
    print(measure.table(head, []))
    failed = False
    for name in [options.only] if options.only else models:
        try:
            result = measure.run(options.scabo, models[name], options.threads, options.seconds, options.gigabytes)
        except measure.Failure as failure:
            print(f"| {name} | {failure}, {failure.processor:.0f} s of processor time |", flush=True)
            failed = True
            continue
        model = result["model"]
        row = [f"{len(result['nodes_of_bodies']):,}", f"{model['dofs']:,}", f"{model['contact_pairs']:,}", sum(result["iterations"]),
               *(seconds_text(result["processor_of"][stage]) for stage in STAGES), seconds_text(result["processor"]),
               seconds_text(result["wall"]), f"{result['peak'] / 1e9:.2f}", f"{result['files'] / 1e6:.0f}", f"{result['certificate']:.0e}"]
        print("| " + " | ".join(str(entry) for entry in row) + " |", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
