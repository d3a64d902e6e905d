"""Performance of a simulator: real-time factor, processor time and memory."""

from __future__ import annotations

import csv
import json
import os
import statistics
import threading
import time
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

from gazelle.argument_checks import checked
from gazelle.clients.errors import ClientError
from gazelle.errors import MissingExtraError
from gazelle_ros import Node
from gazelle_ros.base.closing import Closeable
from gazelle_ros.base.writing import replacing, write_text
from gazelle_ros.msgs import rosgraph_msgs

_MOST_LOOKS = 1000.0
_TICKS = os.sysconf("SC_CLK_TCK") if hasattr(os, "sysconf") else 100
_PAGE = os.sysconf("SC_PAGE_SIZE") if hasattr(os, "sysconf") else 4096

_LABELS = {
    "real_time_factor": "real-time factor",
    "cpu": "processor [cores]",
    "memory": "memory [MB]",
}


@dataclass(frozen=True, slots=True)
class Sample:
    """One look.

    Attributes:
        wall: Since watching began [s].
        simulated: Simulated time [s].
        real_time_factor: Simulated seconds a wall second since the last look.
        cpu: Share of one core since the last look; 0 if no process is watched.
        memory: Resident [MB].
    """

    wall: float
    simulated: float
    real_time_factor: float
    cpu: float
    memory: float


@checked(ClientError, after=True)
class PerformanceWatch(Closeable):
    """Looks at ``/clock`` and at processes at a rate; also a context manager.

    Args:
        node: Listens to ``/clock``.
        pids: Processes to look at (Linux).
        rate: Looks a second of wall time [Hz].

    Attributes:
        samples: Received samples.
    """

    def __init__(self, node: Node, pids: tuple[int, ...] = (), rate: float = 2.0) -> None:
        self.samples: list[Sample] = []
        self._pids = pids
        if not 0.0 < rate <= _MOST_LOOKS:
            raise ClientError(
                f"the rate must be above 0 and at most {_MOST_LOOKS:g} Hz, not {rate}"
            )
        self._period = min(1.0 / rate, threading.TIMEOUT_MAX)
        self._simulated = 0.0
        self._end = threading.Event()
        self._subscriber = node.subscribe("/clock", rosgraph_msgs.msg.Clock, self._tick, 1)
        self._thread = threading.Thread(target=self._watch, name="performance", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Stop sampling; the samples are kept."""
        self._end.set()
        self._thread.join()
        self._subscriber.close()

    # -- results -----------------------------------------------------------------------------

    def summary(self) -> dict[str, dict[str, float]]:
        """Return mean, least and most of everything that was measured.

        Raises:
            ClientError: Nothing was seen yet.
        """
        if not self.samples:
            raise ClientError("no samples yet", hint="watch for longer")
        found = {}
        for name in _LABELS:
            values = [getattr(sample, name) for sample in self.samples]
            found[name] = {
                "mean": statistics.fmean(values),
                "least": min(values),
                "most": max(values),
            }
        return found

    def report(self) -> str:
        """Return the summary as a table of text.

        Raises:
            ClientError: Nothing was seen yet.
        """
        found = self.summary()
        lines = [f"{'':18}{'mean':>9}{'least':>9}{'most':>9}"]
        lines += [
            f"{_LABELS[name]:18}" + "".join(f"{value:9.2f}" for value in values.values())
            for name, values in found.items()
        ]
        return "\n".join(lines)

    def save(self, path: str | Path) -> None:
        """Write all samples to a ``.csv`` or ``.json`` file.

        Raises:
            ClientError: The name ends with neither.
            OSError: The file cannot be written.
        """
        file = Path(path)
        rows = [asdict(sample) for sample in self.samples]
        if file.suffix == ".json":
            write_text(file, json.dumps(rows, indent=1))
        elif file.suffix == ".csv":
            with (
                replacing(file) as draft,
                draft.open("w", newline="", encoding="utf-8") as stream,
            ):
                writer = csv.DictWriter(stream, [field.name for field in fields(Sample)])
                writer.writeheader()
                writer.writerows(rows)
        else:
            raise ClientError("samples are saved as .csv or .json", file=str(file))

    def plot(self, path: str | Path) -> None:
        """Plot real-time factor, processor and memory over time into a picture.

        Raises:
            MissingExtraError: Matplotlib is not installed.
            OSError: The file cannot be written.
        """
        try:
            from matplotlib.backends.backend_agg import FigureCanvasAgg
            from matplotlib.figure import Figure
        except ImportError:
            raise MissingExtraError("matplotlib", "plots") from None
        figure: Any = Figure(figsize=(8.0, 7.0), layout="constrained")
        FigureCanvasAgg(figure)
        wall = [sample.wall for sample in self.samples]
        for axes, (name, label) in zip(
            figure.subplots(3, 1, sharex=True), _LABELS.items(), strict=True
        ):
            values = [getattr(sample, name) for sample in self.samples]
            axes.plot(wall, values)
            axes.set_ylabel(label)
            axes.set_ylim(0.0, 1.1 * max(values, default=0.0) or 1.0)
            axes.grid(alpha=0.3)
        axes.set_xlabel("wall time [s]")
        with replacing(path) as draft:
            figure.savefig(draft, dpi=120)

    # -- looking -----------------------------------------------------------------------------

    def _tick(self, message: rosgraph_msgs.msg.Clock) -> None:
        self._simulated = message.clock.to_sec()

    def _watch(self) -> None:
        start = last_wall = time.monotonic()
        last_simulated, last_cpu = self._simulated, self._cpu_seconds()
        while not self._end.wait(self._period):
            wall, simulated, cpu = time.monotonic(), self._simulated, self._cpu_seconds()
            passed = wall - last_wall
            self.samples.append(
                Sample(
                    wall - start,
                    simulated,
                    max(0.0, simulated - last_simulated) / passed,
                    (cpu - last_cpu) / passed,
                    sum(_memory(pid) for pid in self._pids) / 1e6,
                )
            )
            last_wall, last_simulated, last_cpu = wall, simulated, cpu

    def _cpu_seconds(self) -> float:
        return sum(_cpu_seconds(pid) for pid in self._pids)


def _cpu_seconds(pid: int) -> float:
    """Return processor time of a process so far (proc(5)); 0 if it has ended."""
    try:
        text = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8")
    except OSError:
        return 0.0
    # The name of the program, in brackets, may hold anything.
    values = text.rpartition(")")[2].split()
    return (int(values[11]) + int(values[12])) / _TICKS


def _memory(pid: int) -> float:
    """Return resident memory of a process in bytes (proc(5)); 0 if it has ended."""
    try:
        text = Path(f"/proc/{pid}/statm").read_text(encoding="utf-8")
    except OSError:
        return 0.0
    return float(text.split()[1]) * _PAGE
