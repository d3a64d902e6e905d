"""Devices of one of Stage's robots as its inputs and outputs, by the names that its file gives them.

An output has one value for each world, in a tuple: of a bumper what ``StageFleet.bumps`` gives, of
fiducial and blob finders a tuple of what they see, of a gripper its state, of an actuator its
position [m or rad]. A gripper gets one of its commands through its input; an actuator a speed
[m/s or rad/s] through ``NAME/speed``, or where to go [m or rad] through ``NAME/position``.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from typing import Any

from gazelle.simulation.ports import Input
from gazelle.simulation.robot import Robot
from gazelle.simulation.topics import absolute
from gazelle.stage.description import (
    StageActuator,
    StageBlobfinder,
    StageBumper,
    StageFiducial,
    StageGripper,
)
from gazelle.stage.fleet import StageFleet
from gazelle.stage.robots import StageRobot
from gazelle.stage.step_output import StepOutput


def open_devices(fleet: StageFleet, robot: Robot) -> None:
    """Open the ports of a robot's devices."""
    own = fleet.named.get(robot.name)
    if own is None:
        return
    for kind, name, which in devices_of(own):
        topic = absolute(robot.name, name)
        produce = _outputs[kind](fleet, robot.name, which)
        robot.outputs[name] = StepOutput(robot, topic, tuple, _of_all_worlds(fleet, produce))
        if kind is StageGripper:
            _command_gripper(fleet, robot, name, which)
        if kind is StageActuator:
            _command_actuator(fleet, robot, name, which)


def devices_of(robot: StageRobot) -> Iterator[tuple[type[Any], str, int]]:
    """Yield kind, name on the robot, and number among those of its kind, in order of numbers."""
    seen: Counter[type[Any]] = Counter()
    for _, model in robot.bodies:
        for placed in model.walk():
            kind = type(placed.model.device)
            if kind in _outputs and kind is not StageActuator:
                yield kind, placed.name.partition(".")[2] or placed.name, seen[kind]
                seen[kind] += 1
    for which, actuator in enumerate(robot.mounted_actuators):
        yield StageActuator, actuator.model.name.removeprefix("/"), which


def _of_all_worlds(fleet: StageFleet, read: Callable[[int], Any]) -> Callable[[], tuple[Any, ...]]:
    """Return a function that calls ``read`` with each world and returns all readings."""
    return lambda: tuple(read(world) for world in range(fleet.nworld))


def _bumps(fleet: StageFleet, name: str, which: int) -> Callable[[int], Any]:
    return lambda world: fleet.bumps(name, which, world)


def _fiducials(fleet: StageFleet, name: str, which: int) -> Callable[[int], Any]:
    return lambda world: tuple(fleet.fiducials(name, which, world))


def _blobs(fleet: StageFleet, name: str, which: int) -> Callable[[int], Any]:
    return lambda world: tuple(fleet.blobs(name, which, world))


def _gripper(fleet: StageFleet, name: str, which: int) -> Callable[[int], Any]:
    return lambda world: fleet.gripper(name, which).state(world)


def _position(fleet: StageFleet, name: str, which: int) -> Callable[[int], Any]:
    return lambda world: float(fleet.actuator(name, which).position[world])


_outputs: dict[type[Any], Callable[[StageFleet, str, int], Callable[[int], Any]]] = {
    StageActuator: _position,
    StageBlobfinder: _blobs,
    StageBumper: _bumps,
    StageFiducial: _fiducials,
    StageGripper: _gripper,
}


def _command_gripper(fleet: StageFleet, robot: Robot, name: str, which: int) -> None:
    robot.inputs[name] = Input(
        absolute(robot.name, f"{name}/command"),
        str,
        lambda command, worlds: fleet.gripper(robot.name, which).do(command, worlds),
    )


def _command_actuator(fleet: StageFleet, robot: Robot, name: str, which: int) -> None:
    def go(speed: float, worlds: Any) -> None:
        fleet.actuator(robot.name, which).set_speed(speed, worlds)

    def go_to(position: float, worlds: Any) -> None:
        fleet.actuator(robot.name, which).go_to(position, worlds)

    for word, receive in (("speed", go), ("position", go_to)):
        topic = absolute(robot.name, f"{name}/{word}")
        robot.inputs[f"{name}/{word}"] = Input(topic, float, receive)
