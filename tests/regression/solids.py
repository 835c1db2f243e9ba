"""Models in space and their files, as tests write and read them. Standard library only."""
import csv
import itertools
import math
import re
import signal
import struct
import subprocess
import time

import support

HEAD = "scabo: 1\nanalysis: {space: true}\n"


def arrays_of(file):
    """Arrays of an uncompressed .vtu file by name; `node_body`: `body` of the points."""
    content = file.read_bytes()
    begin = content.index(b"<AppendedData")
    data = content.index(b"_", begin) + 1
    arrays = {}
    for kind, name, offset in re.findall(rb'<DataArray type="(\w+)" Name="(\w+)".*offset="(\d+)"', content[:begin]):
        at = data + int(offset)
        size, = struct.unpack_from("<Q", content, at)
        letter, width = {b"Float64": ("d", 8), b"Float32": ("f", 4), b"Int32": ("i", 4), b"UInt8": ("B", 1)}[kind]
        key = "node_body" if name == b"body" and "node_body" not in arrays else name.decode()
        arrays[key] = struct.unpack_from(f"<{size // width}{letter}", content, at + 8)
    return arrays


def interrupt(test, model, results, *words):
    """Runs a model of at least five increments, and interrupts it after the fourth one."""
    process = subprocess.Popen([support.SCABO, "run", model, "-o", results, "--quiet", *words], stderr=subprocess.PIPE, text=True)
    test.addCleanup(lambda: process.poll() is None and process.kill())
    while process.poll() is None and not (results / "fields_0004.vtu").exists():
        time.sleep(0.005)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=support.PATIENCE)
    test.assertEqual(process.returncode, 130)


def increments_of_deck(test, deck, *words):
    """Converts a deck, and solves the model; every increment has a certificate."""
    (test.directory / "deck.inp").write_text(deck, encoding="utf-8")
    for command in (("convert", test.directory / "deck.inp", "--force", *words), ("run", test.directory / "deck.yaml", "-o", test.directory / "results", "--quiet")):
        done = support.scabo(*command)
        test.assertEqual(done.returncode, 0, done.stdout + done.stderr)
    increments = support.summary_of(test.directory / "results")["increments"]
    for increment in increments:
        test.assertLessEqual(support.certificate_of(increment), 1e-10)
    return increments


def vector(row, name):
    return [float(row[f"{name}_{axis}"]) for axis in "xyz"]


def shell(inner, outer, angular, layers, growth=1.0):
    """An octant of a hollow sphere, quadratic tetrahedra as a deck: nodes lie on the spheres. Node sets IN, OUT, X, Y, Z; `growth` of the thickness
    from layer to layer."""
    part = [sum(growth**k for k in range(j)) for j in range(layers + 1)]
    radii = [inner + (outer - inner) * p / part[-1] for p in part]
    index, points = {}, []
    for j, radius in enumerate(radii):
        for a in range(angular + 1):
            for b in range(angular + 1 - a):
                direction = (a, b, angular - a - b)
                size = math.hypot(*direction)
                index[a, b, j] = len(points)
                points.append((radius, tuple(x / size for x in direction)))
    triangles = []
    for a in range(angular):
        for b in range(angular - a):
            triangles.append(((a, b), (a + 1, b), (a, b + 1)))
            if a + b < angular - 1:
                triangles.append(((a + 1, b), (a + 1, b + 1), (a, b + 1)))
    place = [tuple(radius * x for x in direction) for radius, direction in points]
    middles, cells = {}, []

    def middle(i, k):
        key = (min(i, k), max(i, k))
        if key not in middles:
            middles[key] = len(place)
            mean = [x + y for x, y in zip(points[i][1], points[k][1])]
            radius, size = 0.5 * (points[i][0] + points[k][0]), math.hypot(*mean)
            place.append(tuple(radius * x / size for x in mean))
        return middles[key]

    for triangle, j in itertools.product(triangles, range(layers)):
        low = sorted(index[a, b, j] for a, b in triangle)  # prisms are divided alike from both sides
        high = [index[a, b, j + 1] for a, b in sorted(triangle, key=lambda corner: index[*corner, j])]
        for corners in ([*low, high[2]], [low[0], low[1], *high[1:]], [low[0], *high]):
            if volume(place, corners) < 0:
                corners[0], corners[1] = corners[1], corners[0]
            cells.append([*corners, *(middle(corners[i], corners[k]) for i, k in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)))])
    near = 1e-9 * outer
    sets = {"IN": lambda p: abs(math.hypot(*p) - inner) < near, "OUT": lambda p: abs(math.hypot(*p) - outer) < near,
            **{axis: (lambda p, k=k: abs(p[k]) < near) for k, axis in enumerate("XYZ")}}
    lines = ["*NODE", *(f"{k + 1}, {x:.15g}, {y:.15g}, {z:.15g}" for k, (x, y, z) in enumerate(place)), "*ELEMENT, TYPE=C3D10, ELSET=ALL",
             *(f"{k + 1}, " + ", ".join(str(node + 1) for node in cell) for k, cell in enumerate(cells))]
    for name, holds in sets.items():
        lines += [f"*NSET, NSET={name}", *(f"{k + 1}," for k, point in enumerate(place) if holds(point))]
    return "\n".join(lines) + "\n"


def volume(place, corners):
    a, b, c = ([place[corner][k] - place[corners[0]][k] for k in range(3)] for corner in corners[1:])
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])


class Solving(support.InTemporaryDirectory):
    def solve(self, text):
        """The last increment of a model, without its head, and the values at its points by name."""
        (self.directory / "model.yaml").write_text(HEAD + text, encoding="utf-8")
        done = support.scabo("run", self.directory / "model.yaml", "-o", self.directory / "results", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        points = self.directory / "results" / "points.csv"
        values = {}
        if points.is_file():
            with open(points, encoding="utf-8", newline="") as file:
                values = {row["name"]: {key: float(value) for key, value in row.items() if key not in ("name", "body")} for row in csv.DictReader(file)}
        return support.summary_of(self.directory / "results")["increments"][-1], values


def bodies_of(file, count):
    """Nodes and cells of the first bodies of a file of fields."""
    arrays = arrays_of(file)
    points, offsets, connectivity = (arrays[name] for name in ("Points", "offsets", "connectivity"))
    bodies = []
    for body in range(1, count + 1):
        own = [i for i, number in enumerate(arrays["node_body"]) if number == body]
        place = {node: k for k, node in enumerate(own)}
        cells = [[place[node] for node in connectivity[start:end]] for start, end in zip((0, *offsets), offsets) if connectivity[start] in place]
        bodies.append(([tuple(points[3 * i:3 * i + 3]) for i in own], cells))
    return bodies
