"""SDF's ``<slip1>`` and ``<slip2>`` of wheels, as slip along an axle and about it.

In ODE a contact slips at ``slip1`` times the friction force along its first direction and at
``slip2`` across it. That is done by the tyres of wheels (see ``tyres``), which know the
directions of their axle only: along it and the way that the wheel rolls.
"""

from __future__ import annotations

import warnings
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

import numpy as np

from gazelle.description import Capsule, Collision, Cylinder, Pose, Sphere, TorsionalFriction
from gazelle.engines.tree import TreeLink
from gazelle.errors import EngineWarning

Slip = tuple[float, float]

# Cosines of the angle from the axle at which a direction is along it, or across it.
_ALONG, _ACROSS = 0.99, 0.14


def described_slips(models: Iterable[Sequence[TreeLink]]) -> dict[str, Slip]:
    """Wheels that slip as their collisions say: by scoped link, [m/s/N] and [rad/s/(N m)].

    The first number is along the axle, the second about it. Without ``fdir1`` the first
    direction is world y, as ODE's on level ground, with the wheel as it stands at the start.

    Args:
        models: The bodies of each, parents before children.
    """
    slips = {}
    for bodies in models:
        for body, pose in _placed(bodies):
            if body.joint is not None and body.joint.type in {"continuous", "revolute"}:
                found = {_slip_of(each, body, pose) for each in body.link.collisions}
                if len(found) == 1 and (slip := found.pop()) is not None and any(slip):
                    slips[body.name] = slip
    return slips


def warn_of_losses(models: Iterable[Sequence[TreeLink]], known: Collection[str]) -> None:
    """Say what friction of some surface is not simulated: slip of what is no wheel, and patches.

    Args:
        models: The bodies of each.
        known: Links whose slip is simulated.
    """
    bodies = [body for bodies in models for body in bodies]
    _warn(
        "slip1 and slip2",
        [
            f"{body.name}::{collision.name}"
            for body in bodies
            for collision in body.link.collisions
            if _has_slip(collision) and body.name not in known
        ],
        "they need a wheel (one revolute joint, a cylinder, capsule or sphere) and an fdir1 along "
        "its axle or across it",
    )
    _warn(
        "surface_radius and slip of <torsional>",
        [
            f"{body.name}::{collision.name}"
            for body in bodies
            for collision in body.link.collisions
            if _is_lost(collision.surface.friction.torsional)
        ],
        "rigid bodies have no depth for a patch to grow with; give a <patch_radius>",
    )


def _warn(what: str, lost: Sequence[str], why: str) -> None:
    if lost:
        others = f" and {len(lost) - 1} others" if len(lost) > 1 else ""
        text = f"{what} of collision '{lost[0]}'{others} have no effect: {why}"
        warnings.warn(EngineWarning(text), stacklevel=3)


def _is_lost(torsional: TorsionalFriction | None) -> bool:
    if torsional is None or torsional.coefficient <= 0.0:
        return False
    return torsional.slip > 0.0 or (not torsional.use_patch_radius and torsional.surface_radius > 0)


def _placed(bodies: Sequence[TreeLink]) -> Iterator[tuple[TreeLink, Pose]]:
    """Bodies with their poses in the world at the start."""
    poses: dict[str, Pose] = {}
    for body in bodies:
        poses[body.name] = body.pose if body.parent is None else poses[body.parent] * body.pose
        yield body, poses[body.name]


def _has_slip(collision: Collision) -> bool:
    friction = collision.surface.friction
    rubs = friction.mu > 0.0 or friction.mu2 > 0.0
    return rubs and (friction.slip1 > 0.0 or friction.slip2 > 0.0)


def _slip_of(collision: Collision, body: TreeLink, pose: Pose) -> Slip | None:
    """The slip of a wheel's shape; None if it cannot be told."""
    friction = collision.surface.friction
    if not _has_slip(collision):
        return 0.0, 0.0
    slips = max(friction.slip1, 0.0), max(friction.slip2, 0.0)
    first_is_along = slips[0] == slips[1] or _first_is_along(collision, body, pose)
    if first_is_along is None:
        return None
    lateral, rolling = slips if first_is_along else slips[::-1]
    if not rolling:
        return lateral, 0.0
    shape = collision.geometry
    if not isinstance(shape, Capsule | Cylinder | Sphere):
        return None
    # The force acts at the radius, and so does the velocity.
    return lateral, rolling / shape.radius**2


def _first_is_along(collision: Collision, body: TreeLink, pose: Pose) -> bool | None:
    """Whether a wheel's first friction direction is its axle; None if it is oblique."""
    if body.joint is None:
        return None
    axle = np.array(body.joint.pose.rotate(body.joint.axes[0].xyz))
    fdir1 = np.array(collision.surface.friction.fdir1, np.float64)
    size = float(np.linalg.norm(fdir1))
    if size == 0.0:
        x, y, _ = pose.rotate((float(axle[0]), float(axle[1]), float(axle[2])))
        return bool(abs(y) >= abs(x))
    x, y, z = (fdir1 / size).tolist()
    cosine = abs(float(np.dot(axle, collision.pose.rotate((x, y, z)))))
    return True if cosine >= _ALONG else False if cosine <= _ACROSS else None


def slipping(slips: Mapping[str, Slip], tyres: Collection[str]) -> dict[str, Slip]:
    """All tyres of a world with their slips: none where only the run may set one."""
    return {name: slips.get(name, (0.0, 0.0)) for name in sorted({*slips, *tyres})}
