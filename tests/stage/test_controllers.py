"""Controllers that users write, by the name that a world file gives them."""

import numpy as np
import pytest

from gazelle.errors import SimulationError
from gazelle.stage import FleetController, controllers, register_controller
from gazelle.stage.format.models import known_controllers

TEXT = """
position ( name "a" ctrl "patrol 0.5" ) position ( name "b" pose [0 5 0 0] )
position ( name "c" pose [0 9 0 90] ctrl [ "patrol" "wander" ] ranger ( sensor ( samples 9 ) ) )
"""


class Patrol(FleetController):
    """Drives at the speed that the file says, and turns round every ten updates."""

    def __init__(self, sim, wanted):
        self.sim = sim
        self.robots = [robot.index for robot, _ in wanted]
        self.speeds = np.array([float(text or 0.1) for _, text in wanted])
        self.updates = 0

    def update(self):
        way = 1.0 if self.updates // 10 % 2 == 0 else -1.0
        self.sim.commands[:, self.robots, 0] = way * self.speeds
        self.updates += 1

    def reset(self, worlds=None):
        if worlds is None:
            self.updates = 0


@pytest.fixture
def patrol(monkeypatch):
    monkeypatch.setattr(controllers, "_makers", dict(controllers._makers))
    register_controller("patrol", lambda sim, wanted: [Patrol(sim, wanted)])
    yield
    known_controllers.discard("patrol")


@pytest.mark.usefixtures("patrol")
def test_a_registered_controller_drives_the_robots_that_name_it(start):
    sim = start(TEXT, nworld=2)  # without a warning
    sim.step(10)
    assert sim.poses[:, 0, 0] == pytest.approx(0.5)
    assert (sim.poses[:, 1] == [0.0, 5.0, 0.0]).all()
    assert (sim.poses[:, 2, 1] > 9.0).all()
    sim.step(10)
    assert sim.poses[:, 0, 0] == pytest.approx(0.0, abs=1e-12)
    sim.step(5)
    sim.reset()
    sim.step(10)
    assert sim.poses[:, 0, 0] == pytest.approx(0.5)


@pytest.mark.usefixtures("patrol")
def test_it_is_left_out_with_the_others(start):
    sim = start(TEXT, controllers=False)
    sim.step(3)
    assert not sim.commands.any()


@pytest.mark.parametrize("name", ["", "two words", " "])
def test_a_name_is_one_word(name):
    with pytest.raises(SimulationError, match="one word"):
        register_controller(name, lambda _sim, _wanted: [])
    assert name not in known_controllers
