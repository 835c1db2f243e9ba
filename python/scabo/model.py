"""Models: dictionaries with the content of a model file, which can be checked and run."""
from __future__ import annotations

import copy
import json
import os
import sys
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from . import _core
from .arguments import threads_of
from .errors import Collapse, Interrupted, Mechanism, ModelWarning, NotConverged
from .modes import ModalResult
from .progress import watching
from .result import Result

__all__ = ["Model", "Sizes", "read", "schema"]

Callback = Callable[["_core.Progress"], Any]


@dataclass(frozen=True)
class Sizes:
    """What ``Model.check`` finds out without solving. Memory and time are estimates, usually right within a factor of
    two; of a model that is refined, they are those of the first mesh."""

    bodies: int
    nodes: int
    dofs: int
    super_elements: int
    finite_elements: int
    contact_pairs: int
    """Pairs that can move; those that supports hold on both sides do not count. In space: all pairs."""
    contacts: dict[str, int]
    """Such pairs of every contact."""
    increments: int
    memory_bytes: float
    seconds: float


class Model(dict[str, Any]):
    """A model: a dictionary with the keys of a model file (docs/model_file.md), nested dictionaries and lists.

    >>> model = scabo.Model({"scabo": 1, "materials": {...}, "bodies": {...}})
    >>> model["contacts"]["joint"]["friction"] = 0.5
    >>> result = model.run()

    Values may be numbers and arrays of NumPy. What is given is copied, so that several models made from one dictionary
    are independent. Every check is made by ``check`` and ``run``, with the messages of the program: by key path, and
    for unchanged parts of a model that was read from a file also with line and column.
    """

    def __init__(self, data: Mapping[str, Any] | str | os.PathLike[str] | None = None, *,
                 file: str | os.PathLike[str] = "model") -> None:
        """``data``: the content, or a model file, which is read as ``read`` does. ``file`` stands in messages, and mesh files
        and images that the model names are relative to its folder."""
        self._document: _core.Document | None = None
        if isinstance(data, (str, os.PathLike)):
            self._document = _core.read(os.fsdecode(data), [])
            data, file = self._document.data(), self._document.file
        super().__init__(copy.deepcopy(dict(data or {})))
        self._file = os.fsdecode(file)

    @property
    def file(self) -> str:
        """The model file, or what stands in messages for it."""
        return self._file

    def copy(self) -> Model:
        """A model that can be changed without an effect on this one."""
        twin = Model(self, file=self._file)
        twin._document = self._document
        return twin

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Model:
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        return _remade, (dict(self), self._file)

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes a model file that ``read`` and ``scabo run`` take: JSON, which is YAML too. Paths of mesh files and images
        are written as they are."""
        text = json.dumps(self, indent=2, default=_plain, ensure_ascii=False) + "\n"
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(text)

    def _checked(self) -> _core.CheckedModel:
        return _core.checked_model(self, self._file, self._document)

    def check(self) -> Sizes:
        """Checks and meshes the model without solving it. Raises ``ModelError`` with every mistake."""
        checked = self._checked()
        sizes = checked.sizes()
        _warn(checked.warnings)
        return Sizes(**sizes)

    def run(self, output: str | os.PathLike[str] | None = None, *, progress: Callback | bool | None = None,
            threads: int | None = None, keep_fields: bool = True, ignore_memory: bool = False) -> Result:
        """Solves the model, in the plane or in space; natural modes are found by ``modes``.

        output
            Directory for the files that ``scabo run`` writes (docs/results.md); None: nothing is written.
        progress
            Called with a ``Progress`` at every stage, after every increment, and a few times a second within both. If it
            returns False, the run ends and raises ``Interrupted``; if it raises, the run ends in the same way and the
            exception is passed on, with the finished increments as its attribute ``result``. Ctrl-C does the same.
            Stages are broken off too, but for single calls of a library, as a sparse factorisation.
            True: a bar with stage, residual and time left, in a notebook or a terminal, if tqdm is installed.
        threads
            Upper limit; small models use one. None: all processors.
        keep_fields
            False: displacements and contact tables are kept of the last increment only, so that memory hardly grows
            with the number of increments.
        ignore_memory
            True: starts even if the estimated memory is not available.

        Other Python threads go on while it solves. Raises ``ModelError``; ``NotConverged`` or ``Mechanism``, with the finished increments in ``result``;
        ``WriteError``; ``MemoryError``. Warnings are issued as ``ModelWarning``.
        """
        checked = self._checked()
        if checked.is_modal:
            raise ValueError("analysis.type: a modal analysis has modes and no increments: use modes()")
        with watching(progress) as callback:
            how = (checked, _target(output), threads_of(threads), keep_fields, ignore_memory, callback)
            solved: _core.StaticResult | _core.SpaceResult
            solved = _core.solve_space(*how) if checked.is_in_space else _core.solve_static(*how)
        result = Result(solved)
        _warn(solved.record.warnings)
        if solved.record.error is not None:
            solved.record.error.result = result  # type: ignore[attr-defined]
            raise solved.record.error
        if not solved.record.why_not_solved:
            return result
        kinds = {"interrupted": Interrupted, "mechanism": Mechanism, "collapse": Collapse}
        raise kinds.get(solved.status, NotConverged)(solved.record.why_not_solved, result)

    def modes(self, output: str | os.PathLike[str] | None = None, *, progress: Callback | bool | None = None,
              threads: int | None = None) -> ModalResult:
        """Natural frequencies and modes of a model with ``analysis: {type: modal}``. Arguments and exceptions are those of
        ``run``."""
        checked = self._checked()
        if not checked.is_modal:
            raise ValueError("analysis.type: modes are found where it is modal: use run()")
        with watching(progress) as callback:
            modes = _core.solve_modal(checked, _target(output), threads_of(threads), callback)
        if modes.record.error is not None:
            raise modes.record.error
        _warn(modes.record.warnings)
        return ModalResult(modes)


def _target(output: str | os.PathLike[str] | None) -> str | None:
    target = None if output is None else os.fsdecode(output)
    if target == "":
        raise ValueError("output: the name of the directory is empty: name one, or leave it out")
    return target


def _remade(data: dict[str, Any], file: str) -> Model:
    return Model(data, file=file)


def _outside() -> int:
    """Level of the caller outside of this package, for warnings."""
    frame, level = sys._getframe(1), 1
    while frame is not None and frame.f_globals.get("__name__", "").partition(".")[0] == __package__:
        frame, level = frame.f_back, level + 1  # type: ignore[assignment]
    return level


def _warn(texts: list[str]) -> None:
    for text in texts:
        warnings.warn(text, ModelWarning, stacklevel=_outside())


def _plain(value: Any) -> Any:
    """For JSON."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"must be a number, text, true or false, a list or a dictionary, not {type(value).__name__}")


def _setting(path: str, value: Any) -> str:
    if isinstance(value, str):
        return f"{path}={value}"
    try:
        return f"{path}={json.dumps(value, default=_plain)}"
    except TypeError as error:
        raise TypeError(f"set: {path}: {error}") from None


def read(file: str | os.PathLike[str], *, set: Mapping[str, Any] | None = None) -> Model:
    """Reads a model file (YAML or JSON) and checks it.

    ``set`` replaces values, as ``--set`` of the program does: ``{"contacts.joint.friction": 0.5}``; text is read as YAML.
    Raises ``ModelError`` with every mistake, its line, its column and its remedy.
    """
    if set is not None and not isinstance(set, Mapping):
        raise TypeError(f"set must be a dictionary, as in {{'contacts.joint.friction': 0.5}}, not {type(set).__name__}")
    settings = [_setting(path, value) for path, value in (set or {}).items()]
    document = _core.read(os.fsdecode(file), settings)
    model = Model(document.data(), file=document.file)
    model._document = document
    return model


def schema() -> dict[str, Any]:
    """JSON Schema of the model file, as ``scabo schema`` prints it."""
    return json.loads(_core.schema())
