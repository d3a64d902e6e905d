"""Motion models of particles: four models of odometry noise, as in ``amcl``.

Models: Thrun, Burgard and Fox, "Probabilistic Robotics", 2005, section 5.4; the variants
``-corrected`` take the variance, not the deviation, of the textbook's formula.
"""

from __future__ import annotations

import math
from typing import Literal, get_args

import numpy as np

from gazelle.array_types import Floats
from gazelle.errors import Error, did_you_mean
from gazelle.navigation.angles import wrapped, wrapped_all
from gazelle.navigation.following import Pose2

OdometryModel = Literal["diff", "omni", "diff-corrected", "omni-corrected"]
MODELS: tuple[OdometryModel, ...] = get_args(OdometryModel)

_STANDING = 0.01
"""A shorter distance has no direction of its own [m]."""


def check_model(name: str) -> OdometryModel:
    """Return the model of a name.

    Raises:
        Error: There is none.
    """
    for model in MODELS:
        if name == model:
            return model
    raise Error(f"the odometry model '{name}' is unknown", hint=did_you_mean(name, MODELS))


def move_particles(
    poses: Floats,
    before: Pose2,
    after: Pose2,
    model: OdometryModel,
    alphas: Floats,
    random: np.random.Generator,
) -> None:
    """Move particles as odometry did, each with noise of its own, in place.

    Args:
        poses: x, y [m] and heading [rad], shape (n, 3).
        before: The last odometry.
        after: The present odometry.
        model: Of the base.
        alphas: ``odom_alpha1`` to ``odom_alpha5``, shape (5,).
        random: Draws the noise.
    """
    if model.startswith("diff"):
        _turn_go_turn(poses, before, after, alphas, random, corrected=model == "diff-corrected")
    else:
        _move_in_any_direction(
            poses, before, after, alphas, random, corrected=model == "omni-corrected"
        )


def _turn_go_turn(
    poses: Floats,
    before: Pose2,
    after: Pose2,
    alphas: Floats,
    random: np.random.Generator,
    *,
    corrected: bool,
) -> None:
    dx, dy = after[0] - before[0], after[1] - before[1]
    distance = math.hypot(dx, dy)
    first = 0.0 if distance < _STANDING else wrapped(math.atan2(dy, dx) - before[2])
    second = wrapped(wrapped(after[2] - before[2]) - first)
    # Going backward is no half turn.
    small_first = min(abs(wrapped(first)), abs(wrapped(first - math.pi)))
    small_second = min(abs(wrapped(second)), abs(wrapped(second - math.pi)))
    a1, a2, a3, a4 = alphas[:4]
    spreads = (
        a1 * small_first**2 + a2 * distance**2,
        a3 * distance**2 + a4 * small_first**2 + a4 * small_second**2,
        a1 * small_second**2 + a2 * distance**2,
    )
    # The original takes variances for deviations, but where it is "corrected".
    sigmas = [math.sqrt(each) if corrected else each for each in spreads]
    noise = random.standard_normal((3, len(poses)))
    turn = first - sigmas[0] * noise[0]
    length = distance - sigmas[1] * noise[1]
    turn_again = second - sigmas[2] * noise[2]
    heading = poses[:, 2] + turn
    poses[:, 0] += length * np.cos(heading)
    poses[:, 1] += length * np.sin(heading)
    poses[:, 2] = wrapped_all(heading + turn_again)


def _move_in_any_direction(
    poses: Floats,
    before: Pose2,
    after: Pose2,
    alphas: Floats,
    random: np.random.Generator,
    *,
    corrected: bool,
) -> None:
    dx, dy = after[0] - before[0], after[1] - before[1]
    distance, turn = math.hypot(dx, dy), wrapped(after[2] - before[2])
    a1, a2, a3, a4, a5 = alphas[:5]
    spreads = (
        a3 * distance**2 + a1 * turn**2,
        a4 * turn**2 + a2 * distance**2,
        a1 * turn**2 + a5 * distance**2,
    )
    sigmas = [math.sqrt(each) if corrected else each for each in spreads]
    noise = random.standard_normal((3, len(poses)))
    direction = wrapped(math.atan2(dy, dx) - before[2]) + poses[:, 2]
    cos, sin = np.cos(direction), np.sin(direction)
    along = distance + sigmas[0] * noise[0]
    aside = sigmas[2] * noise[2]
    poses[:, 0] += along * cos + aside * sin
    poses[:, 1] += along * sin - aside * cos
    poses[:, 2] = wrapped_all(poses[:, 2] + turn + sigmas[1] * noise[1])
