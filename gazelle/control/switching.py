"""Controller switches, and the reasons that prevent them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from gazelle.argument_checks import checked
from gazelle.control.control_law import ControlLaw
from gazelle.control.controller import Controller, law_of
from gazelle.control.hardware import ControllerInfo, RobotHardware, SwitchResult
from gazelle.errors import ControlError, did_you_mean


@dataclass(slots=True)
class LoadedController:
    """A controller of a manager.

    Attributes:
        controller: The law.
        state: ``initialized``, ``running``, ``stopped``, ``waiting`` or ``aborted``.
        law: Its native code; None where Python has to update it.
    """

    controller: Controller
    state: str = "initialized"
    law: ControlLaw | None = field(init=False)

    def __post_init__(self) -> None:
        """Look up native code, once."""
        self.law = law_of(self.controller)

    @property
    def info(self) -> ControllerInfo:
        """Information in the form of the robot's side."""
        own = self.controller
        return ControllerInfo(own.name, own.type, dict(own.claimed))


@checked(ControlError)
@dataclass(slots=True)
class Switch:
    """A controller switch: stopped controllers, and those to start when the robot is ready.

    Attributes:
        start: Names of what is started.
        stop: Names of what was stopped.
        asap: Whether each is started as soon as its own joints have switched.
        timeout: Longest time [s]; 0 for no limit.
        begun_ns: Time of its start [ns].
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
        """Mark all controllers as still to be started."""
        self.waiting = set(self.start)

    @property
    def done(self) -> bool:
        """True if nothing is left to do."""
        return not self.waiting

    def advance(
        self,
        hardware: RobotHardware,
        entries: Sequence[LoadedController],
        now_ns: int,
        start: Callable[[LoadedController], None],
    ) -> None:
        """Start the controllers that the robot is ready for; abort those that it cannot become ready for."""
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
    """Describe resources claimed by two controllers, or twice by one; empty if there are none."""
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


def planned(
    loaded: Mapping[str, LoadedController],
    start: Sequence[str],
    stop: Sequence[str],
    *,
    strict: bool,
) -> tuple[list[str], list[str]]:
    """Return the controllers that a switch starts and those it stops.

    Args:
        loaded: All controllers by name.
        start: Requested names.
        stop: Likewise.
        strict: Whether a name that cannot be stopped or started is an error; else it is passed over.

    Raises:
        ControlError: It is invalid.
    """
    stopping = _possible(loaded, stop, (), strict=strict, running=True)
    starting = _possible(loaded, start, stopping, strict=strict, running=False)
    both = [name for name in starting if name in stopping]
    if both:
        raise ControlError(
            f"controller '{both[0]}' is in both the list to start and the list to stop",
            hint="stop it, and start it in a second call",
        )
    after = [
        entry.info
        for name, entry in loaded.items()
        if name in starting or (entry.controller.running and name not in stopping)
    ]
    conflict = conflict_of(after)
    if starting and conflict:
        raise ControlError(f"could not switch controllers, due to resource conflict: {conflict}")
    return starting, stopping


def _possible(
    loaded: Mapping[str, LoadedController],
    names: Sequence[str],
    also: Sequence[str],
    *,
    strict: bool,
    running: bool,
) -> list[str]:
    """Return the names that are running, not running, or among some others."""
    found: list[str] = []
    for name in names:
        entry = loaded.get(name)
        if entry is not None and (entry.controller.running == running or name in also):
            if name not in found:
                found.append(name)
        elif strict:
            hint = did_you_mean(name, loaded) if entry is None else None
            raise ControlError(_why_not(name, running=running, known=entry is not None), hint=hint)
    return found


def _why_not(name: str, *, running: bool, known: bool) -> str:
    if not known:
        return (
            f"could not {'stop' if running else 'start'} controller with name '{name}' because no "
            "controller with this name exists"
        )
    if running:
        return f"could not stop controller with name '{name}' since it is not running"
    return f"controller '{name}' is already running"
