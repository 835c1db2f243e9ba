#!/usr/bin/env python3
"""Checks a solution of problem.hdf5 without Scabo: reads the problem with h5py, takes the forces from `scabo contact --json` (or
from the file itself), and looks pair by pair whether Coulomb's law holds."""
import argparse
import json
import pathlib
import subprocess

import h5py
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent


def read_problem(path):
    """W, q, mu, V, s and the solution in the file (docs/methods/13_problem_files.md)."""
    def matrix(group):
        m, n, p, i, x = (group[name][...] for name in ("m", "n", "p", "i", "x"))
        A = np.zeros((m[0], n[0]))
        for column in range(n[0]):  # compressed columns: nz is -1
            entries = slice(p[column], p[column + 1])
            A[i[entries], column] = x[entries]
        return A

    with h5py.File(path) as file:
        local = file["fclib_local"]
        vectors = local["vectors"]
        return (matrix(local["W"]), vectors["q"][...], vectors["mu"][...], matrix(local["V"]), vectors["s"][...],
                file["solution/r"][...], file["solution/l"][...])


def worst_violation(W, q, mu, V, s, r, l):
    """Of u = W r + V l + q, 0 = V'r + s and Coulomb's law; forces by the largest force, motions by what it causes."""
    u = W @ r + V @ l + q
    force = np.abs(r).max()
    length = force * np.mean(np.diag(W))
    gap, slip, normal, tangential = u[0::2] / length, u[1::2] / length, r[0::2] / force, r[1::2] / force
    bound = mu * np.maximum(normal, 0)
    return max(np.max(-gap), np.max(-normal), np.max(np.abs(normal * gap)),  # no penetration, no tension, one of both is 0
               np.max(np.abs(tangential) - bound),                            # inside the cone
               np.max(tangential * slip),                                     # friction opposes slip
               np.max((bound - np.abs(tangential)) * np.abs(slip)),           # slip only at the bound
               np.max(np.abs(V.T @ r + s)) / force)                           # the block is in balance


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("problem", nargs="?", default=HERE / "problem.hdf5", help="default: %(default)s")
    parser.add_argument("--scabo", default="scabo", help="the program (default: scabo on the PATH)")
    options = parser.parse_args()

    *problem, r_saved, l_saved = read_problem(options.problem)
    run = subprocess.run([options.scabo, "contact", options.problem, "--json"], text=True, stdout=subprocess.PIPE)
    solution = json.loads(run.stdout)
    r, l = np.array(solution["r"]), np.array(solution["l"])
    states = solution["states"]
    print(f"{solution['status']} in {solution['iterations']} iterations: {states.count('open')} open, {states.count('stick')} stick,"
          f" {states.count('slip')} slip")
    print(f"normal force {r[0::2].sum():.6g} N, tangential force {r[1::2].sum():.6g} N")
    print(f"worst violation of Coulomb's law and balance: {worst_violation(*problem, r, l):.1e}")
    print(f"forces against those saved in the file: {np.abs(r - r_saved).max() / np.abs(r).max():.1e}")
    print(f"the saved ones: {worst_violation(*problem, r_saved, l_saved):.1e}")


if __name__ == "__main__":
    main()
