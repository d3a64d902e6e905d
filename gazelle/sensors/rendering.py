"""Pictures by ray tracing on the processor: no graphics card, no screen.

Surfaces are matt and lit by the world's lights with shadows, and by a sky that is brighter
above than below.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.description import Light, Plane, Pose, Visual, World
from gazelle.engines.tracer import RayHits, Tracer
from gazelle.errors import SimulationError
from gazelle.rendering.lamps import SKY_HORIZON, SKY_TOP, SUN
from gazelle.rendering.surface_materials import GREY
from gazelle.sensors.limits import MAX_PIXELS
from gazelle_ros.base.real_numbers import finite

_LINE = 0.012  # half width of the lines of the ground grid [m]
_GAMMA = 1.35  # lifts the shadows to what a screen shows well
_OFFSET = 1e-4  # where shadow rays start above a surface [m]


@checked(SimulationError)
@dataclass(frozen=True, slots=True)
class View:
    """From where and how a picture is taken.

    Attributes:
        pose: Of the camera in the world: x forward, y left, z up.
        width: [pixel].
        height: [pixel].
        horizontal_fov: [rad].
        samples: Rays a pixel along each side, for smooth edges.
    """

    pose: Pose
    width: int = 640
    height: int = 480
    horizontal_fov: float = 1.047
    samples: int = 2


@checked(SimulationError)
def look_at(eye: tuple[float, float, float], target: tuple[float, float, float]) -> Pose:
    """Return the pose of an upright camera at ``eye`` [m] with ``target`` [m] in its middle."""
    dx, dy, dz = (t - e for e, t in zip(eye, target, strict=True))
    pitch = -math.atan2(dz, math.hypot(dx, dy))
    return Pose(*eye, pitch=pitch, yaw=math.atan2(dy, dx))


def render(tracer: Tracer, world: World, view: View) -> NDArray[np.uint8]:
    """Return a picture, shape (height, width, 3), red, green, blue."""
    directions = directions_of_view(view, view.samples)
    eye = np.broadcast_to(np.asarray(view.pose.position), directions.shape)
    sight = tracer.trace(eye, directions)
    colour = _background(world, directions)
    hit = sight.visual >= 0
    if hit.any():
        met = RayHits(sight.distance[hit], sight.normal[hit], sight.visual[hit])
        points = eye[hit] + met.distance[:, None] * directions[hit]
        colour[hit] = _shade(tracer, world, met, points, directions[hit])
    fine = colour.reshape(view.height, view.samples, view.width, view.samples, 3)
    picture = fine.mean(axis=(1, 3))
    return np.asarray(np.clip(picture, 0.0, 1.0) ** (1 / _GAMMA) * 255.0 + 0.5, dtype=np.uint8)


def range_image(tracer: Tracer, view: View) -> Floats:
    """Return distances along the middles of pixels, shape (height, width) [m].

    Infinite for nothing.
    """
    directions = directions_of_view(view, samples=1)
    eye = np.broadcast_to(np.asarray(view.pose.position), directions.shape)
    return tracer.trace(eye, directions).distance.reshape(view.height, view.width)


def directions_of_view(view: View, samples: int) -> Floats:
    """Return unit vectors in the world through every subpixel, row by row, shape (rays, 3).

    Args:
        view: From where and how.
        samples: Subpixels along each side of a pixel.

    Raises:
        SimulationError: The view has no or too many pixels, no finite pose, or no field of view.
    """
    _check(view, samples)
    across, down = view.width * samples, view.height * samples
    focal = across / 2.0 / math.tan(view.horizontal_fov / 2.0)
    left = (across / 2.0 - 0.5 - np.arange(across)) / focal
    up = (down / 2.0 - 0.5 - np.arange(down)) / focal
    y, z = np.meshgrid(left, up)
    local = np.stack((np.ones_like(y), y, z), axis=-1).reshape(-1, 3)
    local /= np.linalg.norm(local, axis=1, keepdims=True)
    return np.ascontiguousarray(local @ view.pose.matrix()[:3, :3].T)


def _check(view: View, samples: int) -> None:
    sides = (view.width, view.height, samples)
    whole = all(isinstance(n, int | np.integer) and not isinstance(n, bool) for n in sides)
    if not whole or min(sides) < 1 or math.prod(map(int, (*sides, samples))) > MAX_PIXELS:
        raise SimulationError(
            f"a picture of {view.width} x {view.height} pixels with {samples} x {samples} rays each "
            f"cannot be taken: there must be one ray and {MAX_PIXELS:,} at most"
        )
    angle = finite(view.horizontal_fov)
    if angle is None or not 0.0 < angle < math.pi:
        raise SimulationError(
            f"the field of view must be more than 0 and less than pi, not {view.horizontal_fov}"
        )
    if not isinstance(view.pose, Pose) or not all(map(math.isfinite, view.pose.numbers)):
        raise SimulationError(f"the pose of a view must be finite, not {view.pose}")


def _background(world: World, directions: Floats) -> Floats:
    if world.scene.sky:
        height = np.clip(directions[:, 2:], 0.0, 1.0) ** 0.6
        blend: Floats = (1.0 - height) * np.array(SKY_HORIZON) + height * np.array(SKY_TOP)
        return blend
    return np.tile(np.asarray(world.scene.background[:3]), (len(directions), 1))


def _shade(tracer: Tracer, world: World, met: RayHits, points: Floats, along: Floats) -> Floats:
    facing = np.where((met.normal * along).sum(axis=1, keepdims=True) > 0.0, -1.0, 1.0)
    normal = met.normal * facing
    surface = _surface_colours(tracer.visuals, met.visual, points, grid=world.scene.grid)
    sky = 0.75 + 0.25 * normal[:, 2:]
    light = np.asarray(world.scene.ambient[:3]) * sky
    start = points + _OFFSET * normal
    for lamp in world.lights or (SUN,):
        light = light + _lamp(tracer, lamp, start, normal, shadows=world.scene.shadows)
    return np.asarray(surface * light, np.float64)


def _lamp(tracer: Tracer, lamp: Light, points: Floats, normal: Floats, *, shadows: bool) -> Floats:
    """Return light from one lamp on surface points, shape (n, 3)."""
    aim = np.asarray(lamp.pose.rotate(lamp.direction), np.float64)
    aim = aim / max(float(np.linalg.norm(aim)), 1e-12)
    if lamp.type == "directional":
        towards = np.broadcast_to(-aim, points.shape)
        reach = np.full(len(points), np.inf)
        strength = np.ones(len(points))
    else:
        offset = np.asarray(lamp.pose.position) - points
        reach = np.linalg.norm(offset, axis=1)
        towards = offset / np.maximum(reach, 1e-9)[:, None]
        strength = _fading(lamp, reach, -(towards @ aim))
    strength = strength * np.clip((normal * towards).sum(axis=1), 0.0, None)
    lit = np.flatnonzero(strength > 1e-4)
    if shadows and lamp.cast_shadows and lit.size:
        blocked = (
            tracer.trace(points[lit], np.ascontiguousarray(towards[lit])).distance < reach[lit]
        )
        strength[lit[blocked]] = 0.0
    colour = np.asarray(lamp.diffuse[:3]) * lamp.intensity
    return np.asarray(strength[:, None] * colour, np.float64)


def _fading(lamp: Light, reach: Floats, cosine: Floats) -> Floats:
    a = lamp.attenuation
    fade = 1.0 / np.maximum(a.constant + a.linear * reach + a.quadratic * reach**2, 1e-6)
    fade = np.where(reach <= a.range, np.minimum(fade, 1.0), 0.0)
    if lamp.type == "spot":
        inner, outer = math.cos(lamp.spot_inner_angle / 2), math.cos(lamp.spot_outer_angle / 2)
        share = np.clip((cosine - outer) / max(inner - outer, 1e-6), 0.0, 1.0)
        fade = fade * share ** max(lamp.spot_falloff, 0.0)
    return np.asarray(fade, np.float64)


def _surface_colours(
    visuals: tuple[Visual, ...], index: NDArray[np.intp], points: Floats, *, grid: bool
) -> Floats:
    table = np.array([_colour(visual) for visual in visuals])
    colours = table[index]
    if grid:
        flat = np.array([isinstance(visual.geometry, Plane) for visual in visuals])[index]
        offset = np.abs(points[:, :2] - np.round(points[:, :2]))
        lines = flat & (offset.min(axis=1) < _LINE)
        colours[lines] *= 0.8
    return colours


def _colour(visual: Visual) -> tuple[float, float, float]:
    material = visual.material
    chosen = None if material is None else (material.diffuse or material.ambient)
    return GREY if chosen is None else chosen[:3]
