"""Run time of the Python package against that of the program, on the same machine in the same run.

    make bench-python      or      PYTHONPATH=build/python benchmarks/python/run.py --scabo build/bin/scabo

Three figures for each model: the program as a whole process; `scabo.read(...).run(output=...)` within Python, which writes
the same files; the same with the start of Python and the import. Each is the smallest of several repetitions, taken in
turn. The fourth is `run()` without files.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile
import time
import warnings

import scabo

ROOT = pathlib.Path(__file__).resolve().parents[2]
BEAM = ROOT / "examples" / "01_double_cantilever" / "model.yaml"
PROCESS = """
import sys, scabo
settings = dict(setting.split("=") for setting in sys.argv[3:])
scabo.read(sys.argv[1], set=settings).run(output=sys.argv[2])
"""


def seconds_of(function):
    start = time.perf_counter()
    function()
    return time.perf_counter() - start


def measure(name, settings, repetitions, program, folder):
    words = [word for setting in settings for word in ("--set", setting)]
    values = dict(setting.split("=") for setting in settings)
    output = str(folder / "results")

    def as_program():
        subprocess.run([program, "run", BEAM, "-o", output, "--quiet", *words], check=True)

    def as_process():
        subprocess.run([sys.executable, "-c", PROCESS, BEAM, output, *settings], check=True)

    def in_python():
        scabo.read(BEAM, set=values).run(output=output)

    def without_files():
        scabo.read(BEAM, set=values).run()

    kinds = [as_program, in_python, as_process, without_files]
    times = {kind: [] for kind in kinds}
    for _ in range(repetitions):
        for kind in kinds:
            times[kind].append(seconds_of(kind))
    least = [min(times[kind]) for kind in kinds]
    dofs = scabo.read(BEAM, set=values).check().dofs
    print(f"| {name} | {dofs} | " + " | ".join(f"{seconds:.3f} s" for seconds in least)
          + f" | {100 * (least[1] / least[0] - 1):+.0f} % |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scabo", required=True, help="the program")
    parser.add_argument("--repetitions", type=int, default=7)
    options = parser.parse_args()
    warnings.simplefilter("ignore", scabo.ModelWarning)
    print("| model | degrees of freedom | program | in Python | with start and import | without files | Python against program |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory(prefix="scabo_bench_") as folder:
        def sized(size, *more):
            return [f"bodies.{body}.mesh.{key}" for body in ("lower", "upper") for key in (f"size={size}", *more)]
        measure("example 01", [], options.repetitions, options.scabo, pathlib.Path(folder))
        measure("example 01, elements of 0.094 m", sized(0.09375), options.repetitions, options.scabo, pathlib.Path(folder))
        measure("example 01 as quadtrees", sized(0.0234375, "kind=quadtree"), max(3, options.repetitions // 2), options.scabo,
                pathlib.Path(folder))


if __name__ == "__main__":
    main()
