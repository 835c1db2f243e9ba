"""`scabo convert`: decks of Abaqus and CalculiX as models. Numbers are compared with closed forms, messages with docs/convert.md."""
import math
import random
import re

import support
from decks import END, HELD, MATERIAL, PRESSED, SQUARE, STATIC, Converting, grid
from support import scabo


class Numbers(Converting):
    def test_patch(self):
        """Uniform tension: u = s x / E and v = -nu s y / E, whatever the elements."""
        for kind in ("CPS4", "CPS8R", "CPE4", "CPE8"):
            with self.subTest(kind=kind):
                deck = (grid(3, 2, 3.0, 2.0, kind=kind) + MATERIAL + f"*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n0.5\n"
                        "*BOUNDARY\nN_BODY_LEFT, 1\nN_BODY_BOTTOM, 2\n" + STATIC + "*DSLOAD\nBODY_RIGHT, P, -1e6\n" + END)
                e, nu = (210e9, 0.3) if kind.startswith("CPS") else (210e9 / (1 - 0.09), 0.3 / 0.7)
                u, summary = self.displacement(deck, 3.0, 2.0, 0)
                v, _ = self.displacement(deck, 3.0, 2.0, 1)
                self.assertAlmostEqual(u / (1e6 * 3.0 / e), 1.0, delta=1e-10)
                self.assertAlmostEqual(v / (-nu * 1e6 * 2.0 / e), 1.0, delta=1e-10)
                reaction = summary["increments"][-1]["reactions"]["N_BODY_LEFT"]
                self.assertAlmostEqual(reaction[0], -1e6 * 2.0 * 0.5, delta=1e-3)

    def test_tube(self):
        """Lame's tube, radii 1 and 3, pressed from inside and held along its axis: u = p a^2 (1 + nu) ((1 - 2 nu) r + b^2 / r) / (E (b^2 - a^2)).
        The force on its ends is 2 pi a^2 nu p, that of the whole circumference."""
        for kind, order in (("CAX8", 1e-3), ("CAX8R", 1e-3), ("CAX4", 1e-2)):
            with self.subTest(kind=kind):
                deck = (grid(16, 2, 2.0, 0.5, corner=(1.0, 0.0), kind=kind) + MATERIAL + "*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n7.\n"
                        "*BOUNDARY\nN_BODY_BOTTOM, 2\nN_BODY_TOP, 2\n" + STATIC + "*DSLOAD\nBODY_LEFT, P, 1e6\n" + END)
                u, summary = self.displacement(deck, 1.0, 0.0, 0)
                self.assertAlmostEqual(u / (1e6 * 1.3 * (0.4 + 9.0) / (210e9 * 8.0)), 1.0, delta=order)
                force = max(abs(force[1]) for force in summary["increments"][-1]["reactions"].values())
                self.assertAlmostEqual(force / (2 * math.pi * 0.3 * 1e6), 1.0, delta=order)
                self.assertEqual(summary["model"]["plane"], "axisymmetric")

    def test_solid_of_revolution(self):
        """A disc that turns, with nodes on the axis held in both directions as CalculiX asks for, and a force around a circle; half of
        the square of the angular velocity in the first step. u(b) = (1 - nu) rho w^2 b^3 / 4 E of a thin disc."""
        deck = (grid(16, 1, 1.0, 0.02, corner=(1e-14, 0.0), kind="CAX8") + MATERIAL + "*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n*BOUNDARY\nN_BODY_LEFT, 1\n"
                "N_BODY_BOTTOM, 2\n" + STATIC + "*DLOAD\nBODY, CENTRIF, 5e3, 0., 0., 0., 0., 1., 0.\n" + END
                + STATIC + "*DLOAD\nBODY, CENTRIF, 1e4, 0., 0., 0., 0., 1., 0.\n*CLOAD\nN_BODY_CORNER, 2, 30.\n" + END)
        deck = deck.replace("*MATERIAL", "*NSET, NSET=N_BODY_CORNER\n99\n*MATERIAL", 1)
        u, summary = self.displacement(deck, 1.0, 0.01, 0)
        self.assertAlmostEqual(u / (0.7 * 7850 * 1e4 / (4 * 210e9)), 1.0, delta=1e-3)
        reactions = summary["increments"][-1]["reactions"]
        self.assertAlmostEqual(sum(force[1] for force in reactions.values()), -30.0, delta=1e-6)
        opened = self.convert(deck.replace(STATIC, STATIC + "*BOUNDARY\nN_BODY_LEFT, 1, 1, 1e-6\n"))
        self.assertEqual(opened.returncode, 1)
        self.assertIn("a radial displacement on the axis opens a hole there", opened.stderr)

    def test_cantilever(self):
        """The exact field of a beam with shear: all of its parts are in the deflection P l^3 / 3 E I (1 + ...) to 1 %."""
        length, height, force = 10.0, 1.0, 1e4
        deck = (grid(20, 2, length, height) + MATERIAL + "*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n1.0\n*BOUNDARY\nN_BODY_LEFT, 1, 2\n" + STATIC
                + f"*CLOAD\n{2 * 41 + 41}, 2, {-force}\n" + END)
        v, _ = self.displacement(deck, length, height / 2)
        inertia, shear = height**3 / 12, 210e9 / 2.6
        expected = -force * length**3 / (3 * 210e9 * inertia) - 1.2 * force * length / (shear * height)
        self.assertAlmostEqual(v / expected, 1.0, delta=5e-3)

    def test_gravity(self):
        """A column under its weight: v(h) = -rho g h^2 / 2 E with nu = 0."""
        material = MATERIAL.replace("0.3", "0.0")
        deck = (grid(1, 4, 1.0, 8.0) + material + "*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n*BOUNDARY\nN_BODY_BOTTOM, 1, 2\n" + STATIC
                + "*DLOAD\nBODY, GRAV, 9.81, 0., -1., 0.\n" + END)
        v, _ = self.displacement(deck, 0.5, 8.0)
        self.assertAlmostEqual(v / (-7850 * 9.81 * 64 / 2 / 210e9), 1.0, delta=1e-9)

    def test_prescribed_displacement_over_steps(self):
        deck = (grid(2, 2, 2.0, 2.0) + MATERIAL.replace("0.3", "0.0") + "*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n*BOUNDARY\nN_BODY_LEFT, 1\n"
                "N_BODY_BOTTOM, 2\n" + STATIC + "*BOUNDARY\nN_BODY_RIGHT, 1, 1, 1e-3\n" + END
                + STATIC + "*BOUNDARY\nN_BODY_RIGHT, 1, 1, -5e-4\n" + END)
        u, summary = self.displacement(deck, 2.0, 1.0, 0)
        self.assertAlmostEqual(u, -5e-4, delta=1e-15)
        self.assertEqual([increment["step"] for increment in summary["increments"]], [1, 2])

    def test_displacement_outside_of_steps(self):
        """It grows over the first step, as in CalculiX, and a step may change it."""
        deck = (grid(2, 2, 2.0, 2.0) + MATERIAL.replace("0.3", "0.0") + "*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n*BOUNDARY\nN_BODY_LEFT, 1\n"
                "N_BODY_BOTTOM, 2\nN_BODY_RIGHT, 1, 1, 1e-3\n" + STATIC.replace("*STATIC\n", "*STATIC, DIRECT\n0.5, 1.\n") + END)
        u, summary = self.displacement(deck, 2.0, 1.0, 0)
        self.assertAlmostEqual(u, 1e-3, delta=1e-15)
        self.assertEqual([increment["factors"] for increment in summary["increments"]], [{"N_BODY_RIGHT": 0.5}, {"N_BODY_RIGHT": 1.0}])
        u, _ = self.displacement(deck.replace(END, "*BOUNDARY\nN_BODY_RIGHT, 1, 1, 3e-3\n" + END), 2.0, 1.0, 0)
        self.assertAlmostEqual(u, 3e-3, delta=1e-15)

    def test_amplitude(self):
        """A load that goes to three times its end and back, in equal increments."""
        deck = (grid(2, 2, 2.0, 2.0) + MATERIAL.replace("0.3", "0.0") + "*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n*BOUNDARY\nN_BODY_LEFT, 1\n"
                "N_BODY_BOTTOM, 2\n*AMPLITUDE, NAME=Path\n0., 0., 1., 3., 2., 1.\n*STEP\n*STATIC, DIRECT\n0.5, 2.\n"
                "*DSLOAD, AMPLITUDE=PATH\nBODY_RIGHT, P, -210e6\n" + END)
        u, _ = self.displacement(deck, 2.0, 1.0, 0)
        with open(self.directory / "part.results" / "history.csv", encoding="utf-8") as file:
            rows = [line.rstrip().split(",") for line in file]
        values = [float(row[rows[0].index("u")]) for row in rows[1:]]
        for value, expected in zip(values, (1.5, 3.0, 2.0, 1.0), strict=True):
            self.assertAlmostEqual(value / 2e-3, expected, delta=1e-10)

    def test_an_amplitude_in_total_time_goes_on_in_later_steps(self):
        """Unless the load is given anew or taken back; one in step time does not. CalculiX 2.20 prints 3 and 1 times the load."""
        deck = (grid(2, 2, 2.0, 2.0) + MATERIAL.replace("0.3", "0.0") + "*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n*BOUNDARY\nN_BODY_LEFT, 1\n"
                "N_BODY_BOTTOM, 2\n*AMPLITUDE, NAME=A, TIME={} TIME\n0., 0., 1., 1., 2., 3.\n" + STATIC
                + "*DSLOAD, AMPLITUDE=A\nBODY_RIGHT, P, -210e6\n" + END + STATIC + "{}" + END)
        for time, second, times in (("TOTAL", "", 3.0), ("STEP", "", 1.0), ("TOTAL", "*DSLOAD, OP=NEW\n", 0.0),
                                    ("TOTAL", "*DSLOAD\nBODY_RIGHT, P, -105e6\n", 0.5)):
            with self.subTest(time=time, second=second):
                u, _ = self.displacement(deck.format(time, second), 2.0, 1.0, 0)
                self.assertAlmostEqual(u / 2e-3, times, delta=1e-10)

    def test_orthotropic_at_an_angle(self):
        """Axis 1 at 90 degrees: tension along x meets E2."""
        material = ("*MATERIAL, NAME=ply\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n140e9, 10e9, 10e9, 0.3, 0.3, 0.4, 5e9, 5e9\n3.5e9\n"
                    "*ORIENTATION, NAME=turned\n0., 1., 0., -1., 0., 0.\n")
        deck = (grid(2, 2, 2.0, 2.0) + material + "*SOLID SECTION, ELSET=BODY, MATERIAL=ply, ORIENTATION=turned\n*BOUNDARY\nN_BODY_LEFT, 1\n"
                "N_BODY_BOTTOM, 2\n" + STATIC + "*DSLOAD\nBODY_RIGHT, P, -1e6\n" + END)
        u, _ = self.displacement(deck, 2.0, 1.0, 0)
        self.assertAlmostEqual(u / (2.0 * 1e6 / 10e9), 1.0, delta=1e-10)

    def test_stiffness_as_numbers(self):
        """TYPE=ORTHO of an isotropic material is that material."""
        young, nu = 210e9, 0.3
        lame, shear = young * nu / (1 + nu) / (1 - 2 * nu), young / 2 / (1 + nu)
        normal = lame + 2 * shear
        material = (f"*MATERIAL, NAME=steel\n*ELASTIC, TYPE=ORTHO\n{normal}, {lame}, {normal}, {lame}, {lame}, {normal}, {shear}, {shear},\n{shear}\n")
        deck = (grid(2, 2, 2.0, 2.0, kind="CPE8") + material + "*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n*BOUNDARY\nN_BODY_LEFT, 1\n"
                "N_BODY_BOTTOM, 2\n" + STATIC + "*DSLOAD\nBODY_RIGHT, P, -1e6\n" + END)
        u, _ = self.displacement(deck, 2.0, 1.0, 0)
        self.assertAlmostEqual(u / (2.0 * 1e6 * (1 - nu**2) / young), 1.0, delta=1e-10)

    def blocks(self, contact, shear="", kind="CPE8"):
        """Two blocks on each other, the lower one held, the upper one pressed by 10 MPa."""
        return (grid(4, 2, 2.0, 1.0, elset="LOWER", kind=kind)
                + grid(4, 2, 2.0, 1.0, first=1001, corner=(0.0, 1.0), elset="UPPER", kind=kind) + MATERIAL
                + "*SOLID SECTION, ELSET=LOWER, MATERIAL=steel\n*SOLID SECTION, ELSET=UPPER, MATERIAL=steel\n" + contact
                + "*BOUNDARY\nN_LOWER_BOTTOM, 1, 2\nN_UPPER_LEFT, 1\nN_LOWER_LEFT, 1\n" + STATIC + "*DSLOAD\nUPPER_TOP, P, 10e6\n" + shear + END)

    CONTACT = ("*CONTACT PAIR, INTERACTION=rough, TYPE=SURFACE TO SURFACE\nUPPER_BOTTOM, LOWER_TOP\n*SURFACE INTERACTION, NAME=rough\n"
               "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n*FRICTION\n0.4\n")

    def test_contact(self):
        summary = self.solved(self.blocks(self.CONTACT))
        contact = summary["increments"][-1]["contacts"]["rough"]
        self.assertAlmostEqual(contact["normal_force"], 2e7, delta=1.0)

    def test_tie_and_tied_contact(self):
        tied, pull = "*TIE, NAME=t\nUPPER_BOTTOM, LOWER_TOP\n", "UPPER_RIGHT, P, -20e6\n"
        whole, _ = self.displacement(self.blocks(tied, pull), 2.0, 2.0, 0)
        self.assertIn("ties:", (self.directory / "part.yaml").read_text())
        other, _ = self.displacement(self.blocks(self.CONTACT.replace("HARD", "TIED"), pull), 2.0, 2.0, 0)
        self.assertEqual(whole, other)
        slipping, _ = self.displacement(self.blocks(self.CONTACT, pull), 2.0, 2.0, 0)
        self.assertNotAlmostEqual(slipping / whole, 1.0, delta=5e-4)

    def test_sections_of_different_thickness(self):
        """A bar of thickness 2 below one of thickness 1: u = p h (1 / E + t / (2 E)); the joint has the force of the thinner one."""
        parts = "".join(grid(2, 2, 2.0, 2.0, first=first, corner=(0.0, y), elset=name) for name, first, y in (("LOWER", 1, 0.0), ("UPPER", 101, 2.0)))
        section = "*SOLID SECTION, ELSET={}, MATERIAL=steel\n{}\n"
        deck = lambda lower, upper, more="": (parts + MATERIAL.replace("0.3", "0.0") + section.format("LOWER", lower) + section.format("UPPER", upper) + self.CONTACT
                                              + more + "*BOUNDARY\nN_LOWER_BOTTOM, 1, 2\nN_UPPER_LEFT, 1\n" + STATIC + "*DSLOAD\nUPPER_TOP, P, 21e6\n" + END)
        v, summary = self.displacement(deck(2.0, 1.0), 2.0, 4.0)
        self.assertAlmostEqual(v / (-21e6 * 2.0 * 1.5 / 210e9), 1.0, delta=1e-9)
        self.assertAlmostEqual(summary["increments"][-1]["contacts"]["rough"]["normal_force"], 42e6, delta=1.0)
        self.assertEqual([body.get("thickness") for body in summary["model"]["bodies"]], [None, 1.0])
        run = self.convert(deck(2.0, 1.0).replace("CPS8", "CPE8"))
        self.assertEqual(run.returncode, 1)
        self.assertIn("in plane strain a model has one thickness", run.stderr)
        halves = deck(2.0, 1.0).replace("*SOLID SECTION, ELSET=LOWER", "*ELSET, ELSET=HALF\n1, 2\n*ELSET, ELSET=REST\n3, 4\n*SOLID SECTION, ELSET=REST, MATERIAL=steel\n1.5\n*SOLID SECTION, ELSET=HALF")
        run = self.convert(halves)
        self.assertEqual(run.returncode, 1)
        self.assertIn("body 'LOWER' has elements of the thickness 2 and of 1.5; a body has one, part it", run.stderr)

    def test_two_materials_in_one_body(self):
        """Half of a bar is half as stiff: elongations add up."""
        deck = (grid(4, 1, 4.0, 1.0) + MATERIAL.replace("0.3", "0.0") + "*MATERIAL, NAME=soft\n*ELASTIC\n105e9, 0.0\n"
                "*ELSET, ELSET=HALF, GENERATE\n3, 4\n*ELSET, ELSET=OTHER\n1, 2\n*SOLID SECTION, ELSET=OTHER, MATERIAL=STEEL\n"
                "*SOLID SECTION, ELSET=HALF, MATERIAL=SOFT\n*BOUNDARY\nN_BODY_LEFT, 1\nN_BODY_BOTTOM, 2\n" + STATIC + "*DLOAD\n4, P2, -1e6\n" + END)
        u, _ = self.displacement(deck, 4.0, 0.5, 0)
        self.assertAlmostEqual(u / (1e6 * (2.0 / 210e9 + 2.0 / 105e9)), 1.0, delta=1e-10)


