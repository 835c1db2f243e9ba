"""Runs in space that start where another one ended."""
import support
from solids import HEAD
from support import rows_of, scabo, summary_of

# A block that slides on a base, with a glued pad, a bolt in a ring on springs, a lid that comes and a stop that goes.
MODEL = """materials:
  steel: {young: 200e9, poisson: 0.3, expansion: 12e-6, density: 7850}
bodies:
  base: {material: steel, shape: {box: {corner: [0, 0, -0.2], size: [0.6, 0.3, 0.2]}}, mesh: {size: 0.15}}
  block: {material: steel, shape: {box: {corner: [0, 0, 0], size: [0.3, 0.3, 0.1]}}, mesh: {size: 0.15}}
  pad: {material: steel, shape: {box: {corner: [0.4, 0, 0], size: [0.15, 0.3, 0.1]}}, mesh: {size: 0.15}}
  stop: {rigid: true, shape: {box: {corner: [0.6, 0, -0.2], size: [0.1, 0.3, 0.3]}}, mesh: {size: 0.1}REMOVED}
LATER
supports:
  - {on: base.bottom, fix: [x, y, z], name: ground}
  - {on: block.left, displacement: [1e-5, null, null], name: ram}
  - {on: stop, fix: [x, y, z], name: held}
springs:
  - {on: pad.top, k_n: 1e9, k_t: 1e9, name: soft, at_rest: 1e-5}
loads:
  press: {on: block.top, pressure: 2e6}
  pull: {on: pad.right, traction: [1e6, 0, 4e6]}
  heat: {on: block, temperature: 5}
contacts:
  slide: {between: [base.top, block.bottom], friction: FRICTION}
  glued: {between: [base.top, pad.bottom], friction: 0.5, cohesion: 2e6, tension: 3e6}
  side: {between: [base.right, stop.left], friction: 0.1}
JOINT
RESTART
steps: [STEPS]
output: {history: {elastic: elastic_energy, friction: friction_energy, external: external_energy, ram: ram.reaction_x}}
"""
FIRST = "{name: press, loads: {press: 1, ram: 0}}, {name: push, increments: 3, loads: {ram: 1, pull: 1}}"
SECOND = "{name: back, increments: 2, loads: {ram: -0.5, heat: 1, soft: 1}}, {name: place, increments: 2, loads: {weight: 1}}, {name: strike, increments: 2}, {name: more, loads: {press: 1.5, pull: 0.2}}"
LID = "  lid: {material: steel, shape: {box: {corner: [0, 0, 0.1], size: [0.3, 0.3, 0.05]}}, mesh: {size: 0.15}, added: place}"
ON_LID = "  under_lid: {between: [block.top, lid.bottom], friction: 0.2}"


def model(steps, later=True, removed="", restart="", friction="0.3"):
    text = MODEL
    for key, value in {"REMOVED": removed, "LATER": LID if later else "", "JOINT": ON_LID if later else "", "FRICTION": friction,
                       "RESTART": restart and f"restart: {restart}", "STEPS": steps}.items():
        text = text.replace(key, value)
    return HEAD + text.replace("  pull: {", "  weight: {on: lid, gravity: [0, 0, -9.81e3]}\n  pull: {" if later else "  pull: {")


