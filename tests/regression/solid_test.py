"""Models in space from the command line: examples/30_blocks_in_space and its twins."""
import importlib.util
import json
import math
import re
import struct
import sys

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
        self.assertEqual([(of["step"], of["increment"]) for of in increments], [("press", 1)] + [("push", k) for k in (1, 2, 3, 4)])
        N, T = CHECK["normal_force"], CHECK["tangential_force"]
        for of in increments:
            self.assert_close(of["contacts"]["joint"]["normal_force"], [0, 0, N], N)
            self.assert_close([sum(f) for f in zip(*of["reactions"].values())], [0, 0, N], N)
            self.assertLessEqual(certificate_of(of), 1e-10)
        last = increments[-1]
        self.assertEqual((last["contacts"]["joint"]["open"], last["contacts"]["joint"]["stick"]), (0, 0))
        self.assert_close(last["contacts"]["joint"]["tangential_force"], [-T, 0, 0], N)
        rows = [row for row in rows_of(self.directory / "results") if (row["step"], row["increment"]) == ("push", "4")]
        area = sum(float(row["area"]) for row in rows)
        self.assertAlmostEqual(area, 0.36, delta=1e-12)
        self.assertAlmostEqual(sum(float(row["pressure"]) * float(row["area"]) for row in rows), N, delta=TOLERANCE * N)
        for row in rows:
            self.assertEqual(row["state"], "slip")
            self.assertAlmostEqual(math.hypot(*vector(row, "shear")), 0.3 * float(row["pressure"]), delta=1e-9 * N / 0.36)

    def test_fields_are_quadratic_tetrahedra_with_displacements(self):
        self.solve(EXAMPLE / "model.yaml", "results")
        files = sorted(file.name for file in (self.directory / "results").glob("*.vtu"))
        self.assertEqual(files, [f"fields_{k:04d}.vtu" for k in range(1, 6)])
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
        for words in (["exponents", EXAMPLE / "model.yaml"], ["sweep", EXAMPLE / "model.yaml", "--vary", "contacts.joint.friction=0.1,0.2", "-o", self.directory / "sweep"]):
            done = scabo(*words)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("is a model in space", done.stderr)


if __name__ == "__main__":
    support.main()
