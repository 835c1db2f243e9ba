"""Parameters of decks: every one that docs/convert.md lists does what the table says, and moves what it moves."""
import re

import support
from decks import END, HELD, MATERIAL, PRESSED, SQUARE, STATIC, Converting, grid

HEAD = "| keyword | taken | without effect | refused |"


def table():
    """Keyword: parameters taken, without effect and refused, each as (name, value)."""
    lines = (support.ROOT / "docs" / "convert.md").read_text(encoding="utf-8").splitlines()
    rows = {}
    for line in lines[lines.index(HEAD) + 2:]:
        if not line.startswith("|"):
            return rows
        cells = line.strip("|").split("|")
        keyword = re.search(r"`(.*?)`", cells[0])[1]
        if keyword == "*TRANSFORM":  # of solids alone: convert_solids_test.py
            continue
        rows[keyword] = []
        for cell in cells[1:]:
            found, name = [], None
            for word in re.findall(r"`(.*?)`", cell):
                if "=" in word:
                    name, value = word.split("=")
                elif name == "PRESSURE-OVERCLOSURE" and word in ("LINEAR", "TABULAR", "TIED", "EXPONENTIAL"):
                    value = word
                else:
                    name, value = word, None
                found.append((name, value))
            rows[keyword].append(found)
    return rows


CONTACT = ("*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e15\n*FRICTION\n0.3\n"
           "*CONTACT PAIR, INTERACTION=I\nTOP_BOTTOM, LOW_TOP\n")
WHOLE = ("*PART, NAME=P\n" + grid(1, 1, 1.0, 1.0, kind="CPE4", elset="PART") + "*ELSET, ELSET=ALL\n1\n*END PART\n*ASSEMBLY, NAME=A\n"
         "*INSTANCE, NAME=P-1, PART=P\n9., 0., 0.\n*END INSTANCE\n*END ASSEMBLY\n"
         + grid(2, 2, 2.0, 2.0, kind="CPE4", elset="LOW") + grid(2, 2, 2.0, 2.0, first=101, corner=(0.0, 2.0), kind="CPE4", elset="TOP")
         + grid(2, 2, 2.0, 2.0, first=201, corner=(2.0, 0.0), kind="CPE4", elset="SIDE") + MATERIAL
         + "*EXPANSION\n1e-5\n*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\n*AMPLITUDE, NAME=A\n0., 0., 1., 1.\n"
         "*ELSET, ELSET=EVERY\nLOW, TOP, SIDE, P-1.PART\n*SOLID SECTION, ELSET=EVERY, MATERIAL=steel\n" + CONTACT
         + "*CONTACT CONTROLS\n*TIE\nLOW_RIGHT, SIDE_LEFT\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nN_LOW_BOTTOM, 20.\n"
         "*BOUNDARY\nN_LOW_BOTTOM, 1, 2\nN_TOP_LEFT, 1\nP-1.N_PART_BOTTOM, 1, 2\n" + STATIC
         + "*CLOAD\n109, 2, -5.\n*DLOAD\n103, P3, 7.\n*DSLOAD\nTOP_RIGHT, P, 1e3\n*RESTART, WRITE\n" + END
         + "*STEP\n*STATIC\n*CHANGE FRICTION, INTERACTION=I\n*FRICTION\n0.2\n" + END)

VALUES = {"NSET": "NEW", "ELSET": "NEW", "INC": "100", "ADJUST": "0.1", "AMPLITUDE": "A", "POSITION TOLERANCE": "0.1",
          "NAME": "NEW", "SOLVER": "PARDISO", "ORIENTATION": "O", "EXTRAPOLATION": "LINEAR", "MODULI": "INSTANTANEOUS"}
FLAGS = {"INTERNAL", "UNSORTED", "NO THICK", "NO OFFSET", "UNSYMM", "PENALTY", "AUGMENTED LAGRANGE", "DIRECT", "LAGRANGE", "SMALL SLIDING",
         "NO THICKNESS", "NO ROTATION"}


