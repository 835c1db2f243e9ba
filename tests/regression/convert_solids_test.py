"""`scabo convert` of decks of solids: models in space, against closed forms."""
import math
import re
import unittest

import support
from decks import block
from solid_directions_test import ANGLE, bricks, tube
from solid_twins_test import product, rotation
from solids import increments_of_deck
from support import scabo, summary_of

MATERIAL = "*MATERIAL, NAME=steel\n*ELASTIC\n1000., 0.25\n*DENSITY\n2.\n*SOLID SECTION, ELSET=LOWER, MATERIAL=steel\n*SOLID SECTION, ELSET=UPPER, MATERIAL=steel\n"


@unittest.skipIf(support.SANITIZED, "numbers")
class Numbers(support.InTemporaryDirectory):
    def solve(self, deck):
        return increments_of_deck(self, deck)

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


    def test_large_displacements(self):
        """NLGEOM is read; the run says where displacements are not small, and where a body turns."""
        for way, sentence in ((1e-3, None), (0.5, "displacements of body 'LOWER' reach")):
            with self.subTest(way=way):
                deck = self.two_blocks("C3D8", lambda top, way=way: f"*BOUNDARY\nUPPER_TOP, 3, 3, {-way}\n").replace("*STEP", "*STEP, NLGEOM")
                self.solve(deck)
                warnings = " ".join(summary_of(self.directory / "results")["warnings"])
                log = (self.directory / "results" / "log.txt").read_text(encoding="utf-8")
                self.assertEqual("the theory is valid" in warnings, sentence is not None, warnings)
                if sentence:
                    self.assertIn("step step_1, increment 1: " + sentence, warnings)
                    self.assertIn(sentence, log)

    def test_amplitude_that_jumps(self):
        """A load that is there from the start of the step acts in every increment."""
        deck = self.two_blocks("C3D8", lambda top: "*DLOAD, AMPLITUDE=whole\n" + "".join(f"{e}, P2, 5.\n" for e in top))
        deck = deck.replace("*STATIC\n1., 1.", "*STATIC\n0.25, 1.").replace("*BOUNDARY", "*AMPLITUDE, NAME=whole\n0., 1., 1., 1.\n*BOUNDARY", 1)
        increments = self.solve(deck)
        self.assertEqual(len(increments), 4)
        for increment in increments:
            self.assertAlmostEqual(increment["contacts"]["touch"]["normal_force"][2], 20, delta=1e-9 * 20)

    def test_mesh_in_another_file(self):
        """What the deck includes tells that it is one of solids."""
        deck = self.two_blocks("C3D8", lambda top: "*DLOAD\n" + "".join(f"{e}, P2, 5.\n" for e in top))
        head, rest = deck.split("*MATERIAL", 1)
        (self.directory / "mesh.msh").write_text(head, encoding="utf-8")
        increment, = self.solve("*INCLUDE, INPUT=mesh.msh\n*MATERIAL" + rest)
        self.assertAlmostEqual(increment["contacts"]["touch"]["normal_force"][2], 20, delta=1e-9 * 20)

    def test_temperature(self):
        """A block between held faces, with nu = 0: the stress E alpha T of the change from the initial temperature, over two steps."""
        text, _, _ = block("C3D20R", (2, 2, 1), (2, 2, 1), 0, 1, "LOWER")
        deck = (text + "*NSET, NSET=WHOLE\n" + "".join(line.split(",")[0] + "\n" for line in text.split("*ELEMENT")[0].splitlines()[1:])
                + "*MATERIAL, NAME=steel\n*ELASTIC\n1000., 0.\n*EXPANSION\n1e-3\n*SOLID SECTION, ELSET=LOWER, MATERIAL=steel\n"
                + "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nWHOLE, 20.\n*BOUNDARY\nLOWER_BOTTOM, 3\nLOWER_LEFT, 1\nLOWER_FRONT, 2\n*STEP\n*STATIC\n0.5, 1.\n"
                + "*BOUNDARY\nLOWER_TOP, 3, 3, 1e-3\n*TEMPERATURE\nWHOLE, 50.\n*END STEP\n*STEP\n*STATIC\n*TEMPERATURE, OP=NEW\nWHOLE, 10.\n*END STEP\n")
        increments = self.solve(deck)
        pushes = [increment["reactions"]["LOWER_TOP"][2] for increment in increments]
        for found, change, way in zip(pushes, (15, 30, -10), (0.5e-3, 1e-3, 1e-3), strict=True):
            self.assertAlmostEqual(found, 4 * 1000 * (way - 1e-3 * change), delta=1e-9 * 120)
        for old, new, sentence in (("WHOLE, 50.", "LOWER_TOP, 50.", "the change of temperature is not the same at all nodes of body 'LOWER'"),
                                   ("*TEMPERATURE\n", "*TEMPERATURE, FILE=x\n", "*TEMPERATURE with FILE is not taken"),
                                   ("*STEP\n*STATIC\n0.5, 1.\n", "*AMPLITUDE, NAME=a\n0., 0., 1., 1.\n*STEP\n*STATIC\n0.5, 1.\n*TEMPERATURE, AMPLITUDE=a\nWHOLE, 50.\n", "with an initial one that is not 0 is not taken")):
            (self.directory / "deck.inp").write_text(deck.replace(old, new, 1), encoding="utf-8")
            done = scabo("convert", self.directory / "deck.inp", "--force")
            self.assertEqual(done.returncode, 1)
            self.assertIn(sentence, done.stderr)

    def test_adjust(self):
        """Nodes of the slave within the distance, or of the set, are moved onto the master: blocks that are 0.01 apart touch from the start."""
        deck = self.two_blocks("C3D8", lambda top: "*BOUNDARY\nUPPER_TOP, 3, 3, -0.02\n").replace("LOWER_BOTTOM, 3", "LOWER_BOTTOM, 3\nUPPER_BOTTOM, 1, 2")
        apart = re.sub(r"(?m)^(1\d\d\d, .*), 1\.0$", r"\1, 1.01", deck)
        self.assertNotEqual(apart, deck)
        forces = {}
        for name, text in (("apart", apart), ("within", apart.replace("INTERACTION=touch,", "INTERACTION=touch, ADJUST=0.011,")),
                           ("set", apart.replace("INTERACTION=touch,", "INTERACTION=touch, ADJUST=UPPER_BOTTOM,")),
                           ("too far", apart.replace("INTERACTION=touch,", "INTERACTION=touch, ADJUST=0.009,"))):
            increment, = self.solve(text)
            forces[name] = increment["contacts"]["touch"]["normal_force"][2]
        self.assertAlmostEqual(forces["within"], forces["set"], delta=1e-9 * forces["set"])
        self.assertAlmostEqual(forces["apart"], forces["too far"], delta=1e-12)
        self.assertGreater(forces["within"], 1.9 * forces["apart"])
        bent = apart.replace("INTERACTION=touch,", "INTERACTION=touch, ADJUST=0.011,")
        bent = re.sub(r"(?m)^(\d\d?, .*), 1\.0$", r"\1, 1.001", bent, count=1)
        (self.directory / "deck.inp").write_text(bent, encoding="utf-8")
        done = scabo("convert", self.directory / "deck.inp", "--force")
        self.assertEqual(done.returncode, 1)
        self.assertIn("ADJUST moves nodes onto a plane master only", done.stderr)

    def test_rigid_contact(self):
        """A soft contact, or one that presses before it touches, is a hard one if the user says so."""
        deck = self.two_blocks("C3D8", lambda top: "*DLOAD\n" + "".join(f"{e}, P2, 5.\n" for e in top))
        for law, what in (("LINEAR\n1000.", "the stiffness of contact is so small"), ("TABULAR\n0., 0.\n1., 1e-3", "the stiffness of contact is so small"), ("EXPONENTIAL\n1e-3, 5.", "presses before the surfaces touch")):
            (self.directory / "deck.inp").write_text(deck.replace("HARD", law), encoding="utf-8")
            done = scabo("convert", self.directory / "deck.inp", "--force", "--rigid-contact")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stderr, f"warning: [^\n]*{what}[^\n]*by --rigid-contact it is left out")
            done = scabo("run", self.directory / "deck.yaml", "-o", self.directory / "results", "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            increment, = summary_of(self.directory / "results")["increments"]
            self.assertAlmostEqual(increment["contacts"]["touch"]["max_pressure"], 5, delta=1e-8)

    def test_axes_of_nodes(self):
        """The same blocks turned, with supports along axes of their nodes."""
        pressure = lambda top: "*DLOAD\n" + "".join(f"{e}, P2, 5.\n" for e in top) + "*BOUNDARY\nUPPER_LEFT, 1, 1, 0.01\n"
        deck = self.two_blocks("C3D8", pressure).replace("UPPER_LEFT, XSYMM", "UPPER_LEFT, 1")
        one = self.solve(deck)[-1]
        turn = rotation(9)
        turned = re.sub(r"(?m)^(\d+), (\S+), (\S+), (\S+)$",
                        lambda line: f"{line[1]}, " + ", ".join(repr(x) for x in product(turn, [float(line[k]) for k in (2, 3, 4)])), deck)
        first, second = (product(turn, axis) for axis in ([2, 0, 0], [1, 3, 0]))
        turned = turned.replace("*MATERIAL", "".join(f"*TRANSFORM, NSET={name}_{side}\n{', '.join(repr(x) for x in (*first, *second))}\n"
                                                     for name in ("LOWER", "UPPER") for side in ("BOTTOM", "LEFT", "FRONT")) + "*MATERIAL", 1)
        other = self.solve(turned)[-1]
        force = math.hypot(*one["contacts"]["touch"]["normal_force"])
        for kind in ("normal_force", "tangential_force"):
            for a, b in zip(product(turn, one["contacts"]["touch"][kind]), other["contacts"]["touch"][kind]):
                self.assertAlmostEqual(a, b, delta=1e-8 * force)
        for axis in range(3):
            a, b = (sum(vector[axis] for vector in reactions) for reactions in
                    ([product(turn, of) for of in one["reactions"].values()], other["reactions"].values()))
            self.assertAlmostEqual(a, b, delta=1e-8 * force)
        self.assertAlmostEqual(one["energy"]["elastic"], other["energy"]["elastic"], delta=1e-8 * one["energy"]["elastic"])

    TUBE = bricks(tube(1.0, 2.0, ANGLE, 0.5), (3, 3, 1)) + MATERIAL.split("*SOLID")[0] + """*SOLID SECTION, ELSET=ALL, MATERIAL=steel
*TRANSFORM, NSET=LOW_2, TYPE=C
0., 0., 0., 0., 0., 1.
*TRANSFORM, NSET=HIGH_2, TYPE=C
0., 0., 0., 0., 0., 1.
*TRANSFORM, NSET=HIGH_1, TYPE=C
0., 0., -3., 0., 0., 7.
*BOUNDARY
LOW_2, 2
HIGH_2, 2
LOW_3, 3
HIGH_3, 3
*STEP
*STATIC
*DLOAD
1, P6, 1.
2, P6, 1.
3, P6, 1.
*END STEP
"""

    def test_axes_about_a_line(self):
        """A sector of a tube is held across its two planes, which then have the force of the hoop; its outside in a bearing has no force from it."""
        increment, = self.solve(self.TUBE)
        forces = sorted((math.hypot(*force), force) for force in increment["reactions"].values())
        for size, force in forces[-2:]:
            self.assertAlmostEqual(size, 0.5, delta=1e-8)
        self.assertAlmostEqual(sum(force[0] for _, force in forces), -0.5 * math.sin(ANGLE), delta=1e-8)
        increment, = self.solve(self.TUBE.replace("*STEP", "HIGH_1, 1\n*STEP", 1))
        self.assertIn("fix: normal", (self.directory / "deck.yaml").read_text(encoding="utf-8"))
        self.assertAlmostEqual(sum(force[0] for force in increment["reactions"].values()), -0.5 * math.sin(ANGLE), delta=1e-8)

    def test_several_axes_of_clamped_nodes(self):
        """Axes of two systems under one label, which is driven along the one that they share; at the other end all is fixed, and axes do not matter."""
        text, _, _ = block("C3D10", (2, 2, 2), (2, 2, 1), 0, 1, "LOWER")
        deck = text + MATERIAL.split("*SOLID")[0] + "*SOLID SECTION, ELSET=LOWER, MATERIAL=steel\n*BOUNDARY\nLOWER_TOP, 1, 3\nLOWER_BOTTOM, 1, 3\n*STEP\n*STATIC\n*BOUNDARY\nLOWER_BOTTOM, 3, 3, 0.01\n*END STEP\n"
        energy = self.solve(deck)[-1]["energy"]["elastic"]
        self.assertGreater(energy, 0.5 * 1000 * 4 * 0.01**2)  # that of a bar with free ends, and more
        axes = "".join(f"*TRANSFORM, NSET=LOWER_{side}\n{math.cos(angle)!r}, {math.sin(angle)!r}, 0., {-math.sin(angle)!r}, {math.cos(angle)!r}, 0.\n"
                       for side, angle in (("LEFT", 0.2), ("RIGHT", 0.5)))
        turned = self.solve(deck.replace("*MATERIAL", axes + "*MATERIAL", 1))[-1]["energy"]["elastic"]
        self.assertAlmostEqual(turned, energy, delta=1e-9 * energy)
        text = (self.directory / "deck.yaml").read_text(encoding="utf-8")
        self.assertEqual(text.count("along: ["), 4, text)

    def test_a_clamped_flange(self):
        """The end of a tube is fixed in all directions: radii, which turn from node to node, do not matter there, and the bearing around it goes on to its edge."""
        head, tail = self.TUBE.split("*TRANSFORM", 1)
        tail = tail[tail.index("*STEP"):]
        axes = "*TRANSFORM, NSET={}, TYPE=C\n0., 0., 0., 0., 0., 1.\n"
        text = {}
        for name, transforms, bearing in (("free", "", ""), ("flange", axes.format("HIGH_3"), ""), ("bearing", axes.format("HIGH_1"), "HIGH_1, 1\n"),
                                          ("both", axes.format("HIGH_1") + axes.format("HIGH_3"), "HIGH_1, 1\n")):
            self.solve(head + transforms + "*BOUNDARY\nHIGH_3, 1, 3\n" + bearing + tail)
            text[name] = (self.directory / "deck.yaml").read_text(encoding="utf-8")
        self.assertIn("HIGH_3, fix: [x, y, z], name: HIGH_3}", text["free"])
        self.assertEqual(text["flange"], text["free"])
        self.assertEqual(text["both"], text["bearing"])
        self.assertIn("HIGH_1, fix: normal, name: HIGH_1}", text["both"])
        mesh = (self.directory / "deck_mesh.inp").read_text(encoding="utf-8")
        self.assertEqual(len(re.search(r"NAME=HIGH_1, TYPE=ELEMENT\n((?:\d+, S\d\n)+)", mesh)[1].splitlines()), 6)  # of three quadrilaterals

    def test_a_shaft_in_a_bearing(self):
        """A prism on an octagon whose nodes all lie on one cylinder: held along the radii, it is pressed in uniaxial strain, and its ends, between nodes of the rim alone, move."""
        levels, number = 3, lambda level, k: 1 + 8 * level + k
        deck = "*NODE\n" + "".join(f"{number(level, k)}, {math.cos(k * math.pi / 4)!r}, {math.sin(k * math.pi / 4)!r}, {level!r}.\n" for level in range(levels) for k in range(8))
        wedges = [[number(level + up, k) for up in (0, 1) for k in (0, i, i + 1)] for level in range(levels - 1) for i in range(1, 7)]
        deck += "*ELEMENT, TYPE=C3D6, ELSET=SHAFT\n" + "".join(f"{e + 1}, " + ", ".join(map(str, nodes)) + "\n" for e, nodes in enumerate(wedges))
        deck += "".join(f"*NSET, NSET={name}, GENERATE\n{first}, {last}\n" for name, first, last in (("RIM", 1, 8 * levels), ("BOTTOM", 1, 8), ("TOP", 8 * levels - 7, 8 * levels)))
        deck += MATERIAL.split("*SOLID")[0] + ("*SOLID SECTION, ELSET=SHAFT, MATERIAL=steel\n*TRANSFORM, NSET=RIM, TYPE=C\n0., 0., 0., 0., 0., 1.\n*BOUNDARY\nRIM, 1\nBOTTOM, 3\n*STEP\n*STATIC\n*DLOAD\n"
                                              + "".join(f"{e}, P2, 6.\n" for e in range(len(wedges) - 5, len(wedges) + 1)) + "*END STEP\n")
        increment, = self.solve(deck)
        area, modulus = 2 * math.sqrt(2), 1000 * 0.75 / (1.25 * 0.5)
        self.assertAlmostEqual(sum(force[2] for force in increment["reactions"].values()), 6 * area, delta=1e-8)
        energy = 0.5 * 6**2 / modulus * area * (levels - 1)
        self.assertAlmostEqual(increment["energy"]["elastic"], energy, delta=1e-8 * energy)
        (self.directory / "deck.inp").write_text(deck.replace("RIM, 1\n", "TOP, 1\n"), encoding="utf-8")  # no side is held along its normal
        done = scabo("convert", self.directory / "deck.inp", "--force")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.directory / "deck.yaml").read_text(encoding="utf-8")
        self.assertNotIn("fix: normal", text)
        self.assertEqual(text.count("fix: {along: ["), 2, text)  # and along x and y

    def test_axes_of_a_reference_node(self):
        """Alone or beside nodes of elements: what *BOUNDARY means there is not lost in silence."""
        text, _, _ = block("C3D8", (2, 2, 1), (2, 2, 1), 0, 1, "LOWER")
        deck = (text + "*NODE, NSET=REF\n9999, 1., 1., 3.\n*NSET, NSET=BOTH\nLOWER_TOP, 9999\n*SURFACE, NAME=ROOF, TYPE=NODE\nLOWER_TOP\n" + MATERIAL.split("*SOLID")[0]
                + "*SOLID SECTION, ELSET=LOWER, MATERIAL=steel\n*COUPLING, CONSTRAINT NAME=c, REF NODE=9999, SURFACE=ROOF\n*KINEMATIC\n1, 3\n*BOUNDARY\nLOWER_BOTTOM, 1, 3\n9999, 1, 6\n"
                "*STEP\n*STATIC\n*BOUNDARY\n9999, 1, 1, 0.01\n*END STEP\n")
        self.solve(deck)
        for nodes in ("REF", "9999", "BOTH"):
            with self.subTest(nodes=nodes):
                (self.directory / "deck.inp").write_text(deck.replace("*COUPLING", f"*TRANSFORM, NSET={nodes}\n0., 1., 0., -1., 0., 0.\n*COUPLING", 1), encoding="utf-8")
                done = scabo("convert", self.directory / "deck.inp", "--force")
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertIn("node 9999 of *TRANSFORM is a reference node, whose axes are not taken", done.stderr)
                self.assertNotIn("there is no node set", done.stderr)

    def test_axes_that_are_refused(self):
        for old, new, sentence in (
                ("*DLOAD\n", "*CLOAD\nLOW_2, 1, 3.\n*DLOAD\n", "the force acts along axes of the node by *TRANSFORM, which is not taken"),
                ("LOW_2, 2\n", "HIGH_1, 2\n", "the axes of 'HIGH_1' by *TRANSFORM turn from node to node"),
                ("LOW_2, 2\n", "LOW_2, 1\n", "are held along radii by *TRANSFORM, and do not lie on one cylinder"),
                ("NSET=LOW_2, TYPE=C", "NSET=LOW_2, TYPE=S", "TYPE"),
                ("NSET=LOW_2, TYPE=C", "NSET=NONE, TYPE=C", "there is no node set 'NONE' with nodes of elements for *TRANSFORM"),
                ("0., 0., 0., 0., 0., 1.\n", "0., 0., 0., 0., 0., 0.\n", "lies on the axis"),
                ("0., 0., 0., 0., 0., 1.\n", "0., 0., 0.\n", "a point of *TRANSFORM"),
                ("*MATERIAL", "*EQUATION\n2\n1, 1, 1., 2, 1, -1.\n*MATERIAL", "has axes of its own by *TRANSFORM, which is not taken")):
            with self.subTest(sentence=sentence):
                self.assertIn(old, self.TUBE)
                (self.directory / "deck.inp").write_text(self.TUBE.replace(old, new, 1), encoding="utf-8")
                done = scabo("convert", self.directory / "deck.inp", "--force")
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertIn(sentence, done.stderr)