class Writing(Converting):
    """The same deck in other clothes."""

    def test_spelling(self):
        expected = self.converted(SQUARE + HELD + PRESSED)
        deck = SQUARE + HELD + PRESSED
        self.assertEqual(self.converted(deck.replace("\n", "\r\n")), expected)
        self.assertEqual(self.converted(deck.replace("\n", "\n** a comment, with commas\n")), expected)
        self.assertEqual(self.converted("\ufeff" + deck), expected)
        lower = self.converted(re.sub(r"(?m)^\*[A-Z ]+", lambda match: match[0].lower(), deck))
        self.assertEqual(lower, expected)
        parted = deck.replace("*SOLID SECTION, ELSET=BODY, MATERIAL=steel", "*SOLID SECTION,\nELSET=BODY,\nMATERIAL=steel")
        self.assertEqual(self.converted(parted), expected)
        self.assertEqual(self.converted(deck.replace(", ", " ,   ")), expected)

    def test_include(self):
        (self.directory / "mesh.inc").write_text(SQUARE)
        included = self.converted("*INCLUDE, INPUT=mesh.inc\n" + HELD + PRESSED)
        self.assertEqual(included, self.converted(SQUARE + HELD + PRESSED))

    def test_files(self):
        run = self.convert(SQUARE + HELD + PRESSED)
        self.assertIn("part.yaml: 1 body, 1 support, 1 load, 1 step", run.stdout)
        self.assertEqual(sorted(path.name for path in self.directory.iterdir()), ["part.inp", "part.yaml", "part_mesh.inp"])
        again = scabo("convert", "part.inp", cwd=self.directory)
        self.assertEqual(again.returncode, 1)
        self.assertIn("part.yaml: exists: remove it, replace it with --force, or name another file with -o", again.stderr)
        other = scabo("convert", "part.inp", "-o", "other.yaml", cwd=self.directory)
        self.assertEqual(other.returncode, 0)
        self.assertIn('file: "other_mesh.inp"', (self.directory / "other.yaml").read_text())
        itself = scabo("convert", "part.inp", "-o", "part.inp", "--force", cwd=self.directory)
        self.assertEqual(itself.returncode, 1)
        self.assertIn("is the deck itself", itself.stderr)

    def test_names_and_title(self):
        deck = ("*HEADING\nA \"plate\": 100 % loaded, twice\n" + SQUARE.replace("BODY", "On").replace("steel", "alloy 7/5") + HELD.replace("BODY", "On")
                + PRESSED.replace("BODY", "On"))
        text = self.converted(deck)
        self.assertIn('title: "A \\"plate\\": 100 % loaded, twice"', text)
        self.assertIn("alloy_7_5:", text)


