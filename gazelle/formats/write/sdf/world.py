"""``<world>`` and what holds in all of it."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description import (
    Atmosphere,
    Ode,
    Parameters,
    Physics,
    Pose,
    Scene,
    SphericalCoordinates,
    World,
)
from gazelle.errors import FormatError
from gazelle.formats.sdf import state
from gazelle.formats.sdf.world import USER_CAMERA
from gazelle.formats.write.element import distinct, element, group, inside, leaf, overlay, pose_leaf
from gazelle.formats.write.sdf.joint import write_joint
from gazelle.formats.write.sdf.link import write_light
from gazelle.formats.write.sdf.model import write_frame, write_part
from gazelle.formats.write.sdf.plugin import write_plugin
from gazelle.formats.write.writing import Writing


def write_world(world: World, writing: Writing) -> Parameters:
    """Write a world with everything in it."""
    usual = World()
    world = _unrestored(world, writing)
    with inside("world", world):
        distinct("model", world.models)
        return element(
            "world",
            *map(write_physics, world.physics),
            leaf("gravity", world.gravity, usual.gravity),
            leaf("magnetic_field", world.magnetic_field, usual.magnetic_field),
            group("wind", leaf("linear_velocity", world.wind, usual.wind)),
            write_atmosphere(world.atmosphere),
            write_spherical(world.spherical_coordinates),
            write_scene(world.scene),
            *_extras(world),
            *map(write_light, world.lights),
            *(write_part(model, writing) for model in world.models),
            *map(write_frame, world.frames),
            *(write_joint(joint, writing) for joint in world.joints),
            *map(write_plugin, world.plugins),
            *world.states,
            name=world.name,
        )


def write_physics(physics: Physics) -> Parameters:
    """Write ``<physics>``: one profile."""
    usual = Physics()
    with inside("physics", physics):
        known = element(
            "physics",
            leaf("max_step_size", physics.max_step_size),
            leaf("real_time_factor", physics.real_time_factor),
            leaf("real_time_update_rate", physics.real_time_update_rate),
            leaf("max_contacts", physics.max_contacts, usual.max_contacts),
            write_ode(physics.ode),
            name=physics.name,
            default="true" if physics.default else "",
            type=physics.type,
        )
        return overlay(element("physics", *physics.extras), known) if physics.extras else known


def write_ode(ode: Ode) -> Parameters | None:
    """Write ``<ode>``, what differs from the defaults."""
    usual = Ode()
    solver = ("min_step_size", "iters", "precon_iters", "sor", "friction_model")
    constraints = ("cfm", "erp", "contact_max_correcting_vel", "contact_surface_layer")
    return group(
        "ode",
        group(
            "solver",
            leaf("type", ode.solver, usual.solver),
            *(leaf(name, getattr(ode, name), getattr(usual, name)) for name in solver),
        ),
        group(
            "constraints",
            *(leaf(name, getattr(ode, name), getattr(usual, name)) for name in constraints),
        ),
    )


def write_atmosphere(air: Atmosphere) -> Parameters | None:
    """Write ``<atmosphere>``; None for the usual one."""
    if air == Atmosphere():
        return None
    return element(
        "atmosphere",
        leaf("temperature", air.temperature),
        leaf("temperature_gradient", air.temperature_gradient),
        leaf("pressure", air.pressure),
        type=air.type,
    )


def write_spherical(place: SphericalCoordinates | None) -> Parameters | None:
    """Write ``<spherical_coordinates>``."""
    if place is None:
        return None
    return element(
        "spherical_coordinates",
        leaf("surface_model", place.surface_model),
        leaf("latitude_deg", place.latitude),
        leaf("longitude_deg", place.longitude),
        leaf("elevation", place.elevation),
        leaf("heading_deg", place.heading),
    )


def write_scene(scene: Scene) -> Parameters | None:
    """Write ``<scene>``; None for the usual one."""
    if scene == Scene():
        return None
    known = element(
        "scene",
        leaf("ambient", scene.ambient),
        leaf("background", scene.background),
        leaf("shadows", scene.shadows),
        leaf("grid", scene.grid, True),
        element("sky") if scene.sky else None,
    )
    return overlay(element("scene", *scene.extras), known) if scene.extras else known


def _extras(world: World) -> list[Parameters]:
    """Return the elements that are kept whole, with the user's camera added to the ``<gui>``."""
    if world.camera is None:
        return list(world.extras)
    shown = _gui(world.camera)
    guis = [extra for extra in world.extras if extra.tag == "gui"]
    if not guis:
        return [shown, *world.extras]
    return [overlay(e, shown) if e is guis[0] else e for e in world.extras]


def _gui(camera: Pose) -> Parameters:
    return element("gui", element("camera", pose_leaf(camera, always=True), name=USER_CAMERA))


def _unrestored(world: World, writing: Writing) -> World:
    """Return the world before its saved state was applied, as libsdformat leaves it.

    Without its states, if they would move what is no longer where the first one put it.
    """
    try:
        before = state.unapplied(world)
    except FormatError:
        before = None
    if before is not None:
        return before
    writing.note(
        "the poses differ from those of the saved <state>, which is left out",
        world.states[0].source,
    )
    return replace(world, states=())
