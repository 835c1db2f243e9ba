"""`scabo convert` of decks of solids with reference nodes: bolts, couplings and rigid bodies, against statics and beams."""
import unittest

import support
from decks import block
from solids import increments_of_deck
from support import scabo

MATERIAL = "*MATERIAL, NAME=steel\n*ELASTIC\n1000., 0.\n*ELSET, ELSET=ALL\n{}\n*SOLID SECTION, ELSET=ALL, MATERIAL=steel\n"
TOUCH = "*SURFACE INTERACTION, NAME=touch\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n*FRICTION\n0.2\n"


def surface_of_nodes(*names):
    return "".join(f"*SURFACE, NAME=S{name}, TYPE=NODE\n{name}\n" for name in names)


def step(*lines, times="1., 1."):
    return f"*STEP\n*STATIC\n{times}\n" + "\n".join(lines) + "\n*END STEP\n"


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


class OfDecks(support.InTemporaryDirectory):
    def convert(self, deck, *words):
        (self.directory / "deck.inp").write_text(deck, encoding="utf-8")
        return scabo("convert", self.directory / "deck.inp", "--force", *words)

    def solve(self, deck):
        return increments_of_deck(self, deck)

    def assert_vector(self, found, expected, delta):
        for a, b in zip(found, expected, strict=True):
            self.assertAlmostEqual(a, b, delta=delta)


def column(kind="C3D8", cells=(2, 2, 4), corner=(0.0, 0.0)):
    """1 x 1 x 4 on its bottom, which is held; a node 9999 at (0.5, 0.5, 6)."""
    text, _, top = block(kind, cells, (1.0, 1.0, 4.0), 0.0, 1, "COLUMN", corner)
    return (text + "*NODE, NSET=REF\n9999, 0.5, 0.5, 6.\n" + MATERIAL.format("COLUMN") + surface_of_nodes("COLUMN_TOP")
            + "*BOUNDARY\nCOLUMN_BOTTOM, 1, 3\n"), top


@unittest.skipIf(support.SANITIZED, "numbers")
class Bolts(OfDecks):
    """A column that is cut in its middle."""

    def section(self, kind="C3D8"):
        # the sides on top of the second layer of elements
        sides = "".join(f"{1 + 4 + e}, {'S2'}\n" for e in range(4))
        return f"*SURFACE, NAME=CUT\n{sides}*PRE-TENSION SECTION, SURFACE=CUT, NODE=9999\n"

    def test_shortening(self):
        """Held at both ends, it has the tension E A s / L; CalculiX 2.20 has it with this sign."""
        deck, _ = column()
        increment, = self.solve(deck + self.section() + "*BOUNDARY\nCOLUMN_TOP, 1, 3\n" + step("*BOUNDARY", "9999, 1, 1, 0.02"))
        self.assertAlmostEqual(increment["preloads"]["ALL"]["shortening"], 0.02, delta=1e-15)
        self.assertAlmostEqual(increment["preloads"]["ALL"]["force"], 1000 * 0.02 / 4, delta=1e-9 * 5)

    def bridge(self):
        """The column pulls a plate on two posts beside it."""
        text = column()[0].replace(MATERIAL.format("COLUMN"), "")
        for k, x in enumerate((-2.0, 2.0)):
            text += block("C3D8", (2, 2, 2), (1.0, 1.0, 4.0), 0.0, 1001 + 1000 * k, f"POST{k}", (x, 0.0))[0]
            text += f"*BOUNDARY\nPOST{k}_BOTTOM, 1, 3\n" + surface_of_nodes(f"POST{k}_TOP")
        text += block("C3D8", (10, 2, 2), (5.0, 1.0, 1.0), 4.0, 4001, "PLATE", (-2.0, 0.0))[0]
        return (text + surface_of_nodes("PLATE_BOTTOM") + MATERIAL.format("COLUMN, POST0, POST1, PLATE") + TOUCH
                + "*CONTACT PAIR, INTERACTION=touch\nSPOST0_TOP, SPLATE_BOTTOM\nSPOST1_TOP, SPLATE_BOTTOM\n*TIE, ADJUST=NO\nSCOLUMN_TOP, SPLATE_BOTTOM\n"
                + self.section())

    def test_force_and_then_length(self):
        """The posts carry the force; then the bolt keeps its length while the plate is pushed, and the posts take all of the push but what the bolt is relieved by."""
        deck = self.bridge()
        tightened = step("*CLOAD", "9999, 1, 10.", times="0.5, 1.")
        first, second, pushed = self.solve(deck + tightened + step("*BOUNDARY, FIXED", "9999, 1", "*DLOAD", *(f"{e}, P2, 0.2" for e in range(4021, 4041))))
        posts = lambda increment: sum(of["normal_force"][2] for name, of in increment["contacts"].items() if name.startswith("SPOST"))
        bolt = lambda increment: next(iter(increment["preloads"].values()))
        for increment, force in ((first, 5), (second, 10)):
            self.assertAlmostEqual(bolt(increment)["force"], force, delta=1e-9 * 10)
            self.assertAlmostEqual(abs(posts(increment)), force, delta=1e-8)
        self.assertAlmostEqual(bolt(pushed)["shortening"], bolt(second)["shortening"], delta=1e-15)
        self.assertLess(bolt(pushed)["force"], 9.9)
        self.assertAlmostEqual(abs(posts(pushed)) - bolt(pushed)["force"], 0.2 * 5, delta=1e-8)

    def test_refused(self):
        deck, push = self.bridge(), "*CLOAD\n9999, 1, 10.\n"
        free = step("*CLOAD", "9999, 1, 10.")
        for changed, sentence in (
                (deck + free + step("*CLOAD", "4001, 3, -1."), "after its step the bolt keeps its force here, and its length in Scabo"),
                (deck + step("*CLOAD", "4001, 3, -1."), "no *CLOAD and no *BOUNDARY tightens the bolt"),
                (deck + free + step("*CLOAD", "9999, 1, 12."), "a bolt is tightened once"),
                (deck.replace("5, S2\n", "", 1) + free, "surface 'CUT' of *PRE-TENSION SECTION is not all of a plane section of body"),
                (deck.replace("5, S2\n", "5, S1\n", 1) + free, "is not all of a plane section of body"),
                (deck.replace("NODE=9999\n", "NODE=9999\n1., 0., 0.\n") + free, "the normal of *PRE-TENSION SECTION is not that of its surface"),
                (deck.replace("NODE=9999", "NODE=1") + free, "node 1 of *PRE-TENSION SECTION is not there, or belongs to an element"),
                (deck.replace("SURFACE=CUT", "SURFACE=NONE") + free, "there is no surface 'NONE' with sides of solid elements for *PRE-TENSION SECTION"),
                (deck.replace("SURFACE=CUT", "ELEMENT=1") + free, "*PRE-TENSION SECTION with ELEMENT is not taken"),
                (deck + free.replace("9999, 1,", "9999, 2,"), "a load along degree of freedom 2 does not act on a reference node"),
        ):
            with self.subTest(sentence=sentence):
                self.assertIn(push, free)
                done = self.convert(changed)
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertIn(sentence, done.stderr)


