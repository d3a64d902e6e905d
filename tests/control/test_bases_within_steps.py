"""Controllers of bases act within the physics' steps, without Python, as they do from it, bit by bit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import gazelle
from gazelle import formats
from gazelle.control import POSITION, VELOCITY
from gazelle.control.base_controller import BaseController
from gazelle.control.values import BaseTwist, FourWheelCommand
from gazelle.description import Plugin, Transmission, World
from gazelle.engines.mujoco.step import WorldSteps
from gazelle.engines.mujoco.worlds import RunningWorlds
from tests.control.robots import ROUND, urdf
from tests.control.test_in_physics import base_text

TURN = '<limit lower="-1.5" upper="1.5" effort="5" velocity="9"/>'
SPIN = '<limit effort="5" velocity="90"/>'


GAINS = {"p": 8.0, "d": 0.5}


def rolling(**places):
    return [(name, "continuous", at, ROUND, SPIN) for name, at in places.items()]


def steered(**places):
    return [(name, "revolute", at, ROUND, TURN) for name, at in places.items()]


CORNERS = {"fl": "1 1 0", "fr": "1 -1 0", "rl": "-1 1 0", "rr": "-1 -1 0"}
STEERS = {f"{name}_steer": at for name, at in CORNERS.items()}
LIMITS = {
    "linear": {"x": {"has_acceleration_limits": True, "max_acceleration": 1.0}},
    "angular": {"z": {"has_velocity_limits": True, "max_velocity": 0.8, "has_jerk_limits": True, "max_jerk": 9.0}},
}  # fmt: skip
BASES = {
    "diff_drive_controller/DiffDriveController": (
        urdf(*rolling(left="0 0.2 0.1", right="0 -0.2 0.1")),
        {"left_wheel": "left", "right_wheel": "right"},
    ),
    "ackermann_steering_controller/AckermannSteeringController": (
        urdf(*rolling(rear="0 0 0.1"), *steered(front_steer="0.5 0 0.1")),
        {"rear_wheel": "rear", "front_steer": "front_steer"},
    ),
    "mecanum_drive_controller/MecanumDriveController": (
        urdf(*rolling(**CORNERS)),
        {f"{place}_wheel_joint": name for place, name in zip(
            ("front_left", "front_right", "back_left", "back_right"), CORNERS, strict=True)},
    ),
    "four_wheel_steering_controller/FourWheelSteeringController": (
        urdf(*rolling(**CORNERS), *steered(**STEERS)),
        {"front_wheel": ["fl", "fr"], "rear_wheel": ["rl", "rr"], "wheel_steering_y_offset": 0.05,
         "front_steering": ["fl_steer", "fr_steer"], "rear_steering": ["rl_steer", "rr_steer"]},
    ),
}  # fmt: skip


def based(kind, nworld=3, **more):
    """Return a base in the air, and its controller."""
    model, given = BASES[kind]
    sim = gazelle.Simulation(World("w", gravity=(0.0, 0.0, 0.0)), nworld=nworld)
    drives = [
        Transmission(
            f"{joint.name}_drive",
            "transmission_interface/SimpleTransmission",
            ((joint.name, (POSITION if joint.name.endswith("steer") else VELOCITY,)),),
            ("motor",),
        )
        for joint in model.joints
    ]
    plugin = Plugin("control", "libgazebo_ros_control.so")
    robot = sim.spawn(replace(model, transmissions=tuple(drives), plugins=(plugin,)))
    # Without gains joints are put at their positions, from Python.
    steered = {joint.name: GAINS for joint in model.joints if joint.name.endswith("steer")}
    robot.settings["pid_gains"].send(steered)
    variances = {f"{name}_covariance_diagonal": [0.001] * 6 for name in ("pose", "twist")}
    more = {"cmd_vel_timeout": 0.15, **LIMITS, **more}
    robot.controllers.load("base", {"type": kind, **given, **variances, **more})
    robot.controllers.start("base")
    return sim, robot.controllers["base"]


def run(sim, controller):
    """Run some commands, some of which get too old; return the results."""
    port = controller.inputs["cmd_vel"]
    for k in range(4):
        port.send(BaseTwist((0.4 * (k - 1), 0.1 * k, 0.0), (0.0, 0.0, 0.3 * (2 - k))), [k % 3])
        if "cmd_four_wheel_steering" in controller.inputs and k == 2:
            controller.inputs["cmd_four_wheel_steering"].send(FourWheelCommand(0.3, -0.1, 0.5), [0])
        sim.step(60)
        if k == 2:
            sim.reset([1])
    odometry = controller.odometry
    states = controller.hardware.states
    return [odometry.pose, odometry.twist, controller.memory.last, states.position, states.velocity]


@pytest.mark.parametrize("open_loop", [False, True])
@pytest.mark.parametrize("kind", BASES)
def test_steps_carry_it_and_change_no_bit(kind, open_loop, monkeypatch):
    counts, updates = [], []
    make, update = WorldSteps.make, BaseController.update
    monkeypatch.setattr(
        WorldSteps,
        "make",
        lambda *given: (counts.append(given[1] if given[2] else 0), make(*given))[1],
    )
    monkeypatch.setattr(
        BaseController, "update", lambda *given: (updates.append(1), update(*given))[1]
    )
    sim, controller = based(kind, open_loop=open_loop)
    inside = [each.copy() for each in run(sim, controller)]
    assert sum(counts) == 240
    assert not updates
    sim, controller = based(kind, open_loop=open_loop)
    sim.controls_in_step = False
    outside = run(sim, controller)
    assert len(updates) == 240
    assert np.abs(inside[0]).max() > 0.01
    for one, other in zip(inside, outside, strict=True):
        assert (one == other).all()


@pytest.mark.parametrize("kind", BASES)
def test_python_comes_between_only_when_something_is_published_that_somebody_hears(kind):
    sim, controller = based(kind, publish_cmd=True, publish_rate=20.0)
    quiet, other = based(kind, publish_cmd=True, publish_rate=20.0)
    heard, driven = [], []
    end = controller.outputs["odom"].subscribe(
        lambda odom: heard.append((odom.stamp, odom.position))
    )
    run(sim, controller)
    run(quiet, other)
    # From a period after the start on, at the first update after each.
    assert [stamp for stamp, _ in heard] == [51_000_000, 101_000_000, 151_000_000, 201_000_000]
    assert (controller.odometry.pose == other.odometry.pose).all()
    end()
    controller.outputs["cmd_vel_out"].subscribe(driven.append)
    sim.step(7)
    assert len(driven) == 7
    # Who listens late hears no more than is due: what nobody heard counts as published.
    late = []
    other.outputs["odom"].subscribe(lambda odom: late.append(odom.stamp))
    quiet.step(30)
    assert late == [251_000_000]


def test_where_one_world_cannot_be_measured_the_others_drive_on():
    sim, controller = based("diff_drive_controller/DiffDriveController")
    controller.inputs["cmd_vel"].send(BaseTwist((0.5, 0.0, 0.0)))
    states = controller.hardware.states
    sim.step(20)
    states.position[1, 0] = np.nan
    controller.update(sim.time, 0.001)
    assert controller.memory.lost.tolist() == [False, True, False]
    assert np.isfinite(controller.odometry.pose).all()


@pytest.mark.parametrize("kind", BASES)
def test_a_snapshot_is_continued_to_the_bit(kind):
    sim, controller = based(kind)
    run(sim, controller)
    kept = sim.snapshot()
    run(sim, controller)
    once = controller.odometry.pose.copy(), controller.odometry.twist.copy()
    sim.restore(kept)
    run(sim, controller)
    assert (controller.odometry.pose == once[0]).all()
    assert (controller.odometry.twist == once[1]).all()


def test_robots_of_a_world_are_compiled_together_however_many_have_motors(monkeypatch):
    """Each robot's plugin puts motors on wheels; with a model made for each, 100 took two minutes."""
    counts = []
    change = RunningWorlds.change
    monkeypatch.setattr(
        RunningWorlds, "change", lambda *given: (counts.append(1), change(*given))[1]
    )
    model = formats.load_model_string(base_text())
    many = tuple(replace(model, name=f"r{i}", pose=gazelle.Pose(y=2.0 * i)) for i in range(6))
    sim = gazelle.Simulation(World("w", models=many))
    for each in many:
        assert set(sim.robots[each.name].joints) == {"left_wheel", "right_wheel"}
    sim.step()
    assert len(counts) <= 2
