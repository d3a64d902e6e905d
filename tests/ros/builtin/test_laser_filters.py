"""The filters of laser_filters, against loops that follow their definitions."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import Point, Polygon

from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.scans.filters.beams import BeamScan, ScanMotion
from gazelle_ros.builtin.scans.filters.chain import KINDS, scan_filter
from gazelle_ros.tf import StampedTransform
from gazelle_ros.transformations import quaternion_from_euler, quaternion_matrix

NAN, INF = math.nan, math.inf
STILL = StampedTransform(0)
SAMPLE = [1.0, 0.1, 1.0, 1.0, 1.0, 9.0, 1.0, 1.0, 1.0, 2.3]
"""That of the original's tests, with limits of 0.5 m and 1.5 m."""

RANGES = st.lists(
    st.one_of(st.floats(0.0, 20.0), st.sampled_from([NAN, INF, 0.5, 10.0])), max_size=30
)


def made(kind, **params):
    return scan_filter(
        "/chain[0]", {"name": "a", "type": f"laser_filters/{kind}", "params": params}
    )


def beams(ranges, intensities=(), **values):
    usual = {"angle_min": -0.5, "angle_increment": 0.1, "range_min": 0.5, "range_max": 10.0}
    return BeamScan(
        np.array(ranges, float),
        np.array(intensities, float),
        **{**usual, "frame": "laser", **values},
    )


def ranges_of(kind, ranges, *, scan=None, **params):
    return made(kind, **params).apply(scan or beams(ranges)).ranges.tolist()


def same(found, expected):
    return found == pytest.approx(expected, abs=1e-9, nan_ok=True)


# The original's samples -------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "params", "expected"),
    [
        (
            "LaserScanIntensityFilter",
            {"lower_threshold": 0.5, "upper_threshold": 3.0},
            [1, NAN, 1, 1, 1, NAN, 1, 1, 1, 2.3],
        ),
        ("InterpolationFilter", {}, [1.0] * 10),
        (
            "ScanShadowsFilter",
            {"min_angle": 80.0, "max_angle": 100.0, "neighbors": 1, "window": 1},
            [NAN, 0.1, NAN, 1, 1, NAN, 1, 1, 1, NAN],
        ),
        ("LaserScanMaskFilter", {"masks": {"laser": [1, 5, 99]}}, [1, NAN, 1, 1, 1, NAN, 1, 1, 1, 2.3]),
    ],
)  # fmt: skip
def test_the_samples_of_the_original_come_out_as_there(kind, params, expected):
    scan = beams(SAMPLE, SAMPLE, range_max=1.5)
    assert same(made(kind, **params).apply(scan).ranges.tolist(), expected)


def test_the_array_filter_is_a_mean_over_the_last_scans():
    chain = [{"name": "m", "type": "filters/MultiChannelMeanFilterFloat",
              "params": {"number_of_observations": 3}}]  # fmt: skip
    mean = made("LaserArrayFilter", range_filter_chain=chain, intensity_filter_chain=chain)
    for ranges in (SAMPLE, [1.0] * 10):
        mean.apply(beams(ranges, SAMPLE))
    found = mean.apply(beams(SAMPLE, SAMPLE))
    assert same(found.ranges.tolist(), [(2 * each + 1.0) / 3 for each in SAMPLE])
    assert same(found.intensities.tolist(), SAMPLE)
    assert same(mean.apply(beams([5.0])).ranges.tolist(), [5.0])  # another size begins again


