"""Stands in for ``rrbot`` of joint_trajectory_controller's tests: two joints that follow commands.

Topics say how sluggishly, whether a period late, and up to where.
"""

import sys

import numpy as np
from kinematic import PERIOD_S, run

from gazelle.control import POSITION, VELOCITY, RobotHardware
from gazelle_ros import load_message

JOINTS = ("joint1", "joint2")


class RRBot(RobotHardware):
    """Two joints, each by whatever interface runs."""

    def __init__(self):
        super().__init__()
        self.joints = self.register_joints(JOINTS, {POSITION: JOINTS, VELOCITY: JOINTS})
        self.joints.position[:] = self.joints.effort[:] = 0.0
        self.smoothing = np.zeros(2)
        self.delayed, self.most = False, np.inf
        self.active = [None, None]
        self.commands = {
            name: self.interfaces[interface].handles(JOINTS)
            for name, interface in (("position", POSITION), ("velocity", VELOCITY))
        }
        self.last = {name: np.zeros((1, 2)) for name in self.commands}

    def write(self, time, period):
        """Move."""
        wanted = {name: each.command() for name, each in self.commands.items()}
        if self.delayed:
            wanted, self.last = self.last, wanted
            for name, handles in self.commands.items():
                handles.set_command(wanted[name])
        else:
            self.last = {name: values.copy() for name, values in wanted.items()}
        joints = self.joints
        for index, interface in enumerate(self.active):
            here = joints.position[0, index]
            rest = 1.0 - self.smoothing[index]
            if interface == POSITION:
                there = self.smoothing[index] * here + rest * wanted["position"][0, index]
                joints.velocity[0, index] = (there - here) / PERIOD_S
                joints.position[0, index] = there
            elif interface == VELOCITY:
                joints.velocity[0, index] = rest * wanted["velocity"][0, index]
                joints.position[0, index] += joints.velocity[0, index] * PERIOD_S
        over = joints.position > self.most
        joints.position[over], joints.velocity[over] = self.most, 0.0

    def do_switch(self, start, stop):
        """Follow the interface that a started controller has claimed a joint by."""
        for each in start:
            for interface, names in each.claimed.items():
                for name in names:
                    self.active[JOINTS.index(name)] = interface

    def listen(self, node):
        """Subscribe to the topics, and confirm each message."""
        empty = load_message("std_msgs/Empty")
        told = node.advertise("parameter_updated", empty, 1)

        def take(topic, kind, act):
            def hear(message):
                act(message.data)
                told.publish(empty())

            node.subscribe(topic, load_message(f"std_msgs/{kind}"), hear, 1)

        take("smoothing", "Float64", lambda value: setattr(self, "smoothing", np.full(2, value)))
        take("smoothings", "Float64MultiArray", lambda v: setattr(self, "smoothing", np.array(v)))
        take("delay", "Bool", lambda value: setattr(self, "delayed", value))
        take("upper_bound", "Float64", lambda value: setattr(self, "most", value))


if __name__ == "__main__":
    robot = RRBot()
    sys.exit(run("rrbot", robot, makes_time=False, offer=robot.listen))
