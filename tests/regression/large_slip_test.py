"""Large slip: a block dragged over ten elements of a foundation, resuming and restarting (press fits: press_fit_test.py; ironing:
example 22)."""
import math
import shutil
import signal
import subprocess
import time

import support
from support import SANITIZED, certificate_of, rows_of, scabo, summary_of

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
        # Its points have slipped by that, less what friction compresses the block by: 3 MN / (E 0.5 m) = 29 um at its end.
        for row in last:
            self.assertAlmostEqual(float(row["slip"]), 2.5, delta=4e-5)
        for row in last:
            self.assertAlmostEqual(float(row["slip"]), 2.5, delta=1e-3)
        # Turned and in mm, with the sides swapped.
        self.check_drag(self.solve(block(angle=math.radians(30), scale=1e3)), scale=1e3)
        self.check_drag(self.solve(block(swapped=True)))

    def test_on_other_meshes_and_on_a_rigid_foundation(self):
        for mesh in ({"kind": "quadtree"}, {"kind": "polygons"}, {"kind": "fem"}):
            with self.subTest(mesh=mesh):
                self.check_drag(self.solve(block(mesh=mesh)))
        # The drag and friction hold the same corner of the block: how much each takes while nothing slips is open.
        self.check_drag(self.solve(block(rigid=True), warned=True))

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

    def test_what_rides_along_on_small_slip(self):
        """A block that a soft spring k holds to the ground rides, stuck, on the one that is dragged: of the two contacts only
        that below has large slip. The spring pulls with k times the way, and the pairs above have not slipped."""
        stiffness, way = 2e5, 0.5
        text = model_of({
            "scabo": 1, "materials": {"steel": {"young": 210e9, "poisson": 0.3}},
            "bodies": {name: {"material": "steel", "mesh": {"size": SIZE}, "shape": rectangle(low, high, 0.0, 1.0)}
                       for name, low, high in (("ground", [0, -1], [4, 0]), ("block", [1, 0], [2, 0.5]), ("rider", [1, 0.5], [2, 0.75]))},
            "supports": [{"on": "ground.bottom", "fix": ["x", "y"]},
                         {"name": "drag", "on": "block.left", "displacement": [1.0, None]}],
            "springs": [{"name": "tether", "on": "rider.vertex_4", "k_x": stiffness, "k_y": 0}],
            "loads": {"weight": {"on": "rider.top", "traction": [0, -WEIGHT]}},
            "contacts": {"joint": {"between": ["ground.top", "block.bottom"], "friction": FRICTION, "slip": "large"},
                         "seat": {"between": ["block.top", "rider.bottom"], "friction": 0.5}},
            "steps": [{"loads": {"weight": 1, "drag": 0}}, {"increments": 4, "loads": {"weight": 1, "drag": way}}]})
        increments = self.solve(text)
        self.assertGreaterEqual(sum(one["pairs_found_anew"]["times"] for one in increments), 3)
        for increment in increments[1:]:
            pull = stiffness * increment["factors"]["drag"]
            self.assertAlmostEqual(increment["springs"]["tether"][0] / pull, -1, delta=1e-3)
            self.assertAlmostEqual(increment["contacts"]["seat"]["tangential_force"] / pull, 1, delta=1e-3)
            self.assertEqual(increment["contacts"]["seat"]["slip"], 0)

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


class ResumeRuns(support.InTemporaryDirectory):
    def files(self, name):
        wanted = {}
        for path in sorted((self.directory / f"{name}.results").iterdir()):
            if path.suffix in (".csv", ".vtu", ".pvd"):
                wanted[path.name] = path.read_bytes()
        return wanted

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


class Resume(ResumeRuns):
    def test_a_killed_run_gives_the_same_bits(self):
        increments = 30 if SANITIZED else 100
        self.kill(block(increments=increments), increments + 1)


class RestartRuns(LargeSlipRuns):
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
        ends = []  # slip and displacements count from the start of the first run
        for name in ("whole", "two"):
            rows = rows_of(self.directory / f"{name}.results")
            of_last = [row for row in rows if all(row[key] == rows[-1][key] for key in ("step", "increment"))]
            ends.append([[value for key, value in row.items() if key not in ("step", "increment")] for row in of_last])
        self.assertEqual(*ends)


class RigidSlider(LargeSlipRuns):
    def test_is_shown_where_it_has_gone(self):
        text = model_of({
            "scabo": 1, "materials": {"steel": {"young": 210e9, "poisson": 0.3}},
            "bodies": {"ground": {"material": "steel", "mesh": {"size": 0.1}, "shape": rectangle([0, -1], [3, 0], 0.0, 1.0)},
                       "slider": {"rigid": True, "shape": rectangle([0.5, 0], [1, 0.5], 0.0, 1.0)}},
            "supports": [{"on": "ground.bottom", "fix": ["x", "y"]},
                         {"name": "drag", "on": "slider", "rotation": 0, "displacement": [1.0, None]}],
            "loads": {"weight": {"on": "slider", "force": [0, -WEIGHT]}},
            "contacts": {"joint": {"between": ["ground.top", "slider.bottom"], "friction": FRICTION, "slip": "large"}},
            "steps": [{"loads": {"weight": 1, "drag": 0}}, {"increments": 4, "loads": {"weight": 1, "drag": 1}}],
            "output": {"history": {"x": "slider.vertex_3.ux"}}})
        increments = self.solve(text)
        self.assertGreaterEqual(sum(one["pairs_found_anew"]["times"] for one in increments), 5)
        history = (self.directory / "model.results" / "history.csv").read_text().splitlines()[1:]
        gone = [float(row.split(",")[-1]) for row in history]
        for x, factor in zip(gone, (0, 0.25, 0.5, 0.75, 1), strict=True):
            self.assertAlmostEqual(x, factor, delta=1e-12)
        joint = increments[-1]["contacts"]["joint"]
        self.assertAlmostEqual(joint["tangential_force"] / WEIGHT, -FRICTION, delta=1e-9)


class Restart(RestartRuns):
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


if __name__ == "__main__":
    support.main()
