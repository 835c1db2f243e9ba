"""Decks in several files (*INCLUDE) and of several parts (*INSTANCE): they mean the same as a deck written out."""
import os
import re

import support
from decks import END, HELD, MATERIAL, PRESSED, SQUARE, STATIC, Converting, grid
from support import scabo


def blocks_of(deck):
    """Keyword line and data lines of each keyword."""
    return re.findall(r"(?m)(^\*[^\n]*\n)((?:^[^*\n][^\n]*\n)*)", deck)


class Included(Converting):
    def texts(self):
        return (self.directory / "part.yaml").read_text(), (self.directory / "part_mesh.inp").read_text()

    WHOLE = (SQUARE + "*AMPLITUDE, NAME=A\n0., 0., 1., 1.\n" + HELD + STATIC.replace("*STATIC\n", "*STATIC\n0.5, 1.\n")
             + "*CLOAD\n25, 2, 5.\n*DLOAD\n2, P2, 3.\n1, P1, 7.\n*DSLOAD, AMPLITUDE=A\nBODY_TOP, P, 1e6\n*BOUNDARY\n21, 1, 1, 1e-4\n" + END)

    def test_data_lines_may_stand_in_a_file(self):
        """Of every keyword that has some, all of them or all but the first, in a file that includes another one."""
        self.converted(self.WHOLE)
        expected = self.texts()
        with_data = [(head, data) for head, data in blocks_of(self.WHOLE) if data]
        self.assertGreater(len({head.split(",")[0] for head, _ in with_data}), 10)
        (self.directory / "sub").mkdir()
        for head, data in with_data:
            for kept in {0, 1} if data.count("\n") > 1 else {0}:
                with self.subTest(keyword=head, kept=kept):
                    lines = data.splitlines(keepends=True)
                    (self.directory / "a data.txt").write_text("** a comment\n*include,\n INPUT = sub/more.txt")
                    (self.directory / "sub" / "more.txt").write_text("".join(lines[kept:]).rstrip("\n"))
                    deck = self.WHOLE.replace(head + data, head + "".join(lines[:kept]) + '*INCLUDE, INPUT="a data.txt"\n', 1)
                    self.converted(deck)
                    self.assertEqual(self.texts(), expected)

    def test_pressure_from_a_file(self):
        """Reactions are the sum of the force and of the pressure in the file: 1 + 2 x 25."""
        (self.directory / "load.dlo").write_text("3, P3, 25.\n4, P3, 25.\n")
        deck = SQUARE + HELD.replace("LEFT", "BOTTOM") + STATIC + "*CLOAD\n25, 2, -1.\n*DLOAD\n*INCLUDE, INPUT=load.dlo\n" + END
        reaction = self.solved(deck)["increments"][-1]["reactions"]["N_BODY_BOTTOM"]
        self.assertAlmostEqual(reaction[1], 51.0, delta=1e-9)

    def test_messages_name_the_line_of_the_file(self):
        (self.directory / "load.dlo").write_text("** loads\n3, P3, 25.\n4, P3, many\n")
        deck = SQUARE + HELD + STATIC + "*DLOAD\n*INCLUDE, INPUT=load.dlo\n*CLOAD\n25, 9, 1.\n" + END
        run = self.convert(deck)
        self.assertEqual(run.returncode, 1)
        self.assertIn("load.dlo:3: 'many' is not a number", run.stderr)
        line = deck[:deck.index("25, 9, 1.")].count("\n") + 1
        self.assertIn(f"part.inp:{line}: a load along degree of freedom 9", run.stderr)

    def test_files_are_found_from_the_deck(self):
        """As both programs find them: a name within an included file counts from the folder of the deck, then its own."""
        (self.directory / "sub").mkdir()
        (self.directory / "sub" / "first.inc").write_text("*INCLUDE, INPUT=second.inc\n*INCLUDE, INPUT=third.inc\n")
        (self.directory / "second.inc").write_text("3, P3, 25.\n")
        (self.directory / "sub" / "second.inc").write_text("3, P3, 99.\n")
        (self.directory / "sub" / "third.inc").write_text("4, P3, 26.\n")
        text = self.converted(SQUARE + HELD + STATIC + "*DLOAD\n*INCLUDE, INPUT=sub/first.inc\n" + END)
        self.assertEqual(sorted(re.findall(r"pressure: (\d+)", text)), ["25", "26"])

    def test_files_that_are_missing_or_include_themselves(self):
        run = self.convert(SQUARE + HELD + STATIC + "*DLOAD\n*INCLUDE, INPUT=none.dlo\n" + END)
        self.assertIn("the included file 'none.dlo' cannot be read", run.stderr)
        self.assertEqual(run.returncode, 1)
        self.assertIn("put it beside this file", run.stderr)
        (self.directory / "folder.inc").mkdir()
        os.mkfifo(self.directory / "pipe.inc")
        for name, why in (("folder.inc", "it is a directory; name a file"), ("pipe.inc", "it is a pipe or a device")):
            run = self.convert(SQUARE + HELD + STATIC + f"*DLOAD\n*INCLUDE, INPUT={name}\n" + END)
            self.assertIn(f"the included file '{name}' cannot be read; {why}", run.stderr)
            self.assertEqual(run.returncode, 1)
        (self.directory / "round.inc").write_text("*INCLUDE, INPUT=round.inc\n")
        run = self.convert(SQUARE + HELD + STATIC + "*DLOAD\n*INCLUDE, INPUT=round.inc\n" + END)
        self.assertIn("round.inc:1:1: 'round.inc' is included within itself", run.stderr)
        self.assertEqual(run.returncode, 1)

    def test_what_is_said_about_an_include_that_is_not_taken(self):
        for words, wanted in (("INPUT=sub\\load.dlo", "write / between the names of folders"), ("INPUT=load.dlo, PASSWORD=x", "*INCLUDE with PASSWORD is not taken"),
                              ("INPUT=", "*INCLUDE names no file")):
            run = self.convert(SQUARE + HELD + STATIC + f"*DLOAD\n*INCLUDE, {words}\n" + END)
            self.assertIn(wanted, run.stderr)
            self.assertEqual(run.returncode, 1)


