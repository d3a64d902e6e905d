"""The clients of controllers against a simulated arm's own manager and controllers."""

from __future__ import annotations

import contextlib
from types import SimpleNamespace

import pytest
from bridges.control.robot_graph import robot_graph
from control.arms import DATA, JOINTS, arm_text

from gazelle.clients import (
    ClientError,
    Controllers,
    Gazebo,
    JointCommander,
    JointWaypoint,
    Processes,
    TrajectoryClient,
    spawn_robot,
)

STATES = {"type": "joint_state_controller/JointStateController", "publish_rate": 50}
TRAJECTORY = {
    "type": "position_controllers/JointTrajectoryController",
    "joints": JOINTS,
    "constraints": {"goal_time": 5.0},
}
GROUP = {"type": "position_controllers/JointGroupPositionController", "joints": JOINTS}
ONE = {"type": "position_controllers/JointPositionController", "joint": "elbow"}
PARAMETERS = {
    "/arm/states": STATES,
    "/arm/follower": TRAJECTORY,
    "/arm/partial": TRAJECTORY | {"allow_partial_joints_goal": True},
    "/arm/group": GROUP,
    "/arm/elbow": ONE,
    "/arm/misspelt": ONE | {"type": "position_controllers/JointPositionControler"},
    "/arm/of_nothing": ONE | {"joint": "knee"},
    "/arm/bare": {"type": "position_controllers/JointPositionController"},
}
NOT_RUNNING = {"initialized", "stopped"}


@pytest.fixture(scope="module")
def arm():
    """Run an arm commanded by position; its controllers' parameters are set."""
    with (
        robot_graph(arm_text("Position"), parameters=PARAMETERS) as graph,
        Controllers(graph.node, "/arm", timeout=60.0) as controllers,
    ):
        controllers.spawn("states")
        yield SimpleNamespace(node=graph.node, controllers=controllers, sim=graph.sim)


@pytest.fixture
def controllers(arm):
    """Return the manager, with only the joint state controller loaded."""
    arm.controllers.kill([name for name in arm.controllers.states() if name != "states"])
    return arm.controllers


def test_one_name_will_do_for_all_that_takes_names(controllers):
    controllers.load("group")
    assert controllers.states()["group"] == "initialized"
    controllers.start("group")
    controllers.stop("group")
    assert controllers.states()["group"] == "stopped"
    controllers.switch(start="group")
    controllers.reset("group")
    controllers.wait_for("group")
    controllers.kill("group")
    assert controllers.states() == {"states": "running"}


def test_several_are_spawned_and_killed_whatever_they_do(controllers):
    controllers.load(("elbow", "group"))
    controllers.start("group")
    controllers.spawn(["elbow"], stopped=True)
    controllers.spawn(iter(["group", "follower"]), stopped=True)
    states = controllers.states()
    assert states["group"] == "running"
    assert {states["elbow"], states["follower"]} <= NOT_RUNNING
    claims = {each.name: each.claimed_resources for each in controllers.loaded()}
    assert list(claims["group"][0].resources) == sorted(JOINTS)
    controllers.kill(["elbow", "group", "follower"])
    assert controllers.states() == {"states": "running"}


def test_a_spawn_that_fails_leaves_nothing_behind(controllers):
    with pytest.raises(ClientError, match="'bare': its parameters"):
        controllers.spawn(["group", "bare"])
    with pytest.raises(ClientError, match="'follower' and 'group' both claim"):
        controllers.spawn(["group", "follower"])
    assert controllers.states() == {"states": "running"}


def test_what_cannot_be_switched_is_passed_over_if_asked(controllers):
    controllers.spawn("group")
    with pytest.raises(ClientError, match="'groop': it is not loaded; did you mean 'group'"):
        controllers.stop(["group", "groop"])
    assert controllers.states()["group"] == "running"
    controllers.stop(["group", "groop"], strict=False)
    assert controllers.states()["group"] == "stopped"


