"""What a page says beside its fields: model, increments, certificate, history and convergence, as values of JSON."""
import math

import numpy as np

from . import words
from .choice import in_order_of_importance

MOST_CURVES = 8       # of contacts and of supports, those with the largest forces; sums are of all
MOST_TOTALS = 100000  # numbers in the tables of contacts, and of reactions
MOST_ROWS = 20000     # of convergence.csv
MOST_HISTORY = 200000  # numbers of history.csv
MOST_LISTED = 500     # bodies and contacts in the tables of the model
TOTALS = ("normal_force", "tangential_force", "max_pressure", "max_gap", "stick", "slip", "open")


def content_of(results):
    summary = results.summary
    increments = results.increments
    model = dict(summary.get("model", {}))
    for key in ("bodies", "contacts", "materials"):
        model[key] = shortened(model.get(key, []))
    failed = [entry for entry in summary.get("increments", []) if not entry["converged"]]
    return {
        "version": summary["scabo"], "title": results.title, "status": summary["status"], "directory": results.directory.resolve().name,
        "verdict": words.verdict(summary, increments), "warnings": summary.get("warnings", []), "model": model, "modal": results.modal,
        "passes": summary.get("passes", []), "timing": summary.get("timing", {}), "memory": summary.get("peak_memory_bytes"),
        "modes": summary.get("modes", []) if results.modal else [], "total_mass": summary.get("total_mass"),
        "certificate": words.certificate(increments), "time_axis": results.time_axis, "in_time": results.in_time,
        "increments": [row_of(entry, number, model, results.in_time) for number, entry in enumerate(increments, start=1)],
        "failed": [{key: entry.get(key) for key in ("step", "increment", "reached", "newton_iterations", "residual")} for entry in failed],
        "cracks": cracks_of(increments), "quantities": increments[-1].get("quantities", []) if increments else [],
        "totals": totals_of(increments), "reactions": reactions_of(increments), "history": history_of(results),
        "convergence": convergence_of(results),
    }


def shortened(entries):
    return {"count": len(entries), "listed": entries[:MOST_LISTED]}


def row_of(entry, number, model, in_time):
    """One row of the table of increments; `in_time`: of a run with steps in time."""
    contacts = entry["contacts"].values()
    figures = [abs(value) for value in (entry.get("certificate") or {}).values() if isinstance(value, (int, float))]
    steps = model.get("steps", [])
    return {"number": number, "step": entry["step"], "increment": entry["increment"], "reached": entry["reached"],
            "step_name": steps[entry["step"] - 1] if entry["step"] <= len(steps) else str(entry["step"]),
            "time": entry.get("time", 0.0) if in_time else entry["step"] - 1 + entry["reached"], "factors": entry["factors"], "iterations": entry["newton_iterations"],
            "coarse": entry.get("coarse_iterations", 0), "residual": entry.get("residual"), "certificate": max(figures, default=None),
            "open": sum(contact["open"] for contact in contacts), "stick": sum(contact["stick"] for contact in contacts),
            "slip": sum(contact["slip"] for contact in contacts), "energy": entry.get("energy"),
            "error": (entry.get("error") or {}).get("relative_energy_norm")}


def series(increments, group, name, part):
    """A value of one contact or support after every increment; None where it does not exist."""
    values = []
    for entry in increments:
        value = entry.get(group, {}).get(name)
        value = value[part] if value is not None and (not isinstance(value, list) or part < len(value)) else None
        values.append(math.hypot(*value) if isinstance(value, list) else value)  # of a vector in space its size
    return values


def largest(increments, group, size, numbers):
    """Names with the largest sizes of all increments, in the order of the model, how many there are, and those of them with curves. Each needs
    so many numbers after every increment."""
    sizes = {}
    for entry in increments:
        for name, value in entry.get(group, {}).items():
            sizes[name] = max(sizes.get(name, 0.0), size(value))
    most = max(MOST_CURVES, MOST_TOTALS // (numbers * max(1, len(increments))))
    by_size = sorted(sizes, key=sizes.get, reverse=True)
    chosen, curves = set(by_size[:most]), set(by_size[:MOST_CURVES])
    return [name for name in sizes if name in chosen], len(sizes), [name for name in sizes if name in curves]


def totals_of(increments):
    names, count, curves = largest(increments, "contacts", lambda contact: size_of(contact["normal_force"]), len(TOTALS))
    return {"count": count, "curves": curves,
            "contacts": [{"name": name, **{key: series(increments, "contacts", name, key) for key in TOTALS}} for name in names]}


def reactions_of(increments):
    names, count, curves = largest(increments, "reactions", lambda force: math.hypot(*(part or 0.0 for part in force)), 2)
    axes = "xyz"[:max((len(force) for entry in increments for force in entry.get("reactions", {}).values()), default=2)]
    return {"count": count, "curves": curves,
            "supports": [{"name": name, **{axis: series(increments, "reactions", name, k) for k, axis in enumerate(axes)}} for name in names]}


def size_of(force):
    """Of a number, or of a vector in space."""
    return math.hypot(*force) if isinstance(force, list) else abs(force or 0.0)


def cracks_of(increments):
    """Factors of cracks after the last increment."""
    if not increments:
        return []
    wanted = ("K_I", "K_II", "T", "G", "J", "K_tt", "K_rt")
    return [{"name": name, "kind": crack["kind"], **{key: crack[key] for key in wanted if crack.get(key) is not None}}
            for name, crack in increments[-1].get("cracks", {}).items()]


def history_of(results):
    """Columns of history.csv; of a long file rows at equal distances."""
    table = None if results.modal else results.table("history.csv")
    if not table or not len(table.get("time", ())):
        return None
    rows = len(table["time"])
    every = max(1, -(-rows * len(table) // MOST_HISTORY))
    kept = np.unique([*range(0, rows, every), rows - 1])
    columns = [name for name in table if name not in ("step", "increment", "time", "forces_of_radians")]
    return {"time": numbers(table["time"][kept]), "columns": [{"name": name, "values": numbers(table[name][kept])} for name in columns],
            "note": f"One row of {every} is shown." if every > 1 else ""}


def convergence_of(results):
    """Columns of convergence.csv; of a long one the rows of as many increments as have a place."""
    table = None if results.modal else results.table("convergence.csv")
    if table is None or len(table["residual"]) == 0:
        return None
    keys = table["step"] * 1e6 + table["increment"]
    keep, note = np.ones(len(keys), dtype=bool), ""
    if len(keys) > MOST_ROWS:
        order, counts = np.unique(keys, return_counts=True)
        spent, taken = 0, []
        for number in in_order_of_importance(len(order), []):
            if taken and spent + counts[number - 1] > MOST_ROWS:
                break
            taken.append(order[number - 1])
            spent += counts[number - 1]
        keep = np.isin(keys, taken)
        note = f"Iterations of {len(taken)} of {len(order)} increments are in this page."
    stages, stage = np.unique(table["stage"][keep], return_inverse=True)
    whole = {key: table[key][keep].astype(int).tolist() for key in ("step", "increment", "attempt", "iteration")}
    return {**whole, "residual": numbers(table["residual"][keep]), "stage": stage.tolist(), "stages": stages.tolist(), "note": note}


def numbers(values):
    """A list in which None stands for what is not a number."""
    return [float(value) if math.isfinite(value) else None for value in values]