NOTES = {  # deck after the mesh: message
    "*NODE FILE\nU\n*EL FILE\nS\n": "requests output and is left out",
    "*CONTROLS, PARAMETERS=FIELD\n": "controls a solver and is left out",
    "*MATERIAL, NAME=other\n*ELASTIC\n1e9, 0.3\n": "material 'other' is used by no section and is left out",
    "*CONDUCTIVITY\n50.\n": "has no effect in a static analysis",
    "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nN_BODY_LEFT, 20.\n": "of temperature are left out",
}

LOST = {
    "*PLASTIC\n235e6, 0.\n": "*PLASTIC of material 'steel' is plasticity, which Scabo does not have: the body would stay elastic",
    "*HYPERELASTIC, NEO HOOKE\n1., 0.\n": "is a law that Scabo does not have",
    "*EQUATION\n2\n1, 1, 1., 2, 1, -1.\n": "*EQUATION joins degrees of freedom",
    "*RIGID BODY, NSET=N_BODY_TOP, REF NODE=1\n": "*RIGID BODY joins degrees of freedom",
    "*TRANSFORM, NSET=N_BODY_TOP\n1., 1., 0., -1., 1., 0.\n": "gives local axes of nodes",
    "*FREQUENCY\n10\n": "is no static analysis; Scabo converts *STATIC steps",
    "*TEMPERATURE\nN_BODY_TOP, 20.\n": "a `temperature` load of a model may replace it",
    "*MODEL CHANGE, TYPE=ELEMENT, REMOVE\nBODY\n": "changes the contact or the elements within the analysis",
    "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n": "is general contact, which is not taken",
    "*CONTACT PAIR, INTERACTION=i\nBODY_TOP, BODY_TOP\n": "there is no *SURFACE INTERACTION 'I'",
    "*CONTACT PAIR\nBODY_TOP, BODY_LEFT\n": "both surfaces are of one body",
    "*CONTACT PAIR\nBODY_TOP, NOWHERE\n": "there is no surface 'NOWHERE'",
    "*CONTACT PAIR, ADJUST=0.1\nBODY_TOP, BODY_LEFT\n": "*CONTACT PAIR has no INTERACTION",
    "*SURFACE INTERACTION, NAME=i\n*FRICTION, ROUGH\n": "*FRICTION with ROUGH is not taken",
    "*BOUNDARY\nNOWHERE, 1\n": "there is no node set 'NOWHERE'",
    "*BOUNDARY\n999, 1\n": "at node 999, which belongs to no plane element, is lost",
    "*BOUNDARY\n8, 1\n": "a support at node 8 acts inside of a body",
    "*NSET, NSET=ALL, GENERATE\n1, 25\n*BOUNDARY\nALL, 2\n": "a support at node 8 (and 4 more) acts inside of a body",
    "*BOUNDARY\n1, one\n": "'one' is not a number",
    "*CLOAD\n1, 1, 5.\n": "stands outside of a step and is lost",
    "*SPRING, ELSET=BODY\n1, 1\n5.\n": "makes elements without area",
    "*WONDER\n": "*WONDER is not known to the converter",
    "*AMPLITUDE, NAME=a, DEFINITION=PERIODIC\n1, 2\n": "only an *AMPLITUDE with a name and a table",
    "*SOLID SECTION, ELSET=BODY, MATERIAL=brass\n": "there is no material 'brass'",
    "*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n1.\n*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n2.\n": "the thickness 2 is given to elements of the thickness 1; give each element one",
    "*SOLID SECTION, ELSET=BODY, MATERIAL=steel, ORIENTATION=O\n": "there is no usable *ORIENTATION 'O'",
    "*MATERIAL, NAME=Steel\n*ELASTIC\n1e9, 0.3\n": "there is another *MATERIAL 'Steel' before this one",
    "*ELASTIC\n1e9, 0.3\n": "*ELASTIC of material 'steel' stands before this one too",
    "*DENSITY\n1000.\n": "*DENSITY of material 'steel' stands before this one too",
}

