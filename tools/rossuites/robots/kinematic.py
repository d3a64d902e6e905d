"""Robots whose joints do at once what they are told, as those of ros_controllers' tests."""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from typing import Any

import numpy as np

from gazelle.bridges.control import HardwareLoop
from gazelle.control import POSITION, VELOCITY, ControllerManager, RobotHardware
from gazelle_ros import Node, load_message, load_service
from gazelle_ros.builtin.arguments import parse_arguments
from gazelle_ros.clock import SECOND, SimulatedClock

PERIOD_S = 0.01


class Kinematic(RobotHardware):
    """Wheels that turn as they are told, and steering joints that are where they are told.

    Args:
        wheels: Joints commanded by velocity.
        steers: Joints commanded by position.

    Attributes:
        running: Whether joints are measured; while not, what is read is no number.
    """

    def __init__(self, wheels: Sequence[str], steers: Sequence[str] = ()) -> None:
        super().__init__()
        self.running = True
        commands = {VELOCITY: wheels} | ({POSITION: steers} if steers else {})
        self.joints = self.register_joints((*wheels, *steers), commands)
        self.joints.position[:] = self.joints.effort[:] = 0.0
        self.turning = self.interfaces[VELOCITY].handles(wheels)
        self.steering = self.interfaces[POSITION].handles(steers) if steers else None
        self.count = len(wheels)

    def read(self, time: float, period: float) -> None:
        """Move; positions are no numbers for one period more after measuring began again."""
        del time
        joints, count = self.joints, self.count
        if not self.running:
            joints.position[:] = joints.velocity[:] = np.nan
            return
        joints.position[:, :count] += joints.velocity[:, :count] * period
        joints.velocity[:, :count] = self.turning.command()
        if self.steering is not None:
            joints.position[:, count:] = self.steering.command()

    def serve(self, node: Node) -> None:
        """Serve ``start`` and ``stop``."""
        empty = load_service("std_srvs/Empty")

        def switch(*, running: bool) -> Any:
            def answer(_request: Any) -> dict[str, Any]:
                self.running = running
                return {}

            return answer

        node.serve("start", empty, switch(running=True))
        node.serve("stop", empty, switch(running=False))


def run(name: str, hardware: RobotHardware, *, makes_time: bool, offer: Any = None) -> int:
    """Run a robot as a node until it is asked to end; returns the exit code.

    Args:
        name: Of the node.
        hardware: The robot.
        makes_time: Whether the robot's time is the graph's.
        offer: Called with the node, before there are services of a manager.
    """
    clock = SimulatedClock() if makes_time else None
    node = parse_arguments(sys.argv[1:], name).start(clock=clock)
    with node:
        if clock is not None:
            node.set_param("/use_sim_time", True)
        if offer is not None:
            offer(node)
        with HardwareLoop(node, ControllerManager(hardware), 1.0 / PERIOD_S) as loop:
            return _keep_time(node, loop) if clock is None else _make_time(node, clock, loop)


def _keep_time(node: Node, loop: HardwareLoop) -> int:
    """Keep periods at their length; late ones are made up for.

    The originals' robots lose them, and with them time, on a machine that is busy with other things.
    """
    due = time.monotonic()
    try:
        while not node.closed:
            loop.step(PERIOD_S)
            due += PERIOD_S
            time.sleep(max(0.0, due - time.monotonic()))
    except KeyboardInterrupt:
        pass
    return 0


def _rest(due: float) -> float:
    """Sleep until then; what is late by more than a period is not made up for."""
    late = time.monotonic() - due
    if late > PERIOD_S:
        return due + late
    time.sleep(max(0.0, -late))
    return due


def _make_time(node: Node, clock: SimulatedClock, loop: HardwareLoop) -> int:
    kind: Any = load_message("rosgraph_msgs/Clock")
    publisher = node.advertise("/clock", kind, 1)
    now, due = 0, time.monotonic()
    try:
        while not node.closed:
            loop.step(PERIOD_S)
            publisher.publish(kind(clock=loop.graph.stamp(now)))
            now += round(PERIOD_S * SECOND)
            clock.set(now)
            due = _rest(due + PERIOD_S)
    except KeyboardInterrupt:
        pass
    return 0
