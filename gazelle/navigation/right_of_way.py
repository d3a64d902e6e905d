"""Robots that wait for one another: the one of least priority yields.

Each robot plans by itself, and takes the others for obstacles. Where two meet in a corridor each finds
its way blocked by the other. So robots that stand are looked at together: robots on the path that
another one would go, were it alone. Of those that hang together the first by priority continues, and the
others wait; those on its path first go to the nearest place beside it, backwards if they have to.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Protocol

import numpy as np

from gazelle.array_types import Floats
from gazelle.description.occupancy import OccupancyMap
from gazelle.navigation.following import Pose2
from gazelle.navigation.waiting_places import RobotDisc, WaitingPlaceMap
from gazelle_ros.base.parameter_values import Values, fields_of

_PERIOD: Final = 0.5
"""Between two looks at all robots [s]."""
_MOVED: Final = 0.3
"""A robot that stays within it stands [m]."""
_MOST_ENCOUNTERS: Final = 12
"""For one goal of a robot; then it is left to ``move_base``, which gives up at last."""
_STUCK: Final = 20.0
"""Time that a robot may be stuck before its waiting place, until others stop waiting for it [s]."""
_BESIDE: Final = 0.8
"""Distance of other moving robots that keeps a robot in its waiting place [m]."""
_RETRY: Final = 3.0
"""After a check of robots that cannot yield [s]."""


@dataclass(frozen=True, slots=True)
class RightOfWaySettings:
    """Parameters below ``right_of_way``.

    Attributes:
        enabled: Whether the robot yields, and others yield to it.
        priority: The greater one goes first; among equals the first by name.
        patience: Time blocked before acting [s].
    """

    enabled: bool = False
    priority: float = 0.0
    patience: float = 4.0

    @classmethod
    def read(cls, values: Values) -> RightOfWaySettings:
        """Read the parameters of ``move_base``.

        Raises:
            Error: One is of the wrong kind.
        """
        own = values.get("right_of_way", {})
        return cls(**fields_of(cls, own if isinstance(own, Mapping) else {}))


class NavigatingRobot(Protocol):
    """A robot with a goal.

    Attributes:
        name: Of the robot.
        right_of_way: Its settings.
        aside: Whether it stands where it was sent aside.
    """

    name: str
    right_of_way: RightOfWaySettings

    aside: bool

    @property
    def goal(self) -> Pose2 | None:
        """Goal of its own, even while it yields; None without one."""

    @property
    def grid(self) -> OccupancyMap | None:
        """Map of the robot; None before the first scan of one that is made."""

    @property
    def body(self) -> RobotDisc | None:
        """Footprint at the last known position; None before."""

    def stand(self) -> None:
        """Wait."""

    def step_aside(self, x: float, y: float, time: float) -> None:
        """Move to a place and wait there."""

    def go_on(self, time: float, known: WaitingPlaceMap, others: Sequence[RobotDisc]) -> None:
        """Resume its own goal, and clear observations of neither the map nor other robots."""


@dataclass(slots=True)
class _Watch:
    """Since when a robot stands, and where."""

    place: tuple[float, float]
    since: float
    goal: Pose2 | None
    encounters: int = 0


@dataclass(slots=True)
class _Waiting:
    """A robot that waits until another one has passed.

    Attributes:
        robot: Robot that waits.
        goal: Its own; with another one it is its own master again.
        waiting_place: Place to wait; None if it obstructs nothing.
        until: Distance that the other one has to advance on its path [m].
    """

    robot: NavigatingRobot
    goal: Pose2 | None
    waiting_place: RobotDisc | None
    until: float


@dataclass(slots=True)
class _Encounter:
    """A robot that others yield to.

    Attributes:
        leader: Robot that others yield to.
        goal: Its goal.
        path: Its path, shape (n, 2) [m].
        along: Distance along it of each point, shape (n,) [m].
        waiting: The others.
        begun: Start of the others' yielding [s].
        involved: Names of all robots still involved.
        under_way: Whether the leader has set off.
    """

    leader: NavigatingRobot
    goal: Pose2 | None
    path: Floats
    along: Floats
    waiting: list[_Waiting]
    begun: float
    involved: list[str]
    under_way: bool = False


class RightOfWay:
    """Sees that robots of one world do not wait for one another for ever.

    Attributes:
        due: Time of the next check of all robots [s].
    """

    def __init__(self) -> None:
        self.due = -math.inf
        self._watches: dict[str, _Watch] = {}
        self._encounters: list[_Encounter] = []
        self._present: Sequence[NavigatingRobot] = ()
        self._maps: dict[int, tuple[OccupancyMap, WaitingPlaceMap]] = {}

    def update(self, time: float, robots: Sequence[NavigatingRobot]) -> None:
        """Update all robots, when it is due.

        Args:
            time: Now [s].
            robots: The robots; those without a goal stand where they are.
        """
        self.due = time + _PERIOD
        ordered = sorted(robots, key=lambda each: (-each.right_of_way.priority, each.name))
        self._present = ordered
        for each in ordered:
            self._watch(time, each)
        self._encounters = [each for each in self._encounters if self._go_on(time, each, ordered)]
        met = {name for encounter in self._encounters for name in encounter.involved}
        free = [each for each in ordered if each.name not in met]
        if sum(self._stands(time, each) for each in free) > 1:
            self._meet(time, free, ordered)

    # Standing robots ---------------------------------------------------------------------------

    def _watch(self, time: float, robot: NavigatingRobot) -> None:
        body = robot.body
        if body is None:
            return
        here, watch = (body.x, body.y), self._watches.get(robot.name)
        if watch is None or watch.goal != robot.goal:
            self._watches[robot.name] = _Watch(here, time, robot.goal)
        elif math.dist(here, watch.place) > _MOVED:
            watch.place, watch.since = here, time

    def _stands(self, time: float, robot: NavigatingRobot) -> bool:
        """Return whether a robot has a goal but makes no progress."""
        watch = self._watches.get(robot.name)
        return (
            watch is not None
            and robot.goal is not None
            and watch.encounters < _MOST_ENCOUNTERS
            and time - watch.since >= robot.right_of_way.patience
        )

    def _map(self, grid: OccupancyMap) -> WaitingPlaceMap:
        """Return the map of a grid, made once for each."""
        found = self._maps.get(id(grid))
        if found is None or found[0] is not grid:
            found = self._maps[id(grid)] = grid, WaitingPlaceMap(grid)
        return found[1]

    # Waiting relations -------------------------------------------------------------------

    def _meet(
        self, time: float, free: Sequence[NavigatingRobot], robots: Sequence[NavigatingRobot]
    ) -> None:
        """Resume the first robot of a group that blocks itself."""
        standing = [each for each in free if self._stands(time, each)]
        paths = {each.name: self._path_of(each) for each in standing}
        groups = [{each.name} for each in standing]
        for each in standing:
            for other in standing:
                if each is not other and _blocks(other, each, paths[each.name]) is not None:
                    joined = [group for group in groups if group & {each.name, other.name}]
                    groups = [group for group in groups if group not in joined]
                    groups.append(set().union(*joined))
        for group in groups:
            members = [each for each in standing if each.name in group]
            if len(members) > 1 and not any(
                self._begin(time, leader, paths[leader.name], members, robots) for leader in members
            ):
                for each in members:
                    self._watches[each.name].since += _RETRY

    def _path_of(self, robot: NavigatingRobot) -> Floats:
        goal, grid, body = robot.goal, robot.grid, robot.body
        if goal is None or grid is None or body is None:
            return np.zeros((0, 2))
        return self._map(grid).path(body, goal)

    def _begin(
        self,
        time: float,
        leader: NavigatingRobot,
        path: Floats,
        members: Sequence[NavigatingRobot],
        robots: Sequence[NavigatingRobot],
    ) -> bool:
        """Start an encounter: others yield to one, if there is room."""
        reached = {each.name: _blocks(each, leader, path) for each in members}
        # The nearest chooses first: one behind it can go farther back.
        obstructing = sorted(
            (each for each in members if reached[each.name] is not None),
            key=lambda each: reached[each.name] or 0,
        )
        along = np.append(0.0, np.hypot(*np.diff(path, axis=0).T).cumsum())
        moving = {leader.name, *(each.name for each in obstructing)}
        fixed = [e.body for e in robots if e.name not in moving and e.body is not None]
        waiting = self._steps_aside(leader, path, along, obstructing, fixed)
        if not waiting:
            return False
        waiting += [
            _Waiting(each, each.goal, None, math.inf) for each in members if each.name not in moving
        ]
        involved = [each.name for each in members]
        for name in involved:
            self._watches[name].encounters += 1
        leader.stand()
        for one in waiting:
            one.robot.stand()
            if one.waiting_place is not None:
                one.robot.step_aside(one.waiting_place.x, one.waiting_place.y, time)
        self._encounters.append(
            _Encounter(leader, leader.goal, path, along, waiting, time, involved)
        )
        return True

    def _steps_aside(
        self,
        leader: NavigatingRobot,
        path: Floats,
        along: Floats,
        obstructing: Sequence[NavigatingRobot],
        fixed: Sequence[RobotDisc],
    ) -> list[_Waiting]:
        """Return waiting places for the robots on a leader's path; empty if one of them has none."""
        first, found = leader.body, list[_Waiting]()
        taken: list[RobotDisc] = []
        for each in obstructing:
            body, grid = each.body, each.grid
            if first is None or body is None or grid is None:
                return []
            place = self._map(grid).waiting_place(body, first, path, fixed, taken)
            if place is None:
                return []
            taken.append(place)
            near = int(np.hypot(*(path - (place.x, place.y)).T).argmin())
            until = min(float(along[near]) + place.apart(first), float(along[-1]))
            found.append(_Waiting(each, each.goal, place, until))
        return found

    # Continuing ---------------------------------------------------------------------------

    def _go_on(self, time: float, met: _Encounter, present: Sequence[NavigatingRobot]) -> bool:
        """Advance an encounter; returns whether it lasts."""
        met.waiting = [
            each for each in met.waiting if each.robot in present and each.robot.goal == each.goal
        ]
        leader, body = met.leader, met.leader.body
        if leader not in present or leader.goal != met.goal or body is None:
            return self._end(time, met)
        if not met.under_way:
            going = [each for each in met.waiting if each.waiting_place and not each.robot.aside]
            since = [self._watches[each.robot.name].since for each in going]
            if not going or time - max(met.begun, *since) > _STUCK:
                self._send(time, leader)
                met.under_way = True
                self._watches[leader.name].since = time
            return True
        come = float(met.along[int(np.hypot(*(met.path - (body.x, body.y)).T).argmin())])
        for each in list(met.waiting):
            if come < each.until or self._is_passed_by(time, each.robot, present):
                continue
            met.waiting.remove(each)
            self._send(time, each.robot)
            met.involved.remove(each.robot.name)
        late = time - self._watches[leader.name].since > 2.0 * leader.right_of_way.patience
        if late or not any(each.waiting_place is not None for each in met.waiting):
            return self._end(time, met)
        return True

    def _send(self, time: float, robot: NavigatingRobot) -> None:
        if robot.grid is not None:
            others = [e.body for e in self._present if e is not robot and e.body is not None]
            robot.go_on(time, self._map(robot.grid), others)

    def _is_passed_by(
        self, time: float, robot: NavigatingRobot, present: Sequence[NavigatingRobot]
    ) -> bool:
        """Return whether a robot should wait for a moving one beside it."""
        body = robot.body
        for each in present:
            other, watch = each.body, self._watches.get(each.name)
            if each is robot or body is None or other is None or watch is None:
                continue
            moves = each.goal is not None and time - watch.since < each.right_of_way.patience
            near = math.dist((body.x, body.y), (other.x, other.y)) < body.apart(other) + _BESIDE
            if moves and near:
                return True
        return False

    def _end(self, time: float, met: _Encounter) -> bool:
        """End an encounter: all continue."""
        if not met.under_way and met.leader.goal == met.goal:
            self._send(time, met.leader)
        for each in met.waiting:
            self._send(time, each.robot)
        for name in met.involved:
            if name in self._watches:
                self._watches[name].since = time
        return False


def _blocks(other: NavigatingRobot, robot: NavigatingRobot, path: Floats) -> int | None:
    """Return the index of the path point that another robot blocks; None if it is beside or behind."""
    body, own = other.body, robot.body
    if body is None or own is None or not len(path):
        return None
    away = np.hypot(*(path - (body.x, body.y)).T)
    nearest = int(away.argmin())
    near = away[nearest] < body.circumscribed + own.circumscribed
    return nearest if near and nearest > 0 else None
