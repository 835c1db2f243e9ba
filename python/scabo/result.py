"""Results of a static analysis."""
from __future__ import annotations

import csv
import html
import io
import json
import math
import operator
import os
import pathlib
import sys
import tempfile
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _core
from .arguments import real_array
from .fields import Fields
from .kept import KeptResult, KeptSpaceResult
from .motion import Motion

if TYPE_CHECKING:
    import meshio
    import pandas
    import pyvista
    from numpy.typing import ArrayLike

__all__ = ["Contact", "Increment", "Result"]

_STATES = np.array(["open", "stick", "slip"])
_PICTURES = ("stress", "contact", "mesh", "convergence", "mechanism", "envelope", "spectrum", "history", "lines", "cracks")
_PICTURES_IN_SPACE = ("stress", "contact", "lines", "mechanism")
_VALUES = ("normal_force", "tangential_force", "open", "stick", "slip", "max_gap", "max_pressure")


def _columns_of(table: str) -> dict[str, np.ndarray]:
    header, *rows = csv.reader(io.StringIO(table))
    columns = zip(*rows) if rows else [()] * len(header)
    return {name: np.array([value or "nan" for value in column], dtype=float) for name, column in zip(header, columns)}


def _flat(table: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Vectors as three columns, named as in contact.csv."""
    columns: dict[str, np.ndarray] = {}
    for name, array in table.items():
        if array.ndim == 1:
            columns[name] = array
        else:
            for k, axis in enumerate("xyz"):
                columns[axis if name == "position" else f"{name}_{axis}"] = array[:, k]
    return columns


def _text_of(value: Any) -> str:
    return "[" + ", ".join(f"{x:.6g}" for x in value) + "]" if isinstance(value, list) else f"{value:.6g}"


class Increment:
    """Totals of an increment: the entry of ``increments`` in summary.json, with the same names (docs/results.md)."""

    def __init__(self, content: dict[str, Any]) -> None:
        self._content = content

    step: int
    """Number of the step, from 1."""
    increment: int
    """Number within the step, from 1."""
    reached: float
    """Part of the step at its end."""
    factors: dict[str, float]
    """Of loads and of supports with prescribed displacements."""
    converged: bool
    newton_iterations: int
    residual: float
    contacts: dict[str, dict[str, Any]]
    """Totals of every contact."""
    reactions: dict[str, list[float]]
    """Force of every support on its body, [x, y], in space [x, y, z]."""
    bars: dict[str, dict[str, float]]
    """Of a model with bars: the tension of every bar."""
    cracks: dict[str, dict[str, Any]]
    """Stress intensity factors."""
    certificate: dict[str, float]
    """What was checked after the solve, free of units (docs/methods/08_certificate.md)."""
    energy: dict[str, float]
    error: dict[str, Any] | None
    """Estimated discretisation error, if the model asks for it."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self._content[name]
        except KeyError:
            raise AttributeError(f"an increment has no '{name}': there are {', '.join(self._content)}") from None

    def __getitem__(self, name: str) -> Any:
        return self._content[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._content]

    def as_dict(self) -> dict[str, Any]:
        """All of it."""
        return dict(self._content)

    def __repr__(self) -> str:
        return f"<scabo.Increment: step {self.step}, increment {self.increment}>"


class Contact:
    """Results of one contact. Forces act on B; n is the normal out of A. In the plane t is n turned by -90 degrees; in space
    forces, shear and slip are vectors along the global axes, and ties are here too."""

    def __init__(self, result: Result, name: str, index: int) -> None:
        self._result = result
        self._index = index
        self.name = name

    def table(self, increment: int = -1) -> dict[str, np.ndarray]:
        """The columns of contact.csv (docs/results.md) after an increment, arrays over the pairs: pair, x, y, normal_x,
        normal_y, gap, slip, normal_force, tangential_force, pressure, shear, state ("open", "stick" or "slip"),
        displacements of both sides along n and t; of bodies of revolution also forces_of_radians.

        In space: pair, position and normal (n, 3), area, gap, slip (n, 3), force (n, 3), normal_force, pressure, shear (n, 3),
        state.

        In the plane all but ``state`` show the memory of the solver and cannot be written: use ``.copy()`` to change one.
        """
        columns = self._result._core.pairs(self._result._with_fields(increment), self._index)
        columns["state"] = _STATES[columns["state"]]
        of = self._result.summary["model"].get("forces_of")
        if of is not None:
            columns["forces_of_radians"] = np.full(len(columns["pair"]), 2 * math.pi if of == "the whole circumference" else 1.0)
        return columns

    def frame(self, increment: int = -1) -> pandas.DataFrame:
        """The same as a DataFrame of pandas, which must be installed. In space a vector is three columns: x, y and z of the
        position, and normal_x, slip_z and so on."""
        try:
            import pandas
        except ImportError:
            raise ImportError("frame() needs pandas (python3-pandas): install it, or use table()") from None
        return pandas.DataFrame(_flat(self.table(increment)))

    def history(self) -> dict[str, np.ndarray]:
        """Totals over the increments: normal_force and tangential_force (sums over the pairs; in space vectors, (n, 3)), numbers
        of open, stick and slip pairs, max_gap and max_pressure."""
        totals = [increment.contacts[self.name] for increment in self._result.increments]
        return {name: np.array([total[name] for total in totals]) for name in _VALUES}

    @property
    def normal_force(self) -> Any:
        """Sum over the pairs after the last increment, a number; in space the vector on B, an array of three."""
        return self._result._of_axes(self._result._last().contacts[self.name]["normal_force"])

    @property
    def tangential_force(self) -> Any:
        """The same of the tangential forces."""
        return self._result._of_axes(self._result._last().contacts[self.name]["tangential_force"])

    def __repr__(self) -> str:
        return f"<scabo.Contact {self.name!r}>"


class _Contacts(Mapping[str, Contact]):
    """The contacts of a result by their names."""

    def __init__(self, result: Result) -> None:
        names = result._core.contacts
        self._contacts = {name: Contact(result, name, index) for index, name in enumerate(names)}

    def __getitem__(self, name: str) -> Contact:
        if name not in self._contacts:
            known = ", ".join(self._contacts) or "none"
            raise KeyError(f"there is no contact named {name!r}; there are: {known}")
        return self._contacts[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._contacts)

    def __len__(self) -> int:
        return len(self._contacts)

    def __repr__(self) -> str:
        return f"<contacts: {', '.join(self._contacts)}>"


class Result:
    """Results of a static analysis. Increments are numbered from 0, and from -1 backwards, as lists are; only converged
    ones count. Positions, displacements, forces and stresses are in the units of the model; stress is positive in
    tension. Of a model in space vectors have three components, and stresses six."""

    def __init__(self, core: _core.StaticResult | _core.SpaceResult | KeptResult | KeptSpaceResult) -> None:
        self._core = core
        self._plane = core if isinstance(core, (_core.StaticResult, KeptResult)) else None
        self._directory = core.record.directory
        self._summary: dict[str, Any] = json.loads(core.record.summary)
        self._increments = [Increment(content) for content in self._summary["increments"] if content["converged"]]
        self.contact: Mapping[str, Contact] = _Contacts(self)
        """The contacts by their names."""

    @property
    def dimension(self) -> int:
        """2 of a model in the plane, 3 of one in space."""
        return 2 if self._plane is not None else 3

    @property
    def status(self) -> str:
        """solved, not_converged, mechanism, collapse or interrupted."""
        return self._core.status

    @property
    def summary(self) -> dict[str, Any]:
        """The content of summary.json (docs/results.md): totals, reactions, certificate, energies, timing."""
        return self._summary

    @property
    def increments(self) -> list[Increment]:
        """Totals of all converged increments."""
        return list(self._increments)

    @property
    def history(self) -> dict[str, np.ndarray]:
        """Columns of history.csv over the increments: step, increment, time, and what ``output.history`` of the model asks
        for, not a number where it has no value. Empty without it. Without a directory it needs the fields of all
        increments (``keep_fields``)."""
        if self._directory is not None:
            path = pathlib.Path(self._directory, "history.csv")
            return _columns_of(path.read_text(encoding="utf-8")) if path.is_file() else {}
        self._with_all_fields()
        table = self._core.history()
        return _columns_of(table) if table else {}

    @property
    def warnings(self) -> list[str]:
        """All warnings of the run."""
        return list(self._core.record.warnings)

    @property
    def directory(self) -> str | None:
        """Where the results are written; None if they are not."""
        return self._directory

    @property
    def mechanism(self) -> Motion | None:
        """How the bodies begin to move, of a run that ended as a mechanism or collapse, or beyond a limit; None otherwise."""
        table = self._core.mechanism()
        return None if table is None else Motion(table, self.bodies, list(self._core.contacts))

    @property
    def limit(self) -> tuple[float, float] | None:
        """Of a last step with limit or reduce: the factor of the last equilibrium, and the nearest one at which none was found,
        inf if it was found at all that were tried. None without such a step."""
        limit = self._summary.get("limit")
        return None if limit is None else (limit["solved"], math.inf if limit["beyond"] is None else limit["beyond"])

    @property
    def cracks(self) -> dict[str, dict[str, np.ndarray]]:
        """Of a step in which cracks grow: for each tip by name, as in "plate.flaw.end", columns over the states of growth:
        increment (an index into ``increments``), x, y, length, K_I, K_II, T, G, kink (radians), load_factor, critical_at,
        grows, range, cycles, opening, displacement, reaction, released, integral and remeshing (docs/results.md). Empty without
        growth."""
        columns: dict[str, dict[str, list[Any]]] = {}
        for number, increment in enumerate(self._increments):
            growth = increment.as_dict().get("growth", {})
            for name, tip in growth.get("tips", {}).items():
                factors = increment.cracks[name]
                row = {"increment": number, "x": tip["position"][0], "y": tip["position"][1], "length": tip["length"],
                       **{key: np.nan if factors.get(key) is None else factors[key] for key in ("K_I", "K_II", "T", "G")},
                       "kink": tip["kink"], "load_factor": growth["load_factor"], "critical_at": tip["critical_at"],
                       "grows": tip["grows"], "range": tip.get("range"), "cycles": growth.get("cycles"), "opening": tip["opening"],
                       "displacement": growth.get("displacement"), "reaction": growth.get("reaction"),
                       **{key: growth.get("energy", {}).get(key) for key in ("released", "integral", "remeshing")}}
                of_tip = columns.setdefault(name, {key: [] for key in row})
                for key, value in row.items():
                    of_tip[key].append(np.nan if value is None else value)
        return {name: {key: np.array(values) for key, values in of_tip.items()} for name, of_tip in columns.items()}

    @property
    def bodies(self) -> list[str]:
        """Names of the bodies."""
        return list(self._core.bodies)

    def nodes(self, body: str) -> np.ndarray:
        """Undeformed positions of the nodes of a body, (nodes, 2) or in space (nodes, 3), without a copy; in the plane empty for a
        rigid body."""
        return self._core.nodes(self._body(body))

    def nodal_displacement(self, body: str, increment: int = -1) -> np.ndarray:
        """Displacements of these nodes, (nodes, 2) or in space (nodes, 3), without a copy; of a rigid body in the plane
        [u_x, u_y, rotation] about its centroid. With a ``reference`` point that moves (unbounded bodies) they are relative to it, in new memory."""
        return self._core.displacement(self._with_fields(increment), self._body(body))

    def values(self, points: ArrayLike, *, body: str | None = None, increment: int = -1,
               outside: Literal["error", "nan"] = "error") -> dict[str, np.ndarray]:
        """Results at points of the undeformed shape, (n, 2), from the semi-analytical solution itself: arrays over the
        points.

        ``body`` (index into ``bodies``), ``displacement`` (n, 2), ``stress`` (n, 4): xx, yy, xy, zz, ``strain`` (n, 3):
        xx, yy, gamma_xy, ``principal`` (n, 3), descending, ``principal_angle``, ``von_mises``, ``energy_density``.

        In space points are (n, 3), and the arrays are ``body``, ``displacement`` (n, 3), ``stress`` (n, 6): xx, yy, zz, xy, yz,
        xz, ``principal`` (n, 3) and ``von_mises``: interpolated in the tetrahedron, stress between the means at its nodes.

        A point on the edge or face where bodies touch needs ``body``. A point outside is an error, or with outside="nan" not a
        number. Stress in a rigid body, and where it is infinite, is not a number.
        """
        if outside not in ("error", "nan"):
            raise ValueError(f"outside must be 'error' or 'nan', not {outside!r}")
        only = -1 if body is None else self._body(body)
        at = real_array("points", points)
        if at.ndim != 2 or at.shape[1] != self.dimension:
            raise ValueError(f"points must have the shape (n, {self.dimension}), as in [[{', '.join('xyz'[:self.dimension])}], ...], "
                             f"not {at.shape}")
        return self._core.values(self._with_fields(increment), at, only, outside == "nan")

    def displacement(self, points: ArrayLike, *, body: str | None = None, increment: int = -1,
                     outside: Literal["error", "nan"] = "error") -> np.ndarray:
        """Displacement at points, (n, 2) or (n, 3); see ``values``."""
        return self.values(points, body=body, increment=increment, outside=outside)["displacement"]

    def stress(self, points: ArrayLike, *, body: str | None = None, increment: int = -1,
               outside: Literal["error", "nan"] = "error") -> np.ndarray:
        """Stress at points, (n, 4): xx, yy, xy, zz, or in space (n, 6): xx, yy, zz, xy, yz, xz; see ``values``."""
        return self.values(points, body=body, increment=increment, outside=outside)["stress"]

    def fields(self, increment: int = -1) -> Fields:
        """Points, cells and values of all bodies, as in fields.vtu."""
        return Fields.of(self._core.fields(self._with_fields(increment)))

    def to_meshio(self, increment: int = -1) -> meshio.Mesh:
        """The same as a ``meshio.Mesh``, which meshio writes in some thirty formats."""
        return self.fields(increment).to_meshio()

    def to_pyvista(self, increment: int = -1) -> pyvista.UnstructuredGrid:
        """The same as a ``pyvista.UnstructuredGrid``."""
        return self.fields(increment).to_pyvista()

    def save(self, directory: str | os.PathLike[str]) -> None:
        """Writes the files that ``scabo run`` writes. Needs the fields of all increments (``keep_fields``)."""
        self._directory = self._write(os.fsdecode(directory))

    def _write(self, directory: str) -> str:
        if isinstance(self._core, (KeptResult, KeptSpaceResult)):
            raise LookupError("results that were pickled cannot be written, nor drawn without a directory: save() them before")
        if self._plane is not None and self._plane.writes_problems:
            raise ValueError("the model asks for the discrete problems (output.discrete_problems), which are written "
                             "only during a run: use run(output=...)")
        self._with_all_fields()
        if isinstance(self._core, _core.SpaceResult):
            _core.write_space_results(self._core, directory)
        else:
            _core.write_results(self._core, directory)
        return directory

    def plot(self, what: str = "stress", increment: int = -1, **options: Any) -> Any:
        """A figure of Matplotlib by ``scabo.plot``, whose functions describe the options: what="stress" on the deformed
        shape, "contact" (pressure, shear, gap, slip), "mesh", "convergence", "mechanism", "envelope", "spectrum"
        (``columns="NAME"``, a velocity of the history), "history", "lines" (those of ``output.lines``) or "cracks". ``mirrored=True`` draws both halves of bodies of
        revolution. Results that are not in a directory are first written to a temporary one."""
        of_space = self.dimension == 3
        pictures = _PICTURES_IN_SPACE if of_space else _PICTURES
        if what not in pictures:
            raise ValueError(f"what must be {', '.join(pictures[:-1])} or {pictures[-1]}, not {what!r}")
        try:
            from . import plot
            picture = getattr(plot, f"solid_{what}" if of_space and what != "lines" else what)
        except ImportError as error:
            raise ImportError(f"plot() needs scabo.plot and Matplotlib (python3-matplotlib): {error}") from None
        if what in ("stress", "contact", "lines"):
            options["increment"] = self._number(increment) + 1  # files and pictures count from 1
        elif what != "mechanism":
            self._number(increment)

        of_both_halves = {"mirrored": True} if options.pop("mirrored", False) else {}

        def draw(directory: str) -> Any:
            figure = picture(plot.Results(directory, **of_both_halves), **options)
            pyplot = sys.modules.get("matplotlib.pyplot")
            if pyplot is not None and "inline" in pyplot.get_backend():  # a notebook shows what a cell returns, and open figures
                pyplot.close(figure)
            return figure

        if self.directory is not None and pathlib.Path(self.directory, "summary.json").is_file():
            return draw(self.directory)
        with tempfile.TemporaryDirectory(prefix="scabo_") as folder:
            return draw(self._write(os.path.join(folder, "results")))

    def report(self, output: str | os.PathLike[str] | None = None, *, units: str | None = None,
               megabytes: float = 25.0, mirrored: bool = False, fields: str | None = None) -> pathlib.Path:
        """Writes one page for the browser, as ``scabo report`` does, and returns its path: by default
        ``model.report.html`` beside the results directory, which a run with ``output`` has. ``units``: length and force
        of the model, as in "m,N". Beyond ``megabytes``, fields of increments are left out, evenly. ``mirrored``: both
        halves of bodies of revolution. ``fields``: those that the page has, as in "displacement,von_mises"; None: all."""
        from . import report
        if self.directory is not None and pathlib.Path(self.directory, "summary.json").is_file():
            return report.write(self.directory, output, units, megabytes, mirrored, fields)
        if output is None:
            raise ValueError("these results are in no directory: name the page, as in report(\"model.html\")")
        with tempfile.TemporaryDirectory(prefix="scabo_") as folder:
            directory = self._write(os.path.join(folder, pathlib.Path(output).stem))
            return report.write(directory, output, units, megabytes, mirrored, fields)

    def _body(self, name: str) -> int:
        bodies = self._core.bodies
        if name not in bodies:
            raise KeyError(f"there is no body named {name!r}; there are: {', '.join(bodies)}")
        return bodies.index(name)

    def _number(self, increment: int) -> int:
        """Its index from 0."""
        count = len(self._increments)
        try:
            increment = operator.index(increment)
        except TypeError:
            raise TypeError(f"increment must be a whole number, not {increment!r}") from None
        if not -count <= increment < count:
            raise IndexError(f"there is no increment {increment}: "
                             + (f"they are 0 to {count - 1}" if count else "none was finished"))
        return increment % count

    def _with_fields(self, increment: int) -> int:
        number = self._number(increment)
        if not self._core.keeps_fields(number):
            raise LookupError(f"the fields of increment {number} were not kept: run with keep_fields=True, or read the "
                              "files of a run with output=... (with slip: large only those since the last time that "
                              "pairs were found anew are kept)")
        return number

    def _with_all_fields(self) -> None:
        for increment in range(len(self._increments)):
            self._with_fields(increment)

    def _last(self) -> Increment:
        return self._increments[self._number(-1)]

    def _of_axes(self, value: Any) -> Any:
        return value if self._plane is not None else np.array(value)

    def __reduce__(self) -> tuple[Any, ...]:
        """Tables, nodal displacements, fields and histories are kept, and values at points are not."""
        if isinstance(self._core, (_core.SpaceResult, KeptSpaceResult)):
            kept: KeptResult | KeptSpaceResult = KeptSpaceResult.of(self._core)
        else:
            kept = KeptResult.of(self._core)
        kept.record.directory = self._directory
        return Result, (kept,)

    def __repr__(self) -> str:
        return f"<scabo.Result: {self.status}, {len(self._increments)} increments>"

    def _repr_html_(self) -> str:
        """For notebooks: status, and the totals of the contacts after the last increment."""
        text = f"<b>{html.escape(self.status)}</b>, {len(self._increments)} increments"
        if not self._increments or not self.contact:
            return text
        head = "".join(f"<th>{name.replace('_', ' ')}</th>" for name in ("contact", *_VALUES))
        rows = "".join(f"<tr><td>{html.escape(name)}</td>"
                       + "".join(f"<td>{_text_of(total[value])}</td>" for value in _VALUES) + "</tr>"
                       for name, total in self._last().contacts.items())
        return f"{text}<table><tr>{head}</tr>{rows}</table>"
