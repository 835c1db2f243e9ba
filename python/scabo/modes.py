"""Results of a modal analysis."""
from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _core
from .kept import KeptModes

__all__ = ["ModalResult", "Mode"]


@dataclass(frozen=True)
class Mode:
    """A natural mode."""

    frequency: float
    """1 / time (SI: Hz); exactly 0 for rigid motions."""
    rigid: bool
    modal_mass: float
    """Mass: shape' M shape."""
    effective_mass: tuple[float, float]
    """Mass that takes part in a motion of the supports along x and y."""
    residual: float
    """Of K shape = omega^2 M shape, free of units."""
    shape: dict[str, np.ndarray]
    """By body: (nodes, 2), without a copy; the largest displacement of a node is 1."""


class ModalResult:
    """Natural frequencies and mode shapes, in ascending frequency."""

    def __init__(self, core: _core.ModalResult | KeptModes) -> None:
        self._core = core
        self._modes = [Mode(**mode) for mode in core.modes()]

    @property
    def modes(self) -> list[Mode]:
        """All modes, in ascending frequency."""
        return list(self._modes)

    @property
    def frequencies(self) -> np.ndarray:
        """Frequencies of all modes, 1 / time."""
        return np.array([mode.frequency for mode in self._modes])

    @property
    def total_mass(self) -> float:
        """Mass of all elastic bodies."""
        return self._core.total_mass

    @property
    def bodies(self) -> list[str]:
        """Names of the bodies."""
        return list(self._core.bodies)

    def nodes(self, body: str) -> np.ndarray:
        """Undeformed positions of the nodes of a body, (nodes, 2), without a copy."""
        return self._core.nodes(self._core.bodies.index(body))

    @property
    def summary(self) -> dict[str, Any]:
        """The content of summary.json (docs/results.md)."""
        return json.loads(self._core.record.summary)

    @property
    def directory(self) -> str | None:
        """Where the results are written; None if they are not."""
        return self._core.record.directory

    def __repr__(self) -> str:
        return f"<scabo.ModalResult: {len(self._modes)} modes>"

    def __reduce__(self) -> tuple[Any, ...]:
        return ModalResult, (KeptModes.of(self._core),)

    def _repr_html_(self) -> str:
        """For notebooks: the frequencies."""
        rows = "".join(f"<tr><td>{number}</td><td>{'0 (rigid)' if mode.rigid else f'{mode.frequency:.6g}'}</td></tr>"
                       for number, mode in enumerate(self._modes, start=1))
        return f"<b>{len(self._modes)} modes</b><table><tr><th>mode</th><th>frequency</th></tr>{rows}</table>"
