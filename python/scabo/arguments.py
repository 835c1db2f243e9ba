"""Arguments that several functions have."""
from __future__ import annotations

import os

__all__ = ["threads_of"]


def threads_of(wanted: int | None) -> int:
    """The upper limit on threads; None: all processors."""
    if wanted is None:
        return os.cpu_count() or 1
    if isinstance(wanted, bool) or not isinstance(wanted, int) or not 1 <= wanted <= 1024:
        raise ValueError(f"threads must be a whole number from 1 to 1024, not {wanted!r}")
    return wanted
