"""Mass and inertia of bodies put together from shapes."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.argument_checks import checked
from gazelle.builders.errors import BuildError, positive
from gazelle.description import Geometry, Inertial, Pose
from gazelle.formats.solids import inertial_of, solid_of
from gazelle.geometry.solids import UnitSolid, joined


@checked(BuildError)
def solid_inertial(parts: Sequence[tuple[Geometry, Pose]], mass: float) -> Inertial:
    """Return mass and inertia of a body of one density, from its shapes and their poses.

    Where shapes overlap, the common volume counts twice.

    Args:
        parts: Shapes, each with its pose in the link frame.
        mass: Of the whole body [kg].

    Raises:
        BuildError: The mass is not positive, or a shape has no volume.
        FormatError: A mesh cannot be read.
    """
    positive(mass, "the mass")
    whole = joined(_solid(shape).placed(pose.matrix()) for shape, pose in parts)
    if whole is None:
        raise BuildError("a body without shapes has no inertia")
    return inertial_of(whole.scaled(mass / whole.volume))


def _solid(shape: Geometry) -> UnitSolid:
    found = solid_of(shape)
    if found is None:
        kind = type(shape).__name__.lower()
        raise BuildError(f"a {kind} has no volume to give it inertia", hint="give the inertial")
    return found
