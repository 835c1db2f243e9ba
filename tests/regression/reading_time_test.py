"""The time of reading and checking a model file is proportional to its length, whatever there is much of."""
import resource
import unittest

import support
from support import scabo

HEAD = "scabo: 1\nmaterials:\n  m: {young: 1e9, poisson: 0.2}\n"
BODY = "bodies:\n  b: {material: m, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 0.5}}\n"
HELD = "supports: [{on: b.left, fix: [x, y]}]\n"
LOADED = "loads: {p: {on: b.right, pressure: 1}}\n"


def lines(count, text):
    return "".join(text.format(i=i, next=i + 1) for i in range(count))


def row_of_bodies(count):
    return HEAD + "bodies:\n" + lines(
        count, "  b{i}: {{material: m, shape: {{rectangle: {{corner: [{i}, 0], size: [1, 1]}}}}, mesh: {{size: 1}}}}\n") + \
        "supports:\n" + lines(count, "  - {{on: b{i}.bottom, fix: [x, y]}}\n") + "loads: {p: {on: b0.top, pressure: 1}}\n"


def tower(count):
    names = ", ".join(f"s{i}" for i in range(1, count))
    return HEAD + "bodies:\n  floor: {rigid: true, shape: {rectangle: {corner: [-1, -1], size: [3, 1]}}}\n" \
        "  b:\n    material: m\n    shape: {rectangle: {corner: [0, 0], size: [1, 1]}}\n    mesh: {size: 1}\n" \
        f"    repeat: {{count: {count}, step: [0, 1]}}\n    added: [null, {names}]\n" \
        "supports: [{on: floor, fix: [x, y]}]\nloads: {p: {on: b_1.right, pressure: 1}}\n" \
        "contacts: {j: {between: all, friction: 0.5}}\nsteps:\n" + lines(count, "  - {{name: s{i}, loads: {{p: 1}}}}\n")


MODELS = {
    "materials": lambda n: HEAD + lines(n, "  m{i}: {{young: 1e9, poisson: 0.2}}\n") + BODY + HELD + LOADED,
    "loads": lambda n: HEAD + BODY + HELD + "loads:\n" + lines(n, "  p{i}: {{on: b.right, pressure: 1}}\n"),
    "springs": lambda n: HEAD + BODY + LOADED + "springs:\n" + lines(n, "  - {{on: b.left, k_n: 1e6, k_t: 1e6}}\n"),
    "supports": lambda n: HEAD + BODY + LOADED + "supports:\n" + lines(n, "  - {{on: b.left, fix: [x, y], name: s{i}}}\n"),
    "steps": lambda n: HEAD + BODY + HELD + LOADED + "steps:\n" + lines(n, "  - {{name: s{i}, loads: {{p: {next}}}}}\n"),
    "steps of one curve": lambda n: HEAD + BODY + HELD + LOADED + "curves:\n  c:\n    table: [[0, 0], [%d, 1]]\n    over:\n" % n +
    lines(n, "      s{i}: 1\n") + "steps:\n" + lines(n, "  - {{name: s{i}, loads: {{p: c}}}}\n"),
    "points": lambda n: HEAD + BODY + HELD + LOADED + "output:\n  points:\n" + lines(n, "    - {{at: [0.5, 0.5], name: q{i}}}\n"),
    "history": lambda n: HEAD + BODY + HELD + LOADED + "output:\n  history:\n" + lines(n, "    h{i}: b.top_right.ux\n"),
    "unknown keys": lambda n: HEAD + BODY + HELD + LOADED + lines(n, "k{i}: 1\n"),
}
LARGE_PARTS = {
    "contacts": lambda n: row_of_bodies(n) + "contacts:\n" + lines(n - 1, "  c{i}: {{between: [b{i}.right, b{next}.left]}}\n"),
    "all contacts": lambda n: row_of_bodies(n) + "contacts: {c: {between: all}}\n",
    "stages": tower,
}


class Reading(support.InTemporaryDirectory):
    def processor_time(self, text):
        model = self.directory / "model.yaml"
        model.write_text(text)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        run = scabo("check", model)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertIn(run.returncode, (0, 1), run.stderr[-2000:])
        return after.ru_utime - before.ru_utime, run.stderr

    def check(self, models, count):
        # Eight times as much takes 8 times as long; 64 times where everything is compared with everything. Times of the
        # processor, of the two relative to each other: how busy the machine is does not matter.
        for name, model in models.items():
            with self.subTest(name):
                few, _ = self.processor_time(model(count))
                many, errors = self.processor_time(model(8 * count))
                if name != "unknown keys":
                    self.assertNotIn("mistake", errors)
                self.assertLess(many, 24 * max(few, 0.03), f"{many:.2f} s of {8 * count}, {few:.2f} s of {count}")

    def test_of_many_small_parts(self):
        self.check(MODELS, 5000)

    def test_of_many_bodies(self):
        self.check(LARGE_PARTS, 800)


if __name__ == "__main__":
    support.main()
