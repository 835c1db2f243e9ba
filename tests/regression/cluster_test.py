"""Runs by mpirun on 2 and 3 ranks give what one process gives (docs/clusters.md), and end with their reason where they cannot go on."""
import csv
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import numpy as np

import support
from support import ROOT, InTemporaryDirectory, scabo, summary_of

sys.path.insert(0, str(ROOT / "python" / "scabo"))
from plot import vtu  # noqa: E402  (its readers need NumPy alone)

MPIRUN = shutil.which("mpirun")
# Also as root, and with more ranks than processors, one thread each.
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_btl_base_warn_component_unused": "0",
               "OMPI_MCA_odls_base_sigkill_timeout": "5",  # a busy machine is slow to record the end
               "OMPI_MCA_mpi_yield_when_idle": os.environ.get("OMPI_MCA_mpi_yield_when_idle", "1"), "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}

# Every kind of mesh, tied bodies of two kinds, one of a file, a slender one, inclined supports, springs, a rigid body, and a
# super-element, which stays on rank 0.
MODEL = """
scabo: 1
title: Blocks on a base
analysis: {plane: strain}
materials:
  rock: {young: 20e9, poisson: 0.25, density: 2500}
  steel: {young: 210e9, poisson: 0.3, density: 7850}
bodies:
  base: {material: rock, shape: {rectangle: {corner: [-1, -1], size: [8, 1]}}, mesh: {kind: polygons, size: 0.2}}
  left: {material: rock, shape: {rectangle: {corner: [0, 0], size: [2, 1]}}, mesh: {kind: quadtree, size: 0.1}}
  right: {material: rock, shape: {rectangle: {corner: [3, 0], size: [2, 1]}}, mesh: {kind: fem, size: 0.125, order: 2}}
  cap: {material: steel, shape: {rectangle: {corner: [3, 1], size: [2, 0.5]}}, mesh: {kind: polygons, size: 0.125}}
  plate: {material: steel, mesh: {file: plate.msh}}
  ramp:
    material: rock
    shape: {polygon: {vertices: [[8, 0], [10, 0], [10, 1], [8, 2]], names: {bottom: edge_1, slope: edge_3}}}
    mesh: {kind: quadtree, size: 0.2}
  beam: {material: steel, shape: {rectangle: {corner: [11, 0], size: [4, 0.1]}}, mesh: {kind: quadtree, size: 0.05}}
  small: {material: steel, shape: {rectangle: {corner: [0.5, 1], size: [1, 0.5]}}, mesh: {size: 0.125}}
  punch: {rigid: true, shape: {rectangle: {corner: [3.5, 1.5], size: [1, 0.5]}}}
supports:
  - {on: base.bottom, fix: [x, y], name: ground}
  - {on: ramp.slope, fix: normal}
  - {on: beam.left, fix: [x, y]}
springs:
  - {on: ramp.bottom, k_n: 5e9, k_t: 1e9}
loads:
  weight: {gravity: [0, -9.81]}
  press: {on: small.top, pressure: 1e6}
  push: {on: left.left, traction: [2e5, 0]}
  punch: {on: punch, force: [1e5, -1e6]}
  tip: {on: beam.right, force: [0, -100]}
ties:
  joint: {between: [right.top, cap.bottom]}
contacts:
  all: {between: all, friction: 0.4}
  plate: {between: [base.top, plate.bottom], friction: 0.2}
steps:
  - {name: weight, increments: 1, loads: {weight: 1, punch: 1}}
  - {name: push, increments: 2, loads: {weight: 1, press: 1, push: 1, punch: 1, tip: 1}}
output:
  points: [[1, 0.5], [4, 1.2], [9, 0.5]]
  lines: [{from: [0, -0.5], to: [6, -0.5], points: 11, name: cut}]
  history: {tip: beam.top_right.uy, work: friction_energy}
"""


def plate_file(nodes=9):
    """A square of 1 m at x = 5.5 in Gmsh's text of version 2.2, its lower side named."""
    spread = np.linspace(0.0, 1.0, nodes)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '1 1 "bottom"', '2 2 "plate"', "$EndPhysicalNames",
             "$Nodes", str(nodes * nodes)]
    lines += [f"{j * nodes + i + 1} {5.5 + spread[i]:.17g} {spread[j]:.17g} 0" for j in range(nodes) for i in range(nodes)]
    lines += ["$EndNodes", "$Elements", str((nodes - 1) ** 2 + nodes - 1)]
    lines += [f"{i + 1} 1 2 1 1 {i + 1} {i + 2}" for i in range(nodes - 1)]
    number = nodes
    for j in range(nodes - 1):
        for i in range(nodes - 1):
            first = j * nodes + i + 1
            lines.append(f"{number} 3 2 2 2 {first} {first + 1} {first + nodes + 1} {first + nodes}")
            number += 1
    return "\n".join(lines + ["$EndElements", ""])


