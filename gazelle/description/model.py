"""Models: links held together by joints, with plugins and nested models."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from gazelle.description.content import FileContent
from gazelle.description.joint import Joint
from gazelle.description.link import Link
from gazelle.description.nan_refusal import refuses_nan
from gazelle.description.parameters import Parameters
from gazelle.description.plugin import Plugin
from gazelle.description.pose import Pose
from gazelle.description.source import Source


@refuses_nan
@dataclass(frozen=True, slots=True)
class Frame:
    """A named frame.

    Attributes:
        name: Unique among the frames, links and joints of its parent.
        attached_to: The link it moves with, scoped by ``::``; empty for the model or world frame.
        pose: In the frame of ``attached_to``.
        joint: Name of the URDF's fixed joint to it, if it was a link that was lumped.
    """

    name: str
    attached_to: str = ""
    pose: Pose = field(default_factory=Pose)
    source: Source | None = field(default=None, compare=False, repr=False)
    joint: str = field(default="", compare=False, repr=False)


TRANSMISSION_WIDTHS = {
    "transmission_interface/SimpleTransmission": 1,
    "transmission_interface/DifferentialTransmission": 2,
    "transmission_interface/FourBarLinkageTransmission": 2,
}
"""Types of transmissions that ros_control has, with the number of their joints."""


@refuses_nan
@dataclass(frozen=True, slots=True)
class Transmission:
    """URDF's ``<transmission>``: which actuator moves which joint through which interface.

    Attributes:
        name: Its name.
        type: Such as ``transmission_interface/SimpleTransmission``.
        joints: Pairs of joint name and its hardware interfaces.
        actuators: Pairs of actuator name and mechanical reduction.
        offsets: Of the joints' positions [m or rad], one a joint; empty for none.
        joint_reductions: Mechanical reductions behind the actuators', one a joint; empty for none.
        joint_roles: Such as ``joint1``, one a joint; empty where none is given.
        actuator_roles: Such as ``actuator1``, likewise.
    """

    name: str
    type: str
    joints: tuple[tuple[str, tuple[str, ...]], ...] = ()
    actuators: tuple[tuple[str, float], ...] = ()
    offsets: tuple[float, ...] = ()
    joint_reductions: tuple[float, ...] = ()
    joint_roles: tuple[str, ...] = ()
    actuator_roles: tuple[str, ...] = ()
    source: Source | None = field(default=None, compare=False, repr=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Model:
    """A model.

    Attributes:
        name: Unique in its world or parent model.
        pose: In the world, or in the parent model's frame.
        static: Immovable: its joints and inertias do not matter.
        self_collide: Whether its links collide with each other.
        allow_auto_disable: Whether the engine may put it to sleep.
        enable_wind: Whether wind pushes its links.
        canonical_link: The link its pose follows; empty for the first.
        placement_frame: The frame that ``pose`` placed, as written; empty for the model frame.
            ``pose`` is already the model frame's, so two models may differ in this and be equal.
        links: In file order.
        joints: In file order.
        models: Nested models, in file order.
        frames: Explicit frames.
        plugins: In file order.
        transmissions: From URDF.
        extras: Elements kept whole: gripper, ...
        actor: The ``<actor>`` that the model stands for and is written as, without its pose;
            else None.
        content: All that its file says of it, which the links are made of, if its format has more
            terms than descriptions; else None.
    """

    name: str
    pose: Pose = field(default_factory=Pose)
    static: bool = False
    self_collide: bool = False
    allow_auto_disable: bool = True
    enable_wind: bool = False
    canonical_link: str = ""
    placement_frame: str = field(default="", compare=False)
    links: tuple[Link, ...] = ()
    joints: tuple[Joint, ...] = ()
    models: tuple[Model, ...] = ()
    frames: tuple[Frame, ...] = ()
    plugins: tuple[Plugin, ...] = ()
    transmissions: tuple[Transmission, ...] = ()
    extras: tuple[Parameters, ...] = ()
    actor: Parameters | None = field(default=None, hash=False)
    content: FileContent | None = field(default=None, compare=False, repr=False)
    source: Source | None = field(default=None, compare=False, repr=False)

    @property
    def kind(self) -> str:
        """Name of the format of ``content``; empty without."""
        return "" if self.content is None else self.content.kind

    @property
    def has_collisions(self) -> bool:
        """True if a link of this model or of a nested one has a collision."""
        return any(link.collisions for placed in self.walk() for link in placed.model.links)

    def walk(self, prefix: str = "", pose: Pose | None = None) -> Iterator[PlacedModel]:
        """Yield this model and all nested ones, depth first, each with its scope and pose.

        Args:
            prefix: Scope put before the names, such as ``world_name::``.
            pose: Pose of this model in the frame that the results shall be in;
                the model's own ``pose`` when None; with NaN, so are all.
        """
        placed = self.pose if pose is None else pose
        scope = f"{prefix}{self.name}"
        yield PlacedModel(scope, placed, self)
        for nested in self.models:
            yield from nested.walk(f"{scope}::", placed * nested.pose)


@dataclass(frozen=True, slots=True)
class PlacedModel:
    """A model found by ``Model.walk``.

    Attributes:
        scope: Its scoped name, such as ``robot::arm``.
        pose: Its pose in the frame that ``walk`` was asked for; may hold NaN as that.
        model: The model.
    """

    scope: str
    pose: Pose
    model: Model
