"""Largest values of contacts over all increments, and response spectra of velocities in history.csv."""
import dataclasses

import numpy as np

from . import contacts, style
from .results import NothingToDraw, ResultsError
from .units import Units

DAMPING = 0.05     # part of the critical one
PERIODS = 150      # of a spectrum
LONGEST = 10.0     # period
PARTS = 20         # of a period, in which the motion of an oscillator is followed


@dataclasses.dataclass(frozen=True)
class Envelope:
    """Of one contact, for each pair: largest opening, pressure and slip in size with their times, and the slip that is left."""
    name: str
    distance: np.ndarray
    values: dict   # opening, pressure, slip, slip left
    times: dict    # of the first three


def envelopes(results, names=()):
    """Of all contacts, or those named, over the increments that converged; those of results in which pairs stay."""
    found, times = {}, results.times()
    for number in range(1, results.count + 1):
        for line in contacts.lines_of(results, number, names):
            now = {"opening": np.maximum(line.values["gap"], 0.0), "pressure": line.values["pressure"], "slip": line.values["slip"]}
            if line.name not in found:
                found[line.name] = Envelope(line.name, line.distance, {key: np.zeros(len(line.x)) for key in now},
                                            {key: np.full(len(line.x), np.nan) for key in now})
            of = found[line.name]
            if len(of.distance) != len(line.distance):
                raise NothingToDraw(f"{results.directory}: pairs of contact {line.name} change during the run, so that they have no envelope")
            for key, values in now.items():
                larger = np.abs(values) > np.abs(of.values[key])
                of.values[key][larger] = values[larger]
                of.times[key][larger] = times[number - 1]
            of.values["slip left"] = now["slip"]
    return list(found.values())


@style.styled
def envelope(results, names=(), units=None):
    """Largest opening, pressure and slip of every pair over the run, and the slip that is left, of up to three contacts."""
    if results.modal:
        raise NothingToDraw(f"{results.directory}: is a modal analysis, which has no contact")
    results.number(-1)
    units = units or Units()
    lines = envelopes(results, names)
    most = max((np.nanmax(np.abs(line.values["pressure"]), initial=0.0), k) for k, line in enumerate(lines))[1]
    shown = lines if len(lines) <= contacts.MOST_CONTACTS else [lines[most]]
    panels = (("opening", ("opening",), "length"), ("pressure", ("pressure",), "stress"), ("slip", ("slip", "slip left"), "length"))
    largest = {keys: max(np.nanmax(np.abs(line.values[key]), initial=0.0) for line in shown for key in keys) for _, keys, _ in panels}
    scales = {keys: units.scale(dimension, largest[keys]) for _, keys, dimension in panels}
    words = [text_of(shown, key, scales[keys], results.in_time) for _, keys, _ in panels for key in keys[:1]]
    figure = style.new_figure(style.WIDTH, 5.4, results.title,
                              f"largest values over {results.count} increments\u00a0· " + "\u00a0· ".join(words))
    axes = figure.subplots(len(panels), len(shown), squeeze=False, sharex="col", sharey="row")
    for number, (column, line) in enumerate(zip(axes.T, shown)):
        along = units.scale("length", line.distance.max(initial=0.0))
        for axis, (title, keys, _) in zip(column, panels):
            for key, (colour, dashes, mark) in zip(keys, style.CURVES):
                axis.plot(along.factor * line.distance, scales[keys].factor * line.values[key], color=colour, linestyle=dashes,
                          marker=mark if len(line.distance) <= 25 else None, markersize=3.5, label=key, clip_on=False)
            axis.grid(True)
            style.plain_frame(axis)
            style.few_ticks(axis, 5, 4)
            if not largest[keys]:
                style.nothing_but_zero(axis)
            if number == 0:
                axis.set_ylabel(scales[keys].label(title))
            if len(keys) > 1:
                axis.legend(loc="best", handlelength=2.4, borderaxespad=0.2)
        column[0].set_title(style.label(line.name))
        column[-1].set_xlabel(along.label("distance along the contact"))
    return figure


def text_of(lines, key, scale, in_time):
    """`slip 3.2 mm at 1.24`, of the contact and pair where it is largest."""
    line = max(lines, key=lambda of: np.nanmax(np.abs(of.values[key]), initial=0.0))
    if not line.values[key].any():
        return f"no {key}"
    pair = int(np.argmax(np.abs(line.values[key])))
    return f"{key} {scale.text(line.values[key][pair])} at {'time' if in_time else 'increment time'} {line.times[key][pair]:.4g}"


