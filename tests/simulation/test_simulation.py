"""Promises of a running simulation."""

import threading

import numpy as np
import pytest
import scenes

from gazelle.description import Pose
from gazelle.errors import PluginWarning, SimulationError
from gazelle.simulation import Simulation


def burger_world(**options):
    return Simulation(scenes.world(scenes.ground(), *scenes.square()), **options)


def test_time_is_whole_nanoseconds_and_runs_hit_them_exactly():
    with Simulation(scenes.world(scenes.box(), step=0.001)) as sim:
        for _ in range(10):
            sim.run(0.1)
        assert sim.clock.now_ns == 1_000_000_000
        sim.step(3)
        assert sim.time == pytest.approx(1.003, abs=1e-12)


def test_spawn_from_a_description_gives_a_robot_at_its_pose():
    with burger_world() as sim:
        robot = sim.spawn(scenes.burger(), name="r1", pose=Pose(x=1.0, yaw=1.0))
        assert robot.pose.is_close(Pose(x=1.0, yaw=1.0))
        assert set(robot.joints) == {"wheel_left_joint", "wheel_right_joint"}
        assert set(robot.sensors) == {"lds", "imu"}
        assert robot.links["wheel_left_link"].pose.z == pytest.approx(0.033)
        sim.run(0.5)
        sim.delete("r1")
        assert "r1" not in sim.robots
        sim.run(0.1)


def test_a_taken_name_is_refused_and_nothing_changes():
    with burger_world() as sim:
        sim.spawn(scenes.burger())
        before = sim.snapshot()
        with pytest.raises(SimulationError, match="there is a model 'burger' already"):
            sim.spawn(scenes.burger())
        assert sim.snapshot() == before


def test_a_plugin_whose_file_is_wrong_is_left_out():
    with burger_world() as sim:
        with pytest.warns(PluginWarning, match="did you mean 'wheel_left_joint'"):
            robot = sim.spawn(scenes.burger(leftJoint="wheel_lefft_joint"))
        assert not robot.inputs
        assert not robot.outputs
        sim.run(seconds=0.1)


def test_where_plugin_warnings_are_errors_a_wrong_plugin_leaves_no_model_behind():
    with burger_world() as sim:
        with pytest.raises(PluginWarning, match="did you mean 'wheel_left_joint'"):
            sim.spawn(scenes.burger(leftJoint="wheel_lefft_joint"))
        assert "burger" not in sim.robots
        assert not any(name.startswith("burger") for name in sim.engine.links.names)
        sim.spawn(scenes.burger())


def test_misses_say_what_there_is():
    with burger_world() as sim:
        robot = sim.spawn(scenes.burger())
        with pytest.raises(SimulationError, match="did you mean 'lds'"):
            robot.sensors["ldss"]
        with pytest.raises(SimulationError, match="did you mean 'burger'"):
            sim.delete("burgr")


def test_reset_gives_the_same_run_again_bit_for_bit():
    with burger_world() as sim:
        robot = sim.spawn(scenes.burger(stddev=0.01), pose=Pose(y=0.3))

        def run():
            robot.inputs["cmd_vel"].send(linear=0.2, angular=0.7)
            seen = []
            for _ in range(10):
                sim.run(0.2)
                seen.append(robot.sensors["lds"].latest()[0])
            return np.array(seen), sim.snapshot()

        first = run()
        sim.reset()
        assert sim.time == 0.0
        np.testing.assert_array_equal(robot.position[0], [0.0, 0.3, 0.0])
        second = run()
        np.testing.assert_array_equal(first[0], second[0])


def test_some_worlds_can_be_reset():
    with burger_world(nworld=4) as sim:
        robot = sim.spawn(scenes.burger())
        robot.inputs["cmd_vel"].send(linear=0.2)
        sim.run(1.0)
        sim.reset(np.array([False, True, False, True]))
        x = robot.position[:, 0]
        assert x[0] == x[2] > 0.1
        assert x[1] == x[3] == 0.0
        sim.run(0.5)
        assert abs(robot.position[1, 0]) < 0.005  # its command was forgotten
        with pytest.raises(SimulationError, match="worlds must be in 0 to 3"):
            sim.reset([4])