class DataThatIsMissing(Converting):
    def test_keywords_without_their_data(self):
        """Every keyword that needs data is refused without it, also if only an empty file stands there."""
        whole = Included.WHOLE.replace("*DSLOAD", "*NSET, NSET=ALONE\n1\n*ELSET, ELSET=ALONE\n1\n*DSLOAD")
        (self.directory / "empty.inc").write_text("** nothing\n\n")
        optional = {"*STATIC", "*SOLID SECTION"}
        for head, data in blocks_of(whole):
            keyword = head.strip().split(",")[0]
            if not data or keyword in optional:
                continue
            for instead in ("", "*INCLUDE, INPUT=empty.inc\n"):
                with self.subTest(keyword=head, instead=instead):
                    run = self.convert(whole.replace(head + data, head + instead, 1))
                    self.assertEqual(run.returncode, 1)
                    told = keyword + " has no data lines" if "NODE" not in head and "ELEMENT" not in head else "mesh is empty"
                    self.assertTrue(told in run.stderr or keyword + " has no data lines" in run.stderr
                                    or "which is not in the file" in run.stderr, run.stderr)

    def test_contacts_without_their_data(self):
        contact = ("*SURFACE INTERACTION, NAME=i\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e14\n*FRICTION\n0.3\n"
                   "*CONTACT PAIR, INTERACTION=i\nBODY_TOP, BODY_LEFT\n*TIE\nBODY_TOP, BODY_LEFT\n*ORIENTATION, NAME=o\n1., 0., 0., 0., 1., 0.\n"
                   "*EXPANSION\n1e-5\n")
        for head, data in blocks_of(contact):
            if data:
                with self.subTest(keyword=head):
                    run = self.convert(SQUARE + contact.replace(head + data, head, 1) + HELD + PRESSED)
                    self.assertIn(head.strip().split(",")[0], run.stderr)
                    self.assertIn("has no data lines", run.stderr)

    def test_op_new_alone_takes_loads_back(self):
        deck = SQUARE + HELD + PRESSED + STATIC + "*DSLOAD, OP=NEW\n" + END
        self.assertIn("loads: {BODY_RIGHT_pressure: 0}", self.converted(deck))


MODEL = MATERIAL + "*SURFACE INTERACTION, NAME=Rough\n1.,\n*FRICTION\n0.3\n*CONTACT PAIR, INTERACTION=Rough\nFoot, Top\n"


