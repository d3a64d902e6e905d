"""Stands in for ``rrbot_wrapping`` of joint_trajectory_controller's tests: angles stay within pi."""

import sys

import numpy as np
from kinematic import PERIOD_S, run

from gazelle.control import VELOCITY, RobotHardware
from gazelle_ros import load_message

JOINTS = ("joint1", "joint2")
START = (np.pi - 0.1, 0.1 - np.pi)


class Wrapping(RobotHardware):
    """Two joints by velocity."""

    def __init__(self):
        super().__init__()
        self.joints = self.register_joints(JOINTS, {VELOCITY: JOINTS})
        self.joints.position[0], self.joints.effort[:] = START, 0.0
        self.turning = self.interfaces[VELOCITY].handles(JOINTS)
        self.turning.set_command(np.array([START]))
        self.factor = 0.0

    def write(self, time, period):
        """Move."""
        joints = self.joints
        joints.velocity[:] = self.factor * self.turning.command()
        turned = joints.position + joints.velocity * PERIOD_S
        joints.position[:] = (turned + np.pi) % (2.0 * np.pi) - np.pi

    def listen(self, node):
        """Subscribe to the share of a command that is followed."""
        node.subscribe(
            "smoothing",
            load_message("std_msgs/Float64"),
            lambda message: setattr(self, "factor", message.data),
            1,
        )


if __name__ == "__main__":
    robot = Wrapping()
    sys.exit(run("rrbot_wrapping", robot, makes_time=False, offer=robot.listen))
