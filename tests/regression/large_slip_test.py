"""Large slip: a block dragged over ten elements of a foundation, a press fit pushed out, resuming and restarting (ironing: example
22)."""
import math
import shutil
import signal
import subprocess
import time
import unittest

import support
from support import certificate_of, rows_of, scabo, summary_of

SIZE = 0.25       # m, of the elements: ten of them are 2.5 m
WEIGHT = 10e6     # N
FRICTION = 0.3


def text_of(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {text_of(part)}" for key, part in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(text_of(part) for part in value) + "]"
    if isinstance(value, bool) or value is None:
        return {True: "true", False: "false", None: "null"}[value]
    return repr(value) if isinstance(value, float) else str(value)


def model_of(sections):
    """A model file with a line for each section."""
    return "".join(f"{name}: {text_of(value)}\n" for name, value in sections.items())


def turned(point, angle, scale):
    c, s = math.cos(angle), math.sin(angle)
    return [scale * (c * point[0] - s * point[1]), scale * (s * point[0] + c * point[1])]


def rectangle(low, high, angle, scale):
    """A polygon whose edges are bottom, right, top and left."""
    corners = [low, [high[0], low[1]], high, [low[0], high[1]]]
    return {"polygon": {"vertices": [turned(x, angle, scale) for x in corners],
                        "names": {"bottom": "edge_1", "right": "edge_2", "top": "edge_3", "left": "edge_4"}}}


def block(angle=0.0, scale=1.0, friction=FRICTION, slip="large", increments=25, drags=(2.5,), mesh=None, swapped=False, ground=6.0,
          rigid=False):
    """A block of 1 m on a foundation; `scale`: 1000 in mm, N and MPa."""
    mesh = {"size": SIZE * scale, **(mesh or {})}
    foundation = {"shape": rectangle([0, -1], [ground, 0], angle, scale)}
    foundation |= {"rigid": True} if rigid else {"material": "steel", "mesh": mesh}
    between = ["block.bottom", "ground.top"] if swapped else ["ground.top", "block.bottom"]
    down = turned([0, -WEIGHT / scale**2], angle, 1.0)
    steps = [{"name": "press", "loads": {"weight": 1, "drag": 0}}]
    for number, drag in enumerate(drags):
        steps.append({"name": f"drag_{number + 1}", "increments": increments, "loads": {"weight": 1, "drag": drag}})
    return model_of({
        "scabo": 1, "analysis": {"thickness": scale},
        "materials": {"steel": {"young": 210e9 / scale**2, "poisson": 0.3}},
        "bodies": {"ground": foundation,
                   "block": {"material": "steel", "mesh": mesh, "shape": rectangle([1, 0], [2, 0.5], angle, scale)}},
        "supports": [{"on": "ground" if rigid else "ground.bottom", "fix": ["x", "y"]},
                     {"name": "drag", "on": "block.left",
                      "displacement": {"along": [math.cos(angle), math.sin(angle)], "value": scale}}],
        "loads": {"weight": {"on": "block.top", "traction": down}},
        "contacts": {"joint": {"between": between, "friction": friction, "slip": slip}},
        "steps": steps,
        "output": {"history": {"shear": "joint.tangential_force", "work": "friction_energy"}}})


class LargeSlipRuns(support.InTemporaryDirectory):
    def solve(self, text, *settings, name="model", warned=False):
        path = self.directory / f"{name}.yaml"
        path.write_text(text, encoding="utf-8")
        run = scabo("run", path, "--quiet", *(word for setting in settings for word in ("--set", setting)))
        self.assertEqual(run.returncode, 0, run.stderr)
        if not warned:
            self.assertEqual(run.stderr, "")
        increments = summary_of(self.directory / f"{name}.results")["increments"]
        for increment in increments:
            self.assertLessEqual(certificate_of(increment), 1e-10)
        return increments


