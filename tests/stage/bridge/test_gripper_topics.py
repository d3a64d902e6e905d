"""Grippers on the graph."""

import pytest

STATE = "gazelle_msgs/Gripper"
GRIPPER = "gripper ( size [.2 .3 .2] pose [.3 0 -.4 0] )"
ROBOT = f"robot ( {GRIPPER} )\n"
PUCK = 'model ( name "puck" size [.08 .08 .1] gripper_return 1 pose [.34 0 0 0] )\n'


def test_a_gripper_is_told_to_close_and_tells_what_it_carries(stage):
    world = stage(ROBOT + PUCK)
    heard = world.listen("/gripper", STATE)
    first = world.step(heard)
    assert (first.paddles, first.lift, first.carried) == (0.0, 0.0, "")
    assert first.header.frame_id == "base_link"
    assert any(first.beams)
    world.send("/cmd_gripper", "std_msgs/String", data="close")
    gripper = world.sim.gripper("position:0")
    world.until(lambda: gripper._closing[0] == 1)
    last = world.step(heard, 25)
    assert last.carried == "puck"
    assert last.paddles == pytest.approx(0.68)


def test_what_is_no_command_changes_nothing(stage):
    world = stage(ROBOT)
    world.send("/cmd_gripper", "std_msgs/String", data="shut")
    world.send("/cmd_gripper", "std_msgs/String", data="up")
    gripper = world.sim.gripper("position:0")
    world.until(lambda: gripper._rising[0] == 1)
    assert gripper._closing[0] == 0


def test_names_of_several(stage):
    topics = stage(f"robot ( {GRIPPER} {GRIPPER} )\n" + ROBOT + "robot ( )").topics()
    assert {"/robot_0/gripper_0", "/robot_0/cmd_gripper_1", "/robot_1/gripper"} <= topics.keys()
    assert "/robot_2/gripper" not in topics
