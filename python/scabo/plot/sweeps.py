"""A sweep (`scabo sweep`): quantities of the last increment over the first varied value, a line for each value of the others."""
import csv
import json
import pathlib

import numpy as np
from matplotlib.lines import Line2D

from . import style
from .results import NothingToDraw, ResultsError
from .units import Units

MOST_PANELS, MOST_LINES = 6, 12
PREFERRED = (".normal_force", ".tangential_force", ".max_pressure", ".max_gap")  # of contacts, without a history
DIMENSIONS = {"normal_force": "force", "tangential_force": "force", "pore_force": "force", "total_normal_force": "force", "tension": "force", "force_x": "force",
              "force_y": "force", "reaction_x": "force", "reaction_y": "force", "max_gap": "length", "centre_x": "length", "centre_y": "length",
              "max_pressure": "stress", "moment": "energy", "external": "energy", "elastic": "energy", "friction": "energy"}


class Sweep:
    """The table of a sweep: `varied` paths; `columns` of figures; `values(name)` of all points, not a number where there is none."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        try:
            with open(self.directory / "sweep.csv", newline="", encoding="utf-8") as file:
                self.rows = list(csv.DictReader(file))
            self.varied = [axis["path"] for axis in json.loads((self.directory / "sweep.json").read_text(encoding="utf-8"))["vary"]]
            names = list(self.rows[0])
            self.columns = names[names.index("reached") + 1:]
            self.texts = {path: [row[path] for row in self.rows] for path in self.varied}
            self.status = [row["status"] for row in self.rows]
        except OSError as error:
            raise ResultsError(f"{error.filename}: cannot be read: {error.strerror}") from None
        except (ValueError, KeyError, IndexError, TypeError, csv.Error) as error:
            raise ResultsError(f"{self.directory / 'sweep.csv'}: is damaged ({error}); sweep again") from None

    @staticmethod
    def is_in(directory):
        return (pathlib.Path(directory) / "sweep.csv").is_file()

    def values(self, name):
        try:
            return np.array([float(row[name] or "nan") for row in self.rows])
        except ValueError as error:
            raise ResultsError(f"{self.directory / 'sweep.csv'}: is damaged ({error}); sweep again") from None

    def solved(self):
        return np.array([status == "solved" for status in self.status])

    def numbers(self, path):
        """Values of an axis; None if they are words."""
        try:
            return np.array([float(text) for text in self.texts[path]])
        except ValueError:
            return None

    def lines(self):
        """Path of the horizontal axis, and for each line its name and the numbers of its points, in order."""
        across = next((path for path in self.varied if self.numbers(path) is not None), self.varied[0])
        others = [path for path in self.varied if path != across]
        lines = {}
        for k in range(len(self.rows)):
            name = ", ".join(f"{short(path)} = {self.texts[path][k]}" for path in others)
            lines.setdefault(name, []).append(k)
        return across, {name: np.array(points) for name, points in lines.items()}


def short(path):
    """`level` of `parameters.level`."""
    return path.removeprefix("parameters.")


def wanted(sweep, names):
    """Columns to draw: those named, where `thrust` stands for `thrust.last`; otherwise the history, or the figures of the contacts, as
    far as they change."""
    if names:
        chosen = []
        for name in names:
            found = [column for column in (name, name + ".last") if column in sweep.columns]
            if not found:
                raise ResultsError(f"--component {name}: the table has {', '.join(sweep.columns) or 'no figures, as no point is solved'}")
            chosen.append(found[0])
        return chosen
    if not sweep.solved().any():
        raise NothingToDraw(f"{sweep.directory}: no point is solved")
    changing = [name for name in sweep.columns if changes(sweep.values(name)[sweep.solved()])]
    history = [name for name in changing if name.endswith(".last")]
    chosen = history or [name for name in changing if name.endswith(PREFERRED)] or changing or sweep.columns
    return chosen[:MOST_PANELS]


def changes(values):
    values = values[np.isfinite(values)]
    return len(values) > 0 and (len(values) == 1 or np.ptp(values) > 1e-9 * np.abs(values).max())


@style.styled
def sweep(directory, columns=(), units=None):
    """One panel for each column (wanted() without any)."""
    table, units = Sweep(directory), units or Units()
    columns = wanted(table, columns)
    across, lines = table.lines()
    if len(lines) > MOST_LINES:
        raise NothingToDraw(f"{table.directory}: would have {len(lines)} lines, at most {MOST_LINES} can be told apart: vary fewer values besides "
                            f"{across}, or draw sweep.csv by a program of your own")
    many = len(lines) > 4  # whose names get a panel of their own
    panels = min(2, len(columns) + many)
    rows = -(-(len(columns) + many) // panels)
    solved = table.solved()
    subtitle = f"{len(solved)} points, {solved.sum()} solved" + ("" if solved.all() else "; crosses at the bottom: " + ", ".join(
        f"{table.status.count(status)} {status.replace('_', ' ')}" for status in dict.fromkeys(table.status) if status != "solved"))
    legend = [(Line2D([], [], color=colour, linestyle=dashes, marker=mark, markersize=3.5), style.label(name))
              for name, (colour, dashes, mark) in zip(lines, looks(len(lines))) if name]
    figure = style.new_figure(style.WIDTH if panels == 2 else 4.6, 2.4 * rows if panels == 2 else 3.2,
                              "Sweep of " + ", ".join(map(short, table.varied)), subtitle, () if many else legend)
    axes = figure.subplots(rows, panels, squeeze=False).reshape(-1)
    for axis, column in zip(axes, columns):
        draw_panel(axis, table, column, across, lines, units)
    for axis in axes[len(columns):]:
        axis.set_axis_off()
    if many:
        names = axes[len(columns)].legend([artist for artist, _ in legend], [text for _, text in legend], loc="upper left",
                                          ncols=1 + (len(legend) > 7), labelspacing=0.3)
        names.set_in_layout(False)  # it may be taller than the panel
    return figure


def looks(count):
    """Colour, dashes and mark of every line."""
    if count <= len(style.CURVES):
        return style.CURVES[:count]
    return [(style.plt.get_cmap("viridis")(0.9 * k / (count - 1)), style.CURVES[k % 6][1], style.CURVES[k % 6][2]) for k in range(count)]


def draw_panel(axis, table, column, across, lines, units):
    values, x, lines_between = table.values(column), table.numbers(across), None
    words = list(dict.fromkeys(table.texts[across]))
    if x is None:  # words, between which there is nothing
        lines_between = "none"
        x = np.array([words.index(text) for text in table.texts[across]], dtype=float)
        axis.set_xticks(range(len(words)), words)
    elif len(words) > 2 and is_geometric(np.unique(x)):
        axis.set_xscale("log")
    dimension = DIMENSIONS.get(column.rsplit(".", 1)[-1])
    scale = units.scale(dimension or "number", np.nanmax(np.abs(values), initial=0.0)) if dimension else None
    factor, label = (scale.factor, scale.label(column)) if scale else (1.0, column.removesuffix(".last"))
    for k, (points, (colour, dashes, mark)) in enumerate(zip(lines.values(), looks(len(lines)))):
        points = points[np.argsort(x[points], kind="stable")]
        axis.plot(x[points], factor * values[points], color=colour, linestyle=lines_between or dashes, marker=mark, markersize=3.5,
                  clip_on=False)
        failed = points[~table.solved()[points]]
        if len(failed):  # an empty line that is not clipped would have no finite box
            axis.plot(x[failed], np.full(len(failed), 0.03 + 0.05 * k), linestyle="", marker="x", markersize=4.5, color=colour, clip_on=False,
                      transform=axis.get_xaxis_transform())
    axis.set(xlabel=short(across), ylabel=label)
    axis.margins(0.05, 0.08)
    axis.grid(True)
    style.plain_frame(axis)
    if not table.solved().all():  # room for the crosses
        low, high = axis.get_ylim()
        axis.set_ylim(low - (0.05 * len(lines) + 0.02) * (high - low), high)
    if table.numbers(across) is not None:
        style.few_ticks(axis, 5, 5)


def is_geometric(values):
    """Positive, of equal ratios, over more than a decade."""
    if values[0] <= 0 or values[-1] < 10 * values[0]:
        return False
    ratios = values[1:] / values[:-1]
    return np.ptp(ratios) < 0.05 * ratios.mean()
