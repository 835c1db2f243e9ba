"""What the pictures show, as arrays: equal to the files, and right for shapes and sizes that are known."""
import dataclasses
import pathlib
import tempfile
import unittest
import warnings

import made_up
import numpy as np
import plot
from matplotlib.collections import PathCollection, PolyCollection
from plot import contacts, fields, geometry, style, vtu


class WithResults(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="scabo_test_")
        self.addCleanup(holder.cleanup)
        self.addCleanup(style.plt.close, "all")
        self.directory = made_up.write(pathlib.Path(holder.name) / "made_up.results")
        self.results = plot.Results(self.directory)


class Vtu(WithResults):
    def test_all_encodings_give_the_arrays_written(self):
        wanted = made_up.grid()
        for encoding in ("text", "raw", "zlib"):
            path = self.directory / f"{encoding}.vtu"
            made_up.vtu(path, wanted, encoding)
            grid = vtu.read_grid(path)
            np.testing.assert_array_equal(grid.points, wanted["Points"][:, :2])
            np.testing.assert_array_equal(grid.connectivity, wanted["connectivity"])
            np.testing.assert_array_equal(grid.types, wanted["types"])
            np.testing.assert_array_equal(grid.point_data["displacement"], wanted["point"]["displacement"])
            np.testing.assert_allclose(grid.point_data["von_mises"], wanted["point"]["von_mises"], rtol=1e-7)

    def test_files_cut_anywhere_are_refused(self):
        path = self.directory / "cut.vtu"
        for encoding in ("text", "raw", "zlib"):
            made_up.vtu(path, made_up.grid(), encoding)
            whole = path.read_bytes()
            tail = len(b"\n</AppendedData>\n</VTKFile>\n")
            for length in np.linspace(0, len(whole) - tail - 1, 60).astype(int):
                path.write_bytes(whole[:length])
                with self.assertRaises(vtu.FormatError, msg=f"{encoding}, {length} of {len(whole)} bytes"):
                    vtu.read_grid(path)

    def test_an_array_that_is_cut_is_named_as_such(self):
        path = self.directory / "cut.vtu"
        made_up.vtu(path, made_up.grid())
        path.write_bytes(path.read_bytes()[:-len(b"\n</AppendedData>\n</VTKFile>\n") - 1])
        with self.assertRaisesRegex(vtu.FormatError, "ends in the middle of an array"):
            vtu.read_grid(path)

    def test_other_encodings_are_refused(self):
        path = self.directory / "base64.vtu"
        made_up.vtu(path, made_up.grid())
        path.write_bytes(path.read_bytes().replace(b'encoding="raw"', b'encoding="base64"'))
        with self.assertRaisesRegex(vtu.FormatError, "not raw"):
            vtu.read_grid(path)