@unittest.skipIf(support.SANITIZED, "numbers")
class Couplings(OfDecks):
    KINEMATIC = "*COUPLING, REF NODE=9999, SURFACE=SCOLUMN_TOP, CONSTRAINT NAME=c\n*KINEMATIC\n1, 3\n"
    DISTRIBUTING = KINEMATIC.replace("KINEMATIC\n1, 3", "DISTRIBUTING\n1, 6")
    RIGID = "*RIGID BODY, NSET=COLUMN_TOP, REF NODE=9999\n"

    def test_forces_and_moments(self):
        """Reactions are those of the force through the node and of the moment, whatever joins them to the face."""
        force, moment = (3.0, -2.0, 5.0), (0.5, 0.25, -1.0)
        loads = ["*CLOAD"] + [f"9999, {k + 1}, {value}" for k, value in enumerate(force + moment)]
        expected = [-(a + b) for a, b in zip(cross((0.5, 0.5, 6.0), force), moment)]
        for kind in ("C3D20", "C3D10", "C3D8"):
            for coupling in (self.KINEMATIC, self.DISTRIBUTING, self.RIGID):
                with self.subTest(kind=kind, coupling=coupling):
                    increment, = self.solve(column(kind)[0] + coupling + step(*loads))
                    self.assert_vector(increment["reactions"]["COLUMN_BOTTOM"], [-f for f in force], 1e-8)
                    self.assert_vector(increment["moments"]["COLUMN_BOTTOM"], expected, 1e-7)

    def test_driven_plate(self):
        """Bent and stretched without shear, a beam with nu = 0 is quadratic, which its elements are: E A u / L and E I turn / L.
        The end moves with the turn about the node: 2 above it, by -2 times the turn, and a point half-way between by turn / 2 L (L/2)^2."""
        for kind in ("C3D20", "C3D10"):
            deck = column(kind)[0] + self.KINEMATIC
            # u_x of the end is turn * L / 2; at the node, 2 above it, turn * (L / 2 + 2)
            turn = 1e-2
            increment, = self.solve(deck + step("*BOUNDARY", f"REF, 1, 1, {turn * (2.0 + 2.0)}", "REF, 2, 2, 0.", "REF, 3, 3, 0.1", "REF, 4, 4, 0.",
                                                f"REF, 5, 5, {turn}", "REF, 6, 6, 0."))
            reaction, moment = increment["reactions"]["COLUMN_BOTTOM"], increment["moments"]["COLUMN_BOTTOM"]
            axial = 1000 * 0.1 / 4
            self.assert_vector(reaction, [0, 0, -axial], 1e-7)
            self.assert_vector([m - f for m, f in zip(moment, cross((0.5, 0.5, 0), (0, 0, -axial)))], [0, -1000 * turn / 12 / 4, 0], 1e-7)

    def test_node_of_rotations(self):
        """ROT NODE of *RIGID BODY has the rotations as displacements."""
        deck = column("C3D20")[0] + "*NODE, NSET=ROT\n9998, 0., 0., 0.\n*RIGID BODY, NSET=COLUMN_TOP, REF NODE=9999, ROT NODE=9998\n"
        increment, = self.solve(deck + step("*CLOAD", "ROT, 2, 7."))
        self.assert_vector(increment["moments"]["COLUMN_BOTTOM"], [0, -7, 0], 1e-8)

    def test_whole_rigid_body(self):
        """A rigid block on the column, held by its node against turning, presses with the force on the node."""
        lid = block("C3D8", (2, 2, 1), (1.0, 1.0, 1.0), 4.0, 5001, "LID")[0]
        deck = (column()[0].replace(MATERIAL.format("COLUMN"), "") + lid + MATERIAL.format("COLUMN, LID") + surface_of_nodes("LID_BOTTOM") + TOUCH
                + "*CONTACT PAIR, INTERACTION=touch\nSCOLUMN_TOP, SLID_BOTTOM\n")
        for body in ("ELSET=LID", "NSET=WHOLE"):
            whole = "*NSET, NSET=WHOLE\n" + "".join(line.split(",")[0] + "\n" for line in lid.split("*ELEMENT")[0].splitlines()[1:])
            increment, = self.solve(deck + whole + f"*RIGID BODY, {body}, REF NODE=9999\n*BOUNDARY\n9999, 1, 2\n9999, 4, 6\n" + step("*CLOAD", "9999, 3, -8."))
            touch, = increment["contacts"].values()
            self.assertAlmostEqual(abs(touch["normal_force"][2]), 8, delta=1e-8)
            self.assertAlmostEqual(touch["max_pressure"], 8, delta=1e-7)

    def test_refused(self):
        deck, load = column()[0], step("*CLOAD", "9999, 3, 1.")
        for coupling, steps, sentence in (
                (self.KINEMATIC.replace("1, 3", "1, 1"), load, "*KINEMATIC couples the displacements along some axes only"),
                (self.KINEMATIC.replace("*KINEMATIC\n1, 3\n", ""), load, "neither *KINEMATIC nor *DISTRIBUTING follows *COUPLING"),
                (self.KINEMATIC.replace("9999", "1"), load, "node 1 of *COUPLING is not there, or belongs to an element"),
                (self.KINEMATIC.replace("REF NODE=9999, ", ""), load, "*COUPLING has no REF NODE that is the number of a node"),
                (self.KINEMATIC.replace("CONSTRAINT", "ORIENTATION=o, CONSTRAINT"), load, "*COUPLING with ORIENTATION is not taken"),
                (self.KINEMATIC + self.RIGID, load, "node 9999 is that of another condition too"),
                (self.KINEMATIC.replace("SCOLUMN_TOP", "NONE"), load, "there is no surface 'NONE' with outer sides"),
                (self.DISTRIBUTING, step("*BOUNDARY", "9999, 3, 3, 0.1"), "the mean motion of a face is prescribed at node 9999 by *DISTRIBUTING"),
                (self.RIGID.replace("NSET=COLUMN_TOP", "NSET=TWO") + "*NSET, NSET=TWO\nCOLUMN_TOP, COLUMN_BOTTOM\n", load, "'TWO' of *RIGID BODY is not one face of one body"),
                ("*ELSET, ELSET=ONE\n1\n" + self.RIGID.replace("NSET=COLUMN_TOP", "ELSET=ONE"), load, "the elements 'ONE' of *RIGID BODY are not all of one body"),
                (self.KINEMATIC, step("*BOUNDARY", "9999, 7, 7, 0.1"), "degree of freedom 7 is not one of a reference node"),
                ("*EQUATION\n2\n5, 1, 1., 6, 1, -1.\n", load, "this *EQUATION neither leaves one displacement unknown nor ties"),
        ):
            with self.subTest(sentence=sentence):
                done = self.convert(deck + coupling + steps)
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertIn(sentence, done.stderr)
                self.assertFalse((self.directory / "deck.yaml").exists())


if __name__ == "__main__":
    support.main()
