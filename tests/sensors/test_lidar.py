"""The lidar against geometry."""

import dataclasses
import pickle
from dataclasses import replace

import numpy as np
import pytest
import scenes
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle import formats
from gazelle.description import Lidar, Noise, Pose, Scan
from gazelle.engines import make_engine
from gazelle.errors import SimulationError
from gazelle.sensors import LaserScan, LidarModel
from gazelle.sensors.lidar import angles_of


def room(*models, nworld=1):
    return make_engine("mujoco", scenes.world(*scenes.square(), *models), nworld)


def model_of(engine, lidar, pose=None):
    return LidarModel(lidar, engine, "box::link", pose or Pose(z=0.3), 0, "lidar")


def square_distance(x, y, angle, half=1.85):
    """Return distance from (x, y) to the walls of a square room."""
    c, s = np.cos(angle), np.sin(angle)
    with np.errstate(divide="ignore"):
        to_x = np.where(c > 0, (half - x) / c, (-half - x) / c)
        to_y = np.where(s > 0, (half - y) / s, (-half - y) / s)
    return np.minimum(np.abs(to_x), np.abs(to_y))


@given(x=st.floats(-1.2, 1.2), y=st.floats(-1.2, 1.2), yaw=st.floats(-3, 3))
@settings(max_examples=30, deadline=None)
def test_ranges_are_the_distances_to_the_walls(x, y, yaw):
    engine = room(scenes.box(pose=Pose(x, y, 0.1, yaw=yaw)))
    lidar = Lidar(Scan(90, min_angle=-3.0, max_angle=3.0), range_min=0.12, range_max=10.0)
    model = model_of(engine, lidar)
    ranges = model.measure()[0]
    np.testing.assert_allclose(ranges, square_distance(x, y, yaw + model.angles), atol=1e-9)


def test_what_is_too_far_is_plus_infinity_and_too_near_is_minus_infinity():
    near = scenes.wall("near", 0.3, 0.0, np.pi / 2, length=0.3, thickness=0.1)
    engine = room(scenes.box(pose=Pose(z=0.1)), near)
    lidar = Lidar(Scan(2, min_angle=0.0, max_angle=np.pi), range_min=0.3, range_max=1.5)
    np.testing.assert_array_equal(model_of(engine, lidar).measure()[0], [-np.inf, np.inf])


def test_the_housing_around_the_scanner_is_not_seen():
    engine = room(scenes.box(size=(0.1, 0.1, 0.6), pose=Pose(z=0.3)))
    lidar = Lidar(Scan(4, max_angle=4.71), range_min=0.12, range_max=5.0)
    assert model_of(engine, lidar, Pose()).measure().min() > 1.8


@pytest.mark.parametrize("worlds", [[1], [-1], [10**9], [0, 0], [np.nan]])
@pytest.mark.parametrize("kind", ["mujoco", "planar"])
def test_worlds_that_are_not_there_are_refused(kind, worlds):
    engine = make_engine(kind, scenes.world(scenes.ground(), scenes.box(pose=Pose(z=0.1))), 1)
    lidar = Lidar(Scan(4, max_angle=4.71), range_min=0.12, range_max=5.0)
    model = LidarModel(lidar, engine, "box::link", Pose(z=0.3), 0, "lidar")
    with pytest.raises(SimulationError, match=r"worlds must be|a sensor measures in"):
        model.measure(np.array(worlds))


@pytest.mark.parametrize("step", [0.0, 0.001, 0.015, 0.05, 1.0])
def test_a_resolution_rounds_nothing_unless_it_is_asked_to(step):
    engine = room(scenes.box(pose=Pose(z=0.1)))
    for rows in (1, 5):  # in the plane, and in three dimensions
        tilt = Scan(rows, min_angle=-0.1, max_angle=0.1)
        exact = Lidar(Scan(90, max_angle=6.0), tilt, range_min=0.1, range_max=5.0)
        truth = model_of(engine, exact).measure()
        stepped = replace(exact, range_resolution=step)
        np.testing.assert_array_equal(model_of(engine, stepped).measure(), truth)
        rounded = model_of(engine, replace(stepped, quantized=True)).measure()
        whole = np.round(truth / step) * step if step else truth
        wanted = np.where(np.isinf(truth), truth, np.clip(whole, 0.1, 5.0))
        np.testing.assert_allclose(rounded, wanted, atol=1e-12)


