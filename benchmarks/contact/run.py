#!/usr/bin/env python3
"""Scabo's contact solvers beside Siconos's on a folder of discrete problems.

    run.py [FOLDER] [--scabo PATH] [--repeats 5] [--seconds 8] [--solvers a,b] [--output FOLDER] [--add]

Every solver gets every problem in a process of its own with a time limit, so that a crash or an endless loop costs that solver that
problem and no more. One function (problems.natural_map) recomputes the residual of every answer from the problem file;
solved is at most 1e-8. Times are those of the solver alone: Scabo's `seconds`, for Siconos the call of its driver; reading and
conversion of the matrix to the storage it likes are not counted for either. Wall time or processor time, whichever is less:
they differ where others use the machine. Median of the repeats; one thread. Without a
folder, or where it has no problems, Scabo makes some itself (generate.py).

Written to --output: results.json, table.md, profiles.png. Exit status 1 if a program is missing. See ../README.md.
"""
import argparse
import json
import os
import pathlib
import resource
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile

import generate
import problems
import profiles

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
LIMIT = 1e-8          # natural-map residual of what counts as solved
START = 3.0           # seconds beyond the limit of a solve for a process to start, read and repeat
SICONOS = {3: ("NSGS", "NSN-AC", "NSN-FB"), 2: ("NSGS", "Lemke")}
SCABO = {3: ("b_differentiable", "alart_curnier", "fischer_burmeister", "gauss_seidel", "tresca", "proximal_point",
             "trial_and_error"),
         2: ("b_differentiable", "alart_curnier", "fischer_burmeister", "gauss_seidel", "lemke", "tresca", "proximal_point",
             "trial_and_error")}
ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", PYTHONWARNINGS="ignore")


def finite(value):
    return value if value == value and abs(value) != float("inf") else None


def last_lines(text, count=1):
    lines = [line.strip() for line in text.strip().splitlines() if line.strip()]
    return " ".join(lines[-count:])[:160]


def run_process(command, seconds):
    """stdout, stderr, exit status (None: the time limit), processor time. The limit is of processor time, so that a busy machine
    changes nothing; a process that waits is ended after twenty times as long."""
    limit = int(seconds + START + 1.0)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=20.0 * limit, env=ENVIRONMENT,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)))
        out, error, status = done.stdout, done.stderr, done.returncode
    except subprocess.TimeoutExpired as expired:
        text = lambda stream: (stream or b"").decode(errors="replace") if isinstance(stream, bytes) else (stream or "")
        out, error, status = text(expired.stdout), text(expired.stderr), None
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if status in (-signal.SIGXCPU, -signal.SIGKILL):
        status = None
    return out, error, status, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def outcome(residual, seconds, iterations, why):
    residual = float("inf") if residual is None else residual
    solved = residual <= LIMIT
    return {"solved": solved, "residual": finite(residual), "seconds": statistics.median(seconds) if seconds else None,
            "smallest": min(seconds, default=None), "iterations": iterations, "why": "" if solved else why}


def with_siconos(arguments, path, problem, solver):
    command = [sys.executable, str(HERE / "siconos_worker.py"), str(path), solver, "--repeats", str(arguments.repeats),
               "--limit", str(LIMIT)]
    out, error, status, _ = run_process(command + ["--budget", str(arguments.seconds)], arguments.seconds)
    runs = [json.loads(line) for line in out.splitlines() if line.startswith("{")]
    why = "time limit" if status is None else f"crash ({last_lines(error)})" if status != 0 else ""
    if not runs:
        return outcome(None, [], None, why)
    last = runs[-1]                                              # at the tolerance that sufficed, or the last one tried
    counted = [run for run in runs if run["tolerance"] == last["tolerance"]]
    seconds = [run["seconds"] for run in counted]
    residual = max(run["residual"] for run in counted)
    if residual > LIMIT and not why:
        why = f"{last['ended']} at its tolerance {last['tolerance']:g}"
    elif residual > LIMIT:
        why += f" after {last['ended']} at its tolerance {last['tolerance']:g}"
    if min(seconds) > arguments.seconds:
        return outcome(None, [], None, "time limit")
    return outcome(residual, seconds, last["iterations"], why)


def with_scabo(arguments, path, problem, solver):
    seconds, residuals, iterations, why = [], [], None, ""
    for _ in range(arguments.repeats):
        command = [str(arguments.scabo), "contact", str(path), "--solver", solver, "--tolerance", str(LIMIT / 2), "--json"]
        out, error, status, processor = run_process(command, arguments.seconds)
        try:
            answer = json.loads(out)
        except json.JSONDecodeError:
            return outcome(None, [], None, "time limit" if status is None else f"crash: {last_lines(error)}")
        # On a busy machine a process waits: its whole processor time is then the better bound.
        seconds.append(min(answer["seconds"], processor + 0.01))
        if seconds[-1] > arguments.seconds:
            return outcome(None, [], None, "time limit")
        residuals.append(problems.natural_map(problem, answer["r"]))
        iterations, why = answer["iterations"], answer.get("reason") or answer["status"]
        if residuals[-1] > LIMIT or seconds[-1] > 0.25 * arguments.seconds:
            break
    return outcome(max(residuals), seconds, iterations, why)


