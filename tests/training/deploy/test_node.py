"""`gazelle deploy` in a process of its own, over our master, with a robot that the test plays."""

from __future__ import annotations

import json
import os
import random
import signal
import sys
import time

import pytest
from fake_robot import Deployed, FakeRobot, wait_for

from gazelle_ros import Master, load_message

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")

STAND, AHEAD = (0.0, 0.0), (0.15, 0.0)


@pytest.fixture
def robot(master):
    made = FakeRobot(master.uri)
    yield made
    made.close()


@pytest.fixture
def deploy(master, tmp_path, straight_on):
    started = []

    def start(*arguments, policy=straight_on):
        started.append(Deployed(tmp_path, master.uri, policy, *arguments))
        return started[-1]

    yield start
    for each in started:
        each.close()


def drive(robot, deploy, *arguments):
    """Start it, and wait until it drives straight ahead to a goal."""
    deployed = deploy("--arm", "--goal", "5,0", *arguments)
    robot.alive(lambda: robot.last == AHEAD, "the first command")
    return deployed


@pytest.mark.long
def test_it_stands_until_it_is_armed_by_the_service(robot, deploy):
    deployed = deploy("--goal", "5,0")
    robot.alive(lambda: "disarmed" in robot.status, "the node")
    answers = []

    def armed():
        answers.append(robot.arm())
        return answers[-1].success

    robot.alive(armed, "its consent")
    assert answers[-1].message == "armed"
    robot.alive(lambda: robot.last == AHEAD, "a command")
    assert robot.twists[0] == AHEAD  # nothing came before
    assert robot.arm(False).success
    wait_for(lambda: robot.last == STAND, "zero")
    code, _, err = deployed.end(signal.SIGTERM)
    assert code == 1, err  # the goal was not reached
    assert "Traceback" not in err
    assert "Warning" not in err
    assert robot.last == STAND


@pytest.mark.long
def test_it_does_not_arm_without_sensors(robot, deploy):
    deploy()
    wait_for(lambda: "disarmed" in robot.status, "the node")
    answer = robot.arm()
    assert (answer.success, answer.message) == (False, "no scan yet")


@pytest.mark.long
@pytest.mark.parametrize("lost", ["scan", "odom"])
def test_cut_off_from_a_sensor_it_stops_within_half_a_second(robot, deploy, tmp_path, lost):
    log = tmp_path / "log.jsonl"
    drive(robot, deploy, "--log", log)
    cut = robot.time
    while robot.time < cut + 0.45:
        robot.go(0.05, **{lost: False})
    wait_for(lambda: robot.last == STAND, "zero, while time stands at 0.45 s after the cut")
    name = {"scan": "scan lost", "odom": "odometry lost"}[lost]

    def told(*names):
        """Return the log's place of it; the clock may have overtaken the other sensor."""
        events = map(json.loads, log.read_text().splitlines())
        begun = (e for e in events if e["event"] == "begin" and e["time"] > cut)
        return [e for e in begun if e["reason"] in names]

    wait_for(lambda: told(name), lambda: f"{name} after {cut} in the log: {log.read_text()}")
    robot.alive(lambda: robot.last == AHEAD, "it to go on when the sensor is back")
    first = told("scan lost", "odometry lost")[0]
    assert first["wanted"] == [0.15, 0.0]
    assert first["given"] == [0.0, 0.0]
    assert 0.4 <= told(name)[0]["time"] - cut <= 0.5


@pytest.mark.long
def test_readings_that_come_too_late_are_none(robot, deploy):
    drive(robot, deploy)
    robot.delay = 0.5
    robot.alive(lambda: robot.last == STAND, "zero")
    robot.delay = 0.1
    robot.alive(lambda: robot.last == AHEAD, "it to go on")