TWICE = {
    "*MATERIAL, NAME=brass\n*ELASTIC\n1e9, 0.3\n*SOLID SECTION, ELSET=BODY, MATERIAL=brass\n":
        "element 1 has material 'steel' by a *SOLID SECTION before this one",
    "*AMPLITUDE, NAME=A\n0., 0., 1., 1.\n*AMPLITUDE, NAME=a\n0., 0., 1., 2.\n": "there is another *AMPLITUDE 'a' before this one",
    "*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\n*ORIENTATION, NAME=o\n0., 1., 0., -1., 0., 0.\n":
        "there is another *ORIENTATION 'o' before this one",
    "*SURFACE INTERACTION, NAME=I\n*FRICTION\n0.3\n*SURFACE INTERACTION, NAME=i\n*FRICTION\n0.2\n":
        "there is another *SURFACE INTERACTION 'i' before this one",
    "*SURFACE INTERACTION, NAME=I\n*FRICTION\n0.3\n*FRICTION\n0.2\n": "*FRICTION of this *SURFACE INTERACTION stands before this one too",
    "*SURFACE, NAME=Body_Right\n1, S4\n": "there is another *SURFACE 'Body_Right' before this one",
    "*NODE PRINT, NSET=N_BODY_TOP, nset=N_BODY_LEFT\nU\n": "*NODE PRINT gives NSET twice",
    "*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD, Pressure-Overclosure = TIED\n": "gives PRESSURE-OVERCLOSURE twice",
    STATIC + "*STATIC, DIRECT\n.2, 1.\n" + END: "another procedure of this step stands before this *STATIC",
    STATIC + "*BOUNDARY\nN_BODY_RIGHT, 1, 1, 1e-3\nN_BODY_TOP, 1, 1, 2e-3\n" + END:
        "in one step 'N_BODY_RIGHT' has the displacement 0.001 along degree of freedom 1, and 'N_BODY_TOP', of the same node, 0.002",
}

