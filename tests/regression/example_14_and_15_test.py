"""The checked numbers of examples/14_wall and 15_concrete_section."""
import subprocess
import sys
import zlib

import support


class Wall(support.OfDrawnExample):
    FOLDER = "14_wall"

    def test_reactions_are_weight_and_push(self):
        check = self.check()
        summary = support.summary_of(self.drawn_in / "wall.results")
        self.assertEqual(summary["model"]["super_elements"], check["blocks"])
        for increment, push in zip(summary["increments"], check["push"], strict=True):
            x, y = increment["reactions"]["ground"]
            self.assertAlmostEqual(y / check["weight"], 1.0, delta=check["relative_tolerance"])
            self.assertAlmostEqual(x / check["weight"], -push, delta=check["relative_tolerance"])


class ConcreteSection(support.OfDrawnExample):
    FOLDER = "15_concrete_section"

    def test_modulus_lies_between_its_bounds(self):
        check = self.check()
        share, first, second = check["aggregate"], 60e9, 20e9
        self.assertAlmostEqual(1 / (share / first + (1 - share) / second) / check["reuss"], 1.0, delta=1e-5)
        self.assertAlmostEqual((share * first + (1 - share) * second) / check["voigt"], 1.0, delta=1e-5)
        for order in (1, 2):
            reactions = support.summary_of(self.drawn_in / "concrete.results" / f"order_{order}")["increments"][-1]["reactions"]
            base, plate = reactions["base"][1], reactions["plate"][1]
            self.assertAlmostEqual(plate / base, -1.0, delta=check["relative_tolerance_of_balance"])
            modulus = base / (0.128 * 0.1 * 0.5e-3)
            self.assertGreater(modulus, check["reuss"])
            self.assertLess(modulus, check["voigt"])
        self.assertAlmostEqual(modulus / check["converged"], 1.0, delta=check["relative_tolerance"])

    def test_the_script_draws_the_image(self):
        example = support.ROOT / "examples" / self.FOLDER
        image = self.directory / "section.png"
        run = subprocess.run([sys.executable, example / "section.py", "-o", image], text=True, capture_output=True, timeout=support.PATIENCE)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn(f"{self.check()['aggregate']:.6f}", run.stdout)
        self.assertEqual(pixels_of(image), pixels_of(example / "section.png"))


def pixels_of(image):
    """The data of a PNG file, which different versions of zlib compress differently."""
    content, data, at = image.read_bytes(), b"", 8
    while at < len(content):
        length = int.from_bytes(content[at:at + 4], "big")
        if content[at + 4:at + 8] == b"IDAT":
            data += content[at + 8:at + 8 + length]
        at += length + 12
    return zlib.decompress(data)


if __name__ == "__main__":
    support.main()
