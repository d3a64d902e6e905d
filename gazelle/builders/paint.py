"""Colours by name, as the materials of visuals."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.argument_checks import checked
from gazelle.builders.errors import BuildError
from gazelle.description import Color, Material
from gazelle.errors import did_you_mean
from gazelle.formats.materials import script_colors

Paint = str | Sequence[float] | Material
"""A name of ``PALETTE``, a ``Gazebo/...`` script, three or four numbers, or a material."""

PALETTE: dict[str, tuple[float, float, float]] = {
    "asphalt": (0.24, 0.24, 0.26),
    "bark": (0.36, 0.25, 0.17),
    "beech": (0.80, 0.64, 0.45),
    "black": (0.09, 0.09, 0.10),
    "blue": (0.16, 0.36, 0.62),
    "brick": (0.64, 0.36, 0.28),
    "carpet": (0.46, 0.50, 0.55),
    "clay": (0.72, 0.49, 0.36),
    "concrete": (0.62, 0.62, 0.60),
    "cream": (0.92, 0.88, 0.78),
    "earth": (0.45, 0.36, 0.26),
    "glass": (0.52, 0.66, 0.76),
    "grass": (0.38, 0.53, 0.25),
    "green": (0.24, 0.52, 0.30),
    "grey": (0.50, 0.51, 0.53),
    "leaf": (0.25, 0.45, 0.20),
    "light grey": (0.78, 0.79, 0.80),
    "meadow": (0.45, 0.58, 0.29),
    "needle": (0.13, 0.32, 0.20),
    "oak": (0.66, 0.50, 0.33),
    "orange": (0.88, 0.50, 0.16),
    "plaster": (0.90, 0.89, 0.86),
    "red": (0.72, 0.20, 0.18),
    "rock": (0.50, 0.48, 0.45),
    "roof": (0.48, 0.25, 0.20),
    "sand": (0.80, 0.72, 0.54),
    "slate": (0.32, 0.35, 0.40),
    "steel": (0.55, 0.57, 0.60),
    "walnut": (0.40, 0.27, 0.19),
    "white": (0.95, 0.95, 0.94),
    "yellow": (0.92, 0.76, 0.22),
}
"""Red, green and blue, each 0 to 1, of the names that ``material`` takes."""


@checked(BuildError)
def material(paint: Paint) -> Material:
    """Return the material of a colour.

    Args:
        paint: A name of ``PALETTE``; the name of a Gazebo material script such as
            ``Gazebo/Grey``; red, green, blue and perhaps alpha, each 0 to 1; or a material,
            which comes back as it is.

    Raises:
        BuildError: The name is unknown, or the numbers are no colour.
    """
    if isinstance(paint, Material):
        return paint
    if isinstance(paint, str):
        if paint.startswith("Gazebo/"):
            return _scripted(paint)
        if paint not in PALETTE:
            raise BuildError(f"unknown colour '{paint}'", hint=did_you_mean(paint, PALETTE))
        return _plain((*PALETTE[paint], 1.0))
    numbers = tuple(float(value) for value in paint)
    if len(numbers) not in {3, 4} or not all(0.0 <= value <= 1.0 for value in numbers):
        raise BuildError(f"a colour is three or four numbers from 0 to 1, found {numbers}")
    red, green, blue, alpha = (*numbers, 1.0)[:4]
    return _plain((red, green, blue, alpha))


def _plain(color: Color) -> Material:
    return Material(ambient=color, diffuse=color)


def _scripted(name: str) -> Material:
    known = script_colors(name)
    if known is None:
        raise BuildError(
            f"the colours of the material script '{name}' are not known",
            hint="pass a gazelle.description.Material to use it nevertheless",
        )
    ambient, diffuse = known
    return Material(ambient, diffuse, script=name)