def velocity_of(results, names):
    """Times and values of a column of history.csv, or of the sum of several, `top+ground`; it begins with 0 at time 0."""
    table = results.table("history.csv")
    if table is None or not results.in_time:
        raise NothingToDraw(f"{results.directory}: a spectrum is that of a velocity over time: ask for one under output.history, as in "
                            "top: dam.crest.vx or ground: ground_velocity_x")
    known = [name for name in table if name not in ("step", "increment", "time")]
    total = 0.0
    for name in names.split("+"):
        if name.strip() not in known:
            raise ResultsError(f"--component {names}: the columns of history.csv are {', '.join(known)}; of velocities, sums as in a+b have a "
                               "spectrum too")
        total = total + table[name.strip()]
    moving = table["time"] > 0.0
    if not np.isfinite(total[moving]).all() or not moving.any():
        raise ResultsError(f"--component {names}: has no value after some increments, and no spectrum")
    return np.append(0.0, table["time"][moving]), np.append(0.0, total[moving])


def response(times, velocity, periods, damping=DAMPING):
    """Pseudo-acceleration of oscillators on a base that moves with a velocity, linear between its times: the largest displacement
    relative to the base, during the motion and in one period after it, times the square of the circular frequency."""
    periods = np.asarray(periods, dtype=float)
    omega = 2.0 * np.pi / periods
    damped = omega * np.sqrt(1.0 - damping**2)
    x, v, largest = np.zeros_like(omega), np.zeros_like(omega), np.zeros_like(omega)

    def follow(acceleration, length):
        nonlocal x, v, largest
        rest = -acceleration / omega**2  # where it would be at rest; exact about that for a constant acceleration
        decay, cos, sin = np.exp(-damping * omega * length), np.cos(damped * length), np.sin(damped * length)
        y, slope = x - rest, (v + damping * omega * (x - rest)) / damped
        x = rest + decay * (y * cos + slope * sin)
        v = decay * ((slope * damped - damping * omega * y) * cos - (y * damped + damping * omega * slope) * sin)
        largest = np.maximum(largest, np.abs(x))

    for length, change in zip(np.diff(times), np.diff(velocity)):
        parts = max(1, int(np.ceil(PARTS * length / periods.min())))
        for _ in range(parts):
            follow(change / length, length / parts)
    for _ in range(2 * PARTS):
        follow(0.0, periods / (2 * PARTS))
    return omega**2 * largest


@style.styled
def spectrum(results, columns, units=None, damping=DAMPING):
    """Response spectra of columns of history.csv that are velocities, `ground,top+ground`; a sum is that of the absolute motion."""
    units = units or Units()
    if not columns:
        raise ResultsError("--what spectrum: name a velocity of output.history by --component, as in --component ground, or a sum, top+ground")
    moved = {names: velocity_of(results, names) for names in columns.split(",")}
    times = next(iter(moved.values()))[0]
    shortest, longest = 2.0 * np.diff(times).max(), min(LONGEST, times[-1])
    if shortest >= longest:
        raise NothingToDraw(f"{results.directory}: has too few increments for a spectrum: ask for more 'increments' in the step in time")
    periods = np.geomspace(shortest, longest, PERIODS)
    curves = {names: response(*motion, periods, damping) for names, motion in moved.items()}
    scale = units.scale("length", 1.0) if units.length else None
    figure = style.new_figure(style.WIDTH, 3.2, results.title, f"response spectra, {100 * damping:g} % of critical damping")
    axis = figure.subplots()
    for (names, values), (colour, dashes, _) in zip(curves.items(), style.CURVES):
        axis.semilogx(periods, values, color=colour, linestyle=dashes, label=style.label(names))
    axis.set(xlabel="period (s)" if units.length else "period (time)",
             ylabel=f"pseudo-acceleration ({scale.unit if scale and scale.factor == 1.0 else units.length or 'length'} / {'s' if units.length else 'time'}²)")
    axis.set_ylim(bottom=0.0)
    axis.grid(True, which="both")
    style.plain_frame(axis)
    axis.legend()
    return figure
