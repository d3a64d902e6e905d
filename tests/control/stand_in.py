"""A robot for controllers without a simulation."""

from __future__ import annotations

import numpy as np

from gazelle.control import JointCommandInterface, RobotHardware

PREFIX = "hardware_interface/"


class Frictionless(RobotHardware):
    """Joints that do at once what they are told; efforts turn masses of 1 kg or 1 kg m²."""

    def __init__(self, commands, nworld=1):
        super().__init__(nworld)
        names = sorted({name for joints in commands.values() for name in joints})
        full = {PREFIX + kind + "JointInterface": joints for kind, joints in commands.items()}
        self.joints = self.register_joints(names, full)
        self.joints.position[:] = self.joints.effort[:] = 0.0

    def write(self, time, period):
        states = self.joints
        for interface in self.interfaces.values():
            if not isinstance(interface, JointCommandInterface):
                continue
            columns = states.columns(interface.resources)
            fields = interface.commands
            if "position" in fields:
                states.position[:, columns] = fields["position"]
            if "velocity" in fields:
                states.velocity[:, columns] = fields["velocity"]
                if "position" not in fields:
                    states.position[:, columns] += fields["velocity"] * period
            if "effort" in fields:
                states.velocity[:, columns] += fields["effort"] * period
                states.position[:, columns] += states.velocity[:, columns] * period
                states.effort[:, columns] = fields["effort"]


def spin(manager, count=1, period=0.01):
    """Run some control periods."""
    hardware = manager.hardware
    for _ in range(count):
        now = manager.now_ns + round(period * 1e9)
        hardware.read(now * 1e-9, period)
        manager.update(now, period)
        hardware.write(now * 1e-9, period)


def column(values):
    return np.asarray(values)[:, 0]
