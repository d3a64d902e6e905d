"""Distortion of lenses: inverse, closed forms, and OpenCV where it is installed."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle_ros.base.errors import Error
from gazelle_ros.base.lenses import distort, undistort
from gazelle_ros.base.resampling import Interpolation, Resampling, resize
from gazelle_ros.compat.image_geometry.cameramodels import PinholeCameraModel
from gazelle_ros.msgs import sensor_msgs

SMALL = st.floats(-0.05, 0.05)
COEFFICIENTS = st.sampled_from([0, 4, 5, 8, 12]).flatmap(
    lambda count: st.lists(SMALL, min_size=count, max_size=count)
)
PLACES = st.floats(-0.6, 0.6)


@given(COEFFICIENTS, PLACES, PLACES)
def test_undistorting_is_the_inverse(coefficients, x, y):
    place = np.array([[x, y]])
    fallen = distort(place, coefficients)
    origin, found = undistort(fallen, coefficients)
    assert found.all()
    assert np.allclose(distort(origin, coefficients), fallen, atol=1e-6)


@given(COEFFICIENTS, PLACES, PLACES)
def test_distortion_is_browns_formula(coefficients, x, y):
    k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4 = [*coefficients, *[0.0] * 12][:12]
    r = np.hypot(x, y)
    radial = (1 + k1 * r**2 + k2 * r**4 + k3 * r**6) / (1 + k4 * r**2 + k5 * r**4 + k6 * r**6)
    wanted = (
        x * radial + 2 * p1 * x * y + p2 * (r**2 + 2 * x**2) + s1 * r**2 + s2 * r**4,
        y * radial + 2 * p2 * x * y + p1 * (r**2 + 2 * y**2) + s3 * r**2 + s4 * r**4,
    )
    assert distort(np.array([x, y]), coefficients) == pytest.approx(wanted, abs=1e-12)


def camera(coefficients=(), model="", turn=0.0):
    """Return a camera whose rectification turns it about its optical axis and changes its focus."""
    cos, sin = np.cos(turn), np.sin(turn)
    made = sensor_msgs.msg.CameraInfo(width=64, height=48, distortion_model=model)
    made.D = list(coefficients)
    made.K = [50.0, 0.0, 31.0, 0.0, 52.0, 24.0, 0.0, 0.0, 1.0]
    made.R = [cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0]
    made.P = [45.0, 0.0, 30.0, 7.0, 0.0, 44.0, 25.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    return made


def model_of(info):
    made = PinholeCameraModel()
    made.fromCameraInfo(info)
    return made


@given(
    COEFFICIENTS, st.floats(-0.2, 0.2), st.floats(1.0, 25.0), st.floats(1.0, 20.0), st.booleans()
)
def test_a_rectified_pixel_is_the_raw_one_of_the_same_ray(coefficients, turn, u, v, binned):
    """A point along the raw pixel's ray is projected there by P, in the part of the image sent."""
    info = camera(
        coefficients, "rational_polynomial" if len(coefficients) > 5 else "plumb_bob", turn
    )
    if binned:
        info.binning_x = info.binning_y = 2
        info.roi.x_offset, info.roi.y_offset = 10, 6
    else:
        u, v = 2.0 * u + 10.0, 2.0 * v + 6.0
    model = model_of(info)
    raw = model.unrectifyPoint((u, v))
    assert model.rectifyPoint(raw) == pytest.approx((u, v), abs=0.01)
    inside = np.array(raw) * (2 if binned else 1) + ((10, 6) if binned else (0, 0))
    bent = (inside - (31.0, 24.0)) / (50.0, 52.0)
    plain = undistort(bent[None], coefficients)[0][0]
    ray = np.array(info.R).reshape(3, 3) @ (*plain, 1.0)
    info.P[3] = 0.0
    u_full, v_full, depth = np.array(info.P).reshape(3, 4)[:, :3] @ ray
    seen = (np.array((u_full, v_full)) / depth - ((10, 6) if binned else (0, 0))) / (
        2 if binned else 1
    )
    assert seen == pytest.approx((u, v), abs=0.01)


