#!/usr/bin/env python3
"""Time of every stage and memory of `scabo run` from 1e4 to 2e6 degrees of freedom with 32 to 3,000 contact pairs, and the limits that
were set for them.

    benchmarks/large/run.py [--most 1e5] [--kinds fem,quadtree,polygons] [--pairs 32,300] [--threads 1]
                            [--sparse build/bin/large_sparse] [--output build/bench-large]

Two rectangles in frictional contact (models.py), one increment, all files written. Stages are processor seconds (measure.py), one thread
unless --threads says more. "fields" is everything after Newton: pressures, recovery, compression, files.

X = (factorise + condense + newton) / (factorise + solve): the contact problem beside the same bodies without contact. The solve is a part
of the factorisation: the one that `large_sparse` measures here for the same numbers of degrees of freedom (--sparse; make bench-large
builds it), or without it that of an earlier measurement (SOLVE).

No run holds up the others: each has a limit of processor time and memory (--seconds, --gigabytes), all together one of processor time
(--total). What was left out for it is named. After every run --output holds runs.json (all figures of all runs) and table.md; --resume
takes the runs that are there, so that a benchmark that was interrupted goes on.

Assembly and factorisation take turns, body by body. The processor seconds of both together are measured; their shares are known only by
their wall seconds, which other work on the machine falsifies. Assembly is therefore taken as the median, over the runs of one kind of mesh
with 1e6 degrees of freedom and more (or all, if there are none), of its seconds for a degree of freedom.
"""
import argparse
import datetime
import json
import math
import os
import pathlib
import subprocess
import sys

import numpy

import measure
from measure import seconds_text
from models import DOFS, KINDS, PAIRS, model_of, possible

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASES = {  # degrees of freedom: numbers of pairs; finite elements whole, of the others what differs
    "fem": {1e4: PAIRS, 1e5: PAIRS, 1e6: PAIRS, 2e6: PAIRS},
    "quadtree": {1e4: (32, 300), 1e5: (32, 300, 1000), 1e6: PAIRS, 2e6: (32, 300)},
    "polygons": {1e4: (300,), 1e5: (300,), 1e6: (300,), 2e6: (300,)},
}
STAGES = ("mesh", "super_elements", "assemble", "factorise", "condense", "newton", "fields")
SOLVE = [(1e4, 0.0021 / 0.027), (1e5, 0.026 / 0.396), (1e6, 0.299 / 5.79)]  # degrees of freedom, solve / factorise
LIMITS_OF_X = {32: 1.1, 300: 1.2, 1000: 1.5, 3000: 3.0}
MEASURABLE = 0.05   # s: less of a stage is not compared
INCREMENTS = 11     # of the runs for the next increment


def solves(sparse, sizes):
    """(degrees of freedom, solve / factorise) from `large_sparse`, one thread; it is ended before it condenses many pairs."""
    found = []
    for dofs in sizes:
        process = subprocess.Popen([str(sparse), f"{dofs:.0f}", "1"], stdout=subprocess.PIPE, text=True)
        lines = []
        for line in process.stdout:
            lines.append(line)
            if "pairs:" in line:
                break
        process.kill()
        process.stdout.close()
        process.wait()
        words = lines[0].replace(",", "").split()
        factorise, solve = float(words[words.index("together") + 1]), float(words[words.index("solve") + 1])
        found.append((float(words[0]), solve / factorise))
        print(f"large_sparse: {words[0]} degrees of freedom, factorise {factorise:.3f} s, solve {solve:.4f} s, {solve / factorise:.3f}", flush=True)
    return found


def settle(runs):
    """Shares of assembly and factorisation; see the head of this file. `runs`: [(kind, result)]."""
    for kind in {kind for kind, _ in runs}:
        of_kind = [result for k, result in runs if k == kind]
        for result in of_kind:
            of = result["processor_of"]
            result.setdefault("assemble_and_factorise", of["assemble"] + of["factorise"])
            result.setdefault("share", of["assemble"] / max(result["assemble_and_factorise"], 1e-9))
        large = [result for result in of_kind if result["model"]["dofs"] > 8e5] or of_kind
        rate = numpy.median([result["share"] * result["assemble_and_factorise"] / result["model"]["dofs"] for result in large])
        for result in of_kind:
            both = result["assemble_and_factorise"]
            result["processor_of"]["assemble"] = min(rate * result["model"]["dofs"], 0.9 * both)
            result["processor_of"]["factorise"] = both - result["processor_of"]["assemble"]


