#!/usr/bin/env python3
"""Solves decks of solids with contact by CalculiX (ccx), with and without NLGEOM, and, converted, by Scabo.

    benchmarks/convert/solids.py --scabo build/bin/scabo [--stiffer 100] DECK...

For each run: the force and the largest pressure of the contacts and the largest displacement after the last increment, of Scabo with the deck's stiffness of
contact as a modulus, where it is soft, and without it. --stiffer adds runs of CalculiX with that times the stiffness of contact and of sticking.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python" / "scabo"))
from plot import vtu  # noqa: E402

OUTPUT = ("NODE FILE", "EL FILE", "NODE PRINT", "EL PRINT", "CONTACT FILE", "CONTACT PRINT", "SECTION PRINT")


def blocks_of(text):
    """Keywords with their data lines, without comments."""
    blocks = []
    for line in text.splitlines():
        if line.startswith("**") or not line.strip():
            continue
        if line.startswith("*"):
            blocks.append([line])
        else:
            blocks[-1].append(line)
    return blocks


def static_blocks(blocks):
    """Without the steps that find vibrations or buckling about a state, which the converter leaves out as well."""
    keyword = lambda block: block[0][1:].split(",")[0].strip().upper()
    parts = [[]]
    for block in blocks:
        if keyword(block) == "STEP":
            parts.append([])
        parts[-1].append(block)
    return [block for part in parts if not any(keyword(block) in ("FREQUENCY", "BUCKLE") for block in part) for block in part]


def changed(text, nlgeom, stiffer):
    """The deck with output of its own, with or without NLGEOM, and with stiffer contacts."""
    made, pairs = [], []
    for head, *data in static_blocks(blocks_of(text)):
        keyword = head[1:].split(",")[0].strip().upper()
        if keyword in OUTPUT:
            continue
        if keyword == "STEP" and not nlgeom:
            head = re.sub(r",\s*NLGEOM(\s*=\s*\w+)?", "", head, flags=re.IGNORECASE)
        if keyword == "SURFACE BEHAVIOR" and "LINEAR" in head.upper():
            first, *rest = data[0].split(",")
            data[0] = ",".join([f"{float(first) * stiffer:g}", *rest])
        if keyword == "FRICTION" and "," in data[0]:
            mu, slope = data[0].split(",")[:2]
            data[0] = f"{mu}, {float(slope) * stiffer:g}"
        if keyword == "CONTACT PAIR" and "NODETOSURFACE" not in head.upper().replace(" ", ""):  # CF is of surfaces only
            pairs += [line.split(",")[:2] for line in data]
        if keyword == "END STEP":
            made += ["*NODE FILE", "U", "*CONTACT FILE", "CDIS, CSTR"]
            for slave, master in pairs:
                made += [f"*CONTACT PRINT, SLAVE={slave.strip()}, MASTER={master.strip()}", "CF"]
        made += [head, *data]
    return "\n".join(made) + "\n"


def last_block(frd, name, columns):
    """The values of a block of a result file, of the last time, with twelve characters each."""
    values, inside = [], False
    with open(frd, encoding="latin-1") as file:
        for line in file:
            if line.startswith(" -4"):
                inside = line.split()[1] == name
                values = [] if inside else values
            elif line.startswith(" -3"):
                inside = False
            elif inside and line.startswith(" -1"):
                values.append([float(line[13 + 12 * k:25 + 12 * k]) for k in range(columns)])
    return np.array(values).reshape(-1, columns)


def with_calculix(folder, text):
    (folder / "ccx.inp").write_text(text)
    for name in ("ccx.frd", "ccx.dat"):
        (folder / name).unlink(missing_ok=True)
    run = subprocess.run(["ccx", "-i", "ccx"], cwd=folder, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"}, timeout=3600)
    if run.returncode or "Job finished" not in run.stdout:
        return None
    stress, moved = last_block(folder / "ccx.frd", "CONTACT", 4), last_block(folder / "ccx.frd", "DISP", 3)
    text = (folder / "ccx.dat").read_text()
    found = re.findall(r"total surface force \(fx,fy,fz\)[^\n]*\n\s*\n([^\n]*)\n", text)
    time = re.findall(r"statistics for slave set [^\n]*time\s*(\S+)", text)
    last = [line for line, at in zip(found, time) if at == time[-1]] if time else found[-1:]
    forces = [np.linalg.norm(list(map(float, line.split()[:3]))) for line in last]
    return {"force": forces, "pressure": stress[:, 3].max() if len(stress) else None, "displacement": np.linalg.norm(moved, axis=1).max()}


def with_scabo(program, folder, deck, *words):
    done = subprocess.run([program, "convert", deck, "-o", folder / "model.yaml", "--force", *words], capture_output=True, text=True)
    if done.returncode:
        return {"said": next(line for line in done.stderr.strip().splitlines() if ": warning: " not in line)}
    done = subprocess.run([program, "run", folder / "model.yaml", "-o", folder / "results", "-q", "--threads", "1"], capture_output=True, text=True)
    if done.returncode:
        return {"said": done.stderr.strip().splitlines()[-1]}
    summary = json.loads((folder / "results" / "summary.json").read_text())
    contacts = summary["increments"][-1].get("contacts", {}).values()
    last = sorted((folder / "results").glob("fields_*.vtu"))[-1]
    moved = vtu.read_grid(last, 3).point_data["displacement"]
    forces = [np.linalg.norm(np.add(of["normal_force"], of["tangential_force"])) for of in contacts]
    return {"force": forces, "pressure": max((of["max_pressure"] for of in contacts), default=None), "displacement": np.linalg.norm(moved, axis=1).max(),
            "warned": any("the theory is valid" in text for text in summary["warnings"]), "dofs": summary["model"]["dofs"]}


def row(name, run):
    if run is None:
        return f"  {name:36} did not end"
    if "said" in run:
        return f"  {name:36} {run['said'][-150:]}"
    forces = ", ".join(f"{force:.5g}" for force in run["force"]) or "-"
    pressure = "-" if run["pressure"] is None else f"{run['pressure']:.4g}"
    return f"  {name:36} force {forces}; largest pressure {pressure}; displacement {run['displacement']:.5g}" + ("; told as large" if run.get("warned") else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scabo", type=pathlib.Path, required=True)
    parser.add_argument("--stiffer", type=float, default=100.0)
    parser.add_argument("decks", metavar="DECK", nargs="+", type=pathlib.Path)
    options = parser.parse_args()
    for deck in options.decks:
        with tempfile.TemporaryDirectory(prefix="scabo_bench_") as holder:
            folder = pathlib.Path(holder)
            for beside in deck.parent.iterdir():  # files that it includes
                if beside.is_file() and beside != deck and beside.suffix in (".msh", ".sur", ".nam", ".inc", ".bou", ".con"):
                    shutil.copy(beside, folder)
            print(deck.name, flush=True)
            for words in ((), ("--rigid-contact",)):
                print(row(" ".join(["Scabo", *words]), with_scabo(options.scabo.resolve(), folder, deck.resolve(), *words)), flush=True)
            text = deck.read_text(encoding="latin-1")
            for nlgeom in (False, True) if "NLGEOM" in text.upper() else (False,):
                for stiffer in (1.0, options.stiffer):
                    made = with_calculix(folder, changed(text, nlgeom, stiffer))
                    print(row(f"CalculiX{', NLGEOM' * nlgeom}, stiffness x {stiffer:g}", made), flush=True)


if __name__ == "__main__":
    main()
