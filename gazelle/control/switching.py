"""A switch between controllers, and what stands against it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Protocol, TypeVar

from gazelle.control.hardware import ControllerInfo, RobotHardware, SwitchResult


class Startable(Protocol):
    """A controller that is to be started."""

    state: str

    @property
    def info(self) -> ControllerInfo:
        """As the robot's side sees it."""


S = TypeVar("S", bound=Startable)


@dataclass(slots=True)
class Switch:
    """A switch: what was stopped, and what is started when the robot is ready.

    Attributes:
        start: Names of what is started.
        stop: Names of what was stopped.
        asap: Whether each is started as soon as its own joints have switched.
        timeout: How long the robot may take [s]; 0 for ever.
        begun_ns: When it began [ns].
        waiting: Names of what is still to be started.
        failed: Names of controllers that were aborted, as the robot did not switch.
    """

    start: tuple[str, ...]
    stop: tuple[str, ...]
    asap: bool
    timeout: float
    begun_ns: int
    waiting: set[str] = field(init=False)
    failed: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        """All is still to be started."""
        self.waiting = set(self.start)

    @property
    def done(self) -> bool:
        """Whether nothing is left to do."""
        return not self.waiting

    def advance(
        self,
        hardware: RobotHardware,
        entries: Sequence[S],
        now_ns: int,
        start: Callable[[S], None],
    ) -> None:
        """Start what the robot is ready for; abort what it will not be ready for."""
        late = 0.0 < self.timeout < (now_ns - self.begun_ns) * 1e-9
        whole = hardware.switch_result()
        for entry in entries:
            info = entry.info
            if info.name not in self.waiting:
                continue
            result = hardware.switch_result(info) if self.asap else whole
            if result is SwitchResult.ONGOING and not late:
                entry.state = "waiting"
                continue
            self.waiting.discard(info.name)
            if result is SwitchResult.DONE:
                start(entry)
            else:
                entry.state = "aborted"
                self.failed.add(info.name)


def conflict_of(controllers: Iterable[ControllerInfo]) -> str:
    """What two controllers, or one by two interfaces, would both command; empty for nothing."""
    claims: dict[str, list[str]] = {}
    for each in controllers:
        for resources in each.claimed.values():
            for resource in resources:
                claims.setdefault(resource, []).append(each.name)
    return "; ".join(
        f"resource conflict on [{resource}], controllers = [{', '.join(names)}]"
        for resource, names in sorted(claims.items())
        if len(names) > 1
    )
