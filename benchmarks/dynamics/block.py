#!/usr/bin/env python3
"""A stiff block that slides on a shaking table (example 26: exact for a rigid one), by Scabo, GetFEM and CalculiX.

    benchmarks/dynamics/block.py [--scabo PATH]

Block of 2 x 1 m, friction 0.3, one cycle of 0.5 g in 0.5 s, seen from the table; weight first, at rest. Damping of the stiffness, 0.5 at 1000 Hz, but for CalculiX, which has none here. Four-node elements (CalculiX: C3D8 held in the
plane, which is plane strain). `error`: largest difference of the displacement of its bottom from that of a rigid block, which slips by 24.49 mm.
Processor seconds of one thread: of Scabo and CalculiX the whole program, of GetFEM its time steps alone. Needs `ccx` and python3-getfem; what is not there is left out.
"""
import argparse
import csv
import json
import math
import pathlib
import re
import shutil
import subprocess
import tempfile

from bar import ROOT, block, processor_seconds

END, AMPLITUDE, FRICTION = 0.5, 4.905, 0.3
SCABO = """scabo: 1
analysis: {{plane: stress}}
materials: {{stone: {{young: 1e10, poisson: 0.2, density: 1000, damping: {{ratio: 0.5, between: [1e-4, 1e3]}}}}}}
bodies:
  table: {{rigid: true, shape: {{rectangle: {{corner: [-0.5, -1], size: [3, 1]}}}}}}
  block: {{material: stone, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{kind: fem, size: {size}, order: 1}}}}
supports: [{{on: table, fix: [x, y]}}]
loads: {{weight: {{gravity: [0, -9.81], on: block}}}}
contacts: {{base: {{between: [table.top, block.bottom], friction: 0.3}}}}
curves: {{quake: {{sine: {{amplitude: 4.905, periods: 1}}}}}}
steps:
  - {{name: rest}}
  - {{name: shake, dynamic: {{duration: 0.5, step: {step!r}, ground: {{x: quake}}}}, increments: {increments}}}
output: {{fields: [], every: 1000, points: [{{at: [1, 0], body: block, name: foot}}], history: {{moved: foot.ux}}}}
"""


def rigid(times):
    """Displacement of a rigid block at some times, from the largest friction and the ground."""
    parts, found, v, u, k = 50000, [], 0.0, 0.0, 0
    h, bound = END / parts, FRICTION * 9.81
    for at in times:
        while k < round(at / h):
            ground = AMPLITUDE * math.sin(2.0 * math.pi * (k + 0.5) * h / END)
            free = v - h * ground
            after = math.copysign(max(0.0, abs(free) - h * bound), free)
            u, v, k = u + 0.5 * h * (v + after), after, k + 1
        found.append(u)
    return found


def error(times, moved):
    return 1e3 * max(abs(a - b) for a, b in zip(moved, rigid(times)))


def scabo(program, columns, step, folder):
    increments = min(round(END / step), 50)
    (folder / "block.yaml").write_text(SCABO.format(size=2 / columns, step=step, increments=increments), encoding="utf-8")
    seconds, run = processor_seconds([program, "run", "block.yaml", "--quiet", "--threads", "1"], folder)
    assert run.returncode == 0, run.stderr
    rows = [row for row in csv.DictReader((folder / "block.results" / "history.csv").open(encoding="utf-8")) if row["time"] and float(row["time"]) > 0.0]
    return f"{seconds:.3f} | {error([float(row['time']) for row in rows], [float(row['moved']) for row in rows]):.3f}"


def getfem(columns, step, scheme, folder):
    _, run = processor_seconds(["/usr/bin/python3", pathlib.Path(__file__).with_name("getfem_block.py"), str(columns), repr(step), scheme], folder)
    if run.returncode != 0:
        return run.stderr.strip().splitlines()[-1] + " | "
    seen = json.loads(run.stdout.strip().splitlines()[-1])
    return f"{seen['seconds']:.3f} | {error(seen['times'], seen['moved']):.3f}"


