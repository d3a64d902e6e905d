"""The IMU against mechanics."""

import numpy as np
import pytest
import scenes

from gazelle.description import Imu, Noise, Pose
from gazelle.engines import make_engine
from gazelle.rotations import from_yaw
from gazelle.sensors import ImuModel, NoiseModel


def imu_on(engine, pose=None, imu=None):
    return ImuModel(imu or Imu(), engine, "box::link", pose or Pose(), 0, "imu")


def test_at_rest_it_feels_gravity_upwards():
    engine = make_engine("mujoco", scenes.world(scenes.ground(), scenes.box(pose=Pose(z=0.1))))
    engine.step(500)
    reading = imu_on(engine, Pose(roll=np.pi / 2)).measure()[0]
    np.testing.assert_allclose(reading[7:], [0.0, 9.8, 0.0], atol=1e-3)
    np.testing.assert_allclose(reading[4:7], 0.0, atol=1e-4)


def test_in_free_fall_it_feels_nothing_and_measuring_moves_nothing():
    engine = make_engine("mujoco", scenes.world(scenes.box(pose=Pose(z=5.0))))
    engine.step(100)
    before = engine.snapshot()
    np.testing.assert_allclose(imu_on(engine).measure()[0, 7:], 0.0, atol=1e-9)
    np.testing.assert_array_equal(engine.snapshot(), before)


def test_off_axis_it_feels_the_centripetal_acceleration_in_its_own_frame():
    engine = make_engine("mujoco", scenes.world(scenes.box(), gravity=(0, 0, 0)))
    engine.models["box"].set_placement((0, 0, 0), from_yaw(np.array(0.8)))
    engine.models["box"].set_motion((0, 0, 0), (0, 0, 3.0))
    reading = imu_on(engine, Pose(x=0.5)).measure()[0]
    np.testing.assert_allclose(reading[7:], [-0.5 * 9.0, 0.0, 0.0], atol=1e-2)
    np.testing.assert_allclose(reading[4:7], [0.0, 0.0, 3.0], atol=1e-9)
    np.testing.assert_allclose(reading[:4], from_yaw(np.array(0.8)), atol=1e-9)


def test_bias_is_constant_and_drift_forgets_with_its_correlation_time():
    bias = NoiseModel(Noise("gaussian", bias_mean=0.3, bias_stddev=0.01), 0, "a", 500, 1)
    first = bias.apply(np.zeros((500, 1)), 0.01)
    np.testing.assert_array_equal(first, bias.apply(np.zeros((500, 1)), 0.01))
    assert np.abs(first).mean() == pytest.approx(0.3, abs=0.005)
    assert 0.4 < (first > 0).mean() < 0.6
    settings = Noise("gaussian", dynamic_bias_stddev=0.2, dynamic_bias_correlation_time=1.0)
    drift = NoiseModel(settings, 0, "b", 4000, 1)
    for _ in range(50):
        early = drift.apply(np.zeros((4000, 1)), 0.1)
    for _ in range(10):
        late = drift.apply(np.zeros((4000, 1)), 0.1)
    assert late.std() == pytest.approx(0.2, rel=0.05)
    assert np.corrcoef(early.ravel(), late.ravel())[0, 1] == pytest.approx(np.exp(-1.0), abs=0.05)


def test_quantised_noise_gives_multiples_of_its_precision():
    noise = NoiseModel(Noise("gaussian_quantized", stddev=1.0, precision=0.25), 0, "q", 10, 3)
    values = noise.apply(np.zeros((10, 3)), 0.0)
    np.testing.assert_allclose(values * 4, np.round(values * 4))
    assert len(np.unique(values)) > 3
