"""Stands in for the robot of ackermann_steering_controller's tests.

The joints that the original turns beside the two that are controlled are only looked up by the
controller in the URDF, never commanded.
"""

import sys

from kinematic import Kinematic, run

if __name__ == "__main__":
    robot = Kinematic(["rear_wheel_joint"], ["front_steer_joint"])
    sys.exit(run("ackermann_steering_bot", robot, makes_time=False, offer=robot.serve))
