"""The planning scene on a graph: topics and services that change it and show it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

from gazelle.bridges.conversions import pose_of_message
from gazelle.bridges.moveit.held_objects import change_held, refuse_reserved
from gazelle.bridges.moveit.object_messages import object_of_message, shapes_of_message
from gazelle.bridges.moveit.octomap_messages import octomap_of_message
from gazelle.bridges.moveit.planning_context import LOG, PlanningContext
from gazelle.bridges.moveit.scene_messages import matrix_of_message, scene_message
from gazelle.errors import Error, PlanningError
from gazelle.planning import OCTOMAP, NoPlanError, PlanOutcome
from gazelle_ros.messages import Message
from gazelle_ros.msgs import moveit_msgs, octomap_msgs, std_msgs, std_srvs

_ALL = 1023
_ADD, _REMOVE, _APPEND, _MOVE = 0, 1, 2, 3


class SceneServices:
    """Changes the scene by topics and services; publishes it on ``~monitored_planning_scene``.

    Args:
        context: The robot and its scene.

    Attributes:
        revision: Number of changes of the scene.
    """

    def __init__(self, context: PlanningContext) -> None:
        self.revision = 0
        self._context, self._scene = context, context.scene
        self._colors: dict[str, std_msgs.msg.ColorRGBA] = {}
        node = context.node
        whole = moveit_msgs.msg.PlanningScene
        self._shown = node.advertise("~monitored_planning_scene", whole, queue_size=100, latch=True)
        world = moveit_msgs.msg.PlanningSceneWorld
        thing = moveit_msgs.msg.CollisionObject
        held = moveit_msgs.msg.AttachedCollisionObject
        for topic, kind, take in (
            ("planning_scene", whole, self._take),
            ("planning_scene_world", world, self._replace),
            ("collision_object", thing, self._object),
            ("attached_collision_object", held, self._hold),
        ):
            node.subscribe(topic, kind, self._listener(take))
        context.serve("get_planning_scene", moveit_msgs.srv.GetPlanningScene, self._get)
        context.serve(
            "apply_planning_scene",
            moveit_msgs.srv.ApplyPlanningScene,
            lambda request: {"success": self.change(lambda: self._take(request.scene))},
        )
        context.serve("clear_octomap", std_srvs.srv.Empty, self._clear_octomap)
        self.change(lambda: True)

    def _listener(self, take: Callable[[Any], bool]) -> Callable[[Any], None]:
        def receive(message: Message) -> None:
            self.change(lambda: take(message))

        return receive

    def _get(self, request: moveit_msgs.srv.GetPlanningSceneRequest) -> dict[str, Any]:
        with self._context.lock:
            self._context.current()
            return {"scene": self._message(request.components.components or _ALL)}

    def _message(self, parts: int) -> moveit_msgs.msg.PlanningScene:
        return scene_message(self._scene, parts, self._colors)

    def _clear_octomap(self, _request: std_srvs.srv.EmptyRequest) -> dict[str, Any]:
        self.change(self._forget_octomap)
        return {}

    def change(self, act: Callable[[], bool]) -> bool:
        """Change the scene and publish it; returns whether everything succeeded."""
        with self._context.lock:
            self._context.current()
            done = act()
            self.revision += 1
            self._shown.publish(self._message(_ALL))
        return done

    def _try(self, act: Callable[[], object]) -> bool:
        """Apply a part of a change.

        Log the reason if it fails, and return whether it succeeded.
        """
        try:
            act()
        except Error as error:
            LOG.error("planning scene: %s", error)
            return False
        return True

    # -- whole scenes --------------------------------------------------------------------

    @contextmanager
    def changed(self, message: moveit_msgs.msg.PlanningScene) -> Iterator[None]:
        """Apply the change of a ``PlanningScene`` while it lasts; hold the context's lock.

        Raises:
            NoPlanError: A part of the change could not be done.
        """
        scene = self._scene
        if not _has_content(message):
            yield  # all that is compiled stays
            return
        colors = dict(self._colors)
        objects, attached, allowed = dict(scene.objects), dict(scene.attached), scene.allowed
        links = scene.robot.links
        padding = {link: scene.padding.get(link, 0.0) for link in links}
        scale = {link: scene.scale.get(link, 1.0) for link in links}
        try:
            if not self._merge(message):
                raise NoPlanError(
                    "the planning scene cannot be changed as the request says",
                    PlanOutcome.INVALID_OBJECT_NAME,
                )
            yield
        finally:
            self._colors = colors
            scene.objects, scene.attached = objects, attached
            scene.set_padding(padding)
            scene.set_scale(scale)
            scene.allowed = allowed

    def _take(self, message: moveit_msgs.msg.PlanningScene) -> bool:
        """Apply a ``PlanningScene``, or a change of it."""
        scene = self._scene
        if not message.is_diff:
            scene.clear()
            self._colors = {}
            for name in [*scene.attached]:
                scene.drop(name)
        return self._merge(message)

    def _merge(self, message: moveit_msgs.msg.PlanningScene) -> bool:
        """Apply the parts of a ``PlanningScene``; the rest stays."""
        scene, done = self._scene, True
        if message.allowed_collision_matrix.entry_names or (
            message.allowed_collision_matrix.default_entry_names
        ):
            scene.allowed = matrix_of_message(message.allowed_collision_matrix)
        padding = {each.link_name: each.padding for each in message.link_padding}
        scale = {each.link_name: each.scale for each in message.link_scale}
        done &= self._try(lambda: scene.set_padding(padding))
        done &= self._try(lambda: scene.set_scale(scale))
        # What is held may be taken from what stands there, so objects are put there before.
        done &= self._place(message.world)
        self._colors |= {each.id: each.color for each in message.object_colors}
        for each in message.robot_state.attached_collision_objects:
            done &= self._hold(each)
        return done

    def _replace(self, world: moveit_msgs.msg.PlanningSceneWorld) -> bool:
        """Replace the world by a ``PlanningSceneWorld``."""
        self._scene.clear()
        return self._place(world)

    def _place(self, world: moveit_msgs.msg.PlanningSceneWorld) -> bool:
        """Apply a ``PlanningSceneWorld``; its octomap, if any, replaces the present one."""
        done = True
        for each in world.collision_objects:
            done &= self._object(each)
        if _has_octomap(world):
            done &= self._try(lambda: self._map(world.octomap))
        return done

    def _map(self, message: octomap_msgs.msg.OctomapWithPose) -> None:
        frame = self._context.frames.find(message.header.frame_id, self._scene.state)
        made = octomap_of_message(message, frame)
        if made is None:
            self._forget_octomap()
        else:
            self._scene.add_object(made)

    def _forget_octomap(self) -> bool:
        if OCTOMAP in self._scene.objects:
            self._scene.remove(OCTOMAP)
        return True

    # -- objects --------------------------------------------------------------------------

    def _object(self, message: moveit_msgs.msg.CollisionObject) -> bool:
        """Apply a ``CollisionObject``."""
        actions = {
            _ADD: self._add, _REMOVE: self._remove, _APPEND: self._append, _MOVE: self._move,
        }  # fmt: skip

        def act() -> None:
            refuse_reserved(message.id)
            if message.operation not in actions:
                raise PlanningError(f"the operation {message.operation} of an object is not known")
            actions[message.operation](message)

        return self._try(act)

    def _add(self, message: moveit_msgs.msg.CollisionObject) -> None:
        frame = self._context.frames.find(message.header.frame_id, self._scene.state)
        self._scene.add_object(object_of_message(message, frame))

    def _remove(self, message: moveit_msgs.msg.CollisionObject) -> None:
        for name in [message.id] if message.id else [*self._scene.objects]:
            if name != OCTOMAP:
                self._scene.remove(name)
                self._colors.pop(name, None)

    def _append(self, message: moveit_msgs.msg.CollisionObject) -> None:
        """Add shapes to an object of the scene; add the object if it is new."""
        if message.id not in self._scene.objects:
            self._add(message)
            return
        known = self._scene.objects[message.id]
        frame = self._context.frames.find(message.header.frame_id, self._scene.state)
        own = known.pose.inverse() * frame * pose_of_message(message.pose)
        added = tuple((shape, own * pose) for shape, pose in shapes_of_message(message))
        self._scene.add_object(replace(known, shapes=known.shapes + added))

    def _move(self, message: moveit_msgs.msg.CollisionObject) -> None:
        frame = self._context.frames.find(message.header.frame_id, self._scene.state)
        self._scene.move(message.id, frame * pose_of_message(message.pose))

    # -- what links hold -----------------------------------------------------------------

    def _hold(self, message: moveit_msgs.msg.AttachedCollisionObject) -> bool:
        """Apply an ``AttachedCollisionObject``."""
        return self._try(lambda: change_held(self._scene, self._context.frames, message))


def _has_octomap(world: moveit_msgs.msg.PlanningSceneWorld) -> bool:
    """Return whether a ``PlanningSceneWorld`` sets the octomap; one without data clears it."""
    return bool(world.octomap.octomap.id or world.octomap.octomap.data)


def _has_content(message: moveit_msgs.msg.PlanningScene) -> bool:
    """Return whether a ``PlanningScene`` would change anything."""
    rules = message.allowed_collision_matrix
    return bool(
        message.world.collision_objects
        or _has_octomap(message.world)
        or message.robot_state.attached_collision_objects
        or rules.entry_names
        or rules.default_entry_names
        or message.link_padding
        or message.link_scale
    )
