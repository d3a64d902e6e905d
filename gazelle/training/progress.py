"""Progress display of a training run."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any, Protocol, TextIO

_SECONDS_BETWEEN_LINES = 10.0


class Progress(Protocol):
    """Shows how far a training run is."""

    def start(self, done: int, total: int) -> None:
        """Start the display, with some control steps done already."""

    def update(self, done: int, summary: dict[str, float]) -> None:
        """Update the display after a given number of control steps.

        The summary is `EpisodeLog.summary`'s.
        """

    def say(self, text: str) -> None:
        """Print a message, without disturbing the display."""

    def close(self) -> None:
        """Close the display."""


class NoProgress:
    """Shows nothing."""

    def start(self, done: int, total: int) -> None:
        """Show nothing."""

    def update(self, done: int, summary: dict[str, float]) -> None:
        """Show nothing."""

    def say(self, text: str) -> None:
        """Show nothing."""

    def close(self) -> None:
        """Show nothing."""


class CopiesView(Protocol):
    """Shows copies that learn."""

    def note(self, done: int, total: int, summary: dict[str, float]) -> None:
        """Show how far the training is; see `Progress`."""

    def close(self) -> None:
        """Stop showing them."""


class Watched:
    """A display, and something to look at the copies with that learn in this process.

    Args:
        progress: The display.
        watch: Called with the environment when the first rollout begins.
    """

    def __init__(self, progress: Progress, watch: Callable[[Any], CopiesView]) -> None:
        self._progress, self._watch = progress, watch
        self._env: Any = None
        self._view: CopiesView | None = None
        self._total = 0

    def attach(self, env: Any) -> None:
        """Set the environment."""
        self._env = env

    def start(self, done: int, total: int) -> None:
        """Start the display; see ``Progress``."""
        self._total = total
        self._progress.start(done, total)

    def update(self, done: int, summary: dict[str, float]) -> None:
        """Update the display; see ``Progress``; the environment has been reset by now."""
        if self._view is None and self._env is not None:
            self._view = self._watch(self._env)
        if self._view is not None:
            self._view.note(done, self._total, summary)
        self._progress.update(done, summary)

    def say(self, text: str) -> None:
        """Print a message; see ``Progress``."""
        self._progress.say(text)

    def close(self) -> None:
        """Close the display; see ``Progress``."""
        self._progress.close()
        if self._view is not None:
            self._view.close()


class Lines:
    """A line now and then, for logs and pipes.

    Args:
        stream: Output of the lines.
        seconds: Wall time between two lines [s].
    """

    def __init__(self, stream: TextIO, seconds: float = _SECONDS_BETWEEN_LINES) -> None:
        self._stream = stream
        self._seconds = seconds
        self._total = 0
        self._began = (0.0, 0)
        self._last = 0.0

    def start(self, done: int, total: int) -> None:
        """Record where and when training starts."""
        self._total = total
        self._last = time.monotonic()
        self._began = (self._last, done)

    def update(self, done: int, summary: dict[str, float]) -> None:
        """Write a line if the last one is long enough ago."""
        now = time.monotonic()
        if now - self._last < self._seconds:
            return
        self._last = now
        rate = (done - self._began[1]) / (now - self._began[0])
        self.say(f"{done:,}/{self._total:,} steps, {rate:,.0f} steps/s{describe(summary)}")

    def say(self, text: str) -> None:
        """Write a line."""
        self._stream.write(f"{text}\n")
        self._stream.flush()

    def close(self) -> None:
        """Do nothing: there is nothing to close."""


class Bar:
    """A progress bar of one line, for terminals.

    Args:
        stream: Output of the bar.
    """

    def __init__(self, stream: TextIO) -> None:
        from tqdm import tqdm

        self._stream = stream
        self._tqdm = tqdm
        self._bar = tqdm(disable=True)

    def start(self, done: int, total: int) -> None:
        """Show the bar."""
        self._bar.close()
        form = "{percentage:3.0f}%|{bar}| {n_fmt}/{total_fmt} [{remaining}, {rate_fmt}{postfix}]"
        self._bar = self._tqdm(
            initial=done,
            total=total,
            unit=" steps",
            unit_scale=True,
            dynamic_ncols=True,
            bar_format=form,
            file=self._stream,
            leave=True,
        )

    def update(self, done: int, summary: dict[str, float]) -> None:
        """Move the bar."""
        self._bar.set_postfix_str(describe(summary).removeprefix(", "), refresh=False)
        self._bar.update(min(done, self._bar.total) - self._bar.n)

    def say(self, text: str) -> None:
        """Write a line above the bar."""
        self._tqdm.write(text, file=self._stream)

    def close(self) -> None:
        """Close the bar, which stays visible."""
        self._bar.close()


def choose_progress(stream: TextIO | None = None) -> Progress:
    """Return a bar on a terminal, else a line now and then.

    Args:
        stream: Output; by default standard error.
    """
    stream = stream or sys.stderr
    return Bar(stream) if stream.isatty() else Lines(stream)


def describe(summary: dict[str, float]) -> str:
    """Return the main figure of an `EpisodeLog.summary`: success, else return."""
    if "success_rate" in summary:
        return f", success {summary['success_rate']:.0%}"
    if "return" in summary:
        return f", return {summary['return']:.4g}"
    return ""
