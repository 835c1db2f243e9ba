"""Arguments that several functions have."""
from __future__ import annotations

import os
from typing import Any

import numpy as np

__all__ = ["real_array", "threads_of"]


def real_array(name: str, values: Any) -> np.ndarray:
    """The values as floating-point numbers; without a copy if they are. Complex numbers, which would lose their imaginary
    parts, masked ones and text are refused."""
    if np.ma.is_masked(values):
        raise ValueError(f"{name} has masked entries: fill them in, or leave them out")
    array = np.asarray(values)
    if array.dtype.kind == "c":
        raise ValueError(f"{name} must be real, not of dtype {array.dtype}: pass its real part if the imaginary part is 0")
    if array.dtype.kind == "O" and any(isinstance(value, (str, bytes)) for value in array.flat):
        raise ValueError(f"{name} must be numbers, not text")
    if array.dtype.kind not in "biufO":
        raise ValueError(f"{name} must be numbers, not of dtype {array.dtype}")
    try:
        return array.astype(float, copy=False)
    except (TypeError, ValueError) as error:  # objects
        raise ValueError(f"{name} must be real numbers: {error}") from None


def threads_of(wanted: int | None) -> int:
    """The upper limit on threads; None: all processors."""
    if wanted is None:
        return os.cpu_count() or 1
    if isinstance(wanted, bool) or not isinstance(wanted, int) or not 1 <= wanted <= 1024:
        raise ValueError(f"threads must be a whole number from 1 to 1024, not {wanted!r}")
    return wanted