class TheTable(Converting):
    def changed(self, keyword, name, value):
        """The deck with a parameter of the keyword; nothing where it needs more than a word and has a test of its own."""
        if value == "EXPONENTIAL" or name in ("INPUT", "GENERATE", "INSTANCE") and keyword not in ("*INSTANCE",) or (keyword, name) in (
                ("*NSET", "ELSET"), ("*NODE", "NSET"), ("*ELASTIC", "TYPE"), ("*EXPANSION", "TYPE"), ("*SOLID SECTION", "ORIENTATION")):
            return None if value not in ("ISO",) else WHOLE.replace(keyword + "\n", f"{keyword}, {name}={value}\n")
        if value is None:
            value = None if name in FLAGS else VALUES.get(name, "1")
        deck = WHOLE.replace(", " + "PRESSURE-OVERCLOSURE=LINEAR\n1e15", "\n") if name == "PRESSURE-OVERCLOSURE" else WHOLE
        word = name if value is None else f"{name}={value}"
        data = {"LINEAR": "1e15\n", "TABULAR": "0., 0.\n1e12, 1e-3\n", "EXPONENTIAL": "1e-3, 1e6\n"}.get(value, "") * (name == "PRESSURE-OVERCLOSURE")
        head = re.search(rf"(?m)^{re.escape(keyword)}\b.*$", deck)[0]
        present = rf", {re.escape(name)}(=[^,\n]*)?(?=,|$)"
        if re.search(present, head):  # it has one already
            return deck if value in VALUES.values() or value == "1" else deck.replace(head, re.sub(present, ", " + word, head), 1)
        return deck.replace(head + "\n", f"{head}, {word}\n{data}", 1)

    def test_the_whole_deck(self):
        run = self.convert(WHOLE)
        self.assertEqual(run.returncode, 0, run.stderr)
        for keyword in table():
            self.assertRegex(WHOLE, rf"(?m)^{re.escape(keyword)}\b")

    def test_what_is_taken_or_has_no_effect(self):
        count = 0
        for keyword, (taken, harmless, _) in table().items():
            for name, value in taken + harmless:
                deck = self.changed(keyword, name, value)
                if deck is None:
                    continue
                count += 1
                with self.subTest(keyword=keyword, parameter=name, value=value):
                    run = self.convert(deck)
                    self.assertEqual(run.returncode, 0, run.stderr)
        self.assertGreater(count, 60)

    def test_what_is_refused(self):
        for keyword, (_, _, refused) in table().items():
            for name, value in refused + [("STRANGE", None)]:
                if name == "STRANGE" and keyword in ("*CONTACT CONTROLS", "*INITIAL CONDITIONS", "*RESTART"):
                    continue
                with self.subTest(keyword=keyword, parameter=name, value=value):
                    run = self.convert(self.changed(keyword, name, value))
                    self.assertEqual(run.returncode, 1, run.stderr)
                    self.assertTrue(name.split()[0] in run.stderr or keyword in run.stderr, run.stderr)
                    self.assertRegex(run.stderr, r"part\.inp:\d+")

    def test_names_keep_their_blanks(self):
        """Messages show keywords and parameters as the deck writes them."""
        run = self.convert(SQUARE + "*Node  print, nset=N_BODY_TOP\nU\n*Strange key  word\n*Contact pair, no separation\nBODY_TOP, BODY_LEFT\n" + HELD + PRESSED)
        self.assertIn("*NODE PRINT requests output", run.stderr)
        self.assertIn("*STRANGE KEY WORD is not known", run.stderr)
        self.assertIn("*CONTACT PAIR with NO SEPARATION is not taken", run.stderr)
        run = self.convert(SQUARE + "*Surface Interaction, name=i\n*SurfaceBehavior, NoSeparation\n" + HELD + PRESSED)
        self.assertIn("*SURFACEBEHAVIOR with NO SEPARATION is contact that does not open", run.stderr)

    def test_entries_that_nothing_reads(self):
        for old, new in (("2, -5.", "2, -5., 7."), ("P, 1e3", "P, 1e3, 1., 0."), ("103, P3, 7.", "103, P3, 7., 8."), ("*FRICTION\n0.3\n", "*FRICTION\n0.3\n0.4\n"),
                         ("*STATIC\n", "*STATIC\n0.1, 1.\n0.1, 1.\n"), ("TOP_BOTTOM, LOW_TOP", "TOP_BOTTOM, LOW_TOP, O")):
            with self.subTest(new=new):
                run = self.convert(WHOLE.replace(old, new))
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertIn("one more", run.stderr)


