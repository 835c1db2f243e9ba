"""Values along straight lines: those of `output: {lines: ...}`, or along any line through the fields or the contact faces of a model in space."""
import csv
import dataclasses

import numpy as np

from . import contacts, curves, style, tetrahedra
from .results import NothingToDraw, ResultsError
from .units import Units

STRESSES = {"von_mises": "von Mises stress", "principal_1": "first principal stress", "principal_2": "second principal stress",
            "principal_3": "third principal stress", **{name: f"stress {name}" for name in ("xx", "yy", "zz", "xy", "yz", "xz")}}
LENGTHS = {"displacement": "displacement", "ux": "displacement along x", "uy": "displacement along y", "uz": "displacement along z"}
DEFAULT = ("von_mises", "displacement")
MOST_LINES = 6   # in one panel
POINTS = 201     # along a line that the results do not have
INSIDE = 1e-6    # of barycentric coordinates, from 0 below


@dataclasses.dataclass(frozen=True)
class Path:
    """One line through one body, in the units of the file."""
    name: str
    distance: np.ndarray  # from the first point of the line
    points: np.ndarray    # n x 2 or 3
    values: dict          # by component


def known_components(in_space):
    return [name for name in (*STRESSES, *LENGTHS) if in_space or name not in ("yz", "xz", "uz")]


def chosen_components(text, in_space):
    """The components of `--component von_mises,zz`."""
    names = [name.strip() for name in text.split(",") if name.strip()] if text else list(DEFAULT)
    known = known_components(in_space)
    for name in names:
        if name not in known:
            raise ResultsError(f"--component {name}: along a line there are {', '.join(known)}")
    return names


def paths_of(results, number):
    """The lines of lines.csv after an increment."""
    table = results.table("lines.csv")
    if table is None:
        raise NothingToDraw(f"{results.directory}: has no lines.csv; `output: {{lines: ...}}` in the model file asks for one")
    entry = results.increments[number - 1]
    here = (table["step"] == entry["step"]) & (table["increment"] == entry["increment"])
    axes = "xyz" if results.in_space else "xy"
    column = {**{name: name if name[:1] in "vp" else f"stress_{name}" for name in STRESSES}, **{f"u{axis}": f"u{axis}" for axis in axes}}
    both = list(dict.fromkeys(zip(table["name"][here], table["body"][here])))
    several = {name for name, body in both if sum(name == other for other, _ in both) > 1}
    paths = []
    for name, body in both:
        rows = here & (table["name"] == name) & (table["body"] == body)
        values = {key: table[of][rows] for key, of in column.items() if of in table}
        values["displacement"] = np.sqrt(sum(table[f"u{axis}"][rows]**2 for axis in axes))
        paths.append(Path(f"{name}, {body}" if name in several else name, table["distance"][rows], np.column_stack([table[axis][rows] for axis in axes]), values))
    if not paths:
        raise NothingToDraw(f"{results.directory}: no line of lines.csv meets a body that is there at {results.name_of(number)}")
    return paths


def points_along(first, last):
    parts = np.linspace(0.0, 1.0, POINTS)
    first, last = np.asarray(first, dtype=float), np.asarray(last, dtype=float)
    return first + parts[:, None] * (last - first), parts * np.linalg.norm(last - first)


def paths_through(results, number, first, last):
    """Along a line through the fields of bodies in space: linear between the nodes; a path for each body."""
    grid = results.fields(number)
    points, distance = points_along(first, last)
    cells = tetrahedra.tetrahedra_of(grid, fine=True)
    body_of = grid.point_data["body"].astype(int)
    low, high = grid.points[cells].min(axis=1), grid.points[cells].max(axis=1)
    slack = INSIDE * (high - low).max(axis=1, keepdims=True)
    near = ((low - slack <= points.max(axis=0)) & (high + slack >= points.min(axis=0))).all(axis=1)
    cells, low, high = cells[near], (low - slack)[near], (high + slack)[near]
    found = {}  # of each body: number of the point, nodes, weights
    for k, point in enumerate(points):
        candidates = cells[((low <= point) & (high >= point)).all(axis=1)]
        if not len(candidates):
            continue
        a, b, c, d = grid.points[candidates].transpose(1, 0, 2)
        rest = np.linalg.solve(np.stack([b - a, c - a, d - a], axis=2), (point - a)[:, :, None])[:, :, 0]
        weights = np.column_stack([1.0 - rest.sum(axis=1), rest])
        for body in np.unique(body_of[candidates[:, 0]]):
            of_body = np.flatnonzero(body_of[candidates[:, 0]] == body)
            best = of_body[np.argmax(weights[of_body].min(axis=1))]
            if weights[best].min() >= -INSIDE:
                found.setdefault(body, []).append((k, candidates[best], weights[best]))
    if not found:
        raise ResultsError("--along: the line meets no body")
    bodies = [body["name"] for body in results.summary["model"]["bodies"]]
    paths = []
    for body, at in sorted(found.items()):
        chosen, nodes, weights = (np.array(of) for of in zip(*at))
        values = {key: np.einsum("ij,ij->i", tetrahedra.values_of(grid, key)[nodes], weights) for key in (*STRESSES, "ux", "uy", "uz")}
        values["displacement"] = np.sqrt(sum(values[f"u{axis}"]**2 for axis in "xyz"))
        paths.append(Path(bodies[body - 1], distance[chosen], points[chosen], values))
    return paths


