"""Cameras of a running simulation: what they see, when, and that it can be put back."""

import numpy as np
import pytest

import gazelle
from gazelle.errors import SimulationWarning
from gazelle.formats import load_string

WORLD = """<sdf version="1.6"><world name="w">
<light name="sun" type="directional"><direction>1 0 -0.3</direction>
<diffuse>0.8 0.8 0.8 1</diffuse></light>
<model name="red"><static>1</static><pose>3 0 0.5 0 0 0</pose><link name="l"><visual name="v">
<geometry><box><size>1 1 1</size></box></geometry>
<material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual></link></model>
<model name="robot"><pose>0 0 0.5 0 0 0</pose><link name="base"><gravity>0</gravity>
<inertial><mass>1</mass></inertial>
<sensor type="{kind}" name="camera"><update_rate>10</update_rate><pose>0.1 0 0 0 0 0</pose>
<camera name="left"><horizontal_fov>1.0</horizontal_fov><image><width>64</width>
<height>48</height></image><clip><near>0.05</near><far>20</far></clip>{inner}</camera>{more}
</sensor></link></model></world></sdf>"""


def simulation(kind="camera", inner="", more="", **options):
    world = load_string(WORLD.format(kind=kind, inner=inner, more=more))
    return gazelle.Simulation(world, **options)


def test_a_camera_sees_what_is_before_it():
    sim = simulation("depth")
    image = sim.robots["robot"].sensors["camera"].read()
    assert image.color.shape == (48, 64, 3)
    assert image.depth.shape == (48, 64)
    assert image.depth[24, 32] == pytest.approx(2.4, abs=1e-4)
    red, green, blue = image.color[24, 32]
    assert red > 150
    assert green == blue == 0
    assert np.isinf(image.depth[0, 0])


def test_a_camera_moves_with_its_robot():
    sim = simulation("depth")
    robot = sim.robots["robot"]
    robot.set_pose(position=(-1.0, 0.0, 0.5))
    assert robot.sensors["camera"].read().depth[24, 32] == pytest.approx(3.4, abs=1e-4)
    robot.set_pose(position=(0.0, 0.0, 0.5), quaternion=(0.0, 0.0, 1.0, 0.0))
    sim.step(1)
    image = robot.sensors["camera"].reading(robot.sensors["camera"].measure()[0])
    assert np.isinf(image.depth[24, 32])


def test_a_plain_camera_has_no_depth():
    assert simulation().robots["robot"].sensors["camera"].read().depth is None


def test_pictures_come_at_the_rate_in_simulated_time_with_the_stamp_of_that_moment():
    sim = simulation()
    stamps = []
    sensor = sim.robots["robot"].sensors["camera"]
    sensor.subscribe(lambda unit: stamps.append(unit.reading(unit.current()).stamp))
    sim.run(0.55)
    assert stamps == [100_000_000 * k for k in range(1, 6)]


def test_every_world_has_its_own_picture():
    sim = simulation("depth", nworld=3)
    robot = sim.robots["robot"]
    robot.set_pose(position=(-2.0, 0.0, 0.5), worlds=[1])
    values = robot.sensors["camera"].measure()
    image = robot.sensors["camera"].reading(values)
    assert image.color.shape == (3, 48, 64, 3)
    assert image.depth[:, 24, 32] == pytest.approx([2.4, 4.4, 2.4], abs=1e-4)
    alone = robot.sensors["camera"].measure(np.array([1]))
    assert np.array_equal(alone[0], values[1])


NOISE = "<noise><type>gaussian</type><mean>0</mean><stddev>0.05</stddev></noise>"


def test_noise_is_the_same_on_the_three_colours_and_as_wide_as_the_file_says():
    sim, plain = simulation(inner=NOISE), simulation()
    seen = sim.robots["robot"].sensors["camera"].read().color.astype(int)
    true = plain.robots["robot"].sensors["camera"].read().color.astype(int)
    inside = ((true > 60) & (true < 190)).all(axis=2)
    assert inside.sum() > 500
    change = (seen - true)[inside]
    assert (change[:, 0] == change[:, 1]).all()
    assert change[:, 0].std() == pytest.approx(0.05 * 255.0, rel=0.1)


def test_pictures_with_noise_come_again_after_a_snapshot():
    sim = simulation(inner=NOISE)
    camera = sim.robots["robot"].sensors["camera"]
    camera.read()
    kept = sim.snapshot()
    sim.run(0.3)
    first = camera.read().color.copy()
    sim.restore(kept)
    sim.run(0.3)
    assert np.array_equal(camera.read().color, first)


def test_two_cameras_see_at_once():
    more = (
        '<camera name="right"><pose>0 -0.2 0 0 0 0</pose><horizontal_fov>1.0</horizontal_fov>'
        "<image><width>32</width><height>24</height></image></camera>"
    )
    sim = simulation("multicamera", more=more)
    left, right = sim.robots["robot"].sensors["camera"].read()
    assert (left.color.shape, right.color.shape) == ((48, 64, 3), (24, 32, 3))
    assert left.stamp == right.stamp
    # Seen from the right, the box is more to the left.
    reds = [
        (image.color[..., 0] > 2 * image.color[..., 1].astype(int) + 20) for image in (left, right)
    ]
    centres = [red.any(axis=0).nonzero()[0].mean() / red.shape[1] for red in reds]
    assert centres[1] < centres[0]


def test_what_is_spawned_is_seen_and_what_is_deleted_is_not():
    sim = simulation("depth")
    camera = sim.robots["robot"].sensors["camera"]
    camera.read()
    sim.delete("red")
    sim.run(0.2)
    assert np.isinf(camera.read().depth[24, 32])


def test_a_camera_works_in_the_plane():
    world = load_string(WORLD.format(kind="depth", inner="", more=""))
    sim = gazelle.Simulation(world, engine="planar")
    image = sim.robots["robot"].sensors["camera"].read()
    assert image.depth[24, 32] == pytest.approx(2.4, abs=1e-3)


def test_a_lens_that_cannot_be_is_told_with_the_sensors_name():
    text = WORLD.format(kind="camera", inner="", more="")
    world = load_string(text.replace("<horizontal_fov>1.0", "<horizontal_fov>4.0"))
    with pytest.warns(SimulationWarning, match="robot::base::camera.*field of view"):
        sim = gazelle.Simulation(world)
    assert "camera" not in sim.robots["robot"].sensors
