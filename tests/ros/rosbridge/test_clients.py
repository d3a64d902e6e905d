"""The clients that people use: roslibpy, and roslib from npm where node is at hand."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest
import roslibpy
from ros.graph import until

from gazelle_ros import load_message, load_service

JAVASCRIPT = """
import * as roslib from 'roslib';
const ROSLIB = roslib.Ros ? roslib : roslib.default;  // 2, or 1
const ros = new ROSLIB.Ros({ url: process.argv[2] });
const fail = (error) => { console.error(error); process.exit(1); };
ros.on('error', fail);
ros.on('connection', () => {
  const out = new ROSLIB.Topic({ ros, name: '/js_out', messageType: 'sensor_msgs/LaserScan' });
  const back = new ROSLIB.Topic({
    ros, name: '/js_back', messageType: 'sensor_msgs/LaserScan', compression: 'cbor',
  });
  const add = new ROSLIB.Service({
    ros, name: '/js_add', serviceType: 'roscpp_tutorials/TwoInts',
  });
  back.subscribe((scan) => {
    if (!(scan.ranges instanceof Float32Array)) fail('no typed array: ' + scan.ranges);
    ros.getTopics((found) => {
      if (!found.topics.includes('/js_back')) fail('rosapi does not know of it');
      add.callService({ a: 20, b: 22 }, (answer) => {
        if (Number(answer.sum) !== 42) fail('the sum is ' + answer.sum);
        new ROSLIB.Param({ ros, name: '/js_param' }).set({ deep: [1, 'x'] }, () => {
          console.log('done'); ros.close(); process.exit(0);
        });
      }, fail);
    }, fail);
  });
  out.publish({ header: { frame_id: 'js' }, ranges: [1.5, 2.5] });
});
setTimeout(() => fail('nothing came'), 50000);
"""


@pytest.fixture
def ros(bridge):
    client = roslibpy.Ros("127.0.0.1", bridge.port, transport="asyncio")
    client.run(timeout=60)
    yield client
    client.close()


def test_roslibpy_publishes_and_subscribes(ros, robot):
    got, heard = [], []
    robot.subscribe("/py_out", load_message("geometry_msgs/Twist"), got.append)
    publisher = robot.advertise("/py_in", load_message("std_msgs/String"), latch=True)
    publisher.publish(publisher.message_class("hello"))
    topic = roslibpy.Topic(ros, "/py_out", "geometry_msgs/Twist")
    topic.publish(roslibpy.Message({"linear": {"x": 0.5}, "angular": {"z": -1}}))
    listener = roslibpy.Topic(ros, "/py_in", "std_msgs/String", throttle_rate=10, queue_length=1)
    listener.subscribe(heard.append)
    until(lambda: got and heard)
    assert (got[0].linear.x, got[0].angular.z) == (0.5, -1.0)
    assert heard[0]["data"] == "hello"
    listener.unsubscribe()
    topic.unadvertise()


def test_roslibpy_calls_and_answers_services(ros, robot):
    robot.serve("/py_add", load_service("roscpp_tutorials/TwoInts"), lambda r: [r.a + r.b])
    service = roslibpy.Service(ros, "/py_add", "roscpp_tutorials/TwoInts")
    assert service.call(roslibpy.ServiceRequest({"a": 2, "b": 3}), timeout=60)["sum"] == 5
    with pytest.raises(roslibpy.core.ServiceException, match="no service"):
        roslibpy.Service(ros, "/none", "std_srvs/Empty").call({}, timeout=60)

    own = roslibpy.Service(ros, "/py_own", "std_srvs/SetBool")

    def answer(request, response):
        response["success"], response["message"] = request["data"], "done"
        return True

    own.advertise(answer)
    robot.wait_for_service("/py_own", 60)
    kind = load_service("std_srvs/SetBool")
    found = robot.client("/py_own", kind).call(kind._request_class(True))
    assert (found.success, found.message) == (True, "done")
    own.unadvertise()


def test_roslibpy_asks_rosapi(ros, robot):
    robot.advertise("/py_known", load_message("std_msgs/String"))
    assert "/py_known" in ros.get_topics()
    assert ros.get_topic_type("/py_known") == "std_msgs/String"
    assert "/robot" in ros.get_nodes()
    ros.set_param("/py_param", {"a": [1, 2]})
    assert ros.get_param("/py_param") == {"a": [1, 2]}
    assert ros.get_time()["secs"] > 0
    details = ros.get_message_details("geometry_msgs/Twist")
    assert details["typedefs"][0]["fieldnames"] == ["linear", "angular"]


@pytest.mark.slow
def test_roslib_from_npm(bridge, robot, tmp_path):
    """GAZELLE_ROSLIB names a folder in which ``npm install roslib`` has run."""
    folder = os.environ.get("GAZELLE_ROSLIB")
    node = shutil.which("node")
    if not folder or node is None or not (Path(folder) / "node_modules/roslib").is_dir():
        pytest.skip("roslib from npm is not installed (GAZELLE_ROSLIB)")
    kind = load_message("sensor_msgs/LaserScan")
    back = robot.advertise("/js_back", kind, latch=True)
    robot.subscribe("/js_out", kind, back.publish)
    robot.serve("/js_add", load_service("roscpp_tutorials/TwoInts"), lambda r: [r.a + r.b])
    (tmp_path / "node_modules").symlink_to(Path(folder) / "node_modules")
    script = tmp_path / "client.mjs"
    script.write_text(JAVASCRIPT)
    url = f"ws://127.0.0.1:{bridge.port}"
    done = subprocess.run(
        [node, script, url], check=False, capture_output=True, text=True, timeout=90
    )
    assert (done.returncode, done.stdout.strip()) == (0, "done"), done.stderr
    assert robot.get_param("/js_param") == {"deep": [1, "x"]}
