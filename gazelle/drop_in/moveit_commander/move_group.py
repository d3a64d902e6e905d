"""``MoveGroupCommander``: plans and moves a group of joints."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from gazelle.bridges.conversions import pose_message
from gazelle.drop_in.moveit_client.pose_targets import pose_of_list, stamped
from gazelle.drop_in.moveit_client.retiming import retimed
from gazelle.drop_in.moveit_client.session import LOG, copied
from gazelle.drop_in.moveit_commander.exception import MoveItCommanderException
from gazelle.drop_in.moveit_commander.group_settings import GroupSettings
from gazelle.drop_in.moveit_commander.group_targets import listed
from gazelle.planning import PlanOutcome
from gazelle_ros.errors import RosError
from gazelle_ros.msgs import geometry_msgs, moveit_msgs, trajectory_msgs
from gazelle_ros.time import Time

if TYPE_CHECKING:
    from gazelle.bridges.moveit.error_codes import WithErrorCode
    from gazelle.drop_in.moveit_commander.group_targets import AnyPose

    AnyTrajectory = (
        moveit_msgs.msg.RobotTrajectory | trajectory_msgs.msg.JointTrajectory | tuple[Any, ...]
    )

__all__ = ["MoveGroupCommander"]

_REMOVE = 1


class MoveGroupCommander(GroupSettings):
    """Simple commands for a group.

    Args:
        name: Of the group.
        robot_description: Parameter of the robot.
        ns: Namespace of ``move_group``.
        wait_for_servers: The longest wait for it [s]; for ever if 0.

    Raises:
        RuntimeError: There is no robot, no such group, or no ``move_group``.
    """

    # -- motions -------------------------------------------------------------------------

    def go(self, joints: Any = None, wait: bool = True) -> bool:  # noqa: FBT001, FBT002  # MoveIt's interface
        """Plan and go: to what is given, else to the target that is set; whether it arrived.

        Args:
            joints: A ``JointState``, a ``Pose``, the name of a remembered posture, a mapping or
                values of all variables; a bool stands for ``wait``.
            wait: Whether to wait for the end.
        """
        if isinstance(joints, bool):
            joints, wait = None, joints
        self._set_any(joints)
        return self.move() if wait else self.async_move()

    def plan(
        self, joints: Any = None
    ) -> tuple[bool, moveit_msgs.msg.RobotTrajectory, float, moveit_msgs.msg.MoveItErrorCodes]:
        """Return a plan to the targets, as for `go`.

        Returns:
            Whether there is a plan, a ``RobotTrajectory``, the time that it took [s], and the
            ``MoveItErrorCodes``.
        """
        self._set_any(joints)
        error, trajectory, seconds = self._plan()
        return error.val == PlanOutcome.SUCCESS, trajectory, seconds, error

    def _set_any(self, target: Any) -> None:
        if target is None:
            return
        if getattr(target, "_type", "") == "geometry_msgs/Pose":
            self.set_pose_target(target)
        elif isinstance(target, str) and target in self._remembered:
            self.set_joint_value_target(self._remembered[target])
        else:
            self.set_joint_value_target(target)

    def execute(self, plan_msg: AnyTrajectory, wait: bool = True) -> bool:  # noqa: FBT001, FBT002
        """Execute a ``RobotTrajectory``, a ``JointTrajectory`` or the result of `plan`."""
        found: Any = plan_msg[1] if isinstance(plan_msg, tuple) else plan_msg
        if not hasattr(found, "joint_trajectory"):
            found = moveit_msgs.msg.RobotTrajectory(joint_trajectory=found)
        return self._execute(found) if wait else self._async_execute(found)

    def compute_cartesian_path(
        self,
        waypoints: Sequence[AnyPose],
        eef_step: float,
        jump_threshold: Any = 0.0,
        avoid_collisions: Any = True,  # noqa: FBT002
        path_constraints: moveit_msgs.msg.Constraints | None = None,
    ) -> tuple[moveit_msgs.msg.RobotTrajectory, float]:
        """Return a ``RobotTrajectory`` along straight paths of the end effector.

        Args:
            waypoints: ``Pose`` messages, or lists of six or seven numbers.
            eef_step: Longest step [m].
            jump_threshold: Not read, as in MoveIt since 1.1.15; a bool stands for the next one.
            avoid_collisions: Whether to end where it would collide.
            path_constraints: ``Constraints`` that hold all along.

        Returns:
            The trajectory, and its fraction of the path, from 0 to 1; -1 if it cannot begin.
        """
        if isinstance(jump_threshold, bool):
            if not isinstance(avoid_collisions, bool):
                path_constraints = path_constraints or avoid_collisions
            jump_threshold, avoid_collisions = 0.0, jump_threshold
        if path_constraints and not hasattr(path_constraints, "joint_constraints"):
            raise MoveItCommanderException(
                f"expected moveit_msgs/Constraints, not {type(path_constraints).__name__}"
            )
        poses = [made for each in waypoints if (made := pose_of_list(listed(each))) is not None]
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
            fields["path_constraints"] = path_constraints
        nothing = moveit_msgs.msg.RobotTrajectory()
        try:
            answer = self._actions.call("compute_cartesian_path", "GetCartesianPath", **fields)
        except RosError as error:
            LOG.error("compute_cartesian_path: %s", error)
            return nothing, -1.0
        if answer.error_code.val != PlanOutcome.SUCCESS:
            return nothing, -1.0
        return answer.solution, float(answer.fraction)

    def retime_trajectory(
        self,
        ref_state_in: moveit_msgs.msg.RobotState,
        traj_in: moveit_msgs.msg.RobotTrajectory,
        velocity_scaling_factor: float = 1.0,
        acceleration_scaling_factor: float = 1.0,
        algorithm: str = "iterative_time_parameterization",
    ) -> moveit_msgs.msg.RobotTrajectory | None:
        """Return a ``RobotTrajectory`` along the same path with other times.

        Args:
            ref_state_in: A ``RobotState``: where joints are that the trajectory does not move.
            traj_in: A ``RobotTrajectory``.
            velocity_scaling_factor: Factor of the limits.
            acceleration_scaling_factor: Likewise.
            algorithm: As MoveIt names it; for another one the trajectory is empty.

        Raises:
            DeserializationError: The state names no joints.
        """
        self._read(ref_state_in)
        return retimed(
            self._access.robot,
            traj_in,
            velocity_scaling_factor,
            acceleration_scaling_factor,
            algorithm,
        )

    def construct_motion_plan_request(self) -> moveit_msgs.msg.MotionPlanRequest:
        """Return a ``MotionPlanRequest`` of all that is set."""
        return copied(moveit_msgs.msg.MotionPlanRequest, self._settings.request(self._goals()))

    def move(self) -> bool:
        """Plan and go there; whether it arrived."""
        return _good(self._actions.run("move_group", self._goal(plan_only=False)))

    def async_move(self) -> bool:
        """Start planning and moving, without a wait."""
        self._actions.send("move_group", self._goal(plan_only=False))
        return True

    def stop(self) -> None:
        """Stop what is moving."""
        self._actions.stop()

    # -- objects -------------------------------------------------------------------------

    def attach_object(
        self, object_name: str, link_name: str = "", touch_links: Sequence[str] = ()
    ) -> bool:
        """Attach an object of the scene to a link.

        By default the end effector's, or the group's first.
        """
        links = self._access.names.group_links(self._name)
        holder = link_name or self._poses.link or (links[0] if links else "")
        if not holder:
            LOG.error("No known link to attach object '%s' to", object_name)
            return False
        message = moveit_msgs.msg.AttachedCollisionObject(
            link_name=holder, touch_links=list(touch_links) or [holder]
        )
        message.object.id = object_name
        self._actions.attach(message)
        return True

    def detach_object(self, name: str = "") -> bool:
        """Detach an object, all of a link, or all of the group."""
        links = self._access.names.group_links(self._name)
        kind = moveit_msgs.msg.AttachedCollisionObject
        chosen = [("", name)] if name and name not in links else [
            (link, "") for link in ([name] if name else links)
        ]  # fmt: skip
        for link, thing in chosen:
            message = kind(link_name=link)
            message.object.id, message.object.operation = thing, _REMOVE
            self._actions.attach(message)
        return True

    def pick(self, object_name: str, grasp: Any = (), plan_only: bool = False) -> int:  # noqa: FBT001, FBT002
        """Pick a thing up with one of some ``Grasp`` messages; the error code.

        A bool in place of the grasps is ``plan_only``.
        """
        if isinstance(grasp, bool):
            grasp, plan_only = (), grasp
        given = [grasp] if isinstance(grasp, moveit_msgs.msg.Grasp) else list(grasp)
        goal = moveit_msgs.msg.PickupGoal(
            target_name=object_name, end_effector=self._end_effector(), possible_grasps=given
        )
        return int(self._handle("pickup", goal, plan_only=plan_only).error_code.val)

    def place(self, object_name: str, location: Any = None, plan_only: bool = False) -> bool:  # noqa: FBT001, FBT002
        """Place an attached object at a ``Pose``, ``PoseStamped``, ``PlaceLocation`` or anywhere.

        A list may hold several of the latter two, or the numbers of a pose; a bool in place of the
        location is ``plan_only``.

        Raises:
            MoveItCommanderException: The location is none of these.
        """
        if isinstance(location, bool):
            location, plan_only = None, location
        goal = moveit_msgs.msg.PlaceGoal(
            attached_object_name=object_name, place_locations=self._locations(location)
        )
        return _good(self._handle("place", goal, plan_only=plan_only))

    def _locations(self, location: Any) -> list[moveit_msgs.msg.PlaceLocation] | None:
        """Return ``PlaceLocation`` messages; none for anywhere."""
        if not location:
            return []
        given = location if isinstance(location, list) else [location]
        kinds = {getattr(each, "_type", type(each)) for each in given}
        if kinds == {"moveit_msgs/PlaceLocation"}:
            return given
        if kinds == {"geometry_msgs/PoseStamped"}:
            return [self._location(each) for each in given]
        numbers = kinds <= {int, float}
        if numbers or (kinds == {"geometry_msgs/Pose"} and given is not location):
            pose = pose_of_list(location if numbers else listed(location))
            if pose is not None:
                return [self._location(stamped(pose_message(pose), self._poses.frame))]
        raise MoveItCommanderException(
            "expected a Pose or PoseStamped to place at, a PlaceLocation, or a list of the latter two"
        )

    def _handle(
        self,
        action: str,
        goal: moveit_msgs.msg.PickupGoal | moveit_msgs.msg.PlaceGoal,
        *,
        plan_only: bool,
    ) -> WithErrorCode:
        """Send a goal of ``pickup`` or ``place`` with what is set."""
        settings = self._settings
        goal.group_name, goal.planner_id = self._name, settings.planner
        goal.support_surface_name = settings.support
        goal.allow_gripper_support_collision = bool(settings.support)
        goal.allowed_planning_time = settings.time
        if settings.path is not None:
            goal.path_constraints = settings.path
        goal.planning_options = settings.options(plan_only=plan_only)
        result: WithErrorCode = self._actions.run(action, goal)
        return result

    def _end_effector(self) -> str:
        """Return the end effector that holds the link which poses are of."""
        for each in self._joints.group.effectors:
            links = self._access.names.group_links(each.group)
            if self._poses.link == each.parent_link or self._poses.link in links:
                return each.name
        return ""

    def _location(self, target: geometry_msgs.msg.PoseStamped) -> moveit_msgs.msg.PlaceLocation:
        """Return a ``PlaceLocation``: from above, and away along the end effector, as MoveIt fills it."""
        made = moveit_msgs.msg.PlaceLocation(place_pose=target)
        down, away = made.pre_place_approach, made.post_place_retreat
        down.direction.header.frame_id = self.get_planning_frame()
        down.direction.vector.z, down.min_distance, down.desired_distance = -1.0, 0.1, 0.2
        away.direction.header.frame_id = self._poses.link
        away.direction.vector.x, away.desired_distance = -1.0, 0.2
        down.direction.header.stamp = away.direction.header.stamp = Time()
        return made

    # -- what MoveIt's C++ class does ------------------------------------------------------

    def _goal(self, *, plan_only: bool) -> moveit_msgs.msg.MoveGroupGoal:
        made = moveit_msgs.msg.MoveGroupGoal()
        made.request = self._settings.request(self._goals())
        made.planning_options = self._settings.options(plan_only=plan_only)
        return made

    def _plan(
        self,
    ) -> tuple[moveit_msgs.msg.MoveItErrorCodes, moveit_msgs.msg.RobotTrajectory, float]:
        """Plan; a ``MoveItErrorCodes``, a ``RobotTrajectory``, and how long it took [s]."""
        result: moveit_msgs.msg.MoveGroupResult = self._actions.run(
            "move_group", self._goal(plan_only=True)
        )
        return result.error_code, result.planned_trajectory, result.planning_time

    def _execute(self, trajectory: moveit_msgs.msg.RobotTrajectory) -> bool:
        """Execute a ``RobotTrajectory``; returns whether it arrived."""
        return _good(self._actions.run("execute_trajectory", _to_execute(trajectory)))

    def _async_execute(self, trajectory: moveit_msgs.msg.RobotTrajectory) -> bool:
        """Start executing a ``RobotTrajectory``, without a wait."""
        self._actions.send("execute_trajectory", _to_execute(trajectory))
        return True


def _good(result: WithErrorCode) -> bool:
    return bool(result.error_code.val == PlanOutcome.SUCCESS)


def _to_execute(
    trajectory: moveit_msgs.msg.RobotTrajectory,
) -> moveit_msgs.msg.ExecuteTrajectoryGoal:
    return moveit_msgs.msg.ExecuteTrajectoryGoal(trajectory=trajectory)
