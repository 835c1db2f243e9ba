#!/usr/bin/env python3
"""Stacks of rigid bodies (stacks.py): Scabo's contact solver beside Siconos's NSGS, 34 seeded problems.

    rigid.py [--scabo PATH] [--seconds 20] [--only WORD] [--folder FOLDER] [--hard FOLDER] [--with scabo,nsgs] [--keep FILE] [--output FILE]

Towers, walls in running bond and piles, 112 to 2,286 contacts, mu 0.1 to 1.5, ratio of masses to 1000. One process and one thread a
problem; solved: a scaled natural map of at most 5e-9 (W and q times 1 / mean W_ii), recomputed from r by problems.natural_map, in
`seconds` of processor time. With --hard, a folder of further problem files. The table, the share solved and the names of the rest are
printed and, with --output, written after every problem. --keep holds what has been measured, which is not measured again: the two
programs may run one after the other (--with scabo, then --with nsgs).
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

import numpy

import problems
import run
import stacks

LIMIT = 5e-9


def natural_map_in_forces(problem, r):
    if problem.contacts == 0:
        return 0.0
    stiffness = 1.0 / problem.W.diagonal().mean()
    scaled = problems.Problem(problem.name, problem.dimension, stiffness * problem.W, stiffness * problem.q, problem.mu)
    return problems.natural_map(scaled, r)


def with_scabo(arguments, path, problem):
    # 0.9 of the limit: the residual is recomputed in another order of summation
    command = [str(arguments.scabo), "contact", str(path), "--tolerance", str(0.9 * LIMIT), "--json"]
    out, error, status, processor = run.run_process(command, arguments.seconds)
    try:
        answer = json.loads(out)
    except json.JSONDecodeError:
        return {"seconds": None, "residual": None, "solved": False, "how": "time limit" if status is None else run.last_lines(error)}
    seconds, residual = min(answer["seconds"], processor + 0.01), natural_map_in_forces(problem, answer["r"])
    return {"seconds": seconds, "residual": residual, "solved": residual <= LIMIT and seconds <= arguments.seconds,
            "how": f"{answer['iterations']}"}


def with_nsgs(arguments, path, problem):
    out, _, _, _ = run.run_process([sys.executable, str(run.HERE / "siconos_worker.py"), str(path), "NSGS", "--limit", str(LIMIT)],
                                   arguments.seconds)
    runs = [json.loads(line) for line in out.splitlines() if line.startswith("{")]
    if not runs:
        return {"seconds": None, "residual": None, "solved": False}
    last = runs[-1]
    return {"seconds": last["seconds"], "residual": last["residual"],
            "solved": last["residual"] <= LIMIT and last["seconds"] <= arguments.seconds}


def text_of(cell):
    if cell is None:
        return "not run", ""
    residual = "" if cell["residual"] is None else f"{cell['residual']:.1e}"
    return (f"{cell['seconds']:.3g}" if cell["solved"] else "-"), residual


def table(rows):
    lines = ["| problem | contacts | mu | Scabo, s | residual | Newton iterations | Siconos NSGS, s | residual |", "|---|---|---|---|---|---|---|---|"]
    for row in rows:
        ours, theirs = text_of(row["scabo"]), text_of(row["nsgs"])
        lines.append(f"| {row['name']} | {row['contacts']} | {row['mu']:g} | {ours[0]} | {ours[1]} | {row['scabo']['how'] if row['scabo'] else ''} | {theirs[0]} | {theirs[1]} |")
    ours = [row for row in rows if row["scabo"]]
    solved = [row for row in ours if row["scabo"]["solved"]]
    lines += ["", f"Scabo: {len(solved)} of {len(ours)}."]
    rest = [row["name"] for row in ours if not row["scabo"]["solved"]]
    if rest:
        lines.append("Not solved: " + ", ".join(rest) + ".")
    if any(row["nsgs"] for row in rows):
        theirs = [row for row in rows if row["nsgs"]]
        lines.append(f"Siconos NSGS: {sum(row['nsgs']['solved'] for row in theirs)} of {len(theirs)}.")
        slower = [row["name"] for row in ours if row["nsgs"] and row["nsgs"]["solved"]
                  and not (row["scabo"]["solved"] and row["scabo"]["seconds"] <= row["nsgs"]["seconds"])]
        lines.append("Slower than NSGS, or not solved where NSGS is: " + (", ".join(slower) or "none") + ".")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scabo", default=str(run.ROOT / "build" / "bin" / "scabo"), type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--only", default="", help="problems with this word in their names")
    parser.add_argument("--folder", type=pathlib.Path, help="where the problems are kept; made again where it is empty")
    parser.add_argument("--hard", type=pathlib.Path, help="further problem files")
    parser.add_argument("--with", dest="programs", default="scabo,nsgs", help="NSGS's 20 s on most problems take most of the time")
    parser.add_argument("--keep", type=pathlib.Path, help="JSON")
    parser.add_argument("--output", type=pathlib.Path)
    arguments = parser.parse_args()
    if not shutil.which(str(arguments.scabo)):
        sys.exit(f"{arguments.scabo} is missing: make build")
    programs = {"scabo": with_scabo, "nsgs": with_nsgs}
    wanted = [name for name in arguments.programs.split(",") if name in programs]
    if "nsgs" in wanted and subprocess.run([sys.executable, "-c", "import siconos.numerics"], capture_output=True).returncode != 0:
        print("Siconos is missing (package python3-siconos): Scabo runs alone", file=sys.stderr)
        wanted.remove("nsgs")
    kept = json.loads(arguments.keep.read_text()) if arguments.keep and arguments.keep.exists() else {}
    rows = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = arguments.folder or pathlib.Path(scratch)
        files = sorted(folder.glob("*.hdf5")) if folder.is_dir() else []
        files = files or sorted(stacks.write_all(folder))
        files += sorted(arguments.hard.glob("*.hdf5")) if arguments.hard else []
        for path in files:
            if arguments.only not in path.stem:
                continue
            problem = problems.read(path)
            # A further file may have the name of a seeded problem and as many contacts: tower20_m3_mu0.4.
            cells = kept.setdefault(f"{problem.name}, {problem.contacts}, |q| = {numpy.linalg.norm(problem.q):.9g}", {})
            for name in wanted:
                if name not in cells:
                    cells[name] = programs[name](arguments, path, problem)
            if arguments.keep:
                arguments.keep.write_text(json.dumps(kept, indent=1))
            rows.append({"name": problem.name, "contacts": problem.contacts, "mu": float(problem.mu.max()) if problem.contacts else 0.0,
                         **{name: cells.get(name) for name in programs}})
            print(table(rows[-1:]).splitlines()[2], file=sys.stderr, flush=True)
            if arguments.output:
                arguments.output.write_text(table(rows) + "\n")
    print(table(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