class Nodes(Converting):
    """ADJUST: two blocks of E = 1000 and nu = 0, 1 high as drawn on each other, whose sides overlap or are apart."""

    def blocks(self, offset, parameters="", more="", nu=0.0, contact="*CONTACT PAIR, INTERACTION=I{}\nUPPER_BOTTOM, LOWER_TOP\n",
               pushed=-1e-3, kind="CPE4"):
        return (grid(2, 1, 2.0, 1.0, elset="LOWER", kind=kind)
                + grid(2, 1, 2.0, 1.0 - offset, first=101, corner=(0.0, 1.0 + offset), elset="UPPER", kind=kind)
                + f"*MATERIAL, NAME=S\n*ELASTIC\n1000., {nu}\n*ELSET, ELSET=ALL\nLOWER, UPPER\n*SOLID SECTION, ELSET=ALL, MATERIAL=S\n1.\n{more}"
                "*SURFACE INTERACTION, NAME=I\n*FRICTION\n0.3\n" + contact.format(parameters)
                + f"*BOUNDARY\nN_LOWER_BOTTOM, 1, 2\nN_UPPER_TOP, 1\n*STEP\n*STATIC\n*BOUNDARY\nN_UPPER_TOP, 2, 2, {pushed}\n" + END)

    def force(self, deck):
        """On the upper block's top."""
        return self.solved(deck)["increments"][-1]["reactions"]["N_UPPER_TOP"][1]

    def test_overlapping_nodes_are_moved(self):
        """Without strain: 2 m of height are compressed by 1 mm, F = E w d / h = 1."""
        for parameters in (", ADJUST=0.1", ", ADJUST=0.", ", ADJUST=N_UPPER_BOTTOM", ", ADJUST=0.1, TYPE=SURFACE TO SURFACE"):
            for kind in ("CPE4", "CPE8"):
                with self.subTest(parameters=parameters, kind=kind):
                    self.assertAlmostEqual(self.force(self.blocks(-0.01, parameters, kind=kind)), -1.0, delta=1e-9)

    def test_without_it_the_overlap_is_pressed_out(self):
        """11 mm over 1 + 1.01 m."""
        self.assertAlmostEqual(self.force(self.blocks(-0.01)), -2000 * 0.011 / 2.01, delta=1e-9)

    def test_the_value_of_calculix(self):
        """nu = 0.25: CalculiX 2.20 prints -1.125 with a contact stiffness of 1e7 and one of sticking of 1e5."""
        stiff = "*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e7\n*FRICTION\n0.3, 1e5\n"
        deck = self.blocks(-0.01, ", ADJUST=0.1", nu=0.25).replace("*SURFACE INTERACTION, NAME=I\n*FRICTION\n0.3\n", stiff)
        self.assertAlmostEqual(self.force(deck), -1.125, delta=2e-3)

    def test_gaps_are_closed_up_to_the_distance(self):
        self.assertAlmostEqual(self.force(self.blocks(0.01, ", ADJUST=0.1")), -1.0, delta=1e-9)
        open_still = self.blocks(0.01, ", ADJUST=0.005", pushed=-0.011)
        self.assertAlmostEqual(self.force(open_still), -2000 * 0.001 / 1.99, delta=1e-9)
        self.assertAlmostEqual(self.force(open_still.replace("ADJUST=0.005", "ADJUST=N_UPPER_BOTTOM")), -2000 * 0.011 / 2.0, delta=1e-9)

    def test_what_it_does_not_name(self):
        run = self.convert(self.blocks(-0.01, ", ADJUST=NOWHERE"))
        self.assertEqual(run.returncode, 1)
        self.assertIn("ADJUST=NOWHERE of *CONTACT PAIR is neither a distance nor a node set", run.stderr)

    TIE = "*TIE{}\nUPPER_BOTTOM, LOWER_TOP\n"

    def test_ties_close_gaps_within_their_tolerance(self):
        for offset in (0.01, -0.01):
            deck = self.blocks(offset, ", NAME=t, POSITION TOLERANCE=0.02", contact=self.TIE, pushed=1e-3)
            self.assertAlmostEqual(self.force(deck), 1.0, delta=1e-9)
            self.assertIn("ties:", (self.directory / "part.yaml").read_text())
        self.assertAlmostEqual(self.force(self.blocks(0.01, ", ADJUST=NO", contact=self.TIE, pushed=1e-3)), 2000 * 1e-3 / 1.99, delta=1e-9)

    def test_ties_beyond_their_tolerance(self):
        run = self.convert(self.blocks(0.01, ", POSITION TOLERANCE=0.005", contact=self.TIE))
        self.assertEqual(run.returncode, 1)
        self.assertIn("3 nodes of 'UPPER_BOTTOM' are up to 0.01 away from 'LOWER_TOP', more than the POSITION TOLERANCE", run.stderr)
        run = self.convert(self.blocks(0.03, contact=self.TIE))  # 3 % of a side of 1 m
        self.assertEqual(run.returncode, 1)
        self.assertIn("it depends on the program whether these are tied", run.stderr)

    def test_soft_contact_is_part_of_the_model(self):
        """E / k L of 1000 / (sqrt(2) k): 0.7 % with 1e5, 7 % with 1e4."""
        law = "*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={}\n"
        for text, stiff in ((law.format("LINEAR") + "1e5\n", True), (law.format("LINEAR") + "0.\n", False),
                            (law.format("TABULAR") + "0., 0.\n1e3, 1e-2\n1e4, 1.5e-2\n", True),
                            (law.format("TABULAR") + "0., 0.\n1e3, 1e-2\n1.1e3, 2e-2\n", False),
                            (law.format("TABULAR") + "0., -0.1\n1e6, 1e-2\n", False), (law.format("EXPONENTIAL") + "1e-3, 1e6\n", False)):
            with self.subTest(text=text):
                run = self.convert(self.blocks(0.0).replace("*SURFACE INTERACTION, NAME=I\n", text))
                self.assertEqual(run.returncode, 0 if stiff else 1, run.stderr)
        soft = self.blocks(0.0).replace("*SURFACE INTERACTION, NAME=I\n", law.format("LINEAR") + "1e4\n")
        expected = 2 * 1e-3 / (2 / 1000 + 1 / 1e4)  # two blocks and the contact in a row
        self.assertAlmostEqual(self.force(soft), -expected, delta=1e-9)
        for slope, stiff in (("1e5", True), ("1e4", False)):
            run = self.convert(self.blocks(0.0).replace("*FRICTION\n0.3\n", f"*FRICTION\n0.3, {slope}\n"))
            self.assertEqual(run.returncode, 0 if stiff else 1, run.stderr)


