"""Hexahedra and wedges of `.inp`, `.msh` and `.vtu` files as super-elements (`kind: hexahedra`): one mesh, distorted and turned, in every format."""
import csv
import itertools
import random
import unittest

import support
from solid_twins_test import product, rotation
from solids import HEAD
from support import scabo, summary_of

YOUNG, POISSON, PRESSURE = 2e5, 0.3, 10.0
HEXAHEDRON = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
WEDGE = ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5))
# The places of these middle nodes behind the corners, in Gmsh's order.
OF_GMSH = {20: (0, 3, 8, 1, 9, 2, 10, 11, 4, 7, 5, 6), 15: (0, 2, 6, 1, 7, 8, 3, 5, 4)}
TYPES = {8: ("C3D8", 5, 12), 6: ("C3D6", 6, 13), 20: ("C3D20", 17, 25), 15: ("C3D15", 18, 26)}


def block(low, high, counts, wedges, quadratic, seed):
    """Nodes and cells of a block whose inner corners are moved at random; those on its sides stay in the plane of it."""
    dice = random.Random(seed)
    nodes, number = [], {}
    for at in itertools.product(*(range(count + 1) for count in counts)):
        number[at] = len(nodes)
        nodes.append([low[k] + (high[k] - low[k]) / counts[k] * (at[k] + (dice.uniform(-0.25, 0.25) if 0 < at[k] < counts[k] else 0.0)) for k in range(3)])
    cells, middles = [], {}
    for x, y, z in itertools.product(*(range(count) for count in counts)):
        ring = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]
        for part in ([[0, 1, 2], [0, 2, 3]] if wedges else [[0, 1, 2, 3]]):
            cell = [number[(*ring[k], level)] for level in (z, z + 1) for k in part]
            for i, k in (WEDGE if wedges else HEXAHEDRON) if quadratic else ():
                edge = tuple(sorted((cell[i], cell[k])))
                if edge not in middles:
                    middles[edge] = len(nodes)
                    nodes.append([0.5 * (a + b) for a, b in zip(nodes[edge[0]], nodes[edge[1]])])
                cell.append(middles[edge])
            cells.append(cell)
    return nodes, cells


def sides_of(cell):
    """Their corners: those of both ends, then the quadrilaterals between them."""
    half = len(cell) // 2 if len(cell) < 9 else 3 if len(cell) == 15 else 4
    low, high = cell[:half], cell[half:2 * half]
    return [low[::-1], high, *([low[k], low[(k + 1) % half], high[(k + 1) % half], high[k]] for k in range(half))]


