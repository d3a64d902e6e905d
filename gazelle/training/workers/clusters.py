"""Workers as actors of a Ray cluster (https://docs.ray.io)."""

from __future__ import annotations

import contextlib
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from gazelle.errors import MissingExtraError, TaskError
from gazelle.native.processors import VARIABLE
from gazelle.training.workers.shards import ShardHost, ShardSpec
from gazelle.training.workers.team import WorkerLink, WorkerLostError
from gazelle_ros.base.child_processes import command_line, descendants
from gazelle_ros.base.interrupts import Interrupted, holding

LOCAL = "local"
"""The address of a cluster that is started on this machine and ends with the program."""
_FORKING_S = 0.5
_HINT = "'ray start --head' starts a cluster; --ray without an address uses this machine"


class RayLink:
    """A worker that is an actor of Ray's.

    Args:
        make: Makes what answers there, such as `ShardHost`.
        arguments: Of ``make``.

    Attributes:
        actor: Ray's handle.
    """

    def __init__(self, make: Callable[..., Any], *arguments: Any) -> None:
        ray = connected()
        alone = {"env_vars": {VARIABLE: "1", "OMP_NUM_THREADS": "1"}}
        made = ray.remote(make).options(num_cpus=1, max_restarts=0, runtime_env=alone)
        self.actor: Any = made.remote(*arguments)
        self._answer: Any = None

    def send(self, method: str, *arguments: Any) -> None:
        """Send a request; see `WorkerLink.send`."""
        self._answer = getattr(self.actor, method).remote(*arguments)

    def receive(self) -> Any:
        """Receive an answer; see `WorkerLink.receive`."""
        ray = connected()
        try:
            return ray.get(self._answer)
        except ray.exceptions.RayActorError as error:
            raise WorkerLostError(str(error)) from error
        except ray.exceptions.RayTaskError as error:
            raise error.cause from error

    def end(self) -> None:
        """Terminate the worker; see `WorkerLink.end`."""
        self.close()

    def close(self) -> None:
        """Stop the actor; repeated calls are harmless."""
        connected().kill(self.actor)


def connect(address: str) -> int:
    """Join a cluster, or start one on this machine.

    Args:
        address: As ``ray.init`` takes it, ``auto`` for the one that this machine belongs to;
            `LOCAL` starts one that only this machine can reach.

    Returns:
        How many processors it has.

    Raises:
        MissingExtraError: Ray is not installed.
        TaskError: There is no cluster at this address, or it is empty.
    """
    if not address.strip():
        raise TaskError("the address of a Ray cluster is empty", hint=_HINT)
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")  # it would report to its makers
    try:
        import ray
    except ModuleNotFoundError as error:
        raise MissingExtraError("ray", "distributed") from error
    alone: dict[str, Any] = {}
    if address == LOCAL:
        alone = {"include_dashboard": False, "_node_ip_address": "127.0.0.1"}
    try:
        if not ray.is_initialized():
            with _ended_if_interrupted(Path(ray.__file__).parent), _sigterm_handler_kept():
                ray.init(address=address, log_to_driver=True, logging_level="ERROR", **alone)
    except (ConnectionError, ValueError) as error:
        raise TaskError(f"no Ray cluster at {address}: {error}", hint=_HINT) from error
    return int(ray.cluster_resources().get("CPU", 1))


@contextlib.contextmanager
def _sigterm_handler_kept() -> Iterator[None]:
    """Keep a handler of SIGTERM; Ray's own exits at once."""
    before = signal.getsignal(signal.SIGTERM)
    try:
        yield
    finally:
        if callable(before) and threading.current_thread() is threading.main_thread():
            signal.signal(signal.SIGTERM, before)


@contextlib.contextmanager
def _ended_if_interrupted(package: Path) -> Iterator[None]:
    """End the processes that an interrupted start of Ray leaves; Ray forgets them.

    Args:
        package: Folder of Ray's files.

    Raises:
        Interrupted: SIGTERM came, which Ray's handler turns into an exit with another code.
    """
    before = set(descendants())
    try:
        yield
    except BaseException as error:
        with holding():
            for process in _started_from(package, before):
                with contextlib.suppress(ProcessLookupError):
                    os.kill(process, signal.SIGKILL)
        if isinstance(error, SystemExit):
            raise Interrupted(signal.SIGTERM) from error
        raise


def _started_from(package: Path, before: set[int]) -> list[int]:
    """Return new processes that run a folder's files, and what these started.

    Other threads may have started programs meanwhile.
    """
    deadline, here = time.monotonic() + _FORKING_S, command_line(os.getpid())
    while True:
        commands = {each: command_line(each) for each in descendants() if each not in before}
        # A child has its parent's command until it executes its own.
        if here not in commands.values() or time.monotonic() > deadline:
            break
        time.sleep(0.01)
    roots = [process for process, words in commands.items() if f"{package}{os.sep}" in words]
    return [*roots, *(each for root in roots for each in descendants(root))]


def connected() -> Any:
    """Return Ray, which `connect` has joined to a cluster."""
    import ray

    return ray


def start_actors(blueprint: ShardSpec) -> Callable[[Sequence[int]], WorkerLink]:
    """Return a function that starts a worker, see `WorkerGroup`."""
    return lambda numbers: RayLink(ShardHost, blueprint, tuple(numbers))
