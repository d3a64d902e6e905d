"""Particles find where a robot is, and their models are the textbook's."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.description import Pose
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import Error
from gazelle.navigation.localization import AmclSettings, Localizer, ParticleFilter, PlanarScan
from gazelle.navigation.localization.odometry_models import MODELS, move_particles
from gazelle.navigation.localization.scan_likelihood import BeamModel, LikelihoodField
from gazelle.navigation.localization.scan_model import ScanModel
from gazelle.navigation.planners.planar import composed

ANGLES = np.radians(np.arange(0.0, 360.0, 2.0))
LASER = (-0.03, 0.0, 0.0)


def room():
    """Return an asymmetric room of 8 m by 6 m with an inner wall and pillars."""
    grid = np.zeros((120, 160), np.int8)
    grid[[0, -1]] = grid[:, [0, -1]] = 100
    grid[0:70, 60:63] = 100
    grid[30:36, 100:106] = 100
    grid[80:100, 120:124] = 100
    grid[90:94, 20:50] = 100
    return OccupancyMap(grid, 0.05, Pose(-1.0, -2.0))


def rays(grid):
    return BeamModel(
        (grid.data != 0).view(np.uint8), (grid.origin.x, grid.origin.y), grid.resolution,
        np.ones(4), 0.2, 0.1,
    )  # fmt: skip


def scan_at(model, pose, random=None, most=3.5):
    x, y, heading = composed(pose, LASER)
    ranges = np.array([model.range_at(x, y, heading + angle, most) for angle in ANGLES])
    if random is not None:
        ranges = ranges + random.normal(0.0, 0.01, len(ranges))
    return PlanarScan(np.where(ranges >= most, np.inf, ranges), ANGLES, most, 0.12, LASER)


def walk(localizer, model, pose, steps, *, slip=1.03, seed=1):
    """Drive with odometry that is off; returns the last true pose."""
    random = np.random.default_rng(seed)
    odom = (0.0, 0.0, 0.0)
    localizer.update(odom, scan_at(model, pose, random))
    for forward, turn in steps:
        pose = composed(pose, (forward, 0.0, turn))
        odom = composed(odom, (forward * slip, 0.0, turn * slip))
        localizer.update(odom, scan_at(model, pose, random))
    return pose


LOOP = (
    [(0.2, 0.0)] * 8 + [(0.05, 0.25)] * 6 + [(0.2, 0.0)] * 10 + [(0.05, 0.3)] * 6 + [(0.2, 0.0)] * 8
)
TB3 = {
    "min_particles": 500, "max_particles": 3000, "kld_err": 0.02, "update_min_d": 0.15,
    "update_min_a": 0.2, "resample_interval": 1, "recovery_alpha_slow": 0.0,
    "recovery_alpha_fast": 0.0, "laser_max_range": 3.5, "laser_max_beams": 180, "laser_z_hit": 0.5,
    "laser_z_rand": 0.5, "odom_alpha1": 0.1, "odom_alpha2": 0.1, "odom_alpha3": 0.1,
    "odom_alpha4": 0.1,
}  # fmt: skip


def off(estimate, pose):
    place = math.hypot(estimate.pose[0] - pose[0], estimate.pose[1] - pose[1])
    return place, abs(math.remainder(estimate.pose[2] - pose[2], 2 * math.pi))


@pytest.mark.parametrize("laser", ["likelihood_field", "likelihood_field_prob", "beam"])
@pytest.mark.parametrize("model", MODELS)
def test_a_robot_is_followed_though_its_odometry_is_off(laser, model):
    grid = room()
    few = (
        {"max_particles": 500, "min_particles": 100, "laser_max_beams": 60}
        if laser == "beam"
        else {}
    )
    if laser == "likelihood_field_prob":
        # Beams count as independent there: so many of them leave next to no particle.
        few = {"laser_max_beams": 20}
    settings = AmclSettings.read(
        {**TB3, "laser_model_type": laser, "odom_model_type": model, **few}
    )
    localizer = Localizer(settings, grid)
    start = (0.0, -1.0, 0.8)
    localizer.begin((0.15, -1.1, 0.9), np.diag([0.1, 0.1, 0.05]))
    end = walk(localizer, rays(grid), start, LOOP)
    place, heading = off(localizer.estimate, end)
    assert place < (0.1 if laser == "likelihood_field" else 0.3)
    assert heading < 0.1
    assert localizer.map_to_odom is not None


SURE = {
    **TB3,
    "laser_max_range": 8.0,
    "laser_z_hit": 0.95,
    "laser_z_rand": 0.05,
    "laser_max_beams": 60,
}
AROUND = [*[(0.2, 0.0)] * 9, *[(0.02, 0.26)] * 6] * 4
"""About a square in the right part of the room."""


STAGE = {
    "min_particles": 500, "max_particles": 5000, "kld_err": 0.05, "laser_z_hit": 0.5, "laser_z_rand": 0.5,
    "resample_interval": 1, "recovery_alpha_slow": 0.0, "recovery_alpha_fast": 0.0, "update_min_a": 0.5,
}  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("settings", [TB3, {**SURE, "max_particles": 5000}, STAGE, {}])
def test_a_robot_is_found_anywhere_on_the_map(settings):
    """Twenty times of twenty, with the published numbers of particles (100 to 5,000)."""
    grid = room()
    model = rays(grid)
    for seed in range(20):
        localizer = Localizer(AmclSettings.read(settings), grid, seed=seed)
        localizer.begin_anywhere()
        start, steps = [((3.0, -1.2, 0.0), AROUND), ((-0.3, -1.2, 0.5), LOOP)][seed % 2]
        end = walk(localizer, model, start, steps, slip=1.01, seed=seed)
        odom = (0.0, 0.0, 0.0)
        for forward, turn in steps:
            odom = composed(odom, (forward * 1.01, 0.0, turn * 1.01))
        found = composed(localizer.map_to_odom, odom)
        assert math.dist(found[:2], end[:2]) < 0.25
        assert abs(math.remainder(found[2] - end[2], 2 * math.pi)) < 0.25


def crowded(scan, angles):
    """Return a scan with people around the robot: a third of its beams end on them."""
    ranges = scan.ranges.copy()
    ranges[np.abs(np.sin(1.5 * angles)) > 0.87] = 0.5
    return PlanarScan(ranges, scan.angles, scan.range_max, scan.range_min, scan.laser)


def test_beams_that_end_on_what_no_map_has_are_skipped():
    grid = room()
    values = {
        "laser_model_type": "likelihood_field_prob", "laser_max_beams": 60, "laser_z_hit": 0.95, "laser_z_rand": 0.05,
        "max_particles": 500,
    }  # fmt: skip
    pose, random = (0.0, -1.0, 0.8), np.random.default_rng(4)
    scan = crowded(scan_at(rays(grid), pose, random), ANGLES)
    poses = np.array(pose) + random.normal(0.0, (0.1, 0.1, 0.05), (500, 3))
    clean = ScanModel(AmclSettings.read(values), grid).scores(poses, scan_at(rays(grid), pose))
    skipping = ScanModel(AmclSettings.read({**values, "do_beamskip": True}), grid)
    # Only where particles are close together, and scores then are those of the beams that remain.
    assert np.array_equal(
        skipping.scores(poses, scan),
        ScanModel(AmclSettings.read(values), grid).scores(poses, scan),
    )

    def likeness(found):
        return np.corrcoef(np.log(found), np.log(clean))[0, 1]

    plain = ScanModel(AmclSettings.read(values), grid).scores(poses, scan)
    assert likeness(skipping.scores(poses, scan, converged=True)) > max(likeness(plain), 0.98)


def test_when_hardly_any_beam_fits_none_is_skipped():
    grid = room()
    values = {"laser_model_type": "likelihood_field_prob", "laser_max_beams": 60}
    poses = np.tile((6.0, 3.0, 0.0), (50, 1))
    scan = PlanarScan(np.full(len(ANGLES), 0.4), ANGLES, 3.5, 0.12, LASER)
    plain = ScanModel(AmclSettings.read(values), grid).scores(poses, scan)
    skipping = ScanModel(AmclSettings.read({**values, "do_beamskip": True}), grid)
    assert np.array_equal(skipping.scores(poses, scan, converged=True), plain)


def test_a_robot_that_was_carried_away_is_looked_for_all_over_the_map():
    grid = room()
    settings = AmclSettings.read(
        {**SURE, "recovery_alpha_slow": 0.001, "recovery_alpha_fast": 0.5, "max_particles": 5000}
    )
    localizer, model = Localizer(settings, grid), rays(grid)
    localizer.begin((0.0, -1.0, 0.8), np.diag([0.05, 0.05, 0.02]))
    walk(localizer, model, (0.0, -1.0, 0.8), LOOP[:10])
    odom, pose, random = (9.0, 9.0, 0.0), (3.0, -1.2, 0.0), np.random.default_rng(5)
    localizer._odom = odom
    spread = []
    for forward, turn in AROUND[:20]:
        pose = composed(pose, (forward, 0.0, turn))
        odom = composed(odom, (forward, 0.0, turn))
        localizer.force_update()
        localizer.update(odom, scan_at(model, pose, random))
        spread.append(localizer.filter.poses[:, :2].std())
    assert min(spread) < 0.3
    assert max(spread) > 0.5


def test_standing_still_changes_nothing_unless_it_is_asked_for():
    grid = room()
    localizer, model = Localizer(AmclSettings(), grid), rays(grid)
    scan = scan_at(model, (0.0, -1.0, 0.0))
    assert localizer.update((0.0, 0.0, 0.0), scan) is not None
    before = localizer.filter.poses.copy()
    assert localizer.update((0.1, 0.0, 0.1), scan) is None
    assert np.array_equal(localizer.filter.poses, before)
    localizer.force_update()
    assert localizer.update((0.1, 0.0, 0.1), scan) is not None


def test_equal_seeds_give_equal_bits():
    def run():
        localizer = Localizer(AmclSettings.read(TB3), room(), seed=3)
        localizer.begin((0.0, -1.0, 0.8), np.diag([0.1, 0.1, 0.05]))
        walk(localizer, rays(room()), (0.0, -1.0, 0.8), LOOP[:12])
        return localizer.filter.poses

    assert np.array_equal(run(), run())


# The parts -------------------------------------------------------------------------------


def test_the_field_is_the_formula():
    random = np.random.default_rng(0)
    terms = random.random((20, 30)).astype(np.float32)
    field = LikelihoodField(terms, (-1.0, 2.0), 0.1, 0.125)
    poses = random.uniform((-2.0, 1.0, -3.0), (3.0, 5.0, 3.0), (50, 3))
    points = random.uniform(-1.0, 1.0, (17, 2))
    for pose, score in zip(poses, field.scores(poses, points, 1.0), strict=True):
        total = 1.0
        for point in points:
            x, y, _ = composed(tuple(pose), (*point, 0.0))
            column, row = math.floor((x + 1.0) / 0.1), math.floor((y - 2.0) / 0.1)
            inside = 0 <= column < 30 and 0 <= row < 20
            total += float(terms[row, column]) if inside else 0.125
        assert score == pytest.approx(total, rel=1e-6)


@given(st.floats(0.1, 5.9), st.floats(0.1, 3.9), st.floats(-3.1, 3.1))
def test_rays_in_a_box_end_at_its_walls(x, y, heading):
    occupied = np.ones((42, 62), np.uint8)
    occupied[1:-1, 1:-1] = 0
    model = BeamModel(occupied, (-0.1, -0.1), 0.1, np.ones(4), 0.2, 0.1)
    c, s = math.cos(heading), math.sin(heading)
    ahead = [(6.0 - x) / c if c > 0 else -x / c] if abs(c) > 1e-12 else []
    ahead += [(4.0 - y) / s if s > 0 else -y / s] if abs(s) > 1e-12 else []
    assert model.range_at(x, y, heading, 50.0) == pytest.approx(min(ahead), abs=1e-6)


@pytest.mark.parametrize("model", MODELS)
def test_without_noise_particles_move_as_odometry_does(model):
    poses = np.array([[1.0, 2.0, 0.5], [0.0, 0.0, -2.0]])
    before, after = (0.3, 0.1, 0.2), (0.9, -0.4, 1.0)
    move_particles(poses, before, after, model, np.zeros(5), np.random.default_rng(0))
    from gazelle.navigation.planners.planar import between

    step = between(before, after)
    for found, start in zip(poses, ((1.0, 2.0, 0.5), (0.0, 0.0, -2.0)), strict=True):
        assert found == pytest.approx(composed(start, step), abs=1e-9)


def test_noise_spreads_as_the_alphas_say():
    def spread(model):
        poses = np.zeros((20000, 3))
        alphas = np.array([0.0, 0.0, 0.04, 0.0, 0.0])
        move_particles(poses, (0, 0, 0), (2.0, 0, 0), model, alphas, np.random.default_rng(0))
        return poses[:, 0].std()

    # "corrected" takes it for the variance, the others for the deviation.
    assert spread("diff") == pytest.approx(0.04 * 4.0, rel=0.03)
    assert spread("diff-corrected") == pytest.approx(math.sqrt(0.04 * 4.0), rel=0.03)


@given(st.integers(2, 400))
def test_more_bins_need_more_particles(bins):
    particles = ParticleFilter(100, 100000, 0.01, 0.99, 0, 0, np.random.default_rng(0))
    few, more = particles.needed(np.array([bins, bins + 1]))
    assert 100 <= few <= more
    # Chi-square of bins - 1 degrees of freedom over twice the error, by Wilson and Hilferty.
    k = bins - 1
    exact = k / 0.02 * (1 - 2 / (9 * k) + math.sqrt(2 / (9 * k)) * 0.99) ** 3
    assert few == max(100, math.ceil(exact))


def test_the_estimate_is_the_heaviest_cluster():
    particles = ParticleFilter(10, 300, 0.01, 0.99, 0, 0, np.random.default_rng(0))
    random = np.random.default_rng(1)
    near = random.normal((1.0, 2.0, 3.1), 0.05, (200, 3))
    far = random.normal((8.0, 8.0, 0.0), 0.05, (100, 3))
    particles.begin(np.vstack((far, near)))
    found = particles.estimate()
    assert found.pose[:2] == pytest.approx((1.0, 2.0), abs=0.02)
    assert found.weight == pytest.approx(2 / 3)


@pytest.mark.parametrize(
    "wrong", [{"odom_model_type": "dif"}, {"laser_model_type": "beams"}, {"max_particles": "many"}]
)
def test_wrong_settings_are_named(wrong):
    with pytest.raises(Error):
        AmclSettings.read(wrong)
