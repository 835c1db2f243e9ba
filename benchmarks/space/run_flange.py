#!/usr/bin/env python3
"""A bolted flange in space (flange.py): Scabo and CalculiX on the same meshes of quadratic tetrahedra, one thread each.

    run_flange.py --scabo build/bin/scabo [--levels 3] [--penalties 1e4,1e5,1e6,1e7] [--json figures.json] [--no-calculix]

For each mesh: degrees of freedom, errors of the force of the joint and of its pressure, processor seconds, memory, after the bolt was tightened and the flange
pulled. The pressure is that on a circle around the hole; its error is the mean square over the circle, over the largest value there. Both are compared with
Scabo on the mesh of `REFERENCE`.
"""
import argparse
import json
import pathlib
import sys
import tempfile

import numpy as np
from scipy.interpolate import LinearNDInterpolator

import flange
from run import timed

LEVELS = [8, 5, 3.5, 2.6]  # size of elements at the bolt, mm
REFERENCE = 2.0


def on_circle(points, pressures):
    """Linear between the places where a program gives it."""
    return LinearNDInterpolator(points, pressures)(flange.places())


def with_scabo(program, folder, fine):
    (folder / "flange.yaml").write_text(flange.model(fine), encoding="utf-8")
    run = timed([program, "run", "flange.yaml", "-q", "--threads", "1"], folder)
    if run["status"]:
        raise RuntimeError(run["said"])
    summary = json.loads((folder / "flange.results" / "summary.json").read_text(encoding="utf-8"))
    last = summary["increments"][-1]
    table = np.genfromtxt(folder / "flange.results" / "contact.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
    joint = table[(table["contact"] == "joint") & (table["step"] == 2)]
    return {**run, "dofs": summary["model"]["dofs"], "pairs": sum(of[state] for of in last["contacts"].values() for state in ("open", "stick", "slip")),
            "force": last["contacts"]["joint"]["normal_force"][2], "pressure": on_circle(np.column_stack([joint["x"], joint["y"]]), joint["pressure"]).tolist()}


def contact_values(frd):
    """Place and pressure of the nodes in the last block CONTACT of a result file: the fourth of its values, with twelve characters each."""
    points, values, block = {}, {}, ""
    with open(frd, encoding="latin-1") as file:
        for line in file:
            if line.startswith("    2C"):
                block = "points"
            elif line.startswith(" -4"):
                block = line.split()[1]
                values = {} if block == "CONTACT" else values
            elif line.startswith(" -3"):
                block = ""
            elif line.startswith(" -1") and block == "points":
                points[int(line[3:13])] = [float(line[13 + 12 * k:25 + 12 * k]) for k in range(3)]
            elif line.startswith(" -1") and block == "CONTACT":
                values[int(line[3:13])] = float(line[13 + 36:13 + 48])
    return np.array([points[node] for node in values]), np.array(list(values.values()))


def with_calculix(folder, penalty):
    (folder / "ccx.inp").write_text(flange.deck(folder / "flange.results", penalty), encoding="utf-8")
    run = timed(["ccx", "-i", "ccx"], folder)
    lines = [line.split() for line in (folder / "ccx.dat").read_text().splitlines() if line.strip()] if (folder / "ccx.dat").exists() else []
    if run["status"] or len(lines) < 2:
        return {**run, "force": None, "pressure": None}
    points, values = contact_values(folder / "ccx.frd")
    at_joint = np.abs(points[:, 2]) < 1e-6
    return {**run, "force": -float(lines[-1][2]) - flange.PULL, "pressure": on_circle(points[at_joint, :2], values[at_joint]).tolist()}


def row(name, run, reference):
    if run["force"] is None:
        return f"{name:28} did not end with a result: {run['said'][-80:]!r}; {run['processor']:.0f} s"
    expected = np.array(reference["pressure"])
    error = np.sqrt(np.mean((np.array(run["pressure"]) - expected) ** 2)) / expected.max()
    return (f"{name:28} force {100 * (run['force'] / reference['force'] - 1):+7.3f} %   pressure {100 * error:6.2f} %   "
            f"{run['processor']:8.1f} s   {run['memory'] / 1e6:7.0f} MB")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scabo", type=pathlib.Path, required=True)
    parser.add_argument("--levels", type=int, default=len(LEVELS))
    parser.add_argument("--penalties", default="1e4,1e5,1e6,1e7")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--no-calculix", action="store_true")
    options = parser.parse_args()
    program = options.scabo.resolve()
    figures = []
    with tempfile.TemporaryDirectory(prefix="scabo_bench_") as holder:
        folder = pathlib.Path(holder)
        reference = with_scabo(program, folder, REFERENCE)
        print(f"reference: {reference['dofs']} degrees of freedom, {reference['pairs']} pairs, force {reference['force']:.1f} N, largest pressure on the circle "
              f"{max(reference['pressure']):.2f} MPa; {reference['processor']:.0f} s, {reference['memory'] / 1e6:.0f} MB", flush=True)
        for fine in LEVELS[:options.levels]:
            own = with_scabo(program, folder, fine)
            print(f"\n{own['dofs']} degrees of freedom, {own['pairs']} pairs\n" + row("Scabo", own, reference), flush=True)
            figures.append({"size": fine, "scabo": own})
            for penalty in [] if options.no_calculix else map(float, options.penalties.split(",")):
                other = with_calculix(folder, penalty)
                print(row(f"CalculiX, {penalty:g} N/mm3", other, reference), flush=True)
                figures[-1][f"calculix {penalty:g}"] = other
    if options.json:
        options.json.write_text(json.dumps({"reference": reference, "runs": figures}, indent=1), encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