LOST_IN_STEP = {
    "*CLOAD\n1, 3, 5.\n": "along degree of freedom 3 does not act on a plane body",
    "*CLOAD\n8, 1, 5.\n": "a force at node 8 acts inside of a body",
    "*CLOAD, AMPLITUDE=none\n5, 1, 5.\n": "there is no usable *AMPLITUDE 'NONE'",
    "*DLOAD\nBODY, CENTRIF, 1., 0., 0., 0., 0., 0., 1.\n": "a rotation (CENTRIF) needs the square of an angular velocity, and the axis x = 0",
    "*DLOAD\nBODY, CENTRIF, 1., 0., 0., 0., 0., 1., 0.\n": "a rotation (CENTRIF) is one of bodies of revolution (CAX) only",
    "*DLOAD\nBODY, HP, 1.\n": "a distributed load of type 'HP' is not taken",
    "*DLOAD\n1, P2, 5.\n": "a pressure acts between two elements",
    "*DSLOAD\nN_BODY_TOP, P, 5.\n": "'N_BODY_TOP' has nodes and no sides of elements, and the pressure on it is lost",
    "*DLOAD\nBODY, GRAV, 9.81, 0., 0., -1.\n": "gravity needs a direction in the plane",
    "*DLOAD\nHALF, GRAV, 9.81, 0., -1., 0.\n": "acts on a part of body 'BODY' only",
    "*BOUNDARY\nN_BODY_TOP, 3, 3, 0.1\n": "degree of freedom 3 is not one of a plane body",
}

