"""What is left of results when they are pickled: their arrays, without the memory of the solver."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np

from . import _core

__all__ = ["KeptModes", "KeptRecord", "KeptResult", "KeptSpaceResult"]


@dataclass
class KeptRecord:
    """A ``_core.RunRecord``."""

    summary: str
    directory: str | None
    warnings: list[str]
    error: BaseException | None
    why_not_solved: str

    @classmethod
    def of(cls, record: _core.RunRecord | KeptRecord) -> KeptRecord:
        return cls(record.summary, record.directory, list(record.warnings), None, record.why_not_solved)


class KeptArrays:
    """What kept results of the plane and of space have in common: arrays by increment, then by contact or body."""

    of_pairs: list[list[dict[str, np.ndarray]]]
    of_nodes: list[np.ndarray]
    of_displacement: list[list[np.ndarray]]
    of_fields: list[dict[str, np.ndarray]]
    of_history: str

    def pairs(self, increment: int, contact: int) -> dict[str, np.ndarray]:
        return dict(self.of_pairs[increment][contact])

    def keeps_fields(self, increment: int) -> bool:
        return bool(self.of_fields[increment])

    def nodes(self, body: int) -> np.ndarray:
        return self.of_nodes[body]

    def displacement(self, increment: int, body: int) -> np.ndarray:
        return self.of_displacement[increment][body]

    def fields(self, increment: int) -> dict[str, np.ndarray]:
        return dict(self.of_fields[increment])

    def history(self) -> str:
        return self.of_history

    def values(self, increment: int, points: np.ndarray, only: int, allow_outside: bool) -> NoReturn:
        raise LookupError("results that were pickled have no values at points, which the solver computes: compute them before, or use "
                          "fields(), whose points they keep")


@dataclass
class KeptResult(KeptArrays):
    """A ``_core.StaticResult``: pairs, displacements and fields of all increments that have them."""

    record: KeptRecord
    status: str
    writes_problems: bool
    contacts: list[str]
    bodies: list[str]
    increments: int
    of_pairs: list[list[dict[str, np.ndarray]]]
    of_nodes: list[np.ndarray]
    of_displacement: list[list[np.ndarray]]
    of_fields: list[dict[str, np.ndarray]]
    of_history: str
    of_mechanism: dict[str, Any] | None

    @classmethod
    def of(cls, core: _core.StaticResult | KeptResult) -> KeptResult:
        """The solver's arrays are copied."""
        if isinstance(core, KeptResult):
            return core
        kept = [core.keeps_fields(increment) for increment in range(core.increments)]
        of_pairs = [[copied(core.pairs(k, contact)) for contact in range(len(core.contacts))] if there else [] for k, there in enumerate(kept)]
        moved = [[np.array(core.displacement(k, body)) for body in range(len(core.bodies))] if there else [] for k, there in enumerate(kept)]
        mechanism = core.mechanism()
        return cls(KeptRecord.of(core.record), core.status, core.writes_problems, list(core.contacts), list(core.bodies), core.increments, of_pairs,
                   [np.array(core.nodes(body)) for body in range(len(core.bodies))], moved,
                   [core.fields(k) if there else {} for k, there in enumerate(kept)], core.history() if all(kept) else "",
                   None if mechanism is None else copied(mechanism))

    def mechanism(self) -> dict[str, Any] | None:
        return self.of_mechanism


@dataclass
class KeptSpaceResult(KeptArrays):
    """A ``_core.SpaceResult``: pairs, displacements and fields of all increments that have them."""

    record: KeptRecord
    status: str
    contacts: list[str]
    bodies: list[str]
    increments: int
    of_pairs: list[list[dict[str, np.ndarray]]]
    of_nodes: list[np.ndarray]
    of_displacement: list[list[np.ndarray]]
    of_fields: list[dict[str, np.ndarray]]
    of_history: str
    of_mechanism: dict[str, Any] | None

    @classmethod
    def of(cls, core: _core.SpaceResult | KeptSpaceResult) -> KeptSpaceResult:
        """The solver's arrays are copied."""
        if isinstance(core, KeptSpaceResult):
            return core
        kept = [core.keeps_fields(increment) for increment in range(core.increments)]
        bodies, contacts = range(len(core.bodies)), range(len(core.contacts))
        return cls(KeptRecord.of(core.record), core.status, list(core.contacts), list(core.bodies), core.increments,
                   [[core.pairs(k, contact) for contact in contacts] if there else [] for k, there in enumerate(kept)],
                   [np.array(core.nodes(body)) for body in bodies],
                   [[np.array(core.displacement(k, body)) for body in bodies] if there else [] for k, there in enumerate(kept)],
                   [core.fields(k) if there else {} for k, there in enumerate(kept)], core.history() if all(kept) else "", core.mechanism())

    def mechanism(self) -> dict[str, Any] | None:
        return self.of_mechanism


@dataclass
class KeptModes:
    """A ``_core.ModalResult``."""

    record: KeptRecord
    total_mass: float
    bodies: list[str]
    of_modes: list[dict[str, Any]]
    of_nodes: list[np.ndarray]

    @classmethod
    def of(cls, core: _core.ModalResult | KeptModes) -> KeptModes:
        """The solver's arrays are copied."""
        if isinstance(core, KeptModes):
            return core
        modes = [{**mode, "shape": copied(mode["shape"])} for mode in core.modes()]
        return cls(KeptRecord.of(core.record), core.total_mass, list(core.bodies), modes, [np.array(core.nodes(body)) for body in range(len(core.bodies))])

    def modes(self) -> list[dict[str, Any]]:
        return self.of_modes

    def nodes(self, body: int) -> np.ndarray:
        return self.of_nodes[body]


def copied(table: dict[str, Any]) -> dict[str, Any]:
    return {name: np.array(value) if isinstance(value, np.ndarray) else value for name, value in table.items()}
