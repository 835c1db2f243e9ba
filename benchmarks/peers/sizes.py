#!/usr/bin/env python3
"""Scabo, GetFEM and CalculiX at equal error of the total contact force, up to 1e5 degrees of freedom of the peers.

    benchmarks/peers/sizes.py [--problem beams|block] [--most 1e5] [--seconds 400] [--repeat 3] [--json FILE]

Two problems: the double cantilever beam (calculix_beams.py, getfem_beams.py) and a block with a round bottom on a floor (round_block.py).
Whole processes are measured, files included: wall and processor seconds, peak memory; one thread each; median of --repeat runs, of runs of
more than 5 s one run. A process ends after --seconds of processor time.

Every row of a peer is compared with the cheapest row of Scabo of which it and all finer rows of the same kind of mesh have at most the error
of the peer, so that no accidental zero of Scabo counts; those of the peers do. Bodies of Scabo are one super-element; a quadtree of
super-elements that is finer along the contact (the block); or one that is finer where contact ends and at corners, of higher order the finer
it is ("graded"). GetFEM's beams are equal squares of order 2, as CalculiX's are, or lines that are closer where it matters with elements of
order 4, the best that was found. REFERENCE holds the converged forces. Degrees of freedom of CalculiX are those of its plane mesh; it
computes with a layer of solid elements.
"""
import argparse
import dataclasses
import json
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

import calculix_beams
import round_block
from run import CONVERGED_FORCE, MODEL, ROOT, python_with_getfem

HERE = pathlib.Path(__file__).resolve().parent
REFERENCE = {"beams": CONVERGED_FORCE, "block": 7188.038}  # kN; the block by quadtrees of orders 3 to 6, all within 0.0015 kN
BEAMS = (8, 15, 24, 44)        # elements over the height of a beam: 3.4e3, 1.1e4, 2.8e4, 9.4e4 degrees of freedom
GETFEM_GRADED = ((0.05, 25834), (0.025, 43732))  # smallest distance of lines, m, order 4; degrees of freedom
BLOCK = (16, 40, 72, 128)      # elements along a side: 1.6e3, 9.9e3, 3.1e4, 9.9e4
SCABO_BEAMS = {"superelement": ((2, 0.375), (2, 0.1875), (2, 0.09375), (2, 0.046875), (2, 0.0234375)),  # order, size of elements, m
               "graded": ((3, 0.1), (4, 0.05), (4, 0.025), (5, 0.0125), (6, 0.00625))}                  # order, smallest size
CONTACT_END = 5.15             # m, where the contact of the beams begins; any mesh shows it
# Kind of mesh: orders, sizes, and sizes along the round side or where contact ends, and at a corner, m.
SCABO_BLOCK = {"superelement": ((2, 0.1, 0.05), (2, 0.1, 0.025), (2, 0.1, 0.0125), (2, 0.05, 0.00625)),
               "quadtree": ((2, 0.1, 0.05), (2, 0.1, 0.025), (2, 0.1, 0.0125), (2, 0.1, 0.00625)),
               "graded": ((2, 0.125, 0.05), (2, 0.125, 0.025), (2, 0.125, 0.0125), (4, 0.125, 0.0125), (6, 0.125, 0.00625))}
LONG = 5.0                     # s
ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")


@dataclasses.dataclass
class Case:
    program: str
    name: str
    command: list
    files: dict                  # name: text, written before the clock starts
    read: object                 # folder -> (force, kN; degrees of freedom)
    mesh: str = ""               # kind of Scabo's mesh: rows of one kind are refinements of each other


def of_scabo(folder):
    summary = json.loads((folder / "results" / "summary.json").read_text())
    if not summary["increments"][-1]["converged"]:
        raise ValueError("not converged")
    return summary["increments"][-1]["contacts"]["joint"]["normal_force"] / 1e3, summary["model"]["dofs"]


def of_getfem(folder):
    figures = json.loads((folder / "stdout").read_text().splitlines()[-1])
    return figures["normal_force"], figures["dofs"]


def of_calculix(dofs):
    def read(folder):
        lines = (folder / "deck.dat").read_text().split("\n")
        totals = [lines[i + 2] for i, line in enumerate(lines) if "total force" in line]
        if not totals or "*ERROR" in (folder / "stdout").read_text():
            raise ValueError("no result in deck.dat")
        return abs(float(totals[-1].split()[1])) / 1e3, dofs
    return read


