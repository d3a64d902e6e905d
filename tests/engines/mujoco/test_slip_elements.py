"""Effects of SDF's slip1 and slip2 on wheels."""

import warnings

import numpy as np
import pytest
from models import GROUND, base

from gazelle import formats
from gazelle.engines import make_engine
from gazelle.errors import EngineWarning

FORCE, SLIP = 2.0, 0.1
WHEELS = [f"base::wheel{i}" for i in range(4)]
ALONG, ACROSS = "<fdir1>0 0 1</fdir1>", "<fdir1>1 0 0</fdir1>"


def described(tags, *, model="", yaw=0.0, nworld=1):
    """Return a base whose wheels have more friction tags."""
    text = (model or base("")).replace("</mu2>", f"</mu2>{tags}")
    text = text.replace('<model name="base">', f'<model name="base"><pose>0 0 0 0 0 {yaw}</pose>')
    text = f'<sdf version="1.6"><world name="w">{GROUND}{text}</world></sdf>'
    return make_engine("mujoco", formats.load_string(text), nworld)


def slips(slip1=0.0, slip2=0.0, fdir1=""):
    return f"<slip1>{slip1}</slip1><slip2>{slip2}</slip2>{fdir1}"


def drift(engine, force):
    """Return the speed of a base along a force with its wheels held."""
    for i in range(4):
        engine.add_motor(f"base::joint{i}", 50.0)  # at rest
    engine.links["base::body"].set_wrench(force, (0.0, 0.0, 0.0))
    engine.step(1000)
    return engine.links["base::body"].motion().linear[0]


@pytest.mark.parametrize(
    ("tags", "lateral", "rolling"),
    [
        (slips(SLIP, 0.0, ALONG), SLIP, 0.0),
        (slips(0.0, SLIP, ALONG), 0.0, SLIP),
        (slips(SLIP, 0.0, ACROSS), 0.0, SLIP),
        (slips(0.0, SLIP, ACROSS), SLIP, 0.0),
        (slips(SLIP, 0.0), SLIP, 0.0),
        (slips(SLIP, SLIP), SLIP, SLIP),
        (slips(SLIP, SLIP, "<fdir1>1 0 1</fdir1>"), SLIP, SLIP),
    ],
)
def test_a_wheel_slips_by_its_slip_times_the_force_along_and_across_its_axle(
    tags, lateral, rolling
):
    aside = drift(described(tags), (0.0, FORCE, 0.0))[1]
    ahead = drift(described(tags), (FORCE, 0.0, 0.0))[0]
    assert aside == pytest.approx(lateral * FORCE / 4.0, rel=0.03, abs=1e-3)
    assert ahead == pytest.approx(rolling * FORCE / 4.0, rel=0.03, abs=1e-3)


def test_without_a_direction_the_first_is_world_y_with_the_wheel_as_it_starts():
    engine = described(slips(SLIP), yaw=np.pi / 2)
    # The axles lie along x now: the wheels slip as they roll, which is along y.
    assert drift(engine, (0.0, FORCE, 0.0))[1] == pytest.approx(SLIP * FORCE / 4.0, rel=0.03)


def test_a_wheel_does_not_slip_further_than_its_friction_holds():
    model = base("", mu=0.1)
    engine = described(slips(SLIP, 0.0, ALONG), model=model)
    weight = 6.0 * 9.8
    engine.links["base::body"].set_wrench((0.0, 0.1 * weight + 6.0, 0.0), (0.0, 0.0, 0.0))
    engine.step(500)
    engine.links["base::body"].set_wrench((0.0, 0.1 * weight + 6.0, 0.0), (0.0, 0.0, 0.0))
    start = engine.links["base::body"].motion().linear[0, 1]
    engine.step(500)
    gained = engine.links["base::body"].motion().linear[0, 1] - start
    assert gained / 0.5 == pytest.approx(1.0, rel=0.05)


@pytest.mark.long
def test_the_slip_of_the_file_can_be_read_and_changed_and_outlasts_new_masses():
    engine = described(slips(SLIP, 0.0, ALONG), nworld=2)
    np.testing.assert_allclose(engine.parameter("wheel_slip", WHEELS[0]), [[SLIP, 0.0]] * 2)
    engine.set_parameter("link_mass", "base::body", [[4.0], [40.0]])
    engine.set_parameter("link_mass", WHEELS[0], [[0.5], [5.0]])
    engine.links["base::body"].set_wrench((0.0, FORCE, 0.0), (0.0, 0.0, 0.0))
    engine.step(4000)
    velocity = engine.links["base::body"].motion().linear[:, 1]
    assert velocity == pytest.approx(SLIP * FORCE / 4.0, rel=0.1)
    for wheel in WHEELS:
        engine.set_parameter("wheel_slip", wheel, 0.0)
    engine.step(1000)
    assert engine.links["base::body"].motion().linear[:, 1] == pytest.approx(0.0, abs=1e-3)


@pytest.mark.parametrize(
    "tags",
    [
        slips(SLIP, 0.0, "<fdir1>1 0 1</fdir1>"),
        slips(-1.0, -1.0),
        slips(SLIP).replace("slip1", "slip3"),
    ],
)
def test_slip_that_cannot_be_told_is_rigid_and_only_oblique_directions_are_warned_of(tags):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        engine = described(tags)
    said = [str(each.message) for each in caught if each.category is EngineWarning]
    assert bool(said) == ("1 0 1" in tags)
    assert engine.parameter("wheel_slip", WHEELS[0]).max() == 0.0
