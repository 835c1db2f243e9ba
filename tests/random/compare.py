"""What a model and its twin must have in common.

Units, turned, reordered: the same status, in the same increment; the same pairs; forces that are unique to 1e-8 of the
largest force so far. Supports that hold a corner together are compared by the sum of their forces. Finer, and turned where the mesh does not turn with the bodies: the same status; at the end of each
step resultants within 5 % of the largest one. A joint that breaks brittly does so at a load that depends on the mesh
(docs/methods/20_contact_laws.md): finer meshes are then compared by their status alone."""
import math

EQUAL, CLOSE = 1e-8, 0.05
NOTHING = 1e-100  # N, of bodies that nothing touches yet: no force but its rounding
PLACE = 1e-8  # m, of bodies of about a metre
SLOPE = math.hypot(1.0, 0.5)  # a pair may be aside by half of what it is apart (docs/methods/11_matching.md)


def differences(one, other, strict):
    """Sentences, the worst first; none if the two agree."""
    if one.status != other.status:
        return [f"status {one.status} and {other.status}"]
    if one.status in ("refused", "failed", "crashed", "endless"):
        return []
    found = []
    if strict and one.last != other.last:
        found.append(f"ends in increment {one.last} and {other.last}")
    if not strict and broken(one, other):
        return found
    return found + worst(one, other, strict)


def broken(*outcomes):
    return any(contact["broken"] for outcome in outcomes for increment in outcome.increments for contact in increment["contacts"].values())


def worst(one, other, strict):
    limit, found, largest = EQUAL if strict else CLOSE, [], 0.0
    by_time = {(increment["step"], increment["increment"]): increment for increment in other.increments}
    ends = {increment["step"]: increment for increment in other.increments if increment["end"]}
    for increment in one.increments:
        largest = max([largest, *sizes(increment)])
        time = increment["step"], increment["increment"]
        twin = by_time.get(time) if strict else ends.get(increment["step"]) if increment["end"] else None
        if twin is None or largest <= NOTHING:
            continue
        found += list(of_increment(one, other, increment, twin, limit * largest, largest))
        if strict:
            found += of_pairs(one, other, time, limit * largest, largest)
    return [f"{text} {amount:.1e} in increment {time}" for amount, text, time in sorted(found, reverse=True)]


def sizes(increment):
    yield from (contact["size"] for contact in increment["contacts"].values())
    yield increment["largest_of_supports"]


def of_increment(one, other, increment, twin, limit, largest):
    """Resultants that differ by more than the limit."""
    time, loose = (increment["step"], increment["increment"]), one.loose | other.loose
    if increment["contacts"].keys() != twin["contacts"].keys():
        yield math.inf, "other contacts", time
        return
    for name, contact in increment["contacts"].items():
        for key in ("normal", "tangential"):
            apart = abs(contact[key] - twin["contacts"][name][key])
            if apart > limit and name not in loose:
                yield apart / largest, f"{key} force of {name}", time
    for name, force in increment["supports"].items():
        apart = math.dist(force, twin["supports"].get(name, [math.inf, math.inf]))
        if apart > limit:
            yield apart / largest, f"force of {name}", time


def of_pairs(one, other, time, limit, largest):
    """The same pairs at the same places; their forces too, where all of them are unique."""
    unique = not any("undetermined_force" in outcome.warnings for outcome in (one, other))
    for (step, increment, contact), rows in one.pairs.items():
        if (step, increment) != time:
            continue
        twins = other.pairs.get((step, increment, contact), [])
        if len(rows) != len(twins):
            yield math.inf, f"{len(rows)} and {len(twins)} pairs of {contact},", time
            continue
        if len(rows) > 1 and math.dist(rows[0][:2], twins[0][:2]) > math.dist(rows[0][:2], twins[-1][:2]):
            twins = twins[::-1]
        moved = max(math.dist(row[:2], twin[:2]) - SLOPE * (row[4] + one.gap) for row, twin in zip(rows, twins))  # of A, then of B
        if moved > PLACE:
            yield moved, f"places of pairs of {contact}, m:", time
        apart = max(math.dist(row[2:4], twin[2:4]) for row, twin in zip(rows, twins))
        if unique and apart > limit:
            yield apart / largest, f"pairs of {contact}", time
