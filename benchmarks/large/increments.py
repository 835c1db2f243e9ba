#!/usr/bin/env python3
"""What a next increment costs beside a factorisation, and X under other loads and frictions.

    benchmarks/large/increments.py [--dofs 1e5,1e6] [--pairs 32,300,1000] [--more 10] [--repeat 3] [--cases]

The models are those of run.py (finite elements of order 2). A next increment: the mean of `more` increments (3 at 1e6
degrees of freedom) after the first, each from its begin to its end, in seconds of the processor clock of the process; and
the factorisation of the same run. Twice: with all files, and without fields. Medians of `repeat` runs, one thread.

With --cases: X of run.py, iterations and certificate of single increments that press, push, shear nearly to sliding, or
press unevenly, at friction 0.5 and 0.1.
"""
import argparse
import math
import pathlib
import re
import statistics

import numpy

import measure
import run
from models import model_of, possible

FIELDS_OFF = "output: {fields: []}\n"
STEPS = "steps: [{{increments: {count}}}]\n"
CASES = {
    "press": "loads: {down: {on: upper.top, pressure: 100e6}}\n",
    "push": "loads: {down: {on: upper.top, pressure: 100e6}, push: {on: upper.left, traction: [1e6, 0]}}\n",
    "shear": "loads: {down: {on: upper.top, pressure: 100e6}, push: {on: upper.top, traction: [45e6, 0]}}\n",
    "tilt": "loads: {down: {on: upper.top, pressure: {over: length, at: [0, LENGTH], values: [20e6, 180e6]}}}\n",
}


def next_increments(options):
    print("| degrees of freedom | pairs | factorisation, s | next increment, s | of a factorisation | without fields, s | of a factorisation | iterations of each |")
    print("|---|---|---|---|---|---|---|---|")
    for dofs in options.dofs:
        for pairs in options.pairs:
            if not possible(dofs, pairs):
                continue
            more = options.more if dofs < 1e6 else min(3, options.more)
            text = model_of("fem", dofs, pairs, more=STEPS.format(count=1 + more))
            factorise, next_one = [], {"": [], FIELDS_OFF: []}
            for _ in range(options.repeat):
                for files, seconds in next_one.items():
                    result = measure.run(options.scabo, text + files)
                    seconds.append(statistics.mean(result["of_increments"][1:]))
                    factorise.append(result["processor_of"]["factorise"])
            T = statistics.median(factorise)
            whole, bare = (statistics.median(seconds) for seconds in next_one.values())
            model, iterations = result["model"], result["iterations"][1:]
            print(f"| {model['dofs']:,} | {model['contact_pairs']:,} | {T:.3f} | {whole:.3f} | {whole / T:.2f} | {bare:.3f} | {bare / T:.2f} | "
                  f"{min(iterations)} to {max(iterations)} |", flush=True)


def cases(options):
    print("| degrees of freedom | pairs | friction | case | factorise, s | condense, s | newton, s | X | iterations (on fewer pairs) | certificate | memory, GB |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for dofs in options.dofs:
        part = numpy.interp(math.log(dofs), [math.log(n) for n, _ in run.SOLVE], [ratio for _, ratio in run.SOLVE])
        for pairs in options.pairs:
            if not possible(dofs, pairs):
                continue
            text = model_of("fem", dofs, pairs)
            length = re.search(r"upper: .*?size: \[([^,]*),", text).group(1)
            head, tail = text.split("loads:")[0], "contacts:" + text.split("contacts:")[1]
            for friction in (0.5, 0.1):
                for name, loads in CASES.items():
                    result = measure.run(options.scabo, head + loads.replace("LENGTH", length) + tail.replace("friction: 0.5", f"friction: {friction}") + FIELDS_OFF)
                    of = result["processor_of"]
                    X = (of["factorise"] + of["condense"] + of["newton"]) / (of["factorise"] * (1 + part))
                    print(f"| {result['model']['dofs']} | {result['model']['contact_pairs']} | {friction} | {name} | {of['factorise']:.2f} | "
                          f"{of['condense']:.2f} | {of['newton']:.2f} | {X:.2f} | {result['iterations'][0]} ({result['coarse_iterations'][0]}) | "
                          f"{result['certificate']:.1e} | {result['peak'] / 1e9:.2f} |", flush=True)


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
