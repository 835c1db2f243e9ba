#!/usr/bin/env python3
"""Towers and walls of blocks that only contact holds: certified or not, iterations of an increment, time, collapse loads.

    run.py --scabo build/bin/scabo [--output DIR] [--limit SECONDS] [--only tower|wall|shaken|collapse]
           [--sizes 4,8,16] [--friction 0.3,0.6,1] [--parts 0,0.5,0.9] [--increments 1,10] [--keep]

Every run is one process with all files. The push is a part of the largest for which limit analysis finds forces that balance
every block (blocks.py); `shaken`: of the largest acceleration, and 0.35 g. A run that takes more processor time than the limit
is stopped and listed as such; walls of 40 x 40 blocks get twice the limit. Limit loads are kept in DIR/limits.json. With
`--keep` the rows of towers and walls are kept in DIR/rows.json as they come, and those that are there are not run again: of one
program, of which the file has a digest. Needs SciPy.
"""
import argparse
import collections
import hashlib
import json
import pathlib
import resource
import subprocess
import sys
import time

import blocks

TOWERS, WALLS = (10, 20, 50, 100, 200), (4, 8, 16, 24, 40)
FRICTION, PARTS, INCREMENTS = (0.3, 0.6, 1.0), (0.0, 0.5, 0.9, 0.95, 0.99), (1, 10)
COLLAPSE = [(1, 2, 0.3), (1, 10, 0.3), (1, 10, 1.0), (1, 50, 0.6), (1, 200, 0.6), (4, 4, 0.3), (4, 4, 1.0), (8, 8, 0.3),
            (8, 8, 0.6), (8, 8, 1.0)]
SHAKEN = [(1, 1), (1, 2), (1, 4), (4, 4), (8, 8), (16, 16)]


def limit_load(options, *wall, shaken=False):
    """blocks.limit_load, kept in a file: the linear programme of a large wall takes longer than the wall itself."""
    file = pathlib.Path(options.output) / "limits.json"
    known = json.loads(file.read_text()) if file.exists() else {}
    name = " ".join(map(str, wall)) + " shaken" * shaken
    if name not in known:
        known[name] = blocks.limit_load(*wall, shaken=shaken)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(known, indent=1))
    return known[name]


def run(options, columns, courses, friction, push, increments, shaken=False):
    """Status, iterations of every increment, the worst figure of their certificates, wall and processor seconds, reason."""
    folder = pathlib.Path(options.output)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{'shaken_' * shaken}{columns}_{courses}_{friction}_{push:.6g}_{increments}.yaml"
    path.write_text(blocks.model(columns, courses, friction, push, increments, shaken))
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    limit = options.limit * (2 if columns >= 40 else 1)
    process = subprocess.Popen([options.scabo, "run", path, "-q", "-o", path.with_suffix(".results")],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)))
    status = process.wait()
    seconds = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if status < 0:
        return "over the limit", [], None, seconds, processor, ""
    summary = json.loads((path.with_suffix(".results") / "summary.json").read_text())
    done = [increment for increment in summary["increments"] if increment["converged"]]
    worst = max((max(v for v in increment["certificate"].values()) for increment in done), default=None)
    return (summary["status"], [increment["newton_iterations"] for increment in done], worst, seconds, processor,
            summary["reason"] or "")


def kept(options, *wall):
    """run(), or what it gave before where rows are kept."""
    if not options.keep:
        return run(options, *wall)
    file = pathlib.Path(options.output) / "rows.json"
    program = hashlib.sha256(pathlib.Path(options.scabo).read_bytes()).hexdigest()[:16]
    rows = json.loads(file.read_text()) if file.exists() else {}
    if rows.get("program", program) != program:
        sys.exit(f"{file} is of another program")
    name = " ".join(f"{value:.6g}" for value in wall)
    if name not in rows:
        rows = {"program": program, **rows, name: run(options, *wall)}
        file.write_text(json.dumps(rows, indent=0))
    return rows[name]


