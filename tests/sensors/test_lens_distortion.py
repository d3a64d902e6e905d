"""Lenses that bend pictures, in Gazebo's meaning and in OpenCV's."""

import math

import numpy as np
import pytest

from gazelle.description import Camera
from gazelle.rendering import PinholeLens
from gazelle.sensors.lens_distortion import LensDistortion, coefficients_of
from gazelle_ros.base.lenses import distort

BARREL = (-0.25, 0.12, 0.0, -0.00028, -0.00005)
PINCUSHION = (0.2, -0.05, 0.0, 0.001, 0.0005)


def checkers(camera):
    """Return a picture of soft dots, each row and column another brightness."""
    y, x = np.mgrid[0 : camera.height, 0 : camera.width]
    grey = 127.5 + 60.0 * np.sin(x * 0.17) + 60.0 * np.cos(y * 0.23)
    return np.repeat(grey[None, :, :, None], 3, axis=3).astype(np.uint8)


def undone(picture, lens, coefficients):
    """Undistort as OpenCV does, with D in units of the focal length; nearest pixels."""
    y, x = np.mgrid[0 : lens.height, 0 : lens.width] + 0.5
    place = np.stack((x - lens.width / 2, y - lens.height / 2), axis=-1) / lens.focal
    opencv = coefficients_of(Camera(distortion=coefficients))
    spot = distort(place, opencv) * lens.focal + (lens.width / 2 - 0.5, lens.height / 2 - 0.5)
    columns = np.clip(np.rint(spot[..., 0]), 0, lens.width - 1).astype(int)
    rows = np.clip(np.rint(spot[..., 1]), 0, lens.height - 1).astype(int)
    return picture[0][rows, columns].astype(float)


@pytest.mark.parametrize("coefficients", [BARREL, PINCUSHION])
def test_undistorting_is_best_with_the_very_coefficients(coefficients):
    """What gazebo_plugins' tests of distortion ask: a minimum within 0.01 of each coefficient."""
    camera = Camera(width=320, height=240, horizontal_fov=1.2, distortion=coefficients)
    plain = checkers(camera)
    bent = LensDistortion(camera, legacy=False).apply(plain)
    lens = PinholeLens.of_camera(camera)
    middle = (slice(50, -50), slice(50, -50))

    def error(tried):
        return np.abs(undone(bent, lens, tried)[middle] - plain[0][middle]).mean()

    least = error(coefficients)
    assert least < 6.0
    for which in (0, 1, 3, 4):
        for change in (-0.03, 0.03):
            tried = list(coefficients)
            tried[which] += change if which < 2 else change / 3.0
            assert error(tuple(tried)) > least


def test_gazebos_own_mode_counts_in_sides_of_the_picture():
    """The same coefficients mean the same where the focal length is the longer side."""
    fov = 2.0 * math.atan(0.5)
    camera = Camera(width=64, height=48, horizontal_fov=fov, distortion=PINCUSHION)
    plain = checkers(camera)
    ways = [LensDistortion(camera, legacy=legacy).apply(plain) for legacy in (True, False)]
    assert np.array_equal(*ways)
    wide = Camera(width=64, height=48, horizontal_fov=2.0, distortion=PINCUSHION)
    ways = [LensDistortion(wide, legacy=legacy).apply(plain) for legacy in (True, False)]
    assert not np.array_equal(*ways)


def test_a_barrel_is_cropped_in_gazebos_mode_and_has_black_corners_in_the_other():
    camera = Camera(width=64, height=64, horizontal_fov=1.2, distortion=(-0.3, 0.0, 0.0, 0.0, 0.0))
    plain = np.full((1, 64, 64, 3), 200, np.uint8)
    assert LensDistortion(camera, legacy=True).apply(plain)[0, 0, 0].min() > 150
    assert LensDistortion(camera, legacy=False).apply(plain)[0, 0, 0].max() == 0
