"""Shapes of collisions and visuals, each in its own frame, z up, lengths in metres.

``file_lengths`` of a primitive shape are those of a file where one is not greater than zero and other
lengths are simulated, in the order of the attributes; a saved file has them again.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from gazelle.description.nan_refusal import refuses_nan
from gazelle.description.parameters import Parameters
from gazelle.description.pose import Vector3
from gazelle.description.source import Source


@refuses_nan
@dataclass(frozen=True, slots=True)
class Empty:
    """No shape at all: the element is there, but nothing collides or shows.

    Attributes:
        file_lengths: The sides of a box without size in a file; else none.
    """

    file_lengths: tuple[float, ...] = field(default=(), compare=False, repr=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Box:
    """A box centred at the origin; ``size`` is the full length along x, y, z [m]."""

    size: Vector3
    file_lengths: tuple[float, ...] = field(default=(), compare=False, repr=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Sphere:
    """A sphere centred at the origin."""

    radius: float
    file_lengths: tuple[float, ...] = field(default=(), compare=False, repr=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Cylinder:
    """A cylinder along z, centred at the origin."""

    radius: float
    length: float
    file_lengths: tuple[float, ...] = field(default=(), compare=False, repr=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Capsule:
    """A cylinder of ``length`` along z with half spheres at both ends, centred at the origin."""

    radius: float
    length: float
    file_lengths: tuple[float, ...] = field(default=(), compare=False, repr=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Ellipsoid:
    """An ellipsoid centred at the origin; ``radii`` along x, y, z [m]."""

    radii: Vector3
    file_lengths: tuple[float, ...] = field(default=(), compare=False, repr=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Cone:
    """A cone along z, its apex up, centred at half its height."""

    radius: float
    length: float
    file_lengths: tuple[float, ...] = field(default=(), compare=False, repr=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Plane:
    """A plane through the origin: infinite as a collision, ``size`` [m] as a visual."""

    normal: Vector3 = (0.0, 0.0, 1.0)
    size: tuple[float, float] = (1.0, 1.0)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Mesh:
    """A mesh in a file.

    Attributes:
        uri: As in the description file.
        path: The file found for it; None when it was not found (a stand-in is used).
        scale: Factors along x, y, z; may be negative, which mirrors.
        submesh: Name of the one part to use; None for all.
        center_submesh: Whether that part is moved to the origin.
    """

    uri: str
    path: Path | None
    scale: Vector3 = (1.0, 1.0, 1.0)
    submesh: str | None = None
    center_submesh: bool = False
    source: Source | None = field(default=None, compare=False, repr=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Heightmap:
    """Terrain from a grey-scale image or a DEM file.

    Attributes:
        uri: As in the description file.
        path: The file found for it, or None.
        size: Extent along x, y and the height of full white [m].
        position: Offset of the centre [m].
        sampling: Samples per pixel.
        extras: Looks: ``<texture>``, ``<blend>`` and the like, kept as in the file.
    """

    uri: str
    path: Path | None
    size: Vector3 = (1.0, 1.0, 1.0)
    position: Vector3 = (0.0, 0.0, 0.0)
    sampling: int = 1
    extras: tuple[Parameters, ...] = field(default=(), hash=False)
    source: Source | None = field(default=None, compare=False, repr=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Image:
    """Boxes extruded from the dark pixels of an image.

    Attributes:
        uri: As in the description file.
        path: The file found for it, or None.
        scale: Metres a pixel.
        threshold: Grey value (0 to 255) above which a pixel is free.
        height: Height of the boxes [m].
        granularity: Pixels merged into one box.
    """

    uri: str
    path: Path | None
    scale: float = 1.0
    threshold: int = 200
    height: float = 1.0
    granularity: int = 1
    source: Source | None = field(default=None, compare=False, repr=False)


@refuses_nan
@dataclass(frozen=True, slots=True)
class Polyline:
    """Closed outlines in the xy plane, extruded from z = 0 to ``height`` [m]."""

    outlines: tuple[tuple[tuple[float, float], ...], ...]
    height: float = 1.0


Geometry = (
    Empty
    | Box
    | Sphere
    | Cylinder
    | Capsule
    | Ellipsoid
    | Cone
    | Plane
    | Mesh
    | Heightmap
    | Image
    | Polyline
)