class Refused(support.InTemporaryDirectory):
    def test_with_a_sentence(self):
        deck = Numbers.two_blocks(None, "C3D8", lambda top: "*CLOAD\n1001, 3, -7.\n")
        for old, new, sentence in (
                ("SLAVE, MASTER", "MASTER, MASTER", "the two surfaces do not face each other, and the contact is lost"),
                ("ELSET=LOWER\n1, 1,", "ELSET=LOWER\n1, -1,", "cell 1 has the node -1; numbers of nodes are positive"),
                ("SLAVE, MASTER", "NONE, MASTER", "there is no surface 'NONE' with outer sides of solid elements"),
                ("PRESSURE-OVERCLOSURE=HARD\n", "PRESSURE-OVERCLOSURE=EXPONENTIAL\n1e-3, 5.\n", "presses before the surfaces touch"),
                ("1001, 3, -7.", "1001, 4, -7.", "a load along degree of freedom 4 does not act on a solid and is lost"),
                ("1001, 3, -7.", "9999, 3, -7.", "the force at node 9999, which belongs to no solid element, is lost"),
                ("*CLOAD\n", "*DLOAD\nUPPER, BZ, 3.\n*CLOAD\n", "forces per volume (BX, BY, BZ) and rotation (CENTRIF) are not taken in space"),
                ("*CLOAD\n", "*DLOAD\n1001, P7, 3.\n*CLOAD\n", "a distributed load of type 'P7' is not taken; there are P1 to P6 and GRAV"),
                ("*CLOAD\n", "*END STEP\n*STEP\n*STATIC\n1., 1.\n*BOUNDARY, OP=NEW\nLOWER_BOTTOM, 3\n*CLOAD\n", "begins or ends in step 2, which supports in space do not"),
                ("PRESSURE-OVERCLOSURE=HARD\n", "PRESSURE-OVERCLOSURE=TABULAR\n0., 0.\n1., 1e-3\n", "the stiffness of contact is so small"),
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
