"""Rangers whose beams go a little beside where they should: the third number of ``noise``."""

import math

import numpy as np
import pytest
from stage_samples import write

from gazelle.stage import StageSimulation

SENSOR = "ranger ( sensor ( range [0 50] fov 60 samples 241 noise [0 0 {}] ) )"
ROBOT = 'position ( name "{}" size [.2 .2 .4] pose [0 {} 0 0] ' + SENSOR + " )\n"
WALL = "model ( size [1 90 2] pose [3.5 0 0 0] )\n"
ANGLES = np.linspace(-math.pi / 6, math.pi / 6, 241)


@pytest.fixture
def start(tmp_path):
    made = []

    def make(text, **options):
        made.append(StageSimulation(write(tmp_path, text), **options))
        return made[-1]

    yield make
    for sim in made:
        sim.close()


def errors_of(ranges):
    """Return the beams' deviations, from their hits on a wall across the axis [rad]."""
    return np.arccos(3.0 / ranges) - np.abs(ANGLES)


def test_beams_meet_what_is_where_they_go(start):
    sim = start(ROBOT.format("r", 0, 2) + WALL)
    found = []
    for _ in range(20):
        found.append(errors_of(sim.scan_of("r")))
        sim.step()
    wide = np.abs(ANGLES) > 0.2  # where the wall is met at an angle that tells the side
    drawn = np.array(found)[:, wide]
    assert np.std(drawn) == pytest.approx(math.radians(2), rel=0.05)
    assert abs(drawn.mean()) < 0.002
    assert len({row.tobytes() for row in drawn}) == len(drawn)  # new in every scan


def test_without_it_beams_go_where_they_should(start):
    ranges = start(ROBOT.format("r", 0, 0) + WALL).scan_of("r")
    assert ranges == pytest.approx(3.0 / np.cos(ANGLES), rel=1e-12)


def test_other_robots_are_met_too(start):
    sim = start(ROBOT.format("r", 0, 2) + ROBOT.format("s", 1, 2) + "position ( pose [2 0 0 0] )")
    near = sim.scan_of("r")[110:131]
    assert (near < 1.9).all()
    assert np.ptp(near) > 0.0


def test_the_seed_decides_and_not_threads_or_other_worlds(start):
    text = ROBOT.format("r", 0, 2) + ROBOT.format("s", 1, 3) + WALL
    one = start(text, seed=3, threads=1)
    many = start(text, seed=3, threads=2, nworld=40)
    other = start(text, seed=4)
    for sim in (one, many, other):
        sim.step(2)
    assert (one.scan(0)[0] == many.scan(0)[0]).all()
    assert not (many.scan(0)[0] == many.scan(0)[1]).all()
    assert not (one.scan(0) == other.scan(0)).all()
    first = one.scan(0).copy()
    one.reset()
    one.step(2)
    again = one.scan(0)
    assert (again == first).all()


def test_returns_are_of_the_same_beams(start):
    sim = start(ROBOT.format("r", 0, 2) + "model ( size [1 2.4 2] pose [3.5 0 0 0] )")
    ranges = sim.scan(0)[0, 0].copy()
    met = sim.returns(0, 0) > 0.0
    assert (met == (ranges < 50.0)).all()
    assert (sim.scan(0)[0, 0] == ranges).all()


def test_with_next_to_none_it_measures_as_without_in_crowded_worlds(start):
    rng = np.random.default_rng(2)
    things = "".join(
        f"model ( size [{a:.3f} {b:.3f} {1 if i % 4 else 0.2}] pose [{x:.3f} {y:.3f} 0 {t:.1f}] )\n"
        for i, (a, b, x, y, t) in enumerate(
            zip(
                *rng.uniform(0.1, 0.8, (2, 60)),
                *rng.uniform(-12, 12, (2, 60)),
                rng.uniform(0, 360, 60),
                strict=True,
            )
        )
    )
    wide = SENSOR.replace("fov 60", "fov 330").replace("[0 50]", "[0 9]")
    fleet = "".join(
        f"position ( size [.3 .2 .4] pose [{x:.3f} {y:.3f} 0 {t:.1f}] {wide} )\n"
        for x, y, t in zip(*rng.uniform(-14, 14, (2, 30)), rng.uniform(0, 360, 30), strict=True)
    )
    exact = start(fleet.replace("{}", "0") + things).scan(0)
    astray = start(fleet.replace("{}", "0.00000001") + things)
    assert astray.noise[0].angle.all()
    assert np.isclose(astray.scan(0), exact, atol=1e-5).mean() > 0.9995  # but at corners