def measure(arguments, files, results):
    for path in files:
        problem = problems.read(path)
        row = results.setdefault(problem.name, {"dimension": problem.dimension, "contacts": problem.contacts, "solvers": {}})
        for solver in SCABO[problem.dimension]:
            if not arguments.solvers or f"Scabo {solver}" in arguments.solvers:
                row["solvers"][f"Scabo {solver}"] = with_scabo(arguments, path, problem, solver)
        for solver in SICONOS[problem.dimension]:
            if not arguments.solvers or f"Siconos {solver}" in arguments.solvers:
                row["solvers"][f"Siconos {solver}"] = with_siconos(arguments, path, problem, solver)
        write(arguments.output, results, arguments.take)
        best = {name: cell["seconds"] for name, cell in row["solvers"].items() if cell["solved"]}
        print(f"{problem.name} ({problem.contacts}): solved by {len(best)} of {len(row['solvers'])}"
              + (f", fastest {min(best, key=best.get)}" if best else ""), file=sys.stderr, flush=True)
    return results


def cell_text(cell, take):
    if cell is None:
        return ""
    if not cell["solved"]:
        return "-"
    return f"{1e3 * cell[take]:.3g} ({cell['iterations']})"


def tables(results, take):
    lines = []
    for dimension in (3, 2):
        rows = {name: row for name, row in results.items() if row["dimension"] == dimension}
        if not rows:
            continue
        solvers = list(dict.fromkeys(solver for row in rows.values() for solver in row["solvers"]))
        lines += [f"### {'In space' if dimension == 3 else 'In the plane'}: time in ms (iterations); - : not solved", "",
                  "| problem | contacts | " + " | ".join(solvers) + " |", "|---|---|" + "---|" * len(solvers)]
        for name, row in rows.items():
            lines.append(f"| {name} | {row['contacts']} | "
                         + " | ".join(cell_text(row["solvers"].get(solver), take) for solver in solvers) + " |")
        shares, fastest = [], []
        for solver in solvers:
            cells = [row["solvers"].get(solver) for row in rows.values()]
            shares.append(f"{sum(bool(cell and cell['solved']) for cell in cells)} of {len(rows)}")
            fastest.append(str(sum(solver == fastest_of(row, take) for row in rows.values())))
        lines += ["| **solved** | | " + " | ".join(shares) + " |", "| **fastest** | | " + " | ".join(fastest) + " |", ""]
    lines += failures(results)
    return "\n".join(lines)


def fastest_of(row, take):
    solved = {solver: cell[take] for solver, cell in row["solvers"].items() if cell["solved"]}
    return min(solved, key=solved.get) if solved else None


def failures(results):
    lines = ["### Not solved, and why", "", "| problem | solver | residual | |", "|---|---|---|---|"]
    for name, row in results.items():
        for solver, cell in row["solvers"].items():
            if not cell["solved"]:
                residual = "-" if cell["residual"] is None else f"{cell['residual']:.1e}"
                lines.append(f"| {name} | {solver} | {residual} | {cell['why'].replace('|', '/')} |")
    return lines


def times(results, dimension, take):
    seconds = {}
    for name, row in results.items():
        if row["dimension"] != dimension:
            continue
        for solver, cell in row["solvers"].items():
            seconds.setdefault(solver, {})
            if cell["solved"]:
                seconds[solver][name] = cell[take]
    return seconds, sum(row["dimension"] == dimension for row in results.values())


def write(folder, results, take):
    (folder / "results.json").write_text(json.dumps(results, indent=1))
    (folder / "table.md").write_text(tables(results, take) + "\n")


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", default=str(ROOT.parent / "shared" / "data" / "fclib"), type=pathlib.Path)
    parser.add_argument("--scabo", default=str(ROOT / "build" / "bin" / "scabo"), type=pathlib.Path)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=8.0, help="limit of one solve, processor time")
    parser.add_argument("--solvers", type=lambda text: text.split(","), help='as in "Scabo b_differentiable,Siconos NSGS"')
    parser.add_argument("--take", choices=("seconds", "smallest"), default="seconds",
                        help="of the repeats: the median, or the smallest (steadier on a busy machine)")
    parser.add_argument("--add", action="store_true", help="to the results that stand in --output")
    parser.add_argument("--output", default=pathlib.Path("bench-contact"), type=pathlib.Path)
    return parser.parse_args()


def main():
    arguments = parse()
    only_siconos = arguments.solvers and all(name.startswith("Siconos") for name in arguments.solvers)
    if not only_siconos and not shutil.which(str(arguments.scabo)):
        sys.exit(f"{arguments.scabo} is missing: make build")
    has_siconos = subprocess.run([sys.executable, "-c", "import siconos.numerics"], capture_output=True).returncode == 0
    if not has_siconos:
        print("Siconos is missing (package python3-siconos): Scabo runs alone", file=sys.stderr)
        SICONOS.update({2: (), 3: ()})
    arguments.output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        files = sorted(pathlib.Path(arguments.folder).glob("*.hdf5"))
        if not files:
            print(f"no problems in {arguments.folder}: Scabo makes its own", file=sys.stderr)
            files = generate.problems_of_scabo(arguments.scabo, pathlib.Path(scratch))
        kept = arguments.output / "results.json"
        results = measure(arguments, files, json.loads(kept.read_text()) if arguments.add and kept.exists() else {})
    panels = {title: times(results, dimension, arguments.take) for title, dimension in (("In space", 3), ("In the plane", 2))}
    profiles.draw({title: panel for title, panel in panels.items() if panel[1]}, arguments.output / "profiles.png",
                  f"natural-map residual <= {LIMIT:g}, {arguments.seconds:g} s a solve, one thread")
    print(tables(results, arguments.take))
    return 0 if has_siconos else 1


if __name__ == "__main__":
    sys.exit(main())
