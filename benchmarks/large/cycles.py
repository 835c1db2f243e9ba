#!/usr/bin/env python3
"""Memory of 100 increments of cyclic load: resident memory at the end of every increment, the first ten against the last ten.

    benchmarks/large/cycles.py [--dofs 1e5] [--pairs 300] [--increments 100]

Two blocks of finite elements (models.py), pressed in one increment, then pushed to and fro by 20 MPa. Fields of every increment are
written. The first increment, in which the factorisation's workspace is given back, is not among the ten.
"""
import argparse
import pathlib
import sys

import numpy

import measure
from models import model_of

STEPS = """curves: {{wave: {{table: [[0, 0], [1, 1], [3, -1], [4, 0]]}}}}
steps:
  - {{name: press, increments: 1, loads: {{down: 1}}}}
  - {{name: waves, increments: 20, cycles: {cycles}, loads: {{push: wave}}}}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scabo", default=pathlib.Path(__file__).resolve().parents[2] / "build" / "bin" / "scabo")
    parser.add_argument("--dofs", type=float, default=1e5)
    parser.add_argument("--pairs", type=int, default=300)
    parser.add_argument("--increments", type=int, default=100, help="a multiple of 20")
    options = parser.parse_args()
    text = model_of("fem", options.dofs, options.pairs, push=20e6, more=STEPS.format(cycles=max(1, options.increments // 20)))
    try:
        result = measure.run(options.scabo, text, 1, seconds=600)
    except measure.Failure as failure:
        sys.exit(f"cycles.py: {failure}")
    resident = numpy.array(result["resident"]) / 1e6
    first, last = resident[1:11], resident[-10:]
    print(f"{result['model']['dofs']:,} degrees of freedom, {result['model']['contact_pairs']} pairs, {len(resident)} increments, "
          f"{result['processor']:.1f} s of processor time, largest certificate {result['certificate']:.1e}")
    print(f"resident memory after an increment: increments 2 to 11 {first.mean():.1f} MB ({first.min():.1f} to {first.max():.1f}), last ten "
          f"{last.mean():.1f} MB ({last.min():.1f} to {last.max():.1f}), {100 * (last.mean() / first.mean() - 1):+.2f} %; "
          f"peak of the process {result['peak'] / 1e6:.0f} MB")


if __name__ == "__main__":
    main()
