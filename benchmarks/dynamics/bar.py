#!/usr/bin/env python3
"""A bar that flies against a wall (page 23 of the methods: exact force 300 for 0.667 s, no energy lost), by Scabo, GetFEM and CalculiX.

    benchmarks/dynamics/bar.py [--scabo PATH]

Four-node elements of the plane (CalculiX: C3D8 held in the plane). Processor seconds of one thread: of Scabo and CalculiX the whole program, of GetFEM
its time steps alone. `deviation`: root of the mean square of force - 300 over the middle 0.4 s of the contact; `kinetic`: energy at 1.5 s over that at
first, of the whole bar. Needs `ccx` and python3-getfem; what is not there is left out.
"""
import argparse
import csv
import json
import pathlib
import re
import resource
import shutil
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
END = 1.5
SCABO = """scabo: 1
analysis: {{type: dynamic, plane: stress}}
materials: {{bar: {{young: 900, poisson: 0, density: 1}}}}
bodies:
  wall: {{rigid: true, shape: {{rectangle: {{corner: [-1, -1], size: [1, 3]}}}}}}
  bar: {{material: bar, shape: {{rectangle: {{corner: [5, 0], size: [10, 1]}}}}, mesh: {{kind: fem, size: {size}, order: 1}}}}
supports: [{{on: wall, fix: [x, y]}}]
initial: [{{on: bar, velocity: [-10, 0]}}]
contacts: {{hit: {{between: [wall.right, bar.left], friction: 0}}}}
steps: [{{dynamic: {{duration: 1.5, step: {step!r}}}, increments: 90}}]
output: {{fields: [], every: 1000, history: {{force: hit.normal_force, kinetic: kinetic_energy}}}}
"""


def processor_seconds(command, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=900, env={"OMP_NUM_THREADS": "1", "PATH": "/usr/local/bin:/usr/bin:/bin"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, run


def figures(times, forces):
    middle = [force for at, force in zip(times, forces) if 0.633 < at < 1.033]
    mean = sum(middle) / len(middle)
    return f"{mean:.1f} | {(sum((force - 300) ** 2 for force in middle) / len(middle)) ** 0.5:.1f}"


def scabo(program, elements, step, folder):
    (folder / "bar.yaml").write_text(SCABO.format(size=10 / elements, step=step), encoding="utf-8")
    seconds, run = processor_seconds([program, "run", "bar.yaml", "--quiet", "--threads", "1"], folder)
    assert run.returncode == 0, run.stderr
    rows = list(csv.DictReader((folder / "bar.results" / "history.csv").open(encoding="utf-8")))
    return f"{seconds:.3f} | {figures([float(row['time']) for row in rows], [float(row['force']) for row in rows])} | {float(rows[-1]['kinetic']) / 500:.3f}"


def getfem(elements, step, scheme, folder):
    _, run = processor_seconds(["/usr/bin/python3", pathlib.Path(__file__).with_name("getfem_bar.py"), str(elements), repr(step), scheme], folder)
    if run.returncode != 0:
        return run.stderr.strip().splitlines()[-1] + " | | |"
    seen = json.loads(run.stdout.strip().splitlines()[-1])
    return f"{seen['seconds']:.3f} | {figures(seen['times'], seen['forces'])} | {seen['kinetic'] / 500:.3f}"


def block(first, x, columns, width, y, rows, height):
    """Nodes and cells of a block of C3D8 of thickness 1."""
    def number(i, j, k):
        return first + (i * (rows + 1) + j) * 2 + k
    nodes = [(number(i, j, k), x + i * width, y + j * height, float(k)) for i in range(columns + 1) for j in range(rows + 1) for k in range(2)]
    cells = [[number(i + di, j + dj, k) for k in range(2) for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))] for i in range(columns) for j in range(rows)]
    return nodes, cells