class LargeSlip(LargeSlipRuns):
    def sliding(self, increments, drag=0.3):
        """Those in which the whole block slides, and how far it has been dragged."""
        return [(increment, increment["factors"]["drag"]) for increment in increments
                if increment["step"] == 2 and increment["factors"]["drag"] >= drag]

    def check_drag(self, increments, scale=1.0, friction=FRICTION):
        slid = self.sliding(increments)
        self.assertGreaterEqual(len(slid), 20)
        for increment, _ in slid:
            joint = increment["contacts"]["joint"]
            self.assertAlmostEqual(joint["normal_force"] / WEIGHT, 1, delta=1e-9)
            self.assertAlmostEqual(joint["tangential_force"] / WEIGHT, -friction, delta=1e-3 * friction)
        found = [increment["pairs_found_anew"] for increment in increments]
        self.assertGreaterEqual(sum(one["times"] for one in found), 10)  # after every 0.2 m, or less where increments are
        self.assertLessEqual(max(one["jump"] for one in found), 1e-2)
        (first, begin), (last, end) = slid[0], slid[-1]
        work = last["energy"]["friction"] - first["energy"]["friction"]
        self.assertAlmostEqual(work / (friction * WEIGHT * (end - begin) * scale), 1, delta=1e-3)
        return [increment["contacts"]["joint"]["tangential_force"] for increment in increments]

    def test_a_block_is_dragged_over_ten_elements(self):
        straight = self.check_drag(self.solve(block()))
        # The pairs go with the block, and it has gone 2.5 m.
        last = [row for row in rows_of(self.directory / "model.results") if row["increment"] == "25"]
        self.assertAlmostEqual(min(float(row["x"]) for row in last), 3.5, delta=0.5 * SIZE)
        self.assertAlmostEqual(max(float(row["x"]) for row in last), 4.5, delta=0.5 * SIZE)
        for row in last:
            self.assertAlmostEqual(float(row["slip"]), 2.5, delta=1e-3)
        # Turned and in mm, with the sides swapped.
        self.check_drag(self.solve(block(angle=math.radians(30), scale=1e3)), scale=1e3)
        self.check_drag(self.solve(block(swapped=True)))

    def test_on_other_meshes_and_on_a_rigid_foundation(self):
        for mesh in ({"kind": "quadtree"}, {"kind": "polygons"}, {"kind": "fem"}):
            with self.subTest(mesh=mesh):
                self.check_drag(self.solve(block(mesh=mesh)))
        self.check_drag(self.solve(block(rigid=True)))

    def test_to_and_fro(self):
        increments = self.solve(block(drags=(1.0, -0.5), increments=16))
        there = [increment for increment in increments if increment["step"] == 2][-1]
        begun, *_, back = [increment for increment in increments if increment["step"] == 3]
        self.assertAlmostEqual(there["contacts"]["joint"]["tangential_force"] / WEIGHT, -FRICTION, delta=3e-4)
        self.assertAlmostEqual(back["contacts"]["joint"]["tangential_force"] / WEIGHT, FRICTION, delta=3e-4)
        # After the increment in which slip reverses, of which docs/results.md says that it counts too little.
        work = back["energy"]["friction"] - begun["energy"]["friction"]
        self.assertAlmostEqual(work / (FRICTION * WEIGHT * (begun["factors"]["drag"] - back["factors"]["drag"])), 1, delta=1e-3)

    def test_without_friction_nothing_drags(self):
        for increment in self.solve(block(friction=0, drags=(1.0,), increments=8)):
            joint = increment["contacts"]["joint"]
            self.assertEqual(joint["tangential_force"], 0.0)
            self.assertAlmostEqual(joint["normal_force"] / WEIGHT, 1, delta=1e-9)

    def test_small_slip_is_as_without_the_key(self):
        with_key = self.solve(block(drags=(2e-4,), increments=5), name="with")
        without = self.solve(block(drags=(2e-4,), increments=5, slip="small"), name="without")
        self.assertEqual([one["contacts"] for one in with_key], [one["contacts"] for one in without])
        self.assertEqual([one["energy"] for one in with_key], [one["energy"] for one in without])
        self.assertEqual(sum(one["pairs_found_anew"]["times"] for one in with_key), 0)

    def test_a_spring_stops_it_where_forces_balance(self):
        """Pushed by F beyond mu N, it slides by (F - mu N) / k, to the size of elastic deformations."""
        text = block(increments=8, drags=(6e6,))
        text = text.replace(", {name: drag, on: block.left, displacement: {along: [1.0, 0.0], value: 1.0}}", "")
        text = text.replace("loads: {weight: {", "springs: [{on: block.bottom_left, k_x: 1e6, k_y: 0}]\n"
                            "loads: {drag: {on: block.left, force: [1, 0]}, weight: {")
        text = text.replace("left: edge_4", "left: edge_4, bottom_left: vertex_1")
        increments = self.solve(text)
        self.assertLess(increments[-1]["springs"]["block.bottom_left"][0], -2.9e6)
        for increment in increments:
            pushed = increment["factors"]["drag"]
            if pushed > FRICTION * WEIGHT:
                self.assertAlmostEqual(-increment["springs"]["block.bottom_left"][0], pushed - FRICTION * WEIGHT, delta=10)
                self.assertAlmostEqual(increment["contacts"]["joint"]["tangential_force"] / WEIGHT, -FRICTION, delta=1e-6)

    def test_long_increments_are_divided(self):
        """One increment of ten elements: attempts that go too far are made in parts."""
        last = self.solve(block(increments=1))[-1]
        self.assertAlmostEqual(last["contacts"]["joint"]["tangential_force"] / WEIGHT, -FRICTION, delta=3e-4)
        self.assertGreaterEqual(last["pairs_found_anew"]["times"], 15)

    def test_off_the_end_of_the_foundation(self):
        path = self.directory / "model.yaml"
        path.write_text(block(ground=2.5, drags=(0.875,), increments=7), encoding="utf-8")
        run = scabo("run", path, "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        summary = summary_of(self.directory / "model.results")
        self.assertEqual(sum("slide off" in warning for warning in summary["warnings"]), 1)
        rows = [row for row in rows_of(self.directory / "model.results") if row["step"] == "2" and row["increment"] == "7"]
        self.assertLessEqual(max(float(row["x"]) for row in rows), 2.5 + 1e-3)  # the foundation gives way a little


# Half of a bar that is pressed together with a jaw and pushed out of it, as in example 23. m, N, Pa.
HALF, JAW, OVERLAP, YOUNG, POISSON, INTERFERENCE = 10e-3, 10e-3, 100e-3, 210e9, 0.3, 10e-6
GRIP = 0.15
SLID = 80e-6           # by which one end moves until all of the bar slides


def press_fit(way=60e-3, increments=6, pulled=True, drawn_at=0.0, angle=0.0, scale=1.0, swapped=False, mesh=None, length=OVERLAP,
              slip="large", sign=-1.0):
    """Overlapping by 100 mm less `drawn_at`; `scale`: 1000 in mm, N and MPa."""
    mesh = {"size": 10e-3 * scale, "order": 2, **(mesh or {})}
    along, across = turned([1, 0], angle, 1.0), turned([0, 1], angle, 1.0)
    bar = rectangle([drawn_at, 0], [drawn_at + length, HALF], angle, scale)
    jaw = rectangle([0, HALF], [OVERLAP, HALF + JAW], angle, scale)
    between = ["jaw.bottom", "bar.top"] if swapped else ["bar.top", "jaw.bottom"]
    return model_of({
        "scabo": 1, "analysis": {"plane": "stress", "thickness": 40e-3 * scale},
        "materials": {"steel": {"young": YOUNG / scale**2, "poisson": POISSON}},
        "bodies": {"bar": {"material": "steel", "mesh": mesh, "shape": bar}, "jaw": {"material": "steel", "mesh": mesh, "shape": jaw}},
        "supports": [{"on": "bar.bottom", "fix": "normal"}, {"on": "jaw.top", "fix": "normal"}, {"on": "jaw.right", "fix": "normal"},
                     {"name": "push", "on": "bar.right" if pulled else "bar.left",
                      "displacement": {"along": along, "value": way * scale}}],
        "contacts": {"fit": {"between": between, "friction": GRIP, "gap": sign * INTERFERENCE * scale, "fit_in": "press", "slip": slip}},
        "steps": [{"name": "press", "friction": {"fit": 0}, "loads": {"push": 0}}, {"name": "grip", "friction": {"fit": GRIP}},
                  {"name": "slide", "increments": 2, "loads": {"push": SLID / way}},
                  {"name": "push", "increments": increments, "loads": {"push": 1}}],
        "output": {"fields": []}})


def force_of_fit(overlap, pulled):
    """Of one half, by hand: examples/23_push_out/hand.py, where it is derived."""
    pressure = YOUNG * INTERFERENCE / (HALF + JAW - (0 if pulled else POISSON * GRIP * overlap))
    return GRIP * pressure * overlap * 40e-3


class PressFit(LargeSlipRuns):
    def forces(self, increments):
        """Of the contact in the last step, with the overlap of its pairs."""
        self.assertEqual([one["step"] for one in increments[:4]], [1, 2, 3, 3])
        for one in increments[4:]:
            fit = one["contacts"]["fit"]
            if fit["normal_force"] > 0:
                self.assertAlmostEqual(abs(fit["tangential_force"]) / fit["normal_force"], GRIP, delta=1e-9)
        return [abs(one["contacts"]["fit"]["tangential_force"]) for one in increments[4:]]

    def test_force_falls_with_the_overlap(self):
        for pulled in (True, False):
            with self.subTest(pulled=pulled):
                increments = self.solve(press_fit(pulled=pulled, increments=12, mesh={"size": 5e-3}), warned=True)
                area = OVERLAP * 40e-3
                pressed = YOUNG * INTERFERENCE / (HALF + JAW) * area
                self.assertAlmostEqual(increments[0]["contacts"]["fit"]["normal_force"] / pressed, 1, delta=1e-9)
                # With the whole overlap all of it is uniform, and the closed form exact.
                slid = abs(increments[3]["contacts"]["fit"]["tangential_force"])
                self.assertAlmostEqual(slid / force_of_fit(OVERLAP, pulled), 1, delta=2e-4)
                # Then stress spreads into what sticks out, which is the same at any overlap: it is one of a little more length.
                forces = self.forces(increments)
                more = [self.length_of(force, pulled) - (OVERLAP - (k + 1) * 5e-3) for k, force in enumerate(forces)]
                self.assertTrue(0.9e-3 < min(more) and max(more) < 1.7e-3, more)
                # Work: of the forces along the way; what is stored in the bar and not lost with the overlap is the rest.
                friction = [one["energy"]["friction"] for one in increments[4:]]
                for k in range(11):
                    by_hand = (forces[k] + forces[k + 1]) / 2 * 5e-3
                    self.assertAlmostEqual((friction[k + 1] - friction[k]) / by_hand, 1, delta=3e-3)
                first, last = increments[3]["energy"], increments[-1]["energy"]
                self.assertAlmostEqual((last["external"] - first["external"]) / (last["friction"] - first["friction"]), 1, delta=2e-3)
                self.assertLess(last["elastic"], 0.55 * first["elastic"])

    def length_of(self, force, pulled):
        """Overlap that has this force by hand."""
        low, high = 0.0, 2 * OVERLAP
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if force_of_fit(middle, pulled) < force else (low, middle)
        return low

    def test_it_is_as_if_pressed_where_it_has_been_pushed_to(self):
        """Once all slides, the way there does not matter: the same bar drawn at 40 mm, without large slip."""
        for pulled in (True, False):
            fine = {"pulled": pulled, "mesh": {"size": 5e-3}}
            pushed = self.forces(self.solve(press_fit(way=40e-3, increments=4, **fine), warned=True))[-1]
            drawn = self.solve(press_fit(way=0.2e-3, increments=1, drawn_at=40e-3, slip="small", **fine), name="drawn")[-1]
            self.assertAlmostEqual(pushed / abs(drawn["contacts"]["fit"]["tangential_force"]), 1, delta=1e-3)  # 0.04 mm of stretch

    def test_twins(self):
        plain = self.forces(self.solve(press_fit(increments=3), warned=True))
        for other, tolerance in (({"angle": math.radians(30), "scale": 1e3}, 1e-8), ({"swapped": True}, 1e-9),
                                 ({"mesh": {"kind": "quadtree"}}, 1e-2), ({"mesh": {"kind": "fem"}}, 1e-2)):
            with self.subTest(other=other):
                for one, twin in zip(plain, self.forces(self.solve(press_fit(increments=3, **other), warned=True)), strict=True):
                    self.assertAlmostEqual(twin / one, 1, delta=tolerance)

    def test_pushed_in_again_and_right_through(self):
        """The overlap grows as it fell; beyond the jaw nothing is left."""
        text = press_fit(way=40e-3, increments=4)
        text = text.replace("increments: 4, loads: {push: 1}}]", "increments: 4, loads: {push: 1}}, "
                            "{name: back, increments: 4, loads: {push: 0}}]")
        back = self.forces(self.solve(text, warned=True))
        for there, here in zip(back[:3], reversed(back[4:-1])):
            self.assertAlmostEqual(here / there, 1, delta=0.03)  # jaw and bar are pulled the other way: see pushed and pulled
        increments = self.solve(press_fit(way=120e-3, increments=12), warned=True)
        self.assertEqual([one["contacts"]["fit"]["normal_force"] for one in increments[-2:]], [0.0, 0.0])
        self.assertLess(increments[-1]["energy"]["elastic"], 1e-9 * increments[0]["energy"]["elastic"])


class Resume(support.InTemporaryDirectory):
    def files(self, name):
        wanted = {}
        for path in sorted((self.directory / f"{name}.results").iterdir()):
            if path.suffix in (".csv", ".vtu", ".pvd"):
                wanted[path.name] = path.read_bytes()
        return wanted

    def test_a_killed_run_gives_the_same_bits(self):
        self.kill(block(increments=100), 101)

    def test_so_does_one_of_a_press_fit(self):
        self.kill(press_fit(increments=40), 44)

    def kill(self, text, increments):
        path = self.directory / "model.yaml"
        path.write_text(text, encoding="utf-8")
        whole = scabo("run", path, "--quiet", "-o", self.directory / "whole.results")
        self.assertEqual(whole.returncode, 0, whole.stderr)
        killed = self.directory / "killed.results"
        for part in (0.3, 0.7):
            shutil.rmtree(killed, ignore_errors=True)
            process = subprocess.Popen([support.SCABO, "run", str(path), "--quiet", "-o", str(killed)],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            begin = time.monotonic()
            while process.poll() is None and time.monotonic() - begin < support.PATIENCE:
                table = killed / "contact.csv"
                rows = table.read_text(encoding="utf-8").splitlines() if table.exists() else []
                done = {tuple(row.split(",")[:2]) for row in rows[1:]}
                if len(done) >= part * increments:
                    break
                time.sleep(0.002)
            process.send_signal(signal.SIGKILL)
            process.wait()
            resumed = scabo("resume", killed, "--quiet")
            self.assertIn(resumed.returncode, (0, 1), resumed.stderr)
            if resumed.returncode == 0:  # else it had ended before the signal
                self.assertEqual(self.files("killed"), self.files("whole"))


class Restart(LargeSlipRuns):
    """Two runs, the second one from the end of the first one, are one run with the steps of both."""

    def check(self, first, second, whole):
        self.solve(first, name="one", warned=True)
        rest = self.solve("restart: one.results\n" + second, name="two", warned=True)
        of_whole = self.solve(whole, name="whole", warned=True)[-len(rest):]
        for one, other in zip(of_whole, rest, strict=True):
            self.assertEqual(one["pairs_found_anew"]["times"], other["pairs_found_anew"]["times"])
            self.assertEqual(one["contacts"], other["contacts"])
            self.assertEqual(one["energy"], other["energy"])
            self.assertEqual(one["reactions"], other["reactions"])
        self.assertGreater(sum(one["pairs_found_anew"]["times"] for one in rest), 3)

    def test_of_a_block(self):
        step = "{name: drag_2, increments: 8, loads: {weight: 1, drag: 2.0}}"
        first, whole = block(increments=8, drags=(1.0,)), block(increments=8, drags=(1.0, 2.0))
        self.assertIn(step, whole)
        press = "{name: press, loads: {weight: 1, drag: 0}}, {name: drag_1, increments: 8, loads: {weight: 1, drag: 1.0}}, "
        second = whole.replace(press, "")
        self.assertNotEqual(second, whole)
        self.check(first, second, whole)
        # The sides are elsewhere: without large slip there is no going on.
        path = self.directory / "small.yaml"
        path.write_text("restart: one.results\n" + second.replace("slip: large", "slip: small"), encoding="utf-8")
        run = scabo("run", path, "--quiet")
        self.assertEqual(run.returncode, 1)
        self.assertIn("small.yaml:1:10: restart: the sides of contact 'joint' have passed each other in", run.stderr)

    def test_of_a_press_fit(self):
        whole = press_fit(increments=4).replace("loads: {push: 1}}]", "loads: {push: 0.5}}, {name: more, increments: 4, loads: {push: 1}}]")
        first = whole.replace(", {name: more, increments: 4, loads: {push: 1}}", "")
        begin = whole.index("steps: [") + len("steps: [")
        second = whole[:begin] + whole[whole.index("{name: more"):]
        self.check(first, second.replace("fit_in: press, ", ""), whole)


if __name__ == "__main__":
    support.main()