def x_of(result, ratios):
    of = result["processor_of"]
    if of["factorise"] < MEASURABLE:
        return math.nan
    part = numpy.interp(math.log(result["model"]["dofs"]), [math.log(n) for n, _ in ratios], [r for _, r in ratios])
    return (of["factorise"] + of["condense"] + of["newton"]) / (of["factorise"] * (1 + part))


HEAD = ["mesh", "degrees of freedom", "pairs", *(stage.replace("_", "-") for stage in STAGES), "all, processor s", "wall, s", "memory, GB",
        "files, MB", "iterations (on fewer pairs)", "certificate", "X"]


def row_of(kind, result, ratios):
    X, of = x_of(result, ratios), result["processor_of"]
    return [kind, f"{result['model']['dofs']:,}", f"{result['model']['contact_pairs']:,}", *(seconds_text(of[stage]) for stage in STAGES),
            seconds_text(result["processor"]), seconds_text(result["wall"]), f"{result['peak'] / 1e9:.2f}", f"{result['files'] / 1e6:.0f}",
            f"{sum(result['iterations'])} ({sum(result['coarse_iterations'])})", f"{result['certificate']:.0e}",
            f"{X:.2f}" if math.isfinite(X) else "-"]


def exponents(runs):
    """Exponent p of value ~ (degrees of freedom)^p between runs of one kind with the same number of pairs."""
    measures = [("all", lambda r: r["processor"]), ("memory", lambda r: r["peak"])]
    measures += [(stage.replace("_", "-"), lambda r, stage=stage: r["processor_of"][stage]) for stage in STAGES]
    rows = []
    for (kind, dofs, pairs), small in runs.items():
        larger = [n for n in DOFS if n > dofs and (kind, n, pairs) in runs]
        if not larger:
            continue
        large = runs[kind, larger[0], pairs]
        ratio = math.log(large["model"]["dofs"] / small["model"]["dofs"])
        growth = lambda a, b, least: f"{math.log(b / a) / ratio:.2f}" if a > least else "-"
        rows.append([kind, pairs, f"{dofs:.0e} to {larger[0]:.0e}".replace("e+0", "e"),
                     *(growth(value(small), value(large), MEASURABLE) for _, value in measures)])
    return measure.table(["mesh", "pairs", "degrees of freedom", *(name for name, _ in measures)], rows) if rows else ""


def verdicts(runs, increments, ratios):
    """Rows: what was wanted, measured, whether it is met."""
    rows = []

    def add(what, where, value, most, text):
        rows.append([what, where, text, f"{most:g}", "yes" if value <= most else "**no**"])

    for (kind, dofs, pairs), result in runs.items():
        where, of = f"{kind}, {result['model']['dofs']:,}, {result['model']['contact_pairs']:,} pairs", result["processor_of"]
        X = x_of(result, ratios)
        if math.isfinite(X) and dofs >= 1e6:
            add("X", where, X, LIMITS_OF_X[pairs], f"{X:.3f}")
        if dofs >= 1e6 and pairs == 300:
            part = (of["super_elements"] + of["assemble"]) / of["factorise"]
            add("(super-elements + assemble) / factorise", where, part, 0.333, f"{part:.3f}")
        if dofs == 1e6 and pairs == 300:
            add("wall seconds, files included", where, result["wall"], 60, f"{result['wall']:.1f}")
            add("peak memory, GB", where, result["peak"] / 1e9, 8, f"{result['peak'] / 1e9:.2f}")
    for (kind, _, _, what), result in increments.items():
        next_one = numpy.mean(result["of_increments"][1:]) / result["processor_of"]["factorise"]
        add(f"a next increment / factorise, {what}", f"{kind}, {result['model']['dofs']:,}, {result['model']['contact_pairs']:,} pairs",
            next_one, 0.3, f"{next_one:.2f} ({numpy.mean(result['of_increments'][1:]):.3f} s)")
    return measure.table(["figure", "mesh, degrees of freedom", "measured", "at most", "met"], rows) if rows else ""


def arguments_of():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scabo", default=ROOT / "build" / "bin" / "scabo")
    parser.add_argument("--sparse", help="the program large_sparse: measures the solves")
    parser.add_argument("--least", type=float, default=0, help="degrees of freedom")
    parser.add_argument("--most", type=float, default=1e5, help="degrees of freedom")
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--pairs", default=",".join(str(p) for p in PAIRS))
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=150, help="limit of a run, processor seconds")
    parser.add_argument("--gigabytes", type=float, default=10, help="limit of a run, address space")
    parser.add_argument("--total", type=float, default=1500, help="no run begins after so many processor seconds of all")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "build" / "bench-large")
    parser.add_argument("--resume", action="store_true", help="take the runs that --output holds")
    parser.add_argument("--model", help="write the model of one run to this file instead of running it")
    return parser.parse_args()


