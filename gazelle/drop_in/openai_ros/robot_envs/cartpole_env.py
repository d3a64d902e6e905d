"""The cart and pole on a graph."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar

from gazelle.drop_in.openai_ros.robot_envs.topic_robot_env import RobotTopic, TopicRobotEnv
from gazelle.errors import TaskError, did_you_mean
from gazelle_ros.compat import rospy
from gazelle_ros.msgs import rosgraph_msgs, sensor_msgs, std_msgs

_SPACE = "cartpole_v0"
_CONTROL = ("velocity", "position", "effort")


class CartPoleEnv(TopicRobotEnv):
    """A cart on a rail with a pole; its controllers are reset with every episode, and time too.

    Args:
        control_type: Commands of the controllers: ``velocity``, ``position`` or ``effort``.
        ros_ws_abspath: A workspace that is searched for the robot's package too.

    Raises:
        TaskError: There is no such kind of control.
    """

    package: ClassVar[str] = "cartpole_description"
    sensors = (RobotTopic("joints", f"/{_SPACE}/joint_states", "sensor_msgs/JointState"),)
    robot_name_space = _SPACE
    reset_controls = True
    set_physics: ClassVar[bool] = True
    joints: Any

    def __init__(self, control_type: str = "velocity", ros_ws_abspath: str | None = None) -> None:
        if control_type not in _CONTROL:
            hint = did_you_mean(control_type, _CONTROL)
            raise TaskError(f"a cart is not controlled by '{control_type}'", hint=hint)
        self.control_type = control_type
        self.controllers_list = (
            "joint_state_controller",
            f"pole_joint_{control_type}_controller",
            f"foot_joint_{control_type}_controller",
        )
        self.steps_beyond_done: int | None = None
        super().__init__(ros_ws_abspath)

    def _open_publishers(self) -> None:
        super()._open_publishers()
        space, kind = f"/{_SPACE}", f"joint_{self.control_type}_controller/command"
        self._base_pub = self._publisher(f"{space}/foot_{kind}", "std_msgs/Float64")
        self._pole_pub = self._publisher(f"{space}/pole_{kind}", "std_msgs/Float64")

    def joints_callback(self, data: sensor_msgs.msg.JointState) -> None:
        """Store the state of the joints."""
        self.joints = data

    def check_publishers_connection(self) -> None:
        """Wait until both commands have subscribers."""
        self._check_publishers_connection()

    def init_internal_vars(self, init_pos_value: float) -> None:
        """Initialise the command of the cart."""
        self.pos = [init_pos_value]

    def move_joints(self, joints_array: Sequence[float]) -> None:
        """Command the cart: the first number [m/s, m or N]."""
        self._base_pub.publish(std_msgs.msg.Float64(float(joints_array[0])))

    def get_clock_time(self) -> Any:
        """Return the next ``rosgraph_msgs/Clock``."""
        self.clock_time = rospy.wait_for_message("/clock", rosgraph_msgs.msg.Clock)
        return self.clock_time

    def joint(self, name: str) -> tuple[float, float]:
        """Return position and velocity of a joint, in any order of publication [m or rad]."""
        place = self.joints.name.index(name)
        return self.joints.position[place], self.joints.velocity[place]