REFUSED_MESHES = {
    "*NODE\n1, 0., 0.\n2, 1., 0.\n3, 0., 1.\n4, 0., 0., 1.\n*ELEMENT, TYPE=C3D5, ELSET=E\n1, 1, 2, 3, 4\n": "elements of type C3D5 are not read",
    "*NODE\n1, 0., 0.\n2, 1., 0.\n3, 0., 1.\n*ELEMENT, TYPE=SAX1, ELSET=E\n1, 1, 2\n": "is an axisymmetric shell, membrane or thermal element",
    "*NODE\n1, 0., 0.\n2, 1., 0.\n3, 0., 1.\n*ELEMENT, TYPE=S3, ELSET=E\n1, 1, 2, 3\n": "elements of type S3 are not taken",
    "": "the mesh is empty",
}


class Messages(Converting):
    def line_of(self, deck, text):
        return deck[:deck.index(text)].count("\n") + 1

    def test_notes(self):
        for part, message in NOTES.items():
            with self.subTest(part=part):
                deck = SQUARE + part + HELD + PRESSED
                run = self.convert(deck)
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertRegex(run.stderr, rf"part\.inp:\d+: warning: .*{re.escape(message)}")

    def test_two_amplitudes_of_one_load(self):
        twice = ("*STEP\n*STATIC\n*DLOAD, AMPLITUDE=UP\nBODY, GRAV, 9.81, 0., -1.\n"
                 "*DLOAD, AMPLITUDE=LATE\nBODY, GRAV, 1., 0., -1.\n*END STEP\n")
        tables = "*AMPLITUDE, NAME=UP\n0., 0., 1., 1.\n*AMPLITUDE, NAME=LATE\n0., 0., 0.5, 0., 1., 1.\n"
        run = self.convert(SQUARE + tables + HELD + twice)
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertEqual(run.stderr.count("two values with different amplitudes act on the same place"), 1, run.stderr)

    def test_what_is_lost(self):
        decks = {SQUARE + part + HELD + PRESSED: (part, message) for part, message in LOST.items()}
        halves = SQUARE + "*ELSET, ELSET=HALF\n1, 2\n" + HELD
        decks |= {halves + PRESSED.replace(END, part + END): (part, message) for part, message in LOST_IN_STEP.items()}
        for deck, (part, message) in decks.items():
            with self.subTest(part=part):
                (self.directory / "part.yaml").unlink(missing_ok=True)
                run = self.convert(deck)
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertRegex(run.stderr, rf"(?m)^part\.inp:\d+: (?!warning).*{re.escape(message)}")
                first = int(re.search(r"^part\.inp:(\d+): (?!warning)", run.stderr, re.MULTILINE).group(1))
                begin = self.line_of(deck, part)
                self.assertTrue(begin <= first < begin + part.count("\n") + 1, run.stderr)
                self.assertFalse((self.directory / "part.yaml").exists())

    def test_what_is_given_twice(self):
        """Programs differ in which of the two counts."""
        for part, message in TWICE.items():
            with self.subTest(part=part):
                run = self.convert(SQUARE + part + HELD + PRESSED)
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertRegex(run.stderr, rf"(?m)^part\.inp:\d+(:1)?: (?!warning).*{re.escape(message)}")

    def test_lines_without_a_name(self):
        self.converted(SQUARE + HELD + PRESSED.replace("*STATIC", "*STATIC, ,"))
        for line, message in (("*STATIC, =3\n", "*STATIC gives '=3' to no parameter"), ("*\n*STATIC\n", "this line names no keyword")):
            run = self.convert(SQUARE + HELD + PRESSED.replace("*STATIC\n", line))
            self.assertEqual(run.returncode, 1, run.stderr)
            self.assertRegex(run.stderr, rf"^part\.inp:57:1: {re.escape(message)}")

    def test_elements_and_sets_that_are_not_there(self):
        """Messages name the line, and what stands in it."""
        for line, message in (("*DLOAD\n77, P1, 5.\n", "*DLOAD: element 77 is not in the file"),
                              ("*DLOAD\nNOWHERE, P1, 5.\n", "*DLOAD: there is no element set 'NOWHERE'"),
                              ("*DLOAD\n, P1, 5.\n", "*DLOAD: the line names no element or element set"),
                              ("*DLOAD\n77, BX, 5.\n", "element 77 is not in the file"),
                              ("*DLOAD\nNOWHERE, GRAV, 9.81, 0., -1.\n", "there is no element set 'NOWHERE'"),
                              ("*DSLOAD\nNOWHERE, P, 5.\n", "there is no surface 'NOWHERE' with sides of plane elements")):
            with self.subTest(line=line):
                deck = SQUARE + HELD + PRESSED.replace(END, line + END)
                run = self.convert(deck)
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertRegex(run.stderr, rf"(?m)^part\.inp:{self.line_of(deck, line) + 1}(:1)?: {re.escape(message)}")

    def test_times_that_are_negative(self):
        for times in ("0.1, -1.", "-0.1, 1.", "0.1, 1., -1e-5"):
            run = self.convert(SQUARE + HELD + PRESSED.replace("*STATIC\n", f"*STATIC\n{times}\n"))
            self.assertEqual(run.returncode, 1, run.stderr)
            self.assertIn("an increment or the period of *STATIC is negative", run.stderr)

    def test_meshes_that_are_not_taken(self):
        for mesh, message in REFUSED_MESHES.items():
            with self.subTest(message=message):
                run = self.convert(mesh + MATERIAL + "*SOLID SECTION, ELSET=E, MATERIAL=steel\n" * bool(mesh) + STATIC + END)
                self.assertEqual(run.returncode, 1)
                self.assertIn(message, run.stderr)

    def test_elements_without_a_material(self):
        for section, words in (("*SOLID SECTION, ELSET=HALF, MATERIAL=steel\n", "element 3 and 1 more have no material"),
                               ("*SOLID SECTION, ELSET=REST, MATERIAL=steel\n", "element 1 has no material")):
            run = self.convert(grid(2, 2, 2.0, 2.0) + "*ELSET, ELSET=HALF\n1, 2\n*ELSET, ELSET=REST\n2, 3, 4\n" + MATERIAL + section + HELD + PRESSED)
            self.assertEqual(run.returncode, 1)
            self.assertIn(words, run.stderr)

    def test_an_incomplete_model(self):
        run = self.convert(SQUARE + "*PLASTIC\n235e6, 0.\n" + HELD + PRESSED, "--incomplete")
        self.assertEqual(run.returncode, 1)
        text = (self.directory / "part.yaml").read_text()
        self.assertRegex(text, r"(?m)^# Missing \(\d+\): \*PLASTIC of material 'steel'")
        self.assertEqual(scabo("run", "part.yaml", cwd=self.directory).returncode, 0)

    def test_new_loads_of_one_keyword_take_back_those_of_the_other(self):
        """CalculiX takes both back, Abaqus those of the same keyword: a deck must say which it means."""
        weight = STATIC + "*DLOAD\nBODY, GRAV, 9.81, 0., -1.\n" + END
        for later, noted in (("*DSLOAD, OP=NEW\nBODY_RIGHT, P, 1e6\n", True), ("*DSLOAD\nBODY_RIGHT, P, 1e6\n", False),
                             ("*DLOAD, OP=NEW\nBODY, GRAV, 5., 0., -1.\n", False),
                             ("*DSLOAD, OP=NEW\nBODY_RIGHT, P, 1e6\n*DLOAD, OP=NEW\nBODY, GRAV, 9.81, 0., -1.\n", False)):
            with self.subTest(later=later):
                run = self.convert(SQUARE + HELD + weight + STATIC + later + END)
                self.assertEqual(run.returncode, 1 if noted else 0, run.stderr)
                self.assertEqual("OP=NEW takes back the loads that *DLOAD of earlier steps" in run.stderr, noted, run.stderr)
        self.assertIn("gravity: 1", (self.directory / "part.yaml").read_text())

    def test_nothing_to_analyse(self):
        run = self.convert(SQUARE + HELD)
        self.assertEqual(run.returncode, 1)
        self.assertIn("the deck has no *STEP", run.stderr)

    def test_missing_file(self):
        run = scabo("convert", "none.inp", cwd=self.directory)
        self.assertEqual(run.returncode, 1)
        self.assertIn("none.inp: there is no such file", run.stderr)


