"""Steps of engines without dynamics, which a file may give besides those of other engines."""

import pytest

from gazelle.description import Physics, World
from gazelle.engines.planar import PlanarEngine


@pytest.mark.parametrize(
    ("physics", "time_step", "expected"),
    [
        (Physics(max_step_size=0.002), None, 0.002),
        (Physics(max_step_size=0.002, kinematic_step=0.1), None, 0.1),
        (Physics(max_step_size=0.002, kinematic_step=0.1), 0.05, 0.05),
    ],
)
def test_the_step_is_the_callers_then_the_kinematic_then_the_largest(physics, time_step, expected):
    engine = PlanarEngine(World(physics=(physics,)), time_step=time_step)
    assert engine.time_step == engine.world.profile.max_step_size == expected
    again = PlanarEngine(engine.world)
    assert again.time_step == (physics.kinematic_step or expected)
    engine.close()
    again.close()


def test_the_real_time_factor_stays():
    physics = Physics(max_step_size=0.01, real_time_update_rate=300.0, kinematic_step=0.1)
    engine = PlanarEngine(World(physics=(physics,)))
    assert engine.world.profile.real_time_update_rate == pytest.approx(30.0)
    engine.close()
