"""Bodies that images show: levels without a material, ranges of levels, and empty pixels on the border of the image."""
import struct
import zlib

import support
from support import InTemporaryDirectory, scabo, summary_of


def write_png(file, rows, opacity=None):
    """Eight bits of grey, and of opacity if it is given; the first row is the top one."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    samples = lambda row: row if opacity is None else [value for level in row for value in (level, opacity)]
    raw = b"".join(b"\0" + bytes(samples(row)) for row in rows)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0 if opacity is None else 4, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


class Images(InTemporaryDirectory):
    def run_model(self, text, name="model", status=0):
        file = self.directory / f"{name}.yaml"
        file.write_text(text, encoding="utf-8")
        run = scabo("run", file, "-o", self.directory / f"{name}.results", "--quiet")
        self.assertEqual(run.returncode, status, run.stderr)
        return run

    def push(self, name="model"):
        return summary_of(self.directory / f"{name}.results")["increments"][-1]["reactions"]["push"]


LAYERS = """scabo: 1
materials: {{soft: {{young: 1e9, poisson: 0.2}}, stiff: {{young: 2e10, poisson: 0.2}}}}
bodies:
  wall:
    shape: {{image: {{file: {file}, pixel: 1e-3, materials: {levels}}}}}
    mesh: {{kind: quadtree, size: 0.008}}
supports:
  - {{on: wall.bottom, fix: [x, y]}}
  - {{on: wall.top, displacement: [null, -1e-5], name: push}}
"""


class Levels(Images):
    """A stiff layer on a soft one. In the smoothed image half of the row between them is grey."""

    def setUp(self):
        super().setUp()
        sharp = [[255] * 32 for _ in range(16)] + [[0] * 32 for _ in range(16)]
        smooth = [list(row) for row in sharp]
        smooth[15][8:24] = [128] * 16
        write_png(self.directory / "sharp.png", sharp)
        write_png(self.directory / "smooth.png", smooth)

    def force(self, file, levels, name):
        self.said = self.run_model(LAYERS.format(file=file, levels=levels), name).stderr
        return -self.push(name)[1]

    def test_levels_without_a_material_are_told(self):
        self.assertAlmostEqual(self.force("smooth.png", "{0: soft, 255: stiff}", "empty"), 13972, delta=1)
        self.assertIn("bodies.wall.shape.image.materials: 16 of 1024 pixels are empty, because their level, 128, has no material",
                      self.said)
        self.assertEqual(len(summary_of(self.directory / "empty.results")["warnings"]), 1)

    def test_ranges_of_levels_give_what_a_sharp_image_gives(self):
        sharp = self.force("sharp.png", "{0: soft, 255: stiff}", "sharp")
        self.assertAlmostEqual(sharp, 19426.11, delta=0.01)
        self.assertEqual(self.said, "")
        for levels in ("{0-127: soft, 128-255: stiff}", "{0: soft, 1-255: stiff}", "{0-100: soft, 128: stiff, 200-255: stiff}"):
            with self.subTest(levels):
                self.assertAlmostEqual(self.force("smooth.png", levels, "ranges") / sharp, 1.0, delta=1e-12)
                self.assertEqual(self.said, "")

    def test_levels_that_are_meant_to_be_empty_are_not_told(self):
        for levels in ("{0: soft, 255: stiff, 128: empty}", "{0-99: soft, 100-200: empty, 201-255: stiff}"):
            with self.subTest(levels):
                self.assertAlmostEqual(self.force("smooth.png", levels, "meant"), 13972, delta=1)
                self.assertEqual(self.said, "")

    def test_transparent_pixels_are_told(self):
        for opacity, word in ((255, ""), (128, "bodies.wall.shape.image.file: 1024 of 1024 pixels are transparent, and count by their level of grey")):
            write_png(self.directory / "clear.png", [[255] * 32] * 16 + [[0] * 32] * 16, opacity)
            self.assertAlmostEqual(self.force("clear.png", "{0: soft, 255: stiff}", "clear"), 19426.11, delta=0.01)
            self.assertIn(word, self.said) if word else self.assertEqual(self.said, "")

    def test_a_range_without_pixels_is_told(self):
        self.force("sharp.png", "{0-127: soft, 128-254: soft, 255: stiff}", "absent")
        self.assertIn("materials.128-254: no pixel of the image has one of these levels: it has 0, 255", self.said)


NOTCHED = """scabo: 1
materials: {m: {young: 1e9, poisson: 0.2}}
bodies:
  wall:
%s
    mesh: {kind: quadtree, size: 1}
supports:
  - {on: wall.%s, fix: [x, y]}
  - {on: wall.%s, displacement: [%s], name: push}
