"""Work of friction over large increments: it does not depend on them more than the program says."""
import itertools

import support
from support import InTemporaryDirectory, rows_of, scabo, summary_of

# A pad is pressed on a rigid floor by 1 MN and pulled by 0.1 m at its top. It slips under 0.3 MN as soon as it has been
# sheared; the work is a little less than 30 kJ, by what the shear takes from the way.
PAD = """scabo: 1
analysis: {plane: strain}
materials: {stuff: {young: 10e9, poisson: 0.3}}
bodies:
  floor: {rigid: true, shape: {rectangle: {corner: [-2, -1], size: [4, 1]}}}
  pad: {material: stuff, shape: {rectangle: {corner: [-0.5, 0], size: [1, 0.5]}}, mesh: {size: 0.125}}
contacts: {sole: {between: [floor.top, pad.bottom], friction: %s}}
supports:
  - {on: floor, fix: [x, y]}
  - {on: pad.top, displacement: [0.1, null], name: pull}
loads: {down: {on: pad.top, pressure: 1e6}}
steps: [{name: down, loads: {down: 1, pull: 0}}, %s]
"""


def work_of_opening(rows):
    """Of the pressure on pairs that open within an increment, until the end of each: by the trapezoidal rule, half of the
    force at its start over the way. The rule of the energies leaves it out, as in the limit of small increments it is zero."""
    start, total, works = None, 0.0, []
    for _, pairs in itertools.groupby(rows, key=lambda row: (row["step"], row["increment"])):
        end = [(float(pair["normal_force"]), float(pair["gap"])) for pair in pairs]
        for (force, gap), (later, wider) in zip(start or [(0.0, 0.0)] * len(end), end):
            total += 0.5 * (force + later) * (wider - gap)
        start = end
        works.append(total)
    return works


class WorkOfFriction(InTemporaryDirectory):
    def energies(self, steps, friction="0.3"):
        model = self.directory / "model.yaml"
        model.write_text(PAD % (friction, steps), encoding="utf-8")
        run = scabo("run", model, "--quiet", "-o", self.directory / "results")
        self.assertEqual(run.returncode, 0, run.stderr)
        energies = [increment["energy"] for increment in summary_of(self.directory / "results")["increments"]]
        for before, after in zip(energies, energies[1:]):
            self.assertGreaterEqual(after["friction"], before["friction"])
            self.assertGreaterEqual(after["friction_error"], before["friction_error"])
        for energy, opening in zip(energies, work_of_opening(rows_of(self.directory / "results")), strict=True):  # the heel opens
            self.assertAlmostEqual(energy["external"] + opening, energy["elastic"] + energy["friction"],
                                   delta=1e-9 * energy["external"])
        return energies[-1]

    def test_a_pad_that_is_pulled_far(self):
        works = {}
        for increments in (1, 3, 10, 100):
            energy = self.energies("{name: pull, loads: {pull: 1}, increments: %d}" % increments)
            works[increments] = energy
            with self.subTest(increments=increments):
                self.assertAlmostEqual(energy["friction"], 29980, delta=15)
                self.assertLess(energy["friction"], 30000)
        for increments in (1, 3, 10):
            self.assertLessEqual(abs(works[increments]["friction"] - works[100]["friction"]), works[increments]["friction_error"])

    def test_there_and_back_again(self):
        one_way = self.energies("{name: pull, loads: {pull: 1}}")["friction"]
        both = self.energies("{name: pull, loads: {pull: 1}}, {name: back, loads: {pull: 0}}")["friction"]
        self.assertAlmostEqual(both / one_way, 2.0, delta=2e-3)

    def test_pressure_that_grows_meanwhile(self):
        """Twice as much at the end: the mean of both."""
        coarse, fine = (self.energies("{name: pull, loads: {pull: 1, down: 2}, increments: %d}" % n) for n in (1, 100))
        self.assertAlmostEqual(fine["friction"], 0.3 * 1.5e6 * 0.1, delta=0.01 * 45000)
        self.assertLessEqual(abs(coarse["friction"] - fine["friction"]), coarse["friction_error"])
        self.assertAlmostEqual(coarse["friction"] / fine["friction"], 1.0, delta=0.01)
        self.assertLess(fine["friction_error"], 0.05 * coarse["friction_error"])

    def test_slip_that_begins_late(self):
        """The pad sticks until the pressure has fallen: the bound is one of the way between, and the error says so."""
        steps = ("{name: shear, loads: {pull: 3e-4}}, {name: relieve, loads: {down: 0.1, pull: 3e-4}, increments: %d}")
        coarse, fine = (self.energies(steps % n) for n in (1, 200))
        self.assertGreater(fine["friction"], 0.0)
        self.assertLessEqual(abs(coarse["friction"] - fine["friction"]), coarse["friction_error"])

    def test_friction_that_falls_with_slip(self):
        """From 0.5 to 0.3 over 10 mm: 1e6 (0.4 10e-3 + 0.3 90e-3) J."""
        energy = self.energies("{name: pull, loads: {pull: 1}}", "{static: 0.5, dynamic: 0.3, slip_distance: 0.01}")
        self.assertAlmostEqual(energy["friction"], 31000, delta=60)


if __name__ == "__main__":
    support.main()
