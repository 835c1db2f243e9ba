"""Broken problem files: each ends in one message that names the file, the dataset and the remedy, exit status 1, and no noise of
the HDF5 library.

    bad_problems_test.py PROGRAM
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "regression"))
from problem_files import write_global, write_local

W, Q, MU = np.diag([2.0, 1.0, 3.0, 2.0]), np.array([-1.0, 0.1, -0.5, 0.2]), np.array([0.3, 0.3])
M, H = np.diag([2.0, 3.0, 4.0]), np.array([[1.0, 0.0], [0.0, 1.0], [0.5, 0.0]])


def replaced(name, value):
    """What puts another dataset in the place of `name`; without a value what takes it away."""
    def change(file):
        del file[name]
        if value is not None:
            file[name] = value
    return change


LOCAL = [
    ("fclib_local/spacedim", np.int32([5]), "fclib_local/spacedim: must be 2 or 3, not 5"),
    ("fclib_local/spacedim", np.int32([3]), "fclib_local/W/m: is 4, which is not a multiple of spacedim, 3"),
    ("fclib_local/spacedim", np.int32([2, 2]), "fclib_local/spacedim: must be one whole number, not 2"),
    ("fclib_local/spacedim", [2.5], "fclib_local/spacedim: must hold whole numbers, not numbers"),
    ("fclib_local/spacedim", None, "fclib_local/spacedim: is missing"),
    ("fclib_local/W", None, "fclib_local/W/m: is missing"),
    ("fclib_local/W", [1.0], "fclib_local/W/m: is missing"),
    ("fclib_local/W/x", None, "fclib_local/W/x: is missing"),
    ("fclib_local/W/x", "text", "fclib_local/W/x: must hold numbers, not text"),
    ("fclib_local/W/x", [1.0, 2.0, np.nan, 1.0], "fclib_local/W/x: entry 2 is nan: must be a finite number"),
    ("fclib_local/W/x", [1.0, 2.0, np.inf, 1.0], "fclib_local/W/x: entry 2 is inf: must be a finite number"),
    ("fclib_local/W/x", [1.0], "fclib_local/W/p: entry 2 is 2: must be from 1 (the one before) to 1"),
    ("fclib_local/W/m", np.int32([6]), "fclib_local/W: must be square, not 6 x 4"),
    ("fclib_local/W/m", np.int32([-4]), "fclib_local/W/m: must be from 0 to 100000000, not -4"),
    ("fclib_local/W/n", np.int64([2**62]), "fclib_local/W/n: must be from 0 to 100000000, not "),
    ("fclib_local/W/n", np.int32([5]), "fclib_local/W/p: must hold 6 values (n + 1, because nz is -1), not 5"),
    ("fclib_local/W/nz", np.int32([-7]), "fclib_local/W/nz: must be -1 (compressed columns), -2 (compressed rows) or"),
    ("fclib_local/W/nz", np.int32([99]), "fclib_local/W/p: must hold 99 values (nz), not 5"),
    ("fclib_local/W/p", np.int32([0, 1, 2, 3, 9]), "fclib_local/W/p: entry 4 is 9: must be from 3 (the one before) to 4"),
    ("fclib_local/W/p", np.int32([0, 3, 2, 3, 4]), "fclib_local/W/p: entry 2 is 2: must be from 3 (the one before) to 4"),
    ("fclib_local/W/p", np.int32([1, 1, 2, 3, 4]), "fclib_local/W/p: must start with 0, not 1"),
    ("fclib_local/W/p", np.int32([]), "fclib_local/W/p: must hold 5 values"),
    ("fclib_local/W/i", np.int32([0, 1, 2, 4]), "fclib_local/W: entry 3 is in row 4 and column 3 (counted from 0) of a matrix of 4 x 4"),
    ("fclib_local/W/i", np.int32([0, 1, -2, 3]), "fclib_local/W: entry 2 is in row -2"),
    ("fclib_local/W/i", np.int32([0, 1]), "fclib_local/W/i: must hold 4 values (the last of p), not 2"),
    ("fclib_local/vectors/q", None, "fclib_local/vectors/q: is missing"),
    ("fclib_local/vectors/q", [1.0, 2.0], "fclib_local/vectors/q: must hold 4 values (as many as rows of W), not 2"),
    ("fclib_local/vectors/q", [1.0, 2.0, np.nan, 3.0], "fclib_local/vectors/q: entry 2 is nan: must be a finite number"),
    ("fclib_local/vectors/mu", [0.3], "fclib_local/vectors/mu: must hold 2 values (one for each pair), not 1"),
    ("fclib_local/vectors/mu", [0.3, -0.1], "fclib_local/vectors/mu: entry 1 is -0.1: a coefficient of friction must be 0 or more"),
    ("fclib_local/vectors", None, "fclib_local/vectors/q: is missing"),
    ("fclib_local", None, "has neither fclib_local nor fclib_global"),
]
GLOBAL = [
    ("fclib_global/M", None, "fclib_global/M/m: is missing"),
    ("fclib_global/M/x", [1.0, 0.0, 1.0], "fclib_global/M: M (with its constraints G) is singular"),
    ("fclib_global/H/m", np.int32([4]), "fclib_global/H/m: must be 3, as many as rows of M, not 4"),
    ("fclib_global/vectors/f", [1.0], "fclib_global/vectors/f: must hold 3 values (as many as rows of M), not 1"),
    ("fclib_global/vectors/w", [np.nan, 1.0], "fclib_global/vectors/w: entry 0 is nan"),
    ("fclib_global/vectors/mu", [-1.0], "fclib_global/vectors/mu: entry 0 is -1"),
]


class BadProblems(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="scabo_test_")
        self.addCleanup(holder.cleanup)
        self.file = pathlib.Path(holder.name, "problem.hdf5")

    def expect(self, message, file=None):
        file = file or self.file
        done = subprocess.run([PROGRAM, "contact", str(file)], text=True, capture_output=True, timeout=1200)
        self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
        self.assertTrue(done.stderr.startswith(f"{file}: {message}"), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_every_mistake_in_the_local_form(self):
        for name, value, message in LOCAL:
            with self.subTest(name=name, message=message):
                write_local(self.file, W, Q, MU)
                with h5py.File(self.file, "r+") as file:
                    replaced(name, value)(file)
                self.expect(message)

    def test_every_mistake_in_the_global_form(self):
        for name, value, message in GLOBAL:
            with self.subTest(name=name, message=message):
                write_global(self.file, M, H, [1.0, 2.0, 3.0], [0.1, 0.2], [0.3])
                with h5py.File(self.file, "r+") as file:
                    replaced(name, value)(file)
                self.expect(message)

    def test_constraints_laws_and_history(self):
        V = np.array([[1.0], [0], [1], [0]])
        for name, value, message in [
            ("fclib_local/R", None, "fclib_local/R/m: is missing"),
            ("fclib_local/V/m", np.int32([5]), "fclib_local/V/m: must be 4, as many as rows of W, not 5"),
            ("fclib_local/R/m", np.int32([3]), "fclib_local/R: must be 1 x 1, as many as columns of V, not 3 x 1"),
            ("fclib_local/vectors/s", None, "fclib_local/vectors/s: is missing"),
            ("fclib_local/vectors/cohesion", [1.0], "fclib_local/vectors/cohesion: must hold 2 values"),
            ("fclib_local/vectors/cohesion", [1.0, -2.0], "fclib_local/vectors/cohesion: entry 1 is -2: must be 0 or more"),
            ("fclib_local/vectors/tension", [np.nan, 0.0], "fclib_local/vectors/tension: entry 0 is nan: must be 0 or more"),
            ("guesses/1/r", [1.0], "guesses/1/r: must hold 4 values (as many as q), not 1"),
            ("solution/r", [1.0, 2, 3, np.nan], "solution/r: entry 3 is nan"),
            ("scabo/force_scale", [-1.0], "scabo/force_scale: must be 0 or more, not -1"),
        ]:
            with self.subTest(name=name):
                write_local(self.file, W, Q, MU, V=V, s=[-1.0])
                with h5py.File(self.file, "r+") as file:
                    if name in file:
                        del file[name]
                    if value is not None:
                        file[name] = value
                self.expect(message)

    def test_singular_constraints(self):
        V, R = np.eye(4)[:, :2], np.diag([1.0, 0.0])
        write_local(self.file, W, Q, MU, V=V, s=[1.0, 1.0], R=R)
        self.expect("fclib_local/R: must be zero or nonsingular")

    def test_files_cut_off(self):
        write_local(self.file, W, Q, MU)
        whole = self.file.read_bytes()
        for size in (0, 1, 7, 8, 100, 512, len(whole) // 2, len(whole) - 1):
            with self.subTest(size=size):
                self.file.write_bytes(whole[:size])
                self.expect("is empty" if size == 0 else "is not an HDF5 file: the signature" if size < 8 else
                            "the HDF5 file cannot be opened: HDF5 says 'truncated file: eof = " if size >= 512 else
                            "the HDF5 file cannot be opened: HDF5 says '")

    def test_what_hdf5_cannot_read(self):
        """The message says what HDF5 says."""
        name = "fclib_local/vectors/q"
        for change, message in ((lambda file: file.create_group(name), "cannot be read as a dataset: HDF5 says 'not a dataset'"),
                                (lambda file: file.create_dataset(name, data=np.zeros(4, "f8, f8")), "must hold numbers, not data of another kind"),
                                (lambda file: file.create_dataset(name, (4,), "f8", external=[("missing.raw", 0, 32)]),
                                 "cannot be read as a dataset: HDF5 says '")):
            with self.subTest(message=message):
                write_local(self.file, W, Q, MU)
                with h5py.File(self.file, "r+") as file:
                    del file[name]
                    change(file)
                self.expect(f"{name}: {message}")

    def test_files_that_are_no_problem(self):
        folder = self.file.parent
        self.expect("no such file", folder / "missing.hdf5")
        self.expect("is a directory: name a problem file", folder)
        (folder / "text.hdf5").write_text("2\n1\n")
        self.expect("is not an HDF5 file: the signature with which one begins is missing", folder / "text.hdf5")
        (folder / "empty.hdf5").write_text("")
        self.expect("is empty", folder / "empty.hdf5")
        (folder / "empty.dat").write_text("")
        self.expect("is empty", folder / "empty.dat")
        with h5py.File(self.file, "w") as file:
            file["temperature"] = [20.0]
        self.expect("has neither fclib_local nor fclib_global, so that it is not a problem in FCLIB's layout (available: temperature)")

    def test_text_has_line_and_column(self):
        text = self.file.parent / "problem.dat"
        text.write_text("2\n1\n0\n2\n2\n2 2\n1 0\n0 x\n")
        done = subprocess.run([PROGRAM, "contact", str(text)], text=True, capture_output=True, timeout=1200)
        self.assertEqual((done.returncode, done.stderr), (1, f"{text}:8:3: W: must be a number, not 'x'\n"))

    def test_numbers_whose_squares_overflow(self):
        text = self.file.parent / "problem.dat"
        for stiffness, motion in (("1e-200", "1e200"), ("1", "1e200"), ("1e-150", "1e10")):
            with self.subTest(W=stiffness, q=motion):
                text.write_text(f"2 1\n0\n2 2\n2 2\n1/W 0 0 1/W\n-{motion} 0\n0.3\n".replace("1/W", stiffness))
                done = subprocess.run([PROGRAM, "contact", str(text)], text=True, capture_output=True, timeout=1200)
                self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
                self.assertIn(f"has motions q up to {motion.replace('1e10', '1e+10').replace('1e200', '1e+200')}", done.stderr)
                self.assertIn("use other units", done.stderr)

    def test_bytes_changed_at_random(self):
        """Whatever the bytes: a solution or one message, never a crash."""
        write_local(self.file, W, Q, MU)
        whole = self.file.read_bytes()
        random = np.random.default_rng(1)
        for _ in range(60):
            broken = bytearray(whole)
            for at in random.integers(len(whole), size=8):
                broken[at] = random.integers(256)
            self.file.write_bytes(bytes(broken))
            done = subprocess.run([PROGRAM, "contact", str(self.file)], text=True, capture_output=True, timeout=1200)
            self.assertIn(done.returncode, (0, 1, 2), done.stderr)
            self.assertLessEqual(done.stderr.count("\n"), 1, done.stderr)


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
