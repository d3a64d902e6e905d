"""Models of a description as bodies and statics of a fleet."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from gazelle.description import Model, Pose
from gazelle.engines.planar.fleet_bodies import Body, Drive
from gazelle.engines.planar.kinematics import LinkTree, link_tree
from gazelle.engines.sections import Levels, parts_of
from gazelle.geometry.planar_part import PlanarPart

STEP = 0.01
"""Greatest height of a step that robots still drive over [m]."""

_DROP = 0.5  # from how high a robot is put on the ground [m]
_HEIGHTS = (STEP, 0.5)  # at which robots bump, if there are none yet [m]


@dataclass(frozen=True, slots=True)
class ConvertedModel:
    """A model and how it is in the plane.

    Attributes:
        model: The model.
        tree: Its links and joints.
        yaw: Heading of its frame at first [rad].
        z: Height of its frame [m].
        tilt: Inclination of its frame.
        still: Whether it never moves: it is part of the statics.
        free: Whether it moves by itself: driven, or pushed off once.
    """

    model: Model
    tree: LinkTree
    yaw: float
    z: float
    tilt: Pose
    still: bool
    free: bool

    @property
    def leaning(self) -> bool:
        """True if its frame does not stand upright."""
        return abs(self.tilt.quaternion[3]) < 1.0 - 1e-15


class ConvertedModels(Mapping[str, ConvertedModel]):
    """The models of a world by name; each is converted at first access.

    Args:
        models: Of the world.
        kinematic: Names of those that only move by request.
    """

    def __init__(self, models: Iterable[Model], kinematic: Collection[str]) -> None:
        self._models = {model.name: model for model in models}
        self._kinematic = kinematic
        self._known: dict[str, ConvertedModel] = {}

    def __getitem__(self, name: str) -> ConvertedModel:
        found = self._known.get(name)
        if found is None:
            found = convert_model(self._models[name], kinematic=name in self._kinematic)
            self._known[name] = found
        return found

    def owners(self) -> dict[str, str]:
        """Return the model of each link, by scoped name."""
        found = {}
        for name, model in self._models.items():
            if model.joints or model.models:
                found.update(dict.fromkeys(self[name].tree.links, name))
            else:
                found.update((f"{name}::{link.name}", name) for link in model.links)
        return found

    def __contains__(self, name: object) -> bool:
        return name in self._models

    def __iter__(self) -> Iterator[str]:
        return iter(self._models)

    def __len__(self) -> int:
        return len(self._models)


def convert_model(model: Model, *, kinematic: bool) -> ConvertedModel:
    """Convert a model to planar parts.

    Raises:
        EngineError: A joint names a link that is not there.
    """
    pose = model.pose
    yaw = pose.yaw
    tilt = Pose()
    if pose.roll != 0.0 or pose.pitch != 0.0:
        tilt = Pose(yaw=-yaw) * Pose.from_quaternion((0.0, 0.0, 0.0), pose.quaternion)
    tree = link_tree(model, tilt, kinematic=kinematic)
    free = not (model.static or kinematic or tree.held)
    z = _grounded(model, tree, tilt) if free else pose.z
    return ConvertedModel(model, tree, yaw, z, tilt, model.static and not kinematic, free)


def _grounded(model: Model, tree: LinkTree, tilt: Pose) -> float:
    """Return the height at which a model stands on its wheels.

    Its initial height without wheels.
    """
    bottoms = [
        (tilt * tree.links[tree.hinges[name].child].rest).z - wheel.radius
        for name, wheel in tree.wheels.items()
    ]
    if not bottoms or abs(model.pose.z + min(bottoms)) > _DROP:
        return model.pose.z
    return -min(bottoms)


def levels_of(models: Iterable[ConvertedModel], more: Iterable[float]) -> Levels:
    """Return the heights of sections: of all lidars and drives, and ``more`` rays."""
    rays, lows, highs = set(more), [], []
    for each in models:
        frame = Pose(z=each.z) * each.tilt
        for link in each.tree.links.values():
            for sensor in link.link.sensors:
                if sensor.lidar is not None:
                    rays.add(round((frame * link.rest * sensor.pose).z, 4))
            if each.free and each.tree.wheels:
                for collision in link.link.collisions:
                    lows.append(STEP)
                    highs.append((frame * link.rest * collision.pose).z)
    low, high = min(lows, default=_HEIGHTS[0]), max(highs, default=_HEIGHTS[1])
    return Levels(tuple(sorted(rays)), low, max(high, low + STEP))


def statics_of(each: ConvertedModel, levels: Levels) -> list[PlanarPart]:
    """Return the parts of a static model, in the world."""
    return [
        part
        for link in each.tree.links.values()
        for collision in link.link.collisions
        for part in parts_of(
            collision, each.model.pose * link.rest * collision.pose, levels, moving=False
        )
    ]


def body_of(each: ConvertedModel, levels: Levels) -> Body:
    """Return a model that moves as a body of a fleet."""
    own = levels.lowered(each.z)
    parts = [
        _lifted(part)
        for link in each.tree.links.values()
        for collision in link.link.collisions
        for part in parts_of(collision, each.tilt * link.rest * collision.pose, own, moving=True)
    ]
    place = (each.model.pose.x, each.model.pose.y, each.yaw)
    return Body(tuple(parts), place, each.z, Drive("omni") if each.free else None)


def _lifted(part: PlanarPart) -> PlanarPart:
    """Return a part that does not collide with what its body can drive over."""
    if not part.solid or part.high - part.low <= 2.0 * STEP:
        return part
    return replace(part, low=part.low + STEP)