"""
OF_IMAGE = "    shape: {image: {file: notch.png, pixel: 1, materials: {0: empty, 255: m}}}"
OF_POLYGON = "    material: m\n    shape: {polygon: {vertices: %s}}"
NOTCH = [[0, 0], [3, 0], [3, 1], [2, 1], [2, 2], [3, 2], [3, 3], [0, 3]]  # its sides are 3, 1, 1, 1, 1, 1, 3, 3 long


def turned(rows):
    """Counter-clockwise."""
    return [list(column) for column in zip(*rows)][::-1]


class EmptyPixelsOnTheBorder(Images):
    """A block of nine pixels without the middle one of its right side, turned in all ways."""

    def test_forces_are_those_of_the_polygon_however_it_is_turned(self):
        rows = [[255, 255, 255], [255, 255, 0], [255, 255, 255]]
        points = NOTCH
        sides = ["bottom", "right", "top", "left"]
        for turn in range(4):
            with self.subTest(turn=turn):
                write_png(self.directory / "notch.png", rows)
                held, pushed = sides[turn], sides[(2 + turn) % 4]
                value = ["null, -1e-3", "1e-3, null", "null, 1e-3", "-1e-3, null"][turn]
                self.run_model(NOTCHED % (OF_IMAGE, held, pushed, value), "image")
                self.run_model(NOTCHED % (OF_POLYGON % points, "edge_1", "edge_7", value), "polygon")
                image, polygon = self.push("image"), self.push("polygon")
                along = 1 if turn % 2 == 0 else 0
                self.assertAlmostEqual(abs(polygon[along]), 712073, delta=1)
                self.assertAlmostEqual(image[along] / polygon[along], 1.0, delta=1e-10)
            rows = turned(rows)
            points = [[3 - y, x] for x, y in points]

    def test_an_edge_in_two_pieces_is_held_and_loaded_on_both(self):
        """The notch is in the edge: the two pieces of the polygon are two edges."""
        write_png(self.directory / "notch.png", [[255, 255, 255], [255, 255, 0], [255, 255, 255]])
        self.run_model(NOTCHED % (OF_IMAGE, "left", "right", "1e-3, null"), "image")
        polygon = NOTCHED % (OF_POLYGON % NOTCH, "edge_8", "edge_2", "1e-3, null")
        self.run_model(polygon + "  - {on: wall.edge_6, displacement: [1e-3, null], name: other}\n", "polygon")
        both = summary_of(self.directory / "polygon.results")["increments"][-1]["reactions"]
        self.assertAlmostEqual(self.push("image")[0] / (both["push"][0] + both["other"][0]), 1.0, delta=1e-10)
        loads = "loads: {total: {on: wall.right, force: [6e3, 0]}, turn: {on: wall.right, moment: 1e3}}\n"
        text = NOTCHED % (OF_IMAGE, "left", "right", "1e-3, null")
        self.run_model(text[:text.rindex("  - {")] + loads, "loaded")
        reactions = summary_of(self.directory / "loaded.results")["increments"][-1]["reactions"]
        self.assertAlmostEqual(reactions["wall.left"][0], -6e3, delta=1e-6)

    def test_rows_without_material_at_the_border_do_not_count(self):
        """The same block in a larger image, in the same place."""
        rows = [[255, 255, 255], [255, 255, 0], [255, 255, 255]]
        write_png(self.directory / "notch.png", [[0] * 6, *[[0, 0, *row, 0] for row in rows], [0] * 6])
        text = NOTCHED % (OF_IMAGE.replace("pixel: 1,", "pixel: 1, corner: [-2, -1],"), "bottom", "top", "null, -1e-3")
        self.run_model(text + "output: {points: [{at: [0.5, 2.5], body: wall}]}\n", "image")
        self.assertAlmostEqual(self.push("image")[1], -712073, delta=1)

    def test_corners_whose_pixel_is_empty_are_refused(self):
        write_png(self.directory / "notch.png", [[255, 255, 0], [255, 255, 255]])
        text = NOTCHED % (OF_IMAGE, "bottom", "top_right", "null, -1e-3")
        run = self.run_model(text, status=1)
        self.assertIn("the pixel of the image at 'wall.top_right' is empty: name an edge, or a point by 'near'", run.stderr)
        self.run_model(NOTCHED % (OF_IMAGE, "bottom", "top_left", "null, -1e-3"))

    def test_contact_of_an_interrupted_edge(self):
        """With a rigid floor both pieces carry; with an elastic body it is refused."""
        write_png(self.directory / "notch.png", [[255, 255, 255], [255, 0, 255]])
        floor = "  floor: {%s shape: {rectangle: {corner: [-1, -1], size: [5, 1]}}%s}\n"
        rest = ("supports: [{on: floor.bottom, fix: [x, y]}]\ncontacts: {base: {between: [floor.top, wall.bottom], friction: 0.4}}\n"
                "loads: {press: {on: wall.top, pressure: 1e6}}\n")
        text = NOTCHED[:NOTCHED.index("supports")] % OF_IMAGE
        self.run_model(text + floor % ("rigid: true,", "") + rest.replace("floor.bottom", "floor"), "rigid")
        increment = summary_of(self.directory / "rigid.results")["increments"][-1]
        self.assertAlmostEqual(increment["contacts"]["base"]["normal_force"], 3e6, delta=1e-3)
        self.assertEqual(increment["contacts"]["base"]["open"], 0)
        polygon = OF_POLYGON % [[0, 0], [1, 0], [1, 1], [2, 1], [2, 0], [3, 0], [3, 2], [0, 2]]
        two = rest.replace("floor.bottom", "floor").replace(
            "contacts: {base: {between: [floor.top, wall.bottom], friction: 0.4}}",
            "contacts: {one: {between: [floor.top, wall.edge_1], friction: 0.4}, two: {between: [floor.top, wall.edge_5], friction: 0.4}}")
        text_of_polygon = NOTCHED[:NOTCHED.index("supports")] % polygon + floor % ("rigid: true,", "")
        self.run_model(text_of_polygon + two.replace("wall.top", "wall.edge_7"), "polygon")
        of_polygon = summary_of(self.directory / "polygon.results")["increments"][-1]
        self.assertAlmostEqual(increment["energy"]["elastic"] / of_polygon["energy"]["elastic"], 1.0, delta=1e-9)
        run = self.run_model(text + floor % ("material: m,", ", mesh: {size: 0.5}") + rest, "elastic", status=1)
        self.assertIn("empty pixels interrupt 'wall.bottom', but the contact of two elastic bodies needs an unbroken edge", run.stderr)


if __name__ == "__main__":
    support.main()
