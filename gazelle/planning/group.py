"""A group of joints of a robot in a running simulation: plan from where it is, and go there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.description import Plane, Pose, Semantics
from gazelle.errors import PlanningError, did_you_mean
from gazelle.formats import Resolver, load_srdf
from gazelle.kinematics.joint_group import JointModelGroup
from gazelle.kinematics.robot_model import RobotModel
from gazelle.kinematics.variables import JointBounds
from gazelle.planning.cartesian_path import JumpLimits
from gazelle.planning.constraints import ConstraintSet
from gazelle.planning.execution import Execution, ExecutionReport, begin_execution
from gazelle.planning.goal_states import Goal
from gazelle.planning.grasps import Grasp, PlaceLocation
from gazelle.planning.gripper import RobotGripper
from gazelle.planning.manipulation import Manipulation
from gazelle.planning.manipulation_plan import ContactRules
from gazelle.planning.motion_planner import MotionPlan, MotionPlanner, PlanOptions
from gazelle.planning.pick_place import PickPlacePlanner
from gazelle.planning.scene import PlanningScene
from gazelle.planning.scene_objects import SceneObject
from gazelle.simulation.inputs import one_world
from gazelle.simulation.joint_motion import JointMotion
from gazelle.simulation.robot import Robot

START_TOLERANCE = 0.01
"""Tolerance of joints about the start of a plan [m or rad] (MoveIt's allowed_start_tolerance)."""


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class GroupPlan:
    """A plan for a robot in a simulation.

    Attributes:
        plan: Plan.
        fraction: Completed part of the request: less than 1 only for straight paths.
        reason: Reason of an early end.
    """

    plan: MotionPlan
    group: Group
    fraction: float = 1.0
    reason: str = ""

    @property
    def duration(self) -> float:
        """Duration [s]."""
        return self.plan.trajectory.duration

    def start(self) -> Execution:
        """Send the plan to the robot's trajectory controllers, without stepping the simulation.

        Raises:
            PlanningError: The robot is not where the plan begins, or no running controllers move
                these joints.
        """
        self.group.check_start(self.plan)
        self.group.publish(self.plan)
        return begin_execution(self.group.robot, self.plan, self.group.world)

    def run(self) -> ExecutionReport:
        """Execute the plan, stepping the simulation; returns when it is done, or times out.

        Raises:
            PlanningError: As ``start``.
        """
        return self.start().run()


@checked(PlanningError)
class Group:
    """A group of joints of a robot in a running simulation.

    Args:
        robot: The robot, as ``Simulation.spawn`` gave it.
        name: Of the group in its SRDF; or, without one, of a trajectory controller, whose joints are
            the group, with ``_controller`` after it or not.
        semantics: The SRDF, or a file of it. If None, that of the robot's ``NAME_moveit_config``
            package is looked for.
        options: Planning options.
        limits: Limits of joints, in place of the description's.
        tip: The link that poses are of, if the SRDF does not name one.
        world: World of the simulation.

    Attributes:
        robot: The robot.
        scene: Planning scene, in the frame of the robot's root link. Add to it.
        model: The robot's group.
        options: Planning options; may be replaced.

    Raises:
        PlanningError: There is no such group.
    """

    def __init__(
        self,
        robot: Robot,
        name: str,
        *,
        semantics: Semantics | str | PathLike[str] | None = None,
        options: PlanOptions | None = None,
        limits: Mapping[str, JointBounds] | None = None,
        tip: str | None = None,
        world: int = 0,
    ) -> None:
        self.robot, self.world = robot, one_world(world, robot.simulation.nworld)
        self.options = options or PlanOptions()
        found = _semantics(robot, semantics)
        model = RobotModel(robot.description, found, limits)
        self.scene = PlanningScene(model)
        groups = [group.name for group in found.groups] if found is not None else []
        if name in groups:
            self.model = model.group(name)
        else:
            self.model = _controlled(robot, model, name, groups)
        self._tip = tip

    # -- where it is ---------------------------------------------------------------------

    @property
    def tip(self) -> str:
        """The link that poses are of.

        Raises:
            PlanningError: The group has several ends, and none was named.
        """
        return self.model.tip if self._tip is None else self._tip

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the joints."""
        return self.model.names

    @property
    def positions(self) -> Floats:
        """Positions of its joints [m or rad], shape (n,)."""
        return self.state()[self.model.columns]

    def state(self) -> Floats:
        """Return the positions of all the robot's joints, shape (variables,); update the scene."""
        made = self.scene.robot.zero()
        rows = np.array([self.world])
        for column, name in enumerate(self.scene.robot.names):
            if name in self.robot.joints:
                made[column] = self.robot.joints[name].positions(rows)[0, 0]
        self.scene.state = made
        return made.copy()

    def pose(self, link: str | None = None) -> Pose:
        """Return the pose of a link in the frame of the robot's root link; of the tip if None."""
        return self.scene.robot.pose(self.state(), self.tip if link is None else link)

    @property
    def base(self) -> Pose:
        """Pose of the robot's root link in the world: ``base.inverse() * pose`` is in its frame."""
        root, rows = self.scene.robot.root, np.array([self.world])
        if root in self.robot.links:
            placed = self.robot.links[root].placement(rows)
        else:
            placed = self.robot.placement(rows)
        return placed.first()

    def see(self, *names: str) -> None:
        """Add other models of the simulation to the scene, at their present poses.

        Each of their links becomes an object ``MODEL::LINK``; seen again it is replaced.

        Args:
            names: Models; all but this robot if none.

        Raises:
            PlanningError: There is no such model.
        """
        others = self.robot.simulation.robots
        selected = names or [name for name in others if name != self.robot.name]
        back, rows = self.base.inverse(), np.array([self.world])
        for name in selected:
            if name not in others:
                hint = did_you_mean(name, others)
                raise PlanningError(f"the simulation has no model '{name}'", hint=hint)
            for link in others[name].description.links:
                shapes = tuple((each.geometry, each.pose) for each in link.collisions)
                placed = others[name].links[link.name].placement(rows)
                pose = Pose.from_quaternion(
                    placed.position[0].tolist(), placed.quaternion[0].tolist()
                )
                if shapes:
                    made = SceneObject(f"{name}::{link.name}", shapes, back * pose)
                    self.scene.add_object(made)
                    self._let_stand(made)

    def _let_stand(self, made: SceneObject) -> None:
        """Allow contact of the root link with an object that the robot stands on."""
        if any(isinstance(shape, Plane) for shape, _ in made.shapes):
            self.scene.allow(made.name, self.scene.robot.root)

    # -- plans ---------------------------------------------------------------------------

    def plan(
        self, goal: Goal, *, constraints: ConstraintSet | None = None, link: str | None = None
    ) -> GroupPlan:
        """Return a plan from the robot's state to a goal.

        Args:
            goal: A pose of the tip in the frame of the robot's root link, the name of a state of the
                group, positions by joint or of all joints, or constraints.
            constraints: Constraints along the path.
            link: Link of a pose; the tip if None.

        Raises:
            NoPlanError: There is none, and why.
            PlanningError: The goal names what is not there.
        """
        start = self.state()
        link = (self.tip if isinstance(goal, Pose) else None) if link is None else link
        found = self._planner().plan(goal, start=start, link=link, constraints=constraints)
        self.publish(found)
        return GroupPlan(found, self)

    def follow(
        self,
        poses: Sequence[Pose],
        *,
        max_step: float = 0.01,
        jumps: JumpLimits | None = None,
        avoid_collisions: bool = True,
        constraints: ConstraintSet | None = None,
    ) -> GroupPlan:
        """Return a plan along straight paths of the tip, as far as possible; see its ``fraction``.

        Args:
            poses: One after another, in the frame of the robot's root link.
            max_step: Longest step [m].
            jumps: Largest jumps of joints, at which it is cut off.
            avoid_collisions: Whether it ends where it would collide.
            constraints: Constraints along the path.

        Raises:
            PlanningError: The step is not above zero, there are no poses, one is not finite, or
                the path has more steps than there may be.
        """
        plan, path = self._planner().follow(
            poses,
            max_step=max_step,
            start=self.state(),
            link=self.tip,
            jumps=jumps,
            avoid_collisions=avoid_collisions,
            constraints=constraints,
        )
        self.publish(plan)
        return GroupPlan(plan, self, path.fraction, path.reason)

    def go(self, goal: Goal) -> ExecutionReport:
        """Plan to a goal and go there: ``plan(goal).run()``."""
        return self.plan(goal).run()

    def pick(
        self,
        name: str,
        grasps: Sequence[Grasp],
        *,
        effector: str = "",
        gripper: RobotGripper | None = None,
        rules: ContactRules | None = None,
    ) -> Manipulation:
        """Return a plan to pick up an object of the scene with the gripper; ``run`` it.

        Args:
            name: Of the object, as ``scene`` has it.
            grasps: Of which one is taken, better ones first (``box_grasps``).
            effector: Name of the end effector in the SRDF; the group's one if empty.
            gripper: Gripper that closes; the robot's one if None.
            rules: Contact rules.

        Raises:
            NoPlanError: No grasp can be done, and why.
            PlanningError: There is no such end effector, or no gripper.
        """
        state = self.state()
        planner = PickPlacePlanner(self.scene, self.model, effector, self.options)
        plan = planner.pick(name, grasps, start=state, rules=rules)
        return Manipulation(plan, self, gripper or RobotGripper(self.robot, world=self.world))

    def place(
        self,
        name: str,
        places: Sequence[PlaceLocation],
        *,
        effector: str = "",
        gripper: RobotGripper | None = None,
        rules: ContactRules | None = None,
    ) -> Manipulation:
        """Return a plan to place an attached object; see ``pick``.

        Raises:
            NoPlanError: It can be put down at none of the places, and why.
            PlanningError: There is no such end effector, or no gripper.
        """
        state = self.state()
        planner = PickPlacePlanner(self.scene, self.model, effector, self.options)
        plan = planner.place(name, places, start=state, rules=rules)
        return Manipulation(plan, self, gripper or RobotGripper(self.robot, world=self.world))

    def check_start(self, plan: MotionPlan) -> None:
        """Check that the robot is at the start of a plan.

        Raises:
            PlanningError: It is not.
        """
        here = self.state()[self.model.columns]
        there = plan.trajectory.positions[0]
        away = np.abs(self.model.difference(here, there))
        if away.max(initial=0.0) > START_TOLERANCE:
            worst = int(np.argmax(away))
            raise PlanningError(
                f"joint '{self.names[worst]}' is at {here[worst]:.4f}, and the plan begins at "
                f"{there[worst]:.4f}",
                hint="plan again from where the robot is",
            )

    def publish(self, plan: MotionPlan) -> None:
        """Publish a plan to listeners of ``simulation.events.planned``.

        Raises:
            PlanningError: The plan is of another robot.
        """
        try:
            tip = self.tip
        except PlanningError:  # it has several ends
            tip = ""
        path, names = plan.trajectory, self.scene.robot.names
        if plan.start.shape != (len(names),) or path.positions.shape[1:] != (len(plan.names),):
            raise PlanningError(f"the plan for '{plan.group.name}' is of another robot")
        start = dict(zip(names, plan.start.tolist(), strict=True))
        motion = JointMotion(plan.names, path.times, path.positions, start, tip)
        self.robot.simulation.events.planned.emit(self.robot, self.world, motion)

    def _planner(self) -> MotionPlanner:
        return MotionPlanner(self.scene, self.model, self.options)


def _semantics(robot: Robot, semantics: Semantics | str | PathLike[str] | None) -> Semantics | None:
    """Return the given SRDF, or that of the robot's MoveIt package, if there is one."""
    if isinstance(semantics, Semantics):
        return semantics
    if semantics is not None:
        return load_srdf(semantics)
    source = robot.description.source
    file = Path(source.file) if source is not None and source.file else None
    for name in dict.fromkeys((robot.description.name, robot.name)):
        uri = f"package://{name}_moveit_config/config/{name}.srdf"
        found = Resolver(file=file).find(uri)
        if found is not None:
            return load_srdf(found)
    return None


def _controlled(
    robot: Robot, model: RobotModel, name: str, groups: Sequence[str]
) -> JointModelGroup:
    """Return the joints of a trajectory controller as a group."""
    from gazelle.planning.execution import trajectory_controllers

    joints = trajectory_controllers(robot)
    for key in (name, f"{name}_controller"):
        if key in joints:
            return model.group_of(joints[key], name)
    raise PlanningError(
        f"'{robot.name}' has no group '{name}', and no trajectory controller of that name",
        hint=did_you_mean(name, [*groups, *joints])
        if groups or joints
        else "give semantics=, the robot's SRDF",
    )