class Geometry(WithResults):
    def test_triangles_cover_every_elastic_cell_once(self):
        grid = self.results.fields(1)
        triangles = geometry.triangles(grid)
        areas = geometry.areas(grid.points, triangles)
        x = grid.points[triangles].mean(axis=1)[:, 0]
        for first, area in ((0, 0.5), (2, 1.0), (4, 0.5), (6, 1.0)):
            self.assertAlmostEqual(areas[(x > first) & (x < first + 1)].sum(), area)
        self.assertEqual(len(geometry.rigid_outlines(grid)), 1)

    def test_outlines_are_the_boundaries_of_the_bodies(self):
        grid = self.results.fields(1)
        sides = geometry.outline(geometry.triangles(grid))
        lengths = np.hypot(*(grid.points[sides[:, 1]] - grid.points[sides[:, 0]]).T)
        self.assertAlmostEqual(lengths.sum(), 2 * (2 + np.sqrt(2)) + 2 * 4)

    def test_arc_length_of_a_polygon(self):
        angles = np.linspace(0, np.pi / 2, 101)
        chord = 2 * np.sin(np.pi / 400)
        np.testing.assert_allclose(geometry.arc_length(np.cos(angles), np.sin(angles)), chord * np.arange(101), rtol=1e-12)

    def test_magnification_is_round_and_counts_deformation_only(self):
        grid = self.results.fields(1)
        factor = geometry.magnification(grid)
        digit = factor / 10 ** np.floor(np.log10(factor))
        self.assertIn(round(digit, 9), (1, 2, 5))
        grid.point_data["displacement"] = 1e-6 * grid.point_data["displacement"]
        small = geometry.magnification(grid)
        self.assertAlmostEqual(np.log10(small / factor), 6, delta=0.5)
        grid.point_data["displacement"] = grid.point_data["displacement"] + [1e-3, 0, 0]
        self.assertAlmostEqual(geometry.magnification(grid) / small, 1.0)

    def test_magnification_does_not_draw_bodies_through_each_other(self):
        grid = self.results.fields(1)
        grid.point_data["displacement"] = 1e-4 * grid.point_data["displacement"]
        free = geometry.magnification(grid)
        rows = {"gap": np.array([0.0, 0.0]), "normal_displacement_a": np.array([0.0, 0.0]), "normal_displacement_b": np.array([-1e-4, 0.0])}
        factor = geometry.magnification(grid, [rows])  # a pair that was 1e-4 apart has closed
        self.assertLess(factor, free)
        self.assertLessEqual(factor * 1e-4 - 1e-4, 0.004 * geometry.extent(grid.points))
        self.assertGreater(5 * factor * 1e-4, 0.004 * geometry.extent(grid.points))

    def test_magnification_in_a_window_is_that_of_its_points(self):
        grid = self.results.fields(1)
        x = grid.points[:, 0]
        grid.point_data["displacement"] = np.where(x < 1.5, 1e-6, 1e-3)[:, None] * np.column_stack([x, 0 * x, 0 * x])
        whole, part = geometry.magnification(grid), geometry.magnification(grid, window=(0.0, 1.0, 0.0, 1.0))
        self.assertGreater(part, 100 * whole)
        seen = 0.04 * np.sqrt(2) / (1e-6 * (1 - 1 / 3))  # of (0, 0), (1, 0), (0, 1) the mean is at 1/3
        self.assertLessEqual(part, seen)
        self.assertGreater(2.51 * part, seen)

    def test_nodes_end_where_the_outline_leaves_them(self):
        ring = np.array([[0, 1], [1, 2], [2, 3], [0, 3], [8, 9], [9, 10], [10, 11], [8, 11]])  # of unbounded ground around four nodes
        np.testing.assert_array_equal(geometry.nodes_on(ring, 0), [0, 1, 2, 3])
        cracked = np.array([[0, 1], [1, 2], [0, 3], [2, 5], [3, 6], [5, 8]])  # open: the faces go on to other rings
        np.testing.assert_array_equal(geometry.nodes_on(cracked, 0), [0, 1, 2])

    def test_points_between_nodes_belong_to_the_boundary(self):
        ring = np.array([[0, 3], [1, 3], [1, 4], [2, 4], [2, 5], [0, 5]])  # three nodes, a point between each two
        np.testing.assert_array_equal(geometry.nodes_on(ring, 0), [0, 1, 2])
        np.testing.assert_array_equal(geometry.boundary_sides(ring, [0, 1, 2]), ring)
        cracked = np.array([[0, 3], [1, 3], [1, 4], [2, 4], [0, 5], [2, 7], [5, 10], [7, 10]])  # faces to the next ring, and the tip
        np.testing.assert_array_equal(geometry.nodes_on(cracked, 0), [0, 1, 2])
        np.testing.assert_array_equal(geometry.boundary_sides(cracked, [0, 1, 2]), cracked[:4])

    def test_quadrilaterals_are_divided_by_their_shorter_diagonal(self):
        for shift, diagonal in ((0.7, {1, 3}), (-0.7, {0, 2}), (0.0, {0, 2})):
            points = np.array([[0, 0], [1, 0], [1 + shift, 1], [shift, 1]], dtype=float)
            grid = vtu.Grid(points, np.arange(4), np.array([4]), np.array([vtu.QUAD]), {}, {})
            first, second = (set(corners) for corners in geometry.triangles(grid).tolist())
            self.assertEqual(first & second, diagonal)
            self.assertAlmostEqual(geometry.areas(points, geometry.triangles(grid)).sum(), 1.0)

    def test_moved_points(self):
        grid = self.results.fields(1)
        x, y = grid.points.T
        np.testing.assert_allclose(geometry.moved(grid, 10.0), np.column_stack([1.1 * x, 0.8 * y]))

    def test_typical_range_leaves_out_a_spike_only(self):
        values = np.concatenate([np.linspace(-1, 2, 1000), [500.0]])
        weights = np.concatenate([np.ones(1000), [0.5]])
        low, high = geometry.typical_range(values, weights)
        self.assertEqual(low, -1.0)
        self.assertLess(high, 2.01)
        self.assertEqual(geometry.typical_range(values[:-1], weights[:-1]), (-1.0, 2.0))


