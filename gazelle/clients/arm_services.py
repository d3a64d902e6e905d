"""Move an arm by the four services that openai_ros' tasks of Fetch call."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle.argument_checks import checked
from gazelle.clients.calls import Caller
from gazelle.clients.errors import ClientError
from gazelle.clients.poses import ModelState, Vector
from gazelle_ros import Node
from gazelle_ros.base.closing import Closeable
from gazelle_ros.msgs import geometry_msgs, trajectory_msgs


@checked(ClientError, after=True)
class ArmCommander(Closeable):
    """Calls ``ee_traj_srv``, ``joint_traj_srv``, ``ee_pose_srv`` and ``ee_rpy_srv`` (package ``fetch_train``).

    Args:
        node: Calls.
        namespace: Of the services.
        timeout: For a service to be there and for it to answer, each [s of wall time]; a motion is
            over when the answer comes.
    """

    def __init__(self, node: Node, namespace: str = "/", timeout: float = 60.0) -> None:
        self._caller = Caller(node, namespace, timeout, retries=1)

    def go_to(self, position: Sequence[float]) -> None:
        """Move the end effector, turned as the frame that is planned in.

        Args:
            position: x, y, z in that frame [m].

        Raises:
            ClientError: It did not get there, and why; or the service is not there.
        """
        pose = geometry_msgs.msg.Pose()
        pose.position.x, pose.position.y, pose.position.z = map(float, position)
        pose.orientation.w = 1.0
        self._move("ee_traj_srv", "EeTraj", pose=pose)

    def go_to_joints(self, positions: Sequence[float]) -> None:
        """Move the joints of the group, in its order [rad or m].

        Raises:
            ClientError: They did not get there, and why; or the service is not there.
        """
        values = [float(each) for each in positions]
        point = trajectory_msgs.msg.JointTrajectoryPoint(positions=values)
        self._move("joint_traj_srv", "JointTraj", point=point)

    def _move(self, name: str, kind: str, **fields: Any) -> None:
        answer = self._caller.call_once(name, f"fetch_train/{kind}", **fields)
        if not answer.success:
            raise ClientError(f"{name}: {answer.message}")

    def pose(self) -> ModelState:
        """Return the pose of the end effector, in the planning frame."""
        pose = self._caller.call("ee_pose_srv", "fetch_train/EePose").pose
        place, turn = pose.position, pose.orientation
        return ModelState((place.x, place.y, place.z), (turn.x, turn.y, turn.z, turn.w))

    def rpy(self) -> Vector:
        """Return roll, pitch and yaw of the end effector [rad]; the service swaps the last two."""
        answer = self._caller.call("ee_rpy_srv", "fetch_train/EeRpy")
        return (answer.r, answer.y, answer.p)

    def close(self) -> None:
        """Close the connections."""
        self._caller.close()
