"""Attached objects: ``moveit_msgs/AttachedCollisionObject``, permanent or in a request's state."""

from __future__ import annotations

from gazelle.array_types import Floats
from gazelle.bridges.moveit.frames import PlanningFrames
from gazelle.bridges.moveit.object_messages import object_of_message
from gazelle.errors import Error, PlanningError
from gazelle.planning import OCTOMAP, AttachedObject, NoPlanError, PlanningScene, PlanOutcome
from gazelle_ros.msgs import moveit_msgs

_REMOVE = 1


def change_held(
    scene: PlanningScene, frames: PlanningFrames, message: moveit_msgs.msg.AttachedCollisionObject
) -> None:
    """Apply an ``AttachedCollisionObject``; the robot is in the scene's state.

    Raises:
        PlanningError: It names what is not there, or a shape is invalid.
    """
    refuse_reserved(message.object.id)
    if message.object.operation == _REMOVE:
        _leave(scene, message)
    else:
        _attach(scene, frames, message)


def scene_in_state(
    scene: PlanningScene, frames: PlanningFrames, message: moveit_msgs.msg.RobotState, state: Floats
) -> PlanningScene:
    """Return a scene with the attached objects of a ``RobotState``; the same if there are none.

    Args:
        scene: The scene; it stays as it is.
        frames: Of the messages.
        message: The state.
        state: Its positions, by which objects of other frames are placed, shape (variables,).

    Raises:
        NoPlanError: Something cannot be held.
    """
    if not message.attached_collision_objects:
        return scene
    made = scene.copy()
    made.state = state.copy()
    for each in message.attached_collision_objects:
        try:
            change_held(made, frames, each)
        except Error as error:
            text = f"the request's state cannot hold '{each.object.id}': {error.message}"
            raise NoPlanError(text, PlanOutcome.INVALID_ROBOT_STATE, error.hint) from None
    return made


def refuse_reserved(name: str) -> None:
    """Raise an error for an object with the octomap's name.

    Raises:
        PlanningError: It does.
    """
    if name == OCTOMAP:
        raise PlanningError(
            f"an object cannot be named '{OCTOMAP}'; that name is reserved for the octomap"
        )


def _leave(scene: PlanningScene, message: moveit_msgs.msg.AttachedCollisionObject) -> None:
    """Detach one object, or all of a link, or all, at its present pose."""
    if message.object.id:
        scene.detach(message.object.id)
        return
    for name, held in [*scene.attached.items()]:
        if message.link_name in ("", held.link):
            scene.detach(name)


def _attach(
    scene: PlanningScene, frames: PlanningFrames, message: moveit_msgs.msg.AttachedCollisionObject
) -> None:
    thing = message.object
    if not (thing.primitives or thing.meshes or thing.planes):
        scene.attach(thing.id, message.link_name, message.touch_links)
        return
    frame = frames.find(thing.header.frame_id, scene.state)
    base = scene.robot.pose(scene.state, message.link_name).inverse()
    made = object_of_message(thing, base * frame)
    scene.hold(AttachedObject(made, message.link_name, frozenset(message.touch_links)))
