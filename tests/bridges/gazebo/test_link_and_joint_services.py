"""State, properties, wrenches and efforts of links and joints over ROS."""

import math

import numpy as np
import pytest

import gazelle
from gazelle.errors import SimulationWarning
from gazelle_ros import Duration, Time, load_message

BALL = """<sdf version="1.6"><model name="{name}"><link name="core">
<inertial><mass>2</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>
<gravity>0</gravity></link></model></sdf>"""

CROSS = """<sdf version="1.6"><model name="cross"><link name="arm"><gravity>0</gravity>
<inertial><mass>2</mass><inertia>{inertia}</inertia></inertial></link><joint name="both"
type="universal"><parent>world</parent><child>arm</child><axis><xyz>1 0 0</xyz></axis>
<axis2><xyz>0 1 0</xyz></axis2></joint></model></sdf>"""


@pytest.fixture
def ball(graph):
    pose = load_message("geometry_msgs/Pose")()
    pose.position.z = 5.0
    graph.client.call(
        "spawn_sdf_model",
        "SpawnModel",
        model_name="ball",
        model_xml=BALL.format(name="ball"),
        initial_pose=pose,
    )
    return graph.sim.robots["ball"]


def wrench(fx=0.0, tz=0.0):
    message = load_message("geometry_msgs/Wrench")()
    message.force.x, message.torque.z = fx, tz
    return message


def test_a_links_state_is_found_by_scoped_and_by_plain_name(graph, ball):
    for name in ("ball::core", "core"):
        got = graph.client.call("get_link_state", "GetLinkState", link_name=name)
        assert got.success
        assert got.link_state.pose.position.z == pytest.approx(5.0)
    missing = graph.client.call("get_link_state", "GetLinkState", link_name="ball::nose")
    assert missing.status_message.startswith("GetLinkState: link not found, did you forget")


def test_a_links_state_is_set(graph, ball):
    state = load_message("gazebo_msgs/LinkState")()
    state.link_name = "ball::core"
    state.pose.position.x, state.pose.orientation.w = 2.0, 1.0
    state.twist.linear.y = 0.5
    answer = graph.client.call("set_link_state", "SetLinkState", link_state=state)
    assert answer.status_message == "SetLinkState: success"
    graph.sim.step(1000)
    assert (ball.pose.x, ball.pose.y) == pytest.approx((2.0, 0.5), abs=1e-6)
    state.link_name = "nobody::core"
    answer = graph.client.call("set_link_state", "SetLinkState", link_state=state)
    assert answer.status_message == "SetLinkState: link does not exist"


def test_a_links_velocity_is_not_turned_but_the_frames_own_is_taken_off(graph, ball):
    graph.sim.robots["r1"].set_pose((1.0, 0.0, 0.0), yaw=math.pi / 2)
    state = load_message("gazebo_msgs/LinkState")()
    state.link_name, state.reference_frame = "ball::core", "r1"
    state.pose.position.x, state.pose.position.z, state.pose.orientation.w = 1.0, 5.0, 1.0
    state.twist.linear.x = 0.5
    graph.client.call("set_link_state", "SetLinkState", link_state=state)
    assert (ball.pose.x, ball.pose.y) == pytest.approx((1.0, 1.0), abs=1e-6)
    assert ball.twist.linear[0] == pytest.approx(0.5, abs=1e-6)
    got = graph.client.call(
        "get_link_state", "GetLinkState", link_name="ball::core", reference_frame="nowhere"
    )
    assert got.status_message == (
        "GetLinkState: reference reference_frame not found, did you forget to scope the link by "
        "model name?"
    )


def test_a_links_mass_and_inertia_are_read_and_changed(graph, ball):
    got = graph.client.call("get_link_properties", "GetLinkProperties", link_name="ball::core")
    assert (got.mass, got.ixx, got.gravity_mode) == pytest.approx((2.0, 1.0, False))
    answer = graph.client.call(
        "set_link_properties",
        "SetLinkProperties",
        link_name="ball::core",
        mass=4.0,
        ixx=2.0,
        iyy=2.0,
        izz=2.0,
        gravity_mode=True,
    )
    assert answer.status_message == "SetLinkProperties: properties set"
    graph.sim.step(100)
    assert ball.twist.linear[2] == pytest.approx(-0.98, rel=1e-3)


