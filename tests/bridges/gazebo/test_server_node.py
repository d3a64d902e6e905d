"""The node gzserver of gazebo_ros, with the flags that launch files give it."""

from __future__ import annotations

import contextlib
import logging
import signal
import subprocess
import sys
import threading
import time
import warnings

import pytest
from graph_client import Client
from ports import free_port
from ros.graph import until

import gazelle
from gazelle.bridges import refuse_twin, serve_ros
from gazelle.bridges.gazebo.server import find_world
from gazelle.bridges.gazebo.server import main as serve
from gazelle.errors import ResolveError, RosError, SimulationWarning
from gazelle_ros import Master, Node, load_message
from gazelle_ros.master.proxy import MasterProxy

WORLD = """<sdf version="1.6"><world name="w"><model name="here"><static>true</static>
<link name="l"/></model></world></sdf>"""
EVERY_FLAG = (
    "-u -r --record_resources --record_path /nowhere --record_encoding txt --record_period 1 "
    "--record_filter * --verbose --lockstep --minimal_comms -q -e ode -s libgazebo_ros_api.so "
    "-g libsomething.so -o profile --seed 5"
)


@pytest.fixture
def master(monkeypatch):
    with Master(port=0, rosout=False) as running:
        monkeypatch.setenv("ROS_MASTER_URI", running.uri)
        yield running


@pytest.fixture
def world(tmp_path):
    file = tmp_path / "worlds" / "mine.world"
    file.parent.mkdir()
    file.write_text(WORLD, encoding="utf-8")
    return file


@pytest.mark.long
def test_it_runs_a_world_with_all_flags_until_ctrl_c(master, world):
    program = [sys.executable, "-m", "gazelle_ros.builtin.start", "gazebo_ros", "gzserver"]
    process = subprocess.Popen([*program, *EVERY_FLAG.split(), str(world), "__name:=gazebo"])
    client = Client(master.uri)
    try:
        for name in ("get_physics_properties", "get_world_properties", "unpause_physics"):
            client.node.wait_for_service(f"/gazebo/{name}", timeout=60.0)  # advertised one by one
        assert client.call("get_physics_properties", "GetPhysicsProperties").pause
        properties = client.call("get_world_properties", "GetWorldProperties")
        assert (properties.model_names, properties.sim_time) == (["here"], 0.0)
        client.call("unpause_physics", "std_srvs/Empty")
        until(lambda: client.call("get_world_properties", "GetWorldProperties").sim_time > 0.0)
    finally:
        process.send_signal(signal.SIGINT)
        assert process.wait(60) == 0
        client.node.close()


def test_it_ends_by_itself_after_so_many_steps(master, world):
    assert serve(["--iters", "20", str(world)]) == 0


def test_a_flag_for_what_is_not_here_is_one_line(master, world):
    flags = "-r --record_path /nowhere --play log -e bullet --initial_sim_time 3 --verbose"
    with pytest.warns(SimulationWarning) as caught:
        assert serve([*flags.split(), "--iters", "1", str(world)]) == 0
    assert [str(each.message).partition(":")[0] for each in caught] == [
        "the simulator writes no log",
        "logs of Gazebo are not played",
        "time begins at zero",
        "there is no physics 'bullet'",
    ]


def test_worlds_are_found_below_gazebos_resource_path(world, monkeypatch):
    monkeypatch.setenv("GAZEBO_RESOURCE_PATH", f"/nowhere:{world.parents[1]}")
    assert find_world("worlds/mine.world") == str(world)


def test_bundled_worlds_are_found_and_others_named(world, monkeypatch):
    monkeypatch.delenv("GAZEBO_RESOURCE_PATH", raising=False)
    assert find_world("worlds/empty.world").endswith("worlds/empty.world")
    assert find_world("turtlebot3_world") == "turtlebot3_world"
    with pytest.raises(ResolveError, match=r"worlds/none\.world"):
        find_world("worlds/none.world")
    for name, hint in {
        f"{world.parent}/Mine.world": "did you mean 'mine.world'?",
        f"{world.parent}/none/a.world": f"there is no folder {world.parent}/none",
        "worlds/TurtleBot3_camera.world": "did you mean 'worlds/turtlebot3_camera.world'?",
    }.items():
        with pytest.raises(ResolveError) as caught:
            find_world(name)
        assert caught.value.hint == hint


def test_a_flag_that_gzserver_does_not_have_is_refused(master, world):
    with pytest.raises(SystemExit) as caught:
        serve(["--no-such-flag", str(world)])
    assert caught.value.code == 2


def test_a_second_simulator_is_refused_and_the_first_stays(master, world):
    with Node("gazebo", master_uri=master.uri) as first:
        first.advertise("/clock", load_message("rosgraph_msgs/Clock"))
        with pytest.raises(RosError, match="a simulator is already running on this graph: /gazebo"):
            serve([str(world)])
        assert not first.closed
        refuse_twin("/other/gazebo")


