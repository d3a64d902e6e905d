"""Transmissions that count: actuators behind joints, by the formulas of transmission_interface."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import gazelle
from gazelle import formats
from gazelle.control import EFFORT, Controller, register
from gazelle.control.actuators import ACTUATOR_STATE, ActuatorStateInterface, drive_of
from gazelle.control.interfaces import JointStateInterface
from gazelle.control.values import JointTargets
from gazelle.description import Transmission, World
from gazelle.errors import ControlError, ControlWarning
from tests.control.arms import JOINTS, arm_text
from tests.control.robots import LINK

BODY = LINK.format(name="body", shape='<sphere radius="1"/>')
KINDS = ("SimpleTransmission", "DifferentialTransmission", "FourBarLinkageTransmission")


def text_of(kind, actuators, joints=(1.0, 1.0), offsets=(0.0, 0.0), roles=(1, 2)):
    """Return a transmission of two joints, as URDF has it; ``roles`` is the order in the file."""
    parts = [f'<transmission name="both"><type>transmission_interface/{kind}</type>']
    parts += [
        f'<joint name="{JOINTS[number - 1]}"><role>joint{number}</role><offset>{offsets[number - 1]}</offset>'
        f"<mechanicalReduction>{joints[number - 1]}</mechanicalReduction>"
        "<hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>"
        for number in roles
    ]
    parts += [
        f'<actuator name="m{number}"><role>actuator{number}</role>'
        f"<mechanicalReduction>{actuators[number - 1]}</mechanicalReduction></actuator>"
        for number in roles
    ]
    return "".join([*parts, "</transmission>"])


def with_transmissions(text, nworld=2, use=True):
    """Return the two-link arm, with these transmissions in place of its own."""
    whole = arm_text("Effort")
    begin, end = whole.index("<transmission"), whole.index("<gazebo>")
    model = formats.load_model_string(whole[:begin] + text + whole[end:])
    sim = gazelle.Simulation(World("w", gravity=(0.0, 0.0, 0.0)), nworld=nworld)
    robot = sim.spawn(model)
    if use:
        robot.settings["use_transmissions"].send(True)
    return sim, robot


def expected(kind, a, j, offsets, position, velocity, effort):
    """Return actuators from joints, by the pages of transmission_interface."""
    p, v = np.subtract(position, offsets), np.asarray(velocity)
    if kind == "DifferentialTransmission":

        def back(x):
            return [a[0] * (x[0] * j[0] + x[1] * j[1]), a[1] * (x[0] * j[0] - x[1] * j[1])]

        force = [
            (effort[0] / j[0] + effort[1] / j[1]) / (2 * a[0]),
            (effort[0] / j[0] - effort[1] / j[1]) / (2 * a[1]),
        ]
    else:

        def back(x):
            return [x[0] * j[0] * a[0], (x[0] + x[1] * j[1]) * a[1]]

        force = [effort[0] / (j[0] * a[0]), (effort[0] + effort[1] / j[1]) / a[1]]
    return back(p), back(v), force


RATIO = st.one_of(st.floats(0.1, 50.0), st.floats(-50.0, -0.1))
PAIR = st.tuples(RATIO, RATIO)
VALUES = st.tuples(st.floats(-50, 50), st.floats(-50, 50))


@given(
    st.sampled_from(KINDS[1:]),
    PAIR,
    PAIR,
    VALUES,
    VALUES,
    VALUES,
    VALUES,
    st.sampled_from([(1, 2), (2, 1)]),
)
def test_two_actuators_turn_as_the_closed_form_says(kind, a, j, offsets, p, v, e, roles):
    text = f'<robot name="r">{BODY}{text_of(kind, a, j, offsets, roles)}</robot>'
    (read,) = formats.load_model_string(text).transmissions
    states = JointStateInterface(JOINTS, 1)
    states.position, states.velocity, states.effort = p, v, e
    found = ActuatorStateInterface([drive_of(read)], states)
    assert found.resources == ("m1", "m2")
    for got, wanted in zip(
        (found.position, found.velocity, found.effort),
        expected(kind, a, j, offsets, p, v, e),
        strict=True,
    ):
        assert got[0] == pytest.approx(wanted, rel=1e-6, abs=1e-6 * (1 + np.abs(wanted).max()))


@given(RATIO, st.floats(-9, 9), st.floats(-50, 50))
def test_one_actuator_turns_by_the_reduction_from_the_offset(reduction, offset, value):
    drive = drive_of(
        Transmission(
            "t",
            "transmission_interface/SimpleTransmission",
            (("shoulder", (EFFORT,)),),
            (("m", reduction),),
            (offset,),
        )
    )
    states = JointStateInterface(["shoulder"], 1)
    states.position, states.velocity, states.effort = value, value, value
    found = ActuatorStateInterface([drive], states).handles(["m"])
    assert found.position == pytest.approx((value - offset) * reduction)
    assert found.velocity == pytest.approx(value * reduction)
    assert found.effort == pytest.approx(value / reduction)


def test_joints_of_two_are_left_out_until_the_option_is_set():
    text = text_of("DifferentialTransmission", (10.0, -20.0))
    with pytest.warns(ControlWarning, match="unless use_transmissions is set"):
        _, robot = with_transmissions(text, use=False)
    hardware = robot.controllers.hardware
    assert ACTUATOR_STATE not in hardware.interfaces
    assert EFFORT not in hardware.interfaces
    with pytest.warns(ControlWarning, match="left out"):
        robot.settings["use_transmissions"].send(False)
    robot.settings["use_transmissions"].send(True)
    hardware = robot.controllers.hardware
    assert set(hardware.interface(EFFORT).resources) == set(JOINTS)
    assert robot.settings["use_transmissions"].name == "/arm/gazebo_ros_control/use_transmissions"


@pytest.mark.parametrize("kind", KINDS[1:])
def test_a_controller_reads_the_actuators_of_joints_that_move(kind):
    sizes = (10.0, -20.0), (2.0, 1.5), (0.3, -0.4)
    with pytest.warns(ControlWarning, match="left out"):
        sim, robot = with_transmissions(text_of(kind, *sizes))
    read = {}

    class Encoders(Controller):
        interfaces = (ACTUATOR_STATE,)

        def init(self, parameters):
            self._motors = self.resources(ACTUATOR_STATE, parameters.names("actuators"))

        def update(self, time, period):
            read.update(
                position=self._motors.position,
                velocity=self._motors.velocity,
                effort=self._motors.effort,
            )

    register("tests/Encoders", Encoders)
    manager = robot.controllers
    manager.load("encoders", {"type": "tests/Encoders", "actuators": ["m2", "m1"]})
    manager.load("arm", {"type": "effort_controllers/JointGroupEffortController", "joints": JOINTS})
    manager.start("encoders", "arm")
    manager["arm"].inputs["command"].send(JointTargets([[3.0, -1.0], [-2.0, 0.5]]))
    sim.step(50)
    states = manager.hardware.states
    for w in range(2):
        wanted = expected(kind, *sizes, states.position[w], states.velocity[w], states.effort[w])
        for got, each in zip(
            (read["position"], read["velocity"], read["effort"]), wanted, strict=True
        ):
            assert got[w, ::-1] == pytest.approx(each, rel=1e-9)
    assert np.abs(states.velocity).min() > 1e-3


def test_by_default_reduction_and_offset_count_for_nothing_and_with_the_option_not_for_joints():
    moved = []
    for use in (False, True):
        text = arm_text("Effort").replace("<mechanicalReduction>2<", "<mechanicalReduction>-7<")
        sim = gazelle.Simulation(World("w"))
        robot = sim.spawn(formats.load_model_string(text))
        robot.settings["use_transmissions"].send(use)
        manager = robot.controllers
        manager.load(
            "arm", {"type": "effort_controllers/JointGroupEffortController", "joints": JOINTS}
        )
        manager.start("arm")
        manager["arm"].inputs["command"].send(JointTargets([3.0, -1.0]))
        sim.step(50)
        moved.append(manager.hardware.states.position.copy())
        assert (ACTUATOR_STATE in manager.hardware.interfaces) is use
    assert (moved[0] == moved[1]).all()
    actuators = manager.hardware.interface(ACTUATOR_STATE)
    assert actuators.resources == ("shoulder_motor", "elbow_motor")
    assert actuators.position[0] == pytest.approx(moved[1][0] * [1.0, -7.0])


GOOD = Transmission(
    "t", "transmission_interface/DifferentialTransmission",
    (("a", (EFFORT,)), ("b", (EFFORT,))), (("m", 1.0), ("n", 1.0)),
)  # fmt: skip


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"type": "transmission_interface/DiferentialTransmission"}, "did you mean"),
        ({"type": "transmission_interface/SimpleTransmission"}, "2 joints and 2 actuators"),
        ({"actuators": (("m", 1.0),)}, "2 joints and 1 actuators"),
        (
            {"actuators": (("m", 0.0), ("n", 1.0))},
            "'t': reductions of a transmission cannot be zero",
        ),
        ({"joint_roles": ("joint1", "joint3")}, "must be joint1 and joint2"),
        ({"actuator_roles": ("actuator1", "actuator1")}, "must be actuator1 and actuator2"),
    ],
)
def test_what_cannot_be_is_said(changes, said):
    with pytest.raises(ControlError, match=said):
        drive_of(replace(GOOD, **changes))
    drive = drive_of(GOOD)
    with pytest.raises(ControlError, match="two transmissions have an actuator 'm'"):
        ActuatorStateInterface([drive, drive], JointStateInterface(["a", "b"], 1))


def test_writers_keep_offsets_reductions_and_roles():
    text = text_of("FourBarLinkageTransmission", (10.0, -20.0), (2.0, 1.5), (0.3, -0.4), (2, 1))
    model = formats.load_model_string(f'<robot name="r">{BODY}{text}</robot>')
    (one,) = model.transmissions
    assert one.offsets == (-0.4, 0.3)
    assert one.joint_reductions == (1.5, 2.0)
    assert one.joint_roles == ("joint2", "joint1")
    assert one.actuator_roles == ("actuator2", "actuator1")
    written = formats.to_string(model, "urdf")
    assert formats.load_model_string(written).transmissions == (one,)