def test_a_wrench_acts_for_its_time_and_no_longer(graph, ball):
    answer = graph.client.call(
        "apply_body_wrench",
        "ApplyBodyWrench",
        body_name="ball::core",
        wrench=wrench(fx=4.0),
        duration=Duration(0, 500_000_000),
    )
    assert (answer.success, answer.status_message) == (True, "")
    graph.sim.step(2000)
    assert ball.twist.linear[0] == pytest.approx(4.0 / 2.0 * 0.5, rel=1e-3)


def test_a_wrench_that_lasts_is_ended_by_the_service_for_that(graph, ball):
    graph.client.call(
        "apply_body_wrench",
        "ApplyBodyWrench",
        body_name="ball::core",
        wrench=wrench(fx=2.0),
        duration=Duration(-1, 0),
    )
    graph.sim.step(1000)
    graph.client.call("clear_body_wrenches", "BodyRequest", body_name="ball::core")
    graph.sim.step(1000)
    assert ball.twist.linear[0] == pytest.approx(1.0, rel=1e-3)


def test_a_wrench_given_in_a_frame_is_turned_with_it(graph, ball):
    ball.set_pose((0.0, 0.0, 5.0), yaw=math.pi / 2)
    graph.client.call(
        "apply_body_wrench",
        "ApplyBodyWrench",
        body_name="ball::core",
        reference_frame="ball::core",
        wrench=wrench(fx=2.0),
        duration=Duration(1, 0),
    )
    graph.sim.step(1000)
    assert ball.twist.linear[:2] == pytest.approx([0.0, 1.0], abs=2e-3)


@pytest.mark.parametrize("frame", ["world", "ball::core"])
def test_the_point_of_a_wrench_is_the_lever_of_its_force(graph, ball, frame):
    point = load_message("geometry_msgs/Point")(0.0, 0.5, 0.0)
    graph.client.call(
        "apply_body_wrench",
        "ApplyBodyWrench",
        body_name="ball::core",
        reference_frame=frame,
        reference_point=point,
        wrench=wrench(fx=0.02),
        duration=Duration(1, 0),
    )
    graph.sim.step(1000)
    assert ball.twist.linear[0] == pytest.approx(0.01, rel=1e-2)
    assert ball.twist.angular[2] == pytest.approx(-0.01, rel=1e-2)


def test_a_wrench_that_begins_later_waits(graph, ball):
    graph.client.call(
        "apply_body_wrench",
        "ApplyBodyWrench",
        body_name="ball::core",
        wrench=wrench(fx=2.0),
        start_time=Time(1, 0),
        duration=Duration(1, 0),
    )
    graph.sim.step(1000)
    assert ball.twist.linear[0] == 0.0
    graph.sim.step(1000)
    assert ball.twist.linear[0] == pytest.approx(1.0, rel=1e-3)


def test_bodies_and_frames_that_are_not_there_are_named(graph, ball):
    answer = graph.client.call("apply_body_wrench", "ApplyBodyWrench", body_name="nobody")
    assert answer.status_message == "ApplyBodyWrench: body does not exist"
    answer = graph.client.call(
        "apply_body_wrench", "ApplyBodyWrench", body_name="ball::core", reference_frame="nowhere"
    )
    assert answer.status_message == "ApplyBodyWrench: reference_frame not found"


def test_a_joint_is_read_turned_and_let_go(graph):
    wheel = graph.sim.robots["r1"].joints["wheel_left_joint"]
    got = graph.client.call(
        "get_joint_properties", "GetJointProperties", joint_name="wheel_left_joint"
    )
    assert (got.success, got.type, list(got.damping)) == (True, 0, [])
    assert got.position[0] == pytest.approx(wheel.position)
    answer = graph.client.call(
        "apply_joint_effort",
        "ApplyJointEffort",
        joint_name="wheel_left_joint",
        effort=0.05,
        duration=Duration(-1, 0),
    )
    assert answer.status_message == "ApplyJointEffort: effort set"
    before = wheel.position
    graph.sim.step(100)
    assert wheel.position != before
    graph.client.call("clear_joint_forces", "JointRequest", joint_name="wheel_left_joint")
    answer = graph.client.call("apply_joint_effort", "ApplyJointEffort", joint_name="none")
    assert answer.status_message == "ApplyJointEffort: joint not found"


def test_the_damping_of_a_joint_is_set(graph):
    config = load_message("gazebo_msgs/ODEJointProperties")(damping=[0.7])
    answer = graph.client.call(
        "set_joint_properties",
        "SetJointProperties",
        joint_name="wheel_left_joint",
        ode_joint_config=config,
    )
    assert answer.status_message == "SetJointProperties: properties set"
    found = graph.sim.engine.parameter("joint_damping", "r1::wheel_left_joint")
    assert np.allclose(found, 0.7)


