"""Descriptions hold no NaN."""

import math

import pytest

from gazelle.description import JointAxis, Light, Link, Polyline, Pose, Sphere, World
from gazelle.errors import FormatError


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Sphere(math.nan), "Sphere takes no NaN: radius is nan"),
        (lambda: World(gravity=(0.0, math.nan, 0.0)), "World takes no NaN: gravity is"),
        (lambda: Link("l", Pose(yaw=math.nan)), "Link takes no NaN: pose is"),
        (lambda: JointAxis(xyz=(math.nan, 0.0, 0.0)), "JointAxis takes no NaN: xyz is"),
        (lambda: Polyline(([(0.0, 0.0), (1.0, 0.0), (1.0, math.nan)],)), "Polyline takes no NaN"),
        (lambda: Light("l", intensity=math.nan), "Light takes no NaN: intensity is nan"),
    ],
)
def test_a_description_refuses_nan(make, said):
    with pytest.raises(FormatError, match=said):
        make()


def test_a_description_takes_infinite_numbers():
    assert JointAxis(upper=math.inf).upper == math.inf
