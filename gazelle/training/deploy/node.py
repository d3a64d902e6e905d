"""The node: receives scan, odometry and goals, runs the pilot, and commands the guard."""

from __future__ import annotations

import contextlib
import logging
import math
import threading
from collections.abc import Callable, Iterable
from pathlib import Path

from gazelle.argument_checks import checked
from gazelle.errors import TaskError
from gazelle.training.deploy.frames import GoalFrames
from gazelle.training.deploy.goals import GoalPlace, GoalResult
from gazelle.training.deploy.guarding import Guarded, GuardLostError
from gazelle.training.deploy.interventions import InterventionLog
from gazelle.training.deploy.messages import floats_message, goal_of, odometry_of, scan_of
from gazelle.training.deploy.pilot import Pilot, PilotOutput, PolicyStep
from gazelle.training.deploy.policies import Policy
from gazelle.training.deploy.safety import SafetyLimits
from gazelle_ros import MasterProxy, Node
from gazelle_ros.base.closing import Closeable
from gazelle_ros.errors import RosError
from gazelle_ros.msgs import geometry_msgs, nav_msgs, sensor_msgs, std_msgs, std_srvs

_LOG = logging.getLogger(__name__)

_TICK_S = 0.02
_CLOCK_LATE_S = 1.0
"""A stamp that is ahead of the clock by more is not of this time: the clock started again [s]."""
_MASTER_LOOK_S = 0.5
_MASTER_MISSES = 2
_FAREWELLS = 5


