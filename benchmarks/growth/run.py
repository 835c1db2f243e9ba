#!/usr/bin/env python3
"""Time of growth: processor time of many steps of Bittencourt's beam (example 31), a step, beside a whole run of the beam with its
crack as it is at the end, at one load.

Then the same of cells that give the beam about 100,000 degrees of freedom: a step beside the first state, which is one full solution. Medians of
several runs; other programs take turns with the first one.

    benchmarks/growth/run.py --scabo build/bin/scabo --others before/bin/scabo
"""
import argparse
import json
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

MODEL = pathlib.Path(__file__).resolve().parents[2] / "examples" / "31_beam_with_three_holes" / "model.yaml"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scabo", default="scabo", help="the program (default: scabo on the PATH)")
    parser.add_argument("--others", nargs="*", default=[], help="other programs, for the large beam")
    parser.add_argument("--steps", type=int, default=200, help="of growth (default: %(default)s)")
    parser.add_argument("--repeat", type=int, default=3, help="runs of the large beam (default: %(default)s)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        grown = pathlib.Path(folder, "grown")
        grow = {"toughness": {"K_Ic": 1000}, "step": 3.9 / options.steps, "until": {"steps": options.steps}}
        spent, wall = run(options.scabo, grown, {"growth": grow})
        summary = json.loads((grown / "summary.json").read_text(encoding="utf-8"))
        path, done = summary["growth"]["paths"]["beam.notch"], len(summary["increments"]) - 1
        near = {"near": path[-1], "size": 3.9 / options.steps / 2}
        alone, _ = run(options.scabo, pathlib.Path(folder, "alone"), {"loads": {"P": 1}}, [
            "parameters={}", f"bodies.beam.cracks.0.path={json.dumps(path)}",
            f"bodies.beam.mesh.refine={json.dumps([{'on': 'low', 'size': 0.12}, {'on': 'middle', 'size': 0.12}, near])}"])
        print(f"{done} steps: {spent:.1f} s of the processors, {wall:.1f} s by the clock; {spent / done:.3f} s a step, a whole run {alone:.3f} s")
        print(", ".join(f"{name} {seconds:.1f}" for name, seconds in summary["timing"].items()))
        compare([options.scabo, *options.others], options.repeat, pathlib.Path(folder), grow | {"step": 0.15})


def compare(programs, repeat, folder, grow):
    """A step of the large beam beside its first state."""
    fine, few = ["bodies.beam.mesh.size=0.1", "bodies.beam.mesh.refine=[]"], 16
    firsts, steps = {program: [] for program in programs}, {program: [] for program in programs}
    for _ in range(repeat):
        for program in programs:
            first, _ = run(program, folder / "first", {"growth": grow | {"until": {"load_factor": 1e-9}}}, fine)
            more, _ = run(program, folder / "more", {"growth": grow | {"until": {"steps": few}}}, fine)
            firsts[program].append(first)
            steps[program].append((more - first) / few)
    dofs = json.loads((folder / "more" / "summary.json").read_text(encoding="utf-8"))["model"]["dofs"]
    for program in programs:
        first, step = statistics.median(firsts[program]), statistics.median(steps[program])
        print(f"{program}: {dofs} degrees of freedom: the first state {first:.2f} s of the processors, a step {step:.2f} s, {step / first:.2f} of it")


def run(scabo, directory, step, settings=()):
    """Processor time and time by the clock."""
    command = [scabo, "run", str(MODEL), "-o", str(directory), "--quiet", "--set", "output.fields=[]", "--set", f"steps.0={json.dumps(step)}"]
    for setting in settings:
        command += ["--set", setting]
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    if subprocess.run(command).returncode != 0:
        sys.exit("scabo failed")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, time.monotonic() - began


if __name__ == "__main__":
    main()
