#!/usr/bin/env python3
"""Time of every stage and memory of `scabo run` from 1e4 to 2e6 degrees of freedom with 32 to 3,000 contact pairs.

    benchmarks/large/run.py [--most 1e5] [--kinds fem,quadtree,polygons] [--pairs 32,300] [--threads 2]

Two rectangles in frictional contact. Equal elements everywhere: the length of the interface gives the number of pairs.
X = (factorise + condense + newton) / (factorise + solve): the contact problem beside the same bodies without contact.
The solve is not measured by itself: it is taken as the part of the factorisation that benchmarks/large_sparse found for
the same number of degrees of freedom (SOLVE).

The stages are wall seconds, as in summary.json. Processor seconds and X are those of the process at the times at which
stages end, by /proc, 100 times a second: on a machine with other work they say more. They mean nothing below 0.1 s.
"""
import argparse
import json
import math
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import numpy

MODEL = """scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 210e9, poisson: 0.3}}}}
bodies:
  upper: {{material: steel, shape: {{rectangle: {{corner: [{left!r}, 0], size: [{upper[0]!r}, {upper[1]!r}]}}}}, mesh: {{{mesh}}}}}
  lower: {{material: steel, shape: {{rectangle: {{corner: [0, -{lower[1]!r}], size: [{lower[0]!r}, {lower[1]!r}]}}}}, mesh: {{{mesh}}}}}
supports: [{{on: lower.bottom, fix: [x, y]}}]
loads: {{down: {{on: upper.top, pressure: 100e6}}, push: {{on: upper.left, traction: [1e6, 0]}}}}
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: 0.5}}}}
"""
KINDS = {  # mesh, degrees of freedom for each square of the side `size`
    "fem": ("kind: fem, order: 2", 6.0),
    "quadtree": ("kind: quadtree, order: 2", 6.0),
    "polygons": ("kind: polygons, order: 2", 10.5),
}
DOFS = (1e4, 1e5, 1e6, 2e6)
PAIRS = (32, 300, 1000, 3000)
STAGES = ("read", "mesh", "super_elements", "assemble", "factorise", "condense", "newton", "recover", "write")
OF_PROCESSOR = ("assemble", "factorise", "condense", "newton", "fields")
SOLVE = numpy.array([(1e4, 0.0021 / 0.027), (1e5, 0.026 / 0.396), (1e6, 0.299 / 5.79)])  # solve / factorise


