"""Forward kinematics and Jacobians, against MuJoCo and against numeric differences."""

import arms
import mujoco
import numpy as np
import pytest

from gazelle.description import Pose, World
from gazelle.engines.mujoco import to_mjcf
from gazelle.errors import Error, FormatWarning, PlanningError
from gazelle.formats import load_model_string
from gazelle.kinematics import RobotModel


def states(robot, count=20, seed=0):
    lower, upper = robot.limits()
    low, high = np.maximum(lower, -3.0), np.minimum(upper, 3.0)
    drawn = np.random.default_rng(seed).uniform(low, high, (count, len(lower)))
    return robot.complete(drawn)


def robots():
    made = {name: arms.arm(name) for name in arms.ARMS}
    return made | {"odd": arms.odd(), "nested": arms.nested()}


class Physics:
    """The same robot in MuJoCo."""

    def __init__(self, robot):
        self.robot, self.name = robot, robot.model.name
        world = World("empty", models=(robot.model,))
        self.model = mujoco.MjModel.from_xml_string(to_mjcf(world, visuals=False))
        self.data = mujoco.MjData(self.model)

    def set(self, state):
        for name, value in zip(self.robot.names, state, strict=True):
            joint = self.model.joint(f"{self.name}::{name}")
            self.data.qpos[joint.qposadr[0]] = value
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)

    def placed(self, link):
        made = np.eye(4)
        body = self.data.body(f"{self.name}::{link}")
        made[:3, :3], made[:3, 3] = body.xmat.reshape(3, 3), body.xpos
        return made

    def in_root(self, link):
        return np.linalg.inv(self.placed(self.robot.root)) @ self.placed(link)

    def jacobian(self, link, point):
        both = np.zeros((6, self.model.nv))
        body = self.model.body(f"{self.name}::{link}").id
        mujoco.mj_jac(self.model, self.data, both[:3], both[3:], point, body)
        joints = [self.model.joint(f"{self.name}::{name}") for name in self.robot.names]
        return both[:, [joint.dofadr[0] for joint in joints]]


@pytest.mark.parametrize("name", [*arms.ARMS, "odd", "nested"])
def test_links_are_where_mujoco_puts_them(name):
    robot = robots()[name]
    physics = Physics(robot)
    bodies = list(robot.bodies)
    drawn = states(robot)
    placed = robot.forward(drawn, bodies)
    for state, poses in zip(drawn, placed, strict=True):
        physics.set(state)
        expected = [physics.in_root(body) for body in bodies]
        np.testing.assert_allclose(poses, expected, atol=1e-9)


@pytest.mark.parametrize("name", [*arms.ARMS, "nested"])
def test_jacobians_are_those_of_mujoco(name):
    robot = robots()[name]
    physics = Physics(robot)
    physics.set(robot.zero())
    turned = physics.placed(robot.root)
    link = list(robot.bodies)[-1]
    for state in states(robot, 5):
        physics.set(state)
        point = turned @ robot.forward(state, link) @ [0.1, -0.2, 0.3, 1.0]
        expected = physics.jacobian(link, point[:3])
        back = np.kron(np.eye(2), turned[:3, :3].T)
        own = robot.jacobian(state, link, (0.1, -0.2, 0.3))
        leaders = [i for i, each in enumerate(robot.variables) if not each.mimics]
        free = [i for i in leaders if robot.variables[i].name != "r_gripper_finger_joint"]
        np.testing.assert_allclose(own[:, free], (back @ expected)[:, free], atol=1e-9)


@pytest.mark.parametrize("name", [*arms.ARMS, "odd", "nested"])
def test_jacobians_are_numeric_differences(name):
    robot = robots()[name]
    step = 1e-6
    for link in robot.links:
        for state in states(robot, 3, seed=1):
            found = robot.jacobian(state, link)
            here = robot.forward(state, link)
            for column in range(len(state)):
                moved = np.tile(state, (2, 1))
                moved[:, column] += (-step, step)
                low, high = robot.forward(moved, link)
                rate = (high - low) / (2.0 * step)
                turn = rate[:3, :3] @ here[:3, :3].T
                spin = [turn[2, 1], turn[0, 2], turn[1, 0]]
                np.testing.assert_allclose(found[:3, column], rate[:3, 3], atol=1e-8)
                np.testing.assert_allclose(found[3:, column], spin, atol=1e-8)


def test_a_batch_has_the_bits_of_its_parts():
    robot = arms.arm("fetch")
    drawn = states(robot, 50)
    links = ["gripper_link", "torso_lift_link", "base_link"]
    together = robot.forward(drawn, links)
    assert together.shape == (50, 3, 4, 4)
    for state, poses in zip(drawn, together, strict=True):
        assert (robot.forward(state, links) == poses).all()
        assert (robot.forward(state, "gripper_link") == poses[0]).all()
    jacobians = robot.jacobian(drawn, "gripper_link")
    assert (jacobians[7] == robot.jacobian(drawn[7], "gripper_link")).all()


