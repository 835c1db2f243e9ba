#!/usr/bin/env python3
"""Time that values at 10,000 points of a grid take, in one increment and in many: processor time of `scabo run` on the double
cantilever beam with the grid less that without it, and per point and increment.

    benchmarks/points/run.py --scabo build/bin/scabo
"""
import argparse
import pathlib
import resource
import subprocess
import sys
import tempfile

MODEL = pathlib.Path(__file__).resolve().parents[2] / "examples" / "01_double_cantilever" / "model.yaml"
GRID = "output.grid={x: [0, 6, 200], y: [0, 3, 50]}"  # 10,000 points; none on the joint


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scabo", default="scabo", help="the program (default: scabo on the PATH)")
    parser.add_argument("--repeat", type=int, default=3, help="runs of each kind, the fastest counts (default: %(default)s)")
    options = parser.parse_args()
    print("| element size | increments | without grid, s | with grid, s | microseconds a point and increment |")
    print("|---|---|---|---|---|")
    for size in (0.375, 0.1875):
        for increments in (1, 20, 200):
            plain, grid = (min(seconds(options.scabo, size, increments, more) for _ in range(options.repeat))
                           for more in ([], [GRID]))
            print(f"| {size} | {increments} | {plain:.3f} | {grid:.3f} | {1e6 * (grid - plain) / (1e4 * increments):.1f} |")


def seconds(scabo, size, increments, settings):
    """Processor time of one run."""
    settings = [f"bodies.{body}.mesh.size={size}" for body in ("lower", "upper")] + [
        f"steps.0.increments={increments}"] + settings
    with tempfile.TemporaryDirectory() as folder:
        command = [scabo, "run", str(MODEL), "-o", folder, "--quiet", "--threads", "1"]
        for setting in settings:
            command += ["--set", setting]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        if subprocess.run(command).returncode != 0:
            sys.exit(f"failed: {' '.join(command)}")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


if __name__ == "__main__":
    main()
