"""The bar of ``Model.run(progress=True)``, by tqdm."""
from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from typing import Any

from . import _core

__all__ = ["watching"]

Callback = Callable[["_core.Progress"], Any]


@contextlib.contextmanager
def watching(progress: Callback | bool | None) -> Iterator[Callback | None]:
    """The callback that ``progress`` of ``Model.run`` means, while the run goes on."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            yield None
            return
        bar = tqdm(total=1.0, bar_format="{l_bar}{bar}| {postfix[0]}", postfix=[""])
        try:
            yield lambda now: _show(bar, now)
        finally:
            bar.close()
    elif callable(progress):
        yield progress
    else:
        raise TypeError(f"progress must be a function or True, not {type(progress).__name__}")


def _show(bar: Any, now: _core.Progress) -> None:
    bar.postfix[0] = text_of(now)
    bar.update(now.fraction - bar.n)
    bar.refresh()


def text_of(now: _core.Progress) -> str:
    """``step press, increment 2 of 10, iteration 3, residual 2.1e-06; about 40 s left``"""
    text = now.stage
    if now.iteration is not None:
        text += f", iteration {now.iteration}, residual {now.iteration_residual:.1e}"
    elif now.residual is not None:
        text += f"; residual {now.residual:.1e}"
    if now.seconds_left is not None and now.seconds_left >= 1.0:
        text += f"; about {_duration(now.seconds_left)} left"
    return text


def _duration(seconds: float) -> str:
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h"
