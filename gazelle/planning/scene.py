"""Planning scenes: a robot, the objects around it, and collision checks of its states."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.description import Pose
from gazelle.engines.collision import CollisionBody, CollisionModel, Shape, collision_model
from gazelle.errors import PlanningError, did_you_mean
from gazelle.kinematics.joint_group import JointModelGroup
from gazelle.kinematics.robot_model import RobotModel
from gazelle.planning.allowed_collisions import AllowedCollisionMatrix
from gazelle.planning.robot_bodies import robot_bodies
from gazelle.planning.scene_contact import SceneContact
from gazelle.planning.scene_objects import AttachedObject, SceneObject, object_of


@checked(PlanningError)
class PlanningScene:
    """Scene of a robot that must not touch itself, obstacles, or objects that it holds.

    Poses of objects are in the robot's frame. Bodies that are fixed to each other are not checked
    against each other.

    Args:
        robot: The robot.
        padding: By link: at which distance from obstacles it counts as touching [m].
        scale: By link: factor of its shapes.

    Attributes:
        robot: The robot.
        state: Current state of its joints, shape (variables,).
        objects: Objects around the robot, by name.
        attached: Objects held by links, by name.

    Raises:
        PlanningError: A link is not there.
    """

    def __init__(
        self,
        robot: RobotModel,
        *,
        padding: Mapping[str, float] | None = None,
        scale: Mapping[str, float] | None = None,
    ) -> None:
        self.robot = robot
        self.state = robot.zero()
        self.objects: dict[str, SceneObject] = {}
        self.attached: dict[str, AttachedObject] = {}
        self._allowed = AllowedCollisionMatrix.of_robot(robot)
        self._padding: dict[str, float] = {}
        self._scale: dict[str, float] = {}
        self._models: dict[tuple[str, ...], CollisionModel] = {}
        self.set_padding(padding or {})
        self.set_scale(scale or {})
        if not robot.semantics.disabled_collisions and not robot.semantics.unchecked_links:
            # What touches with all joints at zero was drawn so, as in MoveIt's setup assistant.
            for contact in self.contacts():
                self.allow(contact.first, contact.second)

    # -- what is there -------------------------------------------------------------------

    def add(
        self,
        name: str,
        shapes: Shape | Iterable[tuple[Shape, Pose]],
        pose: Pose | None = None,
    ) -> SceneObject:
        """Add an object, in place of one of the same name.

        Args:
            name: Its name.
            shapes: One, or several at poses in the object's frame.
            pose: In the robot's frame.

        Raises:
            PlanningError: It has no shape, a length is not above zero, or a link has this name.
        """
        made = object_of(name, shapes, Pose() if pose is None else pose)
        self.add_object(made)
        return made

    def add_object(self, made: SceneObject) -> None:
        """Add an object, in place of one of the same name.

        Raises:
            PlanningError: A link has this name.
        """
        if made.name in self.robot.links:
            raise PlanningError(f"the robot has a link named '{made.name}' already")
        self.attached.pop(made.name, None)
        self.objects[made.name] = made
        self._changed()

    def move(self, name: str, pose: Pose) -> None:
        """Set the pose of an object.

        Raises:
            PlanningError: There is none of that name.
        """
        self.objects[name] = replace(self._object(name), pose=pose)
        self._changed()

    def remove(self, name: str) -> None:
        """Remove an object.

        Raises:
            PlanningError: There is none of that name.
        """
        self._object(name)
        del self.objects[name]
        self._changed()

    def clear(self) -> None:
        """Remove all objects; attached ones stay."""
        self.objects.clear()
        self._changed()

    def attach(self, name: str, link: str, touch_links: Iterable[str] = ()) -> None:
        """Attach an object to a link at its present pose.

        Args:
            name: Of the object.
            link: Link that holds it.
            touch_links: Links that it may touch, besides that one.

        Raises:
            PlanningError: There is no such object or link.
        """
        held = self._object(name)
        pose = self.robot.pose(self.state, link).inverse() * held.pose
        self.hold(AttachedObject(replace(held, pose=pose), link, frozenset(touch_links)))

    def hold(self, attached: AttachedObject) -> None:
        """Attach an object that is placed in a link's frame.

        Raises:
            PlanningError: There is no such link.
        """
        for link in (attached.link, *attached.touch_links):
            self.robot.link(link)
        self.objects.pop(attached.object.name, None)
        self.attached[attached.object.name] = attached
        self._changed()

    def detach(self, name: str) -> None:
        """Detach an object at its present pose.

        Raises:
            PlanningError: No link holds anything of that name.
        """
        held = self._attached(name)
        del self.attached[name]
        pose = self.robot.pose(self.state, held.link) * held.object.pose
        self.objects[name] = replace(held.object, pose=pose)
        self._changed()

    def drop(self, name: str) -> None:
        """Remove an attached object.

        Raises:
            PlanningError: No link holds anything of that name.
        """
        self._attached(name)
        del self.attached[name]
        self._changed()

    @property
    def allowed(self) -> AllowedCollisionMatrix:
        """Allowed collision matrix: a copy. Setting it changes that of the scene."""
        return self._allowed.copy()

    @allowed.setter
    def allowed(self, matrix: AllowedCollisionMatrix) -> None:
        self._allowed = matrix.copy()
        self._changed()

    def allow(self, first: str, second: str, *, allowed: bool = True) -> None:
        """Set whether a pair of links or objects may touch."""
        self._allowed.set_pair(first, second, allowed=allowed)
        self._changed()

    @property
    def padding(self) -> Mapping[str, float]:
        """Padding by link [m]."""
        return dict(self._padding)

    def set_padding(self, padding: Mapping[str, float]) -> None:
        """Set the padding of some links and objects attached to them.

        Raises:
            PlanningError: A link is not there, or a distance is below zero.
        """
        for link, value in padding.items():
            if link not in self.attached:
                self.robot.link(link)
            if not 0.0 <= value < np.inf:
                raise PlanningError(f"the padding of '{link}' must be a length, not {value!r}")
        self._padding |= padding
        self._changed()

    @property
    def scale(self) -> Mapping[str, float]:
        """Scale by link."""
        return dict(self._scale)

    def set_scale(self, scale: Mapping[str, float]) -> None:
        """Set the scale of some links' shapes.

        Raises:
            PlanningError: A link is not there, or a factor is not above zero.
        """
        for link, value in scale.items():
            self.robot.link(link)
            if not 0.0 < value < np.inf:
                raise PlanningError(f"the scale of '{link}' must be above zero, not {value!r}")
        self._scale |= scale
        self._changed()

    def copy(self) -> PlanningScene:
        """Return another scene with the same content."""
        made = PlanningScene(self.robot, padding=None, scale=self._scale)
        made.state = self.state.copy()
        made.objects, made.attached = dict(self.objects), dict(self.attached)
        made._allowed, made._padding = self._allowed.copy(), dict(self._padding)
        made._models = dict(self._models)  # of what has not changed
        return made

    def follow(self, other: PlanningScene) -> None:
        """Copy another scene of the robot; compiled parts stay if nothing changed.

        Unlike copies, scenes that follow share nothing that moves: each may be used by a thread.
        """
        self.state = other.state.copy()
        if _contents(self) == _contents(other):
            return
        self.objects, self.attached = dict(other.objects), dict(other.attached)
        self._padding, self._scale = dict(other._padding), dict(other._scale)
        self._allowed = other._allowed.copy()
        self._changed()

    # -- poses ---------------------------------------------------------------------------

    def pose_of(self, name: str, state: ArrayLike | None = None) -> Pose:
        """Return the pose of a link, an object, or a named frame of one (``OBJECT/FRAME``).

        Raises:
            PlanningError: There is nothing of that name.
        """
        now = self.state if state is None else np.asarray(state, np.float64)
        if name in self.robot.links:
            return self.robot.pose(now, name)
        whole, _, frame = name.partition("/")
        if whole in self.attached:
            held = self.attached[whole]
            found, base = held.object, self.robot.pose(now, held.link) * held.object.pose
        elif whole in self.objects:
            found, base = self.objects[whole], self.objects[whole].pose
        else:
            known = [*self.robot.links, *self.objects, *self.attached]
            raise PlanningError(f"there is no frame '{name}'", hint=did_you_mean(name, known))
        if not frame:
            return base
        frames = dict(found.frames)
        if frame not in frames:
            hint = did_you_mean(frame, frames)
            raise PlanningError(f"the object '{whole}' has no frame '{frame}'", hint=hint)
        return base * frames[frame]

    # -- collisions ----------------------------------------------------------------------

    def contacts(
        self, state: ArrayLike | None = None, group: JointModelGroup | None = None
    ) -> list[SceneContact]:
        """Return forbidden contacts in one state, deepest first.

        Args:
            state: Of all variables; the scene's if None. Shape (variables,).
            group: Only pairs of which a part moves with this group.
        """
        now = self.robot.complete(self.state if state is None else state)
        model = self._model(group)
        model.place(now)
        found = [
            SceneContact(each.first, each.second, each.depth, each.point, each.normal)
            for each in model.contacts()
        ]
        return sorted(found, key=lambda each: -each.depth)

    def in_collision(self, state: Floats, group: JointModelGroup | None = None) -> bool:
        """Return whether there is a forbidden contact in one state, shape (variables,)."""
        return self.collision_check(group)(state)

    def collision_check(self, group: JointModelGroup | None = None) -> Callable[[Floats], bool]:
        """Return ``in_collision`` for many states of the scene as it is now."""
        touches, complete = self._model(group).touches, self.robot.completion()
        return lambda state: touches(complete(state))

    def why_invalid(
        self, state: ArrayLike | None = None, group: JointModelGroup | None = None
    ) -> list[str]:
        """Return reasons why a state is invalid: limits, and pairs that collide, with their depth.

        Args:
            state: Of all variables; the scene's if None. Shape (variables,).
            group: Only limits of this group, and pairs of which a part moves with it.
        """
        now = self.state if state is None else np.asarray(state, np.float64)
        beyond = []
        if group is None:
            for variable, value in zip(self.robot.variables, now.tolist(), strict=True):
                low, high = variable.bounds.lower, variable.bounds.upper
                if not variable.mimics and not low - 1e-9 <= value <= high + 1e-9:
                    beyond.append(f"joint '{variable.name}' at {value:.4f} is beyond its limits "
                                  f"[{low:.4f}, {high:.4f}]")  # fmt: skip
        else:
            beyond = group.beyond(now[group.columns])
        return [*beyond, *map(str, self.contacts(now, group))]

    def _changed(self) -> None:
        self._models = {}

    def _model(self, group: JointModelGroup | None) -> CollisionModel:
        """Return the compiled collision model: for pairs that a group moves, or for all."""
        key = () if group is None else group.names
        if key not in self._models:
            self._models[key] = self._compiled(group)
        return self._models[key]

    def _compiled(self, group: JointModelGroup | None) -> CollisionModel:
        bodies = robot_bodies(self.robot, self._scale, list(self.attached.values()))
        obstacles = [_obstacle(name, found) for name, found in self.objects.items()]
        names = [body.name for body in (*bodies, *obstacles)]
        ignored = {*self._allowed.allowed_among(names)}
        for name, held in self.attached.items():
            ignored |= {(name, link) for link in (held.link, *held.touch_links)}
        if group is not None:
            ignored |= _pairs_at_rest(names, self._moving(group))
        return collision_model(bodies, obstacles, sorted(ignored), self._padding)

    def _moving(self, group: JointModelGroup) -> set[str]:
        """Return links that move with a group, and objects attached to them."""
        links = self.robot.moving(group.columns)
        return {*links} | {name for name, held in self.attached.items() if held.link in links}

    def _object(self, name: str) -> SceneObject:
        if name not in self.objects:
            raise PlanningError(
                f"the scene has no object '{name}'", hint=did_you_mean(name, self.objects)
            )
        return self.objects[name]

    def _attached(self, name: str) -> AttachedObject:
        if name not in self.attached:
            raise PlanningError(
                f"the robot holds no '{name}'", hint=did_you_mean(name, self.attached)
            )
        return self.attached[name]


def _contents(scene: PlanningScene) -> tuple[object, ...]:
    """Return the content of a scene; objects do not change, others take their place."""
    things = {name: id(each) for name, each in (*scene.objects.items(), *scene.attached.items())}
    return things, scene.padding, scene.scale, scene.allowed


def _obstacle(name: str, found: SceneObject) -> CollisionBody:
    return CollisionBody(name, pose=found.pose, shapes=found.shapes)


def _pairs_at_rest(names: Sequence[str], moving: set[str]) -> set[tuple[str, str]]:
    """Return pairs neither of which moves."""
    still = [name for name in names if name not in moving]
    return {(one, other) for i, one in enumerate(still) for other in still[:i]}
