"""The node ``stageros`` as launch files start it."""

import os
import signal
import subprocess
import sys
import time
from types import SimpleNamespace

import pytest
from ports import free_port
from stage_samples import write

from gazelle_ros import Master, Node, WallClock, load_message
from gazelle_ros.builtin import registry

START = "import sys; from gazelle.stage.bridge.server import main; sys.exit(main(sys.argv[1:]))"
TWO = 'position ( name "a" ) position ( name "b" pose [0 3 0 0] )\nspeedup 20\n'


@pytest.fixture
def master():
    with Master(port=0, rosout=False) as running:
        yield running


def start(master, *arguments):
    return subprocess.Popen(
        [sys.executable, "-c", START, *arguments],
        env=os.environ | {"ROS_MASTER_URI": master.uri},
        stderr=subprocess.PIPE,
        text=True,
    )


@pytest.mark.long
def test_it_runs_with_stageros_arguments_until_it_is_told_to_end(master, tmp_path):
    world = write(tmp_path, TWO)
    process = start(master, "-g", "-u", str(world), "__name:=sim", "_base_watchdog_timeout:=0.0")
    node = Node("client", master_uri=master.uri, clock=WallClock())
    try:
        heard = []
        node.subscribe("/b/odom", load_message("nav_msgs/Odometry"), heard.append)
        end = time.monotonic() + 60.0
        while not heard:
            assert time.monotonic() < end, "nothing was heard"
            assert process.poll() is None, process.stderr.read()
            time.sleep(0.02)
        assert heard[0].pose.pose.position.y == 3.0
        assert node.master.lookup_node("/sim")
        assert node.get_param("/sim/base_watchdog_timeout") == 0.0
        process.send_signal(signal.SIGINT)
        assert process.wait(60) == 0
    finally:
        node.close()
        process.kill()
        process.stderr.close()


@pytest.mark.long
def test_it_ends_at_the_files_quit_time(master, tmp_path):
    process = start(master, str(write(tmp_path, "quit_time 2 " + TWO)))
    with process.stderr:
        assert process.wait(60) == 0


def test_launch_files_find_it():
    assert registry.main_of("stage_ros", "stageros").__module__ == "gazelle.stage.bridge.server"


@pytest.mark.long
def test_it_waits_for_a_master_and_ends_while_it_waits(tmp_path):
    port = free_port()
    master = SimpleNamespace(uri=f"http://127.0.0.1:{port}/")
    world = str(write(tmp_path, "quit_time 1 " + TWO))
    process, waiting = start(master, world), start(master, world, "__name:=other")
    with process.stderr, waiting.stderr:
        assert "waiting for it" in process.stderr.readline()
        assert "waiting for it" in waiting.stderr.readline()
        waiting.terminate()
        waiting.wait(60)
        assert process.poll() is None
        with Master(port=port, rosout=False):
            assert process.wait(60) == 0


@pytest.mark.long
def test_what_the_file_is_warned_of_is_on_rosout(master, tmp_path):
    odd = TWO.replace('name "b"', 'name "b" colour "red"')
    heard = []
    with Node("client", master_uri=master.uri, clock=WallClock()) as node:
        node.subscribe("/rosout", load_message("rosgraph_msgs/Log"), heard.append)
        process = start(master, str(write(tmp_path, "quit_time 20 " + odd)), "__name:=sim")
        with process.stderr:
            end = time.monotonic() + 60.0
            while not heard and time.monotonic() < end:
                time.sleep(0.02)
            process.kill()
            process.wait(60)
    assert (heard[0].name, heard[0].level) == ("/sim", 4)
    assert "colour" in heard[0].msg


@pytest.mark.long
def test_a_new_master_learns_that_time_is_simulated(tmp_path):
    port = free_port()
    with Master(port=port, rosout=False) as master:
        process = start(master, str(write(tmp_path, TWO)))
        with Node("client", master_uri=master.uri, clock=WallClock()) as node:
            end = time.monotonic() + 60.0
            while "/robot_1/odom" not in node.master.system_state()[0]:
                assert time.monotonic() < end
                time.sleep(0.02)
            time.sleep(0.5)
    with process.stderr, Master(port=port, rosout=False) as again:
        end = time.monotonic() + 60.0
        while not again.api.parameters.has("/use_sim_time"):
            assert time.monotonic() < end
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        assert process.wait(60) == 0
