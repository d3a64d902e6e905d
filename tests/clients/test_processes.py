"""Simulators, nodes and launch files as processes that end with their owner."""

import math
import time
from pathlib import Path

import pytest
from processes import is_running
from ros.graph import until

from gazelle.clients import (
    ClientError,
    Driver,
    Gazebo,
    PerformanceWatch,
    Processes,
    SimulatorProcess,
    load_parameters,
    read_urdf,
    spawn_robot,
)
from gazelle_ros import Master, Node

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def master(monkeypatch):
    with Master(port=0, rosout=False) as running:
        monkeypatch.setenv("ROS_MASTER_URI", running.uri)
        yield running


@pytest.mark.long
def test_a_simulator_is_there_when_made_and_gone_when_closed(master):
    with SimulatorProcess("turtlebot3_stage_1", robots=["turtlebot3_burger"]) as simulator:
        assert "turtlebot3_burger" in simulator.gazebo.models
        watch = PerformanceWatch(simulator.gazebo.node, (simulator.pid,), rate=10.0)
        until(lambda: any(each.real_time_factor > 0.0 for each in watch.samples[4:]))
        watch.close()
        pid = simulator.pid
    assert not is_running(pid)
    summary = watch.summary()
    assert summary["memory"]["mean"] > 20.0
    assert summary["real_time_factor"]["most"] > 0.0


@pytest.mark.long
def test_a_simulator_is_not_taken_for_another(master):
    with SimulatorProcess(), pytest.raises(ClientError, match="running on this graph: /gazebo"):
        SimulatorProcess()


@pytest.mark.long
def test_clients_outlive_their_simulator_and_find_the_next(master, monkeypatch):
    with Gazebo(master_uri=master.uri) as gazebo:
        with SimulatorProcess("turtlebot3_stage_1", robots=["turtlebot3_burger"]):
            table = gazebo.watch_models().wait()
            assert "turtlebot3_burger" in gazebo.models
        with monkeypatch.context() as quick:
            quick.setattr(gazebo._caller, "timeout", 0.5)
            with pytest.raises(ClientError, match=r"get_world_properties"):
                gazebo.models  # noqa: B018  # it asks the simulator
        with SimulatorProcess("empty", paused=False):
            gazebo.wait_for_model("ground_plane")
            until(lambda: set(table) == {"ground_plane"})
            gazebo.pause()
        table.close()


@pytest.mark.long
def test_a_model_with_the_example_plugin_is_driven(master):
    world = EXAMPLES.parent / "tests" / "clients" / "driven.world"
    options = ["--plugins", str(EXAMPLES)]
    with (
        SimulatorProcess(world, options=options) as simulator,
        Driver(simulator.gazebo.node, "puck", linear=0.5, angular=1.0).wait() as driver,
    ):
        for move, moved in (
            (driver.forward, lambda: driver.state.position[0] > 0.1),
            (driver.back, lambda: driver.state.position[0] < 0.05),
            (driver.left, lambda: driver.state.yaw > 0.2),
            (driver.right, lambda: driver.state.yaw < 0.1),
        ):
            until(lambda move=move, moved=moved: move() or moved())
        driver.stop()
        assert math.isnan(driver.state.linear[0])  # a pose says nothing of it
        until(lambda: simulator.gazebo.model_state("puck").linear == pytest.approx((0.0, 0.0, 0.0)))


@pytest.mark.long
def test_everything_on_a_graph_is_ended_the_master_too():
    with Master(port=0) as master, Processes(master.uri) as processes:
        processes.start_node(
            "tf", "static_transform_publisher", name="pole", arguments="0 0 1 0 0 0 a b 100"
        )
        until(lambda: "/pole" in processes.nodes())
        assert processes.kill("/nobody") == ["/nobody"]
        assert processes.kill_all() == []
        until(lambda: "/pole" not in processes.nodes())
        processes.kill_master()
        assert master.ended.wait(60.0)


@pytest.mark.long
def test_a_simulator_that_cannot_begin_says_why(master):
    with pytest.raises(ClientError, match="no_such_world"):
        SimulatorProcess("no_such_world")


