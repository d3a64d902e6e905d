"""Stands in for ``diffbot`` and ``skidsteerbot`` of diff_drive_controller's tests."""

import sys

from kinematic import Kinematic, run

if __name__ == "__main__":
    count = int(sys.argv.pop(1))
    robot = Kinematic([f"wheel_{number}_joint" for number in range(count)])
    sys.exit(run("diffbot", robot, makes_time=True, offer=robot.serve))
