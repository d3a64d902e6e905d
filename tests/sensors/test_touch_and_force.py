"""Force-torque and contact sensors against statics."""

import math
import warnings

import numpy as np
import pytest
import scenes

from gazelle.description import (
    ContactSensor,
    Inertia,
    Inertial,
    Joint,
    Link,
    Model,
    Noise,
    Parameters,
    Pose,
    Sensor,
)
from gazelle.engines import make_engine
from gazelle.errors import FormatError, SimulationError, SimulationWarning
from gazelle.sensors import ForceTorque, ForceTorqueModel
from gazelle.simulation import Simulation

G = 9.8


def scale(tilt=0.4, sensor_pose=None, settings=None, joint_sensors=()):
    """Return two kilograms held half a metre ahead by a fixed joint, the holder tilted about x."""
    base = Link("base", pose=Pose(roll=tilt), inertial=Inertial())
    load = Link(
        "load",
        pose=Pose(roll=tilt) * Pose(yaw=0.3),
        inertial=Inertial(2.0, Pose(0.5), Inertia(0.01, 0.01, 0.01)),
    )
    joints = (
        Joint("hold", "fixed", "world", "base"),
        Joint("scale", "fixed", "base", "load", sensors=joint_sensors),
    )
    engine = make_engine("mujoco", scenes.world(Model("m", links=(base, load), joints=joints)))
    model = ForceTorqueModel(
        settings or ForceTorque(),
        engine,
        "m::scale",
        ("m::base", "m::load"),
        sensor_pose or Pose(),
        0,
        "ft",
    )
    return engine, model


def in_frame(pose, vector):
    return pose.inverse().rotate(vector)


LOAD = Pose(roll=0.4) * Pose(yaw=0.3)
WEIGHT = (0.0, 0.0, -2.0 * G)


@pytest.mark.parametrize(
    ("frame", "axes"),
    [
        ("child", LOAD),
        ("parent", Pose(roll=0.4)),
        ("sensor", LOAD * Pose(pitch=-0.7)),
    ],
)
@pytest.mark.parametrize(("direction", "sign"), [("child_to_parent", 1), ("parent_to_child", -1)])
def test_a_wrench_is_in_the_frame_and_direction_that_the_file_asks_for(
    frame, axes, direction, sign
):
    _, model = scale(sensor_pose=Pose(pitch=-0.7), settings=ForceTorque(frame, direction))
    reading = model.reading(model.measure()[0], 7)
    lever = LOAD.rotate((0.5, 0.0, 0.0))
    torque = np.cross(lever, WEIGHT)
    assert reading.stamp == 7
    np.testing.assert_allclose(reading.force, sign * np.array(in_frame(axes, WEIGHT)), atol=1e-9)
    np.testing.assert_allclose(reading.torque, sign * np.array(in_frame(axes, torque)), atol=1e-9)


def test_settings_are_read_and_noise_falls_on_its_axis():
    noise = Parameters(
        "noise", attributes={"type": "gaussian"}, children=(Parameters("stddev", "0.5"),)
    )
    force = Parameters("force", children=(Parameters("y", children=(noise,)),))
    inner = Parameters(
        "force_torque",
        children=(
            Parameters("frame", "sensor"),
            Parameters("measure_direction", "parent_to_child"),
            force,
        ),
    )
    settings = ForceTorque.read(Parameters("sensor", children=(inner,)))
    assert (settings.frame, settings.direction) == ("sensor", "parent_to_child")
    assert settings.noises["force/y"] == Noise("gaussian", stddev=0.5)
    engine, _ = scale()
    model = ForceTorqueModel(settings, engine, "m::scale", ("m::base", "m::load"), Pose(), 3, "ft")
    many = np.array([model.measure()[0] for _ in range(300)])
    np.testing.assert_allclose(np.delete(many.std(axis=0), 1), 0.0, atol=1e-12)
    assert many[:, 1].std() == pytest.approx(0.5, rel=0.15)