def test_what_does_not_answer_any_more_is_no_obstacle(master):
    refuse_twin("gazebo")
    dead = "http://127.0.0.1:9"
    with contextlib.closing(MasterProxy(master.uri, "/gazebo")) as proxy:
        proxy.call("registerPublisher", "/clock", "rosgraph_msgs/Clock", dead)
    refuse_twin("gazebo")
    refuse_twin("gazebo", dead)


@pytest.mark.long
def test_what_is_not_supported_is_a_line_and_no_more(master, world):
    text = WORLD.replace("<link", "<plugin name='p' filename='libno_such.so'/><link")
    world.write_text(text, encoding="utf-8")
    program = [sys.executable, "-m", "gazelle_ros.builtin.start", "gazebo_ros", "gzserver"]
    done = subprocess.run(
        [*program, "--iters", "1", str(world)],
        capture_output=True, text=True, timeout=60, check=True,
    )  # fmt: skip
    (line,) = done.stderr.strip().splitlines()
    assert line.startswith("[WARN]")
    assert "libno_such.so" in line


def test_who_makes_the_time_does_not_listen_to_its_own_clock():
    with Master(port=0) as master, gazelle.Simulation("empty") as sim:
        master.api.parameters.set("/use_sim_time", True)  # as launch files do, before it starts
        with serve_ros(sim, master.uri) as server:
            _, subscribers, _ = server.node.master.system_state()
            assert "/clock" not in subscribers


ODD = WORLD.replace("</world>", '<plugin name="odd" filename="libnobody_has_this.so"/></world>')


def heard_of(master, node):
    """Return a node that subscribes to another, and the list of its messages."""
    heard = []
    listener = Node("listener", master_uri=master.uri)
    listener.subscribe("/rosout", load_message("rosgraph_msgs/Log"), heard.append, None)
    return listener, lambda: [each for each in heard if each.name == node]


@pytest.mark.long
def test_what_the_world_warns_of_is_on_rosout(master, world):
    world.write_text(ODD, encoding="utf-8")
    program = [sys.executable, "-m", "gazelle_ros.builtin.start", "gazebo_ros", "gzserver"]
    listener, said = heard_of(master, "/gazebo")
    flags = ["--play", "a.log", str(world), "__name:=gazebo"]
    with subprocess.Popen([*program, *flags], stderr=subprocess.PIPE, text=True) as process:
        try:
            until(lambda: len(said()) >= 2)
            assert "/rosout" in listener.master.system_state()[0]
        finally:
            process.send_signal(signal.SIGINT)
            shown = process.stderr.read()
            listener.close()
    texts = [each.msg for each in said()]
    assert any("libnobody_has_this.so" in text for text in texts)
    assert any("logs of Gazebo are not played" in text for text in texts)
    assert all(text in shown for text in texts), "they are shown as before"
    assert {each.level for each in said()} == {4}
    assert all("/rosout" in each.topics for each in said())


def test_what_a_running_simulation_warns_of_is_on_rosout(master):
    listener, said = heard_of(master, "/gazebo")
    before = warnings.showwarning
    with gazelle.Simulation("empty") as sim, serve_ros(sim, master.uri):
        assert "/gazebo" in listener.master.system_state()[0]["/rosout"]
        with warnings.catch_warnings():
            warnings.simplefilter("always")
            warnings.warn("something odd", SimulationWarning, stacklevel=1)
            warnings.warn("of no concern to ROS", UserWarning, stacklevel=1)
        logging.getLogger("gazelle.plugins").error("something %s", "bad")
        until(lambda: len(said()) >= 2)
    assert [(each.level, each.msg) for each in said()] == [
        (4, "something odd"),
        (8, "something bad"),
    ]
    assert said()[0].file == "test_server_node.py"
    assert warnings.showwarning == before
    listener.close()


def test_a_new_master_learns_that_time_is_simulated(monkeypatch):
    port = free_port()
    with Master(port=port, rosout=False) as first:
        uri = first.uri
        sim = gazelle.Simulation("empty")
        server = serve_ros(sim, uri)
    with sim, server, Master(port=port, rosout=False):
        proxy = MasterProxy(uri, "/test")
        until(lambda: "/clock" in proxy.system_state()[0])
        until(lambda: proxy.has_param("/use_sim_time"))
        assert proxy.get_param("/use_sim_time") is True
        proxy.close()


def test_it_waits_for_a_master(world, monkeypatch):
    port = free_port()
    monkeypatch.setenv("ROS_MASTER_URI", f"http://127.0.0.1:{port}")
    done = []
    thread = threading.Thread(target=lambda: done.append(serve(["--iters", "5", str(world)])))
    thread.start()
    time.sleep(0.3)
    assert thread.is_alive()
    with Master(port=port, rosout=False):
        thread.join(60)
    assert done == [0]
