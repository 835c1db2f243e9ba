"""Exceptions of Scabo. Their texts are those of the program."""
from __future__ import annotations

from typing import Any, NamedTuple

__all__ = ["Collapse", "Error", "Infeasible", "InternalError", "Interrupted", "Mechanism", "ModelError", "ModelWarning",
           "NotConverged", "Problem", "WriteError"]


class Error(Exception):
    """Any error of Scabo."""


class Problem(NamedTuple):
    """A mistake in a model."""

    path: str
    """Keys from the root, as in ``bodies.upper.material``; empty for the file as a whole."""
    line: int | None
    """Line of the model file, from 1; None for what was changed or built in Python."""
    column: int | None
    text: str
    """What is wrong, and how to correct it."""


class ModelError(Error, ValueError):
    """A model, or a file that it names, is wrong. Every mistake is in ``problems``."""

    def __init__(self, text: str, file: str = "", problems: list[Problem] | None = None) -> None:
        super().__init__(text)
        self.file = file
        self.problems: list[Problem] = list(problems or [])

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (str(self), self.file, self.problems)


class NotConverged(Error, RuntimeError):
    """No solution was found. ``result`` holds the increments finished before (of ``solve_contact``: the best iterate);
    it is None in another process than that of the run."""

    def __init__(self, text: str, result: Any = None) -> None:
        super().__init__(text)
        self.result = result

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (str(self),)


class Mechanism(NotConverged):
    """A body is insufficiently supported: the loads exceed what supports, contact and friction can carry. This is
    proven, and not a failure of the solver."""


class Collapse(NotConverged):
    """The equilibria that the loads pass through end before the increment does: bodies then move on without any further
    load. Unlike a mechanism it is not proven that no other equilibrium exists."""


class Infeasible(NotConverged):
    """A discrete contact problem is proved to have no solution."""


class Interrupted(Error):
    """The callback of a run returned False. ``result`` holds the finished increments; None if there is none."""

    def __init__(self, text: str, result: Any = None) -> None:
        super().__init__(text)
        self.result = result

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (str(self),)


class WriteError(Error, OSError):
    """A file or directory of the results cannot be written."""


class InternalError(Error, RuntimeError):
    """A bug of Scabo, which should be reported."""


class ModelWarning(UserWarning):
    """Input that was analysed as written but is probably not what was intended, or a result that needs care."""
