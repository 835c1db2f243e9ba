#!/usr/bin/env python3
"""One body of many degrees of freedom against as many degrees of freedom in many bodies: time of every stage and memory.

    benchmarks/large/bodies.py [--columns 40] [--courses 25] [--threads 2] [--only one|many]

Many: a wall in running bond on a foundation, its own weight and a push of a tenth of it, every block some 1e3 degrees of
freedom, with a coarse boundary and a fine interior. One: a single body of the size of the wall, on the same
foundation, under the same loads and with as many degrees of freedom. Both are quadtrees of order 1. Wall seconds by
stage, as in summary.json; processor seconds of the whole process.
"""
import argparse
import os
import pathlib
import sys

import run

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


def many(columns, courses, fine):
    text = HEAD.format(width=columns + 2.5)
    odd, even = (courses + 1) // 2, courses // 2
    rows = [("whole", 0.0, 0.0, 1, columns, odd, 1), ("shifted", 0.5, 0.5, 1, columns - 1, even, 1),
            ("half", 0.0, 0.5, 0.5, 2, even, columns - 0.5)]  # courses in turn, halves at their ends
    for name, x, y, width, count, courses_of, step in rows:
        if count and courses_of:
            text += BLOCK.format(name=name, x=x, y=y, width=width, cx=x + width / 2, cy=y + 0.25, fine=fine, columns=count,
                                 rows=courses_of, step=step)
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
    options.add_argument("--threads", type=int, default=os.cpu_count())
    options.add_argument("--only", choices=["one", "many"])
    options.add_argument("--model", help="write the model of one run to this file instead of running it")
    options = options.parse_args()
    models = {"many": many(options.columns, options.courses, options.fine),
              "one": one(options.columns, options.courses, options.size)}
    if options.model:
        pathlib.Path(options.model).write_text(models[options.only or "many"], encoding="utf-8")
        return 0
    head = ["bodies", "degrees of freedom", "pairs", "iterations", *(s.replace("_", "-") for s in run.STAGES), "total, wall",
            "processor", "memory, GB", "files, MB"]
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    failed = False
    for name in [options.only] if options.only else models:
        summary, reason = run.run(options.scabo, models[name], options.threads)
        if summary is None:
            print(f"| {name} | {reason} |", flush=True)
            failed = True
            continue
        timing, model = summary["timing"], summary["model"]
        row = [len(model["bodies"]), model["dofs"], model["contact_pairs"],
               sum(increment["newton_iterations"] for increment in summary["increments"]),
               *(run.seconds(timing[s]) for s in run.STAGES), run.seconds(timing["total"]), run.seconds(summary["processor"]),
               f"{summary['peak_memory_bytes'] / 1e9:.2f}", f"{summary['written'] / 1e6:.0f}"]
        print("| " + " | ".join(str(entry) for entry in row) + " |", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
