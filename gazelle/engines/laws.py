"""Physics profile of a whole world, apart from its content."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description import Physics, Vector3, World


def with_profile(world: World, profile: Physics) -> World:
    """Return the world with its active physics profile replaced."""
    used = world.profile
    if not any(each is used for each in world.physics):
        return replace(world, physics=(*world.physics, profile))
    changed = tuple(profile if each is used else each for each in world.physics)
    return replace(world, physics=changed)


def laws_of(world: World) -> tuple[Physics, Vector3, Vector3]:
    """Return the laws that move bodies: physics profile without its pace, gravity, magnetic field."""
    profile = replace(world.profile, real_time_factor=1.0, real_time_update_rate=0.0)
    return profile, world.gravity, world.magnetic_field
