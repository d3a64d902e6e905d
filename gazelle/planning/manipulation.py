"""Objects taken and put down by a robot in a simulation: a plan, stage by stage."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.errors import PlanningError
from gazelle.planning.execution import ExecutionReport, begin_execution
from gazelle.planning.gripper import GripperReport, RobotGripper
from gazelle.planning.manipulation_plan import ManipulationPlan, ManipulationStage
from gazelle.planning.motion_planner import MotionPlan
from gazelle.planning.outcomes import PlanOutcome
from gazelle.planning.scene import PlanningScene
from gazelle.simulation.robot import Robot


class MovingGroup(Protocol):
    """Interface of the group (``Group``) that is needed."""

    robot: Robot
    world: int
    scene: PlanningScene

    def state(self) -> Floats:
        """Return the positions of all joints; update the scene."""

    def check_start(self, plan: MotionPlan) -> None:
        """Check that the robot is at the start of a plan."""

    def publish(self, plan: MotionPlan) -> None:
        """Publish a plan to viewers."""


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class Manipulation:
    """A plan to take an object, or to put it down, for a robot in a simulation."""

    plan: ManipulationPlan
    group: MovingGroup
    gripper: RobotGripper

    def run(self) -> ExecutionReport:
        """Execute all of it, stepping the simulation.

        The scene has the object attached or detached.

        Returns:
            How it ended; what fails is the last that was done.
        """
        seconds = 0.0
        for stage in self.plan.stages:
            done = self._do(stage)
            seconds += done.seconds
            if not done:
                text = f"{stage.name}: {done.message}"
                return ExecutionReport(done.outcome, text, seconds)
            self.group.state()  # the scene knows where it is
            if stage.then == "attach":
                scene, plan = self.group.scene, self.plan
                scene.attach(plan.object, plan.link, sorted(plan.touch_links))
            elif stage.then == "detach":
                self.group.scene.detach(self.plan.object)
        return ExecutionReport(PlanOutcome.SUCCESS, "", seconds)

    def _do(self, stage: ManipulationStage) -> ExecutionReport:
        if stage.motion is not None:
            self.group.check_start(stage.motion)
            self.group.publish(stage.motion)
            execution = begin_execution(self.group.robot, stage.motion, self.group.world)
            return execution.run()
        report: GripperReport = self.gripper.take(stage.posture, stage.effort)
        if report.reached or report.stalled:
            return ExecutionReport(PlanOutcome.SUCCESS, "", report.seconds)
        return ExecutionReport(PlanOutcome.CONTROL_FAILED, report.message, report.seconds)
