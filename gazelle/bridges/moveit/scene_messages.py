"""A whole planning scene as ``moveit_msgs/PlanningScene``, and rules of collisions."""

from __future__ import annotations

from collections.abc import Mapping

from gazelle.bridges.moveit.object_messages import object_message
from gazelle.bridges.moveit.octomap_messages import octomap_message
from gazelle.bridges.moveit.robot_states import state_message
from gazelle.planning import OCTOMAP, AllowedCollisionMatrix, PlanningScene
from gazelle_ros.msgs import moveit_msgs, std_msgs

STATE, ATTACHED, NAMES, GEOMETRY, MAP, ALLOWED, PADDING, COLORS = 2, 4, 8, 16, 32, 128, 256, 512
"""Of ``moveit_msgs/PlanningSceneComponents``."""


def scene_message(
    scene: PlanningScene, parts: int, colors: Mapping[str, std_msgs.msg.ColorRGBA]
) -> moveit_msgs.msg.PlanningScene:
    """Return a scene.

    Args:
        scene: The scene; its state is where the robot is.
        parts: Requested parts: a sum of the components' numbers.
        colors: ``std_msgs/ColorRGBA`` by object or link.
    """
    message = moveit_msgs.msg.PlanningScene()
    message.robot_model_name = scene.robot.model.name
    frame = scene.robot.frame
    if parts & STATE:
        message.robot_state = state_message(scene.robot, scene.state)
    if parts & ATTACHED:
        made = moveit_msgs.msg.AttachedCollisionObject
        message.robot_state.attached_collision_objects = [
            made(
                link_name=held.link,
                object=object_message(held.object, held.link),
                touch_links=sorted(held.touch_links),
            )
            for held in scene.attached.values()
        ]
    message.robot_state.is_diff = not parts & STATE
    if parts & (NAMES | GEOMETRY):
        message.world.collision_objects = [
            object_message(thing, frame, shapes=bool(parts & GEOMETRY))
            for name, thing in scene.objects.items()
            if name != OCTOMAP
        ]
    if parts & MAP:
        message.world.octomap = octomap_message(scene)
    if parts & ALLOWED:
        message.allowed_collision_matrix = matrix_message(scene.allowed)
    if parts & PADDING:
        padding, scale = (
            moveit_msgs.msg.LinkPadding,
            moveit_msgs.msg.LinkScale,
        )
        links = scene.robot.links
        message.link_padding = [
            padding(link_name=link, padding=scene.padding.get(link, 0.0)) for link in links
        ]
        message.link_scale = [
            scale(link_name=link, scale=scene.scale.get(link, 1.0)) for link in links
        ]
    if parts & COLORS:
        color = moveit_msgs.msg.ObjectColor
        message.object_colors = [color(id=name, color=value) for name, value in colors.items()]
    return message


def matrix_message(matrix: AllowedCollisionMatrix) -> moveit_msgs.msg.AllowedCollisionMatrix:
    """Return an ``AllowedCollisionMatrix``; unlisted pairs may not touch."""
    pairs, defaults = matrix.pairs, matrix.defaults
    names = sorted({name for pair in pairs for name in pair})
    entry = moveit_msgs.msg.AllowedCollisionEntry
    return moveit_msgs.msg.AllowedCollisionMatrix(
        entry_names=names,
        entry_values=[
            entry(enabled=[pairs.get((min(a, b), max(a, b)), False) for b in names]) for a in names
        ],
        default_entry_names=[*defaults],
        default_entry_values=[*defaults.values()],
    )


def matrix_of_message(message: moveit_msgs.msg.AllowedCollisionMatrix) -> AllowedCollisionMatrix:
    """Convert an ``AllowedCollisionMatrix``; defaults of names hold for pairs not allowed."""
    made = AllowedCollisionMatrix()
    defaults = dict(zip(message.default_entry_names, message.default_entry_values, strict=False))
    for name, value in defaults.items():
        made.set_default(name, allowed=bool(value))
    for first, row in zip(message.entry_names, message.entry_values, strict=False):
        for second, value in zip(message.entry_names, row.enabled, strict=False):
            if value or not {first, second} & {*defaults}:
                made.set_pair(first, second, allowed=bool(value))
    return made
