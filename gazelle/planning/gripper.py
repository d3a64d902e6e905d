"""The gripper of a robot in a running simulation: open it, close it, and get the outcome."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.control import GoalState
from gazelle.control.values import GripperGoal, GripperResult
from gazelle.errors import PlanningError, did_you_mean
from gazelle.simulation.inputs import one_world
from gazelle.simulation.robot import Robot

_ACTIONS = ("gripper_cmd", "gripper_action")
_STEP = 0.01
_PATIENCE = 10.0


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class GripperReport:
    """Result of a gripper motion.

    Attributes:
        reached: Whether it is where it should be.
        stalled: Whether something, which it may hold, keeps it from there.
        position: Reported by its controller [m or rad].
        message: From the controller.
        seconds: Simulated time that it took [s].
    """

    reached: bool
    stalled: bool
    position: float
    message: str
    seconds: float

    def __bool__(self) -> bool:
        return self.reached


@checked(PlanningError)
class RobotGripper:
    """A gripper that a controller of the robot's moves (``GripperActionController`` and similar ones).

    Args:
        robot: As ``Simulation.spawn`` gave it.
        name: Of the running controller; the only one with a gripper's action if None.
        world: World of the simulation.

    Attributes:
        name: Of the controller.
        joints: Joints that it moves.

    Raises:
        PlanningError: There is no such running controller, or there are several.
    """

    def __init__(self, robot: Robot, name: str | None = None, *, world: int = 0) -> None:
        self._robot, self._world = robot, one_world(world, robot.simulation.nworld)
        found = {
            each.controller.name: each
            for each in robot.controllers.loaded
            if each.state == "running" and any(key in each.controller.actions for key in _ACTIONS)
        }
        if name is None and len(found) != 1:
            raise PlanningError(
                f"'{robot.name}' has {len(found)} running controllers of grippers, not one",
                hint="name it: " + ", ".join(found) if found else "load and start one",
            )
        self.name = next(iter(found)) if name is None else name
        if self.name not in found:
            raise PlanningError(
                f"'{robot.name}' has no running controller of a gripper called '{name}'",
                hint=did_you_mean(self.name, found),
            )
        claimed = found[self.name].info.claimed.values()
        self.joints = tuple(dict.fromkeys(joint for joints in claimed for joint in joints))

    def move(self, position: float, effort: float = 0.0) -> GripperReport:
        """Move the gripper, stepping the simulation until it arrives, stalls, or times out.

        Args:
            position: As its controller takes it: of its joint, or the whole opening [m or rad].
            effort: Largest one [N or N m]; zero is what the controller makes of it.
        """
        controller = self._robot.controllers[self.name]
        action = next(controller.actions[key] for key in _ACTIONS if key in controller.actions)
        simulation = self._robot.simulation
        begun, value = simulation.time, GripperGoal(position, effort)
        goal = action.send(value, np.array([self._world]))
        while not goal.done and simulation.time - begun < _PATIENCE:
            simulation.run(_STEP)
        result = goal.result or GripperResult()
        reached = goal.state == GoalState.SUCCEEDED and not result.stalled
        text = "" if reached else goal.text or goal.state.name.lower()
        if not goal.done:
            goal.cancel()
            text = f"it was not there after {_PATIENCE:g} s"
        seconds = simulation.time - begun
        return GripperReport(reached, bool(result.stalled), float(result.position), text, seconds)

    def take(self, posture: Mapping[str, float], effort: float = 0.0) -> GripperReport:
        """Move its joints to positions by name; a controller of several joints gets their sum.

        Raises:
            PlanningError: None of its joints is named.
        """
        own = [posture[joint] for joint in self.joints if joint in posture]
        if not own:
            raise PlanningError(
                f"the posture names none of the joints of '{self.name}'",
                hint="they are " + ", ".join(self.joints),
            )
        return self.move(float(sum(own)), effort)
