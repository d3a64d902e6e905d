"""Worlds: all there is, and the laws that hold in it."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.content import FileContent
from gazelle.description.joint import Joint
from gazelle.description.light import Light
from gazelle.description.material import Color
from gazelle.description.model import Frame, Model
from gazelle.description.nan_refusal import refuses_nan
from gazelle.description.parameters import Parameters
from gazelle.description.physics import Physics
from gazelle.description.plugin import Plugin
from gazelle.description.pose import Pose, Vector3
from gazelle.description.source import Source


@refuses_nan
@dataclass(frozen=True, slots=True)
class Scene:
    """The look of a world; ``extras`` (fog, clouds, ...) have no effect here and are kept."""

    ambient: Color = (0.4, 0.4, 0.4, 1.0)
    background: Color = (0.7, 0.7, 0.7, 1.0)
    shadows: bool = True
    sky: bool = False
    grid: bool = True
    extras: tuple[Parameters, ...] = field(default=(), hash=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class SphericalCoordinates:
    """Position of the world's origin on Earth: degrees, metres; ``heading`` turns x from east."""

    surface_model: str = "EARTH_WGS84"
    latitude: float = 0.0
    longitude: float = 0.0
    elevation: float = 0.0
    heading: float = 0.0


@refuses_nan
@dataclass(frozen=True, slots=True)
class Atmosphere:
    """Air: temperature at sea level [K], its gradient [K/m], pressure at sea level [Pa]."""

    type: str = "adiabatic"
    temperature: float = 288.15
    temperature_gradient: float = -0.0065
    pressure: float = 101325.0


@refuses_nan
@dataclass(frozen=True, slots=True)
class World:
    """A world.

    Attributes:
        name: Its name.
        models: In file order; those of ``<actor>`` and ``<population>`` too, as what they
            stand for.
        physics: All profiles in file order; ``profile`` gives the one in use.
        gravity: [m/s²].
        magnetic_field: [T].
        wind: Linear velocity of the air [m/s].
        atmosphere: Air.
        spherical_coordinates: Place on Earth; None when the file does not say.
        scene: Look.
        lights: In file order.
        frames: Explicit frames of the world.
        joints: Between models (SDF 1.10); links are scoped ``model::link``.
        plugins: In file order.
        camera: Pose of the user's camera, or None.
        states: ``<state>`` elements kept whole, already applied to the poses above.
        unrestored: The world before they were applied, for what writes it again; else None.
        extras: Other elements kept whole: road, population, audio, gui, ...
        content: All that the file says, which ``models`` above are made of, if its format has more
            terms than descriptions; else None.
        bare: True for the file of a robot or model, which says nothing of the world around it.
    """

    name: str = "default"
    models: tuple[Model, ...] = ()
    physics: tuple[Physics, ...] = ()
    gravity: Vector3 = (0.0, 0.0, -9.8)
    magnetic_field: Vector3 = (5.5645e-6, 22.8758e-6, -42.3884e-6)
    wind: Vector3 = (0.0, 0.0, 0.0)
    atmosphere: Atmosphere = field(default_factory=Atmosphere)
    spherical_coordinates: SphericalCoordinates | None = None
    scene: Scene = field(default_factory=Scene)
    lights: tuple[Light, ...] = ()
    frames: tuple[Frame, ...] = ()
    joints: tuple[Joint, ...] = ()
    plugins: tuple[Plugin, ...] = ()
    camera: Pose | None = None
    states: tuple[Parameters, ...] = ()
    unrestored: World | None = field(default=None, compare=False, repr=False)
    extras: tuple[Parameters, ...] = ()
    content: FileContent | None = field(default=None, repr=False)
    bare: bool = field(default=False, compare=False, repr=False)
    source: Source | None = field(default=None, compare=False, repr=False)

    @property
    def kind(self) -> str:
        """Name of the format of ``content``; empty without."""
        return "" if self.content is None else self.content.kind

    @property
    def profile(self) -> Physics:
        """The physics profile in use: the default one, else the first, else SDF's defaults."""
        for physics in self.physics:
            if physics.default:
                return physics
        return self.physics[0] if self.physics else Physics()
