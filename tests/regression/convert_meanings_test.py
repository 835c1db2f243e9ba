"""`scabo convert` of decks of solids: keywords that a model says in other words, against closed forms and against decks without them."""
import re
import unittest

import support
from convert_solids_test import MATERIAL, Numbers
from decks import block
from solids import increments_of_deck
from support import scabo

PUSHED = "*BOUNDARY\nUPPER_TOP, 3, 3, {}\n"


def force_of(increment):
    return abs(increment["contacts"]["touch"]["normal_force"][2])


def nodes_of(text, name):
    """Numbers of a node set of `block`."""
    return [int(line) for line in re.search(rf"NSET={name}\n((?:\d+\n)+)", text)[1].split()]


class Meanings(support.InTemporaryDirectory):
    def two_blocks(self, kind, load):
        return Numbers.two_blocks(self, kind, load)

    def convert(self, deck, *words):
        (self.directory / "deck.inp").write_text(deck, encoding="utf-8")
        return scabo("convert", self.directory / "deck.inp", "--force", *words)

    def assert_refused(self, deck, sentence):
        done = self.convert(deck)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(sentence, done.stderr)
        self.assertRegex(done.stderr, r"deck\.inp:\d+")
        self.assertFalse((self.directory / "deck.yaml").exists())


def pressed(top):
    return "*DLOAD\n" + "".join(f"{e}, P2, 5.\n" for e in top)


