"""`scabo convert` of decks of solids: models in space, against closed forms."""
import unittest

import support
from support import certificate_of, scabo, summary_of

CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
TETRAHEDRA = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]


def block(kind, cells, size, z, first, name):
    """Nodes and elements of a block with one corner at (0, 0, z), and its sets BOTTOM and TOP; the nodes at z = 0 and at x = 0 and y = 0."""
    quadratic = kind in ("C3D20", "C3D20R", "C3D10")
    number = {}
    n = [2 * c for c in cells]
    def node(at):
        return number.setdefault(at, first + len(number))
    elements = []
    for k in range(cells[2]):
        for j in range(cells[1]):
            for i in range(cells[0]):
                corner = [(2 * i + x, 2 * j + y, 2 * k + w) for x, y, w in CORNERS]
                if kind in ("C3D4", "C3D10"):
                    for cell in TETRAHEDRA:
                        at = [corner[c] for c in cell]
                        middle = [tuple((p + q) // 2 for p, q in zip(at[a], at[b])) for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))]
                        elements.append([node(x) for x in at + (middle if quadratic else [])])
                else:
                    middle = [tuple((p + q) // 2 for p, q in zip(corner[a], corner[b])) for a, b in EDGES]
                    elements.append([node(x) for x in corner + (middle if quadratic else [])])
    text = "*NODE\n" + "".join(f"{m}, {size[0] * x / n[0]!r}, {size[1] * y / n[1]!r}, {z + size[2] * w / n[2]!r}\n" for (x, y, w), m in number.items())
    text += f"*ELEMENT, TYPE={kind}, ELSET={name}\n"
    for e, nodes in enumerate(elements):
        listed = [str(first + e)] + [str(m) for m in nodes]
        text += ", ".join(listed[:15]) + (",\n" + ", ".join(listed[15:]) if len(listed) > 15 else "") + "\n"
    for name_of, axis, value in (("BOTTOM", 2, 0), ("TOP", 2, n[2]), ("LEFT", 0, 0), ("FRONT", 1, 0)):
        text += f"*NSET, NSET={name}_{name_of}\n" + "".join(f"{m}\n" for x, m in number.items() if x[axis] == value)
    top = [e for e in range(len(elements)) if e >= len(elements) * (cells[2] - 1) // cells[2]]
    return text, {x: m for x, m in number.items()}, [first + e for e in top]


MATERIAL = "*MATERIAL, NAME=steel\n*ELASTIC\n1000., 0.25\n*DENSITY\n2.\n*SOLID SECTION, ELSET=LOWER, MATERIAL=steel\n*SOLID SECTION, ELSET=UPPER, MATERIAL=steel\n"


@unittest.skipIf(support.SANITIZED, "numbers")
class Numbers(support.InTemporaryDirectory):
    def solve(self, deck):
        (self.directory / "deck.inp").write_text(deck, encoding="utf-8")
        done = scabo("convert", self.directory / "deck.inp", "--force")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        done = scabo("run", self.directory / "deck.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        increments = summary_of(self.directory / "results")["increments"]
        for increment in increments:
            self.assertLessEqual(certificate_of(increment), 1e-10)
        return increments

    def two_blocks(self, kind, load, contact="*CONTACT PAIR, INTERACTION=touch, TYPE=SURFACE TO SURFACE\nSLAVE, MASTER\n"
                   "*SURFACE INTERACTION, NAME=touch\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n*FRICTION\n0.3\n"):
        lower, _, _ = block(kind, (2, 2, 1), (2, 2, 1), 0, 1, "LOWER")
        upper, _, top = block(kind, (3, 3, 1), (2, 2, 1), 1, 1001, "UPPER")
        deck = "*HEADING\nTwo blocks\n" + lower + upper + MATERIAL + "".join(
            f"*SURFACE, NAME={name}, TYPE=NODE\n{of}\n" for name, of in (("MASTER", "LOWER_TOP"), ("SLAVE", "UPPER_BOTTOM")))
        deck += contact + "*BOUNDARY\nLOWER_BOTTOM, 3\nLOWER_LEFT, 1\nLOWER_FRONT, 2\nUPPER_LEFT, XSYMM\nUPPER_FRONT, YSYMM\n*STEP\n*STATIC\n1., 1.\n"
        return deck + load(top) + "*END STEP\n"

    def test_patch_through_contact(self):
        """A constant pressure 5 on non-matching blocks: the same pressure between them, whatever the elements."""
        side = {"C3D8": "P2", "C3D20R": "P2", "C3D4": "P3", "C3D10": "P3"}
        for kind in ("C3D8", "C3D20R", "C3D10", "C3D4"):
            with self.subTest(kind=kind):
                def load(top, kind=kind):
                    if kind in ("C3D8", "C3D20R"):
                        return "*DLOAD\n" + "".join(f"{e}, {side[kind]}, 5.\n" for e in top)
                    return "*DSLOAD\nROOF, P, 5.\n"
                deck = self.two_blocks(kind, load)
                if kind in ("C3D4", "C3D10"):  # of the six tetrahedra of a brick two have a side on top
                    roof = "".join(f"{1001 + 6 * b + t}, S{s}\n" for b in range(9) for t, s in ((3, 3), (4, 3)))
                    deck = deck.replace("*MATERIAL", "*SURFACE, NAME=ROOF\n" + roof + "*MATERIAL", 1)
                increment, = self.solve(deck)
                touch = increment["contacts"]["touch"]
                self.assertAlmostEqual(touch["normal_force"][2], 20, delta=1e-9 * 20)
                self.assertAlmostEqual(touch["max_pressure"], 5, delta=1e-8)
                self.assertAlmostEqual(sum(force[2] for force in increment["reactions"].values()), 20, delta=1e-9 * 20)

    def test_gravity_displacement_and_force(self):
        """Weight 2 x 9.81 x 4 of each block; then the upper one is pressed down by a node and its side is pushed."""
        def load(top):
            return "*DLOAD\nUPPER, GRAV, 9.81, 0., 0., -1.\nLOWER, GRAV, 9.81, 0., 0., -2.\n*CLOAD\n1001, 3, -7.\n*END STEP\n*STEP\n*STATIC\n0.5, 1.\n*BOUNDARY\nUPPER_LEFT, 1, 1, 0.1\n"
        deck = self.two_blocks("C3D8", load).replace("UPPER_LEFT, XSYMM", "UPPER_LEFT, 1")
        increments = self.solve(deck)
        self.assertEqual(len(increments), 3)
        weight = 2 * 9.81 * 4
        for increment in increments:
            self.assertAlmostEqual(increment["contacts"]["touch"]["normal_force"][2], weight + 7, delta=1e-9 * weight)
            self.assertAlmostEqual(sum(force[2] for force in increment["reactions"].values()), 2 * weight + 7, delta=1e-9 * weight)
        self.assertAlmostEqual(abs(increments[-1]["contacts"]["touch"]["tangential_force"][0]), 0.3 * (weight + 7), delta=0.01 * weight)

    def test_tie(self):
        """Pulled upwards: the tie holds what a contact would not."""
        deck = self.two_blocks("C3D20R", lambda top: "*DLOAD\n" + "".join(f"{e}, P2, -5.\n" for e in top),
                               contact="*TIE, NAME=glue\nSLAVE, MASTER\n")
        increment, = self.solve(deck)
        tie, = increment["contacts"].values()
        self.assertAlmostEqual(tie["normal_force"][2] + tie["tangential_force"][2], -20, delta=1e-9 * 20)


class Refused(support.InTemporaryDirectory):
    def test_with_a_sentence(self):
        deck = Numbers.two_blocks(None, "C3D8", lambda top: "*CLOAD\n1001, 3, -7.\n")
        for old, new, sentence in (
                ("*BOUNDARY", "*EQUATION\n2\n1, 1, 1., 2, 1, -1.\n*BOUNDARY", "*EQUATION joins degrees of freedom"),
                ("*BOUNDARY", "*PRE-TENSION SECTION, SURFACE=MASTER, NODE=1\n*BOUNDARY", "*PRE-TENSION SECTION tightens a bolt"),
                ("*BOUNDARY", "*COUPLING, REF NODE=1, SURFACE=MASTER, CONSTRAINT NAME=c\n*BOUNDARY", "*COUPLING joins degrees of freedom"),
                ("SLAVE, MASTER", "MASTER, MASTER", "each of both surfaces must be of one body, and not of the same"),
                ("SLAVE, MASTER", "NONE, MASTER", "there is no surface 'NONE' with outer sides of solid elements"),
                ("INTERACTION=touch,", "INTERACTION=touch, ADJUST=0.1,", "ADJUST moves nodes, which is not done in space"),
                ("*STEP\n", "*STEP, NLGEOM\n", "*STEP with NLGEOM asks for large displacements"),
                ("1001, 3, -7.", "1001, 4, -7.", "a load along degree of freedom 4 does not act on a solid and is lost"),
                ("1001, 3, -7.", "9999, 3, -7.", "the force at node 9999, which belongs to no solid element, is lost"),
                ("*CLOAD\n", "*DLOAD\nUPPER, BZ, 3.\n*CLOAD\n", "forces per volume (BX, BY, BZ) and rotation (CENTRIF) are not taken in space"),
                ("*CLOAD\n", "*DLOAD\n1001, P7, 3.\n*CLOAD\n", "a distributed load of type 'P7' is not taken; there are P1 to P6 and GRAV"),
                ("*CLOAD\n", "*END STEP\n*STEP\n*STATIC\n1., 1.\n*BOUNDARY, OP=NEW\nLOWER_BOTTOM, 3\n*CLOAD\n", "begins or ends in step 2, which supports in space do not"),
                ("PRESSURE-OVERCLOSURE=HARD\n", "PRESSURE-OVERCLOSURE=LINEAR\n1000.\n", "the stiffness of contact is so small"),
                ("MATERIAL=steel\n*SOLID SECTION, ELSET=UPPER, MATERIAL=steel", "MATERIAL=steel", "have no material; add a *SOLID SECTION"),
        ):
            with self.subTest(sentence=sentence):
                self.assertIn(old, deck)
                (self.directory / "deck.inp").write_text(deck.replace(old, new, 1), encoding="utf-8")
                done = scabo("convert", self.directory / "deck.inp", "--force")
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertIn(sentence, done.stderr)
                self.assertFalse((self.directory / "deck.yaml").exists())


if __name__ == "__main__":
    support.main()