class Levels(unittest.TestCase):
    def test_levels_cover_the_range_with_few_bands(self):
        for low, high in ((0, 1), (0, 6.13e6), (-3, 5), (-5, 0.01), (-7, -6.9), (1e-9, 3e-9), (-0.02, 8), (4, 4), (0, 0), (-1e6, -1e3)):
            levels = style.levels_of(low, high)
            self.assertTrue((np.diff(levels) > 0).all(), (low, high))
            self.assertLessEqual(len(levels), 19)
            small = 0.05 * max(abs(low), abs(high), 1e-300)
            self.assertLessEqual(levels[0], low + small)
            self.assertGreaterEqual(levels[-1], high - small)

    def test_both_signs_have_a_band_around_zero(self):
        levels = style.levels_of(-3.3, 5.1)
        np.testing.assert_allclose(levels, -levels[::-1])
        self.assertNotIn(0.0, levels)
        self.assertIn(0.0, [round(tick, 12) for tick in fields.bar_ticks(levels)])

    def test_units(self):
        units = plot.Units.parse("m,N")
        for dimension, largest, factor, unit in (("stress", 3.2e6, 1e-6, "MPa"), ("stress", 40e9, 1e-9, "GPa"), ("length", 5e-5, 1e6, "µm"),
                                                 ("length", 6.0, 1, "m"), ("force", 5e4, 1e-3, "kN"), ("energy", 3.0, 1, "J")):
            scale = units.scale(dimension, largest)
            self.assertAlmostEqual(scale.factor / factor, 1.0)
            self.assertEqual(scale.unit, unit)
        scale = plot.Units.parse("mm,N").scale("stress", 250.0)
        self.assertAlmostEqual(scale.factor, 1.0)
        self.assertEqual(scale.unit, "MPa")
        self.assertEqual(plot.Units.parse("in,lbf").scale("stress", 3e4).unit, "10³ lbf / in²")
        self.assertEqual(plot.Units().scale("stress", 3.0).unit, "force / length²")
        scale = plot.Units().scale("length", 2e-4)
        self.assertAlmostEqual(scale.factor * 2e-4, 200.0)
        self.assertEqual(scale.unit, "10⁻⁶ length")


