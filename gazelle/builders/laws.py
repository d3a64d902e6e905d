"""Physics presets: how finely a world is simulated, and on which planet."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Literal

from gazelle.argument_checks import checked
from gazelle.builders.errors import BuildError
from gazelle.description import Atmosphere, Ode, Physics, Vector3, World
from gazelle.errors import did_you_mean

PresetName = Literal["default", "real-time", "accurate", "fast"]
PlanetName = Literal["earth", "moon", "mars", "zero-gravity"]

PRESETS: dict[str, Physics] = {
    "default": Physics(),
    "real-time": Physics(
        "real_time", max_step_size=0.002, real_time_update_rate=500.0, ode=Ode(iters=30)
    ),
    "accurate": Physics(
        "accurate",
        max_step_size=0.00025,
        real_time_update_rate=4000.0,
        ode=Ode(iters=200, sor=1.0, friction_model="cone_model"),
    ),
    "fast": Physics("fast", max_step_size=0.004, real_time_update_rate=0.0, ode=Ode(iters=20)),
}
"""Profiles by name: Gazebo's default; for many things in real time (2 ms steps); four times
finer than the default; and as fast as possible for learning (4 ms steps)."""


@checked(BuildError)
@dataclass(frozen=True, slots=True)
class Planet:
    """Environment of a planet.

    Attributes:
        gravity: [m/s²].
        magnetic_field: [T].
        atmosphere: Air at the ground.
    """

    gravity: Vector3
    magnetic_field: Vector3 = (0.0, 0.0, 0.0)
    atmosphere: Atmosphere = field(default_factory=Atmosphere)


_VACUUM = Atmosphere(temperature=250.0, temperature_gradient=0.0, pressure=0.0)

PLANETS: dict[str, Planet] = {
    "earth": Planet((0.0, 0.0, -9.80665), (5.5645e-6, 22.8758e-6, -42.3884e-6)),
    "moon": Planet((0.0, 0.0, -1.62), atmosphere=_VACUUM),
    "mars": Planet(
        (0.0, 0.0, -3.73),
        atmosphere=Atmosphere(temperature=210.0, temperature_gradient=-0.0025, pressure=636.0),
    ),
    "zero-gravity": Planet((0.0, 0.0, 0.0), atmosphere=_VACUUM),
}
"""Places by name. Earth: standard gravity (BIPM, "The International System of Units"), and
SDF's default field and air. Moon and Mars: mean surface gravity, and temperature and pressure
at the ground, of NASA's Planetary Fact Sheets; their fields are too weak to matter."""


def physics(preset: PresetName | str = "default", **changes: float) -> Physics:
    """Return a physics profile by name.

    Args:
        preset: ``default``, ``real-time``, ``accurate`` or ``fast``; see ``PRESETS``.
        **changes: Fields of ``Physics`` that are to differ, such as ``max_step_size``.

    Raises:
        BuildError: There is no such preset or field.
    """
    if preset not in PRESETS:
        raise BuildError(f"unknown physics '{preset}'", hint=did_you_mean(preset, PRESETS))
    chosen = PRESETS[preset]
    numbers = {"max_step_size", "real_time_factor", "real_time_update_rate", "max_contacts"}
    for name, value in changes.items():
        if name not in numbers:
            raise BuildError(f"unknown setting '{name}'", hint=did_you_mean(name, numbers))
        if not 0.0 <= value < math.inf or (name == "max_step_size" and value == 0.0):
            raise BuildError(f"'{name}' is out of range: {value:g}")
    return replace(chosen, **changes)  # type: ignore[arg-type]  # the names were just checked


@checked(BuildError)
def planet(name: PlanetName | str) -> Planet:
    """Return a place by name: ``earth``, ``moon``, ``mars`` or ``zero-gravity``.

    Raises:
        BuildError: There is no such place.
    """
    if name not in PLANETS:
        raise BuildError(f"unknown planet '{name}'", hint=did_you_mean(name, PLANETS))
    return PLANETS[name]


@checked(BuildError)
def with_physics(world: World, preset: PresetName | str | Physics) -> World:
    """Return the world with one physics profile, given or by name, in place of its own.

    Raises:
        BuildError: There is no such preset.
    """
    chosen = preset if isinstance(preset, Physics) else physics(preset)
    return replace(world, physics=(chosen,))


@checked(BuildError)
def on_planet(world: World, name: PlanetName | str) -> World:
    """Return the world with the gravity, magnetic field and air of a place.

    Raises:
        BuildError: There is no such place.
    """
    chosen = planet(name)
    return replace(
        world,
        gravity=chosen.gravity,
        magnetic_field=chosen.magnetic_field,
        atmosphere=chosen.atmosphere,
    )