def deck(columns, step, alpha, penalty, direct):
    nodes, cells = block(1, 0.0, columns, 2 / columns, 0.0, columns // 2, 2 / columns)
    table, of_table = block(len(nodes) + 1, -0.5, 1, 3.0, -1.0, 1, 1.0)
    bottom = [node[0] for node in nodes if node[2] == 0.0]
    last = len(cells)
    quake = [f"{END * k / 500!r},{math.sin(2 * math.pi * k / 500):.9f}" for k in range(501)]
    lines = ["*NODE, NSET=NALL", *(f"{n},{x!r},{y!r},{z!r}" for n, x, y, z in nodes + table),
             "*NSET,NSET=NBOTTOM", *(f"{n}," for n in bottom), "*NSET,NSET=NTABLE,GENERATE", f"{len(nodes) + 1},{len(nodes) + len(table)}",
             "*ELEMENT,TYPE=C3D8,ELSET=EBLOCK", *(f"{k + 1}," + ",".join(map(str, cell)) for k, cell in enumerate(cells)),
             "*ELSET,ELSET=ESHAKEN,GENERATE", f"1,{last}",
             "*ELEMENT,TYPE=C3D8,ELSET=ETABLE", f"{last + 1}," + ",".join(map(str, of_table[0])),
             "*MATERIAL,NAME=STONE", "*ELASTIC", "1e10,0.2", "*DENSITY", "1000", "*SOLID SECTION,ELSET=EBLOCK,MATERIAL=STONE",
             "*SOLID SECTION,ELSET=ETABLE,MATERIAL=STONE",
             "*SURFACE,NAME=SBLOCK,TYPE=NODE", *(str(n) for n in bottom), "*SURFACE,NAME=STABLE", f"{last + 1},S5",
             "*CONTACT PAIR,INTERACTION=ROUGH,TYPE=NODE TO SURFACE", "SBLOCK,STABLE", "*SURFACE INTERACTION,NAME=ROUGH",
             "*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR", f"{penalty:g},1e-9", "*FRICTION", f"{FRICTION},{0.1 * penalty:g}",
             "*AMPLITUDE,NAME=QUAKE", *quake, "*BOUNDARY", "NTABLE,1,3", "NALL,3,3",
             "*STEP,INC=1000,NLGEOM=NO", "*STATIC", "1.,1.", "*DLOAD", "EBLOCK,GRAV,9.81,0.,-1.,0.", "*EL PRINT,ELSET=EBLOCK,TOTALS=ONLY,FREQUENCY=1000", "ELKE", "*END STEP",
             "*STEP,INC=1000000,NLGEOM=NO", f"*DYNAMIC{',DIRECT' if direct else ''},ALPHA={alpha}", f"{step!r},{END},1e-9,{step!r}", "*DLOAD,AMPLITUDE=QUAKE", f"ESHAKEN,GRAV,{AMPLITUDE},-1.,0.,0.",
             "*NODE PRINT,NSET=NBOTTOM,FREQUENCY=1", "U", "*END STEP"]
    return "\n".join(lines) + "\n"


def calculix(columns, step, alpha, penalty, direct, folder):
    (folder / "block.inp").write_text(deck(columns, step, alpha, penalty, direct), encoding="utf-8")
    seconds, run = processor_seconds(["ccx", "block"], folder)
    text = (folder / "block.dat").read_text(encoding="utf-8")
    times, moved = [], []
    for piece in re.split(r"displacements \(vx,vy,vz\) for set NBOTTOM and time\s+", text)[1:]:
        lines = piece.split("\n")
        values = [float(line.split()[1]) for line in lines[1:] if len(line.split()) == 4]
        times.append(float(lines[0]) - 1.0)  # of the step at rest
        moved.append(sum(values) / len(values))
    if not times or times[-1] < 0.99 * END:
        return f"{seconds:.2f} | ends at {times[-1] if times else 0:.3f} s: the solution seems to diverge"
    return f"{seconds:.2f} | {error(times, moved):.3f}"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--scabo", default=str(ROOT / "build" / "bin" / "scabo"))
    options = options.parse_args()
    print("| program | elements | step, ms | processor, s | error, mm |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for step in (4e-3, 2e-3, 1e-3, 5e-4):
            print(f"| Scabo | 4 x 2 | {1e3 * step:g} | {scabo(options.scabo, 4, step, folder)} |", flush=True)
        if subprocess.run(["/usr/bin/python3", "-c", "import getfem"], capture_output=True).returncode == 0:
            for scheme, step in (("newmark", 5e-4), ("theta:0.5", 5e-4), ("theta:0.6", 2e-3), ("theta:0.6", 5e-4), ("theta:0.6", 2e-4), ("theta:1", 2e-3), ("theta:1", 5e-4), ("theta:1", 1e-4)):
                print(f"| GetFEM, {scheme} | 4 x 2 | {1e3 * step:g} | {getfem(4, step, scheme, folder)} |", flush=True)
        if shutil.which("ccx"):
            for direct, alpha, penalty, step in ((True, "-0.3333", 1e10, 1e-3), (False, "-0.3333", 1e8, 1e-3), (False, "-0.05", 1e10, 1e-3), (False, "-0.3333", 1e8, 1e-4)):
                print(f"| CalculiX, alpha {alpha}, {penalty:g} N/m3{', equal steps' if direct else ', automatic'} | 4 x 2 | {1e3 * step:g} | {calculix(4, step, alpha, penalty, direct, folder)} |", flush=True)


if __name__ == "__main__":
    main()
