"""Decks of Abaqus and CalculiX for the tests of `scabo convert`."""
import support
from support import scabo, summary_of

MATERIAL = "*MATERIAL, NAME=steel\n*ELASTIC\n210e9, 0.3\n*DENSITY\n7850.\n"
STATIC = "*STEP\n*STATIC\n"
END = "*END STEP\n"


CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
TETRAHEDRA = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]


def block(kind, cells, size, z, first, name, origin=(0.0, 0.0)):
    """Nodes and elements of a block with one corner at (*origin, z), and its sets BOTTOM and TOP, LEFT, FRONT, RIGHT and BACK; the nodes at z = 0 and at x = 0 and y = 0."""
    quadratic = kind in ("C3D20", "C3D20R", "C3D10")
    number = {}
    n = [2 * c for c in cells]
    def node(at):
        return number.setdefault(at, first + len(number))
    elements = []
    for k in range(cells[2]):
        for j in range(cells[1]):
            for i in range(cells[0]):
                corner = [(2 * i + x, 2 * j + y, 2 * k + w) for x, y, w in CORNERS]
                if kind in ("C3D4", "C3D10"):
                    for cell in TETRAHEDRA:
                        at = [corner[c] for c in cell]
                        middle = [tuple((p + q) // 2 for p, q in zip(at[a], at[b])) for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))]
                        elements.append([node(x) for x in at + (middle if quadratic else [])])
                else:
                    middle = [tuple((p + q) // 2 for p, q in zip(corner[a], corner[b])) for a, b in EDGES]
                    elements.append([node(x) for x in corner + (middle if quadratic else [])])
    text = "*NODE\n" + "".join(f"{m}, {origin[0] + size[0] * x / n[0]!r}, {origin[1] + size[1] * y / n[1]!r}, {z + size[2] * w / n[2]!r}\n" for (x, y, w), m in number.items())
    text += f"*ELEMENT, TYPE={kind}, ELSET={name}\n"
    for e, nodes in enumerate(elements):
        listed = [str(first + e)] + [str(m) for m in nodes]
        text += ", ".join(listed[:15]) + (",\n" + ", ".join(listed[15:]) if len(listed) > 15 else "") + "\n"
    for name_of, axis, value in (("BOTTOM", 2, 0), ("TOP", 2, n[2]), ("LEFT", 0, 0), ("FRONT", 1, 0), ("RIGHT", 0, n[0]), ("BACK", 1, n[1])):
        text += f"*NSET, NSET={name}_{name_of}\n" + "".join(f"{m}\n" for x, m in number.items() if x[axis] == value)
    top = [e for e in range(len(elements)) if e >= len(elements) * (cells[2] - 1) // cells[2]]
    return text, {x: m for x, m in number.items()}, [first + e for e in top]


def grid(nx, ny, width, height, first=1, corner=(0.0, 0.0), kind="CPS8", elset="BODY"):
    """A rectangle of quadrilaterals with 8 or 4 nodes, with its sides as node sets and surfaces `ELSET_LEFT` and so on."""
    step = 2 if kind[3] == "8" else 1
    columns, rows = nx * step + 1, ny * step + 1
    number = lambda i, j: first + j * columns + i
    nodes = [f"{number(i, j)}, {corner[0] + width * i / (columns - 1)!r}, {corner[1] + height * j / (rows - 1)!r}\n"
             for j in range(rows) for i in range(columns) if step == 1 or not (i % 2 and j % 2)]
    elements, of_side = [], {"BOTTOM": [], "RIGHT": [], "TOP": [], "LEFT": []}
    for y in range(ny):
        for x in range(nx):
            i, j, element = step * x, step * y, first + y * nx + x
            corners = [number(i, j), number(i + step, j), number(i + step, j + step), number(i, j + step)]
            if step == 2:
                corners += [number(i + 1, j), number(i + 2, j + 1), number(i + 1, j + 2), number(i, j + 1)]
            elements.append(f"{element}, {', '.join(map(str, corners))}\n")
            for side, at, which in (("BOTTOM", y == 0, 1), ("RIGHT", x == nx - 1, 2), ("TOP", y == ny - 1, 3), ("LEFT", x == 0, 4)):
                if at:
                    of_side[side].append(f"{element}, S{which}\n")
    text = "*NODE\n" + "".join(nodes) + f"*ELEMENT, TYPE={kind}, ELSET={elset}\n" + "".join(elements)
    last = number(columns - 1, rows - 1)
    for side, (start, end, by) in {"BOTTOM": (first, number(columns - 1, 0), 1), "TOP": (number(0, rows - 1), last, 1),
                                   "LEFT": (first, number(0, rows - 1), columns), "RIGHT": (number(columns - 1, 0), last, columns)}.items():
        text += f"*NSET, NSET=N_{elset}_{side}, GENERATE\n{start}, {end}, {by}\n"
        text += f"*SURFACE, NAME={elset}_{side}, TYPE=ELEMENT\n" + "".join(of_side[side])
    return text


class Converting(support.InTemporaryDirectory):
    def convert(self, deck, *words, name="part.inp"):
        path = self.directory / name
        path.write_bytes(deck if isinstance(deck, bytes) else deck.encode("utf-8"))
        return scabo("convert", name, "--force", *words, cwd=self.directory)

    def converted(self, deck, *words):
        run = self.convert(deck, *words)
        self.assertEqual(run.returncode, 0, run.stderr)
        return (self.directory / "part.yaml").read_text(encoding="utf-8")

    def solved(self, deck, *words):
        """Summary of the run of a deck that is taken whole, but for notes."""
        self.converted(deck)
        run = scabo("run", "part.yaml", "--quiet", *words, cwd=self.directory)
        self.assertEqual(run.returncode, 0, run.stderr)
        return summary_of(self.directory / "part.results")

    def displacement(self, deck, x, y, component=1):
        summary = self.solved(deck, "--set", f"output.history={{u: point.{'u' + 'xy'[component]}}}", "--set",
                              f"output.points=[{{at: [{x}, {y}], name: point}}]")
        with open(self.directory / "part.results" / "history.csv", encoding="utf-8") as file:
            rows = [line.rstrip().split(",") for line in file]
        return float(rows[-1][rows[0].index("u")]), summary


SQUARE = grid(2, 2, 2.0, 2.0) + MATERIAL + "*SOLID SECTION, ELSET=BODY, MATERIAL=steel\n"
HELD = "*BOUNDARY\nN_BODY_LEFT, 1, 2\n"
PRESSED = STATIC + "*DSLOAD\nBODY_RIGHT, P, 1e6\n" + END