def nodes_in(deck):
    """Number of nodes of a deck: lines after *NODE."""
    count, counts = 0, False
    for line in deck.splitlines():
        if line.startswith("*"):
            counts = line.split(",")[0] == "*NODE"
        else:
            count += counts
    return count


def beam_mesh(kind, order, size, low):
    """Value of `mesh` for the beam whose lower side is at `low`. A graded quadtree has cells of 0.375 m, of `size` at the corners of the built-in
    end and where contact begins, and of twice this at both ends of the tip; away from them they grow."""
    if kind == "superelement":
        return f"{{order: {order}, size: {size!r}}}"
    places = [(0.0, low, size, 0.5), (0.0, low + 1.5, size, 0.5), (CONTACT_END, 1.5, size, 0.4), (6.0, 1.5, 2 * size, 0.5)]
    if low > 0.0:
        places.append((6.0, 3.0, 2 * size, 0.5))  # the load
    refine = ", ".join(f"{{near: [{x!r}, {y!r}], size: {finest!r}, growth: {growth}}}" for x, y, finest, growth in places)
    return f"{{kind: quadtree, order: {order}, size: 0.375, refine: [{refine}]}}"


def cases(problem, most, scabo, python, ccx):
    run = [str(scabo), "run", "--quiet", "--threads", "1", "-o", "results"]
    if problem == "beams":
        for kind, meshes in SCABO_BEAMS.items():
            for order, size in meshes:
                words = [word for body, low in (("lower", 0.0), ("upper", 1.5))
                         for word in ("--set", f"bodies.{body}.mesh={beam_mesh(kind, order, size, low)}")]
                yield Case("Scabo", f"{kind}, order {order}, {size:g} m", [*run, str(MODEL), *words], {}, of_scabo, kind)
        for n in BEAMS:
            size = calculix_beams.HEIGHT / n
            if 12 * 4 * n * n > 1.3 * most:
                continue
            if python:
                yield Case("GetFEM", f"{size:.4g} m", [python, str(HERE / "getfem_beams.py"), "--size", repr(size)], {}, of_getfem)
            if ccx:
                deck = calculix_beams.deck(size, 0.2)
                yield Case("CalculiX", f"{size:.4g} m", [ccx, "deck"], {"deck.inp": deck}, of_calculix(2 * nodes_in(deck)))
        for finest, dofs in GETFEM_GRADED if python else ():
            if dofs <= 1.3 * most:
                words = ["--size", "0.375", "--order", "4", "--finest", repr(finest)]
                yield Case("GetFEM", f"graded, order 4, {finest:g} m", [python, str(HERE / "getfem_beams.py"), *words], {}, of_getfem)
    else:
        for kind, sizes in SCABO_BLOCK.items():
            for order, size, along in sizes:
                model = round_block.scabo_model(size, along, kind, order)
                yield Case("Scabo", f"{kind}, order {order}, {along:g} m", [*run, "block.yaml"], {"block.yaml": model}, of_scabo, kind)
        for n in BLOCK:
            if 6 * n * n > 1.3 * most:
                continue
            if python:
                yield Case("GetFEM", f"{n} x {n}", [python, str(HERE / "getfem_round_block.py"), "--elements", str(n)], {}, of_getfem)
            if ccx:
                for stiffness in (1e15, 1e16):
                    deck = round_block.calculix_deck(n, stiffness)
                    yield Case("CalculiX", f"{n} x {n}, {stiffness:g} Pa/m", [ccx, "deck"], {"deck.inp": deck}, of_calculix(2 * nodes_in(deck)))


def measure(case, seconds):
    """wall and processor seconds, bytes, force, degrees of freedom; or the reason why not."""
    with tempfile.TemporaryDirectory(prefix="scabo-peers-") as name:
        folder = pathlib.Path(name)
        for file, text in case.files.items():
            (folder / file).write_text(text, encoding="utf-8")
        with open(folder / "stdout", "wb") as out, open(folder / "stderr", "wb") as err:
            start = time.perf_counter()
            process = subprocess.Popen(case.command, cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=err, env=ENVIRONMENT,
                                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds) + 5)))
            _, status, usage = os.wait4(process.pid, 0)
            wall = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        processor = usage.ru_utime + usage.ru_stime
        if processor >= 0.98 * seconds:
            return f"over {seconds:.0f} s of processor time"
        if process.returncode != 0:
            return f"exit status {process.returncode}: {(folder / 'stderr').read_text(errors='replace').strip()[-200:]}"
        try:
            force, dofs = case.read(folder)
        except (OSError, ValueError, KeyError, IndexError) as error:
            return f"no force: {error}"
        return {"wall": wall, "processor": processor, "memory": usage.ru_maxrss * 1024, "force": force, "dofs": dofs}


