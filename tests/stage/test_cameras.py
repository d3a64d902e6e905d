"""Images of Stage's cameras by the geometry of a pinhole."""

import math

import numpy as np
import pytest
from stage_samples import draw

from gazelle import SimulationError

ROWS, COLUMNS = 120, 160
LENS = f"resolution [{COLUMNS} {ROWS}] range [0.2 20] fov [90 60] "
BODY = "size [.2 .2 .5] "
SKY, FLOOR, GREEN, RED = (179, 179, 204), (255, 255, 255), (0, 255, 0), (255, 0, 0)
FX = COLUMNS / 2 / math.tan(math.radians(45))
FY = ROWS / 2 / math.tan(math.radians(30))


def robot(camera="", more=""):
    return f'position ( name "r" {BODY} {more} camera ( {LENS} {camera} ) )\n'


WALL = 'model ( size [1 40 {height}] pose [{x} 0 0 0] color "green" )\n'


def rows_of(picture, color, column):
    """Return first and last row in which a column has a colour."""
    found = np.flatnonzero((picture.color[:, column, :3] == color).all(axis=1))
    return int(found[0]), int(found[-1])


@pytest.mark.parametrize("distance", [1.0, 2.5, 7.0])
@pytest.mark.parametrize("height", [0.2, 1.0, 1.7])
def test_a_wall_covers_the_rows_that_a_pinhole_gives_it(start, distance, height):
    sim = start(robot() + WALL.format(x=distance + 0.5, height=height))
    seen = sim.picture("r")
    # The camera is at the top of its robot, 0.5 m high; a pixel is what its middle sees.
    top = ROWS / 2 - FY * (height - 0.5) / distance
    bottom = ROWS / 2 + FY * 0.5 / distance
    if height < 0.5:  # then its top is seen too, as far as it goes
        top = ROWS / 2 - FY * (height - 0.5) / (distance + 1.0)
    first, last = rows_of(seen, GREEN, COLUMNS // 2)
    assert first == max(math.ceil(top - 0.5), 0)
    assert last == min(math.ceil(bottom - 0.5), ROWS) - 1


def test_depth_is_the_distance_along_the_axis(start):
    sim = start(robot() + WALL.format(x=3.5, height=1.0))
    depth = sim.picture("r").depth
    assert depth[ROWS // 2] == pytest.approx(3.0, abs=1e-5)  # also where the wall is far aside
    row = ROWS - 10
    assert depth[row] == pytest.approx(0.5 * FY / (row + 0.5 - ROWS / 2), rel=1e-6)  # the floor
    assert np.isinf(depth[0]).all()
    assert depth.dtype == np.float32


def test_sky_and_floor(start):
    color = start(robot() + WALL.format(x=3.5, height=1.0)).picture("r").color
    assert color.shape == (ROWS, COLUMNS, 4)
    assert (color[0, :, :3] == SKY).all()
    assert (color[-1, :, :3] == FLOOR).all()
    assert (color[..., 3] == 255).all()


def test_nothing_is_seen_nearer_or_farther_than_the_range(start):
    far = start(robot("range [0.2 2.9]") + WALL.format(x=3.5, height=1.0)).picture("r")
    assert not (far.color[..., :3] == GREEN).all(axis=2).any()
    near = start(robot("range [3.1 20]") + WALL.format(x=3.5, height=0.6)).picture("r")
    assert near.depth[ROWS // 2, COLUMNS // 2] == np.inf


def test_nothing_is_seen_from_its_inside(start):
    body = 'position ( name "r" size [2 2 1] camera ( pose [0 0 -.5 0] ' + LENS + ") )\n"
    seen = start(body + WALL.format(x=3.5, height=1.0)).picture("r")
    assert tuple(seen.color[ROWS // 2, COLUMNS // 2, :3]) == GREEN
    assert seen.depth[ROWS // 2, COLUMNS // 2] == pytest.approx(3.0, rel=1e-6)


@pytest.mark.parametrize(
    ("where", "camera"),
    [
        ("pose [0 -3 0 0]", "pantilt [90 0]"),
        ("pose [0 3 0 0]", "pantilt [-90 0]"),
        ("pose [0 3 0 0]", "pose [0 0 0 90]"),
        ("pose [-3 0 0 0]", "pose [0 0 0 90] pantilt [-90 0]"),
    ],
)
def test_a_pan_is_to_the_right_and_the_heading_of_the_camera_counts(start, where, camera):
    post = f'model ( size [.2 .2 2] {where} color "red" )'
    seen = start(robot(camera) + post).picture("r")
    assert tuple(seen.color[ROWS // 2, COLUMNS // 2, :3]) == RED
    assert seen.depth[ROWS // 2, COLUMNS // 2] == pytest.approx(2.9, rel=1e-6)


def test_a_tilt_is_down(start):
    seen = start(robot("pantilt [0 90]", "origin [0 0 0 0]")).picture("r")
    assert (seen.color[..., :3] == FLOOR).any()
    assert seen.depth[ROWS // 2, 0] == pytest.approx(0.5, rel=1e-6)  # straight down
    level = start(robot("pantilt [0 20]") + WALL.format(x=3.5, height=5.0)).picture("r")
    # The wall at the angle a below the axis' own is on the axis 3 / cos(a) away.
    middle = level.depth[ROWS // 2 - 1 : ROWS // 2 + 1, COLUMNS // 2].mean()
    assert middle == pytest.approx(0.5 / math.sin(math.radians(20)), rel=1e-3)
    slope = -(0.5 - ROWS / 2) / FY
    tilt = math.radians(20)
    along = 3.0 / (math.cos(tilt) + slope * math.sin(tilt))
    assert level.depth[0, COLUMNS // 2] == pytest.approx(along, rel=1e-5)


def test_left_is_left_and_nearer_hides_farther(start):
    sim = start(
        robot()
        + 'model ( size [.4 .4 2] pose [2 1 0 0] color "red" )'
        + 'model ( size [.4 .4 2] pose [4 2 0 0] color "blue" )'
        + WALL.format(x=8, height=3)
    )
    color = sim.picture("r").color[ROWS // 2, :, :3]
    columns = np.flatnonzero((color == RED).all(axis=1))
    assert columns.max() < COLUMNS / 2
    assert not (color == (0, 0, 255)).all(axis=1).any()
    assert tuple(color[-1]) == GREEN


def test_robots_are_seen_where_they_are_now(start):
    sim = start(robot() + 'position ( name "o" size [.4 .4 1] pose [3 0 0 0] color "red" )')
    before = sim.picture("r")
    assert before.depth[ROWS // 2, COLUMNS // 2] == pytest.approx(2.8, rel=1e-6)
    assert sim.picture("r") is before  # drawn once a step
    sim.commands[0, 1, 0] = 1.0
    sim.step()
    sim.step()
    after = sim.picture("r").depth[ROWS // 2, COLUMNS // 2]
    assert after == pytest.approx(2.8 + sim.poses[0, 1, 0] - 3.0, rel=1e-6)
    assert after > 2.9


def test_a_camera_sees_what_else_is_on_its_robot(start):
    arm = 'model ( size [.1 .1 .3] pose [0.5 0 0 0] color "red" )'
    seen = start(f'position ( name "r" {BODY} {arm} camera ( {LENS} ) )').picture("r")
    assert tuple(seen.color[ROWS // 2 - 1, COLUMNS // 2, :3]) == RED
    assert seen.depth[ROWS // 2 - 1, COLUMNS // 2] == pytest.approx(0.45, rel=1e-6)


def test_a_camera_does_not_see_its_own_casing_but_others_do(start):
    # Two plates, before and behind the camera, as wide as a block of Stage's is stretched.
    plate = "block ( points 4 point[0] [{0} 0] point[1] [{1} 0] point[2] [{1} 9] point[3] [{0} 9] z [0 1] ) "
    casing = plate.format(0, 1) + plate.format(8, 9) + 'size [1 1 1] color "green" '
    other = f'position ( name "o" size [.2 .2 .5] pose [2 0 0 180] camera ( {LENS} ) )'
    sim = start(robot(casing) + other)
    assert not (sim.picture("r").color[..., :3] == GREEN).all(axis=2).any()
    assert sim.picture("r").depth[ROWS // 2, COLUMNS // 2] == pytest.approx(1.9, rel=1e-6)
    assert (sim.picture("o").color[ROWS // 2 - 2, COLUMNS // 2, :3] == GREEN).all()


def test_walls_of_bitmaps_and_their_tops(start, tmp_path):
    draw(tmp_path, ["###", "#.#", "###"])
    ring = 'model ( size [6 6 .2] pose [0 0 0 0] bitmap "map.png" color "red" )'
    seen = start(robot() + ring).picture("r")
    # The wall stands 1 m ahead and is 2 m deep.
    first, last = rows_of(seen, RED, COLUMNS // 2)
    assert first == math.ceil(ROWS / 2 + FY * 0.3 / 3.0 - 0.5)
    assert last == math.ceil(ROWS / 2 + FY * 0.5 / 1.0 - 0.5) - 1 or last == ROWS - 1


def test_colours_of_blocks(start):
    square = "points 4 point[0] [0 0] point[1] [1 0] point[2] [1 1] point[3] [0 1]"
    block = f'block ( {square} z [0 1] color "red" )'
    thing = f'model ( size [1 1 1] pose [3 0 0 0] color "green" {block} )'
    assert tuple(start(robot() + thing).picture("r").color[ROWS // 2, 80, :3]) == RED


def test_pictures_of_many_robots_and_worlds_are_those_of_each(start):
    many = "".join(
        f'position ( name "r{i}" {BODY} pose [{i} {i} 0 {50 * i}] camera ( {LENS} ) )\n'
        for i in range(3)
    )
    sim = start(many + "position ( )" + WALL.format(x=6, height=2), nworld=2)
    sim.set_pose("r1", (2.0, -1.0, 1.0), np.array([1]))
    seen = sim.pictures()
    assert seen.color.shape == (2, 3, ROWS, COLUMNS, 4)
    for world in range(2):
        for i in range(3):
            one = sim.picture(f"r{i}", world=world)
            assert (one.color == seen.color[world, i]).all()
            assert (one.depth == seen.depth[world, i]).all()
    assert (seen.color[0, 1] != seen.color[1, 1]).any()
    assert (sim.pictures(["r1"], worlds=np.array([1])).depth[0, 0] == seen.depth[1, 1]).all()


def test_what_is_not_there_cannot_be_looked_through(start):
    sim = start(robot())
    with pytest.raises(SimulationError, match="1 cameras, no number 1"):
        sim.picture("r", camera=1)
    with pytest.raises(SimulationError, match="no robot"):
        sim.picture("x")
    mixed = robot() + f'position ( name "s" camera ( {LENS} range [0.2 9] ) )'
    with pytest.raises(SimulationError, match="same resolution"):
        start(mixed).pictures()
