"""Applied wrenches on links and efforts on joints, with a beginning and an end.

A load acts from its start for its duration, both on simulated time; the physics is stepped
from one beginning or end to the next. Several on one link or joint add up.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.engines import Engine
from gazelle.engines.limits import NANOSECONDS
from gazelle.errors import SimulationError
from gazelle.rotations import cross, rotate
from gazelle.simulation.clock import Clock
from gazelle.simulation.inputs import LONGEST_RUN, number


@dataclass(slots=True, eq=False)
class TimedWrench:
    """A wrench on a link, shapes (nworld, 3), zero in worlds that it does not act in.

    Attributes:
        target: Scoped name of the link.
        start_ns: Its start.
        end_ns: Its end; None for never.
        force: In the axes of the frame [N].
        torque: In the axes of the frame [N m].
        point: Point of action, in the frame [m]; None for the centre of mass.
        frame: Scoped name of the link in whose axes it is expressed; empty for the world.
        follow: Whether it turns with that link, or keeps the direction that it began with.
        held: Force and torque about the centre of mass in the world frame, once it has begun.
    """

    target: str
    start_ns: int
    end_ns: int | None
    force: Floats
    torque: Floats
    point: Floats | None
    frame: str
    follow: bool
    held: tuple[Floats, Floats] | None = None

    def resolve(self, engine: Engine) -> tuple[Floats, Floats]:
        """Return the force and torque about the centre of mass, in the world frame, now."""
        if self.held is not None and not self.follow:
            return self.held
        force, torque, point = self.force, self.torque, self.point
        if self.frame:
            place = engine.links[self.frame].placement()
            force, torque = rotate(place.quaternion, force), rotate(place.quaternion, torque)
            if point is not None:
                point = place.position + rotate(place.quaternion, point)
        if point is not None:
            torque = torque + cross(point - engine.links[self.target].centre(), force)
        self.held = (force, torque)
        return self.held


@dataclass(slots=True, eq=False)
class TimedEffort:
    """An effort on a joint, shape (nworld, axes), zero in worlds that it does not act in."""

    target: str
    start_ns: int
    end_ns: int | None
    effort: Floats


@dataclass(slots=True, eq=False)
class _Joint:
    """Loads on a joint besides timed efforts, while there are some."""

    lasting: Floats
    efforts: list[TimedEffort] = field(default_factory=list)


class AppliedWrenches:
    """All timed forces of a run.

    Args:
        engine: Pushes.
        clock: Knows the time.
    """

    def __init__(self, engine: Engine, clock: Clock) -> None:
        self._engine = engine
        self._clock = clock
        self._wrenches: list[TimedWrench] = []
        self._held: dict[tuple[str, str], tuple[Floats, Floats]] = {}
        self._joints: dict[str, _Joint] = {}
        self._due_ns: int | None = None
        self._follows = False

    # -- beginning ---------------------------------------------------------------------

    def push(
        self,
        link: str,
        force: ArrayLike,
        torque: ArrayLike,
        *,
        point: ArrayLike | None = None,
        frame: str = "",
        follow: bool = False,
        start: float | None = None,
        duration: float | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        """Apply a wrench to a link; see ``LinkHandle.apply_wrench``."""
        # What cannot be pushed is an error now, not when it begins.
        self._push_links([link], self._clock.now_ns)
        if frame:
            self._engine.links[frame].placement()
        start_ns, end_ns = self._span(start, duration)
        self._wrenches.append(
            TimedWrench(
                link,
                start_ns,
                end_ns,
                self._rows(force, 3, worlds),
                self._rows(torque, 3, worlds),
                None if point is None else self._rows(point, 3, worlds),
                frame,
                follow,
            )
        )
        self._schedule()

    def hold(self, name: str, link: str, force: Floats, torque: Floats) -> None:
        """Apply a wrench to a link until the same name sets another; for plugins.

        Args:
            name: Owner of the wrench; with ``model::`` in it if it ends with that model.
            link: Scoped name.
            force: At the centre of mass, in the world frame [N], shape (nworld, 3).
            torque: In the world frame [N m], shape (nworld, 3).
        """
        self._held[name, link] = (self._rows(force, 3, None), self._rows(torque, 3, None))
        self._push_links([link], self._clock.now_ns)

    def turn(
        self,
        joint: str,
        effort: ArrayLike,
        start: float | None = None,
        duration: float | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        """Apply an effort to a joint for a time; see ``JointHandle.apply_effort``."""
        lasting = self._engine.joints[joint].effort()
        known = self._joints.setdefault(joint, _Joint(lasting))
        start_ns, end_ns = self._span(start, duration)
        rows = self._rows(effort, lasting.shape[1], worlds)
        known.efforts.append(TimedEffort(joint, start_ns, end_ns, rows))
        self._schedule()

    def turns(self, joints: Iterable[str]) -> bool:
        """Return whether a timed effort is acting or scheduled on one of some joints."""
        return bool(self._joints) and any(joint in self._joints for joint in joints)

    @property
    def turned(self) -> tuple[str, ...]:
        """Scoped names of the joints on which timed efforts act, or wait."""
        return tuple(self._joints)

    def set_lasting(self, joint: str, effort: Floats, worlds: Worlds | None = None) -> None:
        """Set the effort that acts on a joint besides the timed ones."""
        known = self._joints.get(joint)
        if known is None:
            self._engine.joints[joint].set_effort(effort, worlds)
        else:
            known.lasting[slice(None) if worlds is None else worlds] = effort
            self._turn_joint(joint, known)

    def _span(self, start: float | None, duration: float | None) -> tuple[int, int | None]:
        now = self._clock.now_ns
        start = None if start is None else number("the start of a force", start)
        duration = None if duration is None else number("the duration of a force", duration)
        if start is not None and not math.isfinite(start):
            raise SimulationError(f"the start of a force must be finite, not {start}")
        if start is not None and abs(start) > LONGEST_RUN:
            raise SimulationError(f"a force cannot start at {start:g} s, {LONGEST_RUN:g} s at most")
        begin = now if start is None else max(now, round(start * NANOSECONDS))
        if duration is None or duration > LONGEST_RUN:
            return begin, None
        if not duration >= 0.0:
            raise SimulationError(f"the duration of a force must not be {duration} s")
        return begin, begin + round(duration * NANOSECONDS)

    def _rows(self, values: ArrayLike, width: int, worlds: Worlds | None) -> Floats:
        """Return values of all worlds, zero in those not chosen."""
        rows = np.zeros((self._engine.nworld, width))
        rows[slice(None) if worlds is None else worlds] = values
        if not np.isfinite(rows).all():
            raise SimulationError(f"a force must be finite, not {values!r}")
        return rows

    # -- acting ------------------------------------------------------------------------

    @property
    def any(self) -> bool:
        """True if any force is acting or scheduled."""
        return self._due_ns is not None or self._follows

    def update(self, now_ns: int) -> None:
        """Start and end wrenches and efforts that are due; called before every run of steps."""
        if self._due_ns is not None and now_ns >= self._due_ns:
            self._change(now_ns)
        elif self._follows:
            self._push_links({w.target for w in self._wrenches if w.follow}, now_ns)

    def steps_until(self, clock: Clock) -> int | None:
        """Return the physics steps until something starts or ends; None for never."""
        if self._follows:
            return 1
        if self._due_ns is None:
            return None
        return clock.steps_to(self._due_ns)

    def _change(self, now_ns: int) -> None:
        targets = {wrench.target for wrench in self._wrenches}
        self._wrenches = [w for w in self._wrenches if not _is_over(w, now_ns)]
        self._push_links(targets, now_ns)
        for name, joint in list(self._joints.items()):
            joint.efforts = [each for each in joint.efforts if not _is_over(each, now_ns)]
            self._turn_joint(name, joint)
            if not joint.efforts:
                del self._joints[name]
        self._schedule(after=now_ns)

    def _push_links(self, targets: Iterable[str], now_ns: int) -> None:
        for link in sorted(targets):
            force, torque = np.zeros((2, self._engine.nworld, 3))
            for (_, target), (held_force, held_torque) in self._held.items():
                if target == link:
                    force += held_force
                    torque += held_torque
            for wrench in self._wrenches:
                if wrench.target == link and wrench.start_ns <= now_ns:
                    held = wrench.resolve(self._engine)
                    force += held[0]
                    torque += held[1]
            self._engine.links[link].set_wrench(force, torque)

    def _turn_joint(self, name: str, joint: _Joint) -> None:
        now_ns = self._clock.now_ns
        acting = [e.effort for e in joint.efforts if e.start_ns <= now_ns < _end(e)]
        self._engine.joints[name].set_effort(sum(acting, joint.lasting))

    def _schedule(self, after: int | None = None) -> None:
        """Find the next beginning or end."""
        loads: list[TimedWrench | TimedEffort] = [*self._wrenches]
        loads += [e for j in self._joints.values() for e in j.efforts]
        moments = [load.start_ns for load in loads]
        moments += [load.end_ns for load in loads if load.end_ns is not None]
        coming = [m for m in moments if after is None or m > after]
        self._due_ns = min(coming, default=None)
        self._follows = any(w.follow for w in self._wrenches)

    # -- ending ------------------------------------------------------------------------

    def clear_link(self, link: str) -> None:
        """Remove all wrenches from a link except those that plugins hold."""
        self._wrenches = [w for w in self._wrenches if w.target != link]
        self._push_links([link], self._clock.now_ns)
        self._schedule()

    def clear_joint(self, joint: str) -> None:
        """Remove all efforts from a joint, the lasting one too."""
        self._joints.pop(joint, None)
        self._engine.joints[joint].set_effort(np.zeros_like(self._engine.joints[joint].effort()))
        self._schedule()

    def forget(self, model: str) -> None:
        """Remove what acts on, or is given in a frame of, a deleted model."""
        inside, now_ns = f"{model}::", self._clock.now_ns
        for wrench in [w for w in self._wrenches if w.frame.startswith(inside)]:
            self._wrenches.remove(wrench)
            self._push_links([wrench.target], self._clock.now_ns)
        self._wrenches = [w for w in self._wrenches if not w.target.startswith(inside)]
        # What a plugin of the model holds of others ends too: its name has the model's in it.
        gone = [key for key in self._held if key[1].startswith(inside) or f" {inside}" in key[0]]
        for key in gone:
            del self._held[key]
        self._push_links({link for _, link in gone if not link.startswith(inside)}, now_ns)
        self._joints = {n: j for n, j in self._joints.items() if not n.startswith(inside)}
        self._schedule()

    def reset(self, worlds: Worlds | None) -> None:
        """Remove everything in these worlds, as the engine's reset does with what acts now."""
        if not (self._wrenches or self._joints or self._held):
            return
        if worlds is None:
            self._wrenches, self._joints, self._held = [], {}, {}
        for wrench in self._wrenches:
            for rows in (wrench.force, wrench.torque, *(wrench.held or ())):
                rows[worlds] = 0.0
        for held in self._held.values():
            for rows in held:
                rows[worlds] = 0.0
        for joint in self._joints.values():
            for rows in (joint.lasting, *(e.effort for e in joint.efforts)):
                rows[worlds] = 0.0
        self._schedule()

    # -- saving ------------------------------------------------------------------------

    def state(self) -> dict[str, Any]:
        """Return all active and pending wrenches and efforts, in plain lists and arrays."""
        wrenches = [
            {name: getattr(wrench, name) for name in TimedWrench.__slots__}
            for wrench in self._wrenches
        ]
        joints = {
            name: {
                "lasting": joint.lasting,
                "efforts": [(e.start_ns, e.end_ns, e.effort) for e in joint.efforts],
            }
            for name, joint in self._joints.items()
        }
        held = [(*key, *wrench) for key, wrench in self._held.items()]
        return {"wrenches": wrenches, "joints": joints, "held": held}

    def restore(self, state: dict[str, Any]) -> None:
        """Restore what ``state`` returned; what acts is in the engine's state."""
        self._wrenches = [TimedWrench(**each) for each in state["wrenches"]]
        self._joints = {
            name: _Joint(
                each["lasting"], [TimedEffort(name, *effort) for effort in each["efforts"]]
            )
            for name, each in state["joints"].items()
        }
        self._held = {(name, link): (f, t) for name, link, f, t in state["held"]}
        # What began before the snapshot acts already; beginning it once more changes nothing.
        self._schedule()


def _end(load: TimedWrench | TimedEffort) -> float:
    return math.inf if load.end_ns is None else load.end_ns


def _is_over(load: TimedWrench | TimedEffort, now_ns: int) -> bool:
    return now_ns >= _end(load)
