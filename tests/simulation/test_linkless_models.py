"""A model without a link, as a wrapper whose include is not found: it is there, with its pose."""

import numpy as np
import pytest

from gazelle import Simulation, formats

pytestmark = pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")

WORLD = """<sdf version='1.6'><world name='w'>
<model name='ball'><pose>0 0 1 0 0 0</pose><link name='l'><collision name='c'><geometry><sphere>
<radius>0.1</radius></sphere></geometry></collision></link></model>
<model name='wrap'><pose>1 2 3 0 0 0.5</pose><include><uri>model://nowhere</uri></include></model>
<model name='bare'><pose>3 2 1 0 0 0</pose></model>
<model name='still'><static>1</static><pose>9 2 1 0 0 0</pose></model>
<model name='nest'><pose>4 4 4 0 0 0</pose><model name='inner'><static>1</static></model></model>
</world></sdf>"""
POSES = {"wrap": (1, 2, 3), "bare": (3, 2, 1), "still": (9, 2, 1), "nest": (4, 4, 4)}


@pytest.fixture(params=["mujoco", "planar"])
def sim(request):
    with Simulation(formats.load_string(WORLD), request.param, nworld=2) as simulation:
        yield simulation


@pytest.mark.parametrize("name", POSES)
def test_it_has_its_pose_and_stands_still(sim, name):
    sim.run(0.05)
    robot = sim.robots[name]
    assert robot.pose.position == POSES[name]
    assert robot.position.shape == (2, 3)
    assert not robot.twist.linear.any()
    assert robot.motion().angular.shape == (2, 3)
    assert dict(robot.links) == {}


@pytest.mark.parametrize("name", POSES)
def test_it_can_be_put_elsewhere_until_a_reset(sim, name):
    robot = sim.robots[name]
    robot.set_pose((5.0, 6.0, 7.0), yaw=0.25, worlds=[1])
    robot.set_twist((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    sim.run(0.05)
    np.testing.assert_allclose(robot.position[:, :2], [POSES[name][:2], (5.0, 6.0)])
    assert robot.yaw[1] == pytest.approx(0.25)
    sim.reset()
    np.testing.assert_allclose(robot.position, [POSES[name]] * 2)


def test_it_can_be_spawned_and_deleted(sim):
    text = "<sdf version='1.6'><model name='late'><pose>0 0 1 0 0 0</pose></model></sdf>"
    sim.spawn(formats.load_model_string(text))
    assert sim.robots["late"].pose.z == 1
    sim.delete("late")
    sim.delete("wrap")
    sim.run(0.01)
    assert set(sim.robots) == {"ball", "bare", "still", "nest"}
