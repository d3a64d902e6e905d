"""Send trajectories to a controller of ros_controllers, follow how they go, and learn how they end."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from gazelle.argument_checks import checked
from gazelle.clients.errors import ClientError
from gazelle_ros import Duration, Node, load_message
from gazelle_ros.actions import ActionClient, ClientGoalHandle, CommState, TerminalState
from gazelle_ros.base.closing import Closeable
from gazelle_ros.base.deadlines import deadline_after
from gazelle_ros.msgs import control_msgs, trajectory_msgs

_LOOK_S = 0.01
_ACTION = "control_msgs/FollowJointTrajectory"


@checked(ClientError)
@dataclass(frozen=True, slots=True)
class JointWaypoint:
    """Desired joint positions at a time.

    Attributes:
        seconds: Since the start.
        positions: [rad or m], one a joint.
        velocities: [rad/s or m/s]; none for a straight line in between.
    """

    seconds: float
    positions: Sequence[float]
    velocities: Sequence[float] = ()


@dataclass(frozen=True, slots=True)
class TrajectoryProgress:
    """Progress of a trajectory.

    Attributes:
        seconds: Since its start.
        actual: Position of each joint [rad or m].
        error: Remaining distance [rad or m].
    """

    seconds: float
    actual: Mapping[str, float]
    error: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class TrajectoryOutcome:
    """Outcome of a trajectory.

    Attributes:
        status: ``SUCCEEDED``, ``ABORTED``, ``PREEMPTED``, ``REJECTED``, ``RECALLED`` or ``LOST``.
        error_code: Of control_msgs/FollowJointTrajectoryResult: 0, or why.
        text: Message of the controller.
    """

    status: str
    error_code: int = 0
    text: str = ""

    @property
    def succeeded(self) -> bool:
        """True if the joints reached the goal in time."""
        return self.status == "SUCCEEDED"


@checked(ClientError, after=True)
class TrajectoryRun:
    """A trajectory that is under way; `TrajectoryClient.start` makes it."""

    def __init__(
        self,
        client: ActionClient,
        goal: control_msgs.msg.FollowJointTrajectoryGoal,
        progress: Callable[[TrajectoryProgress], object] | None,
    ) -> None:
        self._action, self._report = client.ns, progress
        self._ended = threading.Event()
        self.progress: TrajectoryProgress | None = None
        """As last received."""
        self._handle = client.send_goal(goal, self._changed, self._on_feedback)

    def wait(self, timeout: float = 60.0) -> TrajectoryOutcome:
        """Wait for the end.

        Raises:
            ClientError: It does not come within ``timeout`` [s of wall time]; it continues.
        """
        if not self._ended.wait(timeout):
            raise ClientError(f"{self._action} is not done after {timeout:g} s")
        return self._outcome()

    def cancel(self) -> None:
        """Cancel the goal: the joints hold where they are."""
        self._handle.cancel()

    def _outcome(self) -> TrajectoryOutcome:
        status = TerminalState.to_string(self._handle.get_terminal_state())
        result, text = self._handle.get_result(), self._handle.get_goal_status_text()
        if result is None:
            return TrajectoryOutcome(status, text=text)
        return TrajectoryOutcome(status, int(result.error_code), result.error_string or text)

    def _changed(self, handle: ClientGoalHandle) -> None:
        if handle.get_comm_state() == CommState.DONE:
            self._ended.set()

    def _on_feedback(
        self, _handle: ClientGoalHandle, feedback: control_msgs.msg.FollowJointTrajectoryFeedback
    ) -> None:
        names = feedback.joint_names
        self.progress = TrajectoryProgress(
            feedback.desired.time_from_start.to_sec(),
            dict(zip(names, feedback.actual.positions, strict=False)),
            dict(zip(names, feedback.error.positions, strict=False)),
        )
        if self._report is not None:
            self._report(self.progress)


@checked(ClientError, after=True)
class TrajectoryClient(Closeable):
    """Commands a ``JointTrajectoryController`` by its action.

    Args:
        node: Node of the client.
        controller: Its name.
        namespace: Of the robot.
        timeout: For the controller to answer [s of wall time].
    """

    def __init__(
        self, node: Node, controller: str, namespace: str = "/", timeout: float = 30.0
    ) -> None:
        space = f"/{namespace.strip('/')}".rstrip("/")
        self.action = f"{space}/{controller}/follow_joint_trajectory"
        self._timeout = timeout
        self._client = ActionClient(node, self.action, load_message(f"{_ACTION}Action"))

    def move(
        self,
        targets: Mapping[str, float],
        seconds: float,
        *,
        timeout: float = 60.0,
        progress: Callable[[TrajectoryProgress], object] | None = None,
    ) -> TrajectoryOutcome:
        """Move joints to positions in some time, at rest in the end; wait until they arrive.

        Args:
            targets: Positions by joint [rad or m]; a controller with ``allow_partial_joints_goal``
                takes some of its joints, others need all.
            seconds: Duration, in the robot's time.
            timeout: The longest wait [s of wall time]; then it is cancelled.
            progress: Called with feedback.

        Raises:
            ClientError: It did not succeed, or not in time.
        """
        rest = JointWaypoint(seconds, list(targets.values()), [0.0] * len(targets))
        return self.follow(list(targets), [rest], timeout=timeout, progress=progress)

    def follow(
        self,
        joints: Sequence[str],
        waypoints: Sequence[JointWaypoint],
        *,
        timeout: float = 60.0,
        progress: Callable[[TrajectoryProgress], object] | None = None,
    ) -> TrajectoryOutcome:
        """Follow waypoints, and wait for the end.

        Args:
            joints: Joints of the waypoints.
            waypoints: In the order of their times.
            timeout: As for ``move``.
            progress: Called with feedback.

        Raises:
            ClientError: It did not succeed, or not in time.
        """
        run = self.start(joints, waypoints, progress=progress)
        try:
            outcome = run.wait(timeout)
        except ClientError:
            run.cancel()
            raise
        if not outcome.succeeded:
            raise ClientError(
                f"{self.action}: {outcome.status} ({outcome.error_code}) {outcome.text}".rstrip()
            )
        return outcome

    def start(
        self,
        joints: Sequence[str],
        waypoints: Sequence[JointWaypoint],
        *,
        progress: Callable[[TrajectoryProgress], object] | None = None,
        path_tolerance: Mapping[str, float] | None = None,
        goal_tolerance: Mapping[str, float] | None = None,
        goal_time: float = 0.0,
    ) -> TrajectoryRun:
        """Send waypoints and continue.

        Args:
            joints: Joints of the waypoints.
            waypoints: In the order of their times; none to hold still.
            progress: Called with feedback, by the subscriber's thread.
            path_tolerance: Largest error of joints along the path [rad or m]; negative for no bound.
                Those that are not named have the controller's own.
            goal_tolerance: Likewise, at the end.
            goal_time: Allowed delay [s]; 0 for the controller's own.

        Raises:
            ClientError: The controller does not answer.
        """
        self._wait_for_controller()
        goal = self._client.types.goal()
        goal.trajectory.joint_names = list(joints)
        goal.trajectory.points = [_point(each, len(joints)) for each in waypoints]
        goal.path_tolerance = _tolerances(path_tolerance or {})
        goal.goal_tolerance = _tolerances(goal_tolerance or {})
        goal.goal_time_tolerance = Duration.from_sec(goal_time)
        return TrajectoryRun(self._client, goal, progress)

    def close(self) -> None:
        """Leave the topics; a sent trajectory continues."""
        self._client.stop()

    def _wait_for_controller(self) -> None:
        """Wait until the controller's action is there, in wall time.

        Raises:
            ClientError: It takes too long.
        """
        deadline = deadline_after(self._timeout)
        while not self._client.connected:
            if time.monotonic() > deadline:
                raise ClientError(
                    f"{self.action} does not answer within {self._timeout:g} s",
                    hint="is the controller loaded, and of a type that follows trajectories?",
                )
            time.sleep(_LOOK_S)


def _point(waypoint: JointWaypoint, count: int) -> trajectory_msgs.msg.JointTrajectoryPoint:
    for values in (waypoint.positions, waypoint.velocities):
        if values and len(values) != count:
            raise ClientError(
                f"a waypoint at {waypoint.seconds:g} s has {len(values)} values for {count} joints"
            )
    return trajectory_msgs.msg.JointTrajectoryPoint(
        positions=list(waypoint.positions),
        velocities=list(waypoint.velocities),
        time_from_start=Duration.from_sec(waypoint.seconds),
    )


def _tolerances(tolerances: Mapping[str, float]) -> list[control_msgs.msg.JointTolerance]:
    kind = control_msgs.msg.JointTolerance
    return [kind(name=name, position=value) for name, value in tolerances.items()]