class Loads(Converting):
    def test_loads_at_once(self):
        """AMPLITUDE=STEP: one increment, whatever the increments of the deck."""
        text = self.converted(SQUARE + HELD + PRESSED.replace("*STEP", "*STEP, AMPLITUDE=STEP").replace("*STATIC\n", "*STATIC\n0.1, 1.\n"))
        self.assertIn("increments: 1}", text)
        table = "*AMPLITUDE, NAME=a\n0., 0., 1., 1.\n"
        run = self.convert(SQUARE + table + HELD + PRESSED.replace("*STEP", "*STEP, AMPLITUDE=STEP").replace("*DSLOAD", "*DSLOAD, AMPLITUDE=A"))
        self.assertEqual(run.returncode, 1)
        self.assertIn("a load by an *AMPLITUDE in a step with AMPLITUDE=STEP", run.stderr)

    def test_direct_increments_that_do_not_divide_the_step(self):
        text = self.converted(SQUARE + HELD + PRESSED.replace("*STATIC\n", "*STATIC, DIRECT\n0.3, 1.\n"))
        self.assertIn("increments: {first: 0.3, smallest: 0.3, largest: 0.3}", text)

    def test_large_displacements(self):
        """Taken, with one warning however many steps ask for it."""
        for word, told in (("NLGEOM", 1), ("NLGEOM=YES", 1), ("NLGEOM=NO", 0)):
            run = self.convert(SQUARE + HELD + PRESSED.replace("*STEP", "*STEP, " + word) + "*STEP, NLGEOM\n*STATIC\n*END STEP\n" * told)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(run.stderr.count("warning: NLGEOM asks for large displacements"), told)

    def test_nearly_incompressible_hybrid_elements(self):
        soft = SQUARE.replace("TYPE=CPS8", "TYPE=CPE8H")
        self.converted(soft + HELD + PRESSED)
        run = self.convert(soft.replace("210e9, 0.3", "1e6, 0.49") + HELD + PRESSED)
        self.assertEqual(run.returncode, 1)
        self.assertIn("hybrid elements of a material with Poisson's ratio 0.49 are not taken", run.stderr)


if __name__ == "__main__":
    support.main()
