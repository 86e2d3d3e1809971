"""How far long work has come: a function of the user's, a bar of tqdm, or lines of text."""

from __future__ import annotations

import importlib
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Union

from ._native import MceipError

#: Called with a line of text, the steps done, and the steps in all where they are known. An
#: exception that it raises ends the work.
Listener = Callable[[str, int, Union[int, None]], object]

#: True asks for a bar of tqdm, or for lines on standard error where tqdm is not installed.
Progress = Union[Listener, bool, None]

#: Time between two lines on standard error, s.
LINE_EVERY = 1.0


@contextmanager
def listening(progress: Progress) -> Iterator[Listener | None]:
    """The listener that is meant, until the work is over."""
    if progress is True:
        tqdm = tqdm_or_none()
        if tqdm is None:
            yield Lines()
        else:
            with tqdm(bar_format="{desc} [{elapsed}]", leave=False) as bar:
                yield lambda text, done, total: bar.set_description_str(text)
    elif progress is False or progress is None:
        yield None
    elif callable(progress):
        yield progress
    else:
        raise MceipError(f"progress: expected a function, True or None, got {progress!r}")


def tqdm_or_none() -> Any:
    """The class `tqdm`, for terminals and for notebooks, where it is installed."""
    try:
        return importlib.import_module("tqdm.auto").tqdm
    except ImportError:
        return None


class Lines:
    """Lines on standard error, not too many."""

    def __init__(self) -> None:
        self._last = float("-inf")

    def __call__(self, text: str, done: int, total: int | None) -> None:
        if time.monotonic() - self._last >= LINE_EVERY:
            self._last = time.monotonic()
            print(text, file=sys.stderr)
