"""Types of the extension module. The package `scabo` is its interface."""
from typing import Any

import numpy as np

version: str

class Document:
    file: str
    def data(self) -> dict[str, Any]: ...

class CheckedModel:
    is_modal: bool
    bodies: list[str]
    warnings: list[str]
    def sizes(self) -> dict[str, Any]: ...

class Progress:
    """How far a run is, for its callback."""

    @property
    def stage(self) -> str: ...
    @property
    def increment(self) -> int: ...
    @property
    def increments(self) -> int | None: ...
    @property
    def fraction(self) -> float: ...
    @property
    def newton_iterations(self) -> int | None: ...
    @property
    def residual(self) -> float | None: ...
    @property
    def iteration(self) -> int | None: ...
    @property
    def iteration_residual(self) -> float | None: ...
    @property
    def seconds_left(self) -> float | None: ...

class RunRecord:
    summary: str
    directory: str | None
    warnings: list[str]
    error: BaseException | None
    why_not_solved: str

class StaticResult:
    record: RunRecord
    status: str
    writes_problems: bool
    contacts: list[str]
    bodies: list[str]
    increments: int
    def pairs(self, increment: int, contact: int) -> dict[str, np.ndarray]: ...
    def keeps_fields(self, increment: int) -> bool: ...
    def nodes(self, body: int) -> np.ndarray: ...
    def displacement(self, increment: int, body: int) -> np.ndarray: ...
    def mechanism(self) -> dict[str, Any] | None: ...
    def values(self, increment: int, points: np.ndarray, only: int, allow_outside: bool) -> dict[str, np.ndarray]: ...

class ModalResult:
    record: RunRecord
    total_mass: float
    bodies: list[str]
    def modes(self) -> list[dict[str, Any]]: ...
    def nodes(self, body: int) -> np.ndarray: ...

class SuperElement:
    def __init__(self, nodes: np.ndarray, centre: tuple[float, float], open: bool, order: int, young: float,
                 poisson: float, plane_strain: bool, thickness: float, unbounded: bool, threads: int) -> None: ...
    stiffness: np.ndarray
    exponents: np.ndarray
    def coefficients(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]: ...
    def values(self, displacement: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]: ...

class DiscreteSolution:
    status: str
    forces: np.ndarray
    rigid_motions: np.ndarray
    gap: np.ndarray
    slip: np.ndarray
    unrestrained_motion: np.ndarray
    proof: np.ndarray
    states: np.ndarray
    iterations: int
    natural_map_residual: float
    rounding: float
    reason: str
    certificate: dict[str, float]

def read(file: str, settings: list[str]) -> Document: ...
def checked_model(data: object, file: str, document: Document | None) -> CheckedModel: ...
def schema() -> str: ...
def solve_static(model: CheckedModel, output: str | None, threads: int, keep_fields: bool, ignore_memory: bool,
                 progress: object) -> StaticResult: ...
def solve_modal(model: CheckedModel, output: str | None, threads: int, progress: object) -> ModalResult: ...
def write_results(result: StaticResult, output: str) -> None: ...
def lobatto_points(order: int) -> list[float]: ...
def solve_contact(dense: np.ndarray | None, columns: tuple[np.ndarray, np.ndarray, np.ndarray] | None, q: np.ndarray,
                  mu: np.ndarray, dimension: int, cohesion: np.ndarray, tension: np.ndarray, G: np.ndarray | None,
                  f: np.ndarray, start_forces: np.ndarray, start_motions: np.ndarray, tolerance: float,
                  by_certificate: bool, iterations: int, force_scale: float, seconds: float,
                  threads: int) -> DiscreteSolution: ...