@pytest.mark.parametrize(
    ("act", "words"),
    [
        (lambda c: c.load("group"), "load_controller refused 'group': it is loaded already"),
        (lambda c: c.load("nobody"), "no parameter /arm/nobody/type"),
        (lambda c: c.load("misspelt"), "JointPositionControler'; did you mean 'position_contr"),
        (lambda c: c.load("of_nothing"), "parameters in /arm/of_nothing do not suit"),
        (lambda c: c.unload("group"), "unload_controller refused 'group': it runs; stop it first"),
        (lambda c: c.unload("nobody"), "'nobody': it is not loaded"),
        (lambda c: c.start("group"), "'group' runs already"),
        (lambda c: c.stop("elbow"), "'elbow' does not run"),
        (lambda c: c.start("elbow"), "'elbow' and 'group' both claim 'elbow'"),
        (lambda c: c.start(["follower", "elbow"]), "both claim 'elbow'"),
        (lambda c: c.wait_for("elbow", timeout=0.2), "'elbow' is initialized, and not running"),
        (lambda c: c.wait_for("elbo", timeout=0.2), "'elbo' is not loaded"),
        (lambda c: c.reload_libraries(), "controllers are loaded"),
    ],
)
def test_a_refusal_says_why(act, words, controllers):
    controllers.load(["elbow", "follower"])
    controllers.spawn("group")
    with pytest.raises(ClientError) as caught:
        act(controllers)
    assert words in str(caught.value)


def test_types_are_listed(controllers):
    assert TRAJECTORY["type"] in controllers.types()


def test_a_manager_that_is_not_there_is_an_error_in_time(arm):
    with (
        Controllers(arm.node, "/nowhere", timeout=0.2) as lost,
        pytest.raises(ClientError, match=r"/nowhere/controller_manager/list_controllers does not"),
    ):
        lost.states()


# -- joints ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("controller", "targets", "there"),
    [
        ("elbow", 0.3, {"elbow": 0.3}),
        ("elbow", [0.2], {"elbow": 0.2}),
        ("group", [0.4, -0.2], {"shoulder": 0.4, "elbow": -0.2}),
        ("group", {"elbow": 0.1, "shoulder": -0.1}, {"shoulder": -0.1, "elbow": 0.1}),
        ("group", 0.25, {"shoulder": 0.25, "elbow": 0.25}),
    ],
)
def test_joints_are_moved_and_progress_is_told(controller, targets, there, arm, controllers):
    controllers.spawn(controller)
    told = []
    with JointCommander(arm.node, controller, "/arm") as joints:
        found = joints.move(targets, tolerance=0.02, timeout=60.0, progress=told.append)
    assert found == pytest.approx(there, abs=0.02)
    assert set(told[-1]) == set(there)


@pytest.mark.parametrize(
    ("controller", "targets", "words"),
    [
        ("group", [0.1, 0.2, 0.3], "takes 2 values (shoulder, elbow), not 3"),
        ("group", {"shoulder": 0.1}, "'elbow' has none"),
        ("group", {"shoulder": 0.1, "elbw": 0.1}, "no joint 'elbw'"),
    ],
)
def test_wrong_targets_are_an_error(controller, targets, words, arm, controllers):
    controllers.spawn(controller)
    with (
        JointCommander(arm.node, controller, "/arm") as joints,
        pytest.raises(ClientError) as caught,
    ):
        joints.send(targets, timeout=60.0)
    assert words in str(caught.value)


def test_joints_that_cannot_get_there_are_an_error(arm, controllers):
    controllers.spawn("group")
    with (
        JointCommander(arm.node, "group", "/arm") as joints,
        pytest.raises(ClientError, match=r"'shoulder' is still .* away from 40 after"),
    ):
        joints.move([40.0, 0.0], timeout=1.0)


@pytest.mark.parametrize("name", ["states", "nobody"])
def test_what_commands_no_joints_is_an_error(name, arm):
    with pytest.raises(ClientError, match=f"/arm/{name}"):
        JointCommander(arm.node, name, "/arm")


# -- trajectories ------------------------------------------------------------------------------


@pytest.fixture
def follower(arm, controllers):
    controllers.spawn("follower")
    with contextlib.closing(TrajectoryClient(arm.node, "follower", "/arm", 60.0)) as made:
        yield made


def positions(arm):
    joints = arm.sim.robots["two_link_arm"].joints
    return {name: joints[name].position for name in JOINTS}


def test_a_trajectory_is_followed_with_progress_to_its_result(arm, follower):
    told = []
    outcome = follower.move(
        {"elbow": -0.3, "shoulder": 0.5}, 0.5, timeout=120.0, progress=told.append
    )
    assert (outcome.status, outcome.error_code, outcome.succeeded) == ("SUCCEEDED", 0, True)
    assert positions(arm) == pytest.approx({"shoulder": 0.5, "elbow": -0.3}, abs=0.02)
    assert set(told[0].actual) == set(told[0].error) == set(JOINTS)
    assert told[0].seconds < told[-1].seconds


