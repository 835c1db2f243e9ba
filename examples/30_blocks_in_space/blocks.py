"""Writes base.inp and block.inp: two boxes of quadratic tetrahedra whose faces do not match.

    blocks.py [FOLDER]

Each brick is divided into six tetrahedra. Surfaces are called after where they are.
"""
import itertools
import pathlib
import sys

EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]  # of C3D10, in the order of its middle nodes
SIDES = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]  # S1 to S4


def box(low, high, n, move=lambda x: x):
    """Text of an .inp file; `move`: applied to every node."""
    points, number, cells = [], {}, []

    def node(x):
        if x not in number:
            number[x] = len(points) + 1
            points.append(x)
        return number[x]

    def place(at):  # at: in halves of a brick
        return tuple(low[k] + (high[k] - low[k]) * at[k] / (2 * n[k]) for k in range(3))

    faces = {name: [] for name in ("LEFT", "RIGHT", "FRONT", "BACK", "BOTTOM", "TOP")}
    for brick in itertools.product(*(range(count) for count in n)):
        for order in itertools.permutations(range(3)):
            corner = [2 * i for i in brick]
            corners = [tuple(corner)]
            for axis in order:
                corner[axis] += 2
                corners.append(tuple(corner))
            if sum(order[i] > order[j] for i, j in ((0, 1), (0, 2), (1, 2))) % 2:  # positive volume
                corners[1], corners[2] = corners[2], corners[1]
            middles = [tuple((a + b) // 2 for a, b in zip(corners[i], corners[j])) for i, j in EDGES]
            cells.append([node(place(at)) for at in corners + middles])
            for side, nodes in enumerate(SIDES, 1):
                for axis, (first, last) in enumerate((("LEFT", "RIGHT"), ("FRONT", "BACK"), ("BOTTOM", "TOP"))):
                    for name, value in ((first, 0), (last, 2 * n[axis])):
                        if all(corners[i][axis] == value for i in nodes):
                            faces[name].append((len(cells), side))
    lines = ["*NODE"]
    lines += [", ".join([str(i), *(repr(float(v)) for v in move(x))]) for i, x in enumerate(points, 1)]
    lines += ["*ELEMENT, TYPE=C3D10"]
    lines += [", ".join(map(str, [i, *cell])) for i, cell in enumerate(cells, 1)]
    for name, sides in faces.items():
        lines += [f"*SURFACE, NAME={name}"] + [f"{cell}, S{side}" for cell, side in sides]
    return "\n".join(lines) + "\n"


def write(folder, move=lambda x: x):
    """Lengths in metres."""
    folder = pathlib.Path(folder)
    (folder / "base.inp").write_text(box((0, 0, -0.5), (1, 1, 0), (3, 3, 2), move), encoding="utf-8")
    (folder / "block.inp").write_text(box((0.2, 0.2, 0), (0.8, 0.8, 0.4), (2, 2, 2), move), encoding="utf-8")


if __name__ == "__main__":
    write(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