@checked(TaskError, after=True)
class DeployNode(Closeable):
    """A policy as a ROS 1 node.

    It stands still until it is armed: by the service ``~arm`` (``std_srvs/SetBool``), or by ``arm``.

    ======================================  ==================================================
    Name (relative ones can be remapped)    Meaning
    ======================================  ==================================================
    ``scan``, ``odom`` (in)                 sensor_msgs/LaserScan, nav_msgs/Odometry
    ``move_base_simple/goal`` (in)          geometry_msgs/PoseStamped; takes the place of all
                                            goals there are
    ``cmd_vel`` (out, by the guard)         geometry_msgs/Twist; silent while nothing is to do
    ``get_action`` (out)                    std_msgs/Float32MultiArray: action, score, reward
    ``result`` (out)                        std_msgs/Float32MultiArray: score, max_q, where a
                                            goal came to its end
    ``~status`` (out, latched)              std_msgs/String
    ``~arm`` (service)                      std_srvs/SetBool
    ======================================  ==================================================

    As there is no reward on a robot, ``reward`` is how much nearer to the goal it came in a step
    [m], and ``score`` the sum of those.

    Args:
        node: On the graph; it is closed with this.
        policy: Acts.
        limits: Limits of the robot.
        turned: Yaw of the lidar on the robot, to the left [rad].
        time_limit: For each goal [s]; None for that of the contract.
        log: File for the log of interventions.
        on_end: Called with the outcome of a goal, by the driving thread; it may give the next one.

    Raises:
        GuardLostError: The guard did not start.
        TaskError: The policy sees what no sensor gives, or the log cannot be written.
    """

    def __init__(
        self,
        node: Node,
        policy: Policy,
        limits: SafetyLimits,
        *,
        turned: float = 0.0,
        time_limit: float | None = None,
        log: Path | None = None,
        on_end: Callable[[GoalResult], None] | None = None,
    ) -> None:
        self.node = node
        self.pilot = Pilot(policy, limits, turned=turned, time_limit=time_limit)
        self.interventions = InterventionLog(log)
        self._on_end = on_end
        self._lock = threading.RLock()
        self._news = threading.Event()
        self._over = threading.Event()
        self._frame = ""
        self._frames = GoalFrames(node)
        self._best = 0.0
        self._score = 0.0
        self._last_cause = ""
        self._master_lost = False
        self._guard = _start_guard(node)
        self._connect()
        self._watch = threading.Thread(target=self._watch_master, daemon=True)
        self._watch.start()

    def arm(self) -> str | None:
        """Arm the robot; returns the reason if it cannot be armed, or None."""
        with self._lock:
            fault = "the master is lost" if self._master_lost else self.pilot.arm(self._now())
            if fault is None:
                self.interventions.note("armed", self._now())
            return fault

    def disarm(self, why: str = "on request") -> None:
        """Disarm and stop the robot."""
        with self._lock:
            if self.pilot.armed:
                self.pilot.disarm()
                _LOG.warning("disarmed: %s", why)
                self.interventions.note("disarmed", self._now(), reason=why)
        self._news.set()

    def go_to(self, goals: Iterable[GoalPlace]) -> None:
        """Set these goals, reached one after another, in place of earlier ones."""
        with self._lock:
            ended = self.pilot.go_to(goals, self._now())
            if ended is not None:
                self._publish_end(ended)
        self._news.set()

    def run(self, stop: threading.Event, *, arm: bool = False, until_done: bool = False) -> None:
        """Run until stopped, shut down, or until all goals are done.

        Args:
            stop: Stops the node.
            arm: Arm as soon as all sensors speak.
            until_done: Return when there is no goal left.

        Raises:
            GuardLostError: The guard is gone; the robot was stopped.
        """
        self.node.on_shutdown.append(lambda _: self._over.set())
        try:
            while not stop.is_set() and not self._over.is_set() and not self.node.closed:
                if arm and not self.pilot.armed and self.arm() is None:
                    arm = False
                self._step()
                if until_done and self.pilot.goal is None:
                    return
                self._news.wait(_TICK_S)
                self._news.clear()
        except GuardLostError:
            self._stop_without_guard()
            raise
        finally:
            self.disarm("the node ends")

    def close(self) -> None:
        """Stop the robot and the node; a second call does nothing."""
        self._over.set()
        self.pilot.disarm()
        self._guard.close()
        self.interventions.close()
        self.node.close()
        if self._watch is not threading.current_thread():
            self._watch.join()

    # Inner ---------------------------------------------------------------------------------

    def _connect(self) -> None:
        node = self.node
        floats = std_msgs.msg.Float32MultiArray
        self._actions = node.advertise("get_action", floats, 10)
        self._results = node.advertise("result", floats, 10)
        self._status = node.advertise("~status", std_msgs.msg.String, 1, latch=True)
        node.subscribe("scan", sensor_msgs.msg.LaserScan, self._on_scan, 1)
        node.subscribe("odom", nav_msgs.msg.Odometry, self._on_odometry, 1)
        goals = geometry_msgs.msg.PoseStamped
        node.subscribe("move_base_simple/goal", goals, lambda m: self.go_to([goal_of(m)]), 1)
        node.serve("~arm", std_srvs.srv.SetBool, self._serve_arm)

    def _now(self) -> float:
        return self.node.clock.now() * 1e-9

    def _measured_at(self, message: sensor_msgs.msg.LaserScan | nav_msgs.msg.Odometry) -> float:
        """Return the time of a reading [s].

        With simulated time it is the stamp, as all nodes share the clock; messages of /clock may
        arrive late. Else it is the time of arrival, as the clock of a robot may differ.
        """
        now, stamp = self._now(), message.header.stamp.to_sec()
        known = self.node.clock.simulated and 0.0 < stamp < now + _CLOCK_LATE_S
        return stamp if known else now

    def _on_scan(self, message: sensor_msgs.msg.LaserScan) -> None:
        reading = scan_of(message)
        with self._lock:
            self.pilot.set_scan(reading, self._measured_at(message))
        self._news.set()

    def _on_odometry(self, message: nav_msgs.msg.Odometry) -> None:
        reading = odometry_of(message)
        with self._lock:
            self._frame = message.header.frame_id.removeprefix("/")
            self.pilot.set_odometry(reading, self._measured_at(message))

    def _serve_arm(self, request: std_srvs.srv.SetBoolRequest) -> std_srvs.srv.SetBoolResponse:
        response = std_srvs.srv.SetBoolResponse()
        if not request.data:
            self.disarm()
            response.success, response.message = True, "disarmed"
            return response
        fault = self.arm()
        response.success, response.message = fault is None, fault or "armed"
        return response

    def _step(self) -> None:
        """Run the pilot once, and publish the results."""
        with self._lock:
            now, goal = self._now(), self.pilot.goal
            place = None if goal is None else self._frames.place(goal, self._frame)
            tick = self.pilot.tick(now, place)
            self.interventions.follow(tick, now)
        self._guard.order(tick.command, active=tick.active)
        if tick.acted is not None:
            self._publish_action(tick.acted)
        if tick.ended is not None:
            self._publish_end(tick.ended)
        self._publish_status(tick)

    def _publish_action(self, acted: PolicyStep) -> None:
        self._best = max(self._best, acted.decision.best_output)
        self._score = acted.score
        action = acted.decision.action
        names = ["action"] if len(action) == 1 else ["linear", "angular"]
        values = [*action, acted.score, acted.gain]
        self._actions.publish(floats_message([*names, "score", "reward"], values))

    def _publish_end(self, ended: GoalResult) -> None:
        _LOG.info("goal (%g, %g): %s", ended.goal.x, ended.goal.y, ended.outcome)
        self.interventions.note(
            "goal",
            self._now(),
            goal=[ended.goal.x, ended.goal.y],
            outcome=ended.outcome,
            seconds=round(ended.seconds, 3),
            distance=None if math.isnan(ended.distance) else round(ended.distance, 3),
        )
        self._results.publish(floats_message(["score", "max_q"], [self._score, self._best]))
        self._best = self._score = 0.0
        if self._on_end is not None:
            self._on_end(ended)

    def _publish_status(self, tick: PilotOutput) -> None:
        if not self.pilot.armed:
            text = "disarmed"
        elif not tick.active:
            text = "armed, no goal"
        else:
            text = "driving" if tick.reason is None else f"overruled: {tick.reason}"
        cause = text.partition(" at ")[0]
        if cause != self._last_cause:
            self._last_cause = cause
            self._status.publish(self._status.message_class(text))

    def _stop_without_guard(self) -> None:
        """Publish zero from here: the guard has ended."""
        kind = geometry_msgs.msg.Twist
        with contextlib.suppress(RosError):
            publisher = self.node.advertise("cmd_vel", kind, 1)
            for _ in range(_FAREWELLS):
                publisher.publish(kind())
                self._over.wait(0.1)

    def _watch_master(self) -> None:
        """Stop the robot without a master: it could not be disarmed the node."""
        proxy, missed = MasterProxy(self.node.master_uri, self.node.name), 0
        while not self._over.wait(_MASTER_LOOK_S) and not self.node.closed:
            try:
                proxy.get_pid()
                missed = 0
            except (RosError, OSError):
                missed += 1
            self._master_lost = missed >= _MASTER_MISSES
            if self._master_lost:
                self.disarm("the master is lost")
        proxy.close()


def _start_guard(node: Node) -> Guarded:
    options = {
        "name": f"{node.name}_guard",
        "master_uri": node.master_uri,
        "host": node.host,
    }
    return Guarded(options, node.resolve("cmd_vel"))