def part(name, nx, ny, width, height, section="*SOLID SECTION, ELSET=ALL, MATERIAL=steel\n2.,\n", **options):
    mesh = grid(nx, ny, width, height, elset="ALL", **options)
    return f"*PART, NAME={name}\n{mesh}{section}*END PART\n"


def instance(name, of, *lines):
    return f"*INSTANCE, NAME={name}, PART={of}\n" + "".join(line + "\n" for line in lines) + "*END INSTANCE\n"


class Parts(Converting):
    """A punch of 2 x 1 on a block of 4 x 1, both with sets of the same names and numbers from 1."""
    PARTS = part("Block", 8, 2, 4.0, 1.0, kind="CPS4") + part("Punch", 5, 3, 2.0, 1.0, kind="CPS4")
    SETS = ("*NSET, NSET=Floor, INSTANCE={0}, GENERATE\n1, 9\n*ELSET, ELSET=_Top_S3, INTERNAL, INSTANCE={0}, GENERATE\n9, 16\n"
            "*SURFACE, NAME=Top, TYPE=ELEMENT\n_Top_S3, S3\n*ELSET, ELSET=_Foot_S1, INTERNAL, INSTANCE={1}, GENERATE\n1, 5\n"
            "*SURFACE, NAME=Foot, TYPE=ELEMENT\n_Foot_S1, S1\n")
    STEP = STATIC + "*DSLOAD\n{1}.ALL_TOP, P, 1e6\n" + END

    def deck(self, block="Block-1", punch="Punch-1", place=("1., 1., 0.",), parts=PARTS, sets=SETS, step=STEP, quoted=None):
        quoted = quoted or (block, punch)
        return (parts + "*ASSEMBLY, NAME=A\n" + instance(block, "Block") + instance(punch, "Punch", *place) + sets.format(*quoted)
                + "*END ASSEMBLY\n" + MODEL + "*BOUNDARY\nFloor, ENCASTRE\n" + step.format(*quoted))

    def force(self, deck):
        return self.solved(deck)["increments"][-1]["contacts"]["Rough"]["normal_force"]

    def test_two_instances(self):
        """1 MPa on 2 m, thickness 2 m: 4 MN, and the floor carries it."""
        summary = self.solved(self.deck())
        increment = summary["increments"][-1]
        self.assertAlmostEqual(increment["contacts"]["Rough"]["normal_force"], 4e6, delta=1e-2)
        self.assertAlmostEqual(increment["reactions"]["Floor"][1], 4e6, delta=1e-2)
        text = (self.directory / "part.yaml").read_text()
        self.assertIn("  Block-1:\n", text)
        self.assertIn("  Punch-1:\n", text)

    def test_the_same_deck_written_out(self):
        """Instances change names and numbers only: the model of one mesh has the same forces and displacements."""
        at = (1.7, 1.6)
        by_parts, _ = self.displacement(self.deck(), *at)
        flat = (grid(8, 2, 4.0, 1.0, kind="CPS4", elset="LOWER") + grid(5, 3, 2.0, 1.0, first=101, corner=(1.0, 1.0), kind="CPS4", elset="UPPER")
                + "*SOLID SECTION, ELSET=LOWER, MATERIAL=steel\n2.\n*SOLID SECTION, ELSET=UPPER, MATERIAL=steel\n2.\n"
                + MODEL.replace("Foot, Top", "UPPER_BOTTOM, LOWER_TOP") + "*BOUNDARY\nN_LOWER_BOTTOM, ENCASTRE\n" + STATIC
                + "*DSLOAD\nUPPER_TOP, P, 1e6\n" + END)
        written_out, _ = self.displacement(flat, *at)
        self.assertAlmostEqual(by_parts / written_out, 1.0, delta=1e-12)

    def test_names_in_quotes(self):
        """Quotes protect blanks and commas; names in and without them are the same."""
        deck = self.deck('"My block"', '"The punch, 2nd"', quoted=('"My block"', '"The punch, 2nd"'))
        self.assertAlmostEqual(self.force(deck), 4e6, delta=1e-2)
        self.assertIn("The_punch__2nd", (self.directory / "part.yaml").read_text())

    def test_numbers_of_an_instance(self):
        """Node 24 of the punch, the top right corner, is another than node 24 of the block."""
        step = STATIC + "*CLOAD\n{1}.24, 2, -3e3\n*DLOAD\n{1}.15, P3, 1e6\n{1}.ALL, GRAV, 10., 0., -1., 0.\n" + END
        weight = 2.0 * 1.0 * 2.0 * 7850 * 10
        self.assertAlmostEqual(self.force(self.deck(step=step)), 3e3 + 0.4 * 2.0 * 1e6 + weight, delta=1e-2)

    def test_an_instance_within_which_the_mesh_stands(self):
        """As of an independent instance: the part is empty."""
        mesh = re.search(r"NAME=Punch\n(.*?)\*END PART", self.PARTS, re.DOTALL)[1]
        deck = self.deck().replace(f"*PART, NAME=Punch\n{mesh}", "*PART, NAME=Punch\n").replace(
            "PART=Punch\n1., 1., 0.\n", "PART=Punch\n1., 1., 0.\n" + mesh)
        self.assertAlmostEqual(self.force(deck), 4e6, delta=1e-2)

    def test_turned_instances(self):
        """A punch drawn upright and turned by -90 degrees about a point lies on the block; its left side is then its top."""
        upright = self.PARTS.replace(part("Punch", 5, 3, 2.0, 1.0, kind="CPS4"), part("Punch", 3, 5, 1.0, 2.0, kind="CPS4"))
        sets = self.SETS.replace("*ELSET, ELSET=_Foot_S1, INTERNAL, INSTANCE={1}, GENERATE\n1, 5\n", "*ELSET, ELSET=_Foot_S1, INSTANCE={1}, GENERATE\n"
                                 "3, 15, 3\n").replace("_Foot_S1, S1", "_Foot_S1, S2")
        place = ("2., 1., 0.", "2., 2., 0., 2., 2., 1., -90.")  # (x, y) + (2, 1), then (2 + dx, 2 + dy) -> (2 + dy, 2 - dx)
        deck = self.deck(place=place, parts=upright, sets=sets, step=self.STEP.replace("ALL_TOP", "ALL_LEFT"))
        self.assertAlmostEqual(self.force(deck), 4e6, delta=1e-2)
        self.assertRegex((self.directory / "part_mesh.inp").read_text(), r"(?m)^\d+, 1, 2$")

    def test_a_material_turns_with_its_instance(self):
        """Axis 1 along the part's x, the instance turned by 90 degrees: tension along x meets E2."""
        ply = "*MATERIAL, NAME=ply\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n140e9, 10e9, 10e9, 0.3, 0.3, 0.4, 5e9, 5e9\n3.5e9\n"
        section = "*ORIENTATION, NAME=Ori\n1., 0., 0., 0., 1., 0.\n3, 0.\n*SOLID SECTION, ELSET=ALL, MATERIAL=ply, ORIENTATION=Ori\n"
        deck = (part("Plate", 2, 2, 2.0, 2.0, section=section) + "*ASSEMBLY, NAME=A\n"
                + instance("P", "Plate", "0., 0., 0.", "0., 0., 0., 0., 0., 1., 90.") + "*END ASSEMBLY\n" + ply
                + "*BOUNDARY\nP.N_ALL_TOP, 1\nP.N_ALL_LEFT, 2\n" + STATIC + "*DSLOAD\nP.ALL_BOTTOM, P, -1e6\n" + END)
        # The part's top is at x = -2, its bottom at x = 0, its left side at y = 0.
        u, _ = self.displacement(deck, 0.0, 1.0, 0)
        self.assertAlmostEqual(u / (2.0 * 1e6 / 10e9), 1.0, delta=1e-10)
        run = self.convert(deck.replace(", ORIENTATION=Ori", ""))
        self.assertEqual(run.returncode, 1)
        self.assertIn("an orthotropic material in an instance that is turned needs an *ORIENTATION", run.stderr)

    def test_two_instances_of_one_part(self):
        """Three bricks on each other: the weight of two of them on the lowest joint."""
        deck = (part("Brick", 4, 2, 2.0, 1.0, kind="CPS4") + "*ASSEMBLY, NAME=A\n" + "".join(
            instance(f"Brick-{k}", "Brick", f"0., {k - 1}., 0.") for k in (1, 2, 3)) + "*END ASSEMBLY\n" + MODEL.replace("Foot, Top", "Brick-2.ALL_BOTTOM, Brick-1.ALL_TOP\nBrick-3.ALL_BOTTOM, Brick-2.ALL_TOP")
            + "*BOUNDARY\nBrick-1.N_ALL_BOTTOM, PINNED\n" + STATIC + "*DLOAD\n, GRAV, 10., 0., -1., 0.\n" + END)
        contacts = self.solved(deck)["increments"][-1]["contacts"]
        weight = 2.0 * 1.0 * 2.0 * 7850 * 10
        self.assertEqual([round(contact["normal_force"] / weight, 9) for contact in contacts.values()], [2.0, 1.0])

    REFUSED = {  # what is replaced by what: message
        ("1., 1., 0.", "1., 1., 0.\n0., 0., 0., 1., 0., 0., 90."): "not in a plane z = constant",
        ("1., 1., 0.", "1., 1., 0.\n0., 0., 0., 0., 0., 0., 90."): "the two points of the axis of *INSTANCE are one",
        ("PART=Punch", "PART=Press"): "there is no part 'Press'",
        ("*INSTANCE, NAME=Punch-1", "*INSTANCE, NAME=block-1"): "there are two instances 'block-1'",
        ("*PART, NAME=Punch", "*PART, NAME=BLOCK"): "there are two parts 'BLOCK'",
        ("Punch-1.ALL_TOP", "Punch-1.ALL_NONE"): "there is no surface 'Punch-1.ALL_NONE' with sides of plane elements",
        ("Punch-1.ALL_TOP", "Punch-2.ALL_TOP"): "there is no surface 'Punch-2.ALL_TOP' with sides of plane elements",
        ("*DSLOAD\nPunch-1.ALL_TOP, P, 1e6", "*CLOAD\nPunch-1.25, 2, 1."): "node Punch-1.25, which belongs to no plane element",
        ("*DSLOAD\nPunch-1.ALL_TOP, P, 1e6", "*CLOAD\n24, 2, 1."): "node 24, which belongs to no plane element",
        ("INSTANCE=Punch-1, GENERATE", "INSTANCE=Punch-9, GENERATE"): "there is no instance 'Punch-9'",
        ("*END INSTANCE\n*NSET", "*NSET"): "has no *END INSTANCE",
        ("*END PART\n*ASSEMBLY", "*ASSEMBLY"): "part 'Punch' has no *END PART",
        ("*SOLID SECTION", "*TRANSFORM, NSET=N_ALL_TOP\n1., 0., 0., 0., 1., 0.\n*SOLID SECTION"): "stands within a part",
        ("*ASSEMBLY, NAME=A", "*ASSEMBLY, NAME=A, STRANGE=1"): "*ASSEMBLY with STRANGE is not taken",
        ("PART=Punch", "PART=Punch, LIBRARY=old"): "from the results of another run",
    }

    def test_what_is_refused(self):
        for (old, new), message in self.REFUSED.items():
            with self.subTest(new=new):
                deck = self.deck()
                self.assertIn(old, deck)
                run = self.convert(deck.replace(old, new))
                self.assertEqual(run.returncode, 1)
                self.assertIn(message, run.stderr)

    def test_bodies_from_the_mesh_alone(self):
        """`mesh.file` takes such a file too: an instance is a region or a set."""
        (self.directory / "a.inp").write_text(self.deck())
        model = ("scabo: 1\nmaterials: {steel: {young: 210e9, poisson: 0.3}}\nanalysis: {plane: stress, thickness: 2}\nbodies:\n"
                 "  block: {material: steel, mesh: {file: a.inp, region: Block-1, elements: fem}}\n"
                 "  punch: {material: steel, mesh: {file: a.inp, region: Punch-1, elements: fem}}\n"
                 "supports: [{on: block.Block-1_ALL_BOTTOM, fix: [x, y]}]\nloads: {p: {on: punch.Punch-1_ALL_TOP, pressure: 1e6}}\n"
                 "contacts: {Rough: {between: [block.Top, punch.Foot], friction: 0.3}}\n")
        (self.directory / "part.yaml").write_text(model)
        run = scabo("run", "part.yaml", "--quiet", cwd=self.directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        summary = support.summary_of(self.directory / "part.results")
        self.assertAlmostEqual(summary["increments"][-1]["contacts"]["Rough"]["normal_force"], 4e6, delta=1e-2)


if __name__ == "__main__":
    support.main()
