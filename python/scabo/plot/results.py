"""A results directory as arrays (docs/results.md). Nothing is computed here that the program has not written."""
import csv
import errno
import functools
import json
import pathlib
import re

import numpy as np

from . import revolution, vtu

TEXT = ("contact", "state", "stage", "name", "body", "tip")  # columns that are not numbers


class ResultsError(Exception):
    """The directory has not what a picture needs: one sentence for the user, with a remedy."""


class NothingToDraw(ResultsError):
    """The results are sound, but have nothing of this kind."""


def refuse_impossible(directory):
    """Where nothing can be, whatever is written or read there."""
    try:
        directory.stat()
    except OSError as error:
        if error.errno == errno.ELOOP:
            raise ResultsError(f"{directory}: the symbolic links in its path form a loop") from None
        if error.errno == errno.ENAMETOOLONG:
            raise ResultsError(f"{directory}: the name is too long") from None


class Results:
    """The results in `directory`; files are read when they are needed."""

    def __init__(self, directory, mirrored=False):
        """`mirrored`: fields of bodies of revolution have both halves of the section."""
        self.directory = pathlib.Path(directory)
        self.summary = self._summary()
        self.revolved = self.summary.get("model", {}).get("plane") == "axisymmetric"
        self.mirrored = mirrored
        if mirrored and not self.revolved:
            raise ResultsError(f"{self.directory}: is not of bodies of revolution (plane: axisymmetric), so that there is no other half to draw")
        self.modal = self.summary.get("analysis") == "modal"
        self.in_space = self.summary.get("analysis") == "space"
        self.title = self.summary.get("title") or ""

    def _summary(self):
        path = self.directory / "summary.json"
        refuse_impossible(self.directory)
        if not self.directory.exists():
            hint = ": `scabo run model.yaml` writes model.results"
            raise ResultsError(f"{self.directory}: there is no such directory{hint}")
        if not self.directory.is_dir():
            raise ResultsError(f"{self.directory}: is a file, not a results directory; `scabo run model.yaml` writes model.results")
        try:
            summary = json.loads(path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            raise ResultsError(f"{self.directory}: has no summary.json, so it is not a results directory of `scabo run`") from None
        except OSError as error:
            raise ResultsError(f"{path}: cannot be read: {error.strerror}") from None
        except ValueError as error:
            raise ResultsError(f"{path}: is damaged ({error}); run the model again") from None
        if not isinstance(summary, dict) or "scabo" not in summary or "status" not in summary:
            raise ResultsError(f"{path}: was not written by `scabo run`")
        return summary

    @property
    def increments(self):
        """Entries of summary.json of all increments that converged, in their order; of a modal analysis none."""
        return [entry for entry in self.summary.get("increments", []) if entry["converged"]]

    @property
    def count(self):
        """Number of increments, or of modes."""
        return len(self.summary.get("modes", [])) if self.modal else len(self.increments)

    def number(self, increment):
        """1 to `count`; negative numbers count from the last one."""
        what = "mode" if self.modal else "increment"
        if self.count == 0:
            raise ResultsError(f"{self.directory}: has no finished {what} (status: {self.summary['status']})")
        number = increment if increment > 0 else self.count + 1 + increment
        if increment == 0 or not 1 <= number <= self.count:
            raise ResultsError(f"--increment {increment}: {self.directory} has {self.count} {what}{'s' * (self.count > 1)}; give 1 to "
                               f"{self.count}, or -1 for the last one")
        return number

    def name_of(self, number):
        """`step 2 (push), increment 1` of a number from 1."""
        if self.modal:
            mode = self.summary["modes"][number - 1]
            return f"mode {number} of {mode['body']}, frequency {mode['frequency']:.5g} (1 / time)"
        entry = self.increments[number - 1]
        name = self.place_of(entry)
        if number == self.count and self.summary["status"] not in ("solved", "running"):
            name += f" (the last one; the run ended as {self.summary['status'].replace('_', ' ')})"
        return name

    def place_of(self, entry):
        """`step 2 (push), increment 1` of an entry of summary.json; without the name that a step has by its number alone."""
        step = entry["step"]
        names = self.summary.get("model", {}).get("steps", [])
        named = step <= len(names) and names[step - 1] != f"step_{step}"
        return f"step {step}" + (f" ({names[step - 1]})" if named else "") + f", increment {entry['increment']}"

    @property
    def in_time(self):
        """Whether the run has steps in time."""
        return any("time" in entry for entry in self.increments)

    @property
    def time_axis(self):
        """What the axis of times() is called."""
        return "time" if self.in_time else "time, in steps"

    def times(self):
        """Time of every increment: 0 to 1 in the first step, 1 to 2 in the second; of a run with steps in time its time, 0
        before them."""
        if self.in_time:
            return np.array([entry.get("time", 0.0) for entry in self.increments])
        return np.array([entry["step"] - 1 + entry["reached"] for entry in self.increments])

    def table(self, name):
        """Columns of a .csv by name, as arrays; None where the file does not exist. An empty field is not a number."""
        return self._tables(name)

    @functools.lru_cache(maxsize=None)
    def _tables(self, name):
        path = self.directory / name
        try:
            with open(path, newline="", encoding="utf-8") as file:
                rows = list(csv.reader(file))
        except FileNotFoundError:
            return None
        except (OSError, UnicodeDecodeError, csv.Error) as error:
            raise ResultsError(f"{path}: cannot be read: {error}") from None
        if not rows:
            raise ResultsError(f"{path}: is empty; run the model again")
        header, rows = rows[0], rows[1:]
        for line, row in enumerate(rows, start=2):
            if len(row) != len(header):
                raise ResultsError(f"{path}:{line}: has {len(row)} fields instead of {len(header)}; run the model again")
        columns = list(zip(*rows)) or [()] * len(header)
        try:
            text = () if name == "history.csv" else TEXT  # whose columns the user names
            return {key: np.array(column, dtype=str) if key in text else _numbers(column) for key, column in zip(header, columns)}
        except ValueError as error:
            raise ResultsError(f"{path}: is damaged ({error}); run the model again") from None

    def contacts(self, number):
        """Rows of contact.csv of one increment: for each contact, in the order of the file, its columns."""
        table = self.table("contact.csv")
        if table is None or len(table["contact"]) == 0:
            return {}
        entry = self.increments[number - 1]
        chosen = self._rows_of_increments.get((entry["step"], entry["increment"]), np.zeros(0, dtype=int))
        names = table["contact"][chosen]
        borders = np.flatnonzero(names[1:] != names[:-1]) + 1  # the pairs of a contact stand together
        return {table["contact"][rows[0]]: {key: column[rows] for key, column in table.items()}
                for rows in np.split(chosen, borders) if len(rows)}

    @functools.cached_property
    def _rows_of_increments(self):
        """Numbers of the rows of contact.csv, by step and increment: found once, however many increments are asked for."""
        table = self.table("contact.csv")
        keys = np.column_stack([table["step"], table["increment"]])
        order = np.lexsort(keys.T[::-1])  # rows of one increment stay in their order
        borders = np.flatnonzero((keys[order][1:] != keys[order][:-1]).any(axis=1)) + 1
        return {tuple(map(int, keys[rows[0]])): rows for rows in np.split(order, borders) if len(rows)}

    def field_numbers(self):
        """Numbers of the increments, or modes, that have a file of fields."""
        path = self.directory / "fields.pvd"
        try:
            names = [name for _, name in vtu.read_collection(path)]
        except FileNotFoundError:
            return []
        except OSError as error:
            raise ResultsError(f"{path}: cannot be read: {error.strerror}") from None
        except vtu.FormatError as error:
            raise ResultsError(f"{path}: is damaged ({error}); run the model again") from None
        return [int(match[1]) for match in (re.fullmatch(r"fields_(\d+)\.p?vtu", name) for name in names) if match]

    def fields(self, number):
        """The grid of fields_000N.vtu, or of the parts of fields_000N.pvtu."""
        numbers = self.field_numbers()
        if number not in numbers:
            have = f"there are those of {_listed(numbers)}" if numbers else "`output` in the model file asks for none"
            raise NothingToDraw(f"{self.directory}: has no fields of increment {number}; {have}")
        return self._fields(number)

    def last_fields(self):
        """The grid of the last file of fields, for outlines of bodies; None where there is none."""
        numbers = self.field_numbers()
        return self._fields(numbers[-1]) if numbers else None

    def _fields(self, number):
        parts = f"fields_{number:04d}.pvtu"  # of a run on several processes
        return self._grid(parts if (self.directory / parts).exists() else f"fields_{number:04d}.vtu")

    def faces(self, number):
        """The grid of contact_000N.vtu of a model in space: contact faces as triangles, whose points are the pairs."""
        self.number(number)
        return self._grid(f"contact_{number:04d}.vtu")

    def cells(self):
        """The grid of cells.vtu; None where no body has several cells."""
        return self._grid("cells.vtu") if (self.directory / "cells.vtu").exists() else None

    def mechanism(self):
        """The grid of mechanism.vtu; None where no motion ended the run."""
        return self._grid("mechanism.vtu") if (self.directory / "mechanism.vtu").exists() else None

    @functools.lru_cache(maxsize=4)
    def _grid(self, name):
        path = self.directory / name
        try:
            grid = vtu.read_parts(path) if path.suffix == ".pvtu" else vtu.read_grid(path, 3 if self.in_space else 2)
        except OSError as error:
            raise ResultsError(f"{path}: cannot be read: {error.strerror}") from None
        except vtu.FormatError as error:
            raise ResultsError(f"{path}: is damaged ({error}); run the model again") from None
        return revolution.mirrored(grid) if self.mirrored else grid


def without_rounding(rows, key, direction):
    """Gap or slip, zero where it is nothing but rounding, as in the tables of log.txt: below 1e-12 of the largest displacement in its
    direction, or below the rounding of coordinates."""
    moved = max(np.abs(rows[f"{direction}_displacement_{side}"]).max() for side in "ab")
    rounding = max(1e-12 * moved, 4e-16 * np.abs([rows["x"], rows["y"]]).max())
    return np.where(np.abs(rows[key]) <= rounding, 0.0, rows[key])


def _numbers(column):
    return np.array([value if value else "nan" for value in column], dtype=float)


def _listed(numbers):
    if len(numbers) > 12:
        return ", ".join(map(str, numbers[:8])) + f", ... {numbers[-1]}"
    return ", ".join(map(str, numbers))