def test_what_was_seen_is_saved_and_drawn(master, tmp_path):
    with Node("watcher", master_uri=master.uri) as node, PerformanceWatch(node, rate=50.0) as watch:
        until(lambda: len(watch.samples) >= 3)
    for name in ("run.csv", "run.json"):
        watch.save(tmp_path / name)
        assert "real_time_factor" in (tmp_path / name).read_text(encoding="utf-8")
    assert watch.report().splitlines()[1].startswith("real-time factor")
    watch.plot(tmp_path / "run.png")
    assert (tmp_path / "run.png").read_bytes().startswith(b"\x89PNG")
    with pytest.raises(ClientError, match="csv or"):
        watch.save(tmp_path / "run.txt")


@pytest.mark.long
def test_a_node_is_started_listed_and_ended(master):
    with Processes(master.uri) as processes:
        name = processes.start_node(
            "tf",
            "static_transform_publisher",
            name="pole",
            namespace="/camp",
            arguments="0 0 1 0 0 0 world pole 100",
            parameters={"colour": "red"},
        )
        assert name == "/camp/pole"
        until(lambda: name in processes.nodes())
        assert processes.running == [name]
        with Node("asker", master_uri=master.uri) as node:
            assert node.get_param("/camp/pole/colour") == "red"
            # Then it has begun, and takes itself off the master when it is ended.
            until(lambda: "/tf" in dict(node.master.published_topics()))
        processes.stop(name)
        until(lambda: name not in processes.nodes())
        with pytest.raises(ClientError, match="no running process is called"):
            processes.stop(name)


@pytest.mark.long
def test_launch_files_run_with_their_arguments(master):
    with Processes(master.uri) as processes:
        processes.start_launch(
            "turtlebot3_empty_world.launch",
            package="turtlebot3_gazebo",
            arguments={"x_pos": 1.0, "gui": False},
        )
        with Gazebo(master_uri=master.uri) as gazebo:
            gazebo.wait_for_model("turtlebot3_burger", timeout=60.0)
            place = gazebo.model_state("turtlebot3_burger").position
            assert place[0] == pytest.approx(1.0, abs=0.02)
    with Node("asker", master_uri=master.uri) as node:
        until(lambda: not any("/gazebo" in services for services in node.master.system_state()[2]))


@pytest.mark.long
def test_a_robot_is_put_there_with_all_that_goes_with_it(master):
    with SimulatorProcess() as simulator, Processes(master.uri) as processes:
        spawn_robot(
            simulator.gazebo,
            processes,
            "burger",
            "urdf/turtlebot3_burger.urdf.xacro",
            package="turtlebot3_description",
        )
        assert "burger" in simulator.gazebo.models
        until(lambda: "/robot_state_publisher" in processes.nodes())
        with Driver(
            simulator.gazebo.node, command_topic="/cmd_vel", pose_topic="/odom"
        ).wait() as driver:
            deadline = time.monotonic() + 60.0
            driver.forward()
            while driver.state.position[0] < 0.1 and time.monotonic() < deadline:
                driver.forward()
                time.sleep(0.05)
            assert driver.state.position[0] >= 0.1


def test_parameters_are_loaded_from_a_file_into_a_namespace(master, tmp_path):
    file = tmp_path / "gains.yaml"
    file.write_text("pid: {p: 1.5, d: 0.1}\nname: arm\n", encoding="utf-8")
    with Node("loader", master_uri=master.uri) as node:
        load_parameters(node, file, namespace="/arm")
        assert node.get_param("/arm/pid/p") == 1.5
        assert node.get_param("/arm/name") == "arm"
        file.write_text("- 1\n", encoding="utf-8")
        with pytest.raises(ClientError, match="names with values"):
            load_parameters(node, file)


def test_xacro_takes_its_arguments(tmp_path):
    file = tmp_path / "r.urdf.xacro"
    file.write_text(
        '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro"><xacro:arg name="n" default="a"/>'
        '<link name="$(arg n)"/></robot>',
        encoding="utf-8",
    )
    assert '"a"' in read_urdf(file)
    assert '"b"' in read_urdf(file, xacro_args={"n": "b"})
