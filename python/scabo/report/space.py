"""Bodies in space of a page: tetrahedra, their values after the increments that have a place in it, and contact faces."""
import dataclasses

import numpy as np

from .choice import in_order_of_importance, listed
from .fields import GROUPS
from .reading import ResultsError, geometry, tetrahedra

NAMES = {"displacement": ("ux", "uy", "uz"), "stress": tuple(tetrahedra.STRESSES), "principal": GROUPS["principal"], "von_mises": GROUPS["von_mises"]}
ON_FACES = ("pressure", "shear", "gap", "slip")


def add_space(results, arrays, budget, asked=None):
    """Adds points, tetrahedra, surfaces, sharp edges and values, up to `budget` bytes beyond those of one increment. `asked`: names of
    groups of fields, as in "displacement,von_mises"; None: all. Returns what the page has to know, or None without fields."""
    numbers = [number for number in results.field_numbers() if number <= results.count]
    motion = motion_of_nodes(results)
    if not numbers and motion is None:
        return None
    last = (results.increments[numbers[-1] - 1] if motion is None else results.summary["increments"][-1]).get("absent")
    with_others = [number for number in numbers if results.increments[number - 1].get("absent") != last]
    numbers = [number for number in numbers if number not in with_others]
    keys = keys_of(asked) if numbers else []
    grid = results.fields(numbers[-1]) if numbers else results.mechanism()
    if not numbers:  # without the contact faces that are in the file
        grid = of_bodies(grid)
    facets = tetrahedra.outer_facets(grid)
    triangles = tetrahedra.triangles_of(facets)
    centre = 0.5 * (grid.points.min(axis=0) + grid.points.max(axis=0))
    bodies = grid.point_data["body"]
    cells, of_cell = corners_of(grid)
    chains = tetrahedra.sharp_edges(grid.points, facets)
    edges = np.concatenate([chains[:, :2], chains[:, 1:]]).reshape(-1, 2)
    for name, values, kind in (("points", grid.points - centre, "f4"), ("triangles", triangles, "u4"), ("body", bodies, "u4"),
                               ("cells", cells, "u4"), ("cell_body", of_cell, "u4"), ("edges", edges, "u4")):
        arrays.add(f"space_{name}", values, kind)
    chosen = add_values(results, numbers, keys, arrays, budget)
    shown = sorted(chosen)
    if motion is not None:
        for name, values in zip(("ux", "uy", "uz"), motion.T):
            arrays.add(f"mechanism_{name}", values, "f4")
    why = "those with the bodies of the last one" if with_others and shown == numbers else "which keeps its size within bounds"
    what = f"This page has the fields of {len(shown)} of {results.count} increments ({listed(shown)}), {why}."
    if not shown:
        what = "This page has no fields, as no other increment has the bodies of the last one."
    return {"centre": centre.tolist(), "low": grid.points.min(axis=0).tolist(), "high": grid.points.max(axis=0).tolist(),
            "bodies": [body["name"] for body in results.summary["model"].get("bodies", [])] or [f"body {k + 1}" for k in range(int(bodies.max()))],
            "increments": shown, "ranges": chosen, "magnification": tetrahedra.magnification_of(results.fields(shown[-1])) if shown else 0.0,
            "quantities": [{"key": key, "name": tetrahedra.COMPONENTS[key][0], "dimension": tetrahedra.COMPONENTS[key][1]} for key in keys],
            "note": "" if len(shown) == results.count else what, "faces": add_faces(results, arrays, shown)}


def motion_of_nodes(results):
    """How the nodes of the bodies begin to move, n x 3; None where the run wrote no mechanism."""
    grid = results.mechanism()
    return None if grid is None else grid.point_data["displacement"][grid.point_data["pair"] == 0]


