"""The driver's side: workers that hold shards, replaced when they are lost."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from gazelle.errors import SimulationWarning, TaskError
from gazelle.training.workers.shards import Spaces

_TRIES = 3


class WorkerLostError(Exception):
    """A worker ended before it answered."""


class WorkerLink(Protocol):
    """A way to one worker, with an object, such as a `ShardHost`, that runs requests."""

    def send(self, method: str, *arguments: Any) -> None:
        """Call a method of the object.

        Raises:
            WorkerLostError: The worker is not there any more.
        """

    def receive(self) -> Any:
        """Return the answer to the last `send`.

        Raises:
            WorkerLostError: The worker ended before it answered.
        """

    def end(self) -> None:
        """Terminate the worker, whatever it is doing; does not wait."""

    def close(self) -> None:
        """Stop the worker and wait for it."""


class WorkerGroup:
    """Some workers and the shards that they hold.

    A worker that is lost is started again, gets its shards back as they were after the last
    rollout, and gets the request again: nothing but time is lost. Where the request was a single step,
    its episodes start again instead, and the answer is their first observations.

    Args:
        start: Makes the link to a new worker with these shards.
        shards: Number of shards.
        workers: Number of workers.

    Raises:
        TaskError: There are more workers than shards.

    Attributes:
        replaced: Number of workers lost and replaced.
    """

    def __init__(
        self, start: Callable[[Sequence[int]], WorkerLink], shards: int, workers: int
    ) -> None:
        if not 1 <= workers <= shards:
            raise TaskError(
                f"{workers} workers cannot share {shards} parts",
                hint=f"use 1 to {shards} workers, or more copies with --num-envs",
            )
        self._start = start
        self._shares = [tuple(range(worker, shards, workers)) for worker in range(workers)]
        self._states: dict[int, Any] = {}
        self._links: list[WorkerLink] = []
        self.replaced = 0
        try:
            for share in self._shares:
                self._links.append(start(share))
        except BaseException:
            self.close()
            raise

    def spaces(self) -> Spaces:
        """Return the spaces, period and contract of the task."""
        spaces: Spaces = _request(self._links[0], "spaces")
        return spaces

    def call(self, method: str, *arguments: Any) -> dict[int, Any]:
        """Call a method of all workers at once.

        Args:
            method: Of `ShardHost`.
            arguments: Of the method.

        Returns:
            What came of it by shard, in order.

        Raises:
            TaskError: A worker was lost again and again.
        """
        lost = [
            worker
            for worker in range(len(self._links))
            if not self._send(worker, method, arguments)
        ]
        found: dict[int, Any] = {}
        for worker in range(len(self._links)):
            if worker not in lost:
                try:
                    self._take(self._links[worker].receive(), found)
                except WorkerLostError:
                    lost.append(worker)
        for worker in lost:
            self._take(self._again(worker, method, arguments), found)
        return dict(sorted(found.items()))

    @property
    def states(self) -> dict[int, Any] | None:
        """The shards as they were after the last answer; None if they cannot be saved."""
        known = self._states
        return None if not known or None in known.values() else dict(sorted(known.items()))

    def close(self) -> None:
        """Stop all workers."""
        for link in self._links:
            link.end()
        while self._links:
            self._links.pop().close()

    def _send(self, worker: int, method: str, arguments: tuple[Any, ...]) -> bool:
        try:
            self._links[worker].send(method, *arguments)
        except WorkerLostError:
            return False
        return True

    def _take(self, answers: Mapping[int, tuple[Any, Any]], found: dict[int, Any]) -> None:
        for number, (value, state) in answers.items():
            found[number] = value
            if state is not None or number not in self._states:
                self._states[number] = state

    def _again(self, worker: int, method: str, arguments: tuple[Any, ...]) -> Any:
        """Call a new worker for a lost one's request."""
        share = self._shares[worker]
        for _ in range(_TRIES):
            self._links[worker].close()
            self._links[worker] = self._start(share)
            self.replaced += 1
            link = self._links[worker]
            try:
                if method == "step":
                    return _request(link, "reset", self.replaced)
                if method not in {"reset", "set_state"}:
                    self._restore(link, share)
                return _request(link, method, *arguments)
            except WorkerLostError:
                continue
        raise TaskError(
            f"worker {worker} ended {_TRIES + 1} times in the same work",
            hint="its output is above; is there enough memory?",
        )

    def _restore(self, link: WorkerLink, share: Sequence[int]) -> None:
        states = {number: self._states.get(number) for number in share}
        if None not in states.values():
            _request(link, "set_state", states)
            return
        warnings.warn(
            "a worker was lost, and this environment cannot save its state: its episodes start "
            "again, so the run is not bit for bit equal to one without the loss",
            SimulationWarning,
            stacklevel=2,
        )
        _request(link, "reset", self.replaced)


def _request(link: WorkerLink, method: str, *arguments: Any) -> Any:
    link.send(method, *arguments)
    return link.receive()
