#!/usr/bin/env python3
"""Runs the double cantilever beam for three coefficients of friction and prints the totals of the contact forces
beside those of the paper (Zhu et al. 2017)."""
import argparse
import pathlib

import runs


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scabo", default="scabo", help="the program (default: scabo on the PATH)")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("double_cantilever.results"),
                        metavar="DIR", help="where the results go (default: %(default)s)")
    options = parser.parse_args()

    print("Double cantilever beam: totals of the contact forces in kN, normal / tangential\n")
    print("   mu   Scabo            paper, SBFEM     paper, ANSYS     in contact  state     iterations  certificate")
    finished = []
    for expected, ansys in zip(runs.CHECK["runs"], runs.CHECK["paper"]["ansys"]):
        run = runs.run(options.scabo, options.output / f"mu_{expected['friction']}",
                       friction=expected["friction"])
        finished.append(run)
        joint = run.joint
        state = "slip" if joint["stick"] == 0 else "stick" if joint["slip"] == 0 else "stick, slip"
        print(f"  {expected['friction']:3.1f}   {totals(joint)}    {totals(expected)}    {totals(ansys)}    "
              f"P{joint['first_pair_in_contact']} to P{joint['last_pair_in_contact']}  {state:8}  "
              f"{run.last['newton_iterations']:10d}  {run.certificate():11.0e}")

    print("\nResults, to open in ParaView (fields.pvd) or as tables (summary.json, contact.csv):")
    for run in finished:
        print(f"  {run.directory}")


def totals(forces):
    return f"{forces['normal_force'] / 1e3:5.2f} / {abs(forces['tangential_force']) / 1e3:5.2f}"


if __name__ == "__main__":
    main()
