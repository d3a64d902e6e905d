"""NaN that would stay in a state for ever is refused when it comes; nothing has changed then."""

import math

import numpy as np
import pytest

from gazelle.control import ControllerManager, RobotHardware
from gazelle.description import Noise
from gazelle.errors import ControlError, Error, SimulationError
from gazelle.navigation.estimation import Measurement
from gazelle.navigation.mapping import GmappingSettings, GridSlam
from gazelle.sensors import NoiseModel, look_at
from gazelle_ros.base.errors import RosError
from gazelle_ros.robot import read_joints

DRIFTING = Noise(type="gaussian", dynamic_bias_stddev=1.0, dynamic_bias_correlation_time=1.0)
WRONG = (math.nan, -math.inf)


@pytest.mark.parametrize("interval", WRONG)
def test_a_drift_of_noise_stays_a_number(interval):
    noise = NoiseModel(DRIFTING, 0, "a", 1, 1)
    with pytest.raises(SimulationError, match="the time since the last measurement"):
        noise.apply(np.zeros((1, 1)), interval)
    assert np.isfinite(noise.apply(np.zeros((1, 1)), 0.1)).all()


@pytest.mark.parametrize("period", [*WRONG, math.inf, -1.0])
def test_integrals_of_controllers_stay_numbers(period):
    manager = ControllerManager(RobotHardware())
    for update in (
        lambda: manager.update(0, period),
        lambda: manager.catch_up(0, 1, period),
    ):
        with pytest.raises(ControlError, match="a period must be a finite number"):
            update()


@pytest.mark.parametrize("worlds", [[-1], [2], [math.nan], [[0]]])
def test_controllers_start_again_in_worlds_that_are_there(worlds):
    with pytest.raises(ControlError, match="worlds must be"):
        ControllerManager(RobotHardware(2)).update(0, 0.1, restart=worlds)


@pytest.mark.parametrize(("time", "most"), [(math.nan, 5.0), (math.inf, 5.0), (0.0, math.nan)])
def test_the_time_of_a_map_stays_a_number(time, most):
    slam, here = GridSlam(GmappingSettings.read({"particles": 1})), (0.0, 0.0, 0.0)
    scan = np.ones(3), np.arange(3.0)
    with pytest.raises(Error, match="a scan is of a time"):
        slam.update(time, here, *scan, most, here)
    assert slam.map_to_odom is None
    assert slam.update(0.0, here, *scan, 0.0, here)  # so far does a driver see that says NaN
    assert np.isfinite(slam.poses).all()


def test_a_threshold_is_a_number():
    row = np.zeros(15), np.eye(15), np.ones(15, bool)
    with pytest.raises(Error, match="the threshold of 'imu' must be a number"):
        Measurement("imu", 0, *row, math.nan)


@pytest.mark.parametrize("eye", [(math.nan, 0.0, 0.0), [math.inf] * 3])
def test_a_camera_looks_from_somewhere(eye):
    with pytest.raises(SimulationError, match="'eye' must be"):
        look_at(eye, (0.0, 0.0, 0.0))


@pytest.mark.parametrize("number", ["nan", "inf", "1e400", "one"])
@pytest.mark.parametrize("part", ['origin xyz="{} 0 0"', 'origin rpy="{} 0 0"', 'axis xyz="{} 0 0"',
                                  'limit lower="{}"', 'mimic joint="j" offset="{}"'])  # fmt: skip
def test_joints_of_a_robot_description_are_somewhere(part, number):
    with pytest.raises(RosError, match=f"is '{number}.*not .*finite number"):
        read_joints(
            '<robot name="r"><joint name="j" type="revolute"><parent link="a"/><child link="b"/>'
            f"<{part.format(number)}/></joint></robot>"
        )
