"""``PlanningSceneInterface``: the planning scene of ``move_group``, as its C++ class asks for it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle.bridges.moveit.client.session import LOG, packed, session, unpacked
from gazelle.bridges.moveit.frames import pose_of_message
from gazelle.bridges.moveit.scene_messages import ATTACHED, GEOMETRY, NAMES
from gazelle.ros import names
from gazelle.ros.errors import RosError, RosTimeoutError
from gazelle.ros.messages import load_message, load_service

_LOOK_S = 5.0
_REMOVE = 1


class PlanningSceneClient:
    """As ``moveit_ros_planning_interface._moveit_planning_scene_interface`` has it.

    It waits for the services, however long that takes.

    Args:
        ns: Namespace of ``move_group``.
    """

    def __init__(self, ns: str = "") -> None:
        self._node = session.node()
        self._get = self._client(ns, "get_planning_scene", "GetPlanningScene")
        self._apply = self._client(ns, "apply_planning_scene", "ApplyPlanningScene")

    def _client(self, namespace: str, name: str, kind: str) -> Any:
        full = names.join(namespace, name)
        while True:
            try:
                self._node.wait_for_service(full, timeout=_LOOK_S)
                break
            except RosTimeoutError:
                LOG.warning("service '%s' not advertised yet. Continue waiting...", full)
        return self._node.client(full, load_service(f"moveit_msgs/{kind}"))

    # -- things --------------------------------------------------------------------------

    def get_known_object_names(self, with_type: bool = False) -> list[str]:  # noqa: FBT001, FBT002  # MoveIt's interface
        """Names of the things, or of those alone whose type is known."""
        things = self._scene(NAMES).world.collision_objects
        return [each.id for each in things if each.type.key or not with_type]

    def get_known_object_names_in_roi(
        self,
        minx: float, miny: float, minz: float,
        maxx: float, maxy: float, maxz: float,
        with_type: bool = False,  # noqa: FBT001, FBT002
    ) -> list[str]:  # fmt: skip
        """Names of the things all of whose shapes have their origins within a box [m]."""
        low, high = (minx, miny, minz), (maxx, maxy, maxz)
        found = []
        for each in self._scene(GEOMETRY).world.collision_objects:
            places = [*each.mesh_poses, *each.primitive_poses]
            if not places or (with_type and not each.type.key):
                continue
            base = pose_of_message(each.pose)
            origins = [(base * pose_of_message(place)).position for place in places]
            if all(
                a <= value <= b
                for origin in origins
                for a, value, b in zip(low, origin, high, strict=True)
            ):
                found.append(each.id)
        return found

    def get_object_poses(self, object_ids: Sequence[str]) -> dict[str, bytes]:
        """``geometry_msgs/Pose`` by name, of the things that are named."""
        things = self._scene(GEOMETRY).world.collision_objects
        return {each.id: packed(each.pose) for each in things if each.id in object_ids}

    def get_objects(self, object_ids: Sequence[str] = ()) -> dict[str, bytes]:
        """``CollisionObject`` by name, of the things that are named, or of all if none are."""
        things = self._scene(GEOMETRY).world.collision_objects
        return {each.id: packed(each) for each in things if not object_ids or each.id in object_ids}

    def get_attached_objects(self, object_ids: Sequence[str] = ()) -> dict[str, bytes]:
        """``AttachedCollisionObject`` by name, of the things that are named, or of all."""
        held = self._scene(ATTACHED).robot_state.attached_collision_objects
        return {
            each.object.id: packed(each)
            for each in held
            if not object_ids or each.object.id in object_ids
        }

    # -- whole scenes --------------------------------------------------------------------

    def get_planning_scene(self, components: int) -> bytes:
        """The parts of a ``PlanningScene`` that a sum of ``PlanningSceneComponents`` names."""
        return packed(self._scene(int(components)))

    def apply_planning_scene(self, scene: bytes) -> bool:
        """Apply a ``PlanningScene``; whether all of it could be done."""
        return self._change(unpacked("moveit_msgs/PlanningScene", scene))

    def clear(self) -> bool:
        """Remove all things, also those that links hold."""
        message: Any = load_message("moveit_msgs/PlanningScene")(is_diff=True)
        message.robot_state.is_diff = True
        thing: Any = load_message("moveit_msgs/CollisionObject")(operation=_REMOVE)
        held: Any = load_message("moveit_msgs/AttachedCollisionObject")(object=thing)
        message.robot_state.attached_collision_objects = [held]
        message.world.collision_objects = [thing]
        return self._change(message)

    def _scene(self, components: int) -> Any:
        """A ``PlanningScene``; an empty one, with a word in the log, if there is no answer."""
        request: Any = load_service("moveit_msgs/GetPlanningScene")._request_class()
        request.components.components = components
        try:
            return self._get.call(request).scene
        except RosError as error:
            LOG.warning("Could not call planning scene service: %s", error)
            return load_message("moveit_msgs/PlanningScene")()

    def _change(self, scene: Any) -> bool:
        request = load_service("moveit_msgs/ApplyPlanningScene")._request_class(scene=scene)
        try:
            return bool(self._apply.call(request).success)
        except RosError as error:
            LOG.warning("Failed to call ApplyPlanningScene service: %s", error)
            return False
