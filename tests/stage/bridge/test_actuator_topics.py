"""Actuators on the graph."""

import pytest
import scenes

from gazelle.description import Pose

NUMBER = "std_msgs/Float64"
ARM = 'actuator ( size [.1 .1 .1] type "linear" axis [0 0 1] max_position 2 max_speed 0.5 )'


def test_an_actuator_is_told_and_tells(stage):
    world = stage(f"robot ( {ARM} )")
    heard = world.listen("/actuator", NUMBER)
    assert world.step(heard).data == 0.0
    arm = world.sim.actuator("position:0")
    world.send("/cmd_actuator_speed", NUMBER, data=0.4)
    world.until(lambda: arm._goal[0] == 0.4)
    assert world.step(heard, 10).data == pytest.approx(0.4)
    world.send("/cmd_actuator_position", NUMBER, data=float("nan"))
    world.send("/cmd_actuator_position", NUMBER, data=0.1)
    world.until(lambda: arm._goal[0] == 0.1)
    assert world.step(heard, 100).data == pytest.approx(0.1, abs=1e-3)


def test_it_goes_on_when_models_come_and_go(stage):
    world = stage(f"robot ( {ARM} )")
    heard = world.listen("/actuator", NUMBER)
    simulation = world.sim.simulation
    for speed, change in (
        (0.4, lambda: simulation.spawn(scenes.box(), name="post", pose=Pose(x=3.0))),
        (0.2, lambda: simulation.delete("post")),
    ):
        change()
        world.send("/cmd_actuator_speed", NUMBER, data=speed)
        world.until(lambda s=speed: world.sim.actuator("position:0")._goal[0] == s)
        before = world.step(heard).data
        assert world.step(heard, 5).data - before == pytest.approx(0.5 * speed)


def test_names_of_several(stage):
    topics = stage(f"robot ( {ARM} {ARM} )\nrobot ( {ARM} )\nrobot ( )").topics()
    assert {"/robot_0/actuator_1", "/robot_0/cmd_actuator_speed_0", "/robot_1/actuator"} <= set(
        topics
    )
    assert "/robot_2/actuator" not in topics
