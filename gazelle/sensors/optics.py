"""Optics of cameras: a pinhole, a distorting lens or a wide-angle one."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from gazelle.array_types import Bytes, Floats, Floats32, Worlds
from gazelle.description import Camera
from gazelle.errors import EngineError
from gazelle.rendering import LiveScene, PinholeLens, WideLens, WideView
from gazelle.sensors.lens_distortion import LensDistortion


class Optics(Protocol):
    """Draws what one camera sees, in some worlds."""

    def render(
        self,
        scene: LiveScene,
        positions: Floats,
        quaternions: Floats,
        worlds: Worlds | None,
        *,
        depth: bool,
    ) -> tuple[Bytes, Floats32]:
        """Return colours, shape (n, height, width, 3), and depths (n, height, width).

        Depths are empty if not requested.

        Args:
            scene: Draws.
            positions: Of the cameras [m], shape (n, 3).
            quaternions: x, y, z, w, shape (n, 4).
            worlds: Their worlds, shape (n,); all if None.
            depth: Whether depths are requested.
        """


class PinholeOptics:
    """A pinhole, with a lens before it that may bend the picture.

    Args:
        camera: Settings of the file.
        legacy: Whether the coefficients of a distortion are meant as Gazebo's own.

    Raises:
        EngineError: There can be no such picture.
    """

    def __init__(self, camera: Camera, *, legacy: bool) -> None:
        self._lens = PinholeLens.of_camera(camera)
        self._bend = LensDistortion(camera, legacy=legacy) if any(camera.distortion) else None

    def render(
        self,
        scene: LiveScene,
        positions: Floats,
        quaternions: Floats,
        worlds: Worlds | None,
        *,
        depth: bool,
    ) -> tuple[Bytes, Floats32]:
        """Return colours and depths; the lens distorts the colours alone, as in Gazebo."""
        want = ("color", "depth") if depth else ("color",)
        frames = scene.render(self._lens, positions, quaternions, worlds, want=want)
        return (
            frames.color if self._bend is None else self._bend.apply(frames.color)
        ), frames.depth


class WideOptics:
    """A lens that sees up to the whole sphere.

    Args:
        camera: Settings of the file.

    Raises:
        EngineError: There can be no such picture, or a distortion comes on top.
    """

    def __init__(self, camera: Camera) -> None:
        if any(camera.distortion):
            raise EngineError(
                "a wide-angle camera has no <distortion>; its <lens> says how it bends light"
            )
        self._view = WideView(WideLens.of_camera(camera))

    def render(
        self,
        scene: LiveScene,
        positions: Floats,
        quaternions: Floats,
        worlds: Worlds | None,
        *,
        depth: bool,
    ) -> tuple[Bytes, Floats32]:
        """Return colours.

        Raises:
            EngineError: Depths are requested; there is no axis to measure them along.
        """
        if depth:
            raise EngineError("a wide-angle camera measures no depths")
        chosen = np.arange(len(positions)) if worlds is None else worlds
        return self._view.color(scene, positions, quaternions, chosen), np.empty(
            (0, 0, 0), np.float32
        )


def optics_of(camera: Camera, *, wide: bool, legacy: bool) -> Optics:
    """Return the optics of a camera.

    Args:
        camera: Settings of the file.
        wide: Whether its sensor is of the wide-angle type; plain cameras ignore ``<lens>``.
        legacy: See ``PinholeOptics``.
    """
    return WideOptics(camera) if wide else PinholeOptics(camera, legacy=legacy)
