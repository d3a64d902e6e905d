"""Stands in for the node of combined_robot_hw_tests: the joints of its four robots, as one robot.

What the suite asks over services does not depend on how many parts a robot is made of.
"""

import sys

import dummy_app

JOINTS = (*(f"test_joint{number}" for number in range(1, 6)), "right_arm_joint_1")

if __name__ == "__main__":
    sys.exit(dummy_app.main((*JOINTS, *dummy_app.JOINTS[:2])))
