"""Public robots with ``libgazebo_ros_control.so`` come up, publish and move, unchanged."""

from __future__ import annotations

import warnings
from dataclasses import replace

import numpy as np
import pytest

import gazelle
from gazelle import formats
from gazelle.control import EFFORT, POSITION, VELOCITY
from gazelle.control.values import JointTargets
from gazelle.description import World

ROBOTS = {
    "husarion__rosbot_description/src/rosbot_description/urdf/rosbot.xacro": {EFFORT: 4},
    "ROBOTIS-GIT__open_manipulator/open_manipulator_description/urdf/open_manipulator_robot.urdf.xacro": {
        EFFORT: 2,
        POSITION: 4,
    },
    "ros-simulation__gazebo_ros_demos/rrbot_description/urdf/rrbot.xacro": {EFFORT: 2},
    "ros-simulation__gazebo_ros_demos/rrbot_description/urdf/rrbot.xml": {EFFORT: 2},
    "ros__urdf_sim_tutorial/urdf/10-firsttransmission.urdf.xacro": {POSITION: 1},
    "ros__urdf_sim_tutorial/urdf/11-limittransmission.urdf.xacro": {POSITION: 1},
    "ros__urdf_sim_tutorial/urdf/12-gripper.urdf.xacro": {POSITION: 4},
    "ros__urdf_sim_tutorial/urdf/13-diffdrive.urdf.xacro": {POSITION: 4, VELOCITY: 4},
    "chvmp__champ/champ_description/urdf/champ.urdf": {EFFORT: 12},
    "chvmp__champ/champ_description/urdf/champ.urdf.xacro": {EFFORT: 12},
    "chvmp__champ/champ_description/urdf/champ_arm.urdf": {EFFORT: 12},
    "chvmp__champ/champ_description/urdf/champ_velodyne.urdf": {EFFORT: 12},
    "ros-controls__ros_controllers/four_wheel_steering_controller/test/urdf/four_wheel_steering.urdf.xacro": {
        POSITION: 4,
        VELOCITY: 4,
    },
}
# A plugin of its own keeps motors on the wheels that hold them with 5 N m, and the file lets efforts be
# 1 N m at most: no controller can turn them, in Gazebo neither.
HELD = {"husarion__rosbot_description/src/rosbot_description/urdf/rosbot.xacro": "skid_steer"}
SMALL = {EFFORT: 1.0, POSITION: 0.05, VELOCITY: 0.5}


def brought_up(path, without):
    """Return a simulation with the robot of a file, without one plugin."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what else its file holds is not the matter here
        model = formats.load_model(path)
        plugins = tuple(each for each in model.plugins if without not in each.filename)
        sim = gazelle.Simulation(World("w"))
        return sim, sim.spawn(replace(model, plugins=plugins))


@pytest.mark.slow
@pytest.mark.parametrize("path", HELD)
def test_wheels_that_another_plugin_holds_do_not_move(path, corpus):
    sim, robot = brought_up(corpus / path, "none is called so")
    names = list(robot.controllers.hardware.interface(EFFORT).resources)
    of = "effort_controllers/JointGroupEffortController"
    robot.controllers.load("wheels", {"type": of, "joints": names})
    robot.controllers.start("wheels")
    robot.controllers["wheels"].inputs["command"].send(JointTargets([100.0] * len(names)))
    sim.run(0.2)
    assert robot.controllers.hardware.states.effort[0] == pytest.approx(1.0)
    assert np.abs(robot.controllers.hardware.states.velocity).max() < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("path", ROBOTS)
def test_it_comes_up_publishes_and_moves(path, corpus):
    sim, robot = brought_up(corpus / path, HELD.get(path, "none is called so"))
    manager = robot.controllers
    offered = {
        kind: each.resources for kind, each in manager.hardware.interfaces.items() if each.claims
    }
    assert {kind: len(names) for kind, names in offered.items()} == ROBOTS[path]
    told = []
    manager.load(
        "states", {"type": "joint_state_controller/JointStateController", "publish_rate": 50}
    )
    manager["states"].outputs["joint_states"].subscribe(told.append)
    manager.start("states")
    for kind, names in offered.items():
        word = kind.split("/")[1].removesuffix("JointInterface")
        of = f"{word.lower()}_controllers/JointGroup{word}Controller"
        manager.load(word, {"type": of, "joints": list(names)})
        manager.start(word)
        targets = JointTargets([SMALL[kind]] * len(names))
        manager[word].inputs["command"].send(targets)
    sim.run(0.3)
    assert 14 <= len(told) <= 16
    assert np.isfinite(told[-1].position).all()
    moved = np.ptp([each.position[0] for each in told], axis=0)
    assert (moved > 1e-4).any()