def described(along):
    return "along the line from ({}) to ({})".format(*(", ".join(f"{x:.4g}" for x in end) for end in along))


@style.styled
def lines(results, increment=-1, component=None, units=None, along=None):
    """A panel for each component, with a curve for each line and body. `along`: both ends of a line through a model in space, instead of the lines
    that the results have."""
    units = units or Units()
    number = results.number(increment)
    names = chosen_components(component, results.in_space)
    paths = paths_through(results, number, *along) if along else paths_of(results, number)
    shown = paths[:MOST_LINES]
    of_most = f"\u00a0· {len(shown)} of {len(paths)} lines" if len(paths) > len(shown) else ""
    columns = min(2, len(names))
    rows = -(-len(names) // columns)
    figure = style.new_figure(style.WIDTH if columns == 2 else 4.6, 2.55 * rows if columns == 2 else 3.2, results.title,
                              f"{results.name_of(number)}\u00a0· {described(along) if along else 'along a line' if len(paths) == 1 else 'along lines'}{of_most}")
    axes = figure.subplots(rows, columns, squeeze=False).reshape(-1)
    for axis, name in zip(axes, names):
        of = [curves.Curve(curves.short_name(path.name) if len(paths) > 1 else "", path.distance, path.values[name]) for path in shown]
        dimension = "stress" if name in STRESSES else "length"
        title = {**STRESSES, **LENGTHS}[name]
        curves.draw_panel(axis, curves.Panel(title, ("distance" if along or len(paths) > 1 else f"distance along {paths[0].name}", "length"), (title, dimension), of), units)
    for axis in axes[len(names):]:
        axis.set_visible(False)
    return figure


def contact_paths(results, number, first, last, names=()):
    """Along the projection of a line on the contact faces, as contacts.Line; linear between the pairs, with the state of the nearest one."""
    points, distance = points_along(first, last)
    found = []
    for of in tetrahedra.maps_of(results, number, names):
        sampled = [at for k, point in enumerate(of.flat(points)) if (at := weights_in(of, point, k))]
        if not sampled:
            continue
        chosen, pairs, weights = (np.array(part) for part in zip(*sampled))
        values = {key: np.einsum("ij,ij->i", value[pairs], weights) for key, value in of.values.items()}
        states = of.states[np.take_along_axis(pairs, np.argmax(weights, axis=1)[:, None], axis=1)[:, 0]]
        found.append(contacts.Line(of.name, distance[chosen], *points[chosen].T[:2], values, states))
    if not found:
        raise ResultsError("--along: the line meets no contact face, seen along its normal")
    return found


def contact(results, number, along, names, component, units):
    """Curves along a line over contact faces."""
    known = [curve[0] for curve in contacts.CURVES]
    if component is not None and component not in known:
        raise ResultsError(f"--component {component}: along a contact there are {', '.join(known)}")
    found = contact_paths(results, number, *along, names)
    if len(found) > contacts.MOST_CONTACTS:
        raise ResultsError(f"--along: the line meets {len(found)} contact faces; name up to {contacts.MOST_CONTACTS} of them with --contact")
    return contacts.contact_curves(results, number, found, units, [curve for curve in contacts.CURVES if component in (None, curve[0])],
                                   described(along))


def weights_in(of, point, number):
    a, b, c = of.places[of.corners].transpose(1, 0, 2)
    cross = lambda u, v: u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    area = cross(b - a, c - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        second, third = cross(point - a, c - a) / area, cross(b - a, point - a) / area
    weights = np.column_stack([1.0 - second - third, second, third])
    inside = np.where(np.isfinite(weights).all(axis=1), weights.min(axis=1), -np.inf)
    best = int(np.argmax(inside))
    return (number, of.corners[best], weights[best]) if inside[best] >= -INSIDE else None


def write_table(results, increment, component, along, path):
    """The values as a .csv."""
    number = results.number(increment)
    names = chosen_components(component, results.in_space)
    paths = paths_through(results, number, *along) if along else paths_of(results, number)
    write_rows(path, ["name", "distance", *"xyz"[:paths[0].points.shape[1]], *names],
               ([of.name, of.distance[k], *of.points[k], *(of.values[name][k] for name in names)] for of in paths for k in range(len(of.distance))))


def write_contact_table(results, increment, names, along, path):
    found = contact_paths(results, results.number(increment), *along, names)
    write_rows(path, ["contact", "distance", "pressure", "shear", "gap", "slip", "state"],
               ([of.name, of.distance[k], *(of.values[key][k] for key in ("pressure", "shear", "gap", "slip")), of.states[k]] for of in found for k in range(len(of.distance))))


def write_rows(path, header, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([value if isinstance(value, str) else repr(float(value)) for value in row] for row in rows)
