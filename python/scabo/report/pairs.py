"""The contact pairs of a page: places once, values after every increment."""
import numpy as np

from .choice import in_order_of_importance, listed, mesh_may_change
from .packing import pack
from .reading import ResultsError, geometry, without_rounding

VALUES = ("pressure", "shear", "gap", "slip", "normal_force", "tangential_force")
ROUNDED = {"gap": "normal", "slip": "tangential"}  # zero where they are nothing but rounding
STATES = ("open", "stick", "slip")


def add_pairs(results, arrays, budget, centre):
    """Returns what the page has to know of the contacts, or None where there are none."""
    if results.modal or results.count == 0:
        return None
    last = results.contacts(results.count)
    if not last:
        return None
    names = list(last)
    joined = {key: np.concatenate([rows[key] for rows in last.values()]) for key in ("x", "y", "pair")}
    arrays.add("pair_x", joined["x"] - centre[0])
    arrays.add("pair_y", joined["y"] - centre[1])
    arrays.add("pair_distance", np.concatenate([geometry.arc_length(rows["x"], rows["y"]) for rows in last.values()]))
    arrays.add("pair_number", joined["pair"], "u4")
    sizes = [len(rows["x"]) for rows in last.values()]
    add_places(results, last, arrays)
    chosen, others, spent = set(), False, 0
    for number in order_of(results):
        if chosen and spent + spent / len(chosen) > budget:
            break
        contacts = results.contacts(number)
        if not same_places(contacts, last):
            if not mesh_may_change(results):
                raise ResultsError(f"{results.directory / 'contact.csv'}: the increments have different pairs; run the model again")
            others = True
            continue
        for key in VALUES:
            values = np.concatenate([without_rounding(rows, key, ROUNDED[key]) if key in ROUNDED else rows[key]
                                     for rows in contacts.values()])
            text = pack(values, "f4")
            arrays.put(f"{key}_of_pairs_{number}", "f4", len(values), text)
            spent += len(text)
        states = np.concatenate([rows["state"] for rows in contacts.values()])
        codes = np.select([states == name for name in STATES], range(len(STATES)), 255)
        if (codes == 255).any():
            raise ResultsError(f"{results.directory / 'contact.csv'}: has the state '{states[codes == 255][0]}', which is none of "
                               f"{', '.join(STATES)}; run the model again")
        arrays.add(f"state_{number}", codes, "u1")
        chosen.add(number)
    why = "those with the pairs of the last one" if others else "which keeps its size within bounds"
    note = "" if len(chosen) == results.count else \
        f"This page has the pairs of {len(chosen)} of {results.count} increments ({listed(chosen)}), {why}."
    return {"names": names, "sizes": sizes, "increments": sorted(chosen), "note": note}


def same_places(contacts, last):
    """Whether the contacts have the pairs of the last increment."""
    return list(contacts) == list(last) and all(
        np.array_equal(rows[key], last[name][key]) for name, rows in contacts.items() for key in ("x", "y"))


def order_of(results):
    steps = [entry["step"] for entry in results.increments]
    return in_order_of_importance(results.count, [k for k in range(1, results.count) if steps[k] != steps[k - 1]])


def add_places(results, contacts, arrays):
    """For each pair the points of the fields at its two sides, plus 1; 0 where a side is rigid or there are no fields."""
    a, b = np.zeros((2, sum(len(rows["x"]) for rows in contacts.values())), dtype=int)
    grid = results.last_fields()
    if grid is not None:
        outline = np.unique(geometry.outline(geometry.triangles(grid)))
        owner = grid.point_data["body"][outline]
        bodies = {body["name"]: number for number, body in enumerate(results.summary["model"].get("bodies", []), start=1)}
        sides = {entry["name"]: [body_of(text, bodies) for text in entry["between"]] for entry in results.summary["model"].get("contacts", [])}
        at = 0
        for name, rows in contacts.items():
            spot = np.column_stack([rows["x"], rows["y"]])
            first, second = sides.get(name, (None, None))
            end = at + len(spot)
            a[at:end] = nearest(spot, grid.points, outline[owner == first], 1e-5 * geometry.extent(grid.points))
            b[at:end] = nearest(spot, grid.points, outline[owner == second], np.inf)
            at = end
    arrays.add("pair_a", a, "u4")
    arrays.add("pair_b", b, "u4")


def body_of(text, bodies):
    """Number of the body of a place, `upper.bottom`; names of bodies may contain points."""
    fitting = [name for name in bodies if text == name or text.startswith(name + ".")]
    return bodies[max(fitting, key=len)] if fitting else None


def nearest(spots, points, candidates, most):
    """Number plus 1 of the candidate nearest to each spot; 0 where there is none within `most`."""
    if len(candidates) == 0:
        return np.zeros(len(spots), dtype=int)
    found = np.zeros(len(spots), dtype=int)
    for k, spot in enumerate(spots):
        distance = np.hypot(*(points[candidates] - spot).T)
        best = int(np.argmin(distance))
        found[k] = candidates[best] + 1 if distance[best] <= most else 0
    return found
