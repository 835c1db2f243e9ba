#!/usr/bin/env python3
"""Towers and walls of blocks that only contact holds: certified or not, iterations of an increment, time, collapse loads.

    run.py --scabo build/bin/scabo [--output DIR] [--limit SECONDS] [--largest COURSES] [--only tower|wall|collapse]

Every run is one process with all files. The push is a part of the largest for which limit analysis finds forces that balance
every block (blocks.py). A run that takes more processor time than the limit is stopped and listed as such. Needs SciPy.
"""
import argparse
import json
import pathlib
import resource
import subprocess
import sys
import time

import blocks

TOWERS, WALLS = (10, 20, 50, 100, 200), (4, 8, 16, 24, 40)
COLLAPSE = [(1, 2, 0.3), (1, 10, 0.3), (1, 10, 1.0), (1, 50, 0.6), (1, 200, 0.6), (4, 4, 0.3), (4, 4, 1.0), (8, 8, 0.3),
            (8, 8, 0.6), (8, 8, 1.0)]


def run(options, columns, courses, friction, part, increments):
    """Status, iterations of every increment, the worst figure of their certificates, wall and processor seconds."""
    folder = pathlib.Path(options.output)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{columns}_{courses}_{friction}_{part}_{increments}.yaml"
    path.write_text(blocks.model(columns, courses, friction, part * blocks.limit_load(columns, courses, friction),
                                 increments))
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    process = subprocess.Popen([options.scabo, "run", path, "-q", "-o", path.with_suffix(".results")],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (options.limit, options.limit)))
    if process.wait() < 0:
        return "over the limit", [], None, time.monotonic() - start, None
    seconds = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    summary = json.loads((path.with_suffix(".results") / "summary.json").read_text())
    done = [increment for increment in summary["increments"] if increment["converged"]]
    worst = max((max(v for v in increment["certificate"].values()) for increment in done), default=None)
    return (summary["status"], [increment["newton_iterations"] for increment in done], worst, seconds,
            after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def table(options, kind):
    print("| blocks | columns x courses | mu | push | increments | status | iterations, worst | certificate | wall s | processor s |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    sizes = [(1, n) for n in TOWERS] if kind == "tower" else [(n, n) for n in WALLS]
    for columns, courses in sizes:
        if courses > options.largest:
            continue
        for friction in (0.3, 0.6, 1.0):
            for part, increments in ((0.0, 1), (0.5, 1), (0.9, 1), (0.99, 1), (0.99, 10)):
                status, iterations, worst, wall, processor = run(options, columns, courses, friction, part, increments)
                text = [str(blocks.blocks(columns, courses)), f"{columns} x {courses}", f"{friction}", f"{part}", f"{increments}",
                        status, str(max(iterations, default="-")), f"{worst:.1e}" if worst is not None else "-",
                        f"{wall:.2f}", f"{processor:.2f}" if processor is not None else "-"]
                print("| " + " | ".join(text) + " |", flush=True)


def collapse(options):
    """The largest push that is solved, by bisection, over that of limit analysis."""
    print("| blocks | mu | limit load over that of the whole | collapse load over the limit load: solved to, not from |")
    print("|---|---|---|---|")
    for columns, courses, friction in COLLAPSE:
        low, high = 0.5, 1.1
        while high - low > 2e-3:
            middle = 0.5 * (low + high)
            status = run(options, columns, courses, friction, middle, 1)[0]
            low, high = (middle, high) if status == "solved" else (low, middle)
        status = run(options, columns, courses, friction, high, 1)[0]
        whole = blocks.limit_load(columns, courses, friction) / blocks.collapse_load(columns, courses, friction)
        print(f"| {columns} x {courses} | {friction} | {whole:.3f} | {low:.3f}, {high:.3f} ({status}) |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scabo", default="build/bin/scabo")
    parser.add_argument("--output", default="build/bench-blocks")
    parser.add_argument("--limit", type=int, default=60)
    parser.add_argument("--largest", type=int, default=10**6)
    parser.add_argument("--only", choices=["tower", "wall", "collapse"])
    options = parser.parse_args()
    for kind in ("tower", "wall"):
        if options.only in (None, kind):
            table(options, kind)
    if options.only in (None, "collapse"):
        collapse(options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
