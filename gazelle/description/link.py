"""Links: rigid bodies, with what of them collides and shows."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.geometry import Geometry
from gazelle.description.inertial import Inertial
from gazelle.description.light import Light
from gazelle.description.material import Material
from gazelle.description.nan_refusal import refuses_nan
from gazelle.description.parameters import Parameters
from gazelle.description.plugin import Plugin
from gazelle.description.pose import Pose
from gazelle.description.sensor import Sensor
from gazelle.description.source import Source
from gazelle.description.surface import Surface


@refuses_nan
@dataclass(frozen=True, slots=True)
class Collision:
    """Collision shape of a link.

    Attributes:
        name: Unique in its link.
        geometry: The shape.
        pose: In the link frame.
        surface: Friction, contact, bounce.
        laser_retro: Intensity that a lidar reports.
        max_contacts: At most a given number of contact points with one other collision.
    """

    name: str
    geometry: Geometry
    pose: Pose = field(default_factory=Pose)
    surface: Surface = field(default_factory=Surface)
    laser_retro: float = 0.0
    max_contacts: int = 10
    source: Source | None = field(default=None, compare=False, repr=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Visual:
    """Visual shape of a link.

    Attributes:
        name: Unique in its link.
        geometry: The shape.
        pose: In the link frame.
        material: Colour; None for the default grey.
        transparency: 0 (opaque) to 1 (invisible).
        cast_shadows: Whether it throws shadows.
        laser_retro: Intensity that a GPU lidar reports.
        visibility_flags: Cameras see it when their mask shares a bit.
        plugins: Plugins that draw on it.
        extras: Elements without effect, kept as in the file: layers of an editor, ...
    """

    name: str
    geometry: Geometry
    pose: Pose = field(default_factory=Pose)
    material: Material | None = None
    transparency: float = 0.0
    cast_shadows: bool = True
    laser_retro: float = 0.0
    visibility_flags: int = 0xFFFFFFFF
    plugins: tuple[Plugin, ...] = ()
    extras: tuple[Parameters, ...] = field(default=(), hash=False)
    source: Source | None = field(default=None, compare=False, repr=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Link:
    """A rigid body.

    Attributes:
        name: Unique in its model.
        pose: In the model frame, with all ``relative_to`` already resolved.
        inertial: Mass and inertia; None when the file gives none.
        collisions: In file order.
        visuals: In file order.
        sensors: In file order.
        lights: In file order.
        gravity: Whether gravity pulls it.
        enable_wind: Whether wind pushes it.
        self_collide: Whether it collides with links of its own model; None: as the model says.
        kinematic: Whether it moves only by being placed.
        velocity_decay_linear: Fraction of linear velocity lost; ODE's linear damping scale.
        velocity_decay_angular: Fraction of angular velocity lost.
        extras: Elements kept whole: projector, battery, audio, Simbody's must_be_base_link, ...
    """

    name: str
    pose: Pose = field(default_factory=Pose)
    inertial: Inertial | None = None
    collisions: tuple[Collision, ...] = ()
    visuals: tuple[Visual, ...] = ()
    sensors: tuple[Sensor, ...] = ()
    lights: tuple[Light, ...] = ()
    gravity: bool = True
    enable_wind: bool = False
    self_collide: bool | None = None
    kinematic: bool = False
    velocity_decay_linear: float = 0.0
    velocity_decay_angular: float = 0.0
    extras: tuple[Parameters, ...] = ()
    source: Source | None = field(default=None, compare=False, repr=False)