def mpirun(ranks, *arguments, cwd=None, program=None, **environment):
    return subprocess.run([MPIRUN, "-n", str(ranks), *(program or [support.SCABO]), *map(str, arguments)], cwd=cwd, text=True,
                          capture_output=True, stdin=subprocess.DEVNULL, timeout=support.PATIENCE, env={**ENVIRONMENT, **environment})


def own_lines(text):
    """What the program wrote, without what mpirun adds."""
    return [line for line in text.splitlines() if line.startswith("scabo:") or ".yaml" in line]


def columns_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return dict(zip(rows[0], zip(*rows[1:])))


def numbers(column):
    try:
        return np.array([float(value or "nan") for value in column])
    except ValueError:
        return None


# Columns that are compared on one scale.
SCALES = [("gap", "slip", "displacement", "ux", "uy", "tip"), ("force",), ("pressure", "shear", "stress", "principal", "mises"), ("energy", "work")]


def scale_of(name):
    return next((k for k, parts in enumerate(SCALES) if any(part in name for part in parts)), name)


class Clusters(InTemporaryDirectory):
    def setUp(self):
        super().setUp()
        (self.directory / "model.yaml").write_text(MODEL, encoding="utf-8")
        (self.directory / "plate.msh").write_text(plate_file(), encoding="utf-8")

    def run_on(self, ranks, name, *arguments):
        run = mpirun(ranks, "run", "model.yaml", "-o", name, "--quiet", *(arguments or ("--divide-from", 100)), cwd=self.directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(own_lines(run.stderr), [])

    def expect_equal(self, one, many, tolerance=1e-10, tables=("contact.csv", "points.csv", "lines.csv", "history.csv")):
        """Tables, summaries and fields of two directories, to `tolerance` of the largest value of their kind."""
        worst = 0.0
        for name in tables:
            expected, found = columns_of(self.directory / one / name), columns_of(self.directory / many / name)
            self.assertEqual(list(expected), list(found), name)
            values = {key: numbers(column) for key, column in expected.items()}
            scale = {}
            for key, column in values.items():
                if column is not None:
                    scale[scale_of(key)] = max(scale.get(scale_of(key), 0.0), np.nanmax(np.abs(column), initial=0.0))
            for key, column in values.items():
                if column is None:
                    self.assertEqual(expected[key], found[key], f"{name}: {key}")
                    continue
                difference = np.nanmax(np.abs(column - numbers(found[key])), initial=0.0) / (scale[scale_of(key)] or 1.0)
                worst = max(worst, difference)
                self.assertLessEqual(difference, tolerance, f"{name}: {key}")
        before, after = summary_of(self.directory / one), summary_of(self.directory / many)
        self.assertEqual(after["status"], before["status"])
        self.assertEqual(after["model"], before["model"])
        for expected, found in zip(before["increments"], after["increments"], strict=True):
            for support_name, reaction in expected["reactions"].items():
                np.testing.assert_allclose(found["reactions"][support_name], reaction, rtol=0, atol=tolerance * 1e7)
            for contact, values in expected["contacts"].items():
                for key in ("open", "stick", "slip"):
                    self.assertEqual(found["contacts"][contact][key], values[key])
            self.assertLessEqual(support.certificate_of(found), 1e-10)
        return worst

    def expect_equal_fields(self, one, many, ranks, increments):
        for number in range(1, increments + 1):
            expected = vtu.read_grid(self.directory / one / f"fields_{number:04d}.vtu")
            path = self.directory / many / f"fields_{number:04d}.pvtu"
            self.assertFalse(path.with_suffix(".vtu").exists())
            self.assertTrue((self.directory / many / f"fields_{number:04d}_{ranks - 1}.vtu").exists())
            found = vtu.read_parts(path)
            self.assertEqual(len(found.points), len(expected.points))
            self.assertEqual(sorted(found.types), sorted(expected.types))
            for body in np.unique(expected.point_data["body"]):
                # Nodes come first and in their order; points inside cells are found by their place.
                here, there = (np.flatnonzero(grid.point_data["body"] == body) for grid in (expected, found))
                self.assertEqual(len(here), len(there))
                order = [points[np.lexsort(np.round(grid.points[points], 9).T)] for grid, points in ((expected, here), (found, there))]
                np.testing.assert_allclose(found.points[order[1]], expected.points[order[0]], rtol=0, atol=1e-12)
                for name, bound in (("displacement", 1e-10), ("stress", 1e-6), ("von_mises", 1e-6)):  # stresses have seven digits
                    scale = np.nanmax(np.abs(expected.point_data[name]))
                    np.testing.assert_allclose(found.point_data[name][order[1]], expected.point_data[name][order[0]], rtol=0,
                                               atol=bound * scale, err_msg=f"{name} of body {body}")
        names = [name for _, name in vtu.read_collection(self.directory / many / "fields.pvd")]
        self.assertEqual(names, [f"fields_{number:04d}.pvtu" for number in range(1, increments + 1)])

    def test_the_same_as_one_process(self):
        run = scabo("run", "model.yaml", "-o", "one", "--quiet", "--threads", 1, cwd=self.directory)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        for ranks in (2, 3):
            self.run_on(ranks, f"many_{ranks}")
            self.expect_equal("one", f"many_{ranks}")
            self.expect_equal_fields("one", f"many_{ranks}", ranks, 3)

    def test_a_body_all_of_whose_nodes_are_in_contact(self):
        """MUMPS has no Schur complement of all unknowns: entries of the inverse give the flexibility of the shim."""
        shim = """bodies:
  shim: {material: rock, shape: {rectangle: {corner: [0.5, 1], size: [1, 0.05]}}, mesh: {kind: quadtree, size: 0.05, order: 1}}"""
        model = BLOCKS.format(size=0.05, increments=1).replace("bodies:", shim).replace("corner: [0.5, 1], size: [1, 0.5]", "corner: [0.5, 1.05], size: [1, 0.5]")
        model = model.replace("contacts: {", "contacts: {under: {between: [lower.top, shim.bottom], friction: 0.4}, ").replace("[lower.top, upper.bottom]", "[shim.top, upper.bottom]")
        (self.directory / "model.yaml").write_text(model, encoding="utf-8")
        run = scabo("run", "model.yaml", "-o", "one", "--quiet", "--threads", 1, cwd=self.directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(len(columns_of(self.directory / "one" / "contact.csv")["pair"]), summary_of(self.directory / "one")["model"]["bodies"][0]["nodes"])
        self.run_on(2, "many", "--divide-from", 50)
        self.expect_equal("one", "many", tables=("contact.csv",))


# Two bodies in contact, both of which are divided: at some pairs other ranks meet than at others.
BLOCKS = """
scabo: 1
materials: {{rock: {{young: 20e9, poisson: 0.25}}}}
bodies:
  lower: {{material: rock, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{kind: quadtree, size: {size}}}}}
  upper: {{material: rock, shape: {{rectangle: {{corner: [0.5, 1], size: [1, 0.5]}}}}, mesh: {{kind: quadtree, size: {size}}}}}
supports: [{{on: lower.bottom, fix: [x, y]}}]
loads:
  press: {{on: upper.top, pressure: 1e6}}
  push: {{on: upper.left, traction: [1e5, 0]}}
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: 0.3}}}}
steps: [{{increments: {increments}}}]
output: {{every: 1000}}
"""


class Failures(InTemporaryDirectory):
    def test_a_wrong_model_is_told_once(self):
        (self.directory / "model.yaml").write_text("scabo: 1\nbodies: {a: {material: concreet}}\n", encoding="utf-8")
        run = mpirun(3, "run", "model.yaml", cwd=self.directory)
        self.assertEqual(run.returncode, 1)
        lines = own_lines(run.stderr)
        self.assertTrue(lines and all(line.startswith("model.yaml:") for line in lines), run.stderr)
        self.assertEqual(len(lines), len(set(lines)))

    def test_commands_for_one_process_say_so(self):
        run = mpirun(2, "check", "model.yaml", cwd=self.directory)
        self.assertEqual(run.returncode, 1)
        self.assertEqual(len(own_lines(run.stderr)), 1, run.stderr)
        self.assertIn("without mpirun", run.stderr)

    def test_an_option_for_ranks_needs_ranks(self):
        run = scabo("run", "model.yaml", "--divide-from", 10, cwd=self.directory)
        self.assertEqual(run.returncode, 1)
        self.assertIn("mpirun", run.stderr)

    LARGE = """
scabo: 1
materials: {rock: {young: 20e9, poisson: 0.25, density: 2500}}
bodies:
  block: {material: rock, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {kind: quadtree, size: SIZE}}
supports: [{on: block.bottom, fix: [x, y]}]
loads: {weight: {gravity: [0, -9.81]}}
steps: [{increments: 300}]
output: {every: 1000}
"""

    def write(self, size):
        (self.directory / "model.yaml").write_text(self.LARGE.replace("SIZE", str(size)), encoding="utf-8")

    def test_a_lost_rank_ends_the_run(self):
        self.write(0.05)
        with subprocess.Popen([MPIRUN, "-n", "2", support.SCABO, "run", "model.yaml", "-o", "results", "--divide-from", "100"],
                              cwd=self.directory, env=ENVIRONMENT, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as run:
            summary = self.directory / "results" / "summary.json"
            while not (self.directory / "results" / "checkpoint.state").exists() and run.poll() is None:
                time.sleep(0.05)
            self.kill_rank(run.pid, "1")
            _, errors = run.communicate(timeout=support.PATIENCE)
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("signal 9", errors)  # mpirun names the rank
        self.assertEqual(json.loads(summary.read_text(encoding="utf-8"))["status"], "failed")
        resumed = scabo("resume", "results", "--quiet", cwd=self.directory)  # by one process
        self.assertEqual(resumed.returncode, 0, resumed.stderr)

    def test_a_rank_lost_before_the_first_increment_ends_the_run(self):
        """As the other rank waits for it within MUMPS, or has what MUMPS condensed."""
        (self.directory / "model.yaml").write_text(BLOCKS.format(size=0.008, increments=300), encoding="utf-8")
        for stage, pause in (("factorisation", 0.3), ("condensation to the contact pairs", 0.0)):
            with self.subTest(stage), subprocess.Popen(
                    [MPIRUN, "-n", "2", support.SCABO, "run", "model.yaml", "-o", "results", "--divide-from", "100", "--json-lines", "--quiet"],
                    cwd=self.directory, env=ENVIRONMENT, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as run:
                for line in run.stdout:
                    event = json.loads(line)
                    if (event["event"], event.get("stage")) == ("stage_begin", stage):
                        break
                time.sleep(pause)
                self.kill_rank(run.pid, "1")
                _, errors = run.communicate(timeout=support.PATIENCE)
                self.assertNotEqual(run.returncode, 0)
                self.assertIn("signal 9", errors)
                self.assertEqual(summary_of(self.directory / "results")["status"], "failed")

    def kill_rank(self, parent, rank):
        found = [int(entry.name) for entry in pathlib.Path("/proc").iterdir() if entry.name.isdigit() and self.is_rank(entry, parent, rank)]
        self.assertEqual(len(found), 1)
        os.kill(found[0], signal.SIGKILL)

    @staticmethod
    def is_rank(entry, parent, rank):
        try:
            stat = (entry / "stat").read_text()
            if int(stat.rsplit(")", 1)[1].split()[1]) != parent:
                return False
            return f"OMPI_COMM_WORLD_RANK={rank}".encode() in (entry / "environ").read_bytes().split(b"\0")
        except OSError:
            return False

    def test_a_rank_without_memory_ends_the_run(self):
        self.write(0.004)
        limit = "[ $OMPI_COMM_WORLD_RANK = 1 ] && ulimit -v 900000; exec \"$@\""
        run = mpirun(2, "run", "model.yaml", "-o", "results", "--divide-from", 100, cwd=self.directory,
                     program=["sh", "-c", limit, "sh", support.SCABO])
        self.assertEqual(run.returncode, 3, run.stderr)
        lines = own_lines(run.stderr)
        self.assertEqual(len(lines), 1, run.stderr)
        self.assertIn("rank 1 of 2", lines[0])
        self.assertIn("not enough memory", lines[0])
        summary = summary_of(self.directory / "results")
        self.assertEqual(summary["status"], "failed")
        self.assertIn("rank 1 of 2", summary["reason"])


if __name__ == "__main__":
    support.main()
