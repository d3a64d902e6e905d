"""``MoveGroupInterface``: plans and moves a group through ``move_group``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle.bridges.moveit.client.group_settings import GroupSettings
from gazelle.bridges.moveit.client.pose_targets import pose_of_list, stamped
from gazelle.bridges.moveit.client.retiming import retimed
from gazelle.bridges.moveit.client.session import LOG, packed, unpacked
from gazelle.bridges.moveit.frames import pose_message
from gazelle.planning import PlanOutcome
from gazelle.ros.errors import RosError
from gazelle.ros.messages import load_message
from gazelle.ros.time import Time

_REMOVE = 1


class MoveGroupInterface(GroupSettings):
    """As ``moveit_ros_planning_interface._moveit_move_group_interface`` has it."""

    # -- plans ---------------------------------------------------------------------------

    def construct_motion_plan_request(self) -> bytes:
        """A ``MotionPlanRequest`` of all that is set."""
        return packed(self._settings.request(self._goals()))

    def _goal(self, *, plan_only: bool) -> Any:
        made: Any = load_message("moveit_msgs/MoveGroupGoal")()
        made.request = self._settings.request(self._goals())
        made.planning_options = self._settings.options(plan_only=plan_only)
        return made

    def plan(self) -> tuple[bytes, bytes, float]:
        """Plan; an error code, a ``RobotTrajectory``, and how long it took [s]."""
        result = self._actions.run("move_group", self._goal(plan_only=True))
        return packed(result.error_code), packed(result.planned_trajectory), result.planning_time

    def compute_cartesian_path(
        self,
        waypoints: Sequence[Sequence[float]],
        eef_step: float,
        jump_threshold: Any = 0.0,
        avoid_collisions: Any = True,  # noqa: FBT002  # MoveIt's interface
        path_constraints: bytes | None = None,
    ) -> tuple[bytes, float]:
        """A ``RobotTrajectory`` along straight ways, and how much of them it does.

        Since 1.1.15 MoveIt has no ``jump_threshold``, and a bool in its place says whether to avoid
        collisions; both are understood.

        Returns:
            The trajectory and a fraction from 0 to 1; -1 if it cannot begin.
        """
        if isinstance(jump_threshold, bool):
            if isinstance(avoid_collisions, bytes):
                path_constraints = avoid_collisions
            jump_threshold, avoid_collisions = 0.0, jump_threshold
        poses = [pose for each in waypoints if (pose := pose_of_list(each)) is not None]
        fields: dict[str, Any] = {
            "start_state": self._settings.start,
            "group_name": self._name,
            "link_name": self._poses.link,
            "waypoints": [pose_message(pose) for pose in poses],
            "max_step": float(eef_step),
            "jump_threshold": float(jump_threshold),
            "avoid_collisions": bool(avoid_collisions),
            "cartesian_speed_limited_link": self._settings.fastest[0],
            "max_cartesian_speed": self._settings.fastest[1],
            "header": stamped(None, self._poses.frame).header,
        }
        if path_constraints:
            fields["path_constraints"] = unpacked("moveit_msgs/Constraints", path_constraints)
        nothing = packed(load_message("moveit_msgs/RobotTrajectory")())
        try:
            answer = self._actions.ask("compute_cartesian_path", "GetCartesianPath", **fields)
        except RosError as error:
            LOG.error("compute_cartesian_path: %s", error)
            return nothing, -1.0
        if answer.error_code.val != PlanOutcome.SUCCESS:
            return nothing, -1.0
        return packed(answer.solution), float(answer.fraction)

    def retime_trajectory(
        self, state: bytes, trajectory: bytes, velocity: float, acceleration: float, algorithm: str
    ) -> bytes:
        """A ``RobotTrajectory`` with other times; an empty one if there is no such algorithm.

        Args:
            state: A ``RobotState``: where joints are that the trajectory does not move.
            trajectory: A ``RobotTrajectory``.
            velocity: Factor of the limits.
            acceleration: Likewise.
            algorithm: As MoveIt names it, such as ``time_optimal_trajectory_generation``.
        """
        start = unpacked("moveit_msgs/RobotState", state)
        if self._access.with_message(start, self._access.default()) is None:
            return b""
        path = unpacked("moveit_msgs/RobotTrajectory", trajectory)
        return packed(retimed(self._access.robot, path, velocity, acceleration, algorithm))

    # -- motions -------------------------------------------------------------------------

    def move(self) -> bool:
        """Plan and go there; whether it arrived."""
        return _good(self._actions.run("move_group", self._goal(plan_only=False)))

    def async_move(self) -> bool:
        """Have it plan and go there, without a wait."""
        self._actions.send("move_group", self._goal(plan_only=False))
        return True

    def execute(self, trajectory: bytes) -> bool:
        """Go along a ``RobotTrajectory``; whether it arrived."""
        return _good(self._actions.run("execute_trajectory", _to_execute(trajectory)))

    def async_execute(self, trajectory: bytes) -> bool:
        """Have it go along a ``RobotTrajectory``, without a wait."""
        self._actions.send("execute_trajectory", _to_execute(trajectory))
        return True

    def stop(self) -> None:
        """Stop what is moving."""
        self._actions.stop()

    # -- objects -------------------------------------------------------------------------

    def attach_object(self, name: str, link: str, touch_links: Sequence[str]) -> bool:
        """Have a link hold a thing of the scene; the end effector's, or the group's first one."""
        links = self._access.names.group_links(self._name)
        holder = link or self._poses.link or (links[0] if links else "")
        if not holder:
            LOG.error("No known link to attach object '%s' to", name)
            return False
        message: Any = load_message("moveit_msgs/AttachedCollisionObject")(
            link_name=holder, touch_links=list(touch_links) or [holder]
        )
        message.object.id = name
        self._actions.attach(message)
        return True

    def detach_object(self, name: str = "") -> bool:
        """Leave a thing, all that a link holds, or all that the group does."""
        links = self._access.names.group_links(self._name)
        kind = load_message("moveit_msgs/AttachedCollisionObject")
        chosen = [("", name)] if name and name not in links else [
            (link, "") for link in ([name] if name else links)
        ]  # fmt: skip
        for link, thing in chosen:
            message: Any = kind(link_name=link)
            message.object.id, message.object.operation = thing, _REMOVE
            self._actions.attach(message)
        return True

    def pick(
        self,
        object_name: str,
        grasps: bytes | Sequence[bytes] | bool = (),  # noqa: FBT001
        plan_only: bool = False,  # noqa: FBT001, FBT002
    ) -> int:
        """Pick a thing up with one of some ``Grasp`` messages; the error code."""
        if isinstance(grasps, bool):
            return self.pick(object_name, (), grasps)
        given = [grasps] if isinstance(grasps, bytes) else list(grasps)
        goal: Any = load_message("moveit_msgs/PickupGoal")(
            target_name=object_name,
            end_effector=self._end_effector(),
            possible_grasps=[unpacked("moveit_msgs/Grasp", each) for each in given],
        )
        return int(self._handle("pickup", goal, plan_only=plan_only).error_code.val)

    def place(
        self,
        object_name: str,
        location: bytes | Sequence[float] | bool = False,  # noqa: FBT001, FBT002
        plan_only: bool = False,  # noqa: FBT001, FBT002
    ) -> bool:
        """Place what is held: at a ``PlaceLocation``, at a pose of seven numbers, or anywhere."""
        if isinstance(location, bool):
            return self._place(object_name, [], plan_only=location)
        if isinstance(location, bytes):
            return self.place_locations_list(object_name, [location], plan_only)
        pose = pose_of_list(location)
        target = stamped(pose_message(pose), self._poses.frame) if pose is not None else None
        made = [] if target is None else [self._location(target)]
        return bool(made) and self._place(object_name, made, plan_only=plan_only)

    def place_poses_list(
        self,
        object_name: str,
        poses: Sequence[bytes],
        plan_only: bool = False,  # noqa: FBT001, FBT002
    ) -> bool:
        """Place what is held at one of some ``PoseStamped`` messages."""
        targets = [unpacked("geometry_msgs/PoseStamped", each) for each in poses]
        made = [self._location(target) for target in targets]
        return self._place(object_name, made, plan_only=plan_only)

    def place_locations_list(
        self,
        object_name: str,
        locations: Sequence[bytes],
        plan_only: bool = False,  # noqa: FBT001, FBT002
    ) -> bool:
        """Place what is held at one of some ``PlaceLocation`` messages."""
        made = [unpacked("moveit_msgs/PlaceLocation", each) for each in locations]
        return self._place(object_name, made, plan_only=plan_only)

    def _place(self, name: str, locations: list[Any], *, plan_only: bool) -> bool:
        goal: Any = load_message("moveit_msgs/PlaceGoal")(
            attached_object_name=name, place_locations=locations
        )
        return _good(self._handle("place", goal, plan_only=plan_only))

    def _handle(self, action: str, goal: Any, *, plan_only: bool) -> Any:
        """Send a goal of ``pickup`` or ``place`` with what is set."""
        settings = self._settings
        goal.group_name, goal.planner_id = self._name, settings.planner
        goal.support_surface_name = settings.support
        goal.allow_gripper_support_collision = bool(settings.support)
        goal.allowed_planning_time = settings.time
        if settings.path is not None:
            goal.path_constraints = settings.path
        goal.planning_options = settings.options(plan_only=plan_only)
        return self._actions.run(action, goal)

    def _end_effector(self) -> str:
        """The end effector that holds the link which poses are of."""
        for each in self._joints.group.effectors:
            links = self._access.names.group_links(each.group)
            if self._poses.link == each.parent_link or self._poses.link in links:
                return each.name
        return ""

    def _location(self, target: Any) -> Any:
        """A ``PlaceLocation``: from above, and away along the end effector, as MoveIt fills it."""
        made: Any = load_message("moveit_msgs/PlaceLocation")(place_pose=target)
        down, away = made.pre_place_approach, made.post_place_retreat
        down.direction.header.frame_id = self.get_planning_frame()
        down.direction.vector.z, down.min_distance, down.desired_distance = -1.0, 0.1, 0.2
        away.direction.header.frame_id = self._poses.link
        away.direction.vector.x, away.desired_distance = -1.0, 0.2
        down.direction.header.stamp = away.direction.header.stamp = Time()
        return made


def _good(result: Any) -> bool:
    return bool(result.error_code.val == PlanOutcome.SUCCESS)


def _to_execute(trajectory: bytes) -> Any:
    return load_message("moveit_msgs/ExecuteTrajectoryGoal")(
        trajectory=unpacked("moveit_msgs/RobotTrajectory", trajectory)
    )
