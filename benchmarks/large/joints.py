#!/usr/bin/env python3
"""Joints of many pairs: layers, and blocks whose meshes are fine at the joint only.

    benchmarks/large/joints.py [layers|blocks|fem ...] [--pairs 3001,10001]

    layers   two layers of five rows of eight-node elements, as long as the joint: slender bodies
    blocks   two blocks of quadtrees of order 2, 2 by 1, graded towards the joint
    fem      the same of triangles of order 2

One increment, friction 0.5 (--friction 0.18: many pairs slip), pressed by a pressure that varies and pushed; one thread. Processor seconds of the stages
as in run.py, peak memory, iterations, certificate.
"""
import argparse
import pathlib

import measure

HEAD = """scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 210e9, poisson: 0.3}}}}
"""
LAYERS = HEAD + """bodies:
  upper: {{material: steel, shape: {{rectangle: {{corner: [0, 0], size: [{length!r}, {depth!r}]}}}}, mesh: {{kind: fem, order: 2, size: {size!r}}}}}
  lower: {{material: steel, shape: {{rectangle: {{corner: [0, {below!r}], size: [{length!r}, {depth!r}]}}}}, mesh: {{kind: fem, order: 2, size: {size!r}}}}}
"""
BLOCKS = HEAD + """bodies:
  upper: {{material: steel, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{kind: {kind}, order: 2, size: 0.125, refine: [{{on: bottom, size: {size!r}}}]}}}}
  lower: {{material: steel, shape: {{rectangle: {{corner: [0, -1], size: [2, 1]}}}}, mesh: {{kind: {kind}, order: 2, size: 0.125, refine: [{{on: top, size: {size!r}}}]}}}}
"""
TAIL = """supports: [{{on: lower.bottom, fix: [x, y]}}]
loads:
  down: {{on: upper.top, pressure: {{over: x, at: [0, {half!r}, {length!r}], values: [20e6, 140e6, 60e6]}}}}
  push: {{on: upper.top, traction: [12e6, 0]}}
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: {friction!r}}}}}
output: {{fields: []}}
"""


def model_of(kind, pairs, friction):
    elements = (pairs - 1) // 2
    if kind == "layers":
        size = 1 / 512
        length, depth = elements * size, 5 * size
        text = LAYERS.format(length=length, depth=depth, below=-depth, size=size)
    else:
        length = 2.0
        text = BLOCKS.format(kind="quadtree" if kind == "blocks" else "fem", size=length / elements)
    return text + TAIL.format(half=length / 2, length=length, friction=friction)


def main():
    root = pathlib.Path(__file__).resolve().parents[2]
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("kinds", nargs="*", default=["layers", "blocks"])
    options.add_argument("--scabo", default=root / "build" / "bin" / "scabo")
    options.add_argument("--pairs", default="3001,10001")
    options.add_argument("--friction", type=float, default=0.5)
    options.add_argument("--model", help="write the model of the first run to this file instead of running it")
    options = options.parse_args()
    if options.model:
        pathlib.Path(options.model).write_text(model_of(options.kinds[0], int(options.pairs.split(",")[0]), options.friction), encoding="utf-8")
        return
    print("| bodies | degrees of freedom | pairs | factorise, s | condense, s | newton, s | all, s | memory, GB | open, stick, slip | iterations | certificate |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for kind in options.kinds:
        for pairs in options.pairs.split(","):
            result = measure.run(options.scabo, model_of(kind, int(pairs), options.friction), seconds=1000.0)
            of, model = result["processor_of"], result["model"]
            print(f"| {kind} | {model['dofs']} | {model['contact_pairs']} | {of['factorise']:.2f} | {of['condense']:.2f} | {of['newton']:.2f} | "
                  f"{result['processor']:.1f} | {result['peak'] / 1e9:.2f} | {', '.join(map(str, result['states']['joint']))} | "
                  f"{result['iterations'][0]} ({result['coarse_iterations'][0]}) | {result['certificate']:.1e} |", flush=True)


if __name__ == "__main__":
    main()