class Fields(WithResults):
    def test_values_are_those_of_the_file(self):
        field = fields.field_of(self.results, 2, "xx")
        x = field.grid.points[:, 0]
        elastic = np.arange(len(x)) < len(x) - 4
        np.testing.assert_allclose(field.values[elastic], (2 * x - 5)[elastic], rtol=1e-6)
        self.assertTrue(np.isnan(field.values[~elastic]).all(), "rigid bodies have no stress")
        self.assertEqual(field.grid.points[field.largest][0], 7.0)
        field = fields.field_of(self.results, 2, "uy", 0)
        np.testing.assert_allclose(field.values, -0.04 * field.grid.points[:, 1])
        np.testing.assert_array_equal(field.points, field.grid.points)

    def test_a_stress_at_a_crack_tip_is_no_number(self):
        field = fields.field_of(self.results, 2, "xx")
        units = plot.Units("m", "N")
        scale, place = units.scale("stress", max(map(abs, field.range))), units.scale("length", 7.0)
        self.assertRegex(fields.described(field, scale, place), r"largest .*Pa at \(7,")
        values = field.values.copy()
        values[field.largest] *= 1e5
        text = fields.described(dataclasses.replace(field, values=values), scale, place)
        self.assertRegex(text, r"grows without bound at \(7,")
        self.assertNotIn("largest", text)

    def test_without_stress_the_displacement_is_shown(self):
        grid = self.results.fields(1)
        self.assertEqual(fields.default_component(grid), "von_mises")
        del grid.point_data["von_mises"]
        self.assertEqual(fields.default_component(grid), "xx")
        del grid.point_data["stress_xx"]
        self.assertEqual(fields.default_component(grid), "displacement")

    def test_a_window_limits_what_is_seen(self):
        field = fields.field_of(self.results, 1, "von_mises", 0, (2.0, 3.0, 0.0, 1.0))
        self.assertEqual(field.range[1], 6.0)  # 3 + x of the square between 2 and 3
        self.assertEqual(fields.field_of(self.results, 1, "von_mises", 0).range[1], 10.0)

    def test_gaps_are_closed_and_lines_stay(self):
        figure = plot.stress(self.results, component="xx")
        collections = [part for part in figure.axes[0].collections if isinstance(part, PathCollection)]
        bands = [part for part in collections if len(part.get_facecolor())]
        lines = [part for part in collections if not len(part.get_facecolor())]
        before = [part.get_edgecolor().tolist() for part in lines]
        style.close_gaps(figure)
        self.assertEqual([part.get_edgecolor().tolist() for part in lines], before)
        self.assertTrue(lines and bands and all(len(edges) for edges in before))
        for part in bands:
            np.testing.assert_array_equal(part.get_edgecolor(), part.get_facecolor())

    def test_no_arrow_for_what_rounding_leaves_beyond_the_colours(self):
        levels = np.array([0.0, 0.5, 1.0])
        values = fields.within_rounding(np.array([-1e-9, 0.3, 1.0 + 1e-7]), levels)
        np.testing.assert_array_equal(values, [0.0, 0.3, 1.0])
        self.assertEqual(fields.ends_of(values, levels), "neither")
        beyond = np.array([-0.1, 0.3, 1.1, np.nan])
        np.testing.assert_array_equal(fields.within_rounding(beyond, levels), beyond)
        self.assertEqual(fields.ends_of(beyond, levels), "both")

    def test_picture(self):
        figure = plot.stress(self.results, component="xx")
        axis, bar = figure.axes
        self.assertIn("stress xx", bar.get_ylabel() + bar.get_xlabel())
        self.assertIn("deformation × ", " ".join(text.get_text() for text in figure.texts))
        self.assertEqual(figure.texts[0].get_text(), "A title with $ and _ in it")
        self.assertIn("the run ended as not converged", " ".join(text.get_text() for text in figure.texts))
        self.assertNotIn("the run ended", " ".join(text.get_text() for text in plot.stress(self.results, 1).texts))
        self.assertTrue([c for c in axis.collections if isinstance(c, PolyCollection)], "the rigid body")


