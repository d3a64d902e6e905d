"""A lidar is fitted to the task, or refused with the file that is to blame."""

import math

import pytest

from gazelle.description import Lidar, Link, Model, Scan, Sensor
from gazelle.description.source import Source
from gazelle.envs.lidars import fit_lidar
from gazelle.errors import GazelleWarning, TaskError

PLACE = Source("robot.urdf", 42, "sensor[@name='eye']")


def robot(samples=360, rows=1, resolution=1.0):
    lidar = Lidar(
        horizontal=Scan(samples, resolution, 0.0, 2 * math.pi),
        vertical=Scan(rows),
        range_min=0.12,
        range_max=3.5,
    )
    eye = Sensor("eye", "ray", lidar=lidar, source=PLACE)
    link = Link("head", sensors=(Sensor("imu", "imu"), eye))
    inner = Model("inner", links=(Link("other"), link))
    return Model("robot", links=(Link("base"),), models=(inner,), source=Source("robot.urdf"))


def test_fewer_rays_over_the_same_angles_with_a_notice():
    with pytest.warns(GazelleWarning, match=r"robot\.urdf:42.*360 rays.*reads 24"):
        fitted = fit_lidar(robot(360), 24, notice=True)
    assert fitted.lidar.horizontal == Scan(24, 1.0, 0.0, 2 * math.pi)
    assert fitted.lidar.range_max == 3.5
    inner = fitted.model.models[0].links[1]
    assert inner.sensors[1].lidar == fitted.lidar
    assert inner.sensors[0].name == "imu"


def test_the_right_number_needs_nothing():
    model = robot(24)
    assert fit_lidar(model, 24, notice=True).model is model


def test_interpolated_points_count_as_rays():
    assert fit_lidar(robot(12, resolution=2.0), 24, notice=True).lidar.horizontal.samples == 12


@pytest.mark.parametrize(
    ("model", "text"),
    [
        (robot(23), r"robot\.urdf:42: <sensor.*23 rays.*reads 24.*lidar_samples=23"),
        (robot(24, rows=2), r"robot\.urdf:42: .*2 rows"),
        (Model("blind", source=Source("blind.urdf", 2)), r"blind\.urdf:2: .*'blind' has no lidar"),
    ],
)
def test_what_cannot_fit_names_the_file(model, text):
    with pytest.raises(TaskError, match=text):
        fit_lidar(model, 24, notice=True)
