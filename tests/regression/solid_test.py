"""Models in space from the command line: examples/30_blocks_in_space, 35_ball_on_block and their twins."""
import importlib.util
import json
import math
import re
import resource
import signal
import struct
import subprocess
import sys
import time
import unittest

import support
from support import ROOT, certificate_of, rows_of, scabo, summary_of

EXAMPLE = ROOT / "examples" / "30_blocks_in_space"
CHECK = json.loads((EXAMPLE / "check.json").read_text(encoding="utf-8"))
TOLERANCE = CHECK["relative_tolerance"]


def blocks():
    sys.dont_write_bytecode = True
    spec = importlib.util.spec_from_file_location("blocks", EXAMPLE / "blocks.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def arrays_of(file):
    """Arrays of an uncompressed .vtu file by name; `node_body`: `body` of the points."""
    content = file.read_bytes()
    begin = content.index(b"<AppendedData")
    data = content.index(b"_", begin) + 1
    arrays = {}
    for kind, name, offset in re.findall(rb'<DataArray type="(\w+)" Name="(\w+)".*offset="(\d+)"', content[:begin]):
        at = data + int(offset)
        size, = struct.unpack_from("<Q", content, at)
        letter, width = {b"Float64": ("d", 8), b"Float32": ("f", 4), b"Int32": ("i", 4), b"UInt8": ("B", 1)}[kind]
        key = "node_body" if name == b"body" and "node_body" not in arrays else name.decode()
        arrays[key] = struct.unpack_from(f"<{size // width}{letter}", content, at + 8)
    return arrays


def vector(row, name):
    return [float(row[f"{name}_{axis}"]) for axis in "xyz"]


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
        for words, why in ((["--view", "1"], "--view 1: give two angles"), (["--window", "0,1,0,1"], "no meaning for bodies in space"),
                           (["--what", "mesh"], "there are pictures of stress and contact"), (["--what", "stress", "--component", "zx"], "there are von_mises")):
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

    def test_a_signal_ends_the_run_and_keeps_what_was_finished(self):
        results = self.directory / "results"
        process = subprocess.Popen([support.SCABO, "run", EXAMPLE / "model.yaml", "-o", results, "--set", "steps.1.increments=20000"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lambda: process.poll() is None and process.kill())
        while process.poll() is None and not (results / "fields_0003.vtu").exists():
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=support.PATIENCE)
        self.assertEqual(process.returncode, 130, err)
        self.assertIn("interrupted", err)
        summary = summary_of(results)
        self.assertEqual((summary["status"], summary["reason"]), ("failed", "interrupted"))
        self.assertGreaterEqual(len(summary["increments"]), 3)
        self.assertTrue(all(of["converged"] for of in summary["increments"]))

    @unittest.skipIf(support.SANITIZED, "the address sanitizer reserves terabytes of address space")
    def test_what_cannot_fit_is_refused_before_it_starts(self):
        limit = 1_500_000 * 1024  # bytes
        done = subprocess.run([support.SCABO, "run", ROOT / "examples" / "35_ball_on_block" / "model.yaml", "-o", self.directory / "results", "--set",
                               "parameters.fine=3e-5"], capture_output=True, text=True, timeout=support.PATIENCE,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r"not enough memory: the analysis needs about .* GB, and `ulimit -v` leaves .*--ignore-memory")
        self.assertFalse((self.directory / "results").exists())

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
        self.assertRegex(done.stderr, r"model.yaml:\d+:\d+: bodies.block: element \d+ of its mesh file is folded")

    def test_check_tells_the_sizes_and_other_commands_refuse(self):
        done = scabo("check", EXAMPLE / "model.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("No mistakes found", done.stdout)
        self.assertRegex(done.stdout, "2 bodies, .* degrees of freedom, 156 finite elements, .* contact pairs; about .* of memory, less than a second")
        for words in (["exponents", EXAMPLE / "model.yaml"], ["sweep", EXAMPLE / "model.yaml", "--vary", "contacts.joint.friction=0.1,0.2", "-o", self.directory / "sweep"]):
            done = scabo(*words)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("is a model in space", done.stderr)


class BallOnBlock(support.InTemporaryDirectory):
    """Hertz: pressure, force and radius of the contact of a ball and a half space."""
    example = ROOT / "examples" / "35_ball_on_block"

    def test_pressure_and_radius_are_those_of_hertz(self):
        check = json.loads((self.example / "check.json").read_text(encoding="utf-8"))
        done = scabo("run", self.example / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        increment, = summary_of(self.directory / "results")["increments"]
        self.assertLessEqual(certificate_of(increment), 1e-10)
        force = check["normal_force"]
        self.assertAlmostEqual(increment["contacts"]["joint"]["normal_force"][2], force, delta=1e-3 * force)
        self.assertAlmostEqual(increment["reactions"]["ground"][2], increment["contacts"]["joint"]["normal_force"][2], delta=1e-3 * force)
        tolerance, p0, a = check["relative_tolerance"], check["largest_pressure"], check["contact_radius"]
        self.assertAlmostEqual(increment["contacts"]["joint"]["max_pressure"], p0, delta=tolerance * p0)
        rows = rows_of(self.directory / "results")
        closed = sum(float(row["area"]) for row in rows if row["state"] != "open")
        self.assertAlmostEqual(math.sqrt(4 * closed / math.pi), a, delta=tolerance * a)
        inner = [row for row in rows if math.hypot(float(row["x"]), float(row["y"])) < 0.6 * a]
        self.assertGreater(len(inner), 5)
        for row in inner:
            r = math.hypot(float(row["x"]), float(row["y"]))
            self.assertAlmostEqual(float(row["pressure"]), p0 * math.sqrt(1 - (r / a) ** 2), delta=0.08 * p0)


class Shapes(support.InTemporaryDirectory):
    def test_a_bush_under_pressure_in_a_ring_has_the_stress_of_lame(self):
        """Both of one material without a gap, kept from moving along the axis: together they are one thick tube, and the pressure between them is
        that of Lame at their radius, if gaps are seen to a hundredth of the displacements, which are 2e-5 of it."""
        text = """scabo: 1
analysis: {space: true}
materials: {steel: {young: 200e3, poisson: 0.3}}
bodies:
  ring: {material: steel, shape: {tube: {from: [0, 0, 0], to: [0, 0, 0.4], inner: 1.5, outer: 2}}, mesh: {size: 0.3}}
  bush: {material: steel, shape: {tube: {from: [0, 0, 0], to: [0, 0, 0.4], inner: 1, outer: 1.5}}, mesh: {size: 0.25}}
supports:
  - {on: ring.bottom, fix: z}
  - {on: ring.top, fix: z}
  - {on: bush.bottom, fix: z}
  - {on: bush.top, fix: z}
loads:
  oil: {on: bush.inside, pressure: 10}
  water: {on: ring.outside, pressure: 1}
contacts:
  joint: {between: [ring.inside, bush.outside], friction: 0.2}
"""
        (self.directory / "model.yaml").write_text(text, encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = rows_of(self.directory / "results")
        expected = 1 + 9 * (1 / 1.5**2 - 1 / 4) / (1 - 1 / 4)  # p(r) = p_b + (p_a - p_b) (a2 / r2 - a2 / b2) / (1 - a2 / b2)
        area = sum(float(row["area"]) for row in rows)
        mean = sum(float(row["normal_force"]) for row in rows) / area
        self.assertAlmostEqual(mean, expected, delta=1e-3 * expected)
        self.assertAlmostEqual(area, 2 * math.pi * 1.5 * 0.4, delta=0.02 * area)

    def test_too_many_nodes_are_refused_before_they_are_made(self):
        text = (EXAMPLE.parent / "35_ball_on_block" / "model.yaml").read_text(encoding="utf-8")
        (self.directory / "model.yaml").write_text(text, encoding="utf-8")
        done = scabo("check", self.directory / "model.yaml", "--set", "parameters.fine=1e-9")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stderr, r"bodies.block: its mesh would have .* nodes, and at most 4e\+06 are possible")


if __name__ == "__main__":
    support.main()
