"""Free bodies, which nothing joins: sleeping, and contacts sought on the way of a step."""

from __future__ import annotations

import warnings
from collections.abc import Collection, Mapping

import mujoco

from gazelle.description import Box, Capsule, Cylinder, Ellipsoid, Model, Sphere, World
from gazelle.engines.limits import MAX_CHAIN, MAX_COORDINATES, MAX_MOVING, MAX_SOLIDS
from gazelle.engines.mujoco.compiler.motors import AXES
from gazelle.errors import EngineError, EngineWarning
from gazelle.kinematics.tree import TreeLink

# From this number of free bodies on the time saved outweighs an ``MjData`` for every world.
_MANY = 16

# Speed below which a body may go to sleep [m/s]. At MuJoCo's 1e-3 a pendulum that swings
# by a hundredth of a radian would stop where it turns back.
SLEEP_SPEED = 1e-4

# Speed that a free body may well have [m/s]: a ball thrown or shot.
_FAST = 20.0

# Pairs of a shape that moves and one of the world from which on contacts are sought on the way of
# a step only where the world enables it. MuJoCo then looks at every pair in every step, at 7 to
# 12 ns each, instead of in trees of boxes: a city took 0.45 s a step, of which 0.44 s for that.
_MOST_PAIRS = 200_000


def check_size(bodies: Mapping[str, list[TreeLink]]) -> None:
    """Check that a world is no larger than the solver can hold, before it is compiled for minutes.

    Args:
        bodies: Of all models, by their names.

    Raises:
        EngineError: It has more than ``MAX_COORDINATES`` coordinates of motion, a chain of more
            than ``MAX_CHAIN`` links, or a model with more than ``MAX_MOVING`` links that move or
            ``MAX_SOLIDS`` that collide.
    """
    for parts in bodies.values():
        _check_chains(parts)
        _check_counts(parts)
    count = coordinate_count(bodies)
    if count > MAX_COORDINATES:
        raise EngineError(
            f"the world has {count:,} coordinates of motion, more than the limit of "
            f"{MAX_COORDINATES:,}",
            hint="let models that nothing shall move be static",
        )


def _check_chains(parts: list[TreeLink]) -> None:
    """Check that no link hangs on too many others; parents stand before children."""
    depths: dict[str, int] = {}
    for body in parts:
        depths[body.name] = depth = depths.get(body.parent or "", 0) + 1
        if depth > MAX_CHAIN:
            raise EngineError(
                f"link '{body.name}' hangs on {depth - 1:,} others, one on the other; the limit is "
                f"{MAX_CHAIN:,} links",
                source=body.link.source,
                hint="join some of them by fixed joints",
            )


def _check_counts(parts: list[TreeLink]) -> None:
    """Check the numbers of links of a model that move, and of those that collide as well."""
    moving = [body for body in parts if body.root != "static"]
    solid = [body for body in moving if body.link.collisions]
    for found, what, limit, hint in (
        (moving, "move", MAX_MOVING, "join some of them by fixed joints"),
        (solid, "collide", MAX_SOLIDS, "leave out collisions of links that touch nothing"),
    ):
        if len(found) > limit:
            raise EngineError(
                f"the model has {len(found):,} links that {what}, more than the limit of {limit:,}",
                source=found[limit].link.source,
                hint=hint,
            )


def coordinate_count(bodies: Mapping[str, list[TreeLink]]) -> int:
    """Return the number of coordinates of motion of models, given by their names."""
    every = [body for parts in bodies.values() for body in parts]
    joints = [body.joint for body in every if body.joint is not None]
    free = sum(6 for body in every if body.root == "free")
    return free + sum(AXES.get(joint.type, 0) for joint in joints)


def allows_sleep(world: World, kinematic: Collection[str] = ()) -> bool:
    """Return whether bodies at rest go to sleep: as the world says, else where many could.

    Args:
        world: The description.
        kinematic: Names of kinematic models; such a one is never free.
    """
    setting = world.profile.auto_disable
    if setting is not None:
        return setting
    moving = _moving(world, kinematic)
    return sum(_is_free(model) and model.allow_auto_disable for model in moving) >= _MANY


def uses_speculative_contacts(
    world: World, time_step: float, kinematic: Collection[str] = ()
) -> bool:
    """Return whether contacts are predicted within a step: as the world says, else if need be.

    There is need when a free body is so small that, at ``_FAST``, it moves in one step by
    more than half its thickness. Robots do not get that fast.
    """
    setting = world.profile.speculative_contacts
    if setting is not None:
        return setting
    reach = _FAST * time_step
    moving = _moving(world, kinematic)
    return any(_is_free(model) and _half_thickness(model) <= reach for model in moving)


def limit_speculative_contacts(model: mujoco.MjModel, world: World) -> None:
    """Disable speculative contacts where finding them takes longer than a step."""
    ahead = int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)
    if world.profile.speculative_contacts is not None or not model.opt.enableflags & ahead:
        return
    collides = (model.geom_contype | model.geom_conaffinity) != 0
    still = model.body_weldid[model.geom_bodyid] == 0
    count, moving = int((collides & still).sum()), int((collides & ~still).sum())
    if count * moving <= _MOST_PAIRS:
        return
    model.opt.enableflags &= ~ahead
    warnings.warn(
        EngineWarning(
            f"the world has {count} static and {moving} moving shapes, too many for "
            "speculative contacts in every step: a small body that is faster than 20 m/s may pass "
            "through something thin. Set sim.physics.speculative_contacts = True to enable them"
        ),
        stacklevel=5,
    )


def has_free_bodies(world: World, kinematic: Collection[str] = ()) -> bool:
    """Return whether there is something that may be pushed, stacked or gripped.

    Args:
        world: The description.
        kinematic: Names of kinematic models; such a one is never free.
    """
    return any(_is_free(model) and model.has_collisions for model in _moving(world, kinematic))


def _moving(world: World, kinematic: Collection[str]) -> list[Model]:
    """Return the dynamic models."""
    return [model for model in world.models if not model.static and model.name not in kinematic]


def keep_awake(model: mujoco.MjModel, world: World) -> None:
    """Allow sleep only for free bodies with a description that allows it.

    Something with joints may stand still for a moment in the middle of a motion.
    """
    never = int(mujoco.mjtSleepPolicy.mjSLEEP_NEVER)
    for each in world.models:
        if each.static or (_is_free(each) and each.allow_auto_disable):
            continue
        for placed in each.walk():
            for link in placed.model.links:
                body = mujoco.mj_name2id(
                    model, mujoco.mjtObj.mjOBJ_BODY, f"{placed.scope}::{link.name}"
                )
                if body > 0 and model.body_treeid[body] >= 0:
                    model.tree_sleep_policy[model.body_treeid[body]] = never


def _is_free(model: Model) -> bool:
    return not model.static and not any(placed.model.joints for placed in model.walk())


def _half_thickness(model: Model) -> float:
    """Return half the least extent of all shapes of a model [m]; infinite without any."""
    return min(
        (
            _half(collision.geometry)
            for placed in model.walk()
            for link in placed.model.links
            for collision in link.collisions
        ),
        default=float("inf"),
    )


def _half(shape: object) -> float:
    if isinstance(shape, Box):
        return min(shape.size) / 2.0
    if isinstance(shape, Sphere | Capsule):
        return shape.radius
    if isinstance(shape, Cylinder):
        return min(shape.radius, shape.length / 2.0)
    if isinstance(shape, Ellipsoid):
        return min(shape.radii)
    return float("inf")