@given(st.lists(st.lists(st.floats(0.0, 9.0), min_size=3, max_size=3), min_size=1, max_size=8))
def test_the_median_filter_takes_the_lower_middle_of_the_last_scans(scans):
    chain = [{"name": "m", "type": "MultiChannelMedianFilterFloat",
              "params": {"number_of_observations": 4}}]  # fmt: skip
    median = made("LaserMedianFilter", internal_filter=chain)
    for number, ranges in enumerate(scans):
        last = scans[max(0, number - 3) : number + 1]
        expected = [sorted(column)[(len(last) - 1) // 2] for column in zip(*last, strict=True)]
        assert median.apply(beams(ranges)).ranges.tolist() == expected


# By value ---------------------------------------------------------------------------------


@given(RANGES, st.floats(0.0, 5.0), st.floats(5.0, 20.0), st.booleans())
def test_ranges_at_thresholds_are_replaced(ranges, lower, upper, by_message):
    found = ranges_of(
        "LaserScanRangeFilter", ranges, lower_threshold=lower, upper_threshold=upper,
        use_message_range_limits=by_message, lower_replacement_value=NAN, upper_replacement_value=INF,
    )  # fmt: skip
    low, high = (0.5, 10.0) if by_message else (lower, upper)
    assert same(found, [NAN if r <= low else INF if r >= high else r for r in ranges])


@given(RANGES, st.lists(st.floats(0.0, 9.0), max_size=30), st.booleans(), st.booleans())
def test_beams_are_removed_by_intensity(ranges, lit, invert, override):
    params = {"lower_threshold": 3.0, "upper_threshold": 6.0, "invert": invert}
    found = made(
        "LaserScanIntensityFilter", **params, filter_override_intensity=override
    ).apply(beams(ranges, lit))  # fmt: skip
    count = min(len(ranges), len(lit))
    out = [(each <= 3.0 or each >= 6.0) != invert for each in lit[:count]]
    assert same(
        found.ranges.tolist()[:count], [NAN if o else r for o, r in zip(out, ranges, strict=False)]
    )
    assert same(found.ranges.tolist()[count:], ranges[count:])
    expected = [0.0 if each else 1.0 for each in out] + lit[count:] if override else lit
    assert same(found.intensities.tolist(), expected)


@given(RANGES)
def test_gaps_are_filled_by_the_mean_of_their_ends(ranges):
    found = ranges_of("InterpolationFilter", ranges)
    expected, after = list(ranges), 10.0 - 0.01
    for n, each in enumerate(ranges):
        if not (each <= 0.5 or each >= 10.0):
            continue
        first = n
        while first and (ranges[first - 1] <= 0.5 or ranges[first - 1] >= 10.0):
            first -= 1
        before = ranges[first - 1] if first else 10.0 - 0.01
        rest = [r for r in ranges[n:] if not (r <= 0.5 or r >= 10.0)]
        if rest:
            after = rest[0]
        expected[n] = (before + after) / 2.0
    assert same(found, expected)


# By angle ---------------------------------------------------------------------------------


@given(st.lists(st.floats(0.6, 9.0), min_size=1, max_size=40), st.floats(-2.0, 1.0),
       st.floats(0.0, 2.0), st.booleans())  # fmt: skip
def test_a_scan_is_shortened_to_its_bounds(ranges, lower, width, backwards):
    upper, step = lower + width, -0.1 if backwards else 0.1
    scan = beams(ranges, ranges, angle_min=1.0 if backwards else -1.0, angle_increment=step,
                 stamp=1000, time_increment=1e-6)  # fmt: skip
    found = made("LaserScanAngularBoundsFilter", lower_angle=lower, upper_angle=upper).apply(scan)
    angle, kept, first = scan.angle_min, [], None
    for number, each in enumerate(ranges):
        outside = angle > upper if backwards else angle < lower
        if not kept and outside:
            angle += step
            continue
        first = (angle, number) if first is None else first
        kept.append(each)
        after = angle + step
        if after < lower if backwards else after > upper:
            break
        angle = after
    assert found.ranges.tolist() == found.intensities.tolist() == kept
    if first is not None:
        assert (found.angle_min, found.stamp) == (first[0], 1000 + 1000 * first[1])
        assert found.message().angle_max == scan.angles[first[1] + len(kept) - 1]


@given(RANGES, st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_beams_between_two_angles_are_cleared(ranges, lower, upper):
    scan = beams(ranges, np.ones(len(ranges)))
    found = made("LaserScanAngularBoundsFilterInPlace", lower_angle=lower, upper_angle=upper).apply(
        scan
    )
    inside = [lower < angle < upper for angle in scan.angles]
    assert same(
        found.ranges.tolist(), [11.0 if i else r for i, r in zip(inside, ranges, strict=True)]
    )
    assert found.intensities.tolist() == [0.0 if i else 1.0 for i in inside]


@given(RANGES, st.floats(-3.0, 3.0), st.floats(-3.0, 3.0), st.booleans())
def test_a_sector_is_cleared_or_kept(ranges, first, last, inside):
    scan = beams(ranges, angle_min=-3.0, angle_increment=0.2)
    found = ranges_of(
        "LaserScanSectorFilter", ranges, scan=scan, angle_min=first, angle_max=last,
        range_min=2.0, range_max=8.0, clear_inside=inside,
    )  # fmt: skip
    expected = []
    for angle, away in zip(scan.angles, ranges, strict=True):
        within = first < angle < last if first <= last else angle > first or angle < last
        expected.append(11.0 if (within and 2.0 < away < 8.0) == inside else away)
    if first <= last or not np.isclose(scan.angles[:, None], [first, last], atol=1e-9).any():
        assert same(found, expected)


def test_a_frame_without_a_mask_is_warned_of_once(caplog):
    mask = made("LaserScanMaskFilter", masks={"other": [0]})
    for _ in range(2):
        assert mask.apply(beams([1.0])).ranges.tolist() == [1.0]
    assert caplog.text.count("no mask for the frame 'laser'") == 1


# By neighbours ----------------------------------------------------------------------------


@given(
    st.lists(st.floats(0.1, 9.0), max_size=15), st.integers(1, 90), st.integers(91, 179),
    st.integers(0, 4), st.integers(0, 3), st.booleans(),
)  # fmt: skip
def test_shadows_are_found_by_the_angle_between_line_and_beam(
    ranges, least, most, window, neighbours, start
):
    found = ranges_of(
        "ScanShadowsFilter", ranges, min_angle=float(least), max_angle=float(most), window=window,
        neighbors=neighbours, remove_shadow_start_point=start,
    )  # fmt: skip
    expected, count, doubtful = list(ranges), len(ranges), False
    for one in range(count):
        slopes = [
            math.degrees(
                math.atan2(
                    ranges[two] * abs(math.sin((two - one) * 0.1)),
                    ranges[one] - ranges[two] * math.cos((two - one) * 0.1),
                )
            )
            for two in range(max(0, one - window), min(count, one + window + 1))
            if two != one
        ]
        doubtful |= any(min(abs(s - least), abs(s - most)) < 1e-6 for s in slopes)
        if any(s < least or s > most for s in slopes):
            for two in range(max(0, one - neighbours), min(count, one + neighbours + 1)):
                if ranges[one] < ranges[two]:
                    expected[two] = NAN
            if start:
                expected[one] = NAN
    if not doubtful:
        assert same(found, expected)


@given(st.lists(st.one_of(st.floats(0.1, 4.0), st.just(NAN)), min_size=9, max_size=20),
       st.integers(1, 6), st.integers(0, 1))  # fmt: skip
def test_speckles_are_beams_without_enough_neighbours(ranges, window, kind):
    found = ranges_of(
        "LaserScanSpeckleFilter", ranges, filter_type=kind, max_range=2.0,
        max_range_difference=0.4, filter_window=window,
    )  # fmt: skip
    count = len(ranges)
    good = [each > 2.0 for each in ranges]
    for one in range(count - window + 1):
        if kind == 0:
            near = not math.isnan(ranges[one]) and all(
                abs(each - ranges[one]) <= 0.4 for each in ranges[one : one + window]
            )
        else:
            others = [
                n for n in range(one - window, one + window + 1) if 0 <= n < count and n != one
            ]
            near = window <= sum(
                math.sqrt(max(0.0, ranges[one] ** 2 + ranges[n] ** 2
                              - 2 * ranges[one] * ranges[n] * math.cos((n - one) * 0.1))) <= 0.4
                for n in others
                if not math.isnan(ranges[n]) and not math.isnan(ranges[one])
            )  # fmt: skip
        if near:
            good[one : one + window] = [True] * window
    assert same(found, [r if g else NAN for r, g in zip(ranges, good, strict=True)])


def test_a_scan_that_is_too_short_for_the_window_is_an_error():
    with pytest.raises(ValueError, match="5 beams are too few"):
        ranges_of("LaserScanSpeckleFilter", [1.0] * 5)


# By place ---------------------------------------------------------------------------------

POSES = st.tuples(
    st.floats(-2.0, 2.0), st.floats(-2.0, 2.0), st.floats(-0.5, 0.5),
    st.floats(-3.0, 3.0), st.floats(-0.3, 0.3), st.floats(-3.0, 3.0),
)  # fmt: skip


def transform(pose, stamp=0):
    turn = tuple(float(each) for each in quaternion_from_euler(*pose[3:]))
    return StampedTransform(stamp, pose[:3], turn)


def points_of(scan, pose):
    matrix = quaternion_matrix(quaternion_from_euler(*pose[3:]))[:3, :3]
    for angle, away in zip(scan.angles, scan.ranges, strict=True):
        if scan.range_min <= away < scan.range_max:
            yield matrix @ [away * math.cos(angle), away * math.sin(angle), 0.0] + pose[:3]
        else:
            yield None


@given(RANGES, POSES, st.booleans())
def test_points_in_a_box_are_removed(ranges, pose, invert):
    still = transform(pose)
    scan = beams(ranges, motions={"base": ScanMotion(still, still)}, angle_increment=0.3)
    limits = {"min_x": -1.0, "max_x": 2.0, "min_y": -1.5, "max_y": 1.0, "min_z": -0.2, "max_z": 0.4}
    found = ranges_of(
        "LaserScanBoxFilter", ranges, scan=scan, box_frame="base", invert=invert, **limits
    )
    expected = []
    for end, away in zip(points_of(scan, pose), ranges, strict=True):
        low, high = np.array([-1.0, -1.5, -0.2]), np.array([2.0, 1.0, 0.4])
        removed = end is not None and bool(((end > low) & (end < high)).all()) != invert
        expected.append(NAN if removed else away)
    assert same(found, expected)


@given(RANGES, POSES)
def test_points_in_the_footprint_are_removed(ranges, pose):
    still = transform(pose)
    scan = beams(ranges, motions={"base_link": ScanMotion(still, still)})
    found = ranges_of("LaserScanFootprintFilter", ranges, scan=scan, inscribed_radius=1.5)
    ends = points_of(scan, pose)
    inside = [end is not None and bool((np.abs(end[:2]) <= 1.5).all()) for end in ends]
    assert same(found, [NAN if i else r for i, r in zip(inside, ranges, strict=True)])


@given(RANGES, POSES, st.booleans())
def test_points_in_a_polygon_are_removed(ranges, pose, invert):
    corners = [[-2.0, -1.0], [2.0, -1.5], [1.0, 0.2], [2.0, 2.0], [-1.0, 1.0]]
    still = transform(pose)
    scan = beams(ranges, motions={"base": ScanMotion(still, still)}, angle_increment=0.3)
    found = ranges_of("LaserScanPolygonFilter", ranges, scan=scan, polygon=corners, polygon_frame="base",
                      polygon_padding=0.1, invert=invert)  # fmt: skip
    shape = Polygon([(x + math.copysign(0.1, x), y + math.copysign(0.1, y)) for x, y in corners])
    expected = []
    for end, away in zip(points_of(scan, pose), ranges, strict=True):
        removed = end is not None and shape.contains(Point(end[:2])) != invert
        expected.append(NAN if removed else away)
    assert same(found, expected)


@given(st.floats(-0.3, 0.3), st.floats(-1.0, 1.0))
def test_points_of_a_moving_laser_are_where_it_was_at_their_time(turn, ahead):
    """A beam in the middle of a scan is seen from the middle of the way."""
    ends = [transform((x, 0.0, 0.0, 0.0, 0.0, yaw), stamp) for x, yaw, stamp in
            ((0.0, 0.0, 0), (ahead, turn, 10**9))]  # fmt: skip
    scan = beams([2.0] * 3, time_increment=0.5, motions={"odom": ScanMotion(*ends)})
    points = scan.points_in("odom")
    for number, part in enumerate((0.0, 0.5, 1.0)):
        angle = scan.angles[number] + part * turn
        expected = (part * ahead + 2.0 * math.cos(angle), 2.0 * math.sin(angle), 0.0)
        assert points[number] == pytest.approx(expected, abs=1e-9)


# Parameters -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"name": "a", "type": "laser_filters/LaserScanRangeFiltre"}, "did you mean 'laser_filters/LaserScanRangeFilter'"),
        ({"type": "laser_filters/LaserScanRangeFilter"}, "has name, type and params"),
        ({"name": "a", "type": "LaserScanFootprintFilter"}, "has no 'inscribed_radius'"),
        ({"name": "a", "type": "LaserScanRangeFilter", "params": {"lower_threshold": "x"}}, "must be of type float"),
        ({"name": "a", "type": "LaserScanRangeFilter", "params": [1]}, "must be a mapping"),
        ({"name": "a", "type": "LaserScanMaskFilter", "params": {"masks": {"l": 3}}}, "list of numbers of beams"),
        ({"name": "a", "type": "LaserScanPolygonFilter", "params": {"polygon": [[1, 2]], "polygon_frame": "b"}}, "three or more pairs"),
        ({"name": "a", "type": "LaserArrayFilter"}, "no range_filter_chain"),
        ({"name": "a", "type": "LaserMedianFilter", "params": {"internal_filter": [{"type": "filters/Mean"}]}}, "no filter of channels"),
    ],
)  # fmt: skip
def test_a_wrong_filter_is_named(given, words):
    with pytest.raises(RosError, match=words):
        scan_filter("/chain[0]", given)


def test_every_filter_says_what_it_does():
    assert all(kind.__doc__.startswith("Filter") for kind in KINDS.values())