@pytest.mark.long
def test_an_obstacle_stops_it(robot, deploy):
    drive(robot, deploy)
    robot.ranges = [0.15] + [3.0] * 22 + [0.15]
    robot.time += 0.2
    robot.alive(lambda: robot.last == STAND, "zero")
    robot.ranges = [3.0] * 24
    robot.alive(lambda: robot.last == AHEAD, "it to go on")


@pytest.mark.long
def test_goals_by_topic_take_the_place_of_others(robot, deploy):
    deployed = deploy("--arm")
    robot.alive(lambda: "armed, no goal" in robot.status, "it to be armed")
    assert robot.twists == []
    robot.send_goal(3.0, 0.0)
    robot.alive(lambda: robot.last == AHEAD and robot.actions, "a command and what tells of it")
    action, score, reward = robot.actions[-1]
    assert (action, score, reward) == (2.0, 0.0, 0.0)
    robot.x = 2.9
    robot.time += 0.2
    robot.alive(lambda: robot.last == STAND and robot.results, "the end of the goal")
    assert robot.results == [[pytest.approx(0.0), pytest.approx(1.0)]]
    robot.send_goal(9.0, 0.0)
    robot.alive(lambda: robot.last == AHEAD, "the next")
    deployed.end(signal.SIGINT)
    assert robot.last == STAND


@pytest.mark.long
def test_a_goal_in_the_map_is_found_by_tf(robot, deploy):
    deploy("--arm")
    robot.alive(lambda: "armed, no goal" in robot.status, "it to be armed")
    robot.send_goal(1.0, 0.0, frame="map")
    robot.alive(lambda: any("no transform" in text for text in robot.status), "the complaint")
    tf = robot.advertise("/tf", "tf2_msgs/TFMessage")
    message = load_message("tf2_msgs/TFMessage")()
    stamped = load_message("geometry_msgs/TransformStamped")()
    stamped.header.frame_id, stamped.child_frame_id = "map", "odom"
    stamped.transform.rotation.w = 1.0
    stamped.transform.translation.x = -4.0  # so the goal is at 5 m in the odometry's frame
    message.transforms = [stamped]

    def drives():
        tf.publish(message)
        return robot.last == AHEAD

    robot.alive(drives, "it to drive")
    robot.x = 4.9
    robot.time += 0.2
    robot.alive(lambda: robot.results, "the end of the goal")


@pytest.mark.long
def test_goals_of_a_list_are_driven_to_and_reported(robot, deploy, tmp_path):
    goals = tmp_path / "goals.txt"
    goals.write_text("1, 0\n2, 0\n")
    deployed = deploy("--arm", "--goals", goals, "--goal", "0.5,0")
    for x in (0.5, 1.0, 2.0):
        before = len(robot.results)
        robot.alive(lambda: robot.last == AHEAD, "a command")
        robot.x = x
        robot.time += 0.2
        robot.alive(lambda n=before: len(robot.results) > n, "the end of the goal")
    code, out, err = deployed.wait()
    assert code == 0, err
    assert out.count("reached, ") == 3
    assert "reached 3 of 3" in out
    assert robot.last == STAND


@pytest.mark.long
def test_names_are_remapped(master, deploy):
    robot = FakeRobot(master.uri)
    heard = []
    robot.listen("/tb3/cmd", "geometry_msgs/Twist", lambda m: heard.append(m.linear.x))
    deploy("--arm", "--goal", "5,0", "cmd_vel:=/tb3/cmd", "__name:=driver")
    robot.alive(lambda: heard[-1:] == [0.15], "a command")
    assert robot.twists == []
    assert robot.arm(False, node="driver").success
    robot.close()


@pytest.mark.long
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL, signal.SIGHUP])
def test_the_last_twist_is_zero_however_it_is_ended(robot, deploy, number):
    deployed = drive(robot, deploy)
    deployed.end(number)
    wait_for(lambda: robot.last == STAND, "zero")