def of_bodies(grid):
    """The cells of bodies of mechanism.vtu, whose points come first."""
    points, cells = int((grid.point_data["pair"] == 0).sum()), int((grid.cell_data["body"] > 0).sum())
    return dataclasses.replace(grid, points=grid.points[:points], connectivity=grid.connectivity[:grid.offsets[cells - 1]], offsets=grid.offsets[:cells],
                               types=grid.types[:cells], point_data={name: values[:points] for name, values in grid.point_data.items()},
                               cell_data={name: values[:cells] for name, values in grid.cell_data.items()})


def keys_of(asked):
    groups = list(NAMES) if asked is None else [name.strip() for name in asked.split(",")]
    wanted = {key for name in groups for key in NAMES[name]}
    return [key for key in tetrahedra.COMPONENTS if key in wanted]


def corners_of(grid):
    """Corners of all tetrahedra, those of other cells too, and their bodies."""
    corners = tetrahedra.tetrahedra_of(grid)
    return corners, grid.point_data["body"][corners[:, 0]]


def add_values(results, numbers, keys, arrays, budget):
    """Returns, for each increment that found a place, the typical and the extreme range of every quantity."""
    steps = [entry["step"] for entry in results.increments]
    ends = [numbers.index(k) + 1 for k in range(1, results.count) if steps[k] != steps[k - 1] and k in numbers]
    chosen, spent = {}, 0
    rigid = [number for number, body in enumerate(results.summary["model"].get("bodies", []), start=1) if body["rigid"]]
    for number in (numbers[k - 1] for k in in_order_of_importance(len(numbers), ends)):
        if chosen and spent + spent / len(chosen) > budget:
            break
        grid, before, ranges = results.fields(number), arrays.size, {}
        weights, deforms = np.ones(len(grid.points)), ~np.isin(grid.point_data["body"], rigid)
        largest_stress = float(np.abs(grid.point_data["von_mises"]).max())
        for key in [*keys, *(["displacement"] if "ux" in keys else [])]:
            values, is_stress = tetrahedra.values_of(grid, key), tetrahedra.COMPONENTS[key][1] == "stress"
            if is_stress:
                values[~deforms] = np.nan  # rigid bodies have none
            low, high = geometry.typical_range(values, weights)
            if is_stress and max(abs(low), abs(high)) <= 1e-6 * largest_stress:
                low = high = 0.0
            known = values[np.isfinite(values)]
            ranges[key] = [low, high, float(known.min(initial=0.0 if len(known) == 0 else np.inf)), float(known.max(initial=0.0 if len(known) == 0 else -np.inf))]
            if key != "displacement":
                arrays.add(f"{key}_{number}", values.astype("f4"))
        spent += arrays.size - before
        chosen[number] = ranges
    return chosen


def add_faces(results, arrays, increments):
    """The contact faces as maps: for each its name, the names of its two coordinates and how many pairs it has."""
    if not increments or not results.increments[-1]["contacts"] or len(results.faces(increments[-1]).points) == 0:
        return []
    maps = tetrahedra.maps_of(results, increments[-1])
    for k, of in enumerate(maps):
        arrays.add(f"face_{k}_places", of.places, "f4")
        arrays.add(f"face_{k}_corners", of.corners, "u4")
    for number in increments:
        for k, of in enumerate(tetrahedra.maps_of(results, number)):
            if len(of.places) != len(maps[k].places):
                raise ResultsError(f"{results.directory}: the increments have different pairs; run the model again")
            for key in ON_FACES:
                arrays.add(f"face_{k}_{key}_{number}", of.values[key].astype("f4"))
            arrays.add(f"face_{k}_state_{number}", np.select([of.states == name for name in ("open", "stick", "slip")], range(3)), "u1")
    grid = results.faces(increments[-1])
    centre = 0.5 * (results.fields(increments[-1]).points.min(axis=0) + results.fields(increments[-1]).points.max(axis=0))
    known = list(results.increments[-1]["contacts"])
    for k, of in enumerate(maps):
        arrays.add(f"face_{k}_points", grid.points[grid.point_data["contact"] == known.index(of.name) + 1] - centre, "f4")
    return [{"name": of.name, "axes": list(of.axes), "pairs": len(of.places)} for of in maps]