class Contacts(WithResults):
    def rows(self, step, contact):
        return [row for row in made_up.contact_rows() if row[0] == step and row[2] == contact]

    def test_lines_are_the_rows_of_the_increment(self):
        for step in (1, 2):
            lines = contacts.lines_of(self.results, step)
            self.assertEqual([line.name for line in lines], ["bend", "_seat"])
            for line in lines:
                rows = self.rows(step, line.name)
                for key, column in (("pressure", 10), ("shear", 11), ("gap", 6), ("slip", 7)):
                    np.testing.assert_array_equal(line.values[key], [row[column] for row in rows])
                self.assertEqual(list(line.states), [row[12] for row in rows])
        chord = 2 * np.sin(np.pi / 32)
        np.testing.assert_allclose(lines[0].distance, chord * np.arange(9), rtol=1e-12)

    def test_the_curves_drawn_are_the_rows_in_the_units_of_the_axis(self):
        figure = plot.contact(self.results, 2, ["bend"], units=plot.Units("m", "N"))
        axes = {axis.get_ylabel().replace("\n", " "): axis for axis in figure.axes}
        rows = self.rows(2, "bend")
        for label, column, factor in (("pressure (MPa)", 10, 1e-6), ("shear (MPa)", 11, 1e-6), ("gap (mm)", 6, 1e3), ("slip (mm)", 7, 1e3)):
            curve = axes[label].lines[1]
            np.testing.assert_allclose(curve.get_ydata(), [factor * row[column] for row in rows])

    def test_shear_that_the_mesh_leaves_is_drawn_small(self):
        line = contacts.lines_of(self.results, 2, ["bend"])[0]
        pressure = np.abs(line.values["pressure"]).max()
        line.values["shear"] = 1e-2 * pressure * np.sin(line.distance)
        for factor, small in ((1.0, False), (1e-3, True)):
            line.values["shear"] = factor * line.values["shear"]
            figure = contacts.contact_curves(self.results, 2, [line], plot.Units("m", "N"), contacts.CURVES)
            axis = next(axis for axis in figure.axes if axis.get_ylabel().startswith("shear"))
            drawn = np.abs(axis.lines[1].get_ydata()).max() / np.ptp(axis.get_ylim())
            self.assertEqual(drawn < 0.01, small)

    def test_curves_of_zeros_have_words_and_no_scale(self):
        line = contacts.lines_of(self.results, 2, ["bend"])[0]
        zeros = {key: np.zeros(9) for key in line.values}
        draw = lambda *lines: contacts.contact_curves(self.results, 2, list(lines), plot.Units("m", "N"), contacts.CURVES)
        texts = lambda figure: [" ".join(text.get_text() for text in axis.texts) for axis in figure.axes]
        closed = dataclasses.replace(line, values={**line.values, "gap": zeros["gap"]}, states=np.full(9, "stick"))
        figure = draw(closed)
        self.assertEqual(texts(figure), ["", "", "no gap: all pairs are closed", ""])
        self.assertEqual([len(axis.get_yticks()) for axis in figure.axes][2], 1)
        self.assertGreater(min(len(axis.get_yticks()) for axis in figure.axes[:2]), 2)
        self.assertEqual(texts(draw(dataclasses.replace(line, values={**zeros, "gap": line.values["gap"]}, states=np.full(9, "open")))),
                         ["no pressure: all pairs are open", "no shear", "", "no slip"])
        self.assertEqual(texts(draw(closed, closed))[4:6], ["no gap: all pairs are closed"] * 2)
        self.assertEqual(texts(draw(closed, line))[4:6], ["", ""])  # they have one axis

    def test_states_differ_in_mark_and_are_where_they_are(self):
        marks = [(mark, filled) for _, mark, filled in style.STATES.values()]
        self.assertEqual(len(set(marks)), 3)
        figure = plot.contact(self.results, 2, ["bend"], "pressure")
        curve, *marked = figure.axes[0].lines[1:]
        states = np.array([row[12] for row in self.rows(2, "bend")])
        for (state, (_, mark, _)), drawn in zip(style.STATES.items(), marked):
            self.assertEqual(drawn.get_marker(), mark)
            np.testing.assert_array_equal(drawn.get_ydata(), curve.get_ydata()[states == state])

    def test_long_runs_keep_a_mark_at_their_ends(self):
        states = np.array(["stick"] * 500 + ["slip"] * 301 + ["open"] * 700)
        shown = style.marked(states, 60)
        self.assertTrue(shown[[0, 499, 500, 800, 801, 1500]].all())
        self.assertLess(shown.sum(), 70)

    def test_parts_of_a_map_join_without_gaps(self):
        x, y = np.array([0.0, 1.0, 4.0]), np.array([0.0, 0.0, 4.0])
        parts = contacts.middles(x, y)
        np.testing.assert_array_equal(parts[:, 1], np.column_stack([x, y]))
        np.testing.assert_array_equal(parts[1:, 0], parts[:-1, 2])
        np.testing.assert_allclose(np.hypot(*np.diff(parts, axis=1).reshape(-1, 2).T).sum(), 6.0)

    def test_widths_are_in_proportion(self):
        widths, widest = contacts.widths_of(np.array([0.0, -2.0, 1.0]))
        np.testing.assert_allclose(widths, [0, 7, 3.5])
        self.assertEqual(widest, 2.0)
        widths, widest = contacts.widths_of(np.concatenate([np.ones(99), [1000.0]]))
        self.assertEqual(widest, 1.0)
        np.testing.assert_allclose(widths, 7.0)

    def test_rounding_of_gaps_is_zero(self):
        rows = {"gap": np.array([1e-19, -3e-17, 2e-9]), "x": np.array([0.0, 1.0, 2.0]), "y": np.zeros(3),
                "normal_displacement_a": np.full(3, 1e-3), "normal_displacement_b": np.full(3, 1e-3), "slip": np.array([1e-9, 0, 1e-20]),
                "tangential_displacement_a": np.zeros(3), "tangential_displacement_b": np.zeros(3)}
        np.testing.assert_array_equal(contacts.without_rounding(rows, "slip", "tangential"), [1e-9, 0, 0])
        np.testing.assert_array_equal(contacts.without_rounding(rows, "gap", "normal"), [0, 0, 2e-9])

    def test_a_small_part_in_contact_is_shown_alone(self):
        distance = np.linspace(0, 1, 101)
        states = np.where(np.abs(distance - 0.5) < 0.025, "slip", "open")
        line = contacts.Line("touch", distance, distance, 0 * distance, {}, states)
        np.testing.assert_allclose(contacts.part_in_contact(line), (0.48 - 0.024, 0.52 + 0.024))
        at_the_end = dataclasses.replace(line, states=np.where(distance > 0.965, "stick", "open"))
        np.testing.assert_allclose(contacts.part_in_contact(at_the_end), (0.97 - 0.018, 1.0))
        self.assertIsNone(contacts.part_in_contact(dataclasses.replace(line, states=np.full(101, "slip"))))
        self.assertIsNone(contacts.part_in_contact(dataclasses.replace(line, states=np.full(101, "open"))))