@unittest.skipIf(support.SANITIZED, "numbers")
class Contacts(Meanings):
    def test_soft_contact(self):
        """A linear law is a bed of springs, which stores p^2 A / 2 k more; --rigid-contact leaves it out."""
        deck = self.two_blocks("C3D8", pressed).replace("HARD", "LINEAR\n1000.")
        energies = []
        for words in ((), ("--rigid-contact",)):
            increment, = increments_of_deck(self, deck, *words)
            self.assertAlmostEqual(increment["contacts"]["touch"]["max_pressure"], 5, delta=1e-8)
            energies.append(increment["energy"]["elastic"])
        self.assertAlmostEqual(energies[0] - energies[1], 5**2 * 4 / 2 / 1000, delta=1e-9)
        self.assertIn("is the `modulus` of the contact", self.convert(deck).stderr)

    def test_change_of_friction(self):
        """The upper block slides; then its friction falls to 0.1. What nothing slips at is written as 1e6."""
        def load(top):
            return pressed(top) + "*BOUNDARY\nUPPER_TOP, 1, 1, 0.1\n"
        deck = self.two_blocks("C3D8", load).replace("UPPER_LEFT, XSYMM\n", "")
        change = "*STEP\n*STATIC\n*CHANGE FRICTION, INTERACTION=TOUCH\n*FRICTION\n0.1\n*END STEP\n"
        first, second = increments_of_deck(self, deck + change)
        for increment, mu in ((first, 0.3), (second, 0.1)):
            self.assertAlmostEqual(abs(increment["contacts"]["touch"]["tangential_force"][0]), mu * 20, delta=1e-2)  # a little of it is across
        held = increments_of_deck(self, deck.replace("*FRICTION\n0.3", "*FRICTION\n1e20"))[0]["contacts"]["touch"]
        self.assertEqual(held["slip"], 0)
        self.assert_refused_once(deck + change.replace("INTERACTION=TOUCH", "INTERACTION=NONE"), "there is no *SURFACE INTERACTION 'NONE'")
        self.assert_refused_once(change.split("*STATIC\n")[1].replace("*END STEP\n", "") + deck, "*CHANGE FRICTION stands outside of a step")

    def assert_refused_once(self, deck, sentence):
        (self.directory / "deck.yaml").unlink(missing_ok=True)
        self.assert_refused(deck, sentence)

    def test_clearance(self):
        """It replaces the gap of the mesh, whatever that is: pressed by 0.02 over a clearance of 0.01 as by 0.01 without it."""
        plain = self.two_blocks("C3D8", lambda top: PUSHED.format(-0.01))
        expected = force_of(increments_of_deck(self, plain)[0])
        clear = "*CLEARANCE, MASTER=MASTER, SLAVE=SLAVE, VALUE={}\n*BOUNDARY"
        apart = re.sub(r"(?m)^(1\d\d\d, .*), ([12]\.0)$", lambda m: f"{m[1]}, {float(m[2]) + 0.25}", plain)
        self.assertNotEqual(apart, plain)
        for deck, way, clearance in ((plain, -0.02, 0.01), (plain, 0.0, -0.01), (apart, -0.02, 0.01), (apart, 0.0, -0.01)):
            with self.subTest(way=way, clearance=clearance):
                deck = deck.replace(PUSHED.format(-0.01), PUSHED.format(way)).replace("*BOUNDARY", clear.format(clearance), 1)
                self.assertAlmostEqual(force_of(increments_of_deck(self, deck)[0]), expected, delta=1e-9 * expected)
        bent = re.sub(r"(?m)^(10\d\d, 0\.0, .*), 1\.0$", r"\1, 1.1", plain)
        self.assertNotEqual(bent, plain)
        for deck, parameters, sentence in (
                (bent, "MASTER=MASTER, SLAVE=SLAVE, VALUE=0.01", "*CLEARANCE replaces the gaps of the mesh, which are from 0 to 0.1"),
                (plain, "MASTER=MASTER, SLAVE=OTHER, VALUE=0.01", "no *CONTACT PAIR before this *CLEARANCE has the slave 'OTHER'"),
                (plain, "MASTER=MASTER, SLAVE=SLAVE, VALUE=x", "'x' is no VALUE of *CLEARANCE"),
                (plain, "MASTER=MASTER, SLAVE=SLAVE, TABULAR", "*CLEARANCE with TABULAR is not taken"),
                (plain, "MASTER=MASTER, SLAVE=SLAVE, VALUE=0.\n*CLEARANCE, MASTER=MASTER, SLAVE=SLAVE, VALUE=0.", "another *CLEARANCE of this contact")):
            with self.subTest(sentence=sentence):
                self.assert_refused_once(deck.replace("*BOUNDARY", f"*CLEARANCE, {parameters}\n*BOUNDARY", 1), sentence)
        self.assert_refused_once(plain.replace("*STATIC\n", "*STATIC\n1., 1.\n*CLEARANCE, MASTER=MASTER, SLAVE=SLAVE, VALUE=0.\n*BOUNDARY\n"),
                                 "*CLEARANCE within a step is not taken")


    def test_few_pairs(self):
        """The upper block bends upwards and touches at a corner only: the run warns that the mesh is too coarse for that."""
        deck = self.two_blocks("C3D8", lambda top: PUSHED.format(-0.01))
        inclined = re.sub(r"(?m)^(1\d\d\d), ([^,]*), ([^,]*), ([12]\.0)$", lambda m: f"{m[1]}, {m[2]}, {m[3]}, {float(m[4]) + 0.05 * (float(m[2])**2 + float(m[3])**2)}", deck)
        self.assertNotEqual(inclined, deck)
        for text, few in ((deck, False), (inclined, True)):
            increment, = increments_of_deck(self, text)
            touch = increment["contacts"]["touch"]
            self.assertEqual(0 < touch["stick"] + touch["slip"] < 4, few)
            warnings = " ".join(support.summary_of(self.directory / "results")["warnings"])
            self.assertEqual("in contact at the end, and the mesh is too coarse for the zone that touches" in warnings, few, warnings)


@unittest.skipIf(support.SANITIZED, "numbers")
class Steps(Meanings):
    def test_steps_of_vibrations(self):
        """They change nothing in static steps: of the same deck with and without them the results are the same."""
        deck = self.two_blocks("C3D8", pressed)
        before, after = "*STEP\n*FREQUENCY\n5\n*END STEP\n", "*STEP, PERTURBATION\n*BOUNDARY\nUPPER_TOP, 1\n*FREQUENCY\n5\n*END STEP\n"
        head, step = deck.split("*STEP", 1)
        increment, = increments_of_deck(self, head + before + "*STEP" + step + after)
        self.assertAlmostEqual(force_of(increment), 20, delta=1e-9 * 20)
        self.assertEqual(increment["reactions"].keys(), increments_of_deck(self, deck)[0]["reactions"].keys())
        self.assertIn("the step with *FREQUENCY asks for vibrations or buckling about a state", self.convert(head + before + "*STEP" + step).stderr)
        (self.directory / "deck.yaml").unlink()
        for text in (head + after + "*STEP" + step, head + before):  # conditions that go on; nothing static
            self.assert_refused(text, "*FREQUENCY is no static analysis")

    def test_time_delay(self):
        """An amplitude that grows from 0 to 1 is at 0.75 where it begins a quarter later."""
        deck = self.two_blocks("C3D8", lambda top: pressed(top).replace("*DLOAD", "*DLOAD, AMPLITUDE=grows, TIME DELAY=0.25"))
        deck = deck.replace("*BOUNDARY", "*AMPLITUDE, NAME=grows\n0., 0., 1., 1.\n*BOUNDARY", 1)
        self.assertAlmostEqual(force_of(increments_of_deck(self, deck)[-1]), 15, delta=1e-9 * 20)
        (self.directory / "deck.yaml").unlink()
        self.assert_refused(deck.replace("TIME DELAY=0.25", "TIME DELAY=later"), "'later' is no TIME DELAY of *DLOAD")


