"""The clock, the states, and the topics of a robot's plugins."""

import threading

import pytest
from ros.graph import until

import gazelle
from gazelle.bridges import serve_ros
from gazelle_ros import Master, Node, WallClock, load_message

KINDS = {
    "/odom": "nav_msgs/Odometry",
    "/scan": "sensor_msgs/LaserScan",
    "/imu": "sensor_msgs/Imu",
    "/joint_states": "sensor_msgs/JointState",
    "/tf": "tf2_msgs/TFMessage",
    "/gazebo/model_states": "gazebo_msgs/ModelStates",
    "/gazebo/link_states": "gazebo_msgs/LinkStates",
}


def wait_until_heard(graph):
    def heard():
        outputs = graph.sim.robots["r1"].outputs.values()
        return all(output.has_subscribers for output in outputs)

    until(heard)


@pytest.mark.long
def test_every_topic_comes_at_its_rate_with_its_frames(graph):
    heard = {topic: graph.client.listen(topic, kind) for topic, kind in KINDS.items()}
    clock = graph.client.listen("/clock", "rosgraph_msgs/Clock")
    wait_until_heard(graph)
    until(lambda: len(clock) > 0)
    clock.clear()
    # Topics have threads of their own: each may be the last, and one that is late loses messages.
    for part in range(1, 21):
        graph.sim.run(seconds=0.1)
        least = {"/imu": 100 * part, "/odom": 3 * part - 1, "/scan": part // 2 - 1}
        for topic, count in least.items():
            until(lambda topic=topic, count=count: len(heard[topic]) >= count)
        until(lambda part=part: len(clock) >= 100 * part - 2)
    assert len(clock) == pytest.approx(2000, abs=2)
    assert len(heard["/odom"]) == pytest.approx(60, abs=1)
    assert len(heard["/scan"]) == pytest.approx(10, abs=1)
    scan, odometry = heard["/scan"][-1], heard["/odom"][-1]
    assert (scan.header.frame_id, len(scan.ranges)) == ("base_scan", 360)
    assert (odometry.header.frame_id, odometry.child_frame_id) == ("odom", "base_footprint")
    assert odometry.pose.covariance[0] == pytest.approx(1e-5)
    assert odometry.pose.covariance[14] == pytest.approx(1e12)
    transform = heard["/tf"][-1].transforms[0]
    assert (transform.header.frame_id, transform.child_frame_id) == ("odom", "base_footprint")
    assert heard["/joint_states"][-1].name == ["wheel_right_joint", "wheel_left_joint"]
    assert "r1" in heard["/gazebo/model_states"][-1].name
    assert "r1::wheel_left_link" in heard["/gazebo/link_states"][-1].name


def test_the_robot_drives_as_cmd_vel_says(running):
    publisher = running.client.node.advertise("/cmd_vel", load_message("geometry_msgs/Twist"))
    until(lambda: publisher.num_connections == 1)
    twist = load_message("geometry_msgs/Twist")()
    twist.linear.x = 0.2
    publisher.publish(twist)
    until(lambda: running.sim.robots["r1"].pose.x > 0.3)


def test_who_comes_late_is_told_the_time_of_a_paused_world(graph):
    graph.sim.step(42)
    graph.sim.pause()
    clock = graph.client.listen("/clock", "rosgraph_msgs/Clock")
    until(lambda: clock)
    assert clock[0].clock.to_sec() == pytest.approx(0.042)


@pytest.mark.long
def test_after_a_reset_one_consistent_set_is_published_before_the_answer(graph):
    heard = {topic: graph.client.listen(topic, kind) for topic, kind in KINDS.items()}
    wait_until_heard(graph)
    graph.sim.robots["r1"].inputs["cmd_vel"].send(0.2)
    for part in range(1, 11):
        graph.sim.run(seconds=0.1)
        until(lambda part=part: len(heard["/imu"]) >= 100 * part - 1)
    for messages in heard.values():
        messages.clear()
    graph.client.call("reset_simulation", "std_srvs/Empty")
    stamped = ("/odom", "/scan", "/imu", "/joint_states")

    def begun():
        return all(heard[t] and heard[t][-1].header.stamp.is_zero() for t in stamped)

    until(lambda: begun() and all(heard.values()))
    odometry = heard["/odom"][-1]
    assert odometry.pose.pose.position.x == pytest.approx(0.0, abs=1e-6)
    assert odometry.twist.twist.linear.x == pytest.approx(0.0, abs=1e-6)
    assert heard["/tf"][-1].transforms[0].transform.translation.x == pytest.approx(0.0, abs=1e-6)
    graph.sim.run(seconds=0.5)
    assert graph.sim.robots["r1"].pose.x == pytest.approx(0.0, abs=1e-3)


def test_a_topic_that_nobody_listens_to_costs_nothing(graph):
    graph.client.listen("/odom", "nav_msgs/Odometry")
    outputs = graph.sim.robots["r1"].outputs
    until(lambda: outputs["odom"].has_subscribers)
    assert not outputs["scan"].has_subscribers
    assert not graph.sim.robots["r1"].sensors["lds_lfcd_sensor"].awake


def test_time_never_goes_back_for_graphs_that_cannot_bear_it():
    with (
        Master(port=0, rosout=False) as master,
        gazelle.Simulation("empty") as sim,
        serve_ros(sim, master.uri, monotonic_clock=True) as server,
        Node("watcher", master_uri=master.uri, clock=WallClock()) as node,
    ):
        stamps = []
        node.subscribe("/clock", load_message("rosgraph_msgs/Clock"), stamps.append)
        until(lambda: stamps)
        for _ in range(3):
            sim.step(50)
            sim.reset()
        sim.step(10)
        server.gazebo.publish()
        # The last step before each reset was never told.
        until(lambda: stamps[-1].clock.to_sec() == pytest.approx(0.157))
        times = [each.clock.to_sec() for each in stamps]
        assert times == sorted(times)


def test_without_the_network_there_are_the_clock_and_what_plugins_publish():
    with Master(port=0, rosout=False) as master, Node("boss", master_uri=master.uri) as boss:
        boss.set_param("/gazebo/enable_ros_network", False)
        boss.set_param("/gazebo/pub_clock_frequency", 100)
        with gazelle.Simulation("empty") as sim, serve_ros(sim, master.uri):
            topics = [name for name, _ in boss.master.published_topics()]
            assert sorted(topics) == ["/clock", "/rosout"]  # as of any node
            services = boss.master.system_state()[2]
            assert sorted(services) == ["/gazebo/get_loggers", "/gazebo/set_logger_level"]
            ticks = []
            boss.subscribe("/clock", load_message("rosgraph_msgs/Clock"), ticks.append)
            until(lambda: ticks)
            ticks.clear()
            sim.run(seconds=1.0)
            until(lambda: len(ticks) >= 99)
            assert len(ticks) == pytest.approx(100, abs=2)
            sim.spawn("turtlebot3_burger", namespace="/")
            assert "/scan" in [name for name, _ in boss.master.published_topics()]


def test_the_door_leaves_nothing_behind():
    with Master(port=0, rosout=False) as master, gazelle.Simulation("empty") as sim:
        before = set(threading.enumerate())
        plugins = len(sim.plugins)
        serve_ros(sim, master.uri).close()
        with Node("boss", master_uri=master.uri) as boss:
            assert boss.master.published_topics() == []
            state = boss.master.system_state()
            assert not any("gazebo" in str(part) for part in state)
        assert len(sim.plugins) == plugins
        until(lambda: set(threading.enumerate()) <= before)
