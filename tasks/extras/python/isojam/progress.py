"""Shows the progress of the program: as a bar if tqdm is installed, otherwise as text on stderr."""

import contextlib
import io
import os
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

#: A message of the program, which is one line of its stderr.
Message = dict[str, Any]

#: Seconds between two lines of text.
_INTERVAL = 5


@contextlib.contextmanager
def shown(wanted: bool) -> Iterator[Callable[[Message], None]]:
    """Gives a function that shows a message about the progress. Without a standard error it does nothing, and a standard
    error that fails does not end the run."""
    display: _Bar | _Text | None = None
    if wanted and _can_write():
        try:
            from tqdm.auto import tqdm  # type: ignore[import]
            display = _Bar(tqdm)
        except ImportError:
            display = _Text()

    def attempt(call: Callable[..., None], *arguments: Message) -> None:
        with contextlib.suppress(OSError, ValueError):
            call(*arguments)

    try:
        yield lambda message: attempt(display.show, message) if display else None
    finally:
        attempt(display.close if display else lambda: None)


def _can_write() -> bool:
    """False if there is no standard error, or if it is closed: its descriptor may then belong to another file."""
    try:
        os.fstat(sys.stderr.fileno())
    except io.UnsupportedOperation:  # in a notebook
        return not sys.stderr.closed
    except (AttributeError, OSError, ValueError):
        return False
    return True


class _Bar:
    """Progress bars of tqdm, one for each round of replicates."""

    def __init__(self, tqdm: Callable[..., Any]) -> None:
        self._tqdm, self._bar = tqdm, None  # type: Callable[..., Any], Any

    def show(self, message: Message) -> None:
        done, total, failed = message.get("done", 0), message.get("total", 0), message.get("failed", 0)
        if total == 0:
            return
        if self._bar is None or total != self._bar.total or done < self._bar.n:
            self.close()
            self._bar = self._tqdm(total=total, unit=" replicates")
        self._bar.set_postfix_str(f"{failed} failed" if failed else "", refresh=False)
        self._bar.update(done - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


class _Text:
    """Prints a message of the program every few seconds, and the last one."""

    def __init__(self) -> None:
        self._last, self._written = "", time.monotonic()

    def show(self, message: Message) -> None:
        self._last = message["text"]
        if time.monotonic() - self._written > _INTERVAL:
            self.close()

    def close(self) -> None:
        if self._last:
            print(f"isojam: {self._last}", file=sys.stderr, flush=True)
        self._last, self._written = "", time.monotonic()
