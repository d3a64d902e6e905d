"""Lint rules for a whole world: steps, contacts, names, and models that fall."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator

from gazelle.description import Inertial, Mesh, Model, World
from gazelle.errors import Error
from gazelle.formats.lint.diagnostic import Diagnostic, links_of, moving_links_of

# Collision meshes above this many triangles slow every contact and ray.
_MOST_TRIANGLES = 20_000

# A contact spring's period should take at least this number of physics steps.
_STEPS_A_PERIOD = 2.0

# Stiffer springs are taken as rigid by everyone; SDF's default is 1e12 [N/m].
_RIGID = 1e9


def lint(world: World) -> Iterator[Diagnostic]:
    """Yield findings on steps, contacts, meshes, names and support."""
    yield from _step(world)
    yield from _contacts(world)
    yield from _meshes(world)
    yield from _names(world)
    yield from _falling(world)


def _step(world: World) -> Iterator[Diagnostic]:
    physics = world.profile
    if physics.max_step_size > 0.02:
        yield Diagnostic(
            "coarse-step",
            f"the physics step is {physics.max_step_size:g} s",
            "contacts and joints are no longer stable at steps above about 20 ms",
            "set <max_step_size> to 0.001, or at most 0.01",
            physics.source,
        )


def _contacts(world: World) -> Iterator[Diagnostic]:
    step = world.profile.max_step_size
    masses = {id(top): _mass(top) for top in world.models}
    for place in moving_links_of(world):
        mass = masses[id(place.top)]
        for collision in place.link.collisions:
            stiffness = collision.surface.contact.kp
            if not 0.0 < stiffness < _RIGID:
                continue
            period = 2.0 * math.pi * math.sqrt(mass / stiffness)
            if period < _STEPS_A_PERIOD * step:
                yield Diagnostic(
                    "stiff-contact",
                    f"collision '{place.scope}::{place.link.name}::{collision.name}': kp "
                    f"{stiffness:g} N/m with {mass:.3g} kg swings in {period * 1000:.2g} ms, "
                    f"less than {_STEPS_A_PERIOD:g} physics steps of {step * 1000:g} ms",
                    "a step this coarse cannot follow the spring; engines treat it as rigid",
                    f"lower kp below {mass * (math.pi / step) ** 2:.2g}, or leave it out for a "
                    "rigid contact",
                    collision.source,
                )


def _mass(model: Model) -> float:
    return sum(
        (link.inertial or Inertial()).mass for placed in model.walk() for link in placed.model.links
    )


def _meshes(world: World) -> Iterator[Diagnostic]:
    from gazelle.formats.mesh import load_mesh

    for place in links_of(world):
        for collision in place.link.collisions:
            shape = collision.geometry
            if not isinstance(shape, Mesh) or shape.path is None:
                continue
            try:
                triangles = len(load_mesh(shape).faces)
            except Error:
                continue  # reported by the reader of the mesh
            if triangles > _MOST_TRIANGLES:
                yield Diagnostic(
                    "heavy-mesh",
                    f"collision '{place.scope}::{place.link.name}::{collision.name}' is a mesh of "
                    f"{triangles:,} triangles",
                    "every contact and ray pays for them",
                    "use a simplified mesh or simple shapes for the collision, and this one for "
                    "the visual",
                    collision.source,
                )


def _names(world: World) -> Iterator[Diagnostic]:
    for name, count in Counter(model.name for model in world.models).items():
        if count > 1:
            yield Diagnostic(
                "duplicate-name",
                f"{count} models are called '{name}'",
                "only one of them can be found by that name",
                "give each a name of its own",
                world.source,
            )


def _falling(world: World) -> Iterator[Diagnostic]:
    """Yield unsupported things, in worlds that have a ground."""
    grounded = any(model.static and model.has_collisions for model in world.models)
    for model in world.models:
        held = any(j.parent == "world" for p in model.walk() for j in p.model.joints)
        weightless = all(not link.gravity for p in model.walk() for link in p.model.links)
        links = [link for p in model.walk() for link in p.model.links]
        free = not (model.static or held or weightless or any(link.kinematic for link in links))
        if grounded and links and free and not model.has_collisions:
            yield Diagnostic(
                "falls",
                f"model '{model.name}' has no collision, so it falls through the ground",
                "gravity pulls it and nothing stops it",
                "add collisions, set <static> to true, or <gravity> to false on its links",
                model.source,
            )