def test_an_image_of_straight_lines_is_straight_again():
    """A lens bends the picture of a function of the ray; rectified, it is that function."""
    info = camera([-0.2, 0.05, 0.001, -0.002, 0.0], "plumb_bob")
    model = model_of(info)
    columns, rows = np.meshgrid(np.arange(64.0), np.arange(48.0))
    ideal = model.rectified(np.stack((columns, rows), axis=-1))
    raw = (100.0 + ideal[..., 0] + 0.5 * ideal[..., 1]).astype(np.float32)
    rectified = np.zeros_like(raw)
    model.rectifyImage(raw, rectified, Interpolation.LINEAR)
    wanted = 100.0 + columns + 0.5 * rows
    seen = slice(10, 38), slice(12, 52)
    assert rectified[seen] == pytest.approx(wanted[seen], abs=0.02)


@pytest.mark.parametrize(
    ("info", "text"),
    [
        (sensor_msgs.msg.CameraInfo(), "is not calibrated"),
        (camera([0.1], "plum_bob"), "distortion model 'plum_bob'"),
        (camera([0.0] * 13 + [0.1], "rational_polynomial"), "a tilted sensor"),
    ],
)
def test_what_cannot_be_rectified_is_an_error(info, text):
    with pytest.raises(Error, match=text):
        model_of(info).rectifyPoint((1.0, 1.0))


@pytest.mark.parametrize("interpolation", [each for each in Interpolation if each])
def test_interpolation_keeps_constants_and_slopes(interpolation):
    """OpenCV's wider kernels, unlike the linear one, bend a slope a little between the pixels."""
    columns, rows = np.meshgrid(np.arange(40.0), np.arange(30.0))
    image = (3.0 * columns - 2.0 * rows).astype(np.float32)
    places = columns[6:-6, 6:-6] + 0.3, rows[6:-6, 6:-6] + 0.8
    found = Resampling(*places, image.shape, interpolation).apply(image)
    wide = interpolation in {Interpolation.CUBIC, Interpolation.LANCZOS4}
    tolerance = 0.3 if wide else 1e-4
    assert found == pytest.approx(3.0 * places[0] - 2.0 * places[1], abs=tolerance)
    flat = Resampling(*places, image.shape, interpolation).apply(np.full(image.shape, 7, np.uint8))
    assert (flat == 7).all()


def test_beyond_an_image_is_nothing_or_its_edge():
    image = np.full((4, 4), 100, np.uint8)
    places = np.array([[-2.0, -0.5, 1.0, 3.5, 9.0]])
    ones = np.ones_like(places)
    assert Resampling(places, ones, (4, 4)).apply(image).tolist() == [[0, 50, 100, 50, 0]]
    held = Resampling(places, ones, (4, 4), replicate=True).apply(image)
    assert held.tolist() == [[100] * 5]


def test_holes_of_depth_images_spread_no_farther_than_their_weights():
    image = np.array([[1.0, np.nan, 3.0, 4.0]], np.float32)
    columns = np.array([[0.0, 0.5, 2.0, 2.5]])
    found = Resampling(columns, np.zeros_like(columns), (1, 4)).apply(image)
    assert np.array_equal(found, [[1.0, np.nan, 3.0, 3.5]], equal_nan=True)


def test_areas_are_means():
    image = np.arange(48, dtype=np.float32).reshape(6, 8)
    means = image.reshape(3, 2, 4, 2).mean(axis=(1, 3))
    assert resize(image, 3, 4, Interpolation.AREA) == pytest.approx(means)
    assert resize(image, 4, 5, Interpolation.AREA).mean() == pytest.approx(image.mean())


@pytest.mark.parametrize("count", [5, 8])
def test_rectification_is_opencvs(count):
    cv2 = pytest.importorskip("cv2")
    rng = np.random.default_rng(count)
    coefficients = (rng.uniform(-0.1, 0.1, count) * [1, 1, 0.1, 0.1, *[1] * (count - 4)]).tolist()
    info = camera(coefficients, "plumb_bob" if count == 5 else "rational_polynomial", 0.1)
    matrices = (np.array(values).reshape(3, -1)[:, :3] for values in (info.K, info.R, info.P))
    intrinsic, rotation, projection = matrices
    size = (info.width, info.height)
    maps = cv2.initUndistortRectifyMap(
        intrinsic, np.array(coefficients), rotation, projection, size, cv2.CV_32FC1
    )
    pixels = np.stack(np.meshgrid(np.arange(64.0), np.arange(48.0)), axis=-1)
    assert np.abs(model_of(info).unrectified(pixels) - np.stack(maps, axis=-1)).max() < 0.01