def test_a_frame_that_does_not_exist_is_an_error():
    inner = Parameters("force_torque", children=(Parameters("frame", "world"),))
    with pytest.raises(FormatError, match="child, parent, sensor, found 'world'"):
        ForceTorque.read(Parameters("sensor", children=(inner,)))


def standing_box(sensor, **options):
    box = scenes.box(pose=Pose(z=0.1), mass=3.0)
    link = Link(
        "link",
        inertial=box.links[0].inertial,
        collisions=box.links[0].collisions,
        sensors=(sensor,),
    )
    model = Model("box", pose=Pose(z=0.1), links=(link,))
    return Simulation(scenes.world(scenes.ground(), model), **options)


def test_a_bumper_tells_what_it_touches_and_how_hard():
    sensor = Sensor("bumper", "contact", update_rate=50.0, contact=ContactSensor(("c",)))
    with standing_box(sensor, nworld=2) as sim:
        sim.robots["box"].set_pose((0.0, 0.0, 50.0), worlds=np.array([1]))
        sim.run(seconds=1.0)
        unit = sim.robots["box"].sensors["bumper"]
        touching = unit.read(world=0).contacts
        assert set(touching.others) == {"ground_plane::link::c"}
        assert set(touching.collisions) == {"box::link::c"}
        assert touching.force[:, 2].sum() == pytest.approx(3.0 * G, rel=0.01)
        assert len(unit.read(world=1).contacts) == 0


def test_names_in_readings_survive_a_snapshot_into_another_simulation():
    sensor = Sensor("bumper", "contact", contact=ContactSensor(("c",)))
    with standing_box(sensor) as sim, standing_box(sensor) as other:
        sim.run(seconds=0.5)
        sim.robots["box"].sensors["bumper"].read()
        other.restore(sim.snapshot())
        assert other.robots["box"].sensors["bumper"].read().contacts.others[0] == (
            "ground_plane::link::c"
        )


def test_a_sensor_that_watches_what_is_not_there_says_so():
    sensor = Sensor("bumper", "contact", contact=ContactSensor(("other",)))
    with (
        pytest.warns(SimulationWarning, match="watches 'other'.*it has: c"),
        standing_box(sensor) as sim,
    ):
        assert len(sim.robots["box"].sensors["bumper"].read().contacts) == 0


def test_a_sensor_on_a_joint_of_a_file_is_read_by_its_name():
    ft = Sensor("ft", "force_torque", update_rate=100.0)
    links = (
        Link("a", inertial=Inertial()),
        Link("b", inertial=Inertial(2.0, Pose(), Inertia(0.01, 0.01, 0.01))),
    )
    joints = (
        Joint("hold", "fixed", "world", "a"),
        Joint("j", "fixed", "a", "b", sensors=(ft,)),
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        sim = Simulation(scenes.world(Model("m", links=links, joints=joints)))
    with sim:
        reading = sim.robots["m"].sensors["ft"].read()
        np.testing.assert_allclose(sim.robots["m"].wrench("j").force, [reading.force], atol=1e-9)
        with pytest.raises(SimulationError, match="no joint"):
            sim.robots["m"].wrench("k")
        np.testing.assert_allclose(reading.force, [0.0, 0.0, -2.0 * G], atol=1e-9)
        assert math.isclose(reading.stamp, 0)


def test_a_force_sensor_of_a_model_that_never_moves_is_left_out_with_a_warning():
    ft = Sensor("ft", "force_torque")
    links = (Link("a"), Link("b"))
    joints = (Joint("j", "fixed", "a", "b", sensors=(ft,)),)
    with (
        pytest.warns(SimulationWarning, match="'m::j::ft'.*is not measured yet.*is static"),
        Simulation(scenes.world(Model("m", static=True, links=links, joints=joints))) as sim,
    ):
        assert "ft" not in sim.robots["m"].sensors