def test_waypoints_are_followed_in_order(arm, follower):
    way = [JointWaypoint(0.2, (0.1, 0.1)), JointWaypoint(0.4, (0.0, 0.2))]
    assert follower.follow(JOINTS, way, timeout=120.0).succeeded
    assert positions(arm) == pytest.approx({"shoulder": 0.0, "elbow": 0.2}, abs=0.02)


def test_a_trajectory_can_be_given_up(follower):
    run = follower.start(JOINTS, [JointWaypoint(500.0, (0.5, 0.5))])
    run.cancel()
    assert run.wait(60.0).status in {"PREEMPTED", "RECALLED"}


def test_one_that_takes_too_long_is_cancelled_and_an_error(follower):
    with pytest.raises(ClientError, match=r"follow_joint_trajectory is not done after 0\.2 s"):
        follower.move(dict.fromkeys(JOINTS, 0.5), 500.0, timeout=0.2)
    # Were it still followed, this would end it as PREEMPTED; the joints hold already.
    assert follower.start(JOINTS, []).wait(60.0).succeeded


def test_a_goal_that_is_rejected_says_why(arm, follower, controllers):
    with pytest.raises(ClientError, match=r"REJECTED \(-2\)"):
        follower.move({"elbow": 0.1}, 0.5)
    with pytest.raises(ClientError, match="2 values for 1 joints"):
        follower.start(["elbow"], [JointWaypoint(1.0, (0.1, 0.2))])
    controllers.kill("follower")
    controllers.spawn("partial")
    with TrajectoryClient(arm.node, "partial", "/arm", 60.0) as partial:
        assert partial.move({"elbow": 0.1}, 0.2, timeout=120.0).succeeded


def test_tolerances_of_a_goal_hold(follower):
    # Faster, and farther, than the shoulder can go.
    point = [JointWaypoint(0.05, (2.0, 0.0))]
    outcome = follower.start(JOINTS, point, path_tolerance={"shoulder": 1e-3}).wait(60.0)
    assert (outcome.status, outcome.error_code) == ("ABORTED", -4)
    assert "path error" in outcome.text
    point = [JointWaypoint(0.1, (5.0, 0.1))]
    run = follower.start(JOINTS, point, goal_tolerance={"shoulder": 1e-3}, goal_time=0.1)
    outcome = run.wait(60.0)
    assert (outcome.status, outcome.error_code) == ("ABORTED", -5)
    assert not outcome.succeeded


def test_a_controller_that_follows_no_trajectories_is_an_error_in_time(arm):
    with (
        TrajectoryClient(arm.node, "group", "/arm", timeout=0.2) as client,
        pytest.raises(ClientError, match=r"/arm/group/follow_joint_trajectory does not answer"),
    ):
        client.move({"elbow": 0.0}, 1.0)


# -- a whole robot -----------------------------------------------------------------------------


@pytest.mark.long
def test_a_robot_is_spawned_with_its_controllers(monkeypatch):
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(DATA))
    names = ["joints", "lifter", "turner"]
    with (
        robot_graph(namespace="/lift") as graph,
        Processes(graph.node.master_uri) as processes,
        Gazebo(master_uri=graph.node.master_uri, timeout=60.0) as gazebo,
    ):
        spawn_robot(
            gazebo,
            processes,
            "arm",
            "urdf/lifting_arm.urdf.xacro",
            package="lifting_arm",
            namespace="/lift",
            publisher_rate=None,
            controller_file="config/controllers.yaml",
            controllers=names,
        )
        with (
            Controllers(graph.node, "/lift", timeout=60.0) as controllers,
            TrajectoryClient(graph.node, "lifter", "/lift", 60.0) as lifter,
            JointCommander(graph.node, "turner", "/lift") as turner,
        ):
            assert controllers.states() == dict.fromkeys(names, "running")
            assert lifter.move({"lift": 0.2}, 1.0, timeout=120.0).succeeded
            assert turner.move(0.4, tolerance=0.05, timeout=120.0)["turn"] > 0.3
        with pytest.raises(ClientError, match="'nobody': there is no parameter /lift/nobody/type"):
            spawn_robot(
                gazebo,
                processes,
                "other",
                "urdf/lifting_arm.urdf.xacro",
                package="lifting_arm",
                xacro_args={"space": "/lift/2"},
                namespace="/lift",
                publisher_rate=None,
                controllers=["nobody"],
            )
