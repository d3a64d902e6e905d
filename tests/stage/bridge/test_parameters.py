"""Private parameters of the node: what they mean, and what is said of a slip."""

import pytest

from gazelle.errors import RosError, SimulationWarning

ROBOT = "robot ( pose [1 2 0 90] )"


def test_time_may_go_on_at_a_reset(stage):
    world = stage(ROBOT, {"monotonic_clock": True})
    clock = world.listen("/clock", "rosgraph_msgs/Clock")
    odom = world.listen("/odom", "nav_msgs/Odometry")
    for _ in range(2):
        world.step(clock, count=5)
        world.call("/gazelle/reset", "std_srvs/Empty")
        assert world.sim.time == 0.0
    world.step(odom)
    world.until(lambda: odom[-1].header.stamp.to_sec() == pytest.approx(1.1))
    times = [message.clock.to_nsec() for message in clock]
    assert times == sorted(times)
    world.step()
    answer = world.call("/gazelle/step", "gazelle_msgs/Step", steps=1)
    assert answer.time.to_sec() == pytest.approx(1.2)


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("publish_rate", -1, "must be a rate"),
        ("publish_rate", "fast", "must be a rate"),
        ("slashed_frames", "perhaps", "true or false"),
        ("cmd_pose_type", "Pose2d", "did you mean 'Pose2D'"),
    ],
)
def test_what_a_parameter_cannot_be_is_refused(stage, name, value, said):
    with pytest.raises(RosError, match=f"/stageros/{name} must be .*{said}|{said}"):
        stage(ROBOT, {name: value})


@pytest.mark.parametrize(
    ("name", "value"), [("base_watchdog_timeout", "soon"), ("is_depth_canonical", "maybe")]
)
def test_stage_ros_own_parameters_fall_back_as_there(stage, name, value):
    with pytest.warns(SimulationWarning, match=f"/stageros/{name} must be"):
        stage(ROBOT, {name: value})


def test_a_slip_in_a_name_is_told(stage):
    with pytest.warns(SimulationWarning, match="did you mean 'base_watchdog_timeout'"):
        stage(ROBOT, {"base_watchdog_timout": 3.0, "something_else": 1})
