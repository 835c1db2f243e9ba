#!/usr/bin/env python3
"""Tries keywords of CalculiX that the comparison names, each on a bar whose answer is known.

    calculix_keywords.py        (needs ccx)

A bar 2 x 1 x 1 of two elements along x, or one shell 1 x 1 of thickness 0.1; E = 200, nu = 0, density and conductivity 1.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

BAR = """*NODE, NSET=ALL
""" + "".join(f"{1 + i + 3 * j + 6 * k}, {i}, {j}, {k}\n" for k in (0, 1) for j in (0, 1) for i in (0, 1, 2)) + """*ELEMENT, TYPE={kind}, ELSET=BAR
1, 1, 2, 5, 4, 7, 8, 11, 10
2, 2, 3, 6, 5, 8, 9, 12, 11
*NSET, NSET=LEFT
1, 4, 7, 10
*NSET, NSET=MIDDLE
2, 5, 8, 11
*NSET, NSET=RIGHT
3, 6, 9, 12
*MATERIAL, NAME=M
*ELASTIC
200, 0
*DENSITY
1
*CONDUCTIVITY
1
*SPECIFIC HEAT
1
{more}*SOLID SECTION, ELSET=BAR, MATERIAL=M
"""
HELD = "*BOUNDARY\nALL, 2, 3\nLEFT, 1\n"
SHELL = """*NODE, NSET=ALL
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
*ELEMENT, TYPE=S4, ELSET=PLATE
1, 1, 2, 3, 4
*NSET, NSET=LEFT
1, 4
*NSET, NSET=RIGHT
2, 3
*MATERIAL, NAME=M
*ELASTIC
200, 0
*SHELL SECTION, ELSET=PLATE, MATERIAL=M
0.1
*BOUNDARY
ALL, 2, 6
LEFT, 1
"""
CASES = {  # deck, column of the value in the last line that is printed, what it must be, within
    # Mean stress K eps = 200 / 3 * 0.01, and two thirds of the yield stress of 1.
    "*PLASTIC: stress of a bar that cannot widen": (
        BAR.format(kind="C3D8", more="*PLASTIC\n1, 0\n1, 1\n") + HELD + "*STEP\n*STATIC\n*BOUNDARY\nRIGHT, 1, 1, 0.02\n"
        "*NODE PRINT, NSET=RIGHT, TOTALS=ONLY\nRF\n*END STEP\n", 0, 4 / 3, 1e-6),
    "*SHELL SECTION: force of 0.001 strain": (
        SHELL + "*STEP\n*STATIC\n*BOUNDARY\nRIGHT, 1, 1, 0.001\n*NODE PRINT, NSET=RIGHT, TOTALS=ONLY\nRF\n*END STEP\n",
        0, 0.02, 1e-6),
    "*DYNAMIC: way of a free bar under a constant force after 1": (
        BAR.format(kind="C3D8", more="") + "*BOUNDARY\nALL, 2, 3\n*STEP, INC=1000\n*DYNAMIC, DIRECT, ALPHA=0\n0.01, 1\n*DLOAD\nBAR, GRAV, 4, 1, 0, 0\n"
        "*NODE PRINT, NSET=RIGHT, FREQUENCY=100\nU\n*END STEP\n", 1, 2.0, 2e-2),
    "*HEAT TRANSFER: temperature in the middle": (
        BAR.format(kind="C3D8", more="") + "*STEP\n*HEAT TRANSFER, STEADY STATE\n*BOUNDARY\nLEFT, 11, 11, 0\nRIGHT, 11, 11, 100\n"
        "*NODE PRINT, NSET=MIDDLE\nNT\n*END STEP\n", 1, 50.0, 1e-6),
}


def value_of(deck, column):
    """A number of the last line of the table that ccx prints, or why there is none."""
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "case.inp").write_text(deck, encoding="ascii")
        run = subprocess.run(["ccx", "case"], cwd=folder, capture_output=True, text=True, timeout=300)
        printed = pathlib.Path(folder, "case.dat")
        lines = [line.split() for line in printed.read_text().splitlines()] if printed.exists() else []
    rows = [line for line in lines if line and re.fullmatch(r"[-+0-9.E]+", line[0])]
    if not rows:
        return f"exit status {run.returncode}, no result: " + " ".join(re.findall(r"\*ERROR.*", run.stdout)[:1])
    return float(rows[-1][column])


def main():
    failed = False
    for name, (deck, column, expected, within) in CASES.items():
        found = value_of(deck, column)
        right = isinstance(found, float) and abs(found - expected) <= within * abs(expected)
        failed |= not right
        print(f"{name}: {found}, expected {expected}: {'right' if right else 'WRONG'}")
    sys.exit(failed)


if __name__ == "__main__":
    main()
