"""Springs of models in space from the command line, against closed forms and a plane model of the same body."""
import pathlib
import unittest

import support
from solids import arrays_of
from support import ROOT, certificate_of, scabo, summary_of

HEAD = "scabo: 1\nanalysis: {space: true}\nmaterials: {m: {young: 1e9, poisson: 0}}\n"
BLOCK = "bodies:\n  block: {material: m, shape: {box: {corner: [0, 0, 0], size: [2, 1, 1]}}, mesh: {size: 0.5}}\n"
PLATE = "bodies:\n  plate: {rigid: true, shape: {box: {corner: [1, 2, 0], size: [2, 1, 0.5]}}, mesh: {size: 1}}\n"


@unittest.skipIf(support.SANITIZED, "numbers")
class Springs(support.InTemporaryDirectory):
    def run_model(self, text, name="space"):
        model = self.directory / f"{name}.yaml"
        model.write_text(text, encoding="utf-8")
        return scabo("run", model, "-o", self.directory / name, "--quiet")

    def solve(self, text, name="space"):
        done = self.run_model(text, name)
        self.assertEqual(done.returncode, 0, done.stderr)
        increments = summary_of(self.directory / name)["increments"]
        for increment in increments:
            self.assertLessEqual(certificate_of(increment), 1e-10)
        return increments

    def displacements(self, number=1):
        arrays = arrays_of(self.directory / "space" / f"fields_{number:04d}.vtu")
        points, moved = arrays["Points"], arrays["displacement"]
        return [(points[k:k + 3], moved[k:k + 3]) for k in range(0, len(points), 3)]

    def assert_vector(self, one, other, scale):
        for a, b in zip(one, other, strict=True):
            self.assertAlmostEqual(a, b, delta=1e-9 * scale)

    def test_a_block_and_its_foundation_are_in_series(self):
        """Pressed and pushed: u = p (1 / k_n + z / E) down, tau / k_t along its base."""
        k_n, k_t, p, tau = 5e8, 2e8, 1e5, 4e4
        increment, = self.solve(HEAD + BLOCK + f"""springs: [{{on: block.bottom, k_n: {k_n}, k_t: {k_t}, name: ground}}]
loads:
  press: {{on: block.top, pressure: {p}}}
  push: {{on: block.bottom, traction: [{tau}, {-2 * tau}, 0]}}
""")
        self.assert_vector(increment["springs"]["ground"], [-2 * tau, 4 * tau, 2 * p], p)
        for (_, _, z), u in self.displacements():
            self.assert_vector(u, [tau / k_t, -2 * tau / k_t, -p * (1 / k_n + z / 1e9)], p / k_n)
        stored = 0.5 * 2 * (p**2 * (1 / k_n + 1 / 1e9) + 5 * tau**2 / k_t)
        self.assertAlmostEqual(increment["energy"]["elastic"], stored, delta=1e-9 * stored)
        self.assertAlmostEqual(increment["energy"]["external"], stored, delta=1e-9 * stored)

    def test_a_rigid_plate_tilts_on_its_foundation(self):
        """theta = M / (k_n I), for both axes and the one across, where it turns on k_t."""
        k_n, k_t = 3e7, 1e7
        moment = (5e3, -2e3, 1e3)
        increment, = self.solve(HEAD + PLATE + f"""springs: [{{on: plate.bottom, k_n: {k_n}, k_t: {k_t}, name: ground}}]
loads: {{twist: {{on: plate, moment: {list(moment)}}}, press: {{on: plate, force: [0, 0, -6e3]}}}}
""")
        area, i_x, i_y = 2.0, 2 * 1**3 / 12, 1 * 2**3 / 12
        self.assert_vector(increment["springs"]["ground"], [0, 0, 6e3], 6e3)
        theta = [moment[0] / (k_n * i_x), moment[1] / (k_n * i_y), moment[2] / (k_t * (i_x + i_y))]
        for (x, y, z), u in self.displacements():
            arm = (x - 2, y - 2.5, z)  # about the middle of the base, which only sinks
            exact = [theta[1] * arm[2] - theta[2] * arm[1], theta[2] * arm[0] - theta[0] * arm[2],
                     theta[0] * arm[1] - theta[1] * arm[0] - 6e3 / (k_n * area)]
            self.assert_vector(u, exact, theta[0])
        self.assertAlmostEqual(increment["energy"]["elastic"], increment["energy"]["external"], delta=1e-9 * 6e3)

    def test_springs_hold_a_rigid_body_at_its_centroid(self):
        increments = self.solve(HEAD + PLATE + """supports: [{on: plate, rotation: [0, 0, 0], name: level}]
springs:
  - {on: plate, k_x: 1e6, k_y: 2e6, k_z: 4e6, name: hanger}
  - {on: plate, k_z: 6e6, at_rest: [0, 0, 2e-3], name: jack}
loads: {press: {on: plate, force: [100, 200, -500]}}
steps: [{name: press, loads: {press: 1}}, {name: lift, loads: {jack: 1}}]
""")
        for increment, jack in zip(increments, (0, 1), strict=True):
            uz = (-500 + jack * 6e6 * 2e-3) / 10e6
            self.assert_vector(increment["springs"]["hanger"], [-100, -200, -4e6 * uz], 1e4)
            self.assert_vector(increment["springs"]["jack"], [0, 0, 6e6 * (jack * 2e-3 - uz)], 1e4)
            for _, u in self.displacements(1 + jack):
                self.assert_vector(u, [1e-4, 1e-4, uz], 1e-3)

    def test_springs_that_are_at_rest_elsewhere_pull(self):
        increment, = self.solve(HEAD + BLOCK + """supports: [{on: block.bottom, fix: [x, y, z], name: ground}]
springs: [{on: block.top, k_n: 1e8, at_rest: 1e-3, name: anchor}]
""")
        u = 1e8 * 1e-3 / (1e8 + 1e9)  # 1 m of a block of 1e9 Pa
        self.assert_vector(increment["springs"]["anchor"], [0, 0, 2 * 1e8 * (1e-3 - u)], 2e5)
        self.assert_vector(increment["reactions"]["ground"], [0, 0, -2 * 1e9 * u], 2e5)

    def test_springs_at_the_nodes_of_a_set(self):
        mesh = pathlib.Path(ROOT / "tests" / "input" / "good" / "tetrahedron.inp")
        increment, = self.solve(HEAD + f"""bodies:
  block: {{material: m, mesh: {{file: {mesh}}}}}
springs: [{{on: block.bottom, k_x: 1e3, k_y: 2e3, k_z: 4e3, name: feet}}]
loads: {{push: {{on: block.bottom, nodal_force: [1, 2, -8]}}}}
""")
        self.assert_vector(increment["springs"]["feet"], [-3, -6, 24], 24)
        for _, u in self.displacements():
            self.assert_vector(u, [1e-3, 1e-3, -2e-3], 2e-3)

    def test_what_springs_do_not_hold_is_a_mechanism(self):
        done = self.run_model(HEAD + BLOCK + """springs: [{on: block.bottom, k_n: 1e8}]
loads: {push: {on: block.top, traction: [1, 0, 0]}}
""")
        self.assertEqual(done.returncode, 2)
        self.assertIn("body 'block': translation along (1, 0, 0), held neither by supports", done.stderr)

    def test_a_beam_on_its_foundation_is_that_of_the_plane(self):
        """Loaded at one end; in space a slice of it between planes of symmetry."""
        common = "materials: {steel: {young: 200e3, poisson: 0.3}}\n"
        springs = "springs: [{on: beam.bottom, k_n: 50, k_t: 20, name: ground}]\n"
        plane, = self.solve("scabo: 1\n" + common + springs + """analysis: {plane: strain, thickness: 0.5}
bodies: {beam: {material: steel, shape: {rectangle: {corner: [0, 0], size: [20, 1]}}, mesh: {kind: fem, size: 0.25, order: 2}}}
loads: {tip: {on: beam.right, traction: [3, -10]}}
""", "plane")
        made, = self.solve("scabo: 1\n" + common + springs + """analysis: {space: true}
bodies: {beam: {material: steel, shape: {box: {corner: [0, 0, 0], size: [20, 0.5, 1]}}, mesh: {size: 0.5}}}
supports: [{on: beam.front, fix: y}, {on: beam.back, fix: y}]
loads: {tip: {on: beam.right, traction: [3, 0, -10]}}
""")
        x, y, z = made["springs"]["ground"]
        self.assert_vector([x, z], [-1.5, 5], 5)
        self.assertAlmostEqual(y, 0, delta=1e-6)  # the mesh of the slice is not symmetric
        self.assert_vector(plane["springs"]["ground"], [-1.5, 5], 5)
        self.assertAlmostEqual(made["energy"]["elastic"], plane["energy"]["elastic"], delta=5e-3 * plane["energy"]["elastic"])


if __name__ == "__main__":
    support.main()
