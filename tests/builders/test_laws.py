"""Physics presets and planets."""

import math

import pytest

import gazelle
from gazelle.builders import (
    PLANETS,
    PRESETS,
    BuildError,
    WorldBuilder,
    ground,
    on_planet,
    physics,
    planet,
    sphere,
    with_physics,
)
from gazelle.description import Physics, Pose, World

G = 6.6743e-11  # CODATA 2018 [m³/(kg s²)]


def test_the_default_is_gazebos():
    assert physics() == Physics()


def test_presets_are_finer_or_faster():
    steps = {name: preset.max_step_size for name, preset in PRESETS.items()}
    assert steps["accurate"] < steps["default"] < steps["real-time"] < steps["fast"]
    for name in ("default", "real-time", "accurate"):
        assert PRESETS[name].max_step_size * PRESETS[name].real_time_update_rate == pytest.approx(1)


@pytest.mark.parametrize(
    ("name", "mass", "radius"), [("moon", 7.346e22, 1737.4e3), ("mars", 6.417e23, 3389.5e3)]
)
def test_gravity_is_newtons(name, mass, radius):
    assert -planet(name).gravity[2] == pytest.approx(G * mass / radius**2, rel=5e-3)


@pytest.mark.parametrize("name", PLANETS)
def test_things_fall_as_they_do_there(name):
    ball = sphere("ball", 0.1, mass=1.0, pose=Pose(z=50.0))
    world = on_planet(with_physics(World(models=(ground(), ball)), "accurate"), name)
    with gazelle.Simulation(world) as sim:
        sim.run(1.0)
        fallen = 50.0 - sim.robots["ball"].pose.z
    assert fallen == pytest.approx(-0.5 * planet(name).gravity[2], rel=1e-3, abs=1e-9)


def test_settings_can_be_changed():
    assert physics("fast", max_step_size=0.01).max_step_size == 0.01
    assert WorldBuilder().physics("fast", max_step_size=0.01).build().profile.name == "fast"
    assert with_physics(World(), Physics("mine")).profile.name == "mine"


def test_unknown_names_get_a_hint():
    with pytest.raises(BuildError, match="did you mean 'accurate'"):
        physics("acurate")
    with pytest.raises(BuildError, match="did you mean 'max_step_size'"):
        physics(step_size=0.1)
    with pytest.raises(BuildError, match="out of range"):
        physics(max_step_size=0.0)
    with pytest.raises(BuildError, match="out of range"):
        physics(max_step_size=math.nan)
    with pytest.raises(BuildError, match="did you mean 'mars'"):
        planet("marz")
