"""How bodies begin to move where an analysis ends as a mechanism or collapse."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from .arguments import real_array

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["Motion"]


class Motion:
    """A motion without deformation, from where the bodies are at the start. Its size means nothing: the largest
    displacement of all is 1 in the unit of length of the model. The arrays over the bodies are in the order of
    ``bodies``; in the plane they show the memory of the solver and cannot be written. In space vectors have three components."""

    def __init__(self, table: dict[str, Any], bodies: list[str], contacts: list[str]) -> None:
        self._table = table
        self._contacts = contacts
        self.bodies = bodies
        """Names of the bodies."""
        self.rule: Literal["coulomb", "associated"] = table["rule"]
        """What slip follows: coulomb: joints slide without opening, and friction opposes slip; associated: joints that
        slide open by u_n = mu |u_t| or more (docs/results.md)."""
        self.text: str = table["text"]
        """Which bodies move, in a sentence."""
        self.work: float = table["work"]
        """Of the loads over the motion, positive; force times length."""
        self.shift: np.ndarray = table["shift"]
        """Displacement of the points ``about``, (bodies, 2) or (bodies, 3)."""
        self.about: np.ndarray = table["about"]
        """A point of each body, (bodies, 2) or (bodies, 3)."""
        self.rotation: np.ndarray = table["rotation"]
        """Of each body, counter-clockwise, radians; in space (bodies, 3), about the axes."""
        self.centre: np.ndarray = table["centre"]
        """The point about which each body turns, (bodies, 2); in space, (bodies, 3), the one nearest to ``about`` of the axis. Not a number
        where it does not turn."""
        self.largest: np.ndarray = table["largest"]
        """Largest displacement of each body."""

    @property
    def moving(self) -> list[str]:
        """Names of the bodies that move by more than 1e-4 of the largest displacement, in the order of the model."""
        return [name for name, moves in zip(self.bodies, self._table["moves"]) if moves]

    def displacement(self, body: str, points: ArrayLike) -> np.ndarray:
        """Displacements at points of a body, (n, 2) or (n, 3), which count as moving with it wherever they are."""
        if body not in self.bodies:
            raise KeyError(f"there is no body named {body!r}; there are: {', '.join(self.bodies)}")
        at = real_array("points", points)
        dimension = self.shift.shape[1]
        if at.ndim != 2 or at.shape[1] != dimension:
            raise ValueError(f"points must have the shape (n, {dimension}), as in [[{', '.join('xyz'[:dimension])}], ...], not {at.shape}")
        number = self.bodies.index(body)
        arms = at - self.about[number]
        if dimension == 3:
            return np.asarray(self.shift[number] + np.cross(self.rotation[number], arms))
        return self.shift[number] + self.rotation[number] * np.column_stack([-arms[:, 1], arms[:, 0]])

    def contact(self, name: str) -> dict[str, np.ndarray]:
        """Motion of the pairs of a contact, arrays over the pairs that can move: ``pair`` (number from 1), ``x``, ``y``
        (on A), ``normal_x``, ``normal_y`` (out of A), ``opening`` (along n) and ``slip`` (along t) of B relative to A. In space over all
        pairs: ``pair``, ``position`` and ``normal`` (n, 3), ``opening`` and ``slip`` (n, 3)."""
        if name not in self._contacts:
            known = ", ".join(self._contacts) or "none"
            raise KeyError(f"there is no contact named {name!r}; there are: {known}")
        rows = self._table["contact"] == self._contacts.index(name)
        if self.shift.shape[1] == 3:
            return {key: self._table[key][rows] for key in ("pair", "position", "normal", "opening", "slip")}
        position, normal = self._table["position"][rows], self._table["normal"][rows]
        return {"pair": self._table["pair"][rows], "x": position[:, 0], "y": position[:, 1], "normal_x": normal[:, 0],
                "normal_y": normal[:, 1], "opening": self._table["opening"][rows], "slip": self._table["slip"][rows]}

    def __repr__(self) -> str:
        return f"<scabo.Motion: {self.text}>"
