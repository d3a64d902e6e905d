"""The nodes from rosbridge_server's launch file, and ``gazelle bridge``."""

from __future__ import annotations

import re
import signal

import pytest
from ports import free_port
from ros.graph import started, until
from ros.rosbridge.conftest import JsonClient

from gazelle_ros.master.proxy import MasterProxy

# Arguments and nodes as rosbridge_server's file of that name has them, in a file of one's own.
LAUNCH = """<launch>
  <arg name="port" default="9090"/>
  <arg name="address" default="127.0.0.1"/>
  <include file="$(find rosbridge_server)/launch/rosbridge_websocket.launch">
    <arg name="port" value="$(arg port)"/>
    <arg name="address" value="$(arg address)"/>
    <arg name="topics_glob" value="[/open*]"/>
  </include>
</launch>
"""


@pytest.fixture
def start(tmp_path):
    with started(["-m", "gazelle_ros"], tmp_path) as run:
        yield run


@pytest.mark.long
def test_the_launch_file_runs(start, tmp_path):
    (tmp_path / "bridge.launch").write_text(LAUNCH)
    port = free_port()
    uri = f"http://127.0.0.1:{port}"
    start("launch", "bridge.launch", "port:=0", ROS_MASTER_URI=uri)
    master = MasterProxy(uri, "/test")
    names = []

    def ready():
        try:
            names[:] = master.param_names()
            services = master.system_state()[2]
        except Exception:  # noqa: BLE001  # it is not there yet
            return False
        return "/rosbridge_websocket/actual_port" in names and "/rosapi/get_time" in services

    until(ready)
    client = JsonClient(master.get_param("/rosbridge_websocket/actual_port"))
    assert client.call("/rosapi/topics")["values"]["topics"] == []  # topics_glob hides them
    assert "topics_glob" in client.ask("subscribe", topic="/rosout")["msg"]
    client.socket.close()
    master.close()


def test_gazelle_bridge(start, graph):
    process = start("bridge", "--port", 0, ROS_MASTER_URI=graph.uri)
    line = process.stdout.readline()
    port = int(re.search(r"ws://127\.0\.0\.1:(\d+)", line).group(1))
    client = JsonClient(port)
    assert "/rosapi/nodes" in client.call("/rosapi/services")["values"]["services"]
    client.socket.close()
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert process.returncode == 0