def table(options, kind):
    print("| blocks | columns x courses | mu | push | increments | status | iterations, worst | in all | certificate | wall s "
          "| processor s |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    counts = collections.Counter()
    sizes = [(1, n) for n in TOWERS] if kind == "tower" else [(n, n) for n in WALLS]
    for columns, courses in sizes:
        if options.sizes and courses not in options.sizes:
            continue
        for friction in options.friction:
            for increments in options.increments:
                for part in options.parts:
                    if part == 0.0 and increments > 1:
                        continue
                    push = part * limit_load(options, columns, courses, friction)
                    status, iterations, worst, wall, processor, _ = kept(options, columns, courses, friction, push, increments)
                    counts[status] += 1
                    text = [str(blocks.blocks(columns, courses)), f"{columns} x {courses}", f"{friction}", f"{part}",
                            f"{increments}", status, str(max(iterations, default="-")), str(sum(iterations) or "-"),
                            f"{worst:.1e}" if worst is not None else "-", f"{wall:.2f}", f"{processor:.2f}"]
                    print("| " + " | ".join(text) + " |", flush=True)
    print("\n" + ", ".join(f"{count} {status}" for status, count in counts.most_common()))


def shaken(options):
    """Blocks, towers and walls that are accelerated along the wall: by 0.35 g, and just below and above what statics says."""
    print("| columns x courses | mu | limit, g | acceleration, g | status | iterations | certificate | processor s |")
    print("|---|---|---|---|---|---|---|---|")
    for columns, courses in SHAKEN:
        if options.sizes and courses not in options.sizes:
            continue
        for friction in options.friction:
            limit = limit_load(options, columns, courses, friction, shaken=True)
            for acceleration in (0.35, 0.99 * limit, 1.01 * limit):
                status, iterations, worst, _, processor, _ = run(options, columns, courses, friction, acceleration, 1, True)
                print(f"| {columns} x {courses} | {friction} | {limit:.4f} | {acceleration:.4f} | {status} | "
                      f"{max(iterations, default='-')} | {'-' if worst is None else format(worst, '.1e')} | {processor:.2f} |",
                      flush=True)


def collapse(options):
    """The largest push that is solved, by bisection, over that of limit analysis."""
    print("| blocks | mu | limit load over that of the whole | collapse load over the limit load: solved to, not from |")
    print("|---|---|---|---|")
    for columns, courses, friction in COLLAPSE:
        if options.sizes and courses not in options.sizes:
            continue
        limit = limit_load(options, columns, courses, friction)
        low, high = 0.5, 1.1
        while high - low > 2e-3:
            middle = 0.5 * (low + high)
            status = run(options, columns, courses, friction, middle * limit, 1)[0]
            low, high = (middle, high) if status == "solved" else (low, middle)
        status = run(options, columns, courses, friction, high * limit, 1)[0]
        whole = limit / blocks.collapse_load(columns, courses, friction)
        print(f"| {columns} x {courses} | {friction} | {whole:.3f} | {low:.3f}, {high:.3f} ({status}) |", flush=True)


def numbers(kind):
    return lambda text: tuple(kind(word) for word in text.split(","))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scabo", default="build/bin/scabo")
    parser.add_argument("--output", default="build/bench-blocks")
    parser.add_argument("--limit", type=int, default=60)
    parser.add_argument("--sizes", type=numbers(int), default=())
    parser.add_argument("--friction", type=numbers(float), default=FRICTION)
    parser.add_argument("--parts", type=numbers(float), default=PARTS)
    parser.add_argument("--increments", type=numbers(int), default=INCREMENTS)
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--only", choices=["tower", "wall", "shaken", "collapse"])
    options = parser.parse_args()
    for kind in ("tower", "wall"):
        if options.only in (None, kind):
            table(options, kind)
    if options.only in (None, "shaken"):
        shaken(options)
    if options.only in (None, "collapse"):
        collapse(options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
