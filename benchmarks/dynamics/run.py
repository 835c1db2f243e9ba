#!/usr/bin/env python3
"""Time and memory of steps in time.

    benchmarks/dynamics/run.py [joint|part|flight|wall|elastic_wall ...] [--dofs 1e5] [--pairs 300] [--steps 40] [--repeat 3]

    joint    a block on ground, finite elements of order 2, --dofs degrees of freedom and --pairs pairs, all of which act while the ground shakes
    part     the same, but a sixth of the pairs act: the others are a gap away from each other
    flight   the same, the block above the ground: no pair acts
    wall     400 rigid blocks in running bond, friction 0.6, that slide on their ground under 0.8 g
    elastic_wall  the same of elastic blocks, each one super-element of order 1 with sides of 0.25 m; no step is halved

Each model runs with --steps time steps and with three times as many; what the further ones take, divided by their number, is the time of a
step. Processor seconds of one thread, medians of --repeat pairs of runs, and resident memory after both.
"""
import argparse
import pathlib
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benchmarks" / "large"))
import measure  # noqa: E402

BODIES = """scabo: 1
analysis: {{plane: strain}}
materials: {{stone: {{young: 30e9, poisson: 0.2, density: 2400, damping: {{ratio: 0.05, between: [5, 50]}}}}}}
bodies:
  ground: {{material: stone, shape: {{rectangle: {{corner: [0, -{height!r}], size: [{length!r}, {height!r}]}}}}, mesh: {{kind: fem, order: 2, size: {size!r}}}}}
  block: {{material: stone, shape: {{rectangle: {{corner: [0, {gap!r}], size: [{length!r}, {height!r}]}}}}, mesh: {{kind: fem, order: 2, size: {size!r}}}}}
supports: [{{on: ground.bottom, fix: [x, y]}}]
loads: {{weight: {{gravity: [0, -9.81]}}}}
contacts: {{joint: {{between: [ground.top, block.bottom], friction: 0.5}}}}
curves: {{quake: {{table: [[0, 2], [100, 2]]}}}}
output: {{fields: []}}
steps:
"""
PART = BODIES.replace("shape: {{rectangle: {{corner: [0, {gap!r}], size: [{length!r}, {height!r}]}}}}",
                      "shape: {{polygon: {{vertices: [[0, 0.5], [{left!r}, 0], [{right!r}, 0], [{length!r}, 0.5], [{length!r}, {height!r}], [0, {height!r}]]}}}}").replace(
    "block.bottom], friction: 0.5}}}}", "block.edge_2], friction: 0.5}}, left: {{between: [ground.top, block.edge_1], friction: 0.5}}, "
    "right: {{between: [ground.top, block.edge_3], friction: 0.5}}}}")
WALL = """scabo: 1
analysis: {plane: stress, thickness: 0.25}
bodies:
  ground: {rigid: true, shape: {rectangle: {corner: [-0.5, -0.5], size: [11, 0.5]}}}
  odd: &stone {rigid: true, density: 2300, shape: {rectangle: {corner: [0, 0], size: [0.5, 0.25]}}, repeat: {count: [20, 10], step: [[0.5, 0], [0, 0.5]]}}
  even: {<<: *stone, shape: {rectangle: {corner: [0.25, 0.25], size: [0.5, 0.25]}}, repeat: {count: [19, 9], step: [[0.5, 0], [0, 0.5]]}}
  half: {<<: *stone, shape: {rectangle: {corner: [0, 0.25], size: [0.25, 0.25]}}, repeat: {count: [2, 9], step: [[9.75, 0], [0, 0.5]]}}
  coping: {<<: *stone, shape: {rectangle: {corner: [0, 4.75], size: [1, 0.25]}}, repeat: {count: 10, step: [1, 0]}}
supports: [{on: ground, fix: [x, y]}]
loads: {weight: {gravity: [0, -9.81]}}
contacts: {joints: {between: all, friction: 0.6}}
curves: {quake: {table: [[0, 8], [100, 8]]}}
output: {fields: []}
steps:
  - {name: rest}
"""
STONE = "{young: 20e9, poisson: 0.2, density: 2300, damping: {ratio: 0.05, between: [20, 500]}}"
STEP = {"joint": 1e-5, "part": 1e-5, "flight": 1e-5, "wall": 2e-3, "elastic_wall": 2e-3}  # s; of elastic bodies that in which a wave passes an element


def model_of(kind, dofs, pairs, steps):
    shake = f"  - {{name: shake, dynamic: {{duration: {STEP[kind] * steps!r}, step: {STEP[kind]!r}, ground: {{x: quake}}}}, increments: 2}}\n"
    if kind == "wall":
        return WALL + shake
    if kind == "elastic_wall":
        elastic = WALL.replace("rigid: true, density: 2300, shape", "material: stone, mesh: {size: 0.25, order: 1}, shape")
        return elastic.replace("bodies:", f"materials: {{stone: {STONE}}}\nbodies:", 1) + shake + "solver: {halvings: 0}\n"
    elements = (pairs - 1) // 2
    rows = max(1, round(dofs / (2 * 6 * elements)))
    size = 1 / 16
    if kind == "part":
        head = PART.format(length=elements * size, height=rows * size, left=(elements // 2 - elements // 12) * size, right=(elements // 2 + elements // 12) * size, size=size)
        return head + "  - {name: rest}\n" + shake
    head = BODIES.format(length=elements * size, height=rows * size, gap=0.0 if kind == "joint" else 100.0, size=size)
    return head + ("  - {name: rest}\n" if kind == "joint" else "") + shake


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("kinds", nargs="*", default=["flight", "joint", "wall"])
    options.add_argument("--scabo", default=ROOT / "build" / "bin" / "scabo")
    options.add_argument("--dofs", type=float, default=1e5)
    options.add_argument("--pairs", type=int, default=300)
    options.add_argument("--steps", type=int, default=40)
    options.add_argument("--repeat", type=int, default=3)
    options = options.parse_args()
    print("| model | degrees of freedom | pairs | steps | a step, ms | resident, MB | after three times the steps, MB | certificate |")
    print("|---|---|---|---|---|---|---|---|")
    for kind in options.kinds:
        runs = [[measure.run(options.scabo, model_of(kind, options.dofs, options.pairs, times * options.steps), seconds=3000.0) for times in (1, 3)]
                for _ in range(options.repeat)]
        short, long = runs[-1]
        step = statistics.median((after["processor"] - before["processor"]) / (2 * options.steps) for before, after in runs)
        print(f"| {kind} | {long['model']['dofs']} | {long['model']['contact_pairs']} | {options.steps}, {3 * options.steps} | {1e3 * step:.1f} | "
              f"{short['resident'][-1] / 1e6:.0f} | {long['resident'][-1] / 1e6:.0f} | {long['certificate']:.0e} |", flush=True)


if __name__ == "__main__":
    main()