def test_the_motor_of_a_joint_is_set_axis_by_axis_and_in_any_order(graph):
    def configure(joint, **values):
        config = load_message("gazebo_msgs/ODEJointProperties")(**values)
        answer = graph.client.call(
            "set_joint_properties", "SetJointProperties", joint_name=joint, ode_joint_config=config
        )
        assert answer.status_message == "SetJointProperties: properties set"

    text = CROSS.format(inertia="<ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz>")
    graph.client.call("spawn_sdf_model", "SpawnModel", model_name="cross", model_xml=text)
    both = graph.sim.robots["cross"].joints["both"]
    configure("both", vel=[1.0, -2.0])
    graph.sim.step(50)
    assert both.velocities()[0] == pytest.approx((0.0, 0.0), abs=1e-9)
    configure("both", fmax=[1e4, 1e4])
    graph.sim.step(50)
    assert both.velocities()[0] == pytest.approx((1.0, -2.0), abs=1e-6)
    configure("both", fmax=[0.0], vel=[0.5, 0.0])
    graph.sim.step(50)
    assert both.velocities()[0, 1] == pytest.approx(0.0, abs=1e-6)
    assert both.motor_effort()[0].tolist() == [0.0, 1e4]


CART = """<robot name='cartpole'><link name='world'/>
<joint name='slider' type='prismatic'><parent link='world'/><child link='cart'/><axis xyz='1 0 0'/>
<limit lower='-2' upper='2' effort='9' velocity='9'/></joint>
<joint name='hinge' type='continuous'><parent link='cart'/><child link='pole'/><axis xyz='0 1 0'/></joint>
<link name='cart'>{0}</link><link name='pole'>{0}</link></robot>""".format(
    "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
)


@pytest.fixture
def cart(graph):
    return graph.sim.spawn(gazelle.formats.load_model_string(CART), pose=gazelle.Pose(y=9.0))


def set_link(graph, link, **pose):
    state = load_message("gazebo_msgs/LinkState")(link_name=link)
    for name, value in pose.items():
        setattr(state.pose.position if name in "xyz" else state.pose.orientation, name[-1], value)
    return graph.client.call("set_link_state", "SetLinkState", link_state=state)


def test_a_pole_is_put_upright_by_its_links_state_and_the_cart_stays(graph, cart):
    cart.joints["hinge"].set_position(0.7)
    cart.joints["hinge"].set_velocity(2.0)
    cart.joints["slider"].set_position(0.5)
    with pytest.warns(SimulationWarning, match="only the part"):
        answer = set_link(graph, "pole")  # all zeros: no turn, at the origin
    assert answer.success
    assert answer.status_message.startswith("SetLinkState: success, but joint 'cartpole::hinge'")
    assert cart.joints["hinge"].position == pytest.approx(0.0, abs=1e-9)
    assert cart.joints["hinge"].velocity == pytest.approx(0.0, abs=1e-9)
    assert cart.joints["slider"].position == pytest.approx(0.5)
    answer = set_link(graph, "cartpole::cart", x=-0.25, y=9.0)
    assert (answer.success, answer.status_message) == (True, "SetLinkState: success")
    assert cart.joints["slider"].position == pytest.approx(-0.25)
    with pytest.warns(SimulationWarning, match="only the part"):
        assert "holds it 3 m from there" in set_link(graph, "cart", x=5.0, y=9.0).status_message


def test_the_state_of_a_model_that_a_joint_holds_is_answered_as_by_gazebo(graph, cart):
    cart.joints["slider"].set_velocity(1.0)
    state = load_message("gazebo_msgs/ModelState")(model_name="cartpole")
    state.pose.position.x = 3.0
    answer = graph.client.call("set_model_state", "SetModelState", model_state=state)
    assert answer.success
    assert answer.status_message == (
        "SetModelState: set model state done, but model 'cartpole' is fixed to the world by a joint "
        "and cannot be moved"
    )
    assert cart.joints["slider"].velocity == 0.0


def test_why_a_links_state_cannot_be_set_is_said(graph):
    fixed = CART.replace("type='prismatic'", "type='fixed'")
    graph.sim.spawn(gazelle.formats.load_model_string(fixed), name="post")
    answer = set_link(graph, "post::cart")
    assert not answer.success
    assert "is fixed to the world" in answer.status_message
