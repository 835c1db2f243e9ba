#!/usr/bin/env python3
"""Where does a wall that is pushed harder and harder lose its equilibrium? An oracle that shares nothing with the solver.

    path.py COLUMNS COURSES FRICTION [--scabo build/bin/scabo] [--from 0.3]

Scabo writes the discrete problems of the wall without push and at half of its limit load (blocks.py); both are linear in the
push. From a solution at part `--from` of that load (Newton's method from bonded pairs, with line search) the solutions are
followed exactly while the push grows: for given states (open, stick, slip either way) they are linear in it, until one pair comes
to its limit; it takes its next state, and the path goes on to the side on which the new state is possible. One factorisation
(SuperLU) for each change of state; 1e-6 of the mean flexibility is added to that of each pair, because pairs of three bodies
that meet in a point are redundant. Needs NumPy, SciPy, h5py.

It ends where the matrix is singular: a body then moves although the push stands still. With walls of 4 x 4 and 8 x 8 blocks:

    4 x 4  0.3, 0.6   1.0000         8 x 8  0.3  1.0000
    4 x 4  1.0        0.8750         8 x 8  0.6  0.9375
"""
import argparse
import pathlib
import subprocess

import blocks
import h5py
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg

OPEN, STICK, FORWARD, BACKWARD = range(4)  # forward: u_t > 0


def matrix(group):
    rows, columns, nz = (int(group[k][()]) for k in ("m", "n", "nz"))
    p, i, x = group["p"][:], group["i"][:], group["x"][:]
    if nz == -1:
        return sp.csc_matrix((x, i, p), shape=(rows, columns)).tocsr()
    if nz == -2:
        return sp.csr_matrix((x, i, p), shape=(rows, columns))
    return sp.coo_matrix((x, (i, p)), shape=(rows, columns)).tocsr()


