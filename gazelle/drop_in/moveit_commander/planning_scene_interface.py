"""``PlanningSceneInterface``: adds objects to the planning scene, and queries it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gazelle.bridges.conversions import pose_of_message
from gazelle.bridges.moveit.object_messages import mesh_message
from gazelle.bridges.moveit.scene_messages import ATTACHED, GEOMETRY, NAMES
from gazelle.description import Mesh
from gazelle.drop_in.moveit_client.session import LOG, session
from gazelle.drop_in.moveit_commander import allowed_collisions
from gazelle.drop_in.moveit_commander.exception import MoveItCommanderException
from gazelle.errors import Error
from gazelle.formats import load_mesh
from gazelle_ros import names
from gazelle_ros.compat.rospy.topics import Publisher
from gazelle_ros.errors import RosError, RosTimeoutError
from gazelle_ros.messages import ServiceDefinition
from gazelle_ros.msgs import geometry_msgs, moveit_msgs, shape_msgs
from gazelle_ros.services import ServiceClient

__all__ = ["PlanningSceneInterface"]

_BOX, _SPHERE, _CYLINDER, _CONE = 1, 2, 3, 4
_REMOVE = 1
_LOOK_S = 5.0

allowed_collisions.extend_messages()


class PlanningSceneInterface:
    """The planning scene of ``move_group``.

    Args:
        ns: Namespace of ``move_group``.
        synchronous: Whether to wait until a change is made; else changes are published.
    """

    def __init__(self, ns: str = "", synchronous: bool = True) -> None:  # noqa: FBT001, FBT002  # MoveIt's interface
        self._node = session.node()
        self._get = self._client(ns, "get_planning_scene", moveit_msgs.srv.GetPlanningScene)
        self._apply = self._client(ns, "apply_planning_scene", moveit_msgs.srv.ApplyPlanningScene)
        self._synchronous = synchronous
        if not synchronous:
            thing, held = "collision_object", "attached_collision_object"
            self._pub_co = Publisher(
                names.join(ns, thing), moveit_msgs.msg.CollisionObject, queue_size=100
            )
            self._pub_aco = Publisher(
                names.join(ns, held),
                moveit_msgs.msg.AttachedCollisionObject,
                queue_size=100,
            )

    # -- things --------------------------------------------------------------------------

    def add_object(self, collision_object: moveit_msgs.msg.CollisionObject) -> None:
        """Add a ``CollisionObject``."""
        if not self._synchronous:
            self._pub_co.publish(collision_object)
            return
        scene = _change()
        scene.world.collision_objects = [collision_object]
        self.apply_planning_scene(scene)

    def add_box(
        self, name: str, pose: geometry_msgs.msg.PoseStamped, size: Sequence[float] = (1, 1, 1)
    ) -> None:
        """Add a box at a ``PoseStamped``; lengths along x, y, z [m]."""
        self.add_object(self.make_box(name, pose, size))

    def add_sphere(self, name: str, pose: geometry_msgs.msg.PoseStamped, radius: float = 1) -> None:
        """Add a sphere [m]."""
        self.add_object(self.make_sphere(name, pose, radius))

    def add_cylinder(
        self, name: str, pose: geometry_msgs.msg.PoseStamped, height: float, radius: float
    ) -> None:
        """Add a cylinder along z [m]."""
        self.add_object(self.make_cylinder(name, pose, height, radius))

    def add_cone(
        self, name: str, pose: geometry_msgs.msg.PoseStamped, height: float, radius: float
    ) -> None:
        """Add a cone along z [m]."""
        self.add_object(self.make_cone(name, pose, height, radius))

    def add_mesh(
        self,
        name: str,
        pose: geometry_msgs.msg.PoseStamped,
        filename: str,
        size: Sequence[float] = (1, 1, 1),
    ) -> None:
        """Add the mesh of a file, times factors."""
        self.add_object(self.make_mesh(name, pose, filename, size))

    def add_plane(
        self,
        name: str,
        pose: geometry_msgs.msg.PoseStamped,
        normal: Sequence[float] = (0, 0, 1),
        offset: float = 0,
    ) -> None:
        """Add the plane ``normal * x + offset = 0``."""
        self.add_object(self.make_plane(name, pose, normal, offset))

    def remove_world_object(self, name: str | None = None) -> None:
        """Remove a thing, or all if none is named."""
        self.add_object(moveit_msgs.msg.CollisionObject(id=name or "", operation=_REMOVE))

    # -- what links hold -----------------------------------------------------------------

    def attach_object(
        self,
        object: moveit_msgs.msg.CollisionObject | moveit_msgs.msg.AttachedCollisionObject | str,  # noqa: A002  # MoveIt's interface
        link: str | None = None,
        touch_links: Sequence[str] | None = None,
    ) -> None:
        """Attach an object to a link.

        It is a ``CollisionObject``, an ``AttachedCollisionObject``, or a known object.

        Args:
            object: One of these, or a name.
            link: Link that holds it.
            touch_links: Links that it may touch; the link alone if None.
        """
        if isinstance(object, str):
            object = _existing(object)  # noqa: A001
        kind = moveit_msgs.msg.AttachedCollisionObject
        held = object if isinstance(object, kind) else kind(object=object)
        if link is not None:
            held.link_name = link
        held.touch_links = [held.link_name] if touch_links is None else list(touch_links)
        self._hold(held)

    def attach_box(
        self, link: str, name: str, pose: geometry_msgs.msg.PoseStamped | None = None, size: Sequence[float] = (1, 1, 1),
        touch_links: Sequence[str] | None = None,
    ) -> None:  # fmt: skip
        """Attach a box to a link, or a known object if no pose is given."""
        made = _existing(name) if pose is None else self.make_box(name, pose, size)
        self.attach_object(made, link, touch_links)

    def attach_sphere(
        self, link: str, name: str, pose: geometry_msgs.msg.PoseStamped | None = None, radius: float = 1,
        touch_links: Sequence[str] | None = None,
    ) -> None:  # fmt: skip
        """Attach a sphere to a link; see `attach_box`."""
        made = _existing(name) if pose is None else self.make_sphere(name, pose, radius)
        self.attach_object(made, link, touch_links)

    def attach_cylinder(
        self, link: str, name: str, pose: geometry_msgs.msg.PoseStamped | None = None, height: float = 1, radius: float = 1,
        touch_links: Sequence[str] | None = None,
    ) -> None:  # fmt: skip
        """Attach a cylinder to a link; see `attach_box`."""
        made = _existing(name) if pose is None else self.make_cylinder(name, pose, height, radius)
        self.attach_object(made, link, touch_links)

    def attach_mesh(
        self, link: str, name: str, pose: geometry_msgs.msg.PoseStamped | None = None, filename: str = "",
        size: Sequence[float] = (1, 1, 1), touch_links: Sequence[str] | None = None,
    ) -> None:  # fmt: skip
        """Attach the mesh of a file to a link; see `attach_box`."""
        made = _existing(name)
        if pose is not None and filename:
            made = self.make_mesh(name, pose, filename, size)
        self.attach_object(made, link, touch_links)

    def remove_attached_object(self, link: str | None = None, name: str | None = None) -> None:
        """Detach an object, all of a link, or all; they stay in the scene."""
        held = moveit_msgs.msg.AttachedCollisionObject(link_name=link or "")
        held.object.id, held.object.operation = name or "", _REMOVE
        self._hold(held)

    def _hold(self, held: moveit_msgs.msg.AttachedCollisionObject) -> None:
        if not self._synchronous:
            self._pub_aco.publish(held)
            return
        scene = _change()
        scene.robot_state.attached_collision_objects = [held]
        self.apply_planning_scene(scene)

    # -- what is there -------------------------------------------------------------------

    def get_known_object_names(self, with_type: bool = False) -> list[str]:  # noqa: FBT001, FBT002  # MoveIt's interface
        """Return names of the things, or only of those with a known type."""
        things = self._scene(NAMES).world.collision_objects
        return [each.id for each in things if each.type.key or not with_type]

    def get_known_object_names_in_roi(
        self,
        minx: float, miny: float, minz: float,
        maxx: float, maxy: float, maxz: float,
        with_type: bool = False,  # noqa: FBT001, FBT002
    ) -> list[str]:  # fmt: skip
        """Return names of the objects with the origins of all shapes within a box [m]."""
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

    def get_object_poses(self, object_ids: Sequence[str]) -> dict[str, geometry_msgs.msg.Pose]:
        """Return ``geometry_msgs/Pose`` by name, of the named objects."""
        things = self._scene(GEOMETRY).world.collision_objects
        return {each.id: each.pose for each in things if each.id in object_ids}

    def get_objects(
        self, object_ids: Sequence[str] = ()
    ) -> dict[str, moveit_msgs.msg.CollisionObject]:
        """Return ``CollisionObject`` by name, of the named objects, or of all by default."""
        things = self._scene(GEOMETRY).world.collision_objects
        return {each.id: each for each in things if not object_ids or each.id in object_ids}

    def get_attached_objects(
        self, object_ids: Sequence[str] = ()
    ) -> dict[str, moveit_msgs.msg.AttachedCollisionObject]:
        """Return ``AttachedCollisionObject`` by name, of the named objects or of all."""
        held = self._scene(ATTACHED).robot_state.attached_collision_objects
        return {
            each.object.id: each for each in held if not object_ids or each.object.id in object_ids
        }

    # -- whole scenes --------------------------------------------------------------------

    def get_planning_scene(self, components: int) -> moveit_msgs.msg.PlanningScene:
        """Return the parts of a ``PlanningScene`` that a sum of ``PlanningSceneComponents`` names."""
        return self._scene(int(components))

    def apply_planning_scene(self, planning_scene_message: moveit_msgs.msg.PlanningScene) -> bool:
        """Apply a ``PlanningScene``; whether all of it could be done."""
        try:
            answer = self._apply.call(
                moveit_msgs.srv.ApplyPlanningSceneRequest(scene=planning_scene_message)
            )
        except RosError as error:
            LOG.warning("Failed to call ApplyPlanningScene service: %s", error)
            return False
        return bool(answer.success)

    def clear(self) -> bool:
        """Remove all things, also those that links hold."""
        message, thing = _change(), _existing("")
        thing.operation = _REMOVE
        held = moveit_msgs.msg.AttachedCollisionObject(object=thing)
        message.robot_state.attached_collision_objects = [held]
        message.world.collision_objects = [thing]
        return self.apply_planning_scene(message)

    def _scene(self, components: int) -> moveit_msgs.msg.PlanningScene:
        """Return a ``PlanningScene``; an empty one, with a word in the log, if there is no answer."""
        request = moveit_msgs.srv.GetPlanningSceneRequest()
        request.components.components = components
        try:
            scene: moveit_msgs.msg.PlanningScene = self._get.call(request).scene
        except RosError as error:
            LOG.warning("Could not call planning scene service: %s", error)
            return moveit_msgs.msg.PlanningScene()
        return scene

    def _client(self, namespace: str, name: str, kind: type[ServiceDefinition]) -> ServiceClient:
        full = names.join(namespace, name)
        while True:
            try:
                self._node.wait_for_service(full, timeout=_LOOK_S)
                break
            except RosTimeoutError:
                LOG.warning("service '%s' not advertised yet. Continue waiting...", full)
        return self._node.client(full, kind)

    # -- messages ------------------------------------------------------------------------

    @staticmethod
    def make_box(
        name: str, pose: geometry_msgs.msg.PoseStamped, size: Sequence[float]
    ) -> moveit_msgs.msg.CollisionObject:
        """Return a ``CollisionObject``: a box at a ``PoseStamped``."""
        return _primitive(name, pose, _BOX, size)

    @staticmethod
    def make_sphere(
        name: str, pose: geometry_msgs.msg.PoseStamped, radius: float
    ) -> moveit_msgs.msg.CollisionObject:
        """Return a ``CollisionObject``: a sphere."""
        return _primitive(name, pose, _SPHERE, [radius])

    @staticmethod
    def make_cylinder(
        name: str, pose: geometry_msgs.msg.PoseStamped, height: float, radius: float
    ) -> moveit_msgs.msg.CollisionObject:
        """Return a ``CollisionObject``: a cylinder."""
        return _primitive(name, pose, _CYLINDER, [height, radius])

    @staticmethod
    def make_cone(
        name: str, pose: geometry_msgs.msg.PoseStamped, height: float, radius: float
    ) -> moveit_msgs.msg.CollisionObject:
        """Return a ``CollisionObject``: a cone."""
        return _primitive(name, pose, _CONE, [height, radius])

    @staticmethod
    def make_mesh(
        name: str,
        pose: geometry_msgs.msg.PoseStamped,
        filename: str,
        scale: Sequence[float] = (1, 1, 1),
    ) -> moveit_msgs.msg.CollisionObject:
        """Return a ``CollisionObject``: the mesh of a file.

        Raises:
            MoveItCommanderException: It cannot be read.
        """
        x, y, z = (float(each) for each in scale)
        try:
            data = load_mesh(Mesh(filename, Path(filename), (x, y, z)))
        except (Error, OSError) as error:
            raise MoveItCommanderException(f"cannot read the mesh '{filename}': {error}") from error
        made = _placed(name, pose)
        made.meshes = [mesh_message(data)]
        return made

    @staticmethod
    def make_plane(
        name: str,
        pose: geometry_msgs.msg.PoseStamped,
        normal: Sequence[float] = (0, 0, 1),
        offset: float = 0,
    ) -> moveit_msgs.msg.CollisionObject:
        """Return a ``CollisionObject``: a plane."""
        made = moveit_msgs.msg.CollisionObject(id=name, header=pose.header)
        coefficients = [*map(float, normal), float(offset)]
        made.planes = [shape_msgs.msg.Plane(coef=coefficients)]
        made.plane_poses = [pose.pose]
        return made


def _placed(name: str, pose: geometry_msgs.msg.PoseStamped) -> moveit_msgs.msg.CollisionObject:
    return moveit_msgs.msg.CollisionObject(id=name, header=pose.header, pose=pose.pose)


def _primitive(
    name: str, pose: geometry_msgs.msg.PoseStamped, kind: int, lengths: Sequence[float]
) -> moveit_msgs.msg.CollisionObject:
    made = _placed(name, pose)
    sizes = [float(length) for length in lengths]
    made.primitives = [shape_msgs.msg.SolidPrimitive(type=kind, dimensions=sizes)]
    return made


def _existing(name: str) -> moveit_msgs.msg.CollisionObject:
    """Return a collision object that refers to an existing one by its name."""
    return moveit_msgs.msg.CollisionObject(id=name)


def _change() -> moveit_msgs.msg.PlanningScene:
    """Return a ``PlanningScene`` that changes nothing yet."""
    made = moveit_msgs.msg.PlanningScene(is_diff=True)
    made.robot_state.is_diff = True
    return made