def test_a_file_may_ask_for_rounded_ranges(tmp_path):
    block = (
        "<ray><scan><horizontal><samples>3</samples></horizontal></scan><range><min>.1</min>"
        "<max>5</max><resolution>.25</resolution>{}</range></ray>"
    )
    text = (
        "<sdf version='1.6' xmlns:gazelle='urn:gazelle'><model name='m'><link name='l'>"
        f"<sensor name='lidar' type='ray'>{block}</sensor></link></model></sdf>"
    )
    ask = "<gazelle:quantize>true</gazelle:quantize>"
    for tag, quantum in (("", 0.0), (ask, 0.25), (ask.replace("true", "0"), 0.0)):
        file = tmp_path / "model.sdf"
        file.write_text(text.format(tag))
        model = formats.load_model(file)
        lidar = model.links[0].sensors[0].lidar
        assert (lidar.range_resolution, lidar.quantum) == (0.25, quantum)
        formats.save(model, tmp_path / "again.sdf")
        assert formats.load_model(tmp_path / "again.sdf").links[0].sensors[0].lidar == lidar


def test_gaussian_noise_has_its_deviation():
    engine = room(scenes.box(pose=Pose(z=0.1)), nworld=400)
    exact = Lidar(Scan(10, max_angle=6.0), range_min=0.1, range_max=5.0)
    truth = model_of(engine, exact).measure()[0]
    noisy = Lidar(
        exact.horizontal,
        range_min=0.1,
        range_max=5.0,
        noise=Noise("gaussian", mean=0.1, stddev=0.02),
    )
    error = model_of(engine, noisy).measure() - truth
    assert error.mean() == pytest.approx(0.1, abs=0.002)
    assert error.std() == pytest.approx(0.02, rel=0.05)


def test_a_world_measures_the_same_alone_and_in_company():
    noisy = Lidar(
        Scan(24, max_angle=6.28), range_min=0.1, range_max=5.0, noise=Noise("gaussian", stddev=0.02)
    )
    alone = model_of(room(scenes.box(pose=Pose(z=0.1))), noisy)
    many = model_of(room(scenes.box(pose=Pose(z=0.1)), nworld=64), noisy)
    for _ in range(3):
        np.testing.assert_array_equal(alone.measure()[0], many.measure()[0])
    np.testing.assert_array_equal(alone.measure()[0], many.measure(np.array([0, 5]))[0])


def test_rows_of_a_3d_lidar_go_from_the_lowest_up():
    engine = room(scenes.ground(), scenes.box(pose=Pose(z=0.1)))
    lidar = Lidar(Scan(1), Scan(3, min_angle=-0.5, max_angle=0.5), range_min=0.01, range_max=9.0)
    down, level, up = model_of(engine, lidar).measure()[0]
    assert down == pytest.approx(0.4 / np.sin(0.5), abs=1e-9)
    assert level == pytest.approx(1.85, abs=1e-9)
    assert np.isinf(up)


def test_angles_include_both_ends_and_follow_the_resolution():
    np.testing.assert_allclose(angles_of(Scan(3, min_angle=-1.0, max_angle=1.0)), [-1, 0, 1])
    assert len(angles_of(Scan(10, 0.5, 0.0, 1.0))) == 5
    assert angles_of(Scan(1, 1.0, 0.3, 1.0)).tolist() == [0.3]


def test_a_scan_is_a_frozen_value():
    scan = LaserScan(5, np.arange(3.0), -1.0, 1.0, 1.0, 0.1, range_max=np.inf)
    assert [each.name for each in dataclasses.fields(scan)][:2] == ["stamp", "ranges"]
    with pytest.raises(AttributeError):
        scan.stamp = 6
    later = dataclasses.replace(scan, stamp=6)
    assert (later.stamp, later.ranges is scan.ranges) == (6, True)
    read = pickle.loads(pickle.dumps(scan))
    assert repr(read) == repr(scan)
    assert repr(scan).startswith("LaserScan(stamp=5, ranges=array([0., 1., 2.]), angle_min=-1.0")
    with pytest.raises(TypeError):
        LaserScan(5, np.arange(3.0))
