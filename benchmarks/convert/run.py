#!/usr/bin/env python3
"""Solves decks by CalculiX (ccx) and, converted, by Scabo, and compares displacements, stresses and contact forces.

    benchmarks/convert/run.py --scabo build/bin/scabo

Differences are relative to the largest value. CalculiX prints seven digits. Displacements are those of all nodes, stresses
those at all integration points of a deck without contact; of contact, the total force.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "peers"))
import calculix_beams

RADIUS = 1.0  # inside of a beam that is a plate around the axis
NUMBER = r"\s+(-?\d\.\d+E[+-]\d+)"


def grid(nx, ny, width, height, kind):
    """Nodes and elements of a beam whose upper side is curved, so that no two elements are alike."""
    quadratic, triangles = kind[3] in "68", kind[3] in "36"
    number, nodes = {}, []
    steps = 2 if quadratic else 1
    for j in range(ny * steps + 1):
        for i in range(nx * steps + 1):
            if quadratic and not triangles and i % 2 and j % 2:
                continue
            s, t = i / (nx * steps), j / (ny * steps)
            number[i, j] = len(nodes) + 1
            nodes.append((width * s + (RADIUS if kind.startswith("CAX") else 0.0), height * t * (1 + 0.3 * s * s)))
    elements = []
    for y in range(ny):
        for x in range(nx):
            i, j, h = x * steps, y * steps, steps
            a, b, c, d = (i, j), (i + h, j), (i + h, j + h), (i, j + h)
            middle = lambda p, q: ((p[0] + q[0]) // 2, (p[1] + q[1]) // 2)
            for corners in ([(a, b, c), (a, c, d)] if triangles else [(a, b, c, d)]):
                places = list(corners)
                if quadratic:
                    places += [middle(corners[k], corners[(k + 1) % len(corners)]) for k in range(len(corners))]
                elements.append([number[place] for place in places])
    sides = {"LEFT": [number[i, j] for i, j in number if i == 0],
             "TIP": [number[nx * steps, ny * steps]]}
    top = [len(elements) - (2 * nx if triangles else nx) + (2 * x + 1 if triangles else x) + 1 for x in range(nx)]
    return nodes, elements, sides, top


def beam_deck(kind):
    nodes, elements, sides, top = grid(12, 3, 6.0, 1.5, kind)
    lines = ["*NODE, NSET=ALL"] + [f"{n + 1}, {x!r}, {y!r}" for n, (x, y) in enumerate(nodes)]
    lines += [f"*ELEMENT, TYPE={kind}, ELSET=BEAM"] + [f"{e + 1}, {', '.join(map(str, of))}" for e, of in enumerate(elements)]
    lines += ["*NSET, NSET=LEFT"] + [f"{n}," for n in sides["LEFT"]]
    lines += ["*MATERIAL, NAME=CONCRETE", "*ELASTIC", "10e9, 0.3", "*DENSITY", "2400.", "*SOLID SECTION, ELSET=BEAM, MATERIAL=CONCRETE", "0.5",
              "*BOUNDARY", "LEFT, 1, 2", "*STEP", "*STATIC", "*CLOAD", f"{sides['TIP'][0]}, 1, 3e4", f"{sides['TIP'][0]}, 2, -1e5",
              "*DLOAD", "BEAM, GRAV, 9.81, 0., -1., 0."]
    face = "P2" if kind[3] in "36" else "P3"
    lines += [f"{e}, {face}, {1e4 * (k + 1)}" for k, e in enumerate(top)]
    return lines, len(nodes)


def blocks_of(text, title):
    """Numbers of the blocks whose head begins with the title."""
    found = []
    for block in re.split(r"\n(?= *[a-z][^\n]* for set )", text):
        if block.strip().startswith(title):
            found += [[float(value) for value in re.findall(NUMBER, line)] for line in block.splitlines()[1:] if re.search(NUMBER, line)]
    return found


def solve_by_calculix(directory, name):
    run = subprocess.run(["ccx", name], cwd=directory, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"}, timeout=900)
    if run.returncode != 0 or not (directory / f"{name}.dat").exists():
        sys.exit(f"ccx has failed: {run.stdout[-500:]}")
    return (directory / f"{name}.dat").read_text()


def solve_by_scabo(scabo, directory, name, points):
    def run(*words):
        done = subprocess.run([scabo, *words], cwd=directory, capture_output=True, text=True, timeout=900)
        if done.returncode != 0:
            sys.exit(f"scabo {' '.join(words)[:200]} has failed: {done.stderr}")
        return done.stderr
    notes = run("convert", f"{name}.inp", "--force")
    if points:
        with open(directory / f"{name}.yaml", "a", encoding="utf-8") as model:
            model.write(f"output: {{points: {json.dumps(points)}}}\n")
    run("run", f"{name}.yaml", "--quiet")
    results = directory / f"{name}.results"
    rows = []
    if points:
        with open(results / "points.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    return notes, json.loads((results / "summary.json").read_text()), rows


def difference(values, expected):
    largest = max(abs(value) for row in expected for value in row)
    return max(abs(x - y) for of, by in zip(values, expected, strict=True) for x, y in zip(of, by, strict=True)) / largest


def about_the_axis(stress, at):
    """Radial, axial, shear and hoop stress at a point beside the plane z = 0, from xx, yy, zz, xy, xz, yz there."""
    c, s = at[0] / math.hypot(at[0], at[2]), at[2] / math.hypot(at[0], at[2])
    xx, yy, zz, xy, xz, yz = stress
    return [c * c * xx + 2 * c * s * xz + s * s * zz, yy, c * xy + s * yz, s * s * xx - 2 * c * s * xz + c * c * zz]


def compare_beam(scabo, directory, kind):
    lines, _ = beam_deck(kind)
    deck = lines + ["*NODE PRINT, NSET=ALL", "U", "*EL PRINT, ELSET=BEAM", "S, COORD", "*END STEP", ""]
    (directory / f"{kind}.inp").write_text("\n".join(deck))
    text = solve_by_calculix(directory, kind)
    nodes = [tuple(map(float, line.split(",")[1:3])) for line in lines[1:lines.index(f"*ELEMENT, TYPE={kind}, ELSET=BEAM")]]
    places = [row[:2] for row in blocks_of(text, "global coordinates")]
    if kind.startswith("CAX"):
        places = [[math.hypot(row[0], row[2]), row[1]] for row in blocks_of(text, "global coordinates")]
    _, _, rows = solve_by_scabo(scabo, directory, kind, [list(x) for x in nodes] + places)
    moved = [[float(row["ux"]), float(row["uy"])] for row in rows[:len(nodes)]]
    revolved = kind.startswith("CAX")
    stress = [[float(row[f"stress_{part}"]) for part in ("xx", "yy", "xy") + ("zz",) * revolved] for row in rows[len(nodes):]]
    by_calculix = [[row[0], row[1], row[3]] for row in blocks_of(text, "stresses")]
    if revolved:
        by_calculix = [about_the_axis(of, at) for of, at in zip(blocks_of(text, "stresses"), blocks_of(text, "global coordinates"), strict=True)]
    return difference(moved, [row[:2] for row in blocks_of(text, "displacements")]), difference(stress, by_calculix)


def compare_beams_in_contact(scabo, directory, friction):
    (directory / "beams.inp").write_text(calculix_beams.deck(0.1875, friction))
    text = solve_by_calculix(directory, "beams")
    shear, normal = [float(value) for value in re.search(r"total force[^\n]*\n\s*\n" + NUMBER + NUMBER, text).groups()]
    _, summary, _ = solve_by_scabo(scabo, directory, "beams", [])
    contact = next(iter(summary["increments"][-1]["contacts"].values()))
    return contact["normal_force"], normal, abs(contact["tangential_force"]), abs(shear)


def rounded_punch_deck(stiffness=1e15):
    """A block with a round bottom (radius 1 m) is moved 1 mm into a flat block of the same steel; half of both, x = 0 is the
    line of symmetry. Contact as in Hertz's problem, elements of 10 mm at the middle."""
    lines, last = ["*HEADING", "Punch with a round bottom"], 0
    for name, y0, height in (("LOWER", -0.4, 0.4), ("UPPER", 0.0, 0.4)):
        nx, ny = 24, 12
        number, rows = {}, []
        for j in range(2 * ny + 1):
            for i in range(2 * nx + 1):
                if i % 2 and j % 2:
                    continue
                s, t = i / (2 * nx), j / (2 * ny)
                x = 0.3 * (0.8 * s + 0.2 * s**3)
                y = y0 + height * t
                if name == "UPPER":
                    y += (1.0 - (1.0 - x * x) ** 0.5) * (1.0 - t)
                number[i, j] = last + len(number) + 1
                rows.append(f"{number[i, j]}, {x:.10g}, {y:.10g}")  # ccx reads 20 characters
        lines += ["*NODE"] + rows + [f"*ELEMENT, TYPE=CPE8, ELSET={name}"]
        first = 1 if name == "LOWER" else 10001
        for b in range(ny):
            for a in range(nx):
                i, j = 2 * a, 2 * b
                places = [(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2), (i + 1, j), (i + 2, j + 1), (i + 1, j + 2), (i, j + 1)]
                lines.append(f"{first + b * nx + a}, " + ", ".join(str(number[place]) for place in places))
        lines += [f"*NSET, NSET={name}_MIDDLE"] + [f"{number[i, j]}," for i, j in number if i == 0]
        held = 0 if name == "LOWER" else 2 * ny
        lines += [f"*NSET, NSET={name}_HELD"] + [f"{number[i, j]}," for i, j in number if j == held]
        side, row = ("S3", ny - 1) if name == "LOWER" else ("S1", 0)
        lines += [f"*SURFACE, NAME={name}_FACE, TYPE=ELEMENT"] + [f"{first + row * nx + a}, {side}" for a in range(nx)]
        last += len(number)
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "210e9, 0.3"]
    for name in ("LOWER", "UPPER"):
        lines += [f"*SOLID SECTION, ELSET={name}, MATERIAL=STEEL", "1.0", "*BOUNDARY", f"{name}_MIDDLE, 1"]
    lines += ["*BOUNDARY", "LOWER_HELD, 1, 2", "UPPER_HELD, 1", "*SURFACE INTERACTION, NAME=FACE", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
              f"{stiffness:g}", "*CONTACT PAIR, INTERACTION=FACE, TYPE=SURFACE TO SURFACE", "UPPER_FACE, LOWER_FACE", "*STEP", "*STATIC", "0.25, 1.0",
              "*BOUNDARY", "UPPER_HELD, 2, 2, -1e-3", "*NODE PRINT, NSET=LOWER_HELD, TOTALS=ONLY", "RF", "*END STEP", ""]
    return "\n".join(lines)