@unittest.skipIf(support.SANITIZED, "numbers")
class Bodies(Meanings):
    def test_two_materials(self):
        """A column of two materials, 1 and 3 high, is pulled: two bodies and a tie. N = A d / (l1 / E1 + l2 / E2)."""
        for kind in ("C3D8", "C3D20", "C3D10"):
            with self.subTest(kind=kind):
                text, _, _ = block(kind, (2, 2, 4), (1.0, 1.0, 4.0), 0.0, 1, "COLUMN")
                each = 6 if kind == "C3D10" else 1
                deck = (text + f"*ELSET, ELSET=FOOT, GENERATE\n1, {4 * each}\n*ELSET, ELSET=SHAFT, GENERATE\n{4 * each + 1}, {16 * each}\n"
                        + "".join(f"*MATERIAL, NAME={name}\n*ELASTIC\n{young}, 0.\n*SOLID SECTION, ELSET={name}, MATERIAL={name}\n"
                                  for name, young in (("FOOT", 1000.0), ("SHAFT", 3000.0)))
                        + "*BOUNDARY\nCOLUMN_BOTTOM, 1, 3\nCOLUMN_LEFT, 1\n*STEP\n*STATIC\n*BOUNDARY\nCOLUMN_TOP, 3, 3, 0.01\n*END STEP\n")
                increment, = increments_of_deck(self, deck)
                expected = 0.01 / (1 / 1000 + 3 / 3000)
                self.assertAlmostEqual(increment["reactions"]["COLUMN_TOP"][2], expected, delta=1e-9 * expected)
                tie, = increment["contacts"].values()
                self.assertAlmostEqual(abs(tie["normal_force"][2]), expected, delta=1e-9 * expected)
                self.assertIn("elements of two materials hang together: they become the bodies 'FOOT' and 'SHAFT', with a tie", self.convert(deck).stderr)

    def test_surfaces_of_several_bodies(self):
        """Two blocks on one, as one surface, and a third that faces nothing: a contact for each of both."""
        lower = block("C3D8", (4, 2, 1), (4, 2, 1), 0, 1, "LOWER")[0]
        deck, sets, loads = lower, "", ""
        for k, x in enumerate((0.0, 2.5, 6.0)):
            text, _, top = block("C3D8", (1, 2, 1), (1, 2, 1), 1, 1001 + 1000 * k, f"UPPER{k}", (x, 0.0))
            deck += text
            sets += f"UPPER{k}_BOTTOM\n"
            loads += f"*BOUNDARY\nUPPER{k}_TOP, 1, 2\nUPPER{k}_BOTTOM, 1, 2\n" + (f"UPPER{k}_TOP, 3\n" if k == 2 else "")
        pressure = "*DLOAD\n" + "".join(f"{e}, P2, 5.\n" for e in (1001, 1002, 2001, 2002))
        deck += ("*ELSET, ELSET=ALL\nLOWER, UPPER0, UPPER1, UPPER2\n*MATERIAL, NAME=steel\n*ELASTIC\n1000., 0.25\n*SOLID SECTION, ELSET=ALL, MATERIAL=steel\n"
                 f"*SURFACE, NAME=MASTER, TYPE=NODE\nLOWER_TOP\n*SURFACE, NAME=SLAVE, TYPE=NODE\n{sets}*SURFACE INTERACTION, NAME=touch\n*FRICTION\n0.3\n"
                 "*CONTACT PAIR, INTERACTION=touch\nSLAVE, MASTER\n*BOUNDARY\nLOWER_BOTTOM, 1, 3\n" + loads + "*STEP\n*STATIC\n" + pressure + "*END STEP\n")
        increment, = increments_of_deck(self, deck)
        self.assertEqual(len(increment["contacts"]), 2)
        for contact in increment["contacts"].values():
            self.assertAlmostEqual(contact["normal_force"][2], 10, delta=1e-8)
        self.assertIn("which face none of the other one and are left out of the contact", self.convert(deck).stderr)
        (self.directory / "deck.yaml").unlink()
        self.assert_refused(deck.replace(f"TYPE=NODE\n{sets}", "TYPE=NODE\nUPPER2_BOTTOM\nUPPER0_TOP\n"),
                            "the two surfaces do not face each other, and the contact is lost")

    def test_contact_of_a_body_with_itself(self):
        """The two legs of a U."""
        text, number, _ = block("C3D8", (3, 1, 3), (3, 1, 3), 0, 1, "U")
        for element in (5, 8):
            text = re.sub(rf"(?m)^{element}, .*, .*, .*, .*, .*, .*, .*, .*\n", "", text)
        inner = ["".join(f"{m}\n" for (i, _, k), m in number.items() if i == at and k >= 2) for at in (2, 4)]
        self.assert_refused(text + f"*NSET, NSET=ONE\n{inner[0]}*NSET, NSET=OTHER\n{inner[1]}*SURFACE, NAME=S, TYPE=NODE\nONE\n*SURFACE, NAME=M, TYPE=NODE\nOTHER\n"
                            "*MATERIAL, NAME=steel\n*ELASTIC\n1000., 0.25\n*SOLID SECTION, ELSET=U, MATERIAL=steel\n*SURFACE INTERACTION, NAME=touch\n"
                            "*CONTACT PAIR, INTERACTION=touch\nS, M\n*BOUNDARY\nU_BOTTOM, 1, 3\n*STEP\n*STATIC\n*CLOAD\n1, 3, 1.\n*END STEP\n",
                            "sides of body 'U' face each other in both surfaces, and contact of a body with itself is not taken")

    def test_elements_that_are_no_solids(self):
        deck = self.two_blocks("C3D8", pressed)
        shell = "*ELEMENT, TYPE=S4, ELSET=SKIN\n9001, 1, 2, 3, 4\n*SURFACE, NAME=OUTSIDE\n{}, SPOS\n*BOUNDARY"
        for of in ("SKIN", "9001"):
            self.assert_refused(deck.replace("*BOUNDARY", shell.format(of), 1),
                                f"surface 'OUTSIDE': '{of}' has elements of type S4, which are no solids and have no sides in space")


