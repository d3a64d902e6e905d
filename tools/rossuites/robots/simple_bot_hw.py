"""Stands in for the robot of effort_controllers' tests: a mass of one, pushed by ten at most."""

import sys

import numpy as np
from kinematic import PERIOD_S, run

from gazelle.control import EFFORT, RobotHardware

MOST = 10.0


class Pushed(RobotHardware):
    """One joint."""

    def __init__(self):
        super().__init__()
        self.joints = self.register_joints(["joint"], {EFFORT: ["joint"]})
        self.joints.position[:] = self.joints.effort[:] = 0.0
        self.pushing = self.interfaces[EFFORT].handles(["joint"])

    def read(self, time, period):
        """Move by what acts."""
        joints = self.joints
        joints.position += PERIOD_S * joints.velocity + 0.5 * PERIOD_S**2 * joints.effort
        joints.velocity += PERIOD_S * joints.effort

    def write(self, time, period):
        """Apply the command."""
        self.joints.effort[:] = np.clip(self.pushing.command(), -MOST, MOST)


if __name__ == "__main__":
    sys.exit(run("simple_bot_hw", Pushed(), makes_time=True))
