"""Wheels that slip in proportion to the force on them."""

import numpy as np
import pytest
from models import GROUND, base

from gazelle import formats
from gazelle.engines import make_engine
from gazelle.errors import EngineError

FORCE = 2.0
SLIPS = np.array([[0.05, 0.0], [0.1, 0.0]])  # [m/s/N], one row a world
WHEELS = [f"base::wheel{i}" for i in range(4)]


def fresh(model=None, nworld=2, step=0.001):
    text = f'<sdf version="1.6"><world name="w">{GROUND}{model or base("")}</world></sdf>'
    return make_engine("mujoco", formats.load_string(text), nworld, time_step=step)


def slipping(**options):
    engine = fresh(**options)
    for wheel in WHEELS:
        engine.set_parameter("wheel_slip", wheel, SLIPS)
    return engine


def pushed(engine, seconds=1.0, force=(0.0, FORCE, 0.0)):
    """Return the speed of the base after a push for some time."""
    engine.links["base::body"].set_wrench(force, (0.0, 0.0, 0.0))
    engine.step(round(seconds / engine.time_step))
    return engine.links["base::body"].motion().linear


@pytest.mark.parametrize("step", [0.001, 0.005])
def test_worlds_slip_by_slips_of_their_own_at_any_step(step):
    velocity = pushed(slipping(step=step))
    assert velocity[:, 1] == pytest.approx(SLIPS[:, 0] * FORCE / 4.0, rel=0.03)


def test_a_wheel_turns_under_its_tyre():
    engine = fresh()
    for wheel in WHEELS:
        engine.set_parameter("wheel_slip", wheel, SLIPS[:, ::-1] / 0.1**2)
    for i in range(4):
        engine.add_motor(f"base::joint{i}", 50.0)  # at rest
    velocity = pushed(engine, force=(FORCE, 0.0, 0.0))
    assert velocity[:, 0] == pytest.approx(SLIPS[:, 0] * FORCE / 4.0, rel=0.02)
    assert engine.joints["base::joint0"].velocity()[:, 0] == pytest.approx(0.0, abs=0.02)


@pytest.mark.long
def test_slip_lasts_when_models_come_and_go_and_ends_when_told():
    engine = slipping()
    velocity = pushed(engine)
    box = formats.load_model_string(
        '<sdf version="1.6"><model name="b"><pose>3 0 1 0 0 0</pose><link name="l"/></model></sdf>'
    )
    engine.spawn(box)
    assert pushed(engine, 0.2) == pytest.approx(velocity, abs=1e-3)
    engine.delete("b")
    assert pushed(engine, 0.2) == pytest.approx(velocity, abs=1e-3)
    np.testing.assert_array_equal(engine.parameter("wheel_slip", WHEELS[0]), SLIPS)
    for wheel in WHEELS:
        engine.set_parameter("wheel_slip", wheel, 0.0)
    assert pushed(engine, 0.5)[:, 1] == pytest.approx(0.0, abs=3e-4)
    engine.delete("base")
    engine.step()


def test_another_engine_slips_on_from_history_and_snapshot():
    engine = slipping()
    pushed(engine, 0.3)
    other = fresh()
    other.adopt(engine.history())
    other.restore(engine.snapshot())
    engine.step(200)
    other.step(200)
    np.testing.assert_array_equal(other.snapshot(), engine.snapshot())


def test_links_of_one_model_still_collide_only_if_they_say_so():
    engine = slipping(model=base("").replace("0 0 0.12 0 0 0", "0 0 0.1 0 0 0"))
    engine.step(300)
    # The body's box reaches into its wheels: it lies still all the same.
    assert np.abs(engine.links["base::body"].motion().linear).max() < 1e-3
    names = [f"{wheel}::c" for wheel in WHEELS]
    assert set(engine.contacts([names]).named().others) == {"ground_plane::link::collision"}


def test_what_is_no_wheel_does_not_slip():
    engine = fresh()
    with pytest.raises(EngineError, match="not a wheel"):
        engine.set_parameter("wheel_slip", "base::body", SLIPS)
    with pytest.raises(EngineError, match="negative"):
        engine.set_parameter("wheel_slip", WHEELS[0], -SLIPS)
    slides = base("").replace('type="revolute"', 'type="prismatic"')
    with pytest.raises(EngineError, match="needs a revolute joint"):
        fresh(slides).set_parameter("wheel_slip", WHEELS[0], SLIPS)
    engine.step()


def test_a_model_that_is_only_placed_forgets_its_slip():
    engine = slipping()
    engine.make_kinematic("base")
    engine.models["base"].set_placement((1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    engine.step(5)
    assert engine.models["base"].placement().position[:, 0] == pytest.approx(1.0)