class Restart(support.InTemporaryDirectory):
    def run_model(self, name, text, status=0):
        (self.directory / f"{name}.yaml").write_text(text, encoding="utf-8")
        done = scabo("run", f"{name}.yaml", "--quiet", cwd=self.directory)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return summary_of(self.directory / f"{name}.results")["increments"] if status == 0 else done.stderr

    def assert_same_rows(self, one, other):
        """Pairs of the last step of two results."""
        last = [[row for row in rows if (row["step"], row["increment"]) == (rows[-1]["step"], rows[-1]["increment"])]
                for rows in (rows_of(self.directory / f"{name}.results") for name in (one, other))]
        largest = {key: max(abs(float(row[key])) for row in last[1]) for key in last[1][0] if key not in ("step", "increment", "contact", "pair", "state")}
        for a, b in zip(*last, strict=True):
            self.assertEqual((a["contact"], a["pair"], a["state"]), (b["contact"], b["pair"], b["state"]))
            for key, scale in largest.items():
                self.assertAlmostEqual(float(a[key]), float(b[key]), delta=1e-9 * max(scale, 1e-6 if key.startswith(("gap", "slip")) else 0.0), msg=key)

    def assert_same(self, increments, others):
        for one, other in zip(increments, others, strict=True):
            for name in ("external", "elastic", "friction"):
                self.assertAlmostEqual(one["energy"][name], other["energy"][name], delta=1e-9 * other["energy"]["elastic"], msg=name)
            for kind in ("reactions", "springs"):
                for name, force in other[kind].items():
                    for a, b in zip(one[kind][name], force):
                        self.assertAlmostEqual(a, b, delta=1e-9 * 2e5, msg=name)
            for name, contact in other["contacts"].items():
                for key in ("open", "stick", "slip"):
                    self.assertEqual(one["contacts"][name][key], contact[key])

    def test_two_runs_are_one(self):
        whole = self.run_model("whole", model(f"{FIRST}, {SECOND}", removed=", removed: strike"))
        first = self.run_model("one", model(FIRST, later=False))
        self.assert_same(first, [self.without_lid(increment) for increment in whole[:4]])
        self.assertGreater(first[-1]["contacts"]["slide"]["slip"], 0)
        self.assertGreater(first[-1]["contacts"]["glued"]["broken"], 0)
        second = self.run_model("two", model(SECOND, removed=", removed: strike", restart="one.results"))
        self.assert_same(second, whole[4:])
        self.assert_same_rows("two", "whole")
        # A third one, which nothing is left for: the end of the second, without the stop.
        third = self.run_model("three", model("{name: rest, loads: {}}", restart="two.results").replace(", added: place", "").replace(
            "  stop: {rigid: true, shape: {box: {corner: [0.6, 0, -0.2], size: [0.1, 0.3, 0.3]}}, mesh: {size: 0.1}}\n", "").replace(
            "  - {on: stop, fix: [x, y, z], name: held}\n", "").replace("  side: {between: [base.right, stop.left], friction: 0.1}\n", ""))
        for name in ("slide", "glued", "under_lid"):
            for key in ("normal_force", "tangential_force"):
                for a, b in zip(third[0]["contacts"][name][key], whole[-1]["contacts"][name][key], strict=True):
                    self.assertAlmostEqual(a, b, delta=1e-9 * 2e5, msg=name)

    @staticmethod
    def without_lid(increment):
        return increment | {"contacts": {name: value for name, value in increment["contacts"].items() if name != "under_lid"}}

    def test_laws_may_change(self):
        self.run_model("one", model(FIRST, later=False))
        second = self.run_model("two", model("{name: smooth, loads: {}}", later=False, restart="one.results", friction="0.01"))
        force = second[0]["contacts"]["slide"]
        self.assertLessEqual(abs(force["tangential_force"][0]), 0.01 * force["normal_force"][2] * (1 + 1e-9))

    def test_a_bolt_keeps_its_shortening(self):
        text = HEAD + """materials: {steel: {young: 210e9, poisson: 0.3}}
bodies:
  ring: {material: steel, shape: {tube: {from: [0, 0, 0], to: [0, 0, 0.05], inner: 9e-3, outer: 20e-3}}, mesh: {size: 0.01}}
  bolt:
    material: steel
    shape: {cylinder: {from: [0, 0, 0], to: [0, 0, 0.05], radius: 8e-3}}
    mesh: {size: 8e-3}
    preload: {cut: {point: [0, 0, 0.025], normal: [0, 0, 1]}, force: 50e3TIGHTENED}
  head: {rigid: true, shape: {cylinder: {from: [0, 0, 0.05], to: [0, 0, 0.06], radius: 13e-3}}, mesh: {size: 0.01}}
  nut: {rigid: true, shape: {cylinder: {from: [0, 0, -0.01], to: [0, 0, 0], radius: 13e-3}}, mesh: {size: 0.01}}
supports: [{on: nut, fix: [x, y, z]}]
loads: {pull: {on: head, force: [0, 0, 10e3]}}
contacts:
  under_head: {between: [ring.top, head.bottom], friction: 0.2}
  on_nut: {between: [nut.top, ring.bottom], friction: 0.2}
ties:
  to_head: {between: [bolt.top, head.bottom]}
  to_nut: {between: [nut.top, bolt.bottom]}
RESTART
steps: [STEPS]
"""
        filled = lambda steps, restart="", tightened="": text.replace("STEPS", steps).replace("RESTART", restart).replace("TIGHTENED", tightened)
        first, pull = "{name: tighten, increments: 2, loads: {}}", "{name: pull, increments: 2, loads: {pull: 1}}"
        whole = self.run_model("whole", filled(f"{first}, {pull}"))
        self.run_model("one", filled(first))
        second = self.run_model("two", filled(pull, "restart: one.results"))
        for one, other in zip(second, whole[2:], strict=True):
            for key, scale in (("force", 5e4), ("shortening", 1e-4)):
                self.assertAlmostEqual(one["preloads"]["bolt"][key], other["preloads"]["bolt"][key], delta=1e-9 * scale)
            self.assertAlmostEqual(one["energy"]["external"], other["energy"]["external"], delta=1e-9 * other["energy"]["elastic"])
        self.assertIn("bolt 'bolt' has been tightened in 'one.results' already: leave 'tightened' out",
                      self.run_model("three", filled(pull, "restart: one.results", ", tightened: pull"), 1))
        self.assertIn("preload of body 'bolt' is there at the end of one.results, but not at the start of this model",
                      self.run_model("four", filled(pull, "restart: one.results").replace("    preload: {cut", "    #"), 1))

    def test_supports_go_on_and_end(self):
        """A bar, a post with a bonded lid and its hand: one support lasts in the first run, and ends in the second; another one has begun in the first."""
        def text(steps, prop="", hand="", jack="", restart=""):
            return HEAD + f"""materials: {{stuff: {{young: 1e9, poisson: 0.1, density: 2000}}, post: {{young: 1e9, poisson: 0.2}}}}
bodies:
  bar: {{material: stuff, shape: {{box: {{corner: [0, 0, 0], size: [1, 1, 2]}}}}, mesh: {{size: 0.5}}}}
  post: {{material: post, shape: {{box: {{corner: [3, 0, 0], size: [1, 1, 1]}}}}, mesh: {{size: 0.5}}}}
  lid: {{rigid: true, shape: {{cylinder: {{from: [3.5, 0.5, 1], to: [3.5, 0.5, 1.5], radius: 1}}}}, mesh: {{size: 0.6}}}}
supports:
  - {{on: bar.bottom, fix: z, name: foot}}
  - {{on: bar.left, fix: [x, y], name: prop{prop}}}
  - {{on: post.bottom, fix: [x, y, z], name: bed}}
  - {{on: lid, displacement: [0, 1e-5, 0], rotation: [0, 0, 2e-5], name: hand{hand}}}
{jack and "  - {on: bar.right, displacement: [-1e-6, null, null], name: jack" + jack + "}"}
loads:
  weight: {{on: bar, gravity: [0, 0, -10]}}
  push: {{on: lid, force: [300, -200, -5000], at: [4.2, 1.2, 1.5]}}
contacts: {{seat: {{between: [post.top, lid.bottom], bond: true}}}}
{restart and f"restart: {restart}"}
steps: [{steps}]
"""
        load, place = "{name: load, loads: {weight: 1, push: 1, hand: 1}}", "{name: place, increments: 2, loads: {jack: 1}}"
        let_go = "{name: let_go, increments: 2, loads: {push: 1.5}}, {name: off, increments: 2}"
        whole = self.run_model("whole", text(f"{load}, {place}, {let_go}", hand=", removed: let_go", jack=", added: place, removed: off"))
        first = self.run_model("one", text(f"{load}, {place}", jack=", added: place"))
        second = self.run_model("two", text(f"{{name: rest, loads: {{}}}}, {let_go}", hand=", removed: let_go", jack=", removed: off", restart="one.results"))
        self.assertGreater(abs(first[-1]["reactions"]["hand"][1]), 1e3)
        self.assertGreater(abs(first[-1]["moments"]["hand"][2]), 1e3)
        for one, other in zip([*first, *second[1:]], whole, strict=True):
            for kind in ("reactions", "moments"):
                for name, value in other[kind].items():
                    for a, b in zip(one[kind].get(name, [0, 0, 0]), value, strict=True):
                        self.assertAlmostEqual(a, b, delta=1e-9 * 1e5, msg=name)
            for name in ("external", "elastic"):
                self.assertAlmostEqual(one["energy"][name], other["energy"][name], delta=1e-9 * other["energy"]["elastic"])
        self.assert_same_rows("two", "whole")
        self.assertIn("support 'hand' is not the same as in one.results",
                      self.run_model("three", text("{name: rest, loads: {}}", jack=", added: later", restart="one.results").replace("2e-5]", "3e-5]").replace(
                          ", added: later", ""), 1))

    def test_what_does_not_agree_is_refused(self):
        self.run_model("one", model(FIRST, later=False))
        there = model(SECOND, removed=", removed: strike", restart="one.results")
        same = "what the state depends on (shape, mesh, material, place, and the value of a load that acts) must not change"
        for change, sentence in (
                (("young: 200e9", "young: 210e9"), f"body 'base' is not the same as in one.results: {same}"),
                (("size: [0.15, 0.3, 0.1]}}, mesh: {size: 0.15}", "size: [0.15, 0.3, 0.1]}}, mesh: {size: 0.1}"), "body 'pad' is not the same"),
                (("pressure: 2e6", "pressure: 3e6"), f"load 'press' is not the same as in one.results: {same}"),
                (("friction: 0.1}", "friction: 0.1, gap: 1e-4}"), "contact 'side' is not the same"),
                (("k_n: 1e9", "k_n: 2e9"), "spring 'soft' is not the same"),
                (("displacement: [1e-5, null, null]", "displacement: [2e-5, null, null]"), "support 'ram' is not the same"),
                ((", added: place", ""), "body 'lid' is not there at the end of one.results: it, or the body that it belongs to, must be 'added' in a step of this model, "
                                         "the second one or a later one"),
                (("added: place", "added: back"), "body 'lid' is not there at the end of one.results"),
                (("removed: strike", "removed: back"), "is the first step of a restart, which begins with what is there at the other run's end: put a step before it in which "
                                                       "nothing changes, as {name: rest, loads: {}}"),
                (("restart: one.results", "restart: none.results"), "there is no directory 'none.results' in the folder of the model"),
                (("restart: one.results", "restart: ."), "has no state at its end to start from")):
            with self.subTest(change=change):
                self.assertIn(change[0], there)
                said = self.run_model("two", there.replace(*change), 1)
                self.assertIn(sentence, said)
                self.assertRegex(said, r"two.yaml:\d+:\d+: ")
        end = self.directory / "one.results" / "end.state"
        content = end.read_bytes()
        end.write_bytes(content[:-40] + b"x" * 40)
        self.assertIn("the state at the end of one.results is damaged: run that model again", self.run_model("two", there, 1))

    def test_directions_of_friction_must_not_change(self):
        axes = "{direction: [1, DIRECTION, 0], along: 0.3, across: ACROSS}"

        def of(direction, across):
            return axes.replace("DIRECTION", direction).replace("ACROSS", across)

        self.run_model("one", model(FIRST, later=False, friction=of("0", "0.2")))
        self.run_model("two", model(SECOND, restart="one.results", friction=of("0", "0.2")))
        for friction in (of("0.5", "0.2"), of("0", "0.25"), "0.3"):
            with self.subTest(friction=friction):
                said = self.run_model("three", model(SECOND, restart="one.results", friction=friction), 1)
                self.assertRegex(said, r"three.yaml:\d+:\d+: restart: contact 'slide' is not the same as in one.results")

    def test_runs_of_the_plane_are_refused_and_refuse(self):
        plane = """scabo: 1
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies: {base: {material: steel, shape: {rectangle: {corner: [0, 0], size: [1, 1]}}, mesh: {size: 1}}}
supports: [{on: base.bottom, fix: [x, y], name: ground}]
loads: {press: {on: base.top, pressure: 1e6}}
"""
        self.run_model("flat", plane)
        self.run_model("one", model(FIRST, later=False))
        self.assertIn("flat.results has the results of a model in the plane, and this one is in space: name the results of a model of the same kind",
                      self.run_model("two", model(FIRST, later=False, restart="flat.results"), 1))
        self.assertIn("one.results has the results of a model in space, and this one is in the plane", self.run_model("three", plane + "restart: one.results\n", 1))


if __name__ == "__main__":
    support.main()
