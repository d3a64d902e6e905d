"""Sensors that files make too large are one error with its place; any rate ends."""

import numpy as np
import pytest

import gazelle
from gazelle import formats
from gazelle.description import Lidar, Pose, Scan
from gazelle.errors import SimulationError
from gazelle.sensors import LidarModel
from gazelle.simulation.clock import Schedule

WORLD = """<sdf version='1.6'><world name='w'><model name='b'><static>1</static><link name='l'>
{}</link></model></world></sdf>"""
RAYS = """<sensor name='s' type='ray'><ray><scan><horizontal><samples>{}</samples>
<resolution>{}</resolution><min_angle>0</min_angle><max_angle>6</max_angle></horizontal>
<vertical><samples>{}</samples></vertical></scan><range><min>.1</min><max>10</max></range></ray>
</sensor>"""
CAMERA = """<sensor name='s' type='{}'><camera><image><width>{}</width><height>{}</height></image>
</camera></sensor>"""
IMU = "<sensor name='s' type='imu'><update_rate>{}</update_rate></sensor>"


@pytest.mark.parametrize("engine", ["mujoco", "planar"])
@pytest.mark.parametrize(
    ("text", "nworld", "complaint"),
    [
        (RAYS.format(2 * 10**9, 1, 1), 1, "2e+09 rays, more than the limit of 4,000,000"),
        (RAYS.format(640, 65536, 1), 1, "rays, more than the limit of 4,000,000"),
        (RAYS.format(640, "-1e308", 1), 1, "rays, more than the limit of 4,000,000"),
        (RAYS.format(4000, 1, 4000), 1, "rays, more than the limit of 4,000,000"),
        (RAYS.format(1, 1, 10**30), 1, "rays, more than the limit of 4,000,000"),
        (RAYS.format(10**6, 1, 1), 1000, "in each of 1000 worlds, more than the limit"),
        (CAMERA.format("camera", 65536, 65536), 1, "pixels, more than the limit of 67,108,864"),
        (CAMERA.format("depth", 10**30, 2), 1, "pixels, more than the limit of 67,108,864"),
    ],
)
def test_too_many_rays_or_pixels_are_refused(text, nworld, complaint, engine):
    world = formats.load_string(WORLD.format(text), name="large.world")
    with pytest.raises(SimulationError) as caught:
        gazelle.Simulation(world, engine, nworld=nworld, threads=1)
    assert "sensor 'b::l::s' has" in caught.value.message
    assert complaint in caught.value.message
    assert (caught.value.file, caught.value.line) == ("large.world", 2)


@pytest.mark.parametrize(
    "scan",
    [
        Scan(samples=10**9),
        Scan(resolution=1e6),
        Scan(samples=2**62),
        Scan(resolution=np.uint8(255)),
    ],
)
def test_too_many_rays_of_a_model_are_refused_before_they_are_made(scan):
    lidar = Lidar(horizontal=scan, vertical=Scan(samples=100))
    with gazelle.Simulation("empty", threads=1) as sim, pytest.raises(SimulationError) as caught:
        LidarModel(lidar, sim.engine, "ground_plane::link", Pose(), 0, "s")
    assert "rays, more than the limit of 4,000,000" in caught.value.message


@pytest.mark.parametrize("rate", ["1e20", "1e308", "1e-308", "1e9", "-5", "inf"])
def test_any_update_rate_ends(rate):
    world = formats.load_string(WORLD.format(IMU.format(rate)))
    with gazelle.Simulation(world, threads=1) as sim:
        sim.robots["b"].sensors["s"].subscribe(lambda _: None)
        sim.step(10)


@pytest.mark.parametrize("rate", [1e-320, 1e-9, 0.3, 30.0, 999.9, 1e9, 1e20, float("inf")])
@pytest.mark.parametrize("now_ns", [0, 1, 999, 10**9, 10**15])
def test_a_schedule_is_due_after_now(rate, now_ns):
    schedule = Schedule(rate)
    schedule.done(now_ns)
    assert now_ns < schedule.due_ns <= now_ns + 1.001e9 / schedule.rate + 1