def model_of(kind, dofs, pairs):
    """A square block with a smaller one on it; two layers as long as the interface if this is not possible."""
    mesh, dofs_of_square = KINDS[kind]
    squares = 0.97 * dofs / dofs_of_square  # a body has at most 1e6 degrees of freedom, or a model 1e6 nodes
    along = max(1, round((pairs - 1) / 2))  # two pairs a side
    across = max(1, along // 2)
    if kind == "fem" and dofs > 1e6:
        across = max(across, round(squares / 2 / along))
    side = math.sqrt(squares - along * across) if squares > along * across else 0.0
    if side > 1.2 * along:
        width = 2 ** round(math.log2(side)) if kind == "quadtree" else round(side)
        lower, upper = (width, round(side * side / width)), (along, across)
    else:
        across = max(1, round(squares / (2 * along)))
        lower, upper = (along, across), (along, across)
    size = 1 / 512  # exact: cells of a quadtree are halves of halves
    return MODEL.format(mesh=f"{mesh}, size: {size!r}", left=(lower[0] - upper[0]) // 2 * size,
                        upper=[n * size for n in upper], lower=[n * size for n in lower])


def possible(kind, dofs, pairs):
    if kind == "fem" and dofs > 1e6 and pairs < 300:
        return False  # the upper body would be a needle
    return pairs * 24 <= dofs  # bodies of at least four rows of elements


def processor_seconds(pid):
    try:
        fields = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    except OSError:
        return None
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def processor_of_stages(timing, samples):
    """Stages follow one another until the end of `newton`; then fields are recovered and written in turn."""
    ends = numpy.cumsum([timing[stage] for stage in STAGES[:7]])
    at = numpy.interp(ends, [s[0] for s in samples], [s[1] for s in samples])
    of = dict(zip(STAGES[:7], numpy.diff(at, prepend=0.0)))
    of["fields"] = samples[-1][1] - at[-1]
    return of


def run(scabo, text, threads):
    with tempfile.TemporaryDirectory() as directory:
        model = pathlib.Path(directory) / "model.yaml"
        model.write_text(text, encoding="utf-8")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        errors = pathlib.Path(directory) / "errors"
        with errors.open("w", encoding="utf-8") as stream:
            begin = time.monotonic()
            process = subprocess.Popen([scabo, "run", model, "--threads", str(threads)], stdout=subprocess.DEVNULL, stderr=stream)
            samples = [(0.0, 0.0)]
            while process.poll() is None:
                samples.append((time.monotonic() - begin, processor_seconds(process.pid) or samples[-1][1]))
                time.sleep(0.01)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if process.returncode != 0:
            return None, errors.read_text(encoding="utf-8").strip().splitlines()[-1]
        summary = json.loads((model.with_suffix(".results") / "summary.json").read_text())
        summary["processor_of"] = processor_of_stages(summary["timing"], samples)
        summary["processor"] = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        summary["written"] = sum(file.stat().st_size for file in model.with_suffix(".results").iterdir())
        return summary, ""


def seconds(value):
    return f"{value:.3f}" if value < 1 else f"{value:.2f}" if value < 10 else f"{value:.1f}"


def growth(small, large, value):
    """Exponent p of value ~ (degrees of freedom)^p between two runs."""
    a, b = value(small), value(large)
    if a <= 0 or b <= 0:
        return "-"
    return f"{math.log(b / a) / math.log(large['model']['dofs'] / small['model']['dofs']):.2f}"


def main():
    root = pathlib.Path(__file__).resolve().parents[2]
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--scabo", default=root / "build" / "bin" / "scabo")
    options.add_argument("--least", type=float, default=0, help="degrees of freedom")
    options.add_argument("--most", type=float, default=1e5, help="degrees of freedom")
    options.add_argument("--kinds", default=",".join(KINDS))
    options.add_argument("--pairs", default=",".join(str(p) for p in PAIRS))
    options.add_argument("--threads", type=int, default=os.cpu_count())
    options.add_argument("--model", help="write the model of one run to this file instead of running it")
    options = options.parse_args()
    pairs_wanted = [int(p) for p in options.pairs.split(",")]
    runs = {}
    if not options.model:
        print(f"{options.threads} threads, load of the machine {os.getloadavg()[0]:.1f} before the runs\n")
        head = ["mesh", "degrees of freedom", "pairs", *(s.replace("_", "-") for s in STAGES), "total, wall", "processor",
                *(f"processor: {s}" for s in OF_PROCESSOR), "memory, GB", "files, MB", "iterations", "X"]
        print("| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    for kind in options.kinds.split(","):
        for dofs in DOFS:
            for pairs in pairs_wanted:
                if not options.least <= dofs <= options.most or not possible(kind, dofs, pairs):
                    continue
                text = model_of(kind, dofs, pairs)
                if options.model:
                    pathlib.Path(options.model).write_text(text, encoding="utf-8")
                    return
                summary, reason = run(options.scabo, text, options.threads)
                if summary is None:
                    print(f"| {kind} | {dofs:.0f} | {pairs} | {reason} |", flush=True)
                    continue
                timing, model = summary["timing"], summary["model"]
                part = numpy.interp(math.log(model["dofs"]), numpy.log(SOLVE[:, 0]), SOLVE[:, 1])
                of = summary["processor_of"]
                X = (of["factorise"] + of["condense"] + of["newton"]) / (of["factorise"] * (1 + part)) if of["factorise"] > 0.1 else math.nan
                iterations = sum(increment["newton_iterations"] for increment in summary["increments"])
                row = [kind, model["dofs"], model["contact_pairs"], *(seconds(timing[s]) for s in STAGES),
                       seconds(timing["total"]), seconds(summary["processor"]),
                       *(seconds(of[s]) for s in OF_PROCESSOR), f"{summary['peak_memory_bytes'] / 1e9:.2f}",
                       f"{summary['written'] / 1e6:.0f}", iterations, f"{X:.2f}" if math.isfinite(X) else "-"]
                print("| " + " | ".join(str(entry) for entry in row) + " |", flush=True)
                runs[kind, dofs, pairs] = summary
    measures = [("processor", lambda s: s["processor"]), ("memory", lambda s: s["peak_memory_bytes"])]
    measures += [(stage.replace("_", "-"), lambda s, stage=stage: s["timing"][stage]) for stage in STAGES if stage != "read"]
    lines = []
    for (kind, dofs, pairs), small in runs.items():
        larger = [n for n in DOFS if n > dofs and (kind, n, pairs) in runs]
        if not larger:
            continue
        large = runs[kind, larger[0], pairs]
        lines.append(f"| {kind} | {pairs} | {dofs:.0e} to {larger[0]:.0e} | " +
                     " | ".join(growth(small, large, value) for _, value in measures) + " |")
    if lines:
        print("\nExponents of growth with the degrees of freedom:\n")
        print("| mesh | pairs | degrees of freedom | " + " | ".join(name for name, _ in measures) + " |")
        print("|" + "---|" * (3 + len(measures)))
        print("\n".join(lines))
    if not runs and not options.model:
        sys.exit("no run is left: see --least, --most, --pairs")


if __name__ == "__main__":
    main()