def deck(elements, step, alpha, penalty):
    rows = max(1, elements // 10)
    bar, cells = block(1, 5.0, elements, 10 / elements, 0.0, rows, 1 / rows)
    wall, of_wall = block(len(bar) + 1, -1.0, 1, 1.0, -1.0, 1, 3.0)
    lines = ["*NODE, NSET=NALL", *(f"{n},{x!r},{y!r},{z!r}" for n, x, y, z in bar + wall),
             "*NSET,NSET=NBAR,GENERATE", f"1,{len(bar)}", "*NSET,NSET=NWALL,GENERATE", f"{len(bar) + 1},{len(bar) + len(wall)}",
             "*ELEMENT,TYPE=C3D8,ELSET=EBAR", *(f"{k + 1}," + ",".join(map(str, cell)) for k, cell in enumerate(cells)),
             "*ELEMENT,TYPE=C3D8,ELSET=EWALL", f"{len(cells) + 1}," + ",".join(map(str, of_wall[0])),
             "*MATERIAL,NAME=BAR", "*ELASTIC", "900,0", "*DENSITY", "1", "*SOLID SECTION,ELSET=EBAR,MATERIAL=BAR", "*SOLID SECTION,ELSET=EWALL,MATERIAL=BAR",
             "*SURFACE,NAME=SBAR,TYPE=NODE", *(str(node[0]) for node in bar if node[1] == 5.0), "*SURFACE,NAME=SWALL", f"{len(cells) + 1},S4",
             "*CONTACT PAIR,INTERACTION=HARD,TYPE=NODE TO SURFACE", "SBAR,SWALL", "*SURFACE INTERACTION,NAME=HARD",
             "*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR", f"{penalty:g},1e-9",
             "*BOUNDARY", "NWALL,1,3", "NALL,3,3", "*INITIAL CONDITIONS,TYPE=VELOCITY", "NBAR,1,-10.0", "*STEP,INC=1000000,NLGEOM=NO",
             f"*DYNAMIC,DIRECT,ALPHA={alpha}", f"{step!r},{END}", "*NODE PRINT,NSET=NWALL,TOTALS=ONLY,FREQUENCY=1", "RF",
             "*EL PRINT,ELSET=EBAR,TOTALS=ONLY,FREQUENCY=1", "ELKE", "*END STEP"]
    return "\n".join(lines) + "\n"


def calculix(elements, step, alpha, penalty, folder):
    (folder / "bar.inp").write_text(deck(elements, step, alpha, penalty), encoding="utf-8")
    seconds, run = processor_seconds(["ccx", "bar"], folder)
    text = (folder / "bar.dat").read_text(encoding="utf-8")
    found = re.findall(r"total force \(fx,fy,fz\) for set NWALL and time\s+(\S+)\s+\n\s+(\S+)", text)
    times, forces = [float(at) for at, _ in found], [abs(float(force)) for _, force in found]
    if times[-1] < 0.99 * END:
        return f"{seconds:.2f} | ends at {times[-1]:.3f} s: the solution seems to diverge | |"
    energies = re.findall(r"total kinetic energy.*\n\s+(\S+)", text, re.I)
    return f"{seconds:.2f} | {figures(times, forces)} | " + (f"{float(energies[-1]) / 500:.3f}" if energies else "")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--scabo", default=str(ROOT / "build" / "bin" / "scabo"))
    options = options.parse_args()
    print("| program | elements | step, s | processor, s | force | deviation | kinetic |\n|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for elements, parts in ((20, 90), (40, 180), (80, 360)):
            print(f"| Scabo | {elements} | 1.5/{parts} | {scabo(options.scabo, elements, END / parts, folder)} |", flush=True)
        if subprocess.run(["/usr/bin/python3", "-c", "import getfem"], capture_output=True).returncode == 0:
            for scheme, elements, parts in (("newmark", 20, 180), ("theta:1", 20, 180), ("theta:1", 20, 1440), ("theta:1", 40, 3600), ("theta:0.6", 20, 720)):
                print(f"| GetFEM, {scheme} | {elements} | 1.5/{parts} | {getfem(elements, END / parts, scheme, folder)} |", flush=True)
        if shutil.which("ccx"):
            for alpha, penalty in (("-0.05", 1e3), ("-0.3333", 1e3), ("-0.3333", 1e4), ("-0.05", 1e4), ("-0.3333", 1e5)):
                print(f"| CalculiX, alpha {alpha}, {penalty:g} force/length3 | 20 | 1.5/180 | {calculix(20, END / 180, alpha, penalty, folder)} |", flush=True)


if __name__ == "__main__":
    main()