def test_a_snapshot_restores_the_exact_future_with_noise_and_odometry():
    with burger_world(nworld=2) as sim:
        robot = sim.spawn(scenes.burger(stddev=0.01, odometrySource="encoder"))
        robot.inputs["cmd_vel"].send(linear=np.array([0.1, 0.2]), angular=0.5)
        robot.sensors["lds"].latest()
        sim.run(0.77)
        saved = sim.snapshot()

        def future():
            sim.run(1.0)
            odometry = robot.outputs["odom"].last
            return robot.sensors["lds"].latest(), odometry.position, robot.position

        first = future()
        robot.inputs["cmd_vel"].send(0.0)
        sim.run(0.3)
        sim.restore(saved)
        for a, b in zip(first, future(), strict=True):
            np.testing.assert_array_equal(a, b)


def test_a_snapshot_of_something_else_is_refused():
    with burger_world() as sim:
        saved = sim.snapshot()
        sim.spawn(scenes.burger())
        with pytest.raises(SimulationError, match="other models"):
            sim.restore(saved)
        with pytest.raises(SimulationError, match="not a snapshot"):
            sim.restore(b"nonsense")


def test_a_sensor_measures_at_its_rate_while_somebody_listens():
    with burger_world() as sim:
        robot = sim.spawn(scenes.burger())
        stamps = []
        end = robot.sensors["lds"].subscribe(lambda unit: stamps.append(sim.clock.now_ns))
        sim.run(1.0)
        assert stamps == [200_000_000 * k for k in range(1, 6)]
        end()
        sim.run(1.0)
        assert len(stamps) == 5


def test_read_gives_the_scan_of_one_world_with_its_stamp():
    with burger_world() as sim:
        robot = sim.spawn(scenes.burger(samples=24))
        scan = robot.sensors["lds"].read()
        assert scan.ranges.shape == (24,)
        assert scan.ranges[0] == pytest.approx(1.85 + 0.032, abs=1e-6)
        assert scan.angle_increment == pytest.approx(6.28319 / 23)
        sim.run(0.45)
        assert robot.sensors["lds"].read().stamp == 400_000_000


@pytest.mark.long
def test_requests_of_other_threads_are_done_between_steps():
    with burger_world() as sim:
        robot = sim.spawn(scenes.burger())
        failures = []

        def meddle(name):
            try:
                for k in range(10):
                    sim.spawn(
                        scenes.ball(pose=Pose(x=1.0, y=0.2 * name, z=0.5)), name=f"{name}_{k}"
                    )
                    robot.set_pose((0.1 * name, 0.0, 0.0))
                    sim.delete(f"{name}_{k}")
            except Exception as error:  # noqa: BLE001  the main thread reports it
                failures.append(error)

        threads = [threading.Thread(target=meddle, args=(n,)) for n in range(3)]
        for thread in threads:
            thread.start()
        while any(thread.is_alive() for thread in threads):
            sim.step(20)
        assert failures == []
        assert set(sim.robots) == {"ground_plane", "north", "south", "east", "west", "burger"}


def test_pausing_refuses_run_but_not_step():
    with burger_world() as sim:
        sim.pause()
        with pytest.raises(SimulationError, match="paused"):
            sim.run(0.1)
        sim.step(5)
        sim.unpause()
        sim.run(0.1)


def test_a_closed_simulation_says_so():
    sim = burger_world()
    sim.close()
    sim.close()
    with pytest.raises(SimulationError, match="closed"):
        sim.step()


def test_a_run_can_keep_to_a_real_time_factor():
    import time

    with burger_world() as sim:
        start = time.monotonic()
        sim.run(0.4, rate=2.0)
        assert time.monotonic() - start > 0.18
