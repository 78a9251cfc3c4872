"""Shows the progress of the program: as a bar if tqdm is installed, otherwise as text on stderr."""

import contextlib
import shutil
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any, TextIO

#: A message of the program, which is one line of its stderr.
Message = dict[str, Any]

#: Seconds between two lines if stderr is not a terminal.
_INTERVAL = 5
_CLEAR = "\r\033[K"


@contextlib.contextmanager
def shown(wanted: bool) -> Iterator[Callable[[Message], None]]:
    """Gives a function that shows a message about the progress. If `wanted` is false, this function does nothing."""
    display = _display() if wanted else None
    if display is None:
        yield lambda message: None
        return
    try:
        yield display.show
    finally:
        display.close()


def _display() -> "_Bar | _Text | None":
    try:
        from tqdm.auto import tqdm  # type: ignore[import]
    except ImportError:
        return _Text(sys.stderr) if sys.stderr else None
    return _Bar(tqdm)


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
    """Prints messages of the program. A terminal has one line that changes. Any other stream gets a line every few
    seconds, and the last message."""

    def __init__(self, stream: TextIO) -> None:
        self._stream, self._terminal = stream, stream.isatty()
        self._last, self._written = "", time.monotonic()

    def show(self, message: Message) -> None:
        self._last = message["text"]
        if self._terminal:
            width = shutil.get_terminal_size().columns
            self._put(_CLEAR + self._last[:width - 1])
        elif time.monotonic() - self._written > _INTERVAL:
            self._put_line()

    def close(self) -> None:
        if self._terminal:
            self._put(_CLEAR)
        if self._last:
            self._put_line()

    def _put_line(self) -> None:
        self._put(f"isojam: {self._last}\n")
        self._last, self._written = "", time.monotonic()

    def _put(self, text: str) -> None:
        self._stream.write(text)
        self._stream.flush()