@unittest.skipIf(support.SANITIZED, "numbers")
class Equations(Meanings):
    def equations(self, nodes, other, components=(1, 2, 3), *, factor=-1.0):
        return "*EQUATION\n" + "".join(f"2\n{node}, {k}, 1., {other(node)}, {k}, {factor}\n" for node in nodes for k in components)

    def test_driven_by_a_node(self):
        """A face that follows a node, whose displacement is prescribed, twice as far: as the face pushed by itself."""
        plain = self.two_blocks("C3D8", lambda top: PUSHED.format(-0.02))
        expected = force_of(increments_of_deck(self, plain)[0])
        node = "*NODE\n9999, 0., 0., 5.\n"
        follow = self.equations(nodes_of(plain, "UPPER_TOP"), lambda node: 9999, (3,), factor=-2.0)
        deck = (node + plain).replace("*BOUNDARY", follow + "*BOUNDARY", 1).replace("UPPER_TOP, 3, 3, -0.02", "9999, 3, 3, -0.01")
        increment, = increments_of_deck(self, deck)
        self.assertAlmostEqual(force_of(increment), expected, delta=1e-9 * expected)
        held = deck.replace("*BOUNDARY\n9999, 3, 3, -0.01", "*CLOAD\n1001, 3, -1.").replace("*STEP", "*BOUNDARY\n9999, 3\n*STEP")
        first, = increments_of_deck(self, held)
        second, = increments_of_deck(self, plain.replace(PUSHED.format(-0.02), "*CLOAD\n1001, 3, -1.\n").replace("*STEP", "*BOUNDARY\nUPPER_TOP, 3\n*STEP"))
        self.assertAlmostEqual(force_of(first), force_of(second), delta=1e-9)
        self.assertGreater(force_of(first), 0.01)

    def test_faces_that_are_joined(self):
        """Two blocks whose nodes move alike, or as means of others, carry a pull as one block."""
        lower, low, _ = block("C3D8", (2, 2, 1), (2, 2, 1), 0, 1, "LOWER")
        for cells in ((2, 2, 1), (4, 4, 1)):
            with self.subTest(cells=cells):
                upper, high, top = block("C3D8", cells, (2, 2, 1), 1, 1001, "UPPER")
                text = lower + upper + MATERIAL + "*EQUATION\n"
                ratio = cells[0] // 2
                for (x, y, z), node in high.items():
                    if z > 0:
                        continue
                    # weights of the nodes of the lower block, 2 apart in its numbers, in steps of 2 / ratio
                    weights = {}
                    for i, wx in self.weights(x / ratio):
                        for j, wy in self.weights(y / ratio):
                            weights[low[i, j, 2]] = wx * wy
                    weights = {n: w for n, w in weights.items() if w}
                    for k in (1, 2, 3):
                        terms = [f"{node}, {k}, -1."] + [f"{n}, {k}, {w}" for n, w in weights.items()]
                        text += f"{len(terms)}\n" + "".join(", ".join(terms[i:i + 4]) + "\n" for i in range(0, len(terms), 4))
                text += ("*BOUNDARY\nLOWER_BOTTOM, 3\nLOWER_LEFT, 1\nLOWER_FRONT, 2\nUPPER_LEFT, 1\nUPPER_FRONT, 2\n*STEP\n*STATIC\n*DLOAD\n"
                         + "".join(f"{e}, P2, -5.\n" for e in top) + "*END STEP\n")
                increment, = increments_of_deck(self, text)
                tie, = increment["contacts"].values()
                self.assertAlmostEqual(abs(tie["normal_force"][2]), 20, delta=1e-8)
                self.assertAlmostEqual(increment["energy"]["elastic"], 0.5 * 5**2 / 1000 * 8, delta=1e-9)

    @staticmethod
    def weights(x):
        """Of the two nodes 2 apart around x."""
        i = int(x // 2) * 2
        return [(i, 1 - (x - i) / 2), (i + 2, (x - i) / 2)] if x > i else [(i, 1.0)]

    def test_refused(self):
        deck = self.two_blocks("C3D8", pressed)
        bottom, upper = nodes_of(deck, "LOWER_TOP"), nodes_of(deck, "UPPER_BOTTOM")
        for equation, sentence in (
                ("2\n1005, 3, 1., 1006, 3, -1.\n", "this *EQUATION neither leaves one displacement unknown nor ties"),
                ("3\n1005, 3, 1., 1006, 3, -1.\n", "the last *EQUATION has fewer terms than it says"),
                ("1\n1005, 3, 1., 1006, 3, -1.\n", "there are more terms on this line than the *EQUATION says"),
                ("two\n1005, 3, 1.\n", "'two' is not a number"),
                ("0\n", "0 is no number of terms of *EQUATION"),
                ("2\nUPPER_TOP, 3, 1., 1006, 3, -1.\n", "'UPPER_TOP' of *EQUATION is not the number of a node"),
                ("2\n1005, 4, 1., 1006, 4, -1.\n", "degree of freedom 4 of *EQUATION is not a displacement 1 to 3"),
                ("2\n1005, 3, 1., 7777, 3, -1.\n", "node 7777 of *EQUATION is not there"),
                (f"2\n{upper[5]}, 3, 1., {bottom[4]}, 3, -1.\n", "along some axes only, and a tie along all"),
                ("".join(f"2\n{upper[5]}, {k}, 1., {bottom[4]}, {k}, -1.\n" for k in (1, 2, 3)), "to another body, and these nodes are not all of a face"),
        ):
            with self.subTest(sentence=sentence):
                self.assert_refused(deck.replace("*BOUNDARY", "*EQUATION\n" + equation + "*BOUNDARY", 1), sentence)
        self.assert_refused(deck.replace("*DLOAD", "*EQUATION, REMOVE=ALL\n*DLOAD", 1), "*EQUATION, REMOVE changes the model within the analysis")
        node = "*NODE\n9999, 0., 0., 5.\n" + deck.replace("*BOUNDARY", self.equations(nodes_of(deck, "UPPER_TOP"), lambda node: 9999, (3,)) + "*BOUNDARY", 1)
        self.assert_refused(node.replace("*DLOAD", "*CLOAD\n9999, 3, -1.\n*DLOAD", 1), "the force at node 9999 acts on what *EQUATION joins to it, and is lost")


if __name__ == "__main__":
    support.main()
