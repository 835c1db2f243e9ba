"""Curves and what is drawn in time, as arrays: equal to the tables of the run, and right for motions that are known."""
import dataclasses
import unittest

import made_up
import numpy as np
import plot
from arrays_test import WithResults
from plot import curves, in_time, meshes, style


class Curves(WithResults):
    def test_history_is_the_summary(self):
        panel = curves.forces(self.results)
        self.assertEqual([curve.name for curve in panel.curves], ["bend, n", "bend, t", "_seat, n", "_seat, t"])
        np.testing.assert_allclose([curve.y for curve in panel.curves], [[100, 200], [-30, -60], [40, 80], [-12, -24]])
        np.testing.assert_allclose(panel.curves[0].x, [1, 2])
        np.testing.assert_allclose([curve.y for curve in curves.reactions(self.results).curves], [[3, 6], [-8, -8]])
        np.testing.assert_allclose([curve.y for curve in curves.energies(self.results).curves], [[2, 4], [1.5, 3], [0.5, 1]])
        np.testing.assert_allclose([curve.y for curve in curves.states(self.results).curves], [[6, 6]] * 3)

    def test_functions_of_the_package_stay_functions(self):
        """Also after the modules that they come from were imported."""
        for _ in range(2):
            for name in plot.__all__:
                self.assertTrue(callable(getattr(plot, name)), name)

    def test_materials_have_the_names_of_the_model_file(self):
        self.results.summary["model"]["materials"] = [{"name": "rock"}, {"name": "concrete"}]
        self.assertEqual([meshes.name_of_material(self.results, number) for number in (1, 2, 3)], ["rock", "concrete", "material 3"])

    def test_hysteresis_is_tangential_force_against_mean_slip(self):
        bend, seat = curves.hysteresis(self.results).curves
        np.testing.assert_allclose(bend.x, [0.008, 0.016])
        np.testing.assert_allclose(bend.y, [-30, -60])
        np.testing.assert_allclose(seat.x, [-0.001, -0.002])

    def test_rounding_is_neither_slip_nor_a_reaction(self):
        entries = self.results.summary["increments"]
        for entry in entries[:2]:
            entry["reactions"] = {"ground": [1e-9, -5e-8]}  # beside contact forces of 200
        self.assertEqual(curves.reactions(self.results).curves, [])
        self.assertIsNotNone(curves.hysteresis(self.results))
        table = self.results.table("contact.csv")
        table["slip"][:] = 1e-17
        self.assertIsNone(curves.hysteresis(self.results))
        self.assertEqual(len([axis for axis in plot.history(self.results).axes if axis.get_visible()]), 4)
        for entry in entries[:2]:  # without contacts: beside what the elastic energy needs, 6 over a displacement below 1
            entry.update(contacts={}, reactions={"ground": [1e-12, 0.0]})
        self.assertEqual(curves.reactions(self.results).curves, [])

    def test_load_against_the_largest_displacement(self):
        panel = curves.load_displacement(self.results)
        self.assertEqual([curve.name for curve in panel.curves], ["push"], "the factor that changes")
        np.testing.assert_allclose(panel.curves[0].y, [0.5, 1.0])
        points = made_up.grid()["point"]["displacement"]
        largest = np.hypot(points[:, 0], points[:, 1]).max()
        np.testing.assert_allclose(panel.curves[0].x, [largest, 2 * largest])

    def test_reaction_of_a_moved_support_against_its_factor(self):
        for step, entry in enumerate(self.results.summary["increments"][:2], start=1):
            entry["factors"] = {"ground": 0.25 * step, "weight": 1.0}
        panel = curves.load_displacement(self.results)
        self.assertEqual([curve.name for curve in panel.curves], ["ground, y"], "-8 is more than 6, from nothing")
        np.testing.assert_allclose(panel.curves[0].x, [0.25, 0.5])
        np.testing.assert_allclose(panel.curves[0].y, [-8, -8])

    def test_convergence_is_its_table(self):
        attempts = curves.attempts_of(self.results)
        self.assertEqual([(a.number, a.attempt, a.accepted) for a in attempts], [(1, 1, True), (2, 1, False), (2, 2, True), (3, 1, False)])
        np.testing.assert_array_equal(np.concatenate([a.residuals for a in attempts]), [row[5] for row in made_up.convergence_rows()])
        np.testing.assert_array_equal(curves.iterations_of(attempts), [2, 2, 1])
        self.assertEqual(list(attempts[0].coarse), [True, False, False])
        figure = plot.convergence(self.results)
        drawn = figure.axes[0].lines[0]
        np.testing.assert_array_equal(drawn.get_ydata(), [1.0, 0.1, curves.LEAST])

    def test_problems_with_fewer_pairs_are_told_apart(self):
        numbers, fewer = np.array([0, 1, 2, 2, 3, 3]), np.array([True, True, True, False, False, False])
        attempt = curves.Attempt(1, 1, True, numbers, np.array([1.0, 0.5, 1e-15, 0.1, 1e-12, 1e-16]), fewer)
        self.assertEqual(curves.words_for_iterations([attempt]),
                         "1 iteration, and 2 on fewer pairs, whose solution is the start of the next problem")
        self.assertEqual(curves.words_for_iterations([curves.Attempt(1, 1, True, numbers[:3], np.ones(3), np.zeros(3, dtype=bool))]),
                         "2 iterations")
        axis = style.plt.figure().subplots()
        curves.draw_attempt(axis, attempt, 1)
        drawn = [list(line.get_xdata()) for line in axis.lines if line.get_linestyle() == "-"]
        self.assertEqual(drawn, [[0, 1, 2], [2, 3, 3]], "no line from the solution of one problem to the start of the next")
        weaker = dataclasses.replace(attempt, coarse=np.zeros(6, dtype=bool))  # friction that falls with slip: another round
        axis = style.plt.figure().subplots()
        curves.draw_attempt(axis, weaker, 1)
        drawn = [list(line.get_xdata()) for line in axis.lines if line.get_linestyle() == "-"]
        self.assertEqual(drawn, [[0, 1, 2], [2, 3, 3]])

    def test_a_name_that_begins_with_an_underscore_is_in_the_legend(self):
        figure = plot.history(self.results, "hysteresis")
        self.assertEqual([text.get_text().strip() for text in figure.axes[0].get_legend().get_texts()], ["bend", "_seat"])

    def test_the_style_of_the_caller_stays(self):
        before = style.plt.rcParams["font.size"], style.plt.rcParams["axes.titlelocation"]
        plot.history(self.results)
        self.assertEqual((style.plt.rcParams["font.size"], style.plt.rcParams["axes.titlelocation"]), before)