def compare_punch(scabo, directory):
    (directory / "punch.inp").write_text(rounded_punch_deck())
    text = solve_by_calculix(directory, "punch")
    normal = [float(found[1]) for found in re.findall(r"total force[^\n]*\n\s*\n" + NUMBER + NUMBER, text)][-1]
    _, summary, _ = solve_by_scabo(scabo, directory, "punch", [])
    return next(iter(summary["increments"][-1]["contacts"].values()))["normal_force"], normal


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scabo", default="build/bin/scabo")
    scabo = str(pathlib.Path(parser.parse_args().scabo).resolve())
    with tempfile.TemporaryDirectory() as folder:
        directory = pathlib.Path(folder)
        print("| elements | displacements | stresses |\n|---|---|---|")
        for kind in ("CPE8", "CPE6", "CPE4", "CPE3", "CPS8", "CPS6", "CPS4", "CPS3", "CPE8R", "CAX8", "CAX6", "CAX4", "CAX3", "CAX8R"):
            moved, stress = compare_beam(scabo, directory, kind)
            print(f"| {kind} | {moved:.1e} | {stress:.1e} |", flush=True)
        print("\n| contact | Scabo, kN | CalculiX, kN | difference |\n|---|---|---|---|")
        for friction in (0.0, 0.2):
            normal, by_calculix, shear, its_shear = compare_beams_in_contact(scabo, directory, friction)
            print(f"| normal force, friction {friction:g} | {normal / 1e3:.3f} | {by_calculix / 1e3:.3f} | {abs(normal / by_calculix - 1):.1e} |", flush=True)
            if friction:
                print(f"| tangential force, friction {friction:g} | {shear / 1e3:.3f} | {its_shear / 1e3:.3f} | {abs(shear / its_shear - 1):.1e} |")
        normal, by_calculix = compare_punch(scabo, directory)
        print(f"| punch with a round bottom, normal force | {normal / 1e3:.3f} | {by_calculix / 1e3:.3f} | {abs(normal / by_calculix - 1):.1e} |")


if __name__ == "__main__":
    main()