class Wall:
    """W, G, mu and q, f at no push and per limit load, as forces of the size of a block's weight."""

    def __init__(self, columns, courses, friction, scabo, folder):
        limit, read = blocks.limit_load(columns, courses, friction), []
        folder.mkdir(parents=True, exist_ok=True)
        for part in (0.0, 0.5):
            model = folder / f"path_{columns}_{courses}_{friction}_{part}.yaml"
            model.write_text("output: {discrete_problems: true}\n" + blocks.model(columns, courses, friction, part * limit))
            subprocess.run([scabo, "run", "-q", model, "-o", model.with_suffix(".results")], check=True, stderr=subprocess.DEVNULL)
            read.append(h5py.File(model.with_suffix(".results") / "problems" / "push_1.hdf5")["fclib_local"])
        W, self.G = matrix(read[0]["W"]), matrix(read[0]["V"])
        (q, f), (q_half, f_half) = ((file["vectors/q"][:], file["vectors/s"][:]) for file in read)
        self.mu, force = read[0]["vectors/mu"][:], np.abs(f).max()
        scale = 1.0 / np.mean(W.diagonal())
        self.n, self.m = self.G.shape
        self.W = (W * scale + 1e-6 * sp.eye(self.n)).tocsr()
        self.at_rest = np.r_[q * scale, f] / force
        self.of_push = 2.0 * (np.r_[q_half * scale, f_half] / force - self.at_rest)

    def solve(self, states, *loads):
        """Forces, rigid motions and relative motions under each of the loads [q; f] if the pairs have these states."""
        normal, tangent = 2 * np.flatnonzero(states != OPEN), 2 * np.flatnonzero(states == STICK) + 1
        rows = np.sort(np.r_[normal, tangent])
        place = np.full(self.n, -1)
        place[rows] = np.arange(len(rows))
        slipping, backward = np.flatnonzero(states >= FORWARD), states == BACKWARD
        friction = self.mu[slipping] * np.where(backward[slipping], 1.0, -1.0)
        forces = sp.csr_matrix((np.r_[np.ones(len(rows)), friction],
                                (np.r_[rows, 2 * slipping + 1], np.r_[np.arange(len(rows)), place[2 * slipping]])),
                               shape=(self.n, len(rows)))
        A = sp.bmat([[self.W[rows] @ forces, self.G[rows]], [self.G.T @ forces, None]]).tocsc()
        try:
            factor = sp.linalg.splu(A)
        except RuntimeError:  # exactly singular
            raise ZeroDivisionError from None
        pivots = np.abs(factor.U.diagonal())
        if pivots.min() < 1e-15 * pivots.max():
            raise ZeroDivisionError
        for load in loads:
            b = -np.r_[load[rows], load[self.n:]]
            x = factor.solve(b)
            x += factor.solve(b - A @ x)
            p, a = forces @ x[:len(rows)], x[len(rows):]
            yield p, a, self.W @ p + self.G @ a + load[:self.n]

    def at_equilibrium(self, part):
        """States at this part of the limit load."""
        load = self.at_rest + part * self.of_push
        A = sp.bmat([[self.W + 1e-3 * sp.eye(self.n), self.G], [self.G.T, None]]).tocsc()
        z = sp.linalg.spsolve(A, -load)
        r = 1.0 / np.maximum(self.W.diagonal(), 1e-3)

        def evaluate(z):
            p, u = z[:self.n], self.W @ z[:self.n] + self.G @ z[self.n:] + load[:self.n]
            trial, bound = (p - r * u)[1::2], self.mu * np.maximum(p[0::2], 0.0)
            H = np.empty(len(z))
            H[0:self.n:2] = np.minimum((r * u)[0::2], p[0::2])
            H[1:self.n:2] = p[1::2] - np.clip(trial, -bound, bound)
            H[self.n:] = self.G.T @ p + load[self.n:]
            sliding = np.where(trial < 0.0, FORWARD, BACKWARD)
            return H, np.where((r * u)[0::2] >= p[0::2], OPEN, np.where(np.abs(trial) < bound, STICK, sliding))

        for _ in range(60):
            H, states = evaluate(z)
            if np.abs(H).max() < 1e-11 * np.abs(z[:self.n]).max():
                return states
            (p, a, _), = self.solve(states, load)
            d, step = np.r_[p, a] - z, 1.0
            while step > 2.0**-10 and (h := evaluate(z + step * d)[0]) @ h > (1.0 - 2e-4 * step) * (H @ H):
                step /= 2.0
            z = z + (step if step > 2.0**-10 else 1.0) * d
        raise ArithmeticError("Newton's method does not converge: choose another --from")

    def distances(self, states, solution):
        """What must not become negative, two quantities a pair."""
        p, _, u = solution
        p_n, p_t, u_n, u_t = p[0::2], p[1::2], u[0::2], u[1::2]
        none = np.full(len(p_n), np.nan)
        return np.array([np.choose(states, [u_n, self.mu * p_n - p_t, p_n, p_n]),
                         np.choose(states, [none, self.mu * p_n + p_t, u_t, -u_t])])

    def follow(self, part, states, most=4000):
        """Part of the limit load at which the path ends, and how."""
        passed, highest = None, part
        for change in range(most):
            try:
                fixed, slope = self.solve(states, self.at_rest, self.of_push)
            except ZeroDivisionError:
                return highest, f"a body moves freely, after {change} changes of state"
            value = self.distances(states, fixed) + part * self.distances(states, slope)
            rate = self.distances(states, slope)
            direction = 1.0 if passed is None or rate[passed] > 0.0 else -1.0
            with np.errstate(all="ignore"):
                step = np.where(direction * rate < -1e-14, np.maximum(value, 0.0) / -(direction * rate), np.inf)
            step[np.isnan(step)] = np.inf
            if passed is not None:
                step[passed] = np.inf
            which, pair = np.unravel_index(np.argmin(step), step.shape)
            if not np.isfinite(step[which, pair]):
                return highest, "no pair comes to a limit any more"
            part += direction * step[which, pair]
            highest, states = max(highest, part), states.copy()
            if states[pair] == OPEN:
                states[pair] = FORWARD if (fixed[2] + part * slope[2])[2 * pair + 1] > 0.0 else BACKWARD
                passed = (0, pair)
            elif states[pair] == STICK:
                states[pair] = BACKWARD if which == 0 else FORWARD
                passed = (1, pair)
            elif which == 0:
                states[pair], passed = OPEN, (0, pair)
            else:
                passed = (1 if states[pair] == FORWARD else 0, pair)
                states[pair] = STICK
        return highest, f"turned back, {most} changes of state"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("columns", type=int)
    parser.add_argument("courses", type=int)
    parser.add_argument("friction", type=float)
    parser.add_argument("--scabo", default="build/bin/scabo")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("build/bench-blocks"))
    parser.add_argument("--from", type=float, default=0.3, dest="start")
    options = parser.parse_args()
    wall = Wall(options.columns, options.courses, options.friction, options.scabo, options.output)
    part, how = wall.follow(options.start, wall.at_equilibrium(options.start))
    print(f"{options.columns} x {options.courses}, friction {options.friction}: {part:.6f} of the limit load; {how}")


if __name__ == "__main__":
    main()
