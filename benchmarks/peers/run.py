#!/usr/bin/env python3
"""Times Scabo, GetFEM and CalculiX on the double cantilever beam of Zhu et al. (2017).

    run.py [--repeat 5] [--json FILE] [--scabo PATH] [--python PATH]

Whole processes, one after the other in turn (A B C A B C ...), so that a slow minute of the machine
hits all of them; one warm-up each is not counted. Wall time from start to end of the process, peak
memory from the operating system (wait4), total normal contact force from each program's own output.
Prints a Markdown table. Needs nothing but Python's standard library. See ../README.md.
Exit status 1 if a program is missing or fails.
"""
import argparse
import dataclasses
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

import calculix_beams

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
MODEL = ROOT / "examples" / "01_double_cantilever" / "model.yaml"
SIZE, FRICTION = 0.1875, 0.2            # edge of an element, m; Coulomb's mu
CONVERGED_FORCE = 53.6693587            # kN, total normal contact force: graded quadtrees of orders 3 to 6 and polygons agree to 3e-8
THREAD_VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "CCX_NPROC_EQUATION_SOLVER", "NUMBER_OF_CPUS")


class Failure(Exception):
    """A program that did not run to its end, or not to a converged result."""


@dataclasses.dataclass
class Run:
    """One process: wall time (s), peak memory (bytes), total normal force (kN), solve alone (s) or None."""
    wall: float
    peak_memory: int
    normal_force: float
    solve: float | None


class Scabo:
    """All result files are written; `solve` is the program's own total without reading and writing."""

    def __init__(self, program, size=None):
        self.name = f"Scabo, {size or 0.375:g} m"            # 0.375 m is the model file's
        self.command = [str(program), "run", str(MODEL), "--quiet", "-o", "results"]
        if size:
            for body in ("lower", "upper"):
                self.command += ["--set", f"bodies.{body}.mesh.size={size}"]

    def prepare(self, folder):
        pass

    def read(self, folder):
        summary = json.loads((folder / "results" / "summary.json").read_text())
        last, timing = summary["increments"][-1], summary["timing"]
        if not last["converged"]:
            raise Failure(f"{self.name}: not converged")
        return (last["contacts"]["joint"]["normal_force"] / 1e3,
                timing["total"] - timing["read"] - timing["write"])


class GetFEM:
    name = f"GetFEM, {SIZE:g} m"

    def __init__(self, python):
        self.command = [python, str(HERE / "getfem_beams.py"), "--size", str(SIZE), "--friction", str(FRICTION)]

    def prepare(self, folder):
        pass

    def read(self, folder):
        return json.loads((folder / "stdout").read_text().splitlines()[-1])["normal_force"], None


class CalculiX:
    """Writing the input file is not timed. Status 0 alone does not say that ccx has a result: look for it."""
    name = f"CalculiX, {SIZE:g} m"

    def __init__(self, program):
        self.command = [program, "beams"]

    def prepare(self, folder):
        (folder / "beams.inp").write_text(calculix_beams.deck(SIZE, FRICTION))

    def read(self, folder):
        lines = (folder / "beams.dat").read_text().split("\n")
        totals = [lines[i + 2] for i, line in enumerate(lines) if "set FIXED_LOWER" in line]
        if len(totals) != 1 or "*ERROR" in (folder / "stdout").read_text():
            raise Failure(f"{self.name}: no result in beams.dat")
        return float(totals[0].split()[1]) / 1e3, None


def measure(program):
    """Runs the program once in a folder of its own."""
    with tempfile.TemporaryDirectory(prefix="scabo-peers-") as name:
        folder = pathlib.Path(name)
        program.prepare(folder)
        with open(folder / "stdout", "wb") as out, open(folder / "stderr", "wb") as err:
            start = time.perf_counter()
            process = subprocess.Popen(program.command, cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=err)
            _, status, usage = os.wait4(process.pid, 0)
            wall = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            message = (folder / "stderr").read_text(errors="replace")[-500:]
            raise Failure(f"{program.name}: exit status {process.returncode}\n{message}")
        try:
            force, solve = program.read(folder)
        except (OSError, ValueError, KeyError, IndexError) as error:
            raise Failure(f"{program.name}: no contact force in its output ({error!r})") from error
        return Run(wall, usage.ru_maxrss * 1024, force, solve)     # Linux counts in KiB


def memory_floor():
    """Bytes. A child starts as a copy of this process, and the operating system counts that copy too."""
    process = subprocess.Popen(["true"])
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return usage.ru_maxrss * 1024