class Broken(Converting):
    def test_truncated_and_changed_decks_end_with_a_message(self):
        whole = (grid(1, 1, 2.0, 1.0, elset="LOWER") + grid(1, 1, 2.0, 1.0, first=101, corner=(0.0, 1.0), elset="UPPER") + MATERIAL
                 + "*SOLID SECTION, ELSET=LOWER, MATERIAL=steel\n*SOLID SECTION, ELSET=UPPER, MATERIAL=steel\n" + Numbers.CONTACT
                 + "*AMPLITUDE, NAME=a\n0., 0., 1., 1.\n*BOUNDARY\nN_LOWER_BOTTOM, 1, 2\nN_UPPER_LEFT, 1\n" + STATIC
                 + "*DLOAD, AMPLITUDE=a\n101, P3, 1e6\nUPPER, GRAV, 9.81, 0., -1., 0.\n*CLOAD\n101, 2, -5.\n" + END).encode()
        choose = random.Random(1)
        for _ in range(60):
            deck = bytearray(whole[:choose.randrange(len(whole))] if choose.random() < 0.4 else whole)
            for _ in range(choose.randrange(1, 4)):
                at = choose.randrange(len(deck) or 1)
                deck[at:at + choose.randrange(3)] = choose.choice([b"", b"-", b"e9", b"999999999999", b",", b"*", b"\0", b"\xff", b"nan", b"\n"])
            run = self.convert(bytes(deck))
            self.assertIn(run.returncode, (0, 1), (bytes(deck), run.stderr))
            if run.returncode == 1:
                self.assertTrue(run.stderr.strip())


if __name__ == "__main__":
    support.main()
