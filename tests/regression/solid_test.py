"""Models in space from the command line: examples/30_blocks_in_space and its twins."""
import importlib.util
import json
import math
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest

import support
from solids import arrays_of, vector
from support import ROOT, certificate_of, rows_of, scabo, summary_of

EXAMPLE = ROOT / "examples" / "30_blocks_in_space"
OUTPUT = "output={points: [[0.5, 0.5, -0.1]], history: {cut: {section: {point: [0, 0, -0.1], normal: [0, 0, 1]}}}}"
CHECK = json.loads((EXAMPLE / "check.json").read_text(encoding="utf-8"))
TOLERANCE = CHECK["relative_tolerance"]


def blocks():
    sys.dont_write_bytecode = True
    spec = importlib.util.spec_from_file_location("blocks", EXAMPLE / "blocks.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


GMSH_MIDDLES = (0, 1, 2, 3, 5, 4)  # the order of Gmsh's middle nodes among those of C3D10


class MeshOfBlocks:
    """Both blocks of the example as one mesh, to be written in other formats. Physical numbers: volumes 1 and 2, surfaces 11 ... by their names."""

    def __init__(self, linear=False):
        self.points, self.cells, self.facets, self.names = [], [], [], []
        for volume, name in enumerate(("base", "block"), 1):
            first, section, faces = len(self.points), "", {}
            for line in (EXAMPLE / f"{name}.inp").read_text(encoding="utf-8").splitlines():
                if line.startswith("*"):
                    section = line
                    continue
                fields = line.split(", ")
                if section == "*NODE":
                    self.points.append(tuple(map(float, fields[1:])))
                elif section.startswith("*ELEMENT"):
                    self.cells.append((volume, [first + int(node) - 1 for node in fields[1:5 if linear else 11]]))
                    faces[fields[0]] = self.cells[-1][1]
                else:
                    face = section.split("NAME=")[1]
                    if face not in self.names:
                        self.names.append(face)
                    corners = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))[int(fields[1][1]) - 1]
                    self.facets.append((11 + self.names.index(face), [faces[fields[0]][i] for i in corners]))

    def names_of_gmsh(self):
        groups = [(3, 1, "base"), (3, 2, "block")] + [(2, 11 + i, name) for i, name in enumerate(self.names)]
        return f"$PhysicalNames\n{len(groups)}\n" + "".join(f'{d} {tag} "{name}"\n' for d, tag, name in groups) + "$EndPhysicalNames\n"

    @staticmethod
    def in_order_of_gmsh(nodes):
        return " ".join(str(node + 1) for node in nodes[:4] + [nodes[4 + k] for k in GMSH_MIDDLES if len(nodes) == 10])

    def msh_2(self):
        type_of = {3: 2, 4: 4, 10: 11}
        elements = [f"{type_of[len(nodes)]} 2 {group} {group} {self.in_order_of_gmsh(nodes)}" for group, nodes in self.facets + self.cells]
        return ("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + self.names_of_gmsh() + f"$Nodes\n{len(self.points)}\n" +
                "".join(f"{i} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(self.points, 1)) + f"$EndNodes\n$Elements\n{len(elements)}\n" +
                "".join(f"{i} {element}\n" for i, element in enumerate(elements, 1)) + "$EndElements\n")

    def msh_4(self):
        type_of = {3: 2, 4: 4, 10: 11}
        surfaces = range(11, 11 + len(self.names))
        entities = "".join(f"{tag} 0 0 0 0 0 0 1 {tag} 0\n" for tag in [*surfaces, 1, 2])
        blocks, number = [], 0
        for dimension, of in ((2, self.facets), (3, self.cells)):
            for tag in sorted({group for group, _ in of}):
                rows = [nodes for group, nodes in of if group == tag]
                lines = [f"{dimension} {tag} {type_of[len(rows[0])]} {len(rows)}"]
                for nodes in rows:
                    number += 1
                    lines.append(f"{number} {self.in_order_of_gmsh(nodes)}")
                blocks.append("\n".join(lines) + "\n")
        n = len(self.points)
        return ("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + self.names_of_gmsh() + f"$Entities\n0 0 {len(surfaces)} 2\n{entities}$EndEntities\n" +
                f"$Nodes\n1 {n} 1 {n}\n3 1 0 {n}\n" + "".join(f"{i}\n" for i in range(1, n + 1)) +
                "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in self.points) + f"$EndNodes\n$Elements\n{len(blocks)} {number} 1 {number}\n" +
                "".join(blocks) + "$EndElements\n")

    def vtu(self):
        rows = self.facets + self.cells
        ends = [sum(len(nodes) for _, nodes in rows[:i + 1]) for i in range(len(rows))]

        def array(name, kind, values, more=""):
            return f'<DataArray type="{kind}" Name="{name}"{more}>{" ".join(map(repr, values))}</DataArray>\n'
        return (f'<VTKFile type="UnstructuredGrid" version="0.1"><UnstructuredGrid><Piece NumberOfPoints="{len(self.points)}" NumberOfCells="{len(rows)}">\n<Points>' +
                array("Points", "Float64", [x for point in self.points for x in point], ' NumberOfComponents="3"') + "</Points><Cells>" +
                array("connectivity", "Int64", [node for _, nodes in rows for node in nodes]) + array("offsets", "Int64", ends) +
                array("types", "UInt8", [{3: 5, 4: 10, 10: 24}[len(nodes)] for _, nodes in rows]) + "</Cells><CellData>" +
                array("region", "Int32", [group for group, _ in rows]) + "</CellData></Piece></UnstructuredGrid></VTKFile>\n")


class BlocksInSpace(support.InTemporaryDirectory):
    def solve(self, model, name, *arguments):
        done = scabo("run", model, "-o", self.directory / name, "--quiet", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = summary_of(self.directory / name)
        self.assertEqual(summary["status"], "solved")
        return summary["increments"]

    def assert_close(self, one, other, scale):
        for a, b in zip(one, other, strict=True):
            self.assertAlmostEqual(a, b, delta=TOLERANCE * scale)

    def test_the_block_slides_with_the_forces_of_statics(self):
        increments = self.solve(EXAMPLE / "model.yaml", "results")
        self.assertEqual([(of["step"], of["increment"]) for of in increments], [(1, 1)] + [(2, k) for k in (1, 2, 3, 4)])
        self.assertEqual([of["reached"] for of in increments], [1.0, 0.25, 0.5, 0.75, 1.0])
        N, T = CHECK["normal_force"], CHECK["tangential_force"]
        for of in increments:
            self.assert_close(of["contacts"]["joint"]["normal_force"], [0, 0, N], N)
            self.assert_close([sum(f) for f in zip(*of["reactions"].values())], [0, 0, N], N)
            self.assertLessEqual(certificate_of(of), 1e-10)
        last = increments[-1]
        self.assertEqual((last["contacts"]["joint"]["open"], last["contacts"]["joint"]["stick"]), (0, 0))
        self.assert_close(last["contacts"]["joint"]["tangential_force"], [-T, 0, 0], N)
        rows = [row for row in rows_of(self.directory / "results") if (row["step"], row["increment"]) == ("2", "4")]
        area = sum(float(row["area"]) for row in rows)
        self.assertAlmostEqual(area, 0.36, delta=1e-12)
        self.assertAlmostEqual(sum(float(row["pressure"]) * float(row["area"]) for row in rows), N, delta=TOLERANCE * N)
        for row in rows:
            self.assertEqual(row["state"], "slip")
            self.assertAlmostEqual(math.hypot(*vector(row, "shear")), 0.3 * float(row["pressure"]), delta=1e-9 * N / 0.36)

    def test_fields_are_quadratic_tetrahedra_with_displacements(self):
        self.solve(EXAMPLE / "model.yaml", "results")
        files = sorted(file.name for file in (self.directory / "results").glob("*.vtu"))
        self.assertEqual(files, [f"{what}_{k:04d}.vtu" for what in ("contact", "fields") for k in range(1, 6)])
        arrays = arrays_of(self.directory / "results" / files[-1])
        cells = 6 * (3 * 3 * 2 + 2 * 2 * 2)
        self.assertEqual(arrays["types"], (24,) * cells)
        self.assertEqual(arrays["offsets"], tuple(range(10, 10 * cells + 1, 10)))
        count = len(arrays["von_mises"])
        self.assertEqual((len(arrays["Points"]), len(arrays["stress"])), (3 * count, 6 * count))
        left = [i for i in range(count) if abs(arrays["Points"][3 * i] - 0.2) < 1e-12 and arrays["node_body"][i] == 2]
        self.assertEqual(len(left), 25)
        for i in left:
            self.assertAlmostEqual(arrays["displacement"][3 * i], 1e-3, delta=1e-15)

    def test_contact_faces_have_the_values_of_the_pairs(self):
        self.solve(EXAMPLE / "model.yaml", "results")
        arrays = arrays_of(self.directory / "results" / "contact_0005.vtu")
        self.assertEqual(arrays["types"], (5,) * 8)  # 2 x 2 squares
        rows = [row for row in rows_of(self.directory / "results") if (row["step"], row["increment"]) == ("2", "4")]
        self.assertEqual(arrays["pressure"], tuple(float(row["pressure"]) for row in rows))
        self.assertEqual(arrays["state"], (2,) * 9)
        x, y = arrays["Points"][::3], arrays["Points"][1::3]
        self.assertEqual(sorted(round(value, 12) for value in x), sorted([0.2, 0.5, 0.8] * 3))
        p, force = arrays["pressure"], 0.0
        for k in range(0, len(arrays["connectivity"]), 3):
            i, j, m = arrays["connectivity"][k:k + 3]
            force += abs((x[j] - x[i]) * (y[m] - y[i]) - (x[m] - x[i]) * (y[j] - y[i])) / 6 * (p[i] + p[j] + p[m])
        self.assertAlmostEqual(force, CHECK["normal_force"], delta=TOLERANCE * CHECK["normal_force"])  # lumped areas are those of psi

    def test_pictures_are_drawn(self):
        self.solve(EXAMPLE / "model.yaml", "results")
        done = scabo("plot", self.directory / "results", "--view=20,-10", SCABO_PYTHON=sys.executable)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(sorted(file.name for file in self.directory.glob("*.png")), ["results.contact.png", "results.stress.png"])
        whole = (self.directory / "results.stress.png").read_bytes()
        done = scabo("plot", self.directory / "results", "--what", "stress", "--view=20,-10", "--cut", "0.5,0.5,0,1,1,0", SCABO_PYTHON=sys.executable)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertNotEqual((self.directory / "results.stress.png").read_bytes(), whole)
        for words, why in ((["--view", "1"], "--view 1: give two angles"), (["--cut", "0,0,1"], "--cut 0,0,1: give a point of the plane and its normal"),
                           (["--what", "stress", "--cut", "-9,0,0,-1,0,0"], "the plane cuts no body"), (["--window", "0,1,0,1"], "no meaning for bodies in space"),
                           (["--what", "mesh"], "there are pictures of stress, contact, lines and mechanism"), (["--what", "stress", "--component", "zx"], "there are von_mises")):
            done = scabo("plot", self.directory / "results", *words, SCABO_PYTHON=sys.executable)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn(why, done.stderr)

    def test_turned_and_in_millimetres_it_is_the_same(self):
        """x -> y, y -> z, z -> x; mm, N, MPa."""
        one = self.solve(EXAMPLE / "model.yaml", "one")
        blocks().write(self.directory, lambda x: (1e3 * x[2], 1e3 * x[0], 1e3 * x[1]))
        text = (EXAMPLE / "model.yaml").read_text(encoding="utf-8")
        for old, new in [("young: 210e9", "young: 210e3"), ("[1e-3, null, null]", "[null, 1, null]"), ("pressure: 1e6", "pressure: 1")]:
            self.assertEqual(text.count(old), 1)
            text = text.replace(old, new)
        model = self.directory / "turned.yaml"
        model.write_text(text, encoding="utf-8")
        other = self.solve(model, "other")
        N = CHECK["normal_force"]
        for a, b in zip(one, other, strict=True):
            for name in ("normal_force", "tangential_force"):
                x, y, z = a["contacts"]["joint"][name]
                self.assert_close([z, x, y], b["contacts"]["joint"][name], N)
        for a, b in zip(rows_of(self.directory / "one"), rows_of(self.directory / "other"), strict=True):
            x, y, z = vector(a, "shear")
            self.assertEqual(a["state"], b["state"])
            self.assert_close([z / 1e6, x / 1e6, y / 1e6], vector(b, "shear"), 1.0)
            self.assertAlmostEqual(float(a["pressure"]) / 1e6, float(b["pressure"]), delta=TOLERANCE)

    def model_of(self, mesh, base, block, places=lambda face: face):
        """The example with one mesh file: `base` and `block` are the entries of the bodies."""
        text = (EXAMPLE / "model.yaml").read_text(encoding="utf-8")
        text = text.replace("  base: {material: steel, mesh: {file: base.inp}}", base).replace("  block: {material: steel, mesh: {file: block.inp}}", block)
        self.assertNotIn(".inp", text)
        for face in ("BOTTOM", "LEFT", "TOP"):
            text = text.replace(f".{face}", f".{places(face)}")
        (self.directory / mesh[0]).write_text(mesh[1], encoding="utf-8")
        model = self.directory / "model.yaml"
        model.write_text(text, encoding="utf-8")
        return model

    def assert_same_pairs(self, one, other):
        for a, b in zip(rows_of(self.directory / one), rows_of(self.directory / other), strict=True):
            self.assertEqual(a["state"], b["state"])
            for name in ("pressure", "shear_x", "shear_y"):
                self.assertAlmostEqual(float(a[name]), float(b[name]), delta=1e-9 * 1e6)

    def test_meshes_of_gmsh_and_vtk_give_the_same(self):
        self.solve(EXAMPLE / "model.yaml", "one")
        mesh = MeshOfBlocks()
        for name, text in (("both.msh", mesh.msh_2()), ("both.msh", mesh.msh_4()), ("both.vtu", mesh.vtu())):
            with self.subTest(name=name):
                of_vtk = name.endswith("vtu")
                entries = [f"  {body}: {{material: steel, mesh: {{file: {name}, region: {region if of_vtk else body}}}}}"
                           for body, region in (("base", "region_1"), ("block", "region_2"))]
                model = self.model_of((name, text), *entries, (lambda face: f"boundary_{11 + mesh.names.index(face)}") if of_vtk else lambda face: face)
                self.solve(model, "other")
                self.assert_same_pairs("one", "other")

    def test_parts_of_one_file_are_bodies(self):
        self.solve(EXAMPLE / "model.yaml", "one")
        model = self.model_of(("both.msh", MeshOfBlocks().msh_2()), "  stone: {material: steel, mesh: {file: both.msh}}", "")
        done = scabo("check", model)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("there is no body named 'base'", done.stderr)
        model.write_text(model.read_text(encoding="utf-8").replace("base.", "stone_1.").replace("block.", "stone_2."), encoding="utf-8")
        done = scabo("check", model)
        self.assertIn("its cells have 2 parts that have no side in common, which become bodies of their own: stone_1 at (0.5, 0.5, -0.25), stone_2 at", done.stderr)
        self.solve(model, "other")
        self.assert_same_pairs("one", "other")

    def test_linear_tetrahedra_are_raised_to_quadratic_ones(self):
        self.solve(EXAMPLE / "model.yaml", "one")
        mesh = MeshOfBlocks(linear=True)
        entries = [f"  {body}: {{material: steel, mesh: {{file: both.msh, region: {body}}}}}" for body in ("base", "block")]
        self.solve(self.model_of(("both.msh", mesh.msh_2()), *entries), "other")
        self.assert_same_pairs("one", "other")

    def test_energy_is_in_balance(self):
        """Work of the pressure and of the support that moves: stored, or taken by friction. All pairs stay closed."""
        for of in self.solve(EXAMPLE / "model.yaml", "results"):
            energy = of["energy"]
            self.assertEqual(of["contacts"]["joint"]["open"], 0)
            self.assertAlmostEqual(energy["external"], energy["elastic"] + energy["friction"], delta=1e-9 * energy["external"])
        # Once it slides, friction takes mu N times the way of the block.
        increments = self.solve(EXAMPLE / "model.yaml", "more", "--set", "supports.1.displacement=[1e-2, null, null]")
        last, before = increments[-1], increments[-2]
        self.assertAlmostEqual(last["energy"]["friction"] - before["energy"]["friction"], 0.3 * CHECK["normal_force"] * 2.5e-3, delta=1e-6 * CHECK["normal_force"] * 2.5e-3)
        self.assertLess(last["energy"]["friction_error"], 0.05 * last["energy"]["friction"])

    def test_the_log_tells_the_course(self):
        self.solve(EXAMPLE / "model.yaml", "results")
        log = (self.directory / "results" / "log.txt").read_text(encoding="utf-8")
        self.assertIn("contact joint: block.BOTTOM on base.TOP; friction 0.3\n", log)
        self.assertRegex(log, r"step push, increment 4 of 4: press = 1, ground = 0, ram = 1; \d+ iterations?, certificate \S+\n")
        self.assertIn("Solved: every increment converged", log)
        self.assertIn("joint, tangential", log)

    def test_a_push_beyond_friction_is_no_solution(self):
        model = self.directory / "model.yaml"
        text = (EXAMPLE / "model.yaml").read_text(encoding="utf-8")
        text = "\n".join(line for line in text.split("\n") if "name: ram" not in line)
        text = text.replace("ram: 0", "shove: 0").replace("ram: 1", "shove: 1").replace("contacts:", "  shove: {on: block.LEFT, traction: [0.46e6, 0, 0]}\n\ncontacts:")
        for name in ("base.inp", "block.inp"):
            (self.directory / name).write_bytes((EXAMPLE / name).read_bytes())
        model.write_text(text, encoding="utf-8")
        done = scabo("run", model, "-o", self.directory / "results")
        self.assertEqual(done.returncode, 2, done.stderr)
        summary = summary_of(self.directory / "results")
        self.assertIn(summary["status"], ("mechanism", "collapse", "not_converged"))
        self.assertFalse(summary["increments"][-1]["converged"])
        self.assertEqual(summary["increments"][-1]["contacts"], {})
        done = scabo("resume", self.directory / "results")
        self.assertEqual(done.returncode, 1, done.stderr)

    def stopped(self, how, model, *settings):
        """A run of many increments that a signal ends after three of them."""
        results = self.directory / "results"
        shutil.rmtree(results, ignore_errors=True)
        process = subprocess.Popen([support.SCABO, "run", model, "-o", results, *settings],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lambda: process.poll() is None and process.kill())
        while process.poll() is None and not (results / "fields_0003.vtu").exists():
            time.sleep(0.01)
        process.send_signal(how)
        _, err = process.communicate(timeout=support.PATIENCE)
        return process.returncode, err

    def content(self, name):
        return {file.name: file.read_bytes() for file in sorted((self.directory / name).iterdir())}

    def test_a_signal_ends_the_run_and_it_is_resumed(self):
        settings = ["--set", "steps.1.increments=60", "--set", OUTPUT]
        self.solve(EXAMPLE / "model.yaml", "whole", *settings)
        for how, status in ((signal.SIGINT, 130), (signal.SIGKILL, -signal.SIGKILL)):
            with self.subTest(how=how):
                code, err = self.stopped(how, EXAMPLE / "model.yaml", *settings)
                self.assertEqual(code, status, err)
                summary = summary_of(self.directory / "results")
                self.assertGreaterEqual(len(summary["increments"]), 2)
                self.assertTrue(all(of["converged"] for of in summary["increments"]))
                if how == signal.SIGINT:
                    self.assertRegex(err, r"interrupted; .*: go on with `scabo resume ")
                    self.assertEqual((summary["status"], summary["reason"]), ("interrupted", "interrupted: the increments finished so far are kept"))
                for name in ("contact.csv", "log.txt", "fields.pvd", "points.csv", "history.csv"):
                    with open(self.directory / "results" / name, "ab") as file:
                        file.write(b"half a li")
                done = scabo("resume", self.directory / "results", "--quiet")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                whole = self.content("whole")
                resumed = self.content("results")
                self.assertEqual(sorted(resumed), sorted(whole))
                for name, data in whole.items():
                    self.assertEqual(resumed[name], data, name)
                done = scabo("resume", self.directory / "results")
                self.assertEqual(done.returncode, 1)
                self.assertIn("has ended with status `solved`", done.stderr)

    def test_what_has_changed_is_not_resumed(self):
        for name in ("base.inp", "block.inp", "model.yaml"):
            (self.directory / name).write_bytes((EXAMPLE / name).read_bytes())
        self.assertEqual(self.stopped(signal.SIGINT, self.directory / "model.yaml", "--set", "steps.1.increments=2000")[0], 130)
        checkpoint = self.directory / "results" / "checkpoint.state"
        kept = checkpoint.read_bytes()
        checkpoint.write_bytes(kept[:len(kept) // 2])
        done = scabo("resume", self.directory / "results")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("the checkpoint is damaged", done.stderr)
        checkpoint.write_bytes(kept)
        with open(self.directory / "block.inp", "a", encoding="utf-8") as file:
            file.write("** a remark\n")
        done = scabo("resume", self.directory / "results")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr, "block.inp: has changed since the run began")

    @unittest.skipIf(support.SANITIZED, "the address sanitizer reserves terabytes of address space")
    def test_what_cannot_fit_is_refused_before_it_starts(self):
        limit = 1_500_000 * 1024  # bytes
        done = subprocess.run([support.SCABO, "run", ROOT / "examples" / "35_ball_on_block" / "model.yaml", "-o", self.directory / "results", "--set",
                               "parameters.fine=3e-5"], capture_output=True, text=True, timeout=support.PATIENCE,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r"not enough memory: the analysis needs about .* GB, and `ulimit -v` leaves .*--ignore-memory")
        self.assertFalse((self.directory / "results").exists())
        done = subprocess.run([support.SCABO, "check", ROOT / "examples" / "35_ball_on_block" / "model.yaml", "--set", "parameters.fine=3e-5"],
                              capture_output=True, text=True, timeout=support.PATIENCE, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"warning: not enough memory: the analysis needs about .* GB, and `ulimit -v` leaves .*--ignore-memory")

    def test_events_tell_the_plan(self):
        done = scabo("run", EXAMPLE / "model.yaml", "-o", self.directory / "results", "--json-lines")
        events = [json.loads(line) for line in done.stdout.splitlines()]
        plan, = [event for event in events if event["event"] == "plan"]
        self.assertEqual((plan["bodies"], plan["finite_elements"], plan["increments"]), (2, 156, 5))
        self.assertEqual(events[-1]["exit_status"], 0)

    def test_a_second_run_replaces_the_results_of_the_first(self):
        for _ in range(2):
            self.solve(EXAMPLE / "model.yaml", "results")

    def test_an_overlap_that_supports_keep_is_not_solved(self):
        text = (EXAMPLE / "model.yaml").read_text(encoding="utf-8")
        for name in ("base", "block"):
            (self.directory / f"{name}.inp").write_bytes((EXAMPLE / f"{name}.inp").read_bytes())
        model = self.directory / "model.yaml"
        for up, status in ((1e-4, 0), (-1e-4, 2)):
            changed = text.replace("base.BOTTOM, fix: [x, y, z]", "base.TOP, fix: [x, y, z]").replace(
                "block.LEFT, displacement: [1e-3, null, null]", f"block.BOTTOM, displacement: [0, 0, {up}]").replace(
                "ram: 0", "ram: 1")
            model.write_text("\n".join(line for line in changed.split("\n") if "name: push" not in line), encoding="utf-8")
            done = scabo("run", model, "-o", self.directory / "results", "--quiet")
            self.assertEqual(done.returncode, status, done.stderr)
            if status == 0:
                for row in rows_of(self.directory / "results"):
                    self.assertAlmostEqual(float(row["gap"]), up, delta=1e-12)
            else:
                self.assertIn("keep an overlap by 0.0001", done.stderr)

    def test_a_folded_element_is_named(self):
        mesh = (EXAMPLE / "block.inp").read_text(encoding="utf-8").split("\n")
        element = mesh[mesh.index("*ELEMENT, TYPE=C3D10") + 1].split(", ")
        middle = element[5]
        at = mesh.index("*NODE") + int(middle)
        mesh[at] = f"{middle}, 9, 9, 9"
        (self.directory / "block.inp").write_text("\n".join(mesh), encoding="utf-8")
        (self.directory / "base.inp").write_bytes((EXAMPLE / "base.inp").read_bytes())
        model = self.directory / "model.yaml"
        model.write_bytes((EXAMPLE / "model.yaml").read_bytes())
        done = scabo("check", model)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stderr, r"model.yaml:\d+:\d+: bodies.block: element \d+ of its mesh file has a Jacobian of -[0-9.e-]+, which must be positive")

    @unittest.skipIf(support.SANITIZED, "memory")
    def test_predicted_memory(self):
        """What a run takes is what `scabo check` says, to 20 %: with many pairs, and with few."""
        text = (ROOT / "benchmarks" / "space" / "blocks.yaml").read_text(encoding="utf-8")
        model = self.directory / "model.yaml"
        for base, block in ((0.25, 0.08), (0.14, 0.3)):
            with self.subTest(base=base):
                model.write_text(text.replace("size: 0.1}", f"size: {base}}}").replace("size: 0.0365}", f"size: {block}}}"), encoding="utf-8")
                said, unit = re.search(r"about ([\d.]+) (MB|GB) of memory", scabo("check", model).stdout).groups()
                process = subprocess.Popen([support.SCABO, "run", model, "-q", "--threads", "1"])
                _, status, usage = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
                self.assertEqual(process.returncode, 0)
                taken = usage.ru_maxrss * 1024
                self.assertLess(abs(float(said) * {"MB": 1e6, "GB": 1e9}[unit] / taken - 1), 0.2, f"said {said} {unit}, taken {taken / 1e6:.0f} MB")

    def test_check_tells_the_sizes_and_other_commands_refuse(self):
        done = scabo("check", EXAMPLE / "model.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("No mistakes found", done.stdout)
        self.assertRegex(done.stdout, "2 bodies, .* degrees of freedom, 156 finite elements, .* contact pairs; about .* of memory, less than a second")
        done = scabo("exponents", EXAMPLE / "model.yaml")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("is a model in space", done.stderr)


if __name__ == "__main__":
    support.main()
