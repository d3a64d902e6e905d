"""Jobs that do not depend on each other, each done by one of some workers."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Iterator
from typing import Any, Generic, TypeVar

from gazelle.native.processors import processors
from gazelle.training.workers.clusters import RayLink, connect
from gazelle.training.workers.processes import ProcessLink
from gazelle.training.workers.team import WorkerLink, WorkerLostError

JobT = TypeVar("JobT")

TRIES = 3
"""Number of tries of a job before it counts as one that no worker survives."""


def call_all(
    jobs: Iterable[JobT],
    start: Callable[[], WorkerLink],
    done: Callable[[JobT, Any], None],
    *,
    workers: int,
) -> None:
    """Run every job; the next one goes to the first free worker.

    A worker that is lost is replaced, and its job is tried again.

    Args:
        jobs: Jobs. Taken one at a time, so that one may depend on results so far.
        start: Makes the link to a new worker; its ``call`` does a job.
        done: Called with each job and its answer, None where all workers that tried it were lost;
            from several threads, never two at a time.
        workers: Largest number of workers.
    """
    queue = _Queue(jobs, done)
    callers = [_Caller(start, queue) for _ in range(workers)]
    try:
        for caller in callers:
            caller.wait()
    finally:
        for caller in callers:
            caller.end()
        for caller in callers:
            caller.close()


def workers_at(
    ray: str | None, workers: int | None, make: Callable[..., Any], *arguments: Any
) -> tuple[int, Callable[[], WorkerLink]]:
    """Return the number of workers and a function that starts one.

    Args:
        ray: The address of a Ray cluster; None for processes on this machine.
        workers: Number; None for one a processor.
        make: Makes what answers there; a name that can be imported.
        arguments: Of ``make``.

    Raises:
        TaskError: There is no cluster at this address.
        MissingExtraError: Ray is requested and not installed.
    """
    if ray is not None:
        there = connect(ray)
        return workers or there, lambda: RayLink(make, *arguments)
    count = workers or processors()
    threads = max(1, processors() // count)
    return count, lambda: ProcessLink(make, *arguments, threads=threads)


class _Queue(Generic[JobT]):
    """Jobs that are left, for threads to take."""

    def __init__(self, jobs: Iterable[JobT], done: Callable[[JobT, Any], None]) -> None:
        self._jobs: Iterator[JobT] = iter(jobs)
        self._done = done
        self._lock = threading.Lock()

    def take(self) -> JobT:
        """Return the next one.

        Raises:
            StopIteration: There is none.
        """
        with self._lock:
            return next(self._jobs)

    def finish(self, job: JobT, answer: Any) -> None:
        """Report the result of a job."""
        with self._lock:
            self._done(job, answer)


class _Caller(Generic[JobT]):
    """A thread with a worker of its own, which takes jobs until none are left."""

    def __init__(self, start: Callable[[], WorkerLink], queue: _Queue[JobT]) -> None:
        self._start, self._queue = start, queue
        self._error: BaseException | None = None
        self._stopped = threading.Event()
        self._link: WorkerLink | None = None
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def wait(self) -> None:
        """Return when it has finished; what went wrong is raised."""
        self._thread.join()
        if self._error is not None:
            raise self._error

    def end(self) -> None:
        """Terminate the worker, whatever it is doing."""
        self._stopped.set()
        if self._link is not None:
            self._link.end()

    def close(self) -> None:
        """Wait for the worker's end."""
        if self._link is not None:
            self._link.close()

    def _run(self) -> None:
        try:
            while not self._stopped.is_set():
                job = self._queue.take()
                self._queue.finish(job, self._answer(job))
        except StopIteration:
            return
        except BaseException as error:  # noqa: BLE001  # the waiting call gets it
            self._error = error

    def _answer(self, job: JobT) -> Any:
        """Send a job to a worker and return its answer; None if each worker that tried was lost."""
        for _ in range(TRIES):
            try:
                if self._link is None:
                    self._link = self._start()
                self._link.send("call", job)
                return self._link.receive()
            except WorkerLostError:
                if self._link is not None:
                    self._link.close()
                self._link = None
                if self._stopped.is_set():
                    raise
        return None