def kill_at_random(robot, deploy, chance):
    deployed = deploy("--arm", "--goal", "5,0")
    patience = chance.uniform(0.0, 3.0)
    deadline = time.monotonic() + patience
    while time.monotonic() < deadline:
        robot.go(0.02)
        time.sleep(0.01)
    if chance.random() < 0.5:
        robot.alive(lambda: robot.last == AHEAD, "a command")
    deployed.end(signal.SIGKILL)
    # The pipes ended, so the guard did, and it said all it had to say.
    if robot.twists:
        wait_for(lambda: robot.last == STAND, "zero")
    robot.twists.clear()


@pytest.mark.long
def test_killed_at_random_points_the_last_twist_is_zero(robot, deploy):
    chance = random.Random(4)
    for _ in range(5):
        kill_at_random(robot, deploy, chance)


@pytest.mark.slow
def test_killed_at_a_hundred_points_the_last_twist_is_zero(robot, deploy):
    chance = random.Random(5)
    for _ in range(100):
        kill_at_random(robot, deploy, chance)


@pytest.mark.long
def test_hanging_it_is_stopped_by_the_guard(robot, deploy):
    deployed = drive(robot, deploy)
    os.kill(deployed.pid, signal.SIGSTOP)
    try:
        wait_for(lambda: robot.last == STAND, "zero")
    finally:
        os.kill(deployed.pid, signal.SIGCONT)
    robot.alive(lambda: robot.last == AHEAD, "it to go on")


def guards_of(deployed):
    """Return processes that the node started."""
    text = open(f"/proc/{deployed.pid}/task/{deployed.pid}/children").read()  # noqa: PTH123, SIM115
    return [int(pid) for pid in text.split()]


@pytest.mark.long
@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
def test_without_its_guard_it_stops_and_ends(robot, deploy):
    deployed = drive(robot, deploy)
    (guard,) = guards_of(deployed)
    os.kill(guard, signal.SIGKILL)
    code, _, err = deployed.wait()
    assert code == 1
    assert "guard" in err
    assert robot.last == STAND


@pytest.mark.long
def test_without_a_master_it_stands(tmp_path, straight_on):
    master = Master(port=0, rosout=False)
    robot = FakeRobot(master.uri)
    deployed = Deployed(tmp_path, master.uri, straight_on, "--arm", "--goal", "5,0")
    try:
        robot.alive(lambda: robot.last == AHEAD, "a command")
        master.close()
        robot.alive(lambda: robot.last == STAND, "zero")
        deployed.end(signal.SIGTERM)
        assert robot.last == STAND
    finally:
        deployed.close()
        robot.close()
        master.close()


def changed(policy, folder, **action):
    """Return a copy of a policy with another contract."""
    told = json.loads(policy.with_suffix(".json").read_text())
    told["action"] |= action
    (folder / "odd.npz").write_bytes(policy.read_bytes())
    (folder / "odd.json").write_text(json.dumps(told).replace("Infinity", "1e400"))
    return folder / "odd.npz"


@pytest.mark.long
def test_an_exception_ends_it_with_zero(robot, deploy, homing, tmp_path):
    """Straight on is known as an action, and to the left is not."""
    policy = changed(homing, tmp_path, first=1)
    deployed = deploy("--arm", "--goal", "5,0", policy=policy)
    robot.alive(lambda: robot.last == (0.15, 0.75), "a command")
    robot.yaw = -1.5
    robot.alive(lambda: deployed.process.poll() is not None, "the end")
    code, _, err = deployed.wait()
    assert code == 1
    assert "does not define action 0" in err
    assert robot.last == STAND


@pytest.mark.long
def test_a_number_that_is_none_is_not_sent(robot, deploy, straight_on, tmp_path):
    policy = changed(straight_on, tmp_path, choices=[[0.15, float("inf")]] * 5)
    deploy("--arm", "--goal", "5,0", policy=policy)
    robot.alive(lambda: robot.last == AHEAD, "a command")
