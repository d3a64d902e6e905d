"""Automated guided vehicles on any ROS 1 graph: Gazelle's, a stage_ros's, real ones.

The motions themselves are those of ``gazelle.navigation``. They run on simulated time where
poses bring it, so they take the same simulated time at any speed of the simulation.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.clients.agv_poses import PoseSource, pose_source
from gazelle.clients.errors import ClientError
from gazelle.clients.poses import twist_message
from gazelle.errors import did_you_mean
from gazelle.navigation import Limits, Motions, Outcome
from gazelle_ros import Node
from gazelle_ros.base.closing import Closeable
from gazelle_ros.base.deadlines import deadline_after
from gazelle_ros.msgs import geometry_msgs

_PATIENCE_S = 30.0  # of wall time without a new pose
_MOST_NAMES = 5  # in one message


@checked(ClientError, after=True)
class AGVFleet(Closeable):
    """Many AGVs, moved together by one thread; also a context manager, which stops them.

    Args:
        node: Publishes and subscribes.
        spaces: Namespace of each robot, such as ``/robot_3``; empty for a single one without.
        poses: ``topic`` for ``nav_msgs/Odometry``, or ``service`` for one that answers with
            x, y [m] and an angle [degrees], as ``sim_agv/AgvPose`` does.
        pose_name: Of the topic or service under each namespace; ``base_pose_ground_truth`` or
            ``get_pose`` by default.
        service_type: Of the service; register its text first, see ``gazelle_ros.messages``.
        limits: Speeds and tolerances.
        rate: Rate of service calls [Hz of simulated time].

    Raises:
        UnknownTypeError: The type of the service is not known.
    """

    def __init__(
        self,
        node: Node,
        spaces: Sequence[str],
        *,
        poses: str = "topic",
        pose_name: str | None = None,
        service_type: str = "sim_agv/AgvPose",
        limits: Limits | None = None,
        rate: float = 10.0,
    ) -> None:
        names = [f"/{space.strip('/')}" if space.strip("/") else "" for space in spaces]
        self._node, self._names = node, names
        self.motions = Motions(len(names), limits)
        self._lock = threading.RLock()
        self._ended = threading.Condition(self._lock)
        self._stop = threading.Event()
        self._fault: Exception | None = None
        self._source: PoseSource = pose_source(poses, node, names, pose_name, service_type, rate)
        kind = geometry_msgs.msg.Twist
        self._publishers = [node.advertise(f"{name}/cmd_vel", kind, 1) for name in names]
        self._standing = np.ones(len(names), np.bool_)
        self._thread = threading.Thread(target=self._run, name="agv", daemon=True)
        self._thread.start()

    def wait(self, timeout: float = 30.0) -> Self:
        """Wait until all robots have subscribed and their poses are known.

        Raises:
            ClientError: It takes longer than ``timeout`` [s of wall time].
        """
        end = deadline_after(timeout)
        while not (self._source.known and all(p.num_connections for p in self._publishers)):
            if time.monotonic() > end:
                raise self._absent(timeout)
            time.sleep(0.01)
        return self

    def _absent(self, timeout: float) -> ClientError:
        """Return the error for missing robots, with a hint at those present."""
        blind = not self._source.known
        if blind:
            rows = [bool(np.isnan(pose).any()) for pose in self._source.latest()[0]]
        else:
            rows = [not publisher.num_connections for publisher in self._publishers]
        missed = [name for name, missing in zip(self._names, rows, strict=True) if missing]
        there = {topic.removesuffix("/cmd_vel") for topic in self._drives()} - set(missed)
        return ClientError(
            f"{_list_of(missed)} has no {self._source.name if blind else 'cmd_vel'} within "
            f"{timeout:g} s of wall time",
            hint=did_you_mean(missed[0], there) if there else "is the simulation running?",
        )

    def _drives(self) -> list[str]:
        """Return the velocity topics that another node subscribes to."""
        _, listeners, _ = self._node.master.system_state()
        return [topic for topic in listeners if topic.endswith("/cmd_vel")]

    @property
    def poses(self) -> Floats:
        """x, y [m] and heading [rad] as last received, shape (count, 3)."""
        return self._source.latest()[0]

    def move_l(
        self, x: ArrayLike, y: ArrayLike, robots: ArrayLike | None = None, *, timeout: float = 60.0
    ) -> Floats:
        """Drive robots straight to points [m], together; see ``gazelle.navigation.Motions``.

        Returns:
            The simulated time that each took [s].

        Raises:
            ClientError: One did not get there in time, or was cancelled.
        """
        with self._lock:
            self.motions.move_l(x, y, robots, timeout=timeout)
        return self._finish(robots)

    def move_c(
        self, angle: ArrayLike, robots: ArrayLike | None = None, *, timeout: float = 60.0
    ) -> Floats:
        """Turn robots by angles [rad]; as ``move_l``."""
        with self._lock:
            self.motions.move_c(angle, robots, timeout=timeout)
        return self._finish(robots)

    def move_ofsc(
        self, heading: ArrayLike, robots: ArrayLike | None = None, *, timeout: float = 60.0
    ) -> Floats:
        """Turn robots to absolute headings [rad]; as ``move_l``."""
        with self._lock:
            self.motions.move_ofsc(heading, robots, timeout=timeout)
        return self._finish(robots)

    def cancel(self, robots: ArrayLike | None = None) -> None:
        """Cancel motions, from any thread; waiting calls raise a ClientError."""
        with self._lock:
            self.motions.cancel(robots)

    def close(self) -> None:
        """Stop all robots and leave the topics."""
        self._stop.set()
        self._source.close()
        self._thread.join()
        for publisher in self._publishers:
            publisher.publish(twist_message((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)))
            publisher.close()

    def _finish(self, robots: ArrayLike | None) -> Floats:
        """Wait until these robots stand; the time they took."""
        rows = np.arange(self.motions.count) if robots is None else np.atleast_1d(robots)
        with self._ended:
            last, since = self._source.count, time.monotonic()
            while self.motions.active[rows].any() or not self._standing[rows].all():
                self._ended.wait(0.2)
                if self._source.count != last:
                    last, since = self._source.count, time.monotonic()
                if self._fault is not None:
                    raise ClientError(f"the AGVs cannot be moved: {self._fault}") from self._fault
                if self._stop.is_set() or time.monotonic() - since > _PATIENCE_S:
                    raise ClientError("no more poses are published")
            outcome, taken = self.motions.outcome[rows], self.motions.taken[rows].copy()
        for code, text in (
            (Outcome.TIMED_OUT, "did not get there in time"),
            (Outcome.CANCELLED, "was cancelled"),
        ):
            found = [self._names[row] for row in np.asarray(rows)[outcome == code].tolist()]
            if found:
                raise ClientError(f"the motion of {_list_of(found)} {text}")
        return taken

    def _run(self) -> None:
        """Send commands for new poses."""
        try:
            while not self._stop.is_set():
                if self._source.await_news(0.1):
                    self._update()
        except Exception as error:  # noqa: BLE001  # raised in the waiting call
            self._fault = error

    def _update(self) -> None:
        poses, now = self._source.latest()
        with self._ended:
            command = self.motions.update(np.nan_to_num(poses), now)
            moving = self.motions.active
            commanded = np.flatnonzero(moving | ~self._standing)
            self._standing[:] = ~moving
            rows = command[commanded].tolist()
        for robot, (linear, angular) in zip(commanded.tolist(), rows, strict=True):
            self._publishers[robot].publish(twist_message((linear, 0.0, 0.0), (0.0, 0.0, angular)))
        with self._ended:
            self._ended.notify_all()


def _list_of(names: Sequence[str]) -> str:
    """Return the first few names."""
    more = f" and {len(names) - _MOST_NAMES} more" if len(names) > _MOST_NAMES else ""
    return ", ".join(name or "the AGV" for name in names[:_MOST_NAMES]) + more


@checked(ClientError, after=True)
class AGV(Closeable):
    """One AGV; its moves return the simulated time they took [s]. Many may run in threads.

    Args:
        node: Publishes and subscribes.
        space: Its namespace, such as ``/robot_3``.
        poses: See ``AGVFleet``; the other arguments as well.
        pose_name: See there.
        service_type: See there.
        limits: See there.
        rate: See there.
    """

    def __init__(
        self,
        node: Node,
        space: str = "",
        *,
        poses: str = "topic",
        pose_name: str | None = None,
        service_type: str = "sim_agv/AgvPose",
        limits: Limits | None = None,
        rate: float = 10.0,
    ) -> None:
        self._fleet = AGVFleet(
            node,
            [space],
            poses=poses,
            pose_name=pose_name,
            service_type=service_type,
            limits=limits,
            rate=rate,
        )

    def wait(self, timeout: float = 30.0) -> Self:
        """Wait until the robot has subscribed and its pose is known.

        Raises:
            ClientError: It takes longer than ``timeout`` [s of wall time].
        """
        self._fleet.wait(timeout)
        return self

    @property
    def pose(self) -> tuple[float, float, float]:
        """x, y [m] and heading [rad] as last received."""
        x, y, heading = self._fleet.poses[0].tolist()
        return x, y, heading

    def move_l(self, x: float, y: float, *, timeout: float = 60.0) -> float:
        """Drive straight to a point [m]; returns the simulated time it took [s].

        Raises:
            ClientError: It did not get there in time, or was cancelled.
        """
        return float(self._fleet.move_l(x, y, timeout=timeout)[0])

    def move_c(self, angle: float, *, timeout: float = 60.0) -> float:
        """Turn by an angle [rad]; as ``move_l``."""
        return float(self._fleet.move_c(angle, timeout=timeout)[0])

    def move_ofsc(self, heading: float, *, timeout: float = 60.0) -> float:
        """Turn to an absolute heading [rad]; as ``move_l``."""
        return float(self._fleet.move_ofsc(heading, timeout=timeout)[0])

    def cancel(self) -> None:
        """Cancel the motion, from any thread; a waiting call raises a ClientError."""
        self._fleet.cancel()

    def close(self) -> None:
        """Stop and leave the topics."""
        self._fleet.close()