def cases(options):
    wanted = [int(p) for p in options.pairs.split(",")]
    for kind in options.kinds.split(","):
        for dofs, of_pairs in CASES[kind].items():
            for pairs in of_pairs:
                if options.least <= dofs <= options.most and pairs in wanted and possible(dofs, pairs):
                    yield kind, dofs, pairs


def slender_last(case):
    """Layers of few rows of elements have an ill-conditioned W, and may take long."""
    return case[1] < 50 * case[2]


def next_increments(options):
    """Models of several increments: with fields of every increment, and of the last one alone."""
    for dofs in (1e5, 1e6):
        if options.least <= dofs <= options.most and "fem" in options.kinds and "300" in options.pairs.split(","):
            count = INCREMENTS if dofs < 1e6 else 4
            steps = f"steps: [{{increments: {count}}}]\n"
            yield ("fem", dofs, 300, "with its files"), model_of("fem", dofs, 300, more=steps)
            yield ("fem", dofs, 300, "tables only"), model_of("fem", dofs, 300, more=steps + "output: {fields: []}\n")


def main():
    options = arguments_of()
    todo = sorted(cases(options), key=slender_last)  # otherwise in their order
    if not todo:
        sys.exit("no run is left: see --least, --most, --pairs")
    if options.model:
        pathlib.Path(options.model).write_text(model_of(*todo[0]), encoding="utf-8")
        return
    options.output.mkdir(parents=True, exist_ok=True)
    store = options.output / "runs.json"
    kept = {tuple(run["name"]): run for run in json.loads(store.read_text())} if options.resume and store.exists() else {}
    done, left_out, spent = {}, [], 0.0

    def attempt(name, text):
        """name: kind, degrees of freedom, pairs, "" or what is special."""
        nonlocal spent
        if name in kept:
            done[name] = kept[name]
            return
        if spent > options.total:
            left_out.append(f"{name[0]}, {name[1]:.0e} degrees of freedom, {name[2]} pairs {name[3]}: not begun, {options.total:.0f} s of processor time were spent")
            return
        try:
            done[name] = {"name": name, "kind": name[0], **measure.run(options.scabo, text, options.threads, options.seconds, options.gigabytes)}
        except measure.Failure as failure:
            spent += failure.processor
            left_out.append(f"{name[0]}, {name[1]:.0e} degrees of freedom, {name[2]} pairs {name[3]}: {failure}")
            print(left_out[-1], flush=True)
            return
        spent += done[name]["processor"]
        store.write_text(json.dumps([*done.values(), *(run for other, run in kept.items() if other not in done)], indent=1), encoding="utf-8")
        if not name[3]:
            print("| " + " | ".join(row_of(name[0], done[name], ratios)) + " |", flush=True)

    before = f"{datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d %H:%M} UTC; threads: {options.threads}, cores: {os.cpu_count()}, load before: {os.getloadavg()[0]:.1f}"
    sizes = [n for n in DOFS if n <= options.most]
    ratios = solves(options.sparse, sizes) if options.sparse else SOLVE
    print(before + "\n\n" + measure.table(HEAD, []), flush=True)
    try:
        for case in todo:
            attempt((*case, ""), model_of(*case))
        for name, text in next_increments(options):
            attempt(name, text)
    except KeyboardInterrupt:
        left_out.append("interrupted: what follows was not begun")

    settle([(name[0], run) for name, run in done.items()])
    runs = {name[:3]: run for name, run in done.items() if not name[3]}
    increments = {name: run for name, run in done.items() if name[3]}
    text = [before, f"solve / factorise, {'of large_sparse' if options.sparse else 'measured before'}: "
            + ", ".join(f"{ratio:.3f} at {dofs:,.0f}" for dofs, ratio in ratios),
            measure.table(HEAD, [row_of(name[0], run, ratios) for name, run in runs.items()]),
            "Exponents of growth with the degrees of freedom:", exponents(runs), verdicts(runs, increments, ratios)]
    if left_out:
        text.append("Not run to the end:\n\n- " + "\n- ".join(left_out))
    text.append(f"{len(done)} runs, {spent:.0f} s of processor time here; load after: {os.getloadavg()[0]:.1f}")
    (options.output / "table.md").write_text("\n\n".join(part for part in text if part) + "\n", encoding="utf-8")
    print("\n" + (options.output / "table.md").read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
