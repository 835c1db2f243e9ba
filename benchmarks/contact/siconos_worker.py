"""Solves one problem with one solver of Siconos and prints JSON, a line for each tolerance tried.

    siconos_worker.py FILE SOLVER [--limit 1e-8]

A process of its own, because Siconos may crash or not come back; run.py sets the time limit. Timed is the call of
Siconos's driver alone, with the problem ready in the storage that suits the solver, starting from zero.

Settings are the best of about fifty tried on 27 problems of FCLIB and of Siconos's own test data:

- q is divided by |q|. The problem is homogeneous, so r is too; Siconos's tolerances then mean the same for all problems. With q of
  1e-18, as in one file, it stops at once without.
- Its own residuals are not the natural map's. The tolerance is 1e-9; where the result then misses the limit although
  Siconos is content, 1e-11 and 1e-13 are tried, and the first that suffices counts, with its time alone.
- NSGS in space: sparse W, local solver ONECONTACT_NSN_GP (0.55 s for the twelve solved; its default hybrid 0.95 s,
  projections 0.84 s), errors judged lightly and fully at the end. With full errors throughout it stops too early.
- NSN-AC: Jean and Moreau's formulation, Goldstein and Price's line search (14 of 16 hard problems in 6.4 s; the default,
  generated Alart-Curnier, 14 in 9.5 s; without line search or with Armijo's 4 to 9).
- NSGS in the plane: block-sparse W (6 ms for 667 contacts, dense 520 ms). Lemke: dense, all that it accepts.
"""
import argparse
import ctypes
import json
import os
import sys
import time

import numpy
import siconos.numerics as sn

import problems

TOLERANCES = (1e-9, 1e-11, 1e-13)
SWEEPS = 10_000_000      # only the time limit ends them
NEWTON_STEPS = 5_000


def nonsmooth_gauss_seidel(options):
    options.iparam[sn.SICONOS_IPARAM_MAX_ITER] = SWEEPS
    options.iparam[sn.SICONOS_FRICTION_3D_IPARAM_ERROR_EVALUATION] = \
        sn.SICONOS_FRICTION_3D_NSGS_ERROR_EVALUATION_LIGHT_WITH_FULL_FINAL


def gauss_seidel_in_space(options):
    nonsmooth_gauss_seidel(options)
    sn.solver_options_update_internal(options, 0, sn.SICONOS_FRICTION_3D_ONECONTACT_NSN_GP)


def newton(options):
    options.iparam[sn.SICONOS_IPARAM_MAX_ITER] = NEWTON_STEPS
    options.iparam[sn.SICONOS_FRICTION_3D_NSN_LINEAR_SOLVER] = sn.SICONOS_FRICTION_3D_NSN_USE_CSLUSOL
    options.iparam[sn.SICONOS_FRICTION_3D_NSN_LINESEARCH] = sn.SICONOS_FRICTION_3D_NSN_LINESEARCH_GOLDSTEINPRICE


def alart_curnier(options):
    newton(options)
    options.iparam[sn.SICONOS_FRICTION_3D_NSN_FORMULATION] = sn.SICONOS_FRICTION_3D_NSN_FORMULATION_JEANMOREAU_STD
    options.iparam[sn.SICONOS_FRICTION_3D_NSN_RHO_STRATEGY] = \
        sn.SICONOS_FRICTION_3D_NSN_FORMULATION_RHO_STRATEGY_SPECTRAL_NORM


def lemke(options):
    options.iparam[sn.SICONOS_IPARAM_MAX_ITER] = SWEEPS


# (name, dimension): Siconos's solver, storage of W, options
SOLVERS = {
    ("NSGS", 3): (sn.SICONOS_FRICTION_3D_NSGS, "sparse", gauss_seidel_in_space),
    ("NSN-AC", 3): (sn.SICONOS_FRICTION_3D_NSN_AC, "sparse", alart_curnier),
    ("NSN-FB", 3): (sn.SICONOS_FRICTION_3D_NSN_FB, "sparse", newton),
    ("NSGS", 2): (sn.SICONOS_FRICTION_2D_NSGS, "block", nonsmooth_gauss_seidel),
    ("Lemke", 2): (sn.SICONOS_FRICTION_2D_LEMKE, "dense", lemke),
}


def siconos_matrix(W, storage, dimension):
    if storage == "dense":
        return numpy.asfortranarray(W.toarray())
    W = W.tocsc()
    W.indices, W.indptr = W.indices.astype(numpy.int64), W.indptr.astype(numpy.int64)     # Siconos's integers
    return W if storage == "sparse" else sn.SBM_from_csparse(dimension, W)[1]


class Silence:
    """Siconos's C code writes to file descriptor 1, where only our JSON belongs."""

    def __enter__(self):
        sys.stdout.flush()
        self.kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        os.close(nowhere)

    def __exit__(self, *_):
        ctypes.CDLL(None).fflush(None)
        os.dup2(self.kept, 1)
        os.close(self.kept)


def solve(problem, W, size, solver, set_options, tolerance):
    options = sn.SolverOptions(solver)
    set_options(options)
    options.dparam[sn.SICONOS_DPARAM_TOL] = tolerance
    r, u = numpy.zeros_like(problem.q), numpy.zeros_like(problem.q)
    driver = sn.fc3d_driver if problem.dimension == 3 else sn.fc2d_driver
    with Silence():
        value = sn.FrictionContactProblem(problem.dimension, problem.contacts, W, problem.q / size, problem.mu.copy())
        start, start_processor = time.perf_counter(), time.process_time()
        status = driver(value, r, u, options)
        # One thread. Processor time is counted in ticks of up to 10 ms.
        seconds = min(time.perf_counter() - start, time.process_time() - start_processor + 0.01)
    return {"seconds": seconds, "iterations": int(options.iparam[sn.SICONOS_IPARAM_ITER_DONE]), "tolerance": tolerance,
            "residual": problems.natural_map(problem, size * r), "ended": f"status {status}", "content": status == 0}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file")
    parser.add_argument("solver")
    parser.add_argument("--limit", type=float, default=1e-8)
    arguments = parser.parse_args()
    problem = problems.read(arguments.file)
    solver, storage, set_options = SOLVERS[arguments.solver, problem.dimension]
    sn.numerics_set_verbose(0)
    W = siconos_matrix(problem.W, storage, problem.dimension)
    size = numpy.linalg.norm(problem.q) or 1.0
    for tolerance in TOLERANCES:
        result = solve(problem, W, size, solver, set_options, tolerance)
        print(json.dumps(result), flush=True)
        if result["residual"] <= arguments.limit or not result["content"]:
            break
    os._exit(0)      # Siconos would free matrices that Python holds too


if __name__ == "__main__":
    main()
