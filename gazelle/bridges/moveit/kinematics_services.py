"""The services ``compute_ik``, ``compute_fk`` and ``check_state_validity``."""

from __future__ import annotations

import math
from functools import partial

from gazelle.array_types import Floats
from gazelle.bridges.conversions import set_point
from gazelle.bridges.moveit.constraint_messages import weights_of_message
from gazelle.bridges.moveit.frames import stamped_message
from gazelle.bridges.moveit.planning_context import LOG, PlanningContext
from gazelle.bridges.moveit.robot_states import state_message
from gazelle.errors import PlanningError
from gazelle.kinematics import InverseKinematics, JointModelGroup
from gazelle.planning import (
    ConstraintSet,
    NoPlanError,
    PlanningScene,
    PlanOutcome,
    SceneContact,
    goal_of_pose,
)
from gazelle.planning.goal_states import GoalStates
from gazelle.planning.state_validity import StateValidity
from gazelle_ros.msgs import geometry_msgs, moveit_msgs
from gazelle_ros.time import Time

_LINK, _OBJECT, _ATTACHED = 0, 1, 2
_EXACT = (1e-5, 1e-5)
"""Tolerance of the poses of several links at once [m, rad]; one alone comes as near."""


class KinematicsServices:
    """Answers what positions and poses go together, and which states can be.

    Args:
        context: The robot and its scene.
    """

    def __init__(self, context: PlanningContext) -> None:
        self._context = context
        srv = moveit_msgs.srv
        context.serve("compute_ik", srv.GetPositionIK, self._answer_inverse)
        context.serve("compute_fk", srv.GetPositionFK, self._answer_forward)
        context.serve("check_state_validity", srv.GetStateValidity, self._validity)

    # -- inverse -------------------------------------------------------------------------

    def _answer_inverse(
        self, request: moveit_msgs.srv.GetPositionIKRequest
    ) -> moveit_msgs.srv.GetPositionIKResponse:
        response = moveit_msgs.srv.GetPositionIKResponse()
        return self._context.answer(response, partial(self._inverse, request), "PositionIK")

    def _inverse(
        self,
        request: moveit_msgs.srv.GetPositionIKRequest,
        response: moveit_msgs.srv.GetPositionIKResponse,
    ) -> None:
        query, context = request.ik_request, self._context
        group = context.group(query.group_name)
        state = context.state(query.robot_state)
        constraints = context.constraints(query.constraints, state)
        targets = _targets(query)
        scene = context.scene_in(query.robot_state, state)
        validity = StateValidity(
            scene, group, state, constraints, collisions=query.avoid_collisions
        )
        if len(targets) > 1:
            found = self._together(validity, state, targets)
        else:
            found = self._alone(validity, state, *targets[0], timeout=query.timeout.to_sec())
        state[group.columns] = found
        response.solution = state_message(context.robot, context.robot.complete(state))

    def _alone(
        self,
        validity: StateValidity,
        state: Floats,
        link: str | None,
        stamped: geometry_msgs.msg.PoseStamped,
        timeout: float,
    ) -> Floats:
        """Return positions of a group with one link at its pose."""
        pose = self._context.frames.pose(stamped, state)
        solver = self._solver(validity.group, link)
        found = solver.solve(pose, state, valid=validity, timeout=timeout or math.inf)
        if found is None:
            raise NoPlanError(
                f"no inverse kinematics solution of '{validity.group.name}' for '{solver.link}' at this pose",
                PlanOutcome.NO_IK_SOLUTION,
            )
        return found

    def _together(
        self,
        validity: StateValidity,
        state: Floats,
        targets: list[tuple[str | None, geometry_msgs.msg.PoseStamped]],
    ) -> Floats:
        """Return positions of a group with several links at their poses.

        Each has joints of its own.
        """
        group, frames = validity.group, self._context.frames
        parts = [
            goal_of_pose(link or group.tip, frames.pose(stamped, state), *_EXACT)
            for link, stamped in targets
        ]
        goal = ConstraintSet(
            positions=tuple(each for part in parts for each in part.positions),
            orientations=tuple(each for part in parts for each in part.orientations),
        )
        try:
            found: Floats = GoalStates(validity, state[group.columns]).find(goal)[0]
        except PlanningError as error:  # whatever it is, MoveIt has one word for it
            raise NoPlanError(error.message, PlanOutcome.NO_IK_SOLUTION, error.hint) from None
        return found

    def _solver(self, group: JointModelGroup, link: str | None) -> InverseKinematics:
        try:
            return InverseKinematics(self._context.robot, group, link)
        except PlanningError as error:  # as MoveIt has it: there is no solver for such a link
            raise NoPlanError(error.message, PlanOutcome.NO_IK_SOLUTION, error.hint) from None

    # -- forward -------------------------------------------------------------------------

    def _answer_forward(
        self, request: moveit_msgs.srv.GetPositionFKRequest
    ) -> moveit_msgs.srv.GetPositionFKResponse:
        response = moveit_msgs.srv.GetPositionFKResponse()
        return self._context.answer(response, partial(self._forward, request), "PositionFK")

    def _forward(
        self,
        request: moveit_msgs.srv.GetPositionFKRequest,
        response: moveit_msgs.srv.GetPositionFKResponse,
    ) -> None:
        context, robot = self._context, self._context.robot
        if not request.fk_link_names:
            raise NoPlanError("no links are named", PlanOutcome.INVALID_LINK_NAME)
        state = context.state(request.robot_state)
        frame = request.header.frame_id or robot.frame
        back = context.frames.find(frame, state).inverse()
        for name in request.fk_link_names:
            if name not in robot.links:
                response.error_code.val = int(PlanOutcome.INVALID_LINK_NAME)
                continue
            pose = back * robot.pose(state, name)
            response.pose_stamped.append(stamped_message(pose, frame, context.now()))
            response.fk_link_names.append(name)

    # -- validity ------------------------------------------------------------------------

    def _validity(
        self, request: moveit_msgs.srv.GetStateValidityRequest
    ) -> moveit_msgs.srv.GetStateValidityResponse:
        response = moveit_msgs.srv.GetStateValidityResponse()
        context = self._context
        try:
            with context.lock:
                self._judge_state(request, response)
        except PlanningError as error:
            LOG.error("StateValidity: %s", error)
            response.valid = False
        return response

    def _judge_state(
        self,
        request: moveit_msgs.srv.GetStateValidityRequest,
        response: moveit_msgs.srv.GetStateValidityResponse,
    ) -> None:
        context = self._context
        group = context.group(request.group_name) if request.group_name else None
        state = context.state(request.robot_state)
        constraints = context.constraints(request.constraints, state)
        scene = context.scene_in(request.robot_state, state)
        contacts = scene.contacts(state, group)
        response.contacts = [self._contact(each, scene) for each in contacts]
        made = moveit_msgs.msg.ConstraintEvalResult
        for part, weight in zip(
            constraints.all, weights_of_message(request.constraints), strict=True
        ):
            kept = part.violation(context.robot, state) is None
            away = weight * part.distance(context.robot, state)
            response.constraint_result.append(made(result=kept, distance=away))
        response.valid = not contacts and all(each.result for each in response.constraint_result)

    def _contact(
        self, contact: SceneContact, scene: PlanningScene
    ) -> moveit_msgs.msg.ContactInformation:
        message = moveit_msgs.msg.ContactInformation()
        message.header.frame_id = self._context.robot.frame
        message.header.stamp = Time(nsecs=self._context.now())
        set_point(message.position, contact.point)
        set_point(message.normal, contact.normal)
        message.depth = float(contact.depth)
        message.contact_body_1, message.contact_body_2 = contact.first, contact.second
        message.body_type_1 = _kind(contact.first, scene)
        message.body_type_2 = _kind(contact.second, scene)
        return message


def _kind(name: str, scene: PlanningScene) -> int:
    """Return the body type of ``moveit_msgs/ContactInformation``."""
    if name in scene.robot.links:
        return _LINK
    return _ATTACHED if name in scene.attached else _OBJECT


def _targets(
    query: moveit_msgs.msg.PositionIKRequest,
) -> list[tuple[str | None, geometry_msgs.msg.PoseStamped]]:
    """Return the links and poses of a request.

    Raises:
        NoPlanError: The numbers of links and poses differ.
    """
    if not query.pose_stamped_vector:
        return [(query.ik_link_name or None, query.pose_stamped)]
    names = query.ik_link_names or [query.ik_link_name]
    if len(names) != len(query.pose_stamped_vector):
        raise NoPlanError(
            f"{len(names)} links have {len(query.pose_stamped_vector)} poses",
            PlanOutcome.INVALID_LINK_NAME,
        )
    return [
        (name or None, pose) for name, pose in zip(names, query.pose_stamped_vector, strict=True)
    ]