def measured(case, repeat, seconds):
    runs = [measure(case, seconds)]
    if isinstance(runs[0], str):
        return runs[0]
    while len(runs) < repeat and runs[0]["processor"] < LONG:
        runs.append(measure(case, seconds))
    return {key: statistics.median(run[key] for run in runs) for key in runs[0]} | {"runs": len(runs)}


def as_exact_as(ours, error):
    """The cheapest of our rows of which it and all finer ones of its kind of mesh have at most this error; None if the finest have more."""
    exact = []
    for mesh in {row["mesh"] for row in ours}:
        for row in sorted((row for row in ours if row["mesh"] == mesh), key=lambda row: -row["dofs"]):
            if abs(row["error"]) > abs(error):
                break
            exact.append(row)
    return min(exact, key=lambda row: row["processor"], default=None)


def compare(problem, rows):
    lines = ["| program, size | degrees of freedom | total force, kN | error, % | wall, s | processor, s | memory, MB | Scabo at most as wrong: size, "
             "processor s, memory MB | processor time / Scabo's | memory / Scabo's |", "|" + "---|" * 10]
    ours = [row for row in rows if row["program"] == "Scabo" and "force" in row]
    for row in rows:
        if "force" not in row:
            lines.append(f"| {row['program']}, {row['name']} | {row['why']} |")
            continue
        text = [f"{row['program']}, {row['name']}", f"{row['dofs']:,.0f}", f"{row['force']:.6f}", f"{100 * row['error']:+.2g}",
                f"{row['wall']:.3g}", f"{row['processor']:.3g}", f"{row['memory'] / 1e6:.0f}"]
        if row["program"] == "Scabo":
            text += ["", "", ""]
        else:
            best = as_exact_as(ours, row["error"])
            text += [f"{best['name']}, {best['processor']:.3g}, {best['memory'] / 1e6:.0f}", f"{row['processor'] / best['processor']:.3g}",
                     f"{row['memory'] / best['memory']:.2g}"] if best else ["none here", "-", "-"]
        lines.append("| " + " | ".join(text) + " |")
    return f"{problem}, reference {REFERENCE[problem]} kN, load of the machine {os.getloadavg()[0]:.1f}:\n\n" + "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--problem", choices=["beams", "block"], help="one of them alone")
    parser.add_argument("--most", type=float, default=1e5, help="degrees of freedom of the peers")
    parser.add_argument("--seconds", type=float, default=400)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--only", help="Scabo, GetFEM or CalculiX")
    parser.add_argument("--scabo", default=ROOT / "build" / "bin" / "scabo", type=pathlib.Path)
    parser.add_argument("--python", help="a Python that can import getfem (default: search)")
    parser.add_argument("--json", type=pathlib.Path, help="keep the rows; rows that it has already are not measured again")
    arguments = parser.parse_args()
    python, ccx = python_with_getfem(arguments.python), shutil.which("ccx")
    for found, name in ((python, "GetFEM (python3-getfem)"), (ccx, "CalculiX (calculix-ccx)")):
        if not found:
            print(f"{name} is missing", file=sys.stderr)
    kept = json.loads(arguments.json.read_text()) if arguments.json and arguments.json.exists() else {}
    for problem in [arguments.problem] if arguments.problem else ["beams", "block"]:
        rows = []
        for case in cases(problem, arguments.most, arguments.scabo.resolve(), python, ccx):
            key = f"{problem}: {case.program}, {case.name}"
            if arguments.only and case.program != arguments.only and key not in kept:
                continue
            if key not in kept:
                result = measured(case, arguments.repeat, arguments.seconds)
                kept[key] = {"program": case.program, "name": case.name, "mesh": case.mesh} | ({"why": result} if isinstance(result, str) else result)
                print(f"{key}: {result if isinstance(result, str) else round(result['processor'], 2)}", file=sys.stderr, flush=True)
                if arguments.json:
                    arguments.json.write_text(json.dumps(kept, indent=1))
            row = dict(kept[key])
            if "force" in row:
                row["error"] = row["force"] / REFERENCE[problem] - 1.0 if REFERENCE[problem] else float("nan")
            rows.append(row)
        print(compare(problem, rows), flush=True)
    return 0 if python and ccx else 1


if __name__ == "__main__":
    sys.exit(main())
