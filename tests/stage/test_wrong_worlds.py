"""Worlds, robots and rows that are not there are refused before native code sees them."""

import numpy as np
import pytest

from gazelle import SimulationError

ROBOT = """
position ( name "r" size [.4 .4 .4] camera ( resolution [4 4] )
  gripper ( size [.2 .3 .2] pose [.3 0 -.4 0] )
  actuator ( type "linear" model ( size [.1 .1 .1] ) ) )
"""
ORIGIN = (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    "call",
    [
        lambda sim, bad: sim.reset_positions(bad),
        lambda sim, bad: sim.start_over(bad),
        lambda sim, bad: sim.set_pose("r", ORIGIN, bad),
        lambda sim, bad: sim.set_pose_of(0, ORIGIN, bad),
        lambda sim, bad: sim.place(bad, np.zeros((1, 3))),
        lambda sim, bad: sim.gripper("r").reset(bad),
        lambda sim, bad: sim.gripper("r").do("close", bad),
        lambda sim, bad: sim.actuator("r").reset(bad),
        lambda sim, bad: sim.actuator("r").go_to(1.0, bad),
        lambda sim, bad: sim.pictures(worlds=bad),
        lambda sim, bad: sim.picture("r", world=int(bad[0])),
        lambda sim, bad: sim.draw([("r", 0, int(bad[0]))]),
    ],
)
def test_worlds_that_are_not_there(start, call):
    sim = start(ROBOT, nworld=2)
    for world in (-1, 2, 2**62):
        with pytest.raises(SimulationError):
            call(sim, np.array([world]))
    sim.step()


@pytest.mark.parametrize(
    "call",
    [
        lambda sim: sim.set_pose_of(1, ORIGIN),
        lambda sim: sim.set_pose_of(-1, ORIGIN),
        lambda sim: sim.set_pose("r", (0.0, 1.0)),
        lambda sim: sim.set_pose("r", np.zeros((3, 3))),
        lambda sim: sim.set_pose("r", (1e300, 0.0, 0.0)),
        lambda sim: sim.place(np.array([0, 1]), np.zeros((1, 2))),
        lambda sim: sim.place(np.array([0.0]), np.zeros((1, 3))),
        lambda sim: sim.draw([("r", 0)]),
        lambda sim: sim.draw(["r"]),
        lambda sim: sim.pictures([]),
    ],
)
def test_poses_and_robots_that_cannot_be(start, call):
    sim = start(ROBOT)
    sim.commands[:] = 0.5
    before = sim.poses.copy(), sim.commands.copy()
    with pytest.raises(SimulationError):
        call(sim)
    assert (sim.poses == before[0]).all()
    assert (sim.commands == before[1]).all()
