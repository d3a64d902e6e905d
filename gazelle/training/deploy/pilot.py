"""Control loop of a deployed policy: its actions within safety limits, without ROS.

Times are those of the node's clock in seconds, which may be simulated and may jump back.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass

from gazelle.argument_checks import checked
from gazelle.errors import TaskError
from gazelle.training.deploy.goals import GoalPlace, GoalResult
from gazelle.training.deploy.policies import Decision, Policy
from gazelle.training.deploy.safety import STAND, SafetyLimits, VelocityCommand, lost, unusable
from gazelle.training.deploy.sensing import (
    Observer,
    OdometryReading,
    ScanReading,
    distance_to_goal,
)

_EARLY = 0.75  # share of the control period after which a new scan is acted on
_SPEED_CHANGE = 1e-9


@dataclass(frozen=True, slots=True)
class PolicyStep:
    """One act of the policy."""

    decision: Decision
    """Decision of the policy."""
    gain: float
    """Approach of the robot to the goal since the act before [m]."""
    score: float
    """Sum of those since the goal was set [m]."""


@dataclass(frozen=True, slots=True)
class PilotOutput:
    """Output of the pilot at one moment."""

    command: VelocityCommand
    """Command to the robot."""
    active: bool
    """True if the pilot is in control; if not, others may drive."""
    policy_command: VelocityCommand = STAND
    """Command of the policy."""
    reason: str | None = None
    """Why the command is not what the policy wants; None where it is."""
    acted: PolicyStep | None = None
    """Set where the policy acted at this moment."""
    ended: GoalResult | None = None
    """Set where a goal came to its end at this moment."""


@checked(TaskError, after=True)
class Pilot:
    """Follows a policy to one goal after another.

    Readings may hold NaN, which stops the robot; times are finite.

    Args:
        policy: Acts.
        limits: Limits of the robot.
        turned: Yaw of the lidar on the robot, to the left [rad].
        time_limit: For each goal [s]; None for that of the contract, which may be none.

    Attributes:
        armed: Whether it may drive.
        goal: Its goal; None where it has nothing to do.
        waiting: Goals that follow.
        outcomes: Counts of outcomes.
    """

    def __init__(
        self,
        policy: Policy,
        limits: SafetyLimits,
        *,
        turned: float = 0.0,
        time_limit: float | None = None,
    ) -> None:
        self.policy = policy
        self.limits = limits
        self.armed = False
        self.goal: GoalPlace | None = None
        self.waiting: deque[GoalPlace] = deque()
        self.outcomes: list[GoalResult] = []
        contract = policy.contract
        self._observer = Observer(contract, turned=turned)
        self._turned = turned
        self._period = contract.control_period or 0.0
        self._reach = contract.goal_distance or 0.2
        limit = contract.time_limit if time_limit is None else time_limit
        self._time_limit = math.inf if limit is None else limit
        self._scan: tuple[float, ScanReading] | None = None
        self._odometry: tuple[float, OdometryReading] | None = None
        self._now = -math.inf
        self._began: float | None = None
        self._distance: float | None = None
        self._score = 0.0
        self._policy_command = STAND
        self._acted_at = -math.inf
        self._fresh = self._touching = False

    # Messages received -------------------------------------------------------------------------

    def set_scan(self, scan: ScanReading, now: float) -> None:
        """Store a scan."""
        self._scan = (_moment(now), scan)
        self._fresh = True

    def set_odometry(self, odometry: OdometryReading, now: float) -> None:
        """Store odometry, in the frame of the goals."""
        self._odometry = (_moment(now), odometry)

    @checked(TaskError)
    def go_to(self, goals: Iterable[GoalPlace], now: float) -> GoalResult | None:
        """Set these goals; returns the result of the previous one, if there is one."""
        ended = None if self.goal is None else self._end("replaced", now)
        self.waiting = deque(goals)
        self._next_goal()
        return ended

    def arm(self, now: float) -> str | None:
        """Arm the robot; returns the reason if it cannot be armed, or None."""
        fault = self._blind(_moment(now))
        if fault is None:
            self.armed = True
            self._halt()
        return fault

    def disarm(self) -> None:
        """Stop the robot until it is armed again."""
        self.armed = False
        self._halt()

    # What is done --------------------------------------------------------------------------

    def tick(self, now: float, place: tuple[float, float] | None) -> PilotOutput:
        """Return the command of this moment.

        Args:
            now: Time [s].
            place: Of the goal in the frame of the odometry [m]; None or NaN where that is not known.
        """
        if _moment(now) < self._now - _SPEED_CHANGE:
            # Time started again: earlier messages are of another run.
            self._scan = self._odometry = None
            self._halt()
        self._now = now
        if not self.armed or self.goal is None:
            return PilotOutput(STAND, active=False)
        if self._began is None:
            self._began = now
        fault = self._blind(now)
        if fault is None and (place is None or not all(map(math.isfinite, place))):
            fault = f"no transform from the goal's frame '{self.goal.frame}'"
        if fault is not None or place is None or self._scan is None or self._odometry is None:
            last, self._policy_command = self._policy_command, STAND
            self._acted_at = -math.inf
            return PilotOutput(STAND, active=True, policy_command=last, reason=fault)
        return self._drive(now, place, self._scan[1], self._odometry[1])

    def _drive(
        self, now: float, place: tuple[float, float], scan: ScanReading, odometry: OdometryReading
    ) -> PilotOutput:
        """Act if it is due, and keep within the limits."""
        acted = None
        if self._fresh and now - self._acted_at >= _EARLY * self._period:
            self._fresh = False
            ended = self._judge(now, place, scan, odometry)
            if ended is not None:
                # What follows is another goal, or nothing to do.
                return PilotOutput(STAND, active=self.goal is not None, ended=ended)
            acted = self._act(now, place, scan, odometry)
        command = self.limits.limited(self._policy_command)
        reason = None if command == self._policy_command else "limit"
        nearest = self.limits.blocked(command, scan, turned=self._turned)
        if nearest is not None:
            command, reason = VelocityCommand(0.0, command.angular), f"obstacle at {nearest:.2f} m"
        return PilotOutput(
            command, active=True, policy_command=self._policy_command, reason=reason, acted=acted
        )

    def _act(
        self, now: float, place: tuple[float, float], scan: ScanReading, odometry: OdometryReading
    ) -> PolicyStep:
        decision = self.policy.decide(self._observer.observe(scan, odometry, place))
        distance = distance_to_goal(odometry, place)
        gain = 0.0 if self._distance is None else self._distance - distance
        self._score += gain
        self._distance, self._acted_at, self._policy_command = distance, now, decision.command
        return PolicyStep(decision, gain, self._score)

    def _judge(
        self, now: float, place: tuple[float, float], scan: ScanReading, odometry: OdometryReading
    ) -> GoalResult | None:
        """Return the result of the goal if it has ended, else None."""
        distance = distance_to_goal(odometry, place)
        began = now if self._began is None else self._began
        crashed = self._crashes(scan)
        self._distance = distance if self._distance is None else self._distance
        if round(distance, 2) < self._reach:
            return self._end("reached", now, distance)
        if crashed:
            return self._end("collision", now, distance)
        if now - began > self._time_limit:
            return self._end("time-out", now, distance)
        return None

    def _crashes(self, scan: ScanReading) -> bool:
        """Return whether an obstacle has newly come within the collision range."""
        least = self.policy.contract.collision_range
        ranges = scan.ranges[scan.measured()]
        touching = least is not None and len(ranges) > 0 and float(ranges.min()) < least
        crashed, self._touching = touching and not self._touching, touching
        return crashed

    def _end(self, outcome: str, now: float, distance: float | None = None) -> GoalResult:
        began = now if self._began is None else self._began
        goal = GoalPlace(0.0, 0.0) if self.goal is None else self.goal
        far = self._distance if distance is None else distance
        ended = GoalResult(goal, outcome, now - began, math.nan if far is None else far)
        self.outcomes.append(ended)
        self._next_goal()
        return ended

    def _next_goal(self) -> None:
        self.goal = self.waiting.popleft() if self.waiting else None
        self._halt()

    def _halt(self) -> None:
        """Set a zero command, and discard the history of actions."""
        self._policy_command = STAND
        self._acted_at = -math.inf
        self._began = self._distance = None
        self._score = 0.0
        self._fresh = self._scan is not None

    def _blind(self, now: float) -> str | None:
        """Return the missing input that prevents driving; None if nothing is missing."""
        if self._scan is None:
            return "no scan yet"
        if self._odometry is None:
            return "no odometry yet"
        if now - self._scan[0] > self.limits.scan_timeout:
            return "scan lost"
        if now - self._odometry[0] > self.limits.odometry_timeout:
            return "odometry lost"
        return unusable(self._scan[1]) or lost(self._odometry[1])


def _moment(now: float) -> float:
    """Return a time: NaN is later than no timeout.

    Raises:
        TaskError: It is not a finite number.
    """
    if not math.isfinite(now):
        raise TaskError(f"the time must be a finite number of seconds, not {now!r:.60}")
    return now
