"""Settings of ``move_group`` requests besides the goal: attempts, link speeds, planners' parameters."""

import threading
from types import SimpleNamespace

import numpy as np
import pytest
from bridges.moveit.moveit_graph import message, moveit_graph, set_parameters
from ros.graph import until

from gazelle.bridges.conversions import pose_message
from gazelle.bridges.moveit.capabilities import Capabilities
from gazelle.bridges.moveit.description import margins_of_parameters, robot_of_parameters
from gazelle.bridges.moveit.plan_choice import shortest_plan, slowed
from gazelle.description import Box, Pose
from gazelle.errors import PlanningError, PlanningWarning
from gazelle.planning import (
    ConstraintSet,
    JointConstraint,
    MotionPlanner,
    PlanningScene,
    PlanOptions,
)
from gazelle_ros import Master, Node, load_service

TIP = "gripper_link"
SIDE = {"shoulder_pan_joint": 1.2}
CONFIGS = {"planner_configs": {"RRTConnect": {"type": "geometric::RRTConnect", "range": 0.0}}}


@pytest.fixture(scope="module")
def client():
    with moveit_graph(**CONFIGS) as made:
        yield made


def goal(**positions):
    return ConstraintSet(tuple(JointConstraint(name, value) for name, value in positions.items()))


def request(**fields):
    made = message("MotionPlanRequest", group_name="arm", allowed_planning_time=30.0, **fields)
    joints = [
        message("JointConstraint", joint_name=name, position=value, tolerance_above=1e-3,
                tolerance_below=1e-3) for name, value in SIDE.items()
    ]  # fmt: skip
    made.goal_constraints = [message("Constraints", joint_constraints=joints)]
    return made


def planned(client, **fields):
    answer = client.call(
        "plan_kinematic_path", "GetMotionPlan", motion_plan_request=request(**fields)
    ).motion_plan_response
    assert answer.error_code.val == 1
    assert answer.group_name == "arm"
    return answer.trajectory.joint_trajectory


def speed_of(robot, trajectory):
    """Return the speed of the tip, between the points of a trajectory [m/s]."""
    times = np.array([each.time_from_start.to_sec() for each in trajectory.points])
    states = np.zeros((len(times), len(robot.variables)))
    states[:, robot.columns(trajectory.joint_names)] = [
        each.positions for each in trajectory.points
    ]
    places = robot.forward(states, TIP)[:, :3, 3]
    return (np.linalg.norm(np.diff(places, axis=0), axis=1) / np.diff(times)).max()


# -- one thing at a time -------------------------------------------------------------------


def test_questions_do_not_wait_for_plans(client):
    context, found = client.group.context, []
    with context.planning:  # as while a long plan is made
        asking = threading.Thread(target=lambda: found.append(planned(client)))
        asking.start()
        scene = client.call("get_planning_scene", "GetPlanningScene").scene
        assert scene.robot_model_name == context.robot.model.name
        state = message("RobotState", is_diff=True)
        assert client.call("check_state_validity", "GetStateValidity", robot_state=state).valid
        change = message("PlanningScene", is_diff=True)
        assert client.call("apply_planning_scene", "ApplyPlanningScene", scene=change).success
        assert not found
    asking.join(60.0)
    assert found


def test_plans_see_the_scene_as_it_is_when_they_begin(client):
    context = client.group.context
    planned(client)
    compiled = dict(context.planned._models)
    planned(client)
    assert dict(context.planned._models) == compiled  # nothing has changed
    with context.lock:
        context.scene.add("wall", Box((0.2, 0.05, 2.0)), Pose(-0.8, 0.0, 1.0))
    try:
        planned(client)
        assert "wall" in context.planned.objects
        assert dict(context.planned._models) != compiled
    finally:
        with context.lock:
            context.scene.remove("wall")
    planned(client)
    assert "wall" not in context.planned.objects


# -- attempts ------------------------------------------------------------------------------


def test_the_shortest_of_several_attempts_counts(client):
    robot = client.group.context.robot
    scene = PlanningScene(robot)
    scene.add("post", Box((0.1, 0.1, 2.0)), Pose(0.65, 0.35, 0.8))
    group, start = robot.group("arm"), robot.zero()
    start[group.columns] = group.positions({"elbow_flex_joint": 0.4}, np.zeros(7))

    def length(attempts, seed):
        options = PlanOptions(seed=seed, time=30.0, use_ompl=False)
        plan = shortest_plan(scene, group, goal(**SIDE), start, None, options, attempts=attempts)
        assert plan.seconds > 0.0
        return float(group.distance(plan.points[:-1], plan.points[1:]).sum()), len(plan.points)

    singles = [length(1, seed)[0] for seed in range(4)]
    assert length(1, 0)[1] > 2, "the post is not in the way"
    best, _ = length(4, 0)
    assert best == pytest.approx(min(singles))
    assert best <= singles[0]


def test_attempts_of_requests(client):
    assert planned(client, num_planning_attempts=3).points


# -- speeds --------------------------------------------------------------------------------


