"""Hector's servos, frames that plugins hear of, and the plugin that tells of resets."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from models import block, plugin, simulate

from gazelle.errors import PluginWarning
from gazelle.plugins.hector_servo import angles_of
from gazelle.plugins.received_frames import ReceivedFrames
from gazelle.rotations import from_yaw, multiply
from gazelle.simulation import Transform, Transforms
from gazelle.simulation.values import TurnCommand

UPRIGHT = (0.0, 0.0, 0.0, 1.0)
LINK = """<link name="{name}"><inertial><mass>0.1</mass><inertia><ixx>0.001</ixx><iyy>0.001</iyy>
<izz>0.001</izz></inertia></inertial></link>"""
JOINT = """<joint name="{name}" type="revolute"><parent>{parent}</parent><child>{child}</child>
<axis><xyz>{axis}</xyz></axis></joint>"""
AXES = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}
PLACES = ("first", "second", "third")


def head(axes, **tags):
    """Return a base with servos about these axes, one upon the other."""
    parts, parent = [LINK.format(name="base_link")], "base_link"
    parts.append(
        '<joint name="fix" type="fixed"><parent>world</parent><child>base_link</child></joint>'
    )
    for place, axis in zip(PLACES, axes, strict=False):
        child = f"link_{place}"
        parts += [
            LINK.format(name=child),
            JOINT.format(name=place, parent=parent, child=child, axis=AXES[axis]),
        ]
        tags[f"{place}ServoName"], tags[f"{place}ServoAxis"] = place, AXES[axis]
        parent = child
    return (
        f'<model name="head">{"".join(parts)}{plugin("libhector_servo_plugin.so", **tags)}</model>'
    )


def about(axis, angle):
    turn = np.zeros((1, 4))
    turn[:, "xyz".index(axis)], turn[:, 3] = math.sin(angle / 2), math.cos(angle / 2)
    return turn


def turned(order, angles):
    """Return the quaternion of turns about axes, each in the frame that the one before left."""
    result = np.array([UPRIGHT])
    for axis, angle in zip(order, angles, strict=True):
        result = multiply(result, about(axis, angle))
    return result


small = st.floats(-1.5, 1.5)


@given(order=st.sampled_from(["xyz", "zyx"]), angles=st.tuples(small, small, small))
def test_angles_are_those_that_a_turn_was_made_of(order, angles):
    assert angles_of(turned(order, angles), order)[0] == pytest.approx(angles, abs=1e-9)


@pytest.mark.long
@pytest.mark.parametrize("torque", ["0", "0.5"])
@pytest.mark.parametrize("axes", ["zy", "xy", "zyx", "xyz"])
def test_servos_turn_to_what_they_are_told(axes, torque):
    with simulate(head(axes, torque=torque), ground=False, nworld=2) as sim:
        robot = sim.robots["head"]
        angles = (0.5, -0.3, 0.4)[: len(axes)]
        wanted = turned(axes, angles)[0]
        robot.inputs["drive"].send(TurnCommand("base_link", wanted), np.array([1]))
        sim.run(seconds=1.5)
        positions = np.stack([robot.joints[p].positions()[:, 0] for p in PLACES[: len(axes)]])
        assert positions[:, 0] == pytest.approx(0.0, abs=1e-3)
        assert positions[:, 1] == pytest.approx(angles, abs=2e-3)


def test_a_servo_about_y_alone_takes_the_pitch():
    with simulate(head("y", topicName="camera/command"), ground=False) as sim:
        robot = sim.robots["head"]
        assert robot.inputs["camera/command"].topic == "/camera/command"
        robot.inputs["camera/command"].send(TurnCommand("/base_link", about("y", 0.4)[0]))
        sim.run(seconds=1.5)
        assert robot.joints["first"].position == pytest.approx(0.4, abs=1e-3)


def test_servos_are_no_quicker_than_allowed_and_tell_where_they_are():
    with simulate(head("zy", maxVelocity="0.2", controlRate="50"), ground=False) as sim:
        robot = sim.robots["head"]
        heard = []
        robot.outputs["drive joint_states"].subscribe(heard.append)
        robot.inputs["drive"].send(TurnCommand("base_link", about("z", 1.0)[0]))
        sim.run(seconds=1.0)
        assert len(heard) == pytest.approx(50, abs=1)
        assert heard[-1].names == ("first", "second")
        assert heard[-1].velocity[0, 0] == pytest.approx(0.2, abs=1e-3)
        assert heard[-1].position[0, 0] == pytest.approx(0.2, abs=0.01)


def test_a_frame_of_tf_counts_and_an_unknown_one_stops_the_servos():
    with simulate(head("zy"), ground=False) as sim:
        robot = sim.robots["head"]
        robot.inputs["drive"].send(TurnCommand("odom", UPRIGHT))
        sim.run(seconds=0.2)
        assert robot.joints["first"].position == pytest.approx(0.0, abs=1e-6)
        frames = (
            Transform("odom", "base_footprint", np.zeros((1, 3)), from_yaw(np.array([0.6]))),
            Transform("base_footprint", "base_link", np.zeros((1, 3)), np.array([UPRIGHT])),
        )
        robot.inputs["drive frames"].send(Transforms(0, frames))
        sim.run(seconds=1.0)
        assert robot.joints["first"].position == pytest.approx(-0.6, abs=2e-3)
        state = sim.snapshot()
        sim.run(seconds=0.1)
        expected = robot.joints["first"].position
        robot.inputs["drive"].send(TurnCommand("base_link", UPRIGHT))
        sim.restore(state)
        sim.run(seconds=0.1)
        assert robot.joints["first"].position == pytest.approx(expected)
        sim.reset()
        sim.run(seconds=0.5)
        # Commands are forgotten, and nobody tells of base_stabilized.
        assert robot.joints["first"].position == pytest.approx(0.0, abs=1e-6)


def test_orders_of_axes_that_are_not_known_are_named():
    with pytest.raises(PluginWarning, match="'yz'"):
        simulate(head("yz"), ground=False)


yaws = st.lists(st.floats(-3.0, 3.0), min_size=2, max_size=5)


@given(yaws=yaws, data=st.data())
def test_a_turn_between_heard_frames_does_not_depend_on_the_way(yaws, data):
    """A tree of frames about one axis: the turn is the difference of the sums."""
    frames, total = ReceivedFrames(2), {"f0": 0.0}
    for i, yaw in enumerate(yaws, start=1):
        parent = data.draw(st.sampled_from(sorted(total)))
        one = Transform(f"/{parent}", f"f{i}", np.zeros((1, 3)), from_yaw(np.array([yaw])))
        frames.receive(Transforms(0, (one,)), None)
        total[f"f{i}"] = total[parent] + yaw
    target, source = (data.draw(st.sampled_from(sorted(total))) for _ in range(2))
    turn = frames.turn(target, source)
    difference = total[source] - total[target]
    assert np.abs(turn[0] @ from_yaw(np.array([difference]))[0]) == pytest.approx(1.0)
    assert frames.turn("f0", "nowhere") is None


def test_frames_that_turn_in_a_circle_end():
    frames = ReceivedFrames(1)
    for parent, child in (("a", "b"), ("b", "a")):
        one = Transform(parent, child, np.zeros((1, 3)), np.array([UPRIGHT]))
        frames.receive(Transforms(0, (one,)), None)
    assert frames.turn("c", "a") is None


def test_a_reset_is_told():
    tags = plugin("libhector_gazebo_reset_plugin.so")
    with simulate(block(plugin=tags), ground=False) as sim:
        output = sim.robots["cube"].outputs["syscommand"]
        heard = []
        output.subscribe(heard.append)
        sim.run(seconds=0.1)
        assert heard == []
        sim.reset()
        sim.reset(time=False)
        assert heard == ["reset", "reset"]
        assert (output.topic, output.event) == ("/syscommand", True)
