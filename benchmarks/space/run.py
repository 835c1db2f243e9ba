#!/usr/bin/env python3
"""A ball on a block in space: Scabo and CalculiX on the same meshes of quadratic tetrahedra, one thread each.

    run.py --scabo build/bin/scabo [--levels 3] [--penalties 1e13,1e14,1e15] [--json figures.json] [--no-calculix]

For each mesh: degrees of freedom, errors of the force on the block and of the largest pressure, processor seconds, memory. The force is
compared with that of Scabo on the finest mesh of `REFERENCE`, the pressure with Hertz's under this force. CalculiX's answer depends on its penalty,
which is part of the deck: every one of --penalties is run. Contact of surfaces with each other, as its manual recommends.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import ball

LEVELS = [(2e-3, 0.5), (1.2e-3, 0.5), (0.6e-3, 0.5), (0.3e-3, 0.5)]  # size at the contact, growth
REFERENCE = (0.2e-3, 0.4)
PATIENCE = 3600  # processor seconds


def timed(words, folder, **environment):
    """Wall and processor seconds, peak of memory in bytes, and the end of what it printed."""
    start = time.monotonic()
    with open(folder / "out.txt", "w+", encoding="utf-8") as out:
        process = subprocess.Popen([*map(str, words)], cwd=folder, stdout=out, stderr=subprocess.STDOUT,
                                   env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", **environment})
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        said = out.read()
    return {"wall": time.monotonic() - start, "processor": usage.ru_utime + usage.ru_stime, "memory": usage.ru_maxrss * 1024,
            "status": process.returncode, "said": said[-400:]}


def with_scabo(program, folder, level):
    (folder / "ball.yaml").write_text(ball.model(*level), encoding="utf-8")
    run = timed([program, "run", "ball.yaml", "-q", "--threads", "1"], folder)
    if run["status"]:
        raise RuntimeError(run["said"])
    summary = json.loads((folder / "ball.results" / "summary.json").read_text(encoding="utf-8"))
    joint = summary["increments"][-1]["contacts"]["joint"]
    return {**run, "dofs": summary["model"]["dofs"], "pairs": joint["open"] + joint["stick"] + joint["slip"], "force": joint["normal_force"][2],
            "pressure": joint["max_pressure"]}


def with_calculix(folder, penalty):
    (folder / "ccx.inp").write_text(ball.deck(folder / "ball.results", penalty), encoding="utf-8")
    run = timed(["ccx", "-i", "ccx"], folder)
    forces = re.findall(r"total force.*\n\n\s*(\S+)\s+(\S+)\s+(\S+)", (folder / "ccx.dat").read_text()) if (folder / "ccx.dat").exists() else []
    if run["status"] or not forces:
        return {**run, "force": None, "pressure": None}
    return {**run, "force": float(forces[-1][2]), "pressure": largest_pressure(folder / "ccx.frd")}


def largest_pressure(frd):
    """Of CSTR in the last block CONTACT of a result file: the fourth of six values with twelve characters each."""
    largest, inside = 0.0, False
    with open(frd, encoding="latin-1") as file:
        for line in file:
            if line.startswith(" -4"):
                inside = line.split()[1] == "CONTACT"
                largest = 0.0 if inside else largest
            elif inside and line.startswith(" -1"):
                largest = max(largest, float(line[13 + 36:13 + 48]))
    return largest


def row(name, run, force):
    if run["force"] is None:
        return f"{name:28} did not end with a result: {run['said'][-80:]!r}; {run['processor']:.0f} s"
    expected = ball.hertz_pressure(force)
    return (f"{name:28} force {100 * (run['force'] / force - 1):+7.3f} %   pressure {100 * (run['pressure'] / expected - 1):+7.2f} %   "
            f"{run['processor']:8.1f} s   {run['memory'] / 1e6:7.0f} MB")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scabo", type=pathlib.Path, required=True)
    parser.add_argument("--levels", type=int, default=len(LEVELS))
    parser.add_argument("--penalties", default="1e13,1e14,1e15")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--no-calculix", action="store_true")
    options = parser.parse_args()
    program = options.scabo.resolve()
    figures = []
    with tempfile.TemporaryDirectory(prefix="scabo_bench_") as holder:
        folder = pathlib.Path(holder)
        reference = with_scabo(program, folder, REFERENCE)
        print(f"reference: {reference['dofs']} degrees of freedom, {reference['pairs']} pairs, force {reference['force']:.2f} N of a quarter, largest pressure "
              f"{reference['pressure'] / 1e6:.2f} MPa, Hertz {ball.hertz_pressure(reference['force']) / 1e6:.2f}; {reference['processor']:.0f} s", flush=True)
        for level in LEVELS[:options.levels]:
            own = with_scabo(program, folder, level)
            print(f"\n{own['dofs']} degrees of freedom, {own['pairs']} pairs")
            print(row("Scabo", own, reference["force"]), flush=True)
            figures.append({"level": level, "scabo": own})
            for penalty in [] if options.no_calculix else map(float, options.penalties.split(",")):
                other = with_calculix(folder, penalty)
                print(row(f"CalculiX, {penalty:g} Pa/m", other, reference["force"]), flush=True)
                figures[-1][f"calculix {penalty:g}"] = other
    if options.json:
        options.json.write_text(json.dumps({"reference": reference, "runs": figures}, indent=1), encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
