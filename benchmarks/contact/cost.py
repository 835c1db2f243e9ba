#!/usr/bin/env python3
"""Newton's share: time of the contact solve, W being known, against one factorisation of K.

    cost.py [--scabo PATH] [--elements 128] [--repeats 5] [--friction 0.3,1,3]

The block of Raous (SSNV128), plane strain, elements x elements eight-node elements, pressed on a rigid floor. Each run is a process of
its own, on one thread. factorise (K, ordering included), condense (W = B' K^-1 B) and newton are `timing` of summary.json; newton
holds the displacements (one solve with K) and the certificate of the structure too. The contact solve alone is `seconds` of `scabo
contact` on the problem that the run wrote. Medians. Wanted: contact solve below 5 % of factorise.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
MODEL = """
scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 130e9, poisson: 0.2}}}}
bodies:
  block: {{material: steel, shape: {{rectangle: {{corner: [0, 0], size: [0.04, 0.04]}}}},
           mesh: {{size: {size!r}, kind: fem}}}}
  floor: {{rigid: true, shape: {{rectangle: {{corner: [-0.02, -0.02], size: [0.08, 0.02]}}}}}}
supports:
  - {{on: floor, fix: [x, y]}}
  - {{on: block.right, fix: [x]}}
loads:
  down: {{on: block.top, pressure: 50e6}}
  aside: {{on: block.left, pressure: 150e6}}
contacts:
  joint: {{between: [floor.top, block.bottom], friction: {friction}}}
output: {{discrete_problems: true}}
"""


def numbers(kind):
    return lambda text: [kind(word) for word in text.split(",")]


def run(scabo, folder, text):
    model = pathlib.Path(folder) / "model.yaml"
    model.write_text(text)
    one = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    subprocess.run([str(scabo), "run", str(model), "-o", str(pathlib.Path(folder) / "out"), "--threads", "1", "--quiet"],
                   check=True, env=one)
    summary = json.loads((pathlib.Path(folder) / "out" / "summary.json").read_text())
    problem = next((pathlib.Path(folder) / "out" / "problems").glob("*.hdf5"))
    answer = subprocess.run([str(scabo), "contact", str(problem), "--json"], check=True, env=one, capture_output=True, text=True)
    timing = dict(summary["timing"], contact=json.loads(answer.stdout)["seconds"])
    increment = summary["increments"][-1]
    return timing, (increment["newton_iterations"], increment["coarse_iterations"]), summary["model"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scabo", default=str(ROOT / "build" / "bin" / "scabo"), type=pathlib.Path)
    parser.add_argument("--elements", type=int, default=128)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--friction", type=numbers(float), default=[0.3, 1.0, 3.0])
    arguments = parser.parse_args()
    print("| mu | pairs | dofs | iterations | on fewer pairs | factorise, ms | condense, ms | newton, ms | contact solve, ms | contact solve / factorise |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for friction in arguments.friction:
        timings = []
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(arguments.repeats):
                timing, iterations, model = run(arguments.scabo, folder, MODEL.format(
                    size=0.04 / arguments.elements, friction=friction))
                timings.append(timing)
        median = {key: 1e3 * statistics.median(timing[key] for timing in timings)
                  for key in ("factorise", "condense", "newton", "contact")}
        ratio = statistics.median(timing["contact"] / timing["factorise"] for timing in timings)
        print(f"| {friction:g} | {model['contact_pairs']} | {model['dofs']} | {iterations[0]} | {iterations[1]} | "
              f"{median['factorise']:.1f} | {median['condense']:.1f} | {median['newton']:.1f} | {median['contact']:.1f} | {100 * ratio:.1f} % |", flush=True)


if __name__ == "__main__":
    main()
