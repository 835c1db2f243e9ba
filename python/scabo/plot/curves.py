"""Curves over increments: forces, states, loads against displacements, hysteresis, energies; and convergence of the contact solver."""
import dataclasses

import numpy as np
from matplotlib.lines import Line2D

from . import style
from .results import NothingToDraw, ResultsError, without_rounding
from .units import Units

LEAST = 1e-17      # drawn for a residual of zero
MOST_COLUMNS = 6   # of history.csv
MOST_CURVES = 6    # in one panel
MOST_NAMED = 4     # increments with a mark and a name
PAIRS = ("pairs", "number")
MOST_ATTEMPTS = 150  # whose residuals are drawn
MOST_FILES = 400   # files of fields that are read for a displacement


@dataclasses.dataclass(frozen=True)
class Curve:
    name: str
    x: np.ndarray
    y: np.ndarray


@dataclasses.dataclass(frozen=True)
class Panel:
    """Curves with one pair of axes: what they are called and their dimension (units.py)."""
    title: str
    x: tuple
    y: tuple
    curves: list


@style.styled
def history(results, component=None, units=None):
    """Panels over the increments; `component` chooses one of PANELS."""
    if results.modal:
        raise NothingToDraw(f"{results.directory}: is a modal analysis, which has no increments")
    results.number(-1)
    units = units or Units()
    if component is not None and component not in PANELS:
        raise ResultsError(f"--component {component}: over increments there are {', '.join(PANELS)}")
    made = [PANELS[name](results) for name in ([component] if component else PANELS)]
    panels = [panel for some in made for panel in (some if isinstance(some, list) else [some]) if panel and panel.curves]
    if not panels:
        raise NothingToDraw(f"{results.directory}: has nothing to draw over increments" + (f" as {component}" if component else ""))
    columns = min(2, len(panels))
    rows = -(-len(panels) // columns)
    increments = results.count
    subtitle = f"{increments} increments in {results.increments[-1]['step']} steps" if increments > 1 else \
        "one increment only: its values are marked"
    if results.increments[-1]["step"] == 1:
        subtitle = subtitle.replace("1 steps", "one step")
    if results.revolved:
        subtitle += f"\u00a0\u00b7 forces and energies of {results.summary['model']['forces_of']}"
    figure = style.new_figure(style.WIDTH if columns == 2 else 4.6, 2.55 * rows if columns == 2 else 3.2, results.title, subtitle)
    axes = figure.subplots(rows, columns, squeeze=False).reshape(-1)
    for axis, panel in zip(axes, panels):
        draw_panel(axis, panel, units)
    for axis in axes[len(panels):]:
        axis.set_visible(False)
    return figure


def draw_panel(axis, panel, units):
    largest = lambda key: max((np.nanmax(np.abs(getattr(curve, key)), initial=0.0) for curve in panel.curves), default=0.0)
    x_scale, y_scale = units.scale(panel.x[1], largest("x")), units.scale(panel.y[1], largest("y"))
    for curve, (colour, dashes, mark) in zip(panel.curves, style.CURVES):
        if curve.name in style.STATES:
            colour, mark, _ = style.STATES[curve.name]
        axis.plot(x_scale.factor * curve.x, y_scale.factor * curve.y, color=colour, linestyle=dashes, marker=mark if len(curve.x) <= 25 else None,
                  markersize=3.5, label=style.label(curve.name), clip_on=False)
    axis.set(title=panel.title, xlabel=x_scale.label(panel.x[0]), ylabel=y_scale.label(panel.y[0]))
    axis.grid(True)
    style.plain_frame(axis)
    axis.margins(0.05, 0.08)
    if max(len(curve.x) for curve in panel.curves) == 1:  # one increment: how far it is from nothing
        axis.axhline(0, linewidth=0)
        axis.axvline(0, linewidth=0)
    if largest("y") and panel.y == PAIRS:
        axis.set_ylim(bottom=-0.05 * largest("y"))
    style.few_ticks(axis, 5, 5)
    if not largest("y"):
        style.nothing_but_zero(axis)
    names = [curve.name for curve in panel.curves if curve.name]
    if names:
        room_for_legend(axis, 2 if max(map(len, names)) <= 17 else 1, len(names))
    if largest("y") and panel.y == PAIRS:
        axis.yaxis.get_major_locator().set_params(integer=True)


def room_for_legend(axis, columns, entries):
    """A legend above the curves, within the axes."""
    low, high = axis.get_ylim()
    part = 0.04 + 0.085 * -(-entries // columns)
    axis.set_ylim(low, low + (high - low) / (1 - part))
    axis.legend(loc="upper left", ncols=columns, handlelength=2.0, labelspacing=0.2, borderaxespad=0.25, columnspacing=1.0, borderpad=0.1)


def contact_names(results, most=MOST_CURVES):
    """The contacts with the largest normal force of any increment, in the order of the model."""
    forces = {}
    for entry in results.increments:
        for name, contact in entry["contacts"].items():
            forces[name] = max(forces.get(name, 0.0), abs(contact["normal_force"] or 0.0))
    chosen = sorted(forces, key=forces.get, reverse=True)[:most]
    return [name for name in forces if name in chosen], len(forces)


def short_name(name, most=24):
    return name if len(name) <= most else name[:most // 2 - 1] + "…" + name[-most // 2:]


def of_contacts(results, name, key):
    """A value of one contact after every increment."""
    values = [entry["contacts"].get(name, {}).get(key) for entry in results.increments]
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def forces(results):
    """Normal and tangential force of each contact; of many, of those that carry most."""
    names, count = contact_names(results, 3)
    title = "forces of contacts" if count <= 3 else f"forces of contacts (3 of {count}, the largest)"
    curves = [Curve(f"{short_name(name)}, {short}" if count > 1 else long, results.times(), of_contacts(results, name, key)) for name in names
              for key, short, long in (("normal_force", "n", "normal"), ("tangential_force", "t", "tangential"))]
    return Panel(title if count else "", (results.time_axis, "number"), ("force", "force"), curves)


def states(results):
    """Pairs that are open, stick and slip, of all contacts."""
    if not any(entry["contacts"] for entry in results.increments):
        return None
    totals = {state: np.array([sum(contact[state] for contact in entry["contacts"].values()) for entry in results.increments], dtype=float)
              for state in style.STATES}
    return Panel("pairs of nodes", (results.time_axis, "number"), PAIRS,
                 [Curve(state, results.times(), total) for state, total in totals.items()])


def mean_slip(results, name):
    """Mean slip of the pairs of a contact after every increment, without that which is only rounding."""
    table = results.table("contact.csv")
    chosen = table["contact"] == name
    keys = ("x", "y", "slip", "tangential_displacement_a", "tangential_displacement_b")
    slip = without_rounding({key: table[key][chosen] for key in keys}, "slip", "tangential")
    step, increment = table["step"][chosen], table["increment"][chosen]
    starts = np.flatnonzero((np.diff(step, prepend=-1) != 0) | (np.diff(increment, prepend=-1) != 0))  # rows of an increment stand together
    means = np.add.reduceat(slip, starts) / np.diff(np.append(starts, len(slip)))
    of = dict(zip(zip(step[starts], increment[starts]), means))
    return np.array([of.get((entry["step"], entry["increment"]), np.nan) for entry in results.increments])


def hysteresis(results):
    """Tangential force against mean slip of each contact: a loop where slip reverses."""
    names, count = contact_names(results, 3)
    if not names or results.table("contact.csv") is None:
        return None
    curves = [Curve(short_name(name) if count > 1 else "", mean_slip(results, name), of_contacts(results, name, "tangential_force"))
              for name in names]
    largest = max(np.nanmax(np.abs(of_contacts(results, name, "normal_force")), initial=0.0) for name in names)
    if all(np.nanmax(np.abs(curve.y), initial=0.0) <= 1e-8 * largest for curve in curves):  # without friction, or a closed line
        return None
    if not any(np.nan_to_num(curve.x).any() for curve in curves):  # nothing slips
        return None
    return Panel("tangential force against slip", ("mean slip", "length"), ("tangential force", "force"), curves)


def largest_displacement(results):
    """After every increment, and what it is called: of the first point of `output.points` the component that changes most, otherwise
    the largest one of any point of the fields; None where increments have no fields."""
    points = results.table("points.csv")
    if points is not None and len(points["name"]):
        name = points["name"][0]
        rows = (points["name"] == name) & (points["body"] == points["body"][0])
        if rows.sum() == results.count:
            key = max(("ux", "uy"), key=lambda component: np.ptp(np.append(points[component][rows], 0.0)))
            return f"{key} of {name}", points[key][rows]
    numbers = results.field_numbers()
    if len(numbers) != results.count or len(numbers) > MOST_FILES:
        return None
    values = []
    for number in numbers:
        displacement = results.fields(number).point_data.get("displacement")
        if displacement is None:
            return None
        values.append(float(np.hypot(*displacement[:, :2].T).max()))
    return "largest displacement", np.array(values)


def load_displacement(results):
    """Factors that change during the analysis against a displacement; or, where supports are moved, their reactions against the factors
    of their displacements."""
    factors = {name: np.array([entry["factors"][name] for entry in results.increments], dtype=float)
               for name in results.increments[0]["factors"]}
    changing = {name: values for name, values in factors.items() if np.ptp(values) > 0} or factors
    moved = [name for name in changing if name in results.increments[0]["reactions"]]
    if moved:
        return Panel("reaction against displacement", ("factor of the displacement", "number"), ("force", "force"),
                     [reaction_of(results, name, changing[name]) for name in moved[:MOST_CURVES]])
    displacement = largest_displacement(results)
    if displacement is None:
        return None
    alike = {}  # loads with equal factors share a curve
    for name, values in changing.items():
        alike.setdefault(tuple(values), []).append(short_name(name))
    curves = [Curve(names[0] if len(names) == 1 else f"{names[0]} and {len(names) - 1} more", displacement[1], np.array(values))
              for values, names in list(alike.items())[:MOST_CURVES]]
    return Panel("load against displacement", (displacement[0], "length"), ("factor of the load", "number"), curves)


def reaction_of(results, name, factor):
    """The component of a reaction that changes most."""
    force = np.array([entry["reactions"][name] for entry in results.increments], dtype=float)
    k = int(np.argmax(np.ptp(np.vstack([force, [0.0, 0.0]]), axis=0)))
    return Curve(f"{short_name(name)}, {'xy'[k]}", factor, force[:, k])


def least_load(results):
    """A force that the loads of the model together exceed: its elastic energy is at most half of their sum times the largest displacement.
    0 where no fields tell."""
    try:
        numbers = [number for number in results.field_numbers() if number <= results.count]
        displacement = results.fields(numbers[-1]).point_data.get("displacement") if numbers else None
    except ResultsError:  # a file that is damaged or missing; pictures that need it say so
        displacement = None
    if displacement is None:
        return 0.0
    largest = np.hypot(*displacement[:, :2].T).max()
    elastic = results.increments[numbers[-1] - 1]["energy"]["elastic"] or 0.0
    return 2.0 * elastic / largest if largest > 0.0 else 0.0


def reactions(results):
    """Components of the reactions; of many supports the largest ones."""
    sizes = {}
    for entry in results.increments:
        for name, force in entry["reactions"].items():
            for k in range(2):
                sizes[name, k] = max(sizes.get((name, k), 0.0), abs(force[k] or 0.0))
    pressed = [abs(contact["normal_force"] or 0.0) for entry in results.increments for contact in entry["contacts"].values()]
    largest = max([*sizes.values(), *pressed, least_load(results)], default=0.0)
    kept = [key for key in sizes if sizes[key] > 1e-9 * largest]  # others are rounding beside the forces of the model
    kept = [key for key in kept if key in sorted(kept, key=sizes.get, reverse=True)[:4]]
    curves = [Curve(f"{short_name(name)}, {'xy'[k]}", results.times(),
                    np.array([entry["reactions"][name][k] for entry in results.increments], dtype=float)) for name, k in kept]
    return Panel("reactions", (results.time_axis, "number"), ("force", "force"), curves)


def energies(results):
    """Of summary.json; in time those of the balance that are not nothing, the largest ones."""
    terms = [("external", "work of loads"), ("elastic", "elastic"), ("friction", "friction")]
    values = lambda key: np.array([entry["energy"].get(key) or 0.0 for entry in results.increments], dtype=float)
    if results.in_time:
        more = [("kinetic", "kinetic"), ("damping", "damping"), ("impact", "impact"), ("projection", "projection"), ("massless", "massless parts")]
        sizes = {key: np.abs(values(key)).max(initial=0.0) for key, _ in more}
        kept = sorted((key for key in sizes if sizes[key] > 1e-3 * np.abs(values("external")).max(initial=0.0)), key=sizes.get)[-3:]
        terms += [term for term in more if term[0] in kept]
    curves = [Curve(name, results.times(), values(key)) for key, name in terms]
    return Panel("energy", (results.time_axis, "number"), ("energy", "energy"), curves)


def asked_for(results):
    """What `output.history` asks for, a panel for each column of history.csv; of many the first."""
    table = results.table("history.csv")
    if table is None:
        return []
    names = [name for name in table if name not in ("step", "increment", "time", "forces_of_radians")]
    count = f" ({MOST_COLUMNS} of {len(names)} columns)" if len(names) > MOST_COLUMNS else ""
    return [Panel(short_name(name) + count, (results.time_axis, "number"), ("in units of the model", "number"),
                  [Curve("", table["time"][:results.count], table[name][:results.count])]) for name in names[:MOST_COLUMNS]]


PANELS = {"forces": forces, "states": states, "load": load_displacement, "hysteresis": hysteresis, "reactions": reactions,
          "energy": energies, "history": asked_for}


@dataclasses.dataclass(frozen=True)
class Attempt:
    """Iterations of one attempt at an increment."""
    number: int            # of the increment, from 1, those that did not converge counted too
    attempt: int
    accepted: bool
    iterations: np.ndarray
    residuals: np.ndarray
    coarse: np.ndarray     # of a problem with fewer pairs


def attempts_of(results):
    """All attempts in convergence.csv, in its order. An attempt is accepted if it is the last one of an increment that converged."""
    table = results.table("convergence.csv")
    if table is None or not table["residual"].any():
        raise NothingToDraw(f"{results.directory}: has no convergence.csv with iterations; the model has no contact")
    keys = np.column_stack([table[key] for key in ("step", "increment", "attempt")]).astype(int)
    borders = np.flatnonzero((keys[1:] != keys[:-1]).any(axis=1)) + 1
    converged = {(entry["step"], entry["increment"]) for entry in results.increments}
    groups = np.split(np.arange(len(keys)), borders)
    last = {tuple(keys[rows[0], :2]): k for k, rows in enumerate(groups)}
    attempts, numbers = [], {}
    for k, rows in enumerate(groups):
        increment = tuple(keys[rows[0], :2])
        number = numbers.setdefault(increment, len(numbers) + 1)
        coarse = np.array(["," in stage for stage in table["stage"][rows]])
        attempts.append(Attempt(number, int(keys[rows[0], 2]), increment in converged and last[increment] == k, table["iteration"][rows],
                                table["residual"][rows], coarse))
    return attempts


@style.styled
def convergence(results):
    """Residual over the iterations of every attempt at an increment, and the number of iterations of every increment."""
    if results.modal:
        raise NothingToDraw(f"{results.directory}: is a modal analysis, which has no iterations of contact")
    attempts = attempts_of(results)
    count = attempts[-1].number
    several = count > 1
    accepted = sorted({attempt.number for attempt in attempts if attempt.accepted})
    legend = []
    if several and count <= MOST_NAMED:
        legend = [(Line2D([], [], color=colour_of(k, count), marker=mark_of(k, count), markersize=4, linewidth=0.9), f"increment {k}")
                  for k in accepted]
    if any(attempt.coarse.any() for attempt in attempts):
        legend.append((Line2D([], [], color="0.4", marker="o", markersize=4, markerfacecolor="white", linewidth=0.8), "on fewer pairs"))
    if any(not attempt.accepted for attempt in attempts):
        legend.append((Line2D([], [], color=style.RED, linestyle="--", marker="x", markersize=4, linewidth=0.9), "not accepted"))
    subtitle = f"convergence of the contact solver: {words_for_iterations(attempts)}; {count} increment{'s' * several}"
    if len(attempts) > MOST_ATTEMPTS:
        subtitle += f"; residuals of about {MOST_ATTEMPTS} attempts"
    figure = style.new_figure(style.WIDTH, 3.1, results.title, subtitle, legend)
    axes = figure.subplots(1, 2 if several else 1, squeeze=False, width_ratios=[1.6, 1] if several else [1])[0]
    every = -(-len(attempts) // MOST_ATTEMPTS)
    for attempt in attempts[::-every][::-1]:
        draw_attempt(axes[0], attempt, count)
    axes[0].set(yscale="log", xlabel="iteration", ylabel="residual / largest force")
    axes[0].grid(True, which="major")
    style.plain_frame(axes[0])
    style.few_ticks(axes[0], 7)
    axes[0].xaxis.get_major_locator().set_params(integer=True)
    if several:
        per_increment = iterations_of(attempts)
        axes[1].vlines(np.arange(1, count + 1), 0, per_increment, color=style.BLUE, linewidth=float(np.clip(110 / count, 0.6, 6)))
        axes[1].set(xlabel="increment", ylabel="iterations", xlim=(0.3, count + 0.7), ylim=(0, None), title="iterations of each increment")
        axes[1].grid(True, axis="y")
        style.plain_frame(axes[1])
        style.few_ticks(axes[1], 6, 5)
        for scale in (axes[1].xaxis, axes[1].yaxis):
            scale.get_major_locator().set_params(integer=True)
        axes[0].set_title("residual" + ("" if count <= MOST_NAMED else "; from dark to light over the increments"))
    return figure


def iterations_of(attempts):
    """Iterations of all attempts at each increment."""
    counts = np.zeros(attempts[-1].number, dtype=int)
    for attempt in attempts:
        counts[attempt.number - 1] += taken_by(attempt)
    return counts


def taken_by(attempt):
    """Iterations of one attempt, as summary.json counts them: the row of number 0 is the start."""
    return int(attempt.iterations[-1])


def words_for_iterations(attempts):
    """Those of the whole problem and those on fewer pairs, as the program prints them."""
    fewer = sum(int(attempt.iterations[attempt.coarse].max(initial=0)) for attempt in attempts)
    whole = sum(map(taken_by, attempts)) - fewer
    words = f"{whole} iteration{'s' * (whole != 1)}"
    return f"{words}, and {fewer} on fewer pairs, whose solution is the start of the next problem" if fewer else words


def colour_of(number, count):
    """From dark to light over the increments, never too light to see."""
    return style.plt.get_cmap("viridis")(0.85 * (number - 1) / max(1, count - 1))


def mark_of(number, count):
    return style.CURVES[number - 1][2] if count <= MOST_NAMED else "."


def draw_attempt(axis, attempt, count):
    residuals = np.where(np.isfinite(attempt.residuals), np.maximum(attempt.residuals, LEAST), np.nan)
    colour = colour_of(attempt.number, count) if attempt.accepted else style.RED
    dashes = "-" if attempt.accepted else "--"
    # A number again is the start of another problem, whose residual is another one: after one with fewer pairs, or, with a larger
    # residual, of the next round of laws that depend on history.
    anew = attempt.coarse[:-1] | (residuals[1:] > residuals[:-1])
    starts = np.flatnonzero((np.diff(attempt.iterations) <= 0) & anew) + 1
    for rows in np.split(np.arange(len(residuals)), starts):
        axis.plot(attempt.iterations[rows], residuals[rows], color=colour, linestyle=dashes, linewidth=0.9)
    mark = mark_of(attempt.number, count) if attempt.accepted else "x"
    for coarse in (False, True):
        chosen = attempt.coarse == coarse
        axis.plot(attempt.iterations[chosen], residuals[chosen], linestyle="", marker=mark, markersize=4 if count <= 20 else 2.5, color=colour,
                  markerfacecolor="white" if coarse else colour)
