"""Lenses that bend straight lines, up to the whole sphere: Gazebo's wide-angle cameras.

Light from an angle theta off the optical axis falls at a distance from the middle of the picture,
in halves of its width, of

    r = c1 f fun(theta / c2 + c3)

with the sine, the tangent or nothing for ``fun``: the five classic projections and any between
them. Gazebo's shader turns that around for every pixel, and so does ``WideLens``.
"""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Bools, Floats
from gazelle.errors import EngineError, SimulationWarning, did_you_mean, located
from gazelle.rendering.lens import MAX_PIXELS

if TYPE_CHECKING:
    from gazelle.description import Camera, Parameters

MAX_FACE = 4096

_TYPES = {
    "gnomonical": (1.0, 1.0, 0.0, 1.0, "tan"),
    "stereographic": (2.0, 2.0, 0.0, 1.0, "tan"),
    "equidistant": (1.0, 1.0, 0.0, 1.0, "id"),
    "equisolid_angle": (2.0, 2.0, 0.0, 1.0, "sin"),
    "orthographic": (1.0, 1.0, 0.0, 1.0, "sin"),
}
_FUNCTIONS = {
    "sin": (math.sin, np.arcsin),
    "tan": (math.tan, np.arctan),
    "id": (float, np.positive),
}


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class LensMapping:
    """Radius at which light of an angle falls: ``c1 f fun(theta / c2 + c3)``.

    Attributes:
        c1: Factor.
        c2: Divides the angle.
        c3: Added to it.
        f: Focal length [half of the picture's width].
        fun: ``sin``, ``tan`` or ``id``.

    Raises:
        EngineError: There is no such function, or a factor is not above zero.
    """

    c1: float = 2.0
    c2: float = 2.0
    c3: float = 0.0
    f: float = 1.0
    fun: str = "tan"

    def __post_init__(self) -> None:
        """Check what a file gave."""
        if self.fun not in _FUNCTIONS:
            hint = did_you_mean(self.fun, _FUNCTIONS)
            raise EngineError(f"a lens maps angles by sin, tan or id, not '{self.fun}'", hint=hint)
        if not (self.c1 * self.f > 0.0 and self.c2 > 0.0):
            raise EngineError(
                "the mapping of a lens has c1, c2 and f above zero, not "
                f"{self.c1:g}, {self.c2:g} and {self.f:g}"
            )

    def radius(self, angle: float) -> float:
        """Return the radius at which light of an angle [rad] falls [half of the picture's width]."""
        return self.c1 * self.f * _FUNCTIONS[self.fun][0](angle / self.c2 + self.c3)

    def angles(self, radii: Floats) -> Floats:
        """Return the angles of light that falls at some radii [rad]; NaN where none does."""
        with np.errstate(invalid="ignore"):
            bare: Floats = _FUNCTIONS[self.fun][1](radii / (self.c1 * self.f))
        return (bare - self.c3) * self.c2


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class WideLens:
    """A picture through such a lens.

    Attributes:
        width: Columns of pixels.
        height: Rows of pixels.
        mapping: Mapping of the texture.
        cutoff: Light from farther off the axis [rad] is darkened to a fifth.
        face: Pixels along a side of the six pictures, of a right angle each, that it is made of.
        near: Near clipping distance along the axis of one of these [m].
        far: Far clipping distance [m].

    Raises:
        EngineError: There can be no such picture.
    """

    width: int = 320
    height: int = 240
    mapping: LensMapping = LensMapping()
    cutoff: float = math.pi / 2.0
    face: int = 256
    near: float = 0.1
    far: float = 100.0

    def __post_init__(self) -> None:
        """Check what a file gave."""
        if self.width < 1 or self.height < 1 or self.width * self.height > MAX_PIXELS:
            raise EngineError(
                f"a picture has between 1 and {MAX_PIXELS} pixels, not {self.width} x {self.height}"
            )
        if not 1 <= self.face <= MAX_FACE:
            raise EngineError(f"<env_texture_size> is between 1 and {MAX_FACE}, not {self.face}")

    @classmethod
    def of_camera(cls, camera: Camera) -> WideLens:
        """Return the lens of a description's wide-angle camera, by SDF's defaults."""
        lens = camera.lens
        mapping = _TYPES["stereographic"] if lens is None else _mapping_of(lens)
        scaled = True if lens is None else lens.get("scale_to_hfov", True)
        return cls(
            camera.width,
            camera.height,
            _scaled(LensMapping(*mapping), camera.horizontal_fov, whether=scaled),
            1.5707 if lens is None else lens.get("cutoff_angle", 1.5707),
            256 if lens is None else lens.get("env_texture_size", 256),
            camera.near,
            camera.far,
        )

    def rays(self) -> tuple[Floats, Bools]:
        """Return the ray direction of each pixel, and a mask of those beyond the cutoff.

        Returns:
            Directions of unit length in the camera's frame (x forward, y left, z up), shape
            (height, width, 3), NaN where no light falls; and shape (height, width).
        """
        right = (np.arange(self.width) + 0.5) / self.width * 2.0 - 1.0
        down = ((np.arange(self.height) + 0.5) / self.height * 2.0 - 1.0) * self.height / self.width
        x, y = np.meshgrid(right, down)
        radius = np.hypot(x, y)
        angle = self.mapping.angles(radius)
        share = np.sin(angle) / np.where(radius == 0.0, 1.0, radius)
        return np.stack((np.cos(angle), -share * x, -share * y), axis=-1), angle > self.cutoff


def _mapping_of(lens: Parameters) -> tuple[float, float, float, float, str]:
    """Return c1, c2, c3, f and the function that ``<lens>`` names."""
    kind = lens.get("type", "stereographic").strip()
    custom = lens.find("custom_function")
    if kind == "custom" and custom is not None:
        function = custom.get("fun", "tan").strip()
        if function not in _FUNCTIONS:
            _warn(custom, f"<fun> is one of {', '.join(_FUNCTIONS)}, not '{function}'", "tan")
            function = "tan"
        c1, c2, c3, f = (
            custom.get(name, usual)
            for name, usual in (("c1", 1.0), ("c2", 1.0), ("c3", 0.0), ("f", 1.0))
        )
        return (c1, c2, c3, f, function)
    if kind in _TYPES:
        return _TYPES[kind]
    if kind == "custom":
        _warn(lens, "a custom <lens> needs a <custom_function>", "stereographic")
        return _TYPES["stereographic"]
    _warn(lens, f"<lens><type> is custom or one of {', '.join(_TYPES)}, not '{kind}'", "gnomonical")
    return _TYPES["gnomonical"]


def _warn(node: Parameters, what: str, instead: str) -> None:
    warnings.warn(
        SimulationWarning(located(f"{what}; '{instead}' is taken, as in Gazebo", node.source)),
        stacklevel=2,
    )


def _scaled(mapping: LensMapping, fov: float, *, whether: bool) -> LensMapping:
    """Return the mapping with the focal length that fills the width with the field of view."""
    if not whether:
        return mapping
    c1, c2, c3, fun = mapping.c1, mapping.c2, mapping.c3, mapping.fun
    edge = LensMapping(c1, c2, c3, 1.0, fun).radius(fov / 2.0)
    if not edge > 0.0:
        raise EngineError(
            f"its lens sees no light from half its field of view, {math.degrees(fov / 2.0):g} "
            "degrees off the axis: give a lower <horizontal_fov>, or another <lens><type>"
        )
    return LensMapping(c1, c2, c3, 1.0 / edge, fun)
