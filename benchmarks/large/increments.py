#!/usr/bin/env python3
"""What a next increment costs beside a factorisation, and X under other loads and frictions.

    benchmarks/large/increments.py [--dofs 1e5,1e6] [--pairs 32,300,1000] [--more 10] [--repeat 3] [--cases]

The models are those of run.py (finite elements of order 2). A next increment: processor seconds in user mode of a run
with 1 + `more` increments less those of a run with one, divided by `more`, and by the factorisation of the same runs.
Twice: with all files, and without fields. Medians of `repeat` runs, one thread.

With --cases: X of run.py, iterations and certificate of single increments that press, push, shear nearly to sliding, or
press unevenly, at friction 0.5 and 0.1.
"""
import argparse
import json
import math
import pathlib
import re
import resource
import statistics
import subprocess
import tempfile
import time

import numpy

import run

FIELDS_OFF = "output: {fields: []}\n"
STEPS = "steps: [{{name: load, increments: {count}}}]\n"
CASES = {
    "press": "loads: {down: {on: upper.top, pressure: 100e6}}\n",
    "push": "loads: {down: {on: upper.top, pressure: 100e6}, push: {on: upper.left, traction: [1e6, 0]}}\n",
    "shear": "loads: {down: {on: upper.top, pressure: 100e6}, push: {on: upper.top, traction: [45e6, 0]}}\n",
    "tilt": "loads: {down: {on: upper.top, pressure: {over: length, at: [0, LENGTH], values: [20e6, 180e6]}}}\n",
}


def user_seconds(scabo, text):
    """Of the whole process, and of its factorisation; the summary."""
    with tempfile.TemporaryDirectory() as directory:
        model = pathlib.Path(directory) / "model.yaml"
        model.write_text(text, encoding="utf-8")
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        begin = time.monotonic()
        with subprocess.Popen([scabo, "run", model, "--threads", "1", "--quiet"], stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True) as process:
            samples = [(0.0, 0.0)]
            while process.poll() is None:
                samples.append((time.monotonic() - begin, run.processor_seconds(process.pid) or samples[-1][1]))
                time.sleep(0.01)
            errors = process.stderr.read()
        if process.returncode != 0:
            raise SystemExit(errors)
        summary = json.loads((model.with_suffix(".results") / "summary.json").read_text())
        summary["of"] = run.processor_of_stages(summary["timing"], samples)
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, summary


def next_increments(options):
    print("| degrees of freedom | pairs | factorisation, s | next increment, s | of a factorisation | without fields, s | of a factorisation |")
    print("|---|---|---|---|---|---|---|")
    for dofs in options.dofs:
        for pairs in options.pairs:
            if not run.possible("fem", dofs, pairs):
                continue
            text = run.model_of("fem", dofs, pairs)
            factorise, per_increment = [], {"": [], FIELDS_OFF: []}
            for _ in range(options.repeat):
                for files, seconds in per_increment.items():
                    single, one = user_seconds(options.scabo, text + STEPS.format(count=1) + files)
                    several, many = user_seconds(options.scabo, text + STEPS.format(count=1 + options.more) + files)
                    seconds.append((several - single) / options.more)
                    factorise += [one["of"]["factorise"], many["of"]["factorise"]]
            T = statistics.median(factorise)
            whole, bare = (statistics.median(seconds) for seconds in per_increment.values())
            model = one["model"]
            print(f"| {model['dofs']} | {model['contact_pairs']} | {T:.3f} | {whole:.3f} | {whole / T:.2f} | {bare:.3f} | {bare / T:.2f} |", flush=True)


def cases(options):
    print("| degrees of freedom | pairs | friction | case | factorise, s | condense, s | newton, s | X | iterations (on fewer pairs) | certificate | memory, GB |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for dofs in options.dofs:
        part = numpy.interp(math.log(dofs), numpy.log(run.SOLVE[:, 0]), run.SOLVE[:, 1])
        for pairs in options.pairs:
            if not run.possible("fem", dofs, pairs):
                continue
            text = run.model_of("fem", dofs, pairs)
            length = re.search(r"upper: .*?size: \[([^,]*),", text).group(1)
            head, tail = text.split("loads:")[0], "contacts:" + text.split("contacts:")[1]
            for friction in (0.5, 0.1):
                for name, loads in CASES.items():
                    _, summary = user_seconds(options.scabo, head + loads.replace("LENGTH", length) + tail.replace("friction: 0.5", f"friction: {friction}") + FIELDS_OFF)
                    of, increment = summary["of"], summary["increments"][0]
                    X = (of["factorise"] + of["condense"] + of["newton"]) / (of["factorise"] * (1 + part))
                    coarse = increment.get("coarse_iterations", 0)
                    worst = max(v for v in increment["certificate"].values() if isinstance(v, float))
                    print(f"| {summary['model']['dofs']} | {summary['model']['contact_pairs']} | {friction} | {name} | {of['factorise']:.2f} | "
                          f"{of['condense']:.2f} | {of['newton']:.2f} | {X:.2f} | {increment['newton_iterations']} ({coarse}) | {worst:.1e} | "
                          f"{summary['peak_memory_bytes'] / 1e9:.2f} |", flush=True)


def main():
    root = pathlib.Path(__file__).resolve().parents[2]
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--scabo", default=root / "build" / "bin" / "scabo")
    options.add_argument("--dofs", default="1e5,1e6")
    options.add_argument("--pairs", default="32,300,1000")
    options.add_argument("--more", type=int, default=10)
    options.add_argument("--repeat", type=int, default=3)
    options.add_argument("--cases", action="store_true")
    options = options.parse_args()
    options.dofs = [float(n) for n in options.dofs.split(",")]
    options.pairs = [int(n) for n in options.pairs.split(",")]
    (cases if options.cases else next_increments)(options)


if __name__ == "__main__":
    main()