class InTime(WithResults):
    def in_time(self, columns):
        """Increments of step 2 are at the times 0.5, 1.0, ..., with these columns of history.csv."""
        first = self.results.summary["increments"][0]
        count = len(next(iter(columns.values())))
        self.results.summary["increments"] = [first] + [{**first, "step": 2, "increment": k + 1, "time": 0.5 * (k + 1)} for k in range(count)]
        rows = [["step", "increment", "time", *columns], ["1", "1", "0", *["7"] * len(columns)]]
        rows += [["2", str(k + 1), str(0.5 * (k + 1)), *(str(values[k]) for values in columns.values())] for k in range(count)]
        (self.directory / "history.csv").write_text("\n".join(map(",".join, rows)) + "\n", encoding="utf-8")

    def test_response_to_a_constant_acceleration(self):
        """From rest an oscillator swings to (1 + exp(-pi zeta / sqrt(1 - zeta^2))) times where it would stay."""
        for damping in (0.02, 0.05, 0.2):
            spectrum = in_time.response(np.linspace(0, 20, 41), 3.0 * np.linspace(0, 20, 41), [1.0, 2.0, 7.0], damping)
            np.testing.assert_allclose(spectrum, 3.0 * (1 + np.exp(-np.pi * damping / np.sqrt(1 - damping**2))), rtol=2e-3)

    def test_response_to_a_jump_of_the_velocity(self):
        """A base that starts to move at once: omega v exp(-zeta atan(1 / zeta)), also where the motion ends before the swing does."""
        for end in (20.0, 0.1):
            motion = (np.array([0.0, 1e-6, end]), np.array([0.0, 2.0, 2.0]))
            exact = 2.0 * 2 * np.pi / np.array([1.0, 4.0]) * np.exp(-0.05 / np.sqrt(1 - 0.05**2) * np.arctan(np.sqrt(1 - 0.05**2) / 0.05))
            np.testing.assert_allclose(in_time.response(*motion, [1.0, 4.0], 0.05), exact, rtol=4e-3)

    def test_columns_and_sums_of_a_history(self):
        self.in_time({"top": [1.0, 2.0], "ground": [0.5, -1.0]})
        times, values = in_time.velocity_of(self.results, "top+ground")
        np.testing.assert_array_equal(times, [0, 0.5, 1.0])
        np.testing.assert_array_equal(values, [0, 1.5, 1.0])
        with self.assertRaisesRegex(plot.ResultsError, "the columns of history.csv are top, ground"):
            in_time.velocity_of(self.results, "crest")
        with self.assertRaisesRegex(plot.ResultsError, "--component"):
            in_time.spectrum(self.results, None)

    def test_a_spectrum_is_drawn(self):
        self.in_time({"top": list(np.sin(np.arange(40))), "ground": list(np.cos(np.arange(40)))})
        figure = plot.spectrum(self.results, "ground,top+ground", plot.Units("m", "N"))
        self.assertEqual(len(figure.axes[0].lines), 2)
        self.assertEqual(figure.axes[0].get_ylabel(), "pseudo-acceleration (m / s²)")

    def test_an_envelope_is_the_largest_of_all_increments(self):
        bend, seat = in_time.envelopes(self.results)
        np.testing.assert_allclose(bend.values["opening"], [0.002] * 3 + [0] * 6)
        np.testing.assert_allclose(bend.values["pressure"], 2e6 * np.arange(1, 10))
        np.testing.assert_allclose(seat.values["slip left"], [0, -0.002, -0.004])
        np.testing.assert_array_equal(bend.times["pressure"], [2] * 9)
        table = self.results.table("contact.csv")
        table["slip"][table["step"] == 2] = 1e-4  # it slips back
        seat = in_time.envelopes(self.results, ["_seat"])[0]
        np.testing.assert_allclose(seat.values["slip"], [1e-4, -0.001, -0.002])
        np.testing.assert_array_equal(seat.times["slip"], [2, 1, 1])
        np.testing.assert_allclose(seat.values["slip left"], [1e-4] * 3)
        axes = plot.envelope(self.results).axes
        self.assertEqual([axis.get_ylabel().split(" ")[0] for axis in axes], ["opening", "", "pressure", "", "slip", ""])

    def test_energies_in_time_are_those_that_are_not_nothing(self):
        self.in_time({"top": [1.0, 2.0]})
        for entry in self.results.summary["increments"]:
            entry["energy"] = {"external": 2.0, "elastic": 1.0, "friction": 0.4, "kinetic": 0.5, "damping": 0.1, "impact": 1e-9}
        self.assertEqual([curve.name for curve in curves.energies(self.results).curves],
                         ["work of loads", "elastic", "friction", "kinetic", "damping"])


if __name__ == "__main__":
    unittest.main()
