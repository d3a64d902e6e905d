"""Workers as processes on this machine."""

from __future__ import annotations

import contextlib
import os
import pickle
import queue
import signal
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Sequence
from typing import IO, Any

from gazelle.native.processors import VARIABLE, processors
from gazelle.training.workers.shards import ShardHost, ShardSpec
from gazelle.training.workers.team import WorkerLink, WorkerLostError

_LENGTH = struct.Struct("<Q")
_GRACE = 0.5  # of a worker at work to end it, once its driver has gone [s]
_PATIENCE = 1.0  # until a worker that does not end is killed [s]
_LIBRARIES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


class ProcessLink:
    """A worker in a process of its own; it ends when this one does.

    Args:
        make: Makes what answers there, such as `ShardHost`; a name that can be imported.
        arguments: Of ``make``.
        threads: Number of threads of its engine.
    """

    def __init__(self, make: Callable[..., Any], *arguments: Any, threads: int) -> None:
        few = {VARIABLE: str(threads), **dict.fromkeys(_LIBRARIES, "1")}
        self._process = subprocess.Popen(  # this very Python and module
            [sys.executable, "-m", "gazelle.training.workers.serve"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            process_group=0,  # Ctrl-C is for the driver, which ends its workers
            env=os.environ
            | few
            | {"PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
        )
        self._write((make, arguments))

    @property
    def pid(self) -> int:
        """The process's number."""
        return self._process.pid

    def send(self, method: str, *arguments: Any) -> None:
        """Send a request; see `WorkerLink.send`."""
        self._write((method, arguments))

    def receive(self) -> Any:
        """Receive an answer; see `WorkerLink.receive`."""
        try:
            error, answer = read(_open(self._process.stdout))
        except (EOFError, OSError) as gone:
            raise WorkerLostError(f"it ended with code {self._process.poll()}") from gone
        if error is not None:
            raise error
        return answer

    def _write(self, value: Any) -> None:
        try:
            write(_open(self._process.stdin), value)
        except OSError as error:
            raise WorkerLostError(str(error)) from error

    def end(self) -> None:
        """Terminate the worker; see `WorkerLink.end`."""
        with contextlib.suppress(OSError):
            _open(self._process.stdin).close()

    def close(self) -> None:
        """Stop the process, by force if necessary."""
        self.end()
        try:
            self._process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        # Only now: a thread that waits for an answer holds the pipe until the process has ended.
        with contextlib.suppress(OSError):
            _open(self._process.stdout).close()


def start_processes(blueprint: ShardSpec, workers: int) -> Callable[[Sequence[int]], WorkerLink]:
    """Return a function that starts one of this many workers, see `WorkerGroup`."""
    threads = max(1, processors() // workers)
    return lambda numbers: ProcessLink(ShardHost, blueprint, tuple(numbers), threads=threads)


def serve(requests: IO[bytes], answers: IO[bytes]) -> None:
    """Serve requests until there are no more."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)  # for the driver, which saves and ends its workers
    inbox: queue.SimpleQueue[Any] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(requests, inbox), daemon=True).start()
    first = inbox.get()
    if first is None:
        return
    make, given = first
    host = make(*given)
    try:
        while (request := inbox.get()) is not None:
            method, arguments = request
            write(answers, _answer(host, method, arguments))
    except OSError:
        return  # the driver has gone
    finally:
        host.close()


def _listen(requests: IO[bytes], inbox: queue.SimpleQueue[Any]) -> None:
    """Forward requests; end the worker when the driver releases it or exits."""
    with contextlib.suppress(EOFError, OSError):
        while True:
            inbox.put(read(requests))
    inbox.put(None)
    time.sleep(_GRACE)
    os._exit(1)  # it is still at something long, without a receiver


def write(pipe: IO[bytes], value: Any) -> None:
    """Write a value to a process of our own."""
    data = pickle.dumps(value, protocol=pickle.HIGHEST_PROTOCOL)
    pipe.write(_LENGTH.pack(len(data)))
    pipe.write(data)
    pipe.flush()


def read(pipe: IO[bytes]) -> Any:
    """Read a value that such a process wrote.

    Raises:
        EOFError: It ended.
    """
    head = pipe.read(_LENGTH.size)
    if len(head) < _LENGTH.size:
        raise EOFError
    data = pipe.read(*_LENGTH.unpack(head))
    if len(data) < _LENGTH.unpack(head)[0]:
        raise EOFError
    return pickle.loads(data)  # noqa: S301  # of a process that this one started


def _answer(host: Any, method: str, arguments: tuple[Any, ...]) -> tuple[Exception | None, Any]:
    """Return an error or the result."""
    try:
        return None, getattr(host, method)(*arguments)
    except Exception as error:  # noqa: BLE001  # the driver raises it
        return _portable(error), None


def _portable(error: Exception) -> Exception:
    """Return the error itself, if it can travel, else one with its text."""
    try:
        pickle.loads(pickle.dumps(error))  # noqa: S301  # our own
    except Exception:  # noqa: BLE001  # whatever is wrong with it
        return RuntimeError(f"{type(error).__name__}: {error}")
    return error


def _open(pipe: IO[bytes] | None) -> IO[bytes]:
    if pipe is None:
        raise WorkerLostError("the worker has no pipe")
    return pipe
