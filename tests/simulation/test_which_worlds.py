"""Every call that takes worlds refuses those that are not there, in the same words."""

import inspect

import numpy as np
import pytest
import scenes

import gazelle
from gazelle.errors import SimulationError
from gazelle.planning import Group, RobotGripper
from gazelle.sensors import View, look_at
from gazelle.simulation import (
    Input,
    JointHandle,
    LinkHandle,
    Robot,
    SensorUnit,
    Service,
    Simulation,
    TwistInput,
    WorldParameters,
)
from gazelle.simulation.parameters import Parameter
from gazelle.viewer import LiveView, SceneCamera

NWORLD = 3
WRONG = ([-1], [0, 7], [3], [True, False], -1, [0.5], "all", [[0]], [[0], [1, 2]], [2**70])
ZERO, UP = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)
WHEEL = "wheel_left_joint"

# What comes before ``worlds`` in a call, by class and method.
CALLS = {
    JointHandle: {
        "apply_effort": (0.1,),
        "drive": (0.1,),
        "motor_effort": (),
        "positions": (),
        "set_position": (0.1,),
        "set_properties": (),
        "set_velocity": (0.1,),
        "velocities": (),
        "wrench": (),
    },
    LinkHandle: {
        "apply_wrench": (),
        "approach": (ZERO, UP),
        "motion": (),
        "placement": (),
        "set_pose": (ZERO,),
        "set_properties": (),
        "set_twist": (ZERO, ZERO),
    },
    Robot: {
        "motion": (),
        "placement": (),
        "planar_pose": (),
        "set_configuration": ([WHEEL], [0.1]),
        "set_pose": (ZERO,),
        "set_twist": (ZERO, ZERO),
        "wrench": (WHEEL,),
    },
    SensorUnit: {"measure": ()},
    TwistInput: {"send": (0.1, 0.1), "clear": ()},
    Simulation: {"reset": (), "state_hash": (), "attach": (), "detach": ()},
    WorldParameters: {"randomize": ("gravity", "", ZERO, ZERO)},
    Parameter: {"set": ("burger::base_footprint", 1.0)},
    Input: {"send": (None,), "clear": ()},
    Service: {"call": (None,)},
}

# Called by the owner of the state, with worlds that were looked at before.
INNER = {"reset", "reseed", "apply"}


@pytest.fixture(scope="module")
def sim():
    with Simulation(
        scenes.world(scenes.ground(), scenes.burger()), nworld=NWORLD, threads=1
    ) as sim:
        sim.robots["burger"].joints[WHEEL].add_motor(1.0)
        yield sim


def thing(sim, kind):
    robot = sim.robots["burger"]
    accept = Input("topic", object, lambda *_: None, forget=lambda _: None)
    answer = Service("topic", None, None, lambda *_: None)
    for each in (accept, answer):
        each.bind(sim.lock)
    return {
        JointHandle: robot.joints[WHEEL],
        LinkHandle: robot.links["wheel_left_link"],
        Robot: robot,
        SensorUnit: robot.sensors["lds"],
        TwistInput: TwistInput(NWORLD, "cmd_vel"),
        Simulation: sim,
        WorldParameters: sim.parameters,
        Parameter: sim.parameters.link_mass,
        Input: accept,
        Service: answer,
    }[kind]


@pytest.mark.parametrize("kind", CALLS)
def test_no_call_that_takes_worlds_is_forgotten_here(kind):
    takes = {
        name
        for name, method in inspect.getmembers(kind, inspect.isroutine)
        if not name.startswith("_") and "worlds" in inspect.signature(method).parameters
    }
    assert takes - (INNER if kind is not Simulation else set()) == set(CALLS[kind])


@pytest.mark.parametrize("wrong", WRONG, ids=str)
@pytest.mark.parametrize(("kind", "name"), [(k, n) for k, names in CALLS.items() for n in names])
def test_worlds_that_are_not_there_are_refused(sim, kind, name, wrong):
    before = None if kind is Input or kind is Service else sim.snapshot()
    arguments = CALLS[kind][name]
    if name in ("attach", "detach"):
        arguments = (sim.robots["burger"].links["base_footprint"], thing(sim, LinkHandle))
    with pytest.raises(SimulationError, match="worlds must be in 0 to 2, or a mask of 3, not "):
        getattr(thing(sim, kind), name)(*arguments, worlds=wrong)
    assert before is None or sim.snapshot() == before


@pytest.mark.parametrize("worlds", [[2, 0], [True, False, True], 1, np.array([1], np.uint8), []])
@pytest.mark.parametrize("name", ["positions", "velocities", "set_position", "set_velocity"])
def test_worlds_that_are_there_are_taken(sim, name, worlds):
    getattr(thing(sim, JointHandle), name)(*CALLS[JointHandle][name], worlds=worlds)


@pytest.mark.parametrize("world", [-1, 3, 99, 0.5, "0", None])
def test_a_single_world_that_is_not_there_is_refused(sim, world):
    robot = sim.robots["burger"]
    calls = [
        lambda: robot.sensors["lds"].read(world),
        lambda: sim.render(View(look_at((1.0, 1.0, 1.0), ZERO), 20, 20), world),
        lambda: SceneCamera(sim, world=world),
        lambda: LiveView(sim, world=world),
        lambda: Group(robot, "arm", world=world),
        lambda: RobotGripper(robot, world=world),
        lambda: gazelle.serve_ros(sim, world=world),
    ]
    for call in calls:
        with pytest.raises(SimulationError, match=r"there is no world .*; worlds are 0 to 2"):
            call()