def text_of(form, nodes, cells, faces):
    """The file in a format; `faces` by name, each a test of a corner."""
    size = len(cells[0])
    abaqus, gmsh, vtk = TYPES[size]
    of_face = {name: [side for cell in cells for side in sides_of(cell) if all(holds(node) for node in side)] for name, holds in faces.items()}
    write = lambda point: " ".join(repr(x) for x in point)
    if form == "inp":
        lines = ["*NODE", *(f"{k + 1}, {write(node).replace(' ', ', ')}" for k, node in enumerate(nodes)), f"*ELEMENT, TYPE={abaqus}, ELSET=ALL"]
        for k, cell in enumerate(cells):
            entries = [str(k + 1), *(str(node + 1) for node in cell)]
            lines += [", ".join(entries[i:i + 10]) + ("," if i + 10 < len(entries) else "") for i in range(0, len(entries), 10)]
        for name, sides in of_face.items():
            lines += [f"*NSET, NSET={name}", *(f"{node + 1}," for node in sorted({node for side in sides for node in side}))]
        return "\n".join(lines) + "\n"
    sides = [(number + 1, side) for number, of in enumerate(of_face.values()) for side in of]
    corners = {20: 8, 15: 6}.get(size, size)
    ordered = [cell[:corners] + [cell[corners + k] for k in OF_GMSH.get(size, ())] for cell in cells]
    if form == "msh22":
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(of_face)), *(f'2 {k + 1} "{name}"' for k, name in enumerate(of_face)), "$EndPhysicalNames",
                 "$Nodes", str(len(nodes)), *(f"{k + 1} {write(node)}" for k, node in enumerate(nodes)), "$EndNodes", "$Elements", str(len(sides) + len(cells))]
        lines += [f"{k + 1} {len(side) - 1} 2 {tag} {tag} " + " ".join(str(node + 1) for node in side) for k, (tag, side) in enumerate(sides)]
        lines += [f"{len(sides) + k + 1} {gmsh} 2 9 9 " + " ".join(str(node + 1) for node in cell) for k, cell in enumerate(ordered)]
        return "\n".join([*lines, "$EndElements"]) + "\n"
    if form == "msh41":
        lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(of_face)), *(f'2 {k + 1} "{name}"' for k, name in enumerate(of_face)), "$EndPhysicalNames",
                 "$Entities", f"0 0 {len(of_face)} 1", *(f"{k + 1} 0 0 0 1 1 1 1 {k + 1} 0" for k in range(len(of_face))), "9 0 0 0 1 1 1 1 9 0", "$EndEntities",
                 "$Nodes", f"1 {len(nodes)} 1 {len(nodes)}", f"3 9 0 {len(nodes)}", *(str(k + 1) for k in range(len(nodes))), *map(write, nodes), "$EndNodes",
                 "$Elements", f"{len(sides) + 1} {len(sides) + len(cells)} 1 {len(sides) + len(cells)}"]
        for k, (tag, side) in enumerate(sides):
            lines += [f"2 {tag} {len(side) - 1} 1", f"{k + 1} " + " ".join(str(node + 1) for node in side)]
        lines += [f"3 9 {gmsh} {len(cells)}", *(f"{len(sides) + k + 1} " + " ".join(str(node + 1) for node in cell) for k, cell in enumerate(ordered)), "$EndElements"]
        return "\n".join(lines) + "\n"
    every = [*(side for _, side in sides), *cells]
    array = lambda kind, name, values: f'<DataArray type="{kind}" Name="{name}">' + " ".join(map(str, values)) + "</DataArray>"
    return "\n".join(['<VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid>', f'<Piece NumberOfPoints="{len(nodes)}" NumberOfCells="{len(every)}">',
                      '<Points><DataArray type="Float64" NumberOfComponents="3">', *map(write, nodes), "</DataArray></Points><Cells>",
                      array("Int64", "connectivity", itertools.chain(*every)), array("Int64", "offsets", itertools.accumulate(map(len, every))),
                      array("UInt8", "types", [{3: 5, 4: 9}[len(side)] for _, side in sides] + [vtk] * len(cells)), "</Cells><CellData>",
                      array("Int32", "region", [tag for tag, _ in sides] + [9] * len(cells)), "</CellData></Piece></UnstructuredGrid></VTKFile>"]) + "\n"