def python_with_getfem(wanted):
    """Path of a Python that can import getfem, or None. Debian's is not always the first on the path."""
    for candidate in [wanted] if wanted else [sys.executable, "python3", "/usr/bin/python3"]:
        python = shutil.which(candidate)
        if python and subprocess.run([python, "-c", "import getfem"], capture_output=True).returncode == 0:
            return os.path.abspath(python)
    return None


def find_programs(arguments):
    """Programs found here, and one line for each one missing."""
    programs, missing = [], []
    scabo = pathlib.Path(arguments.scabo).resolve()
    if scabo.is_file():
        programs += [Scabo(scabo, SIZE), Scabo(scabo)]
    else:
        missing.append(f"scabo not found at {arguments.scabo}: build it, or name it with --scabo")
    python = python_with_getfem(arguments.python)
    if python:
        programs.append(GetFEM(python))
    else:
        missing.append("no Python that can import getfem: apt-get install python3-getfem")
    ccx = shutil.which("ccx")
    if ccx:
        programs.append(CalculiX(os.path.abspath(ccx)))
    else:
        missing.append("ccx not found: apt-get install calculix-ccx")
    return programs, missing


def run_in_turn(programs, repeat):
    """Name -> runs, after one warm-up each."""
    runs = {program.name: [] for program in programs}
    for turn in range(repeat + 1):
        for program in programs:
            result = measure(program)
            if turn > 0:
                runs[program.name].append(result)
        print(f"turn {turn} of {repeat} done", file=sys.stderr)
    return runs


def spread(values):
    """median [smallest, largest], to three digits."""
    return f"{statistics.median(values):.3g} [{min(values):.3g}, {max(values):.3g}]"


def table(runs):
    """Markdown. The ratio is to the first row if that is Scabo, on the same element size."""
    first = next(iter(runs))
    reference = statistics.median(r.wall for r in runs[first]) if first.startswith("Scabo") else None
    lines = ["| program, element size | wall time, s | solve alone, s | peak memory, MB | total normal force, kN "
             "| error, % | wall time / Scabo's |", "|---|---|---|---|---|---|---|"]
    for name, results in runs.items():
        walls, solves = [r.wall for r in results], [r.solve for r in results]
        memory = statistics.median(r.peak_memory for r in results) / 1e6
        force = statistics.median(r.normal_force for r in results)
        error = 100.0 * (force / CONVERGED_FORCE - 1.0)
        solve = "-" if None in solves else spread(solves)
        ratio = f"{statistics.median(walls) / reference:.3g}" if reference else "-"
        lines.append(f"| {name} | {spread(walls)} | {solve} | {memory:.1f} | {force:.4f} | {error:+.4f} | {ratio} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeat", type=int, default=5, help="counted runs of each program (default 5)")
    parser.add_argument("--json", metavar="FILE", help="save every run's figures")
    parser.add_argument("--scabo", metavar="PATH", default=str(ROOT / "build" / "bin" / "scabo"))
    parser.add_argument("--python", metavar="PATH", help="a Python that can import getfem (default: search)")
    arguments = parser.parse_args()
    if arguments.repeat < 1:
        parser.error("--repeat must be at least 1")

    programs, missing = find_programs(arguments)
    for line in missing:
        print(line, file=sys.stderr)
    if not programs:
        return 1
    threads = [f"{name}={os.environ[name]}" for name in THREAD_VARIABLES if name in os.environ]
    machine = {"cores": len(os.sched_getaffinity(0)), "thread_variables": threads, "memory_floor": memory_floor()}
    try:
        runs = run_in_turn(programs, arguments.repeat)
    except Failure as failure:
        print(failure, file=sys.stderr)
        return 1

    print(table(runs))
    print(f"\nMedian [smallest, largest] of {arguments.repeat} runs. Error against {CONVERGED_FORCE} kN. "
          f"{machine['cores']} cores; thread variables set: {', '.join(threads) or 'none'}. "
          f"Peak memory cannot read below {machine['memory_floor'] / 1e6:.1f} MB, the size of this script.")
    if arguments.json:
        saved = {"machine": machine, "converged_force_kN": CONVERGED_FORCE,
                 "runs": {name: [dataclasses.asdict(r) for r in results] for name, results in runs.items()}}
        pathlib.Path(arguments.json).write_text(json.dumps(saved, indent=2) + "\n")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
