#!/usr/bin/env python3
"""Estimates that `scabo run` prints before the work, against memory and processor time measured afterwards.

    benchmarks/plan.py [--scabo build/bin/scabo] [--largest DOFS]
"""
import argparse
import json
import pathlib
import re
import resource
import subprocess
import tempfile

MODEL = """scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 210e9, poisson: 0.3}}}}
bodies:
  upper: {{material: steel, shape: {{rectangle: {{corner: [0, 1], size: [{width}, 1]}}}}, mesh: {{{mesh}}}}}
  lower: {{material: steel, shape: {{rectangle: {{corner: [-1, -1], size: [4, 2]}}}}, mesh: {{{mesh}}}}}
supports: [{{on: lower.bottom, fix: [x, y]}}]
loads: {{down: {{on: upper.top, pressure: 100e6}}, push: {{on: upper.left, traction: [1e6, 0]}}}}
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: 0.5}}}}
"""
MESHES = [  # degrees of freedom (about), mesh, width of the contact
    (1_200, "size: 0.05", 1),
    (4_900, "kind: quadtree, size: 0.0625, order: 1", 1),
    (12_000, "kind: polygons, size: 0.05, order: 2", 1),
    (5_900, "size: 0.0125", 2),
    (60_000, "kind: quadtree, size: 0.03125, order: 2", 1),
    (220_000, "kind: quadtree, size: 0.015625, order: 2", 1),
    (840_000, "kind: quadtree, size: 0.0078125, order: 2", 0.5),
]


def processor_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def main():
    root = pathlib.Path(__file__).resolve().parents[1]
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--scabo", default=root / "build" / "bin" / "scabo")
    options.add_argument("--largest", type=float, default=1e6)
    options = options.parse_args()
    print("| mesh | degrees of freedom | pairs | memory: estimate | measured | time: estimate | measured |\n|---|---|---|---|---|---|---|")
    for dofs, mesh, width in MESHES:
        if dofs > options.largest:
            continue
        with tempfile.TemporaryDirectory() as directory:
            model = pathlib.Path(directory) / "model.yaml"
            model.write_text(MODEL.format(mesh=mesh, width=width), encoding="utf-8")
            before = processor_seconds()
            run = subprocess.run([options.scabo, "run", model, "--threads", "1"], capture_output=True, text=True, check=True)
            seconds = processor_seconds() - before
            summary = json.loads((model.with_suffix(".results") / "summary.json").read_text())
        memory, time = re.search(r"; about (.*?) of memory, (.*)\n", run.stderr).groups()
        print(f"| {mesh} | {summary['model']['dofs']} | {summary['model']['contact_pairs']} | {memory} "
              f"| {summary['peak_memory_bytes'] / 1e6:.0f} MB | {time} | {seconds:.1f} s |", flush=True)


if __name__ == "__main__":
    main()