@unittest.skipIf(support.SANITIZED, "numbers")
class BrickFiles(support.InTemporaryDirectory):
    def solve(self, forms, wedges, quadratic, turn, kind=", kind: hexahedra"):
        """A block of a file of one format on another one, pressed along its turned axis; values in the axes of the blocks."""
        lower = block([0, 0, -1], [2, 2, 0], [3, 2, 2], wedges[0], quadratic, 1)
        upper = block([0, 0, 0], [2, 2, 1], [2, 3, 2], wedges[1], quadratic, 2)
        faces = {}
        for name, form, (nodes, cells), low, high in (("lower", forms[0], lower, -1.0, 0.0), ("upper", forms[1], upper, 0.0, 1.0)):
            tests = {"BELOW": lambda node, nodes=nodes, low=low: nodes[node][2] == low, "ABOVE": lambda node, nodes=nodes, high=high: nodes[node][2] == high}
            file = f"{name}.{form[:3]}"
            (self.directory / file).write_text(text_of(form, [product(turn, node) for node in nodes], cells, tests), encoding="utf-8")
            faces[name] = ("boundary_1", "boundary_2") if form == "vtu" else ("BELOW", "ABOVE")
            faces[name + ".file"] = file
        row = lambda vector: "[" + ", ".join(repr(x) for x in vector) + "]"
        back = [list(column) for column in zip(*turn)]
        # u = turn strain turn^T x with the strain of a bar that is pressed along its third axis.
        strain = [POISSON * PRESSURE / YOUNG, POISSON * PRESSURE / YOUNG, -PRESSURE / YOUNG]
        gradient = [[sum(turn[i][k] * strain[k] * turn[j][k] for k in range(3)) for j in range(3)] for i in range(3)]
        formula = ", ".join(f'"{" + ".join(f"({g!r}) * {axis}" for g, axis in zip(of, "xyz"))}"' for of in gradient)
        inside = product(turn, [1.1, 0.9, 0.55])
        (self.directory / "model.yaml").write_text(HEAD + f"""materials: {{m: {{young: {YOUNG}, poisson: {POISSON}}}}}
bodies:
  lower: {{material: m, mesh: {{file: {faces["lower.file"]}{kind}}}}}
  upper: {{material: m, mesh: {{file: {faces["upper.file"]}{kind}}}}}
supports: [{{on: lower.{faces["lower"][0]}, displacement: {{formula: [{formula}]}}, name: ground}}]
loads: {{press: {{on: upper.{faces["upper"][1]}, pressure: {PRESSURE}}}}}
contacts: {{joint: {{between: [lower.{faces["lower"][1]}, upper.{faces["upper"][0]}], friction: 0.3}}}}
output: {{points: [{{at: {row(inside)}, name: inside}}]}}
""", encoding="utf-8")
        done = scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        increment = summary_of(self.directory / "results")["increments"][-1]
        with open(self.directory / "results" / "points.csv", encoding="utf-8", newline="") as file:
            point = next(csv.DictReader(file))
        stress = {(i, j): float(point["stress_" + "".join(sorted("xyz"[i] + "xyz"[j]))]) for i in range(3) for j in range(3)}
        turned_back = [sum(turn[i][a] * turn[j][a] * stress[i, j] for i in range(3) for j in range(3)) for a in range(3)]
        u = product(back, [float(point["u" + axis]) for axis in "xyz"])
        expected = [e * x for e, x in zip(strain, [1.1, 0.9, 0.55])]
        force = product(back, increment["contacts"]["joint"]["normal_force"])
        pressures = [float(row["pressure"]) for row in support.rows_of(self.directory / "results")]
        errors = [max(abs(p / PRESSURE - 1) for p in pressures), abs(force[2] / (4 * PRESSURE) - 1), max(abs(a - b) for a, b in zip(u, expected)) * YOUNG / PRESSURE,
                  abs(turned_back[2] / PRESSURE + 1), abs(turned_back[0]) / PRESSURE]
        return errors, [*force, *u, *turned_back, increment["energy"]["elastic"], *sorted(pressures)], summary_of(self.directory / "results")

    def test_a_uniform_pressure_passes_between_files_of_every_format(self):
        turn = rotation(3)
        forms = ("inp", "msh22", "msh41", "vtu")
        for k, (wedges, quadratic) in enumerate(itertools.product(((False, False), (True, False), (False, True), (True, True)), (False, True))):
            pair = (forms[k % 4], forms[(k + 1 + k // 4) % 4])
            with self.subTest(formats=pair, wedges=wedges, quadratic=quadratic):
                errors, _, summary = self.solve(pair, wedges, quadratic, turn)
                self.assertLess(max(errors), 1e-10)
                counts = [body["super_elements"] for body in summary["model"]["bodies"]]
                self.assertEqual(counts, [12 * (1 + wedges[0]), 12 * (1 + wedges[1])])
                self.assertEqual(summary["warnings"], [])

    def test_the_formats_give_the_same_answer(self):
        """Also where the file's hexahedra are divided into tetrahedra, which its numbers decide how."""
        for kind, quadratic in ((", kind: hexahedra", True), (", kind: hexahedra", False), ("", True), ("", False)):
            _, one, _ = self.solve(("inp", "inp"), (False, True), quadratic, rotation(4), kind)
            size = max(map(abs, one))
            for form in ("msh22", "msh41", "vtu"):
                with self.subTest(kind=kind, quadratic=quadratic, format=form):
                    errors, other, _ = self.solve((form, form), (False, True), quadratic, rotation(4), kind)
                    self.assertLess(max(abs(a - b) for a, b in zip(one, other)) / size, 1e-12)
                    self.assertLess(max(errors), 1e-10)


if __name__ == "__main__":
    support.main()