def test_models_inside_belong_to_the_robot_and_joints_that_close_loops_do_not():
    srdf = (
        "<group name='arm'><chain base_link='base' tip_link='hand::palm'/></group>"
        "<group name='hand'><joint name='hand::grip'/><joint name='closing'/></group>"
    )
    robot = arms.nested(srdf)
    assert robot.names == ("lift", "wrist", "hand::grip", "swing")
    assert list(robot.bodies) == ["base", "upper", "hand::palm", "hand::finger", "bar"]
    assert [joint.name for joint in robot.closing] == ["closing"]
    assert (robot.group("arm").names, robot.group("arm").tip) == (("lift", "wrist"), "hand::palm")
    assert robot.group("hand").names == ("hand::grip",)
    frame = robot.links["hand::tip"]
    assert (frame.body, robot.nodes[frame.joint].name) == ("hand::finger", "hand::grip")
    state = robot.zero()
    state[robot.column("hand::grip")] = 0.4
    expected = robot.pose(state, "hand::finger") * Pose(0.1, 0.0, 0.0, pitch=0.2)
    assert robot.pose(state, "hand::tip").is_close(expected)


def test_the_root_does_not_move():
    robot = arms.arm("fetch")
    drawn = states(robot)
    assert (robot.forward(drawn, "base_link") == np.eye(4)).all()
    assert not robot.jacobian(drawn, "base_link").any()


def test_what_follows_is_no_variable_of_its_own():
    robot = arms.odd()
    column = robot.column("follow")
    state = states(robot, 1)[0]
    other = state.copy()
    other[column] += 1.0
    assert (robot.forward(state, "d") == robot.forward(other, "d")).all()
    assert robot.complete(other)[column] == pytest.approx(0.25 - 0.5 * state[robot.column("turn")])
    assert not robot.jacobian(state, "d")[:, column].any()


def test_a_base_that_drives_has_three_variables():
    srdf = '<virtual_joint name="v" type="planar" parent_frame="odom" child_link="base"/>'
    robot = arms.odd(srdf)
    assert robot.names[:3] == ("v/x", "v/y", "v/theta")
    assert robot.frame == "odom"
    state = robot.zero()
    state[:3] = 1.0, 2.0, 0.5
    pose = robot.pose(state, "base")
    assert (pose.x, pose.y, pose.yaw) == pytest.approx((1.0, 2.0, 0.5))
    still = arms.odd().forward(arms.odd().zero(), "tool")
    np.testing.assert_allclose(robot.forward(state, "tool"), pose.matrix() @ still, atol=1e-12)


@pytest.mark.parametrize("kind", ["fixed", "revolute"])
def test_a_robot_may_be_held_to_the_world(kind):
    joint = (
        f'<link name="world"/><joint name="foot" type="{kind}"><parent link="world"/>'
        '<child link="base"/><origin xyz="1 2 3"/><axis xyz="0 0 1"/>'
        '<limit lower="-1" upper="1" velocity="1" effort="1"/></joint>'
    )
    model = load_model_string(arms.ODD.replace("</robot>", f"{joint}</robot>"))
    robot = RobotModel(model)
    assert robot.root == "world"
    moved = robot.forward(robot.zero(), "tool")
    np.testing.assert_allclose(
        moved, Pose(1, 2, 3).matrix() @ arms.odd().forward(arms.odd().zero(), "tool"), atol=1e-12
    )
    assert ("foot" in robot.names) == (kind == "revolute")


def test_a_robot_of_two_parts_is_refused():
    other = '<robot name="two"><link name="a"/><link name="b"/></robot>'
    with pytest.raises(Error, match=r"root|tree"):
        RobotModel(load_model_string(other))


@pytest.mark.parametrize("leaders", [("one",), ("two", "one"), ("two", "three", "one")])
def test_joints_that_only_mimic_each_other_are_refused(leaders):
    names = ("one", "two", "three")
    text = "<robot name='r'><link name='base'/>"
    for place, leader in enumerate(leaders):
        text += (
            f"<link name='{names[place]}_link'/><joint name='{names[place]}' type='continuous'>"
            f"<parent link='{f'{names[place - 1]}_link' if place else 'base'}'/>"
            f"<child link='{names[place]}_link'/><axis xyz='0 0 1'/><mimic joint='{leader}'/></joint>"
        )
    with (
        pytest.warns(FormatWarning, match="mass"),
        pytest.raises(PlanningError, match="'one' mimics itself: one -> "),
    ):
        RobotModel(load_model_string(text + "</robot>"))


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda robot: robot.forward(robot.zero(), "gripper_lnk"), "did you mean 'gripper_link'"),
        (lambda robot: robot.column("elbow"), "no joint 'elbow'"),
        (lambda robot: robot.forward([0.0, 1.0], "gripper_link"), "a state has 12 positions"),
        (lambda robot: robot.group("leg"), "no group 'leg'"),
        (lambda robot: robot.group("arm").named("sleep"), "no state 'sleep'"),
    ],
)
def test_what_is_not_there_is_named(ask, words):
    with pytest.raises(PlanningError, match=words):
        ask(arms.arm("fetch"))
