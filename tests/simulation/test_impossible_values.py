"""Values that cannot be are one error of Gazelle's, at the place where they are given."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
import scenes

import gazelle
from gazelle import formats
from gazelle.description import Pose
from gazelle.engines.laws import with_profile
from gazelle.engines.mujoco import to_mjcf
from gazelle.engines.planar import Body, Fan, Fleet, Mount, RangeNoise
from gazelle.errors import EngineError, Error, SimulationError
from gazelle.stage import StageSimulation
from gazelle.streams import Stream

NAN, INF = math.nan, math.inf
ENGINES = ["mujoco", "planar"]


def world_of(text):
    return formats.load_string(f'<sdf version="1.6"><world name="w">{text}</world></sdf>')


def refuses(match, call):
    """Check for an error of ours that says what was wrong, in one line."""
    with pytest.raises(Error, match=match) as caught:
        call()
    assert "\n\n" not in str(caught.value)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("step", [1e-300, 1e-10, 1e7, 1e308, 0.0, -1.0, NAN, INF, "a", [1.0]])
def test_a_physics_step_that_no_clock_counts(engine, step):
    refuses("physics step", lambda: gazelle.Simulation(scenes.world(), engine, time_step=step))
    if isinstance(step, float):
        refuses(
            "physics step|max_step_size is nan",
            lambda: gazelle.Simulation(
                with_profile(scenes.world(), replace(scenes.world().profile, max_step_size=step)),
                engine,
            ),
        )


@pytest.mark.parametrize("step", ["1e-300", "1e-10", "1e308"])
def test_a_physics_step_of_a_file(step):
    text = f'<physics type="ode"><max_step_size>{step}</max_step_size></physics>'
    refuses("physics step", lambda: gazelle.Simulation(world_of(text)))


@pytest.mark.parametrize("step", [1e-9, 1e-6, 10.0])
def test_a_step_that_is_odd_but_possible_runs(step):
    with gazelle.Simulation(scenes.world(), time_step=step) as sim:
        sim.step(3)
        assert sim.clock.now == pytest.approx(3 * step)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("name", ["a::b", "::", "a::"])
def test_a_name_with_what_parts_names(engine, name):
    world = scenes.world(scenes.box(name, static=True))
    refuses("parts the names", lambda: gazelle.Simulation(world, engine))
    with gazelle.Simulation(scenes.world(), engine) as sim:
        refuses("parts the names", lambda: sim.spawn(scenes.box(), name=name))


@pytest.mark.parametrize("given", [None, 3, 1.5, True, [], {}, b"empty", object()])
def test_what_is_neither_a_world_nor_a_name(given):
    for call in (gazelle.Simulation, gazelle.load, StageSimulation):
        refuses(".", lambda call=call: call(given))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("field", ["gravity", "wind", "magnetic_field"])
@pytest.mark.parametrize("value", [INF, -INF, NAN])
def test_laws_that_are_not_finite(engine, field, value):
    numbers = (value, 0.0, 0.0)
    refuses(
        "must be finite|is .nan",
        lambda: gazelle.Simulation(replace(scenes.world(), **{field: numbers}), engine),
    )


@pytest.mark.parametrize("seed", ["a", "1", b"a", 1.5, NAN, [1], None])
def test_seeds_are_ints(seed):
    refuses("seed must be an int", lambda: gazelle.Simulation("empty", seed=seed))
    refuses("seed must be an int", lambda: Stream(seed, "name", 1))
    refuses("seed must be an int", lambda: StageSimulation("fleet.world", seed=seed))
    if seed is not None:
        with gazelle.Simulation("empty") as sim:
            refuses("seed must be an int", lambda: sim.reset(seed=seed))


@pytest.mark.parametrize("seed", [0, -1, 2**80, np.int64(7), np.uint8(3)])
def test_any_int_is_a_seed(seed):
    with gazelle.Simulation("empty", seed=seed) as sim:
        assert sim.seed == int(seed)
        sim.reset(seed=seed)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("count", [0, -1, 1.5, "a", NAN, 10**30])
def test_numbers_of_worlds_threads_and_steps(engine, count):
    for option in ("nworld", "threads"):
        refuses(option, lambda o=option: gazelle.Simulation("empty", engine, **{o: count}))
    if count != 0:
        with gazelle.Simulation("empty", engine) as sim:
            refuses(".", lambda: sim.step(count))
            refuses("number of steps", lambda: sim.engine.step(count))


@pytest.mark.parametrize("time", ["a", None, -1, NAN, INF, [1]])
def test_times_to_run(time):
    with gazelle.Simulation("empty") as sim:
        refuses("cannot run", lambda: sim.run(seconds=time))


@pytest.mark.parametrize("axis", ["x", "y", "yaw", "z"])
@pytest.mark.parametrize("value", [NAN, INF])
def test_places_of_sensors_on_a_fleet(axis, value):
    with pytest.raises(EngineError, match=f"'{axis}' must be a finite number"):
        Mount(0, **{axis: value})


@pytest.mark.parametrize("value", [NAN, INF, -INF])
def test_beams_and_noise(value):
    good = {"start": 0.0, "step": 0.1, "count": 5, "reach": 4.0, "begin": 0.0}
    for name in ("start", "step", "reach", "begin"):
        with pytest.raises(EngineError, match=f"'{name}' must be a finite number"):
            Fan(**{**good, name: value})
    for name in ("constant", "share"):
        with pytest.raises(EngineError, match=f"'{name}' must be a finite number"):
            RangeNoise(**{name: value})


@pytest.mark.parametrize("count", [-1, 1.5, "a", None, 10**30])
def test_a_fleet_goes_forward_by_whole_steps(count):
    fleet = Fleet([Body(())])
    with pytest.raises(EngineError, match="number of steps"):
        fleet.step(count)


@pytest.mark.parametrize("step", [0.0, -1.0, NAN, INF, 1e-300, 1e308, "a"])
def test_the_step_of_a_fleet(step):
    with pytest.raises(EngineError, match=r"physics step|'time_step' must be a finite number"):
        Fleet([Body(())], time_step=step)


@pytest.mark.parametrize(
    ("quaternion", "match"),
    [
        ((0.0, 0.0, 0.0, 0.0), "all zeros"),
        ((NAN, 0.0, 0.0, 1.0), "finite"),
        ((1.0, 0.0, 0.0), "4 numbers"),
        ("a", "must be numbers"),
    ],
)
def test_orientations(quaternion, match):
    with gazelle.Simulation(scenes.world(scenes.box())) as sim:
        robot = sim.robots["box"]
        for thing in (robot, robot.links["link"]):
            refuses(match, lambda t=thing: t.set_pose((0.0, 0.0, 1.0), quaternion))
        assert robot.position[0].tolist() == [0.0, 0.0, 0.0]


def test_one_orientation_of_zeros_among_many():
    with gazelle.Simulation(scenes.world(scenes.box()), nworld=2) as sim:
        rows = [(0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0, 0.0)]
        refuses("all zeros", lambda: sim.robots["box"].set_pose((0.0, 0.0, 1.0), rows))


@pytest.mark.parametrize("size", [1e-320, 1e-200, 1e200, 1e308])
def test_an_orientation_of_any_length_is_that_turn(size):
    wanted = Pose.from_quaternion((0, 0, 0), (0.0, 0.0, 0.5, 0.5)).quaternion
    given = (0.0, 0.0, size, size)
    assert Pose.from_quaternion((0, 0, 0), given).quaternion == pytest.approx(wanted, rel=1e-3)
    with gazelle.Simulation(scenes.world(scenes.box())) as sim:
        sim.robots["box"].set_pose((0.0, 0.0, 1.0), given)
        assert sim.robots["box"].quaternion[0] == pytest.approx(wanted, rel=1e-3)


@pytest.mark.parametrize("far", [1e308, -1e11, NAN, INF])
def test_places_too_far_away(far):
    refuses(".", lambda: gazelle.Simulation(scenes.world(scenes.box(pose=Pose(y=far)))))
    with gazelle.Simulation(scenes.world(scenes.box())) as sim:
        robot = sim.robots["box"]
        refuses(".", lambda: sim.spawn(scenes.ball(pose=Pose(x=far))))
        refuses(".", lambda: sim.spawn(scenes.ball(), pose=Pose(z=far)))
        refuses(".", lambda: robot.set_pose((far, 0.0, 0.0)))
        refuses(".", lambda: robot.links["link"].set_pose((0.0, far, 0.0)))
        assert tuple(sim.robots) == ("box",)
        sim.step(2)


# -- commands and laws of a running world ------------------------------------------------


def test_a_vector_is_a_command_for_one_world():
    with gazelle.Simulation(scenes.world(scenes.ground(), scenes.burger())) as sim:
        port = sim.robots["burger"].inputs["cmd_vel"]
        port.send(linear=(0.3, 0.2, 0.0), angular=(0.0, 0.0, 0.5))
        assert port.linear.tolist() == [[0.3, 0.2, 0.0]]
        assert port.angular.tolist() == [[0.0, 0.0, 0.5]]


@pytest.mark.parametrize("nworld", [1, 2])
@pytest.mark.parametrize("name", ["linear", "angular"])
@pytest.mark.parametrize(
    "value",
    [
        "x",
        None,
        NAN,
        INF,
        [1.0, 2.0, 3.0, 4.0],
        [[0.1]],
        [],
        np.zeros((5, 3)),
        np.zeros((2, 2)),
        {},
    ],
    ids=str,
)
def test_commands_of_another_shape_change_nothing(nworld, name, value):
    with gazelle.Simulation(scenes.world(scenes.ground(), scenes.burger()), nworld=nworld) as sim:
        port = sim.robots["burger"].inputs["cmd_vel"]
        port.send(linear=0.1, angular=0.2)
        refuses("the command on", lambda: port.send(**{name: value}))
        assert port.linear[:, 0].tolist() == [0.1] * nworld
        assert port.angular[:, 2].tolist() == [0.2] * nworld
        motor = sim.robots["burger"].joints["wheel_left_joint"]
        if np.shape(value) not in ((), (1, 1)) or isinstance(value, str | dict):
            refuses("motor on", lambda: motor.drive(value))


@pytest.mark.parametrize(
    "name", ["time_step", "update_rate", "real_time_factor", "iterations", "max_contacts", "erp"]
)
@pytest.mark.parametrize("value", [INF, NAN, -1, "a", None, [1.0], 10**400])
def test_physics_properties(name, value):
    with gazelle.Simulation(scenes.world(scenes.box())) as sim:
        before = getattr(sim.physics, name)
        with pytest.raises(SimulationError, match=name):
            setattr(sim.physics, name, value)
        assert getattr(sim.physics, name) == before
        sim.step()


@pytest.mark.parametrize("name", ["gravity", "wind", "magnetic_field"])
@pytest.mark.parametrize("value", ["a", None, 1.0, (1.0, 2.0), (INF, 0.0, 0.0), (NAN, 0, 0)])
def test_vectors_of_physics(name, value):
    with gazelle.Simulation(scenes.world(scenes.box())) as sim:
        with pytest.raises(SimulationError, match=name):
            setattr(sim.physics, name, value)
        sim.step()


@pytest.mark.parametrize("step", [1e-300, 1e-10, 1e20])
def test_a_step_of_a_running_world(step):
    with gazelle.Simulation(scenes.world(scenes.box())) as sim:
        refuses("physics step", lambda: setattr(sim.physics, "time_step", step))
        assert sim.physics.time_step == 0.001
        sim.step()


# -- whatever else takes a number --------------------------------------------------------

ODD = ["a", [1.0, 2.0, 3.0], [[1.0, 2.0], [3.0, 4.0]], {}, NAN]


@pytest.mark.parametrize("value", ODD, ids=str)
def test_no_call_leaves_an_error_of_another_library(value):
    with gazelle.Simulation(scenes.world(scenes.ground(), scenes.burger()), nworld=2) as sim:
        robot, parameters = sim.robots["burger"], sim.parameters
        joint, link = robot.joints["wheel_left_joint"], next(iter(robot.links.values()))
        wheel = "burger::wheel_left_link"
        calls = [
            lambda: setattr(joint, "position", value),
            lambda: setattr(joint, "velocity", value),
            lambda: joint.apply_effort(1.0, start=value),
            lambda: joint.apply_effort(1.0, duration=value),
            lambda: joint.add_motor(value),
            lambda: joint.set_properties(damping=value),
            lambda: link.set_properties(mass=value),
            lambda: robot.set_pose((value, value, value, value)),
            lambda: robot.set_pose((0.0, 0.0, 0.0), yaw=value),
            lambda: robot.set_configuration(["wheel_left_joint"], value),
            lambda: robot.inputs["cmd_vel"].send(0.1, worlds=value),
            lambda: sim.engine.set_parameter("link_mass", wheel, value),
            lambda: parameters.link_mass.__setitem__(wheel, value),
            lambda: parameters.pose.__setitem__("burger", value),
            lambda: parameters.lidar_noise.__setitem__("burger::base_footprint::lds", value),
            lambda: parameters.randomize("link_mass", wheel, value, value),
            lambda: sim.reset(worlds=value),
            lambda: sim.run(0.001, rate=value),
            lambda: sim.spawn(value),
            lambda: sim.restore(value),
            lambda: formats.load_string(value),
        ]
        for call in calls:
            refuses(".", call)
        robot.inputs["cmd_vel"].send(0.0)
        sim.step(2)


@pytest.mark.parametrize("name", [None, 3, "no"])
def test_names_that_are_none(name):
    with gazelle.Simulation("empty") as sim:
        for call in (sim.delete, lambda name: gazelle.Simulation("empty", name)):
            refuses("there is no", lambda call=call: call(name))
        refuses("on_fault|there is no", lambda: gazelle.Simulation("empty", on_fault=name))


# -- what every handle does with wrong values ---------------------------------------------


@pytest.mark.parametrize("engine", ENGINES)
def test_worlds_are_named_once_and_in_any_order(engine):
    with gazelle.Simulation(
        scenes.world(scenes.ground(), scenes.burger()), engine, nworld=3
    ) as sim:
        robot = sim.robots["burger"]
        robot.set_pose([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.0, 0.0)])
        assert robot.placement([2, 0]).position[:, 0].tolist() == [2.0, 0.0]
        for unit in robot.sensors.values():
            rows = unit.measure([0, 1, 2])
            assert unit.measure([2, 0]).shape == rows[[2, 0]].shape
            refuses("named once", lambda u=unit: u.measure([0, 0]))
            refuses("named once", lambda u=unit: u.measure([0] * 10_000))
        refuses("named once", lambda: robot.set_pose((0.0, 0.0, 0.0), worlds=[1, 0, 1]))
        refuses("named once", lambda: sim.reset([2, 2]))


@pytest.mark.parametrize("table", ["inputs", "outputs", "services", "settings", "links", "joints"])
def test_a_table_says_what_it_has(table):
    with gazelle.Simulation(scenes.world(scenes.ground(), scenes.burger())) as sim:
        names = getattr(sim.robots["burger"], table)
        for name in ("", "cmd_vell", "::", "a" * 10_000):
            refuses("there is no", lambda name=name: names[name])
            with pytest.raises(KeyError):
                names[name]
            assert names.get(name) is None
        near = sim.robots["burger"].inputs
        refuses("did you mean 'cmd_vel'", lambda: near["cmd_vell"])


@pytest.mark.parametrize(
    "path", ["", ".", "no/such/file", "/dev/null/a", "\x00", "\ud800", "a" * 300]
)
def test_a_recording_that_cannot_be_written(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with gazelle.Simulation("empty") as sim:
        refuses("the recording cannot be written", lambda: sim.record(path))
        sim.step()


@pytest.mark.parametrize("name", ["\x00", "\ud800", "a\x00b"])
def test_names_that_hold_what_is_no_character(name):
    with gazelle.Simulation(scenes.world()) as sim:
        refuses("cannot be called", lambda: sim.spawn(scenes.box(), name=name))
        refuses("cannot be called", lambda: gazelle.Simulation(scenes.world(scenes.box(name))))
        sim.step()


def test_numbers_that_are_too_large_for_any_computer():
    huge = 10**400
    with gazelle.Simulation(scenes.world(scenes.ground(), scenes.burger(), scenes.box())) as sim:
        robot, box = sim.robots["burger"], sim.robots["box"].links["link"]
        joint = robot.joints["wheel_left_joint"]
        calls = [
            lambda: setattr(sim.physics, "gravity", (0.0, 0.0, huge)),
            lambda: setattr(sim.parameters, "gravity", [huge]),
            lambda: sim.parameters.scale_mass(box.name, huge),
            lambda: sim.parameters.scale_mass(box.name, [1.0, 2.0]),
            lambda: sim.run(0.001, rate=huge),
            lambda: sim.run(0.001, rate=1e-320),
            lambda: joint.apply_effort(1.0, start=huge),
            lambda: joint.apply_effort(1.0, start=1e308),
            lambda: joint.apply_effort(1.0, duration=huge),
            lambda: joint.add_motor(huge),
            lambda: joint.drive([huge]),
            lambda: robot.set_pose((0.0, 0.0, 0.0), yaw=[huge]),
            lambda: sim.attach(next(iter(robot.links.values())), box, settling=huge),
            lambda: gazelle.Simulation("empty", time_step=huge),
        ]
        for call in calls:
            refuses(".", call)
        joint.apply_effort(0.0, duration=1e308)
        sim.step()


@pytest.mark.parametrize(("given", "used"), [(2**31 - 1, 1000), (10**5, 1000), (999, 999), (0, 1)])
def test_a_solver_that_finds_nothing_ends(given, used):
    """MuJoCo's goes on for as long as it is allowed to where numbers are no numbers."""
    world = scenes.world(scenes.box())
    ode = replace(world.profile.ode, iters=given)
    text = to_mjcf(with_profile(world, replace(world.profile, ode=ode)))
    found = re.search(r'iterations="(\d+)"', text)
    assert int(found[1] if found else 100) == used
