"""Counter of collisions in other tests."""

from touch_counter import Touches

import gazelle
from gazelle.description import Pose


def test_a_robot_that_runs_into_pillars_is_counted_and_one_that_drives_is_not():
    with gazelle.Simulation("turtlebot3_world", engine="mujoco", seed=0) as sim:
        robot = sim.spawn("turtlebot3_burger", pose=Pose(x=-1.5, y=0.0))
        touches = Touches(sim, robot.name)
        robot.inputs["cmd_vel"].send(linear=0.2, angular=0.0)
        for wanted, cycles in ((0, 25), (1, 60)):
            for _ in range(cycles):
                sim.run(seconds=0.02)
                touches.look()
            assert touches.count == wanted
        robot.inputs["cmd_vel"].send(linear=-0.2, angular=0.0)
        for _ in range(40):
            sim.run(seconds=0.02)
            touches.look()
        robot.inputs["cmd_vel"].send(linear=0.2, angular=0.0)
        for _ in range(60):
            sim.run(seconds=0.02)
            touches.look()
        assert touches.count == 2
        assert set(touches.met) == {"ros_symbol::symbol::pillar_2"}