class NoOverlap(WithResults):
    def map_of_a_tower(self, upright):
        """Pairs of five contacts above or beside each other, with a peak of pressure, which the text names."""
        line, along, lines = contacts.lines_of(self.results, 2, ["bend"])[0], np.linspace(0, 1, 9), []
        self.results.last_fields = lambda: None
        for k in range(5):
            values = {key: np.where(line.distance == 0, 5e7, 1.234e6) for key in line.values}
            x, y = (0.25 * along, np.full(9, 0.5 * k)) if upright else (along + k, np.full(9, 0.5 * k))
            lines.append(dataclasses.replace(line, x=x, y=y, distance=along, values=values))
        with style.plt.rc_context(style.SETTINGS):
            return contacts.contact_map(self.results, 2, lines, plot.Units("m", "N"), "pressure")

    def slender_map(self):
        grid = self.results.fields(2)
        slender = plot.Results(self.directory)
        slender.fields = lambda number: dataclasses.replace(grid, points=grid.points * [0.02, 1.0])
        return plot.stress(slender, units=plot.Units("m", "N"))

    def test_texts_of_a_picture_do_not_overlap(self):
        self.results.title = "A WIDE Title OF MANY Words, " * 12
        for figure in (plot.stress(self.results), plot.contact(self.results), plot.history(self.results), plot.convergence(self.results),
                       self.slender_map(), self.map_of_a_tower(True), self.map_of_a_tower(False)):
            with warnings.catch_warnings():
                warnings.simplefilter("error")  # a layout that does not fit
                figure.canvas.draw()
            renderer = figure.canvas.get_renderer()
            texts = list(figure.texts) + [text for legend in figure.legends for text in legend.get_texts()]
            for axis in figure.axes:
                if axis.get_visible():
                    if legend := axis.get_legend():
                        self.assertTrue(legend.get_frame_on() and legend.get_frame().get_alpha() == 1, "lines go through a legend")
                    texts += [axis.title, axis._left_title, axis.xaxis.label, axis.yaxis.label]
                    for scale, (low, high) in ((axis.xaxis, sorted(axis.get_xlim())), (axis.yaxis, sorted(axis.get_ylim()))):
                        texts += [tick.label1 for tick in scale.get_major_ticks() if low <= tick.get_loc() <= high]
            boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in texts if text.get_text() and text.get_visible()]
            frame = figure.bbox
            for k, (name, box) in enumerate(boxes):
                self.assertTrue(box.x0 >= frame.x0 - 1 and box.x1 <= frame.x1 + 1 and box.y0 >= frame.y0 - 1 and box.y1 <= frame.y1 + 1,
                                f"'{name}' leaves the picture")
                for other, against in boxes[k + 1:]:
                    across = min(box.x1, against.x1) - max(box.x0, against.x0)
                    up = min(box.y1, against.y1) - max(box.y0, against.y0)
                    self.assertFalse(across > 1 and up > 1, f"'{name}' overlaps '{other}'")


if __name__ == "__main__":
    unittest.main()
