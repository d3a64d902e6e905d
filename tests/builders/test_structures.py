"""Buildings, roads and fences."""

import math

import pytest

from gazelle.builders import BuildError, building, fence, road


@pytest.mark.parametrize("pitched", [True, False])
def test_a_building_is_as_high_as_its_storeys(pitched):
    model = building(storeys=3, pitched=pitched)
    body = model.links[0].collisions[0].geometry
    assert body.size == (10.0, 8.0, 9.0)
    assert len({v.name for v in model.links[0].visuals}) == len(model.links[0].visuals)


def test_windows_leave_the_door_free():
    visuals = building(length=12.0).links[0].visuals
    door = next(v for v in visuals if v.name == "door_visual")
    for visual in visuals:
        if visual.name.startswith("window_y-_0"):
            assert abs(visual.pose.x - door.pose.x) >= 1.1


def test_a_road_shows_and_touches_nothing():
    model = road([(0, 0), (10, 0), (10, 10)], width=4.0)
    (link,) = model.links
    assert not link.collisions
    beds = [v for v in link.visuals if v.name.startswith("bed")]
    assert [bed.geometry.size[0] for bed in beds] == [10.0, 10.0]
    assert beds[1].pose.yaw == pytest.approx(math.pi / 2)


def test_a_fence_has_posts_at_both_ends():
    posts = [c for c in fence([(0, 0), (5, 0)]).links[0].collisions if c.name.startswith("post")]
    assert [p.pose.x for p in posts] == pytest.approx([0.0, 5 / 3, 10 / 3, 5.0])


@pytest.mark.parametrize("make", [road, fence])
def test_lines_need_points(make):
    with pytest.raises(BuildError, match="at least 2"):
        make([(0, 0)])
    with pytest.raises(BuildError, match="coincide"):
        make([(0, 0), (0, 0)])
    with pytest.raises(BuildError, match="finite"):
        make([(0, 0), (math.nan, 0)])


def test_impossible_buildings_are_refused():
    with pytest.raises(BuildError):
        building(length=1.0)
    with pytest.raises(BuildError):
        building(storeys=0)
