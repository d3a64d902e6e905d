"""A camera that looks at a running simulation, for pictures and films."""

from __future__ import annotations

import itertools
import math
import warnings
from collections.abc import Iterator

import numpy as np
from PIL import Image

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Picture
from gazelle.description.pose import Vector3
from gazelle.errors import Error
from gazelle.rendering import LiveScene, PinholeLens
from gazelle.sensors import look_at
from gazelle.simulation import Simulation
from gazelle.simulation.inputs import one_world
from gazelle.viewer.page.shapes import extent_of_world
from gazelle.viewer.sight import distance_seen

_GAMMA = 1.35  # lifts the shadows to what a screen shows well
_FINER = 2  # drawn larger by this factor, then reduced: smooth edges
_FOV = 0.9  # horizontal [rad]
_MARGIN = 1.06
_ASIDE = np.array([-0.45, -0.75, 0.75])  # from where a whole world is looked at
_NEAR = 0.4  # what is met so near to a model's middle belongs to it [m]
_BEHIND = np.array([-1.6, -1.0, 1.1])  # from where a model is followed [m]


@checked(Error)
class SceneCamera:
    """Camera that renders a simulation with the rasteriser.

    Args:
        simulation: Simulation to view.
        eye: Position of the camera [m]; by default one that sees the whole world, or behind the
            model that it follows, and elsewhere as soon as something blocks the view. While it
            follows, in the frame that moves with the model.
        target: Target point [m], likewise.
        follow: Name of a model that the camera goes along with, without turning.
        world: World of a batch.
        size: Width and height of pictures [pixel].
        fov: Horizontal field of view [rad].

    Raises:
        Error: There is no such model or world.
    """

    def __init__(
        self,
        simulation: Simulation,
        *,
        eye: Vector3 | None = None,
        target: Vector3 | None = None,
        follow: str = "",
        world: int = 0,
        size: tuple[int, int] = (960, 600),
        fov: float = _FOV,
    ) -> None:
        which = one_world(world, simulation.nworld)
        if follow:
            _ = simulation.robots[follow]
        self._simulation, self._follow = simulation, follow
        self._world, self._size = np.array([which]), size
        self._lens = PinholeLens(size[0] * _FINER, size[1] * _FINER, fov)
        self._scene: tuple[object, LiveScene | None] = (None, None)
        self._dodges = bool(follow) and eye is None
        self._eye, self._target = self._usual(eye, target)

    def render(self) -> Picture:
        """Return the present picture, shape (height, width, 3)."""
        with self._simulation.lock:
            return self._draw()

    def look(self) -> Picture:
        """Render the scene; deprecated, use `render`."""
        warnings.warn(DeprecationWarning("SceneCamera.look is called render now"), stacklevel=2)
        return self.render()

    def _draw(self) -> Picture:
        simulation = self._simulation
        engine, scene = self._scene
        if scene is None or engine is not simulation.engine:
            engine = simulation.engine
            scene = LiveScene(simulation.engine, gamma=_GAMMA)
            self._scene = engine, scene
        shift = np.zeros(3)
        if self._follow:
            shift = simulation.robots[self._follow].placement(self._world).position[0]
            if self._dodges:
                self._eye = self._target + self._unobstructed(self._eye - self._target)
        eye, target = self._eye + shift, self._target + shift
        pose = look_at(_triple(eye), _triple(target))
        frames = scene.render(
            self._lens,
            np.array([pose.position]),
            np.array([pose.quaternion]),
            self._world,
            want=("color",),
        )
        fine = Image.fromarray(frames.color[0])
        return np.asarray(fine.reduce(_FINER), np.uint8)

    def _unobstructed(self, present: Floats) -> Floats:
        """Return from where the model that is followed is seen, relative to the target [m].

        The nearest to the present one along which nothing but the model is met; the present one if
        there is none.
        """
        model = self._simulation.robots[self._follow]
        target = model.placement(self._world).position[0] + self._target

        def clear(offset: Floats) -> bool:
            length = float(np.linalg.norm(offset))
            eye, along = target + offset, -offset / length
            return distance_seen(self._simulation, self._world, eye, along) >= length - _NEAR

        nearest = sorted(
            _candidate_offsets(), key=lambda each: float(np.linalg.norm(each - present))
        )
        return next(filter(clear, (present, *nearest)), present)

    def _usual(self, eye: Vector3 | None, target: Vector3 | None) -> tuple[Floats, Floats]:
        """Return eye and target, by default from the size of the scene."""
        if self._follow:
            middle, away = np.array([0.0, 0.0, 0.1]), _BEHIND
        else:
            low, high = extent_of_world(self._simulation.world)
            middle = (low + high) / 2.0
            away = _ASIDE * distance_to_see((high - low) / 2.0, _ASIDE, self._lens)
        seen = middle if target is None else np.array(target)
        return (seen + away if eye is None else np.array(eye)), seen


def _candidate_offsets() -> Iterator[Floats]:
    """Yield camera positions relative to a model [m], the default first."""
    for share, lift in ((1.0, 0.0), (1.0, 0.8), (0.5, 0.0), (0.5, 0.8), (0.3, 1.0)):
        for eighth in (0, 1, -1, 2, -2, 3, -3, 4):
            turn = math.pi / 4.0 * eighth
            x, y, z = _BEHIND.tolist()
            yield share * np.array(
                [
                    x * math.cos(turn) - y * math.sin(turn),
                    x * math.sin(turn) + y * math.cos(turn),
                    z + lift,
                ]
            )


def distance_to_see(half: Floats, away: Floats, lens: PinholeLens) -> float:
    """Return the distance at which a camera sees a whole box, in lengths of a vector.

    Args:
        half: Half of the box's sides [m], shape (3,).
        away: From the middle to the camera, shape (3,).
        lens: Of the camera.
    """
    length = float(np.linalg.norm(away))
    corners = np.array(list(itertools.product(*((-side, side) for side in half.tolist()))))
    pose = look_at(_triple(away), (0.0, 0.0, 0.0))
    forward, left, up = (corners @ np.array(pose.matrix())[:3, :3]).T
    wide, high = lens.width / 2.0 / lens.focal, lens.height / 2.0 / lens.focal
    needed = np.maximum(np.abs(left) / wide, np.abs(up) / high) - forward
    return max(_MARGIN * float(needed.max()), 4.0 * lens.near) / length


def _triple(point: Floats) -> Vector3:
    x, y, z = point.tolist()
    return x, y, z