@pytest.mark.parametrize("link", [TIP, ""])
def test_links_are_not_faster_than_they_may_be(client, link):
    robot = client.group.context.robot
    free = speed_of(robot, planned(client))
    held = planned(client, max_cartesian_speed=0.1, cartesian_speed_limited_link=link)
    assert free > 0.2
    assert speed_of(robot, held) == pytest.approx(0.1, rel=0.1)
    assert speed_of(robot, held) <= 0.1 + 1e-9


def test_a_plan_that_is_slow_enough_stays_as_it_is(client):
    robot = client.group.context.robot
    plan = MotionPlanner(PlanningScene(robot), robot.group("arm")).plan(SIDE)
    assert slowed(plan, robot, TIP, 50.0) is plan
    assert slowed(plan, robot, TIP, 0.0) is plan
    with pytest.raises(PlanningError, match="no link 'leg'"):
        slowed(plan, robot, "leg", 0.1)


def test_straight_ways_are_slowed_too(client):
    robot, context = client.group.context.robot, client.group.context
    with context.lock:
        here = robot.pose(context.current(), TIP)
    fields = {
        "group_name": "arm",
        "waypoints": [pose_message(here * Pose(z=0.1))],
        "max_step": 0.01,
    }
    free = client.call("compute_cartesian_path", "GetCartesianPath", **fields)
    held = client.call(
        "compute_cartesian_path", "GetCartesianPath", max_cartesian_speed=0.05, **fields
    )
    assert free.fraction == held.fraction == 1.0
    speeds = [speed_of(robot, each.solution.joint_trajectory) for each in (free, held)]
    assert speeds[0] > speeds[1]
    assert speeds[1] <= 0.05 + 1e-9


# -- parameters ----------------------------------------------------------------------------


def test_parameters_of_planners_are_told_and_changed(client):
    def ask(config, group=""):
        params = client.call(
            "get_planner_params", "GetPlannerParams", planner_config=config, group=group
        ).params
        return dict(zip(params.keys, params.values, strict=True))

    assert ask("RRTConnect") == {"type": "geometric::RRTConnect", "range": "0.0"}
    assert ask("Unheard") == {}
    params = message("PlannerParams", keys=["range"], values=["0.2"])
    fields = {"planner_config": "RRTConnect", "params": params}
    client.call("set_planner_params", "SetPlannerParams", group="arm", **fields)
    assert ask("RRTConnect", "arm")["range"] == "0.2"
    assert ask("RRTConnect")["range"] == "0.0"
    client.call("set_planner_params", "SetPlannerParams", **fields)
    assert ask("RRTConnect")["range"] == "0.2"


def test_octomaps_are_cleared_as_there_are_none(client):
    kind = load_service("std_srvs/Empty")
    until(
        lambda: client.node.client("/clear_octomap", kind).call(kind._request_class()) is not None
    )


def test_margins_of_links_come_from_parameters():
    with Master(port=0, rosout=False) as master, Node("/asking", master_uri=master.uri) as node:
        set_parameters(node)
        robot = robot_of_parameters(node)
        assert margins_of_parameters(node, robot) == ({}, {})
        space = "/robot_description_planning"
        node.set_param(f"{space}/default_robot_padding", 0.02)
        node.set_param(f"{space}/default_robot_scale", 1)
        node.set_param(f"{space}/default_robot_link_paddings", {TIP: 0.05})
        padding, scale = margins_of_parameters(node, robot)
        assert padding == dict.fromkeys(robot.links, 0.02) | {TIP: 0.05}
        assert scale == dict.fromkeys(robot.links, 1.0)
        node.set_param(f"{space}/default_object_padding", 0.01)
        with pytest.warns(PlanningWarning, match="default_object_padding has no effect"):
            margins_of_parameters(node, robot)
        node.set_param(f"{space}/default_robot_padding", "much")
        with pytest.raises(PlanningError, match="'default_robot_padding' must be a number"):
            margins_of_parameters(node, robot)


def test_capabilities_may_be_left_out():
    off = "move_group/MoveGroupKinematicsService MoveGroupPickPlaceAction  MoveGroupMoveAction"
    with moveit_graph(disable_capabilities=off) as client:
        publishers, _, services = client.node.master.system_state()
        assert {"/check_state_validity", "/plan_kinematic_path", "/clear_octomap"} <= {*services}
        assert not {*services} & {"/compute_ik", "/compute_fk"}
        assert "/execute_trajectory/status" in publishers
        assert not {*publishers} & {"/move_group/status", "/pickup/status", "/place/status"}


@pytest.mark.parametrize("parameter", ["~capabilities", "~disable_capabilities"])
def test_capabilities_that_are_not_known_are_warned_of(parameter):
    given = {parameter: "move_group/MoveGroupPlanService move_group/MoveGroupPlanServices"}
    node = SimpleNamespace(get_param=given.get)
    with pytest.warns(PlanningWarning, match="no capability 'MoveGroupPlanServices'; did you mean"):
        found = Capabilities(node)
    assert ("plan_kinematic_path" in found) == (parameter == "~capabilities")
    assert "compute_ik" in found
