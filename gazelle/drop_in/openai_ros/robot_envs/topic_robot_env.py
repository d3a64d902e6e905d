"""Common base of the robots: subscribed topics, and a launch file that spawns them."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from gazelle.drop_in.openai_ros.gazebo_connection import SIMULATION
from gazelle.drop_in.openai_ros.openai_ros_common import ROSLauncher
from gazelle.drop_in.openai_ros.robot_gazebo_env import RobotGazeboEnv
from gazelle.drop_in.openai_ros.running import published
from gazelle.errors import TaskError, did_you_mean
from gazelle_ros import load_message
from gazelle_ros.compat import rospy
from gazelle_ros.messages import Message

PATIENCE_S = 60.0
"""Longest silence of a topic, or wait for a subscriber, before an error [s of wall time]."""
_LOOK_S = 0.005


@dataclass(frozen=True, slots=True)
class RobotTopic:
    """A topic that a robot is known by.

    Attributes:
        attribute: Attribute of the environment for the last message.
        topic: Its name.
        kind: Its type, such as ``nav_msgs/Odometry``.
    """

    attribute: str
    topic: str
    kind: str


class TopicRobotEnv(RobotGazeboEnv):
    """A robot that is spawned by a launch file unless its topics are there, and seen by its topics.

    Subclasses fill the class attributes. For each sensor they get the methods ``get_NAME``, the last
    message, and ``_check_NAME_ready``, which waits for the next.

    Args:
        ros_ws_abspath: A workspace that is searched for the robot's package too.

    Attributes:
        package: With the launch file.
        launch_file: Spawns the robot.
        sensors: Subscribed topics.
        robot_name_space: Of its controllers.
        controllers_list: Its controllers.
        reset_controls: Whether they are reset with every episode.
        set_physics: Whether openai_ros' physics is set.
        reset_kind: See `GazeboConnection`.
    """

    package: ClassVar[str] = ""
    launch_file: ClassVar[str] = "put_robot_in_world.launch"
    sensors: ClassVar[Sequence[RobotTopic]] = ()
    robot_name_space: str = ""
    controllers_list: Sequence[str] = ()
    reset_controls: bool = False
    set_physics: ClassVar[bool] = False
    reset_kind: ClassVar[str] = SIMULATION

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        for sensor in cls.__dict__.get("sensors", ()):
            name = sensor.attribute
            setattr(cls, f"get_{name}", _getter(name))
            setattr(cls, f"_check_{name}_ready", _checker(name))

    def __init__(self, ros_ws_abspath: str | None = None) -> None:
        if self.package and not published(each.topic for each in self.sensors):
            ROSLauncher(self.package, self.launch_file, ros_ws_abspath)
        super().__init__(
            self.robot_name_space,
            self.controllers_list,
            self.reset_controls,
            self.set_physics,
            self.reset_kind,
        )
        self._received: dict[str, int] = {}
        self._subscribers = [self._listen(each) for each in self.sensors]
        self._open_publishers()
        self.gazebo.unpauseSim()
        self._await_controllers()
        self._check_all_systems_ready()
        self.gazebo.pauseSim()

    # -- sensors -----------------------------------------------------------------------------

    def _listen(self, sensor: RobotTopic) -> rospy.Subscriber:
        setattr(self, sensor.attribute, None)
        self._received[sensor.attribute] = 0

        def take(message: Message) -> None:
            setattr(self, sensor.attribute, message)
            self._received[sensor.attribute] += 1

        return rospy.Subscriber(sensor.topic, load_message(sensor.kind), take, queue_size=10)

    def _check_all_systems_ready(self) -> bool:
        """Wait until all sensors have published since now, and commands have subscribers."""
        self._check_all_sensors_ready()
        self._check_publishers_connection()
        return True

    def _check_all_sensors_ready(self) -> None:
        """Wait until all sensors have published since now; time must advance."""
        before = dict(self._received)
        deadline = time.monotonic() + PATIENCE_S
        for sensor in self.sensors:
            while self._received[sensor.attribute] == before[sensor.attribute]:
                if time.monotonic() > deadline:
                    raise self._silent(sensor)
                self._look_again()

    def _check_sensor_ready(self, attribute: str) -> Any:
        """Return the next message of a sensor; time must advance.

        Raises:
            TaskError: There is none within a minute.
        """
        (sensor,) = (each for each in self.sensors if each.attribute == attribute)
        if not hasattr(self, "_received"):  # tasks may check before the robot's constructor
            return self._first(sensor)
        before, deadline = self._received[attribute], time.monotonic() + PATIENCE_S
        while self._received[attribute] == before:
            if time.monotonic() > deadline:
                raise self._silent(sensor)
            self._look_again()
        return getattr(self, attribute)

    def _first(self, sensor: RobotTopic) -> Any:
        """Return the next message of a topic without a subscriber yet."""
        try:
            return rospy.wait_for_message(sensor.topic, load_message(sensor.kind), PATIENCE_S)
        except rospy.ROSInterruptException:
            raise
        except rospy.ROSException:
            raise self._silent(sensor) from None

    def _silent(self, sensor: RobotTopic) -> TaskError:
        known = dict(rospy.get_published_topics())
        if sensor.topic in known:
            hint = f"it is published as {known[sensor.topic]}; does time go on?"
        else:
            hint = f"it has no publisher; {did_you_mean(sensor.topic, known)}"
        return TaskError(
            f"{type(self).__name__} waited {PATIENCE_S:g} s for {sensor.topic} in vain", hint=hint
        )

    @staticmethod
    def _look_again() -> None:
        if rospy.is_shutdown():
            raise rospy.ROSInterruptException("the node was shut down")
        time.sleep(_LOOK_S)

    # -- commands ------------------------------------------------------------------------------

    def _open_publishers(self) -> None:
        """Create the publishers of commands; into ``publishers_array`` too."""
        self.publishers_array: list[rospy.Publisher] = []

    def _publisher(self, topic: str, kind: str) -> rospy.Publisher:
        """Create a publisher of commands."""
        made = rospy.Publisher(topic, load_message(kind), queue_size=1)
        self.publishers_array.append(made)
        return made

    def _check_publishers_connection(self) -> None:
        """Wait until each command has a subscriber.

        Raises:
            TaskError: There is none within a minute.
        """
        deadline = time.monotonic() + PATIENCE_S
        for each in self.publishers_array:
            while not each.get_num_connections():
                if time.monotonic() > deadline:
                    raise TaskError(
                        f"no subscriber on {each.resolved_name} after {PATIENCE_S:g} s",
                        hint="is the robot there, and are its controllers running?",
                    )
                self._look_again()

    def _await_controllers(self) -> None:
        """Wait until the launch file has started the controllers that will be reset."""
        if self.reset_controls:
            self.controllers_object.wait_running(PATIENCE_S)

    def check_array_similar(
        self,
        ref_value_array: Sequence[float],
        check_value_array: Sequence[float],
        epsilon: float,
    ) -> bool:
        """Return whether numbers agree within a tolerance."""
        return bool(np.allclose(ref_value_array, check_value_array, atol=epsilon))


def _getter(name: str) -> Callable[[TopicRobotEnv], Any]:
    def get(env: TopicRobotEnv) -> Any:
        """Return the last message."""
        return getattr(env, name)

    return get


def _checker(name: str) -> Callable[[TopicRobotEnv], Any]:
    def check(env: TopicRobotEnv) -> Any:
        """Return the next message."""
        return env._check_sensor_ready(name)  # noqa: SLF001  # a method of the class

    return check
