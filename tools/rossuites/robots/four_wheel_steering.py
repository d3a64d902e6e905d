"""Stands in for the robot of four_wheel_steering_controller's tests."""

import sys

from kinematic import Kinematic, run

CORNERS = ("front_left", "front_right", "rear_left", "rear_right")

if __name__ == "__main__":
    robot = Kinematic(
        [f"{corner}_wheel" for corner in CORNERS],
        [f"{corner}_steering_joint" for corner in CORNERS],
    )
    sys.exit(run("four_wheel_steering", robot, makes_time=True, offer=robot.serve))
