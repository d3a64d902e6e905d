"""Costmaps cost what costmap_2d's do: the rules of its own tests, restated."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.description import Pose
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import Error, SimulationWarning
from gazelle.navigation.costmap import (
    Costmap,
    InflationLayer,
    ObservationSource,
    ObstacleLayer,
    StaticLayer,
    VoxelLayer,
    costmap_of,
    footprint_of,
)
from gazelle.navigation.costmap.footprint import cells_under, placed, radii_of
from gazelle.navigation.costmap.values import shown
from gazelle.navigation.planners.rollout import TrajectoryRollout

SQUARE = footprint_of([[-1, -1], [-1, 1], [1, 1], [1, -1]], padding=0.0)
LETHAL, INSCRIBED, FREE, UNKNOWN = 254, 253, 0, 255


def seeing(name="scan", **settings):
    return {name: ObservationSource(clearing=True, **settings)}


def look(layer, costmap, points, origin=(0.0, 0.0, 0.5), time=0.0, pose=(0.0, 0.0, 0.0)):
    layer.observe("scan", time, np.array(origin), np.array(points, float).reshape(-1, 3))
    return costmap.update(pose)


def small(layers, **others):
    return Costmap(
        layers, others.pop("footprint", SQUARE * 0.01), width=10, height=10, resolution=1, **others
    )


# Footprints ------------------------------------------------------------------------------


def test_a_footprint_is_padded_away_from_the_middle():
    assert footprint_of("[[1, 1], [-1, 1], [-1, -1]]", padding=0.5).tolist() == [
        [1.5, 1.5],
        [-1.5, 1.5],
        [-1.5, -1.5],
    ]
    assert radii_of(SQUARE) == pytest.approx((1.0, math.sqrt(2.0)))


def test_a_radius_is_a_polygon_of_sixteen_corners():
    round_one = footprint_of("[]", radius=10.0, padding=0.0)
    assert len(round_one) == 16
    assert np.hypot(*round_one.T) == pytest.approx(10.0)


@pytest.mark.parametrize(
    "wrong", ["[[1, 2]]", "what", "[[1], [2], [3]]", [[0, 0], [1, math.nan], [1, 1]]]
)
def test_what_is_no_footprint_is_refused(wrong):
    with pytest.raises(Error, match="footprint"):
        footprint_of(wrong)


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(-4.0, 4.0), st.floats(0.3, 6.0))
def test_a_robot_is_on_the_cells_within_it_and_on_its_outline(x, y, heading, long):
    corners = placed(SQUARE * (long, 2.5), x, y, heading)
    found = set(
        zip(*(axis.tolist() for axis in cells_under(np.floor(corners).astype(int))), strict=True)
    )
    for column in range(-10, 11):
        for row in range(-10, 11):
            # In the frame of the robot: a cell whose middle is more than a diagonal within is one of
            # them, one that is more than a diagonal off is none.
            dx, dy = column + 0.5 - x, row + 0.5 - y
            along = abs(math.cos(heading) * dx + math.sin(heading) * dy) - long
            aside = abs(math.cos(heading) * dy - math.sin(heading) * dx) - 2.5
            if max(along, aside) < -1.5:
                assert (column, row) in found
            if max(along, aside) > 1.5:
                assert (column, row) not in found
    columns, rows = np.floor(corners).astype(int).T
    assert set(zip(columns.tolist(), rows.tolist(), strict=True)) <= found


# Inflation -------------------------------------------------------------------------------


@given(st.floats(0.1, 4.0), st.floats(0.5, 10.0), st.floats(0.05, 2.0))
def test_costs_fall_off_with_the_distance(radius, scaling, inscribed):
    layer, source = (
        InflationLayer(radius=radius, scaling=scaling),
        ObstacleLayer(
            "o", {"scan": ObservationSource(obstacle_range=100)}, footprint_clearing=False
        ),
    )
    costmap = Costmap([source, layer], SQUARE * inscribed, width=10, height=10, resolution=0.25)
    look(source, costmap, [[5.1, 5.1, 0.2]], origin=(9.0, 9.0, 0.2))
    rows, columns = np.indices(costmap.cells.shape)
    away = np.hypot(rows - 20, columns - 20) * 0.25
    exact = np.where(
        away <= inscribed, 253, (252 * np.exp(-scaling * (away - inscribed))).astype(int)
    )
    exact[20, 20] = LETHAL
    reach = math.ceil(radius / 0.25 - 1e-9) * 0.25
    exact[away > reach + 1e-9] = 0
    assert np.array_equal(costmap.cells, exact)


def test_more_obstacles_never_lower_costs():
    rng = np.random.default_rng(3)
    source = ObstacleLayer("o", {"scan": ObservationSource(obstacle_range=100)})
    costmap = Costmap(
        [source, InflationLayer(radius=1.0)], SQUARE * 0.2, width=10, height=10, resolution=0.1
    )
    before = costmap.cells.copy()
    for _ in range(20):
        point = [*rng.uniform(1, 9, 2), 0.3]
        look(source, costmap, [point], origin=(5, 5, 0.3), pose=(-5, -5, 0))
        assert (costmap.cells >= before).all()
        before = costmap.cells.copy()


def test_a_small_update_is_as_good_as_a_whole_one():
    rng = np.random.default_rng(4)

    def make():
        source = ObstacleLayer("scan", seeing(obstacle_range=3, raytrace_range=3))
        static = StaticLayer()
        costmap = Costmap(
            [static, source, InflationLayer(radius=0.7, scaling=2)], SQUARE * 0.2, resolution=0.1
        )
        static.set_map(
            OccupancyMap((rng.random((90, 70)) < 0.01).astype(np.int8) * 100, 0.1, Pose(-3, -4)),
            costmap,
        )
        return source, costmap

    source, costmap = make()
    for _ in range(15):
        angle = rng.uniform(0, 6.28, 60)
        far = rng.uniform(0.3, 3.5, 60)
        x, y = rng.uniform(-1, 1, 2)
        points = np.stack((x + far * np.cos(angle), y + far * np.sin(angle), 0 * far), 1)
        look(source, costmap, points, origin=(x, y, 0.0), pose=(x, y, 0.0))
    partial = costmap.cells.copy()
    # The layers know the same; only what is drawn is forgotten.
    costmap.cells.fill(0)
    costmap.layers[0].reset()
    costmap.layers[2].reset()
    costmap.update((x, y, 0.0))
    assert np.array_equal(costmap.cells, partial)


def test_unknown_cells_get_costs_only_where_they_are_hit_for_sure():
    source = ObstacleLayer(
        "o", {"scan": ObservationSource(obstacle_range=100)}, footprint_clearing=False
    )
    layer = InflationLayer(radius=3.0, scaling=1.0)
    costmap = Costmap(
        [source, layer], SQUARE, width=10, height=10, resolution=0.5, track_unknown=True
    )
    look(source, costmap, [[5.1, 5.1, 0.2]], origin=(1, 1, 0.2), pose=(2.0, 2.0, 0.0))
    assert costmap.cost_at(5.1, 5.9) == INSCRIBED
    assert costmap.cost_at(5.1, 7.1) == UNKNOWN


# Obstacles -------------------------------------------------------------------------------


def test_what_is_seen_is_an_obstacle_and_what_is_before_it_free():
    layer = ObstacleLayer("o", seeing(), footprint_clearing=False)
    costmap = small([layer], track_unknown=True)
    look(layer, costmap, [[2.5, 0.5, 0.5]], origin=(0.5, 0.5, 0.5))
    assert costmap.cells[0, :4].tolist() == [FREE, FREE, LETHAL, UNKNOWN]
    look(layer, costmap, [[0.5, 2.5, 0.5]], origin=(0.5, 0.5, 0.5))
    assert costmap.cells[:4, 0].tolist() == [FREE, FREE, LETHAL, UNKNOWN]
    # It remembers.
    assert costmap.cells[0, 2] == LETHAL
    look(layer, costmap, [[3.4, 0.5, 0.5]], origin=(0.5, 0.5, 0.5))
    assert costmap.cells[0, 2] == FREE


def test_what_is_too_far_too_high_or_too_low_does_not_count():
    layer = ObstacleLayer("o", seeing(obstacle_range=3.0, raytrace_range=2.0), max_height=1.0)
    costmap = small([layer])
    look(
        layer,
        costmap,
        [[4.5, 0.5, 0.5], [1.5, 1.5, 3.0], [1.5, 1.5, -0.1], [2.5, 1.5, 1.5]],
        origin=(0.5, 0.5, 0.5),
    )
    assert not costmap.cells.any()


def test_observations_persist_as_long_as_they_should():
    source = ObservationSource(obstacle_range=9, persistence=1.0)
    layer = ObstacleLayer("o", {"scan": source})
    costmap = small([layer])
    look(layer, costmap, [[2.5, 0.5, 0.5]], time=0.0)
    look(layer, costmap, [[3.5, 0.5, 0.5]], time=0.5)
    assert len(source.observations) == 2
    look(layer, costmap, [[4.5, 0.5, 0.5]], time=1.4)
    assert [each.time for each in source.observations] == [0.5, 1.4]


def test_a_robot_stands_on_free_ground():
    layer = ObstacleLayer("o", {"scan": ObservationSource(obstacle_range=9)})
    costmap = small([layer], footprint=SQUARE * 1.4)
    look(
        layer, costmap, [[5.5, 5.5, 0.5], [8.5, 8.5, 0.5]], pose=(5.5, 5.5, 0.0), origin=(4, 4, 0.5)
    )
    assert costmap.cost_at(5.5, 5.5) == FREE
    assert costmap.cost_at(8.5, 8.5) == LETHAL


@given(
    st.floats(-0.05, 0.05), st.floats(-0.05, 0.05), st.floats(-4.0, 4.0), st.floats(0.05, 0.4), st.integers(3, 6)
)  # fmt: skip
def test_a_robot_among_obstacles_never_stands_on_one(x, y, heading, side, corners):
    """What is seen where it stands is freed up to its outline, so that it may drive off again."""
    turns = 2.0 * math.pi * np.arange(corners) / corners
    footprint = side * np.stack((np.cos(turns), 0.7 * np.sin(turns)), axis=1)
    source = ObservationSource(obstacle_range=9)
    costmap = Costmap(
        [ObstacleLayer("o", {"scan": source}), InflationLayer(radius=0.3)],
        footprint, width=2, height=2, resolution=0.05, rolling=True,
    )  # fmt: skip
    grid = np.stack(np.meshgrid(*[np.arange(-0.9, 0.9, 0.04)] * 2), -1).reshape(-1, 2)
    points = np.column_stack((grid, np.full(len(grid), 0.5)))
    look(costmap.layers[0], costmap, points, pose=(x, y, heading))
    rollout = TrajectoryRollout(
        costmap.cells, costmap.origin, 0.05, footprint, np.zeros((4, *costmap.cells.shape), np.int32),
        np.zeros(6), 0.0,
    )  # fmt: skip
    assert rollout.footprint_cost(x, y, heading) >= 0.0
    assert rollout.footprint_cost(x + 0.3, y, heading) < 0.0


def test_a_rolling_map_keeps_what_stays_in_its_window():
    layer = ObstacleLayer(
        "o", {"scan": ObservationSource(obstacle_range=9)}, footprint_clearing=False
    )
    costmap = Costmap([layer], SQUARE * 0.1, width=4, height=4, resolution=0.5, rolling=True)
    look(layer, costmap, [[1.3, 0.3, 0.0]], origin=(0, 0, 0))
    assert costmap.cost_at(1.3, 0.3) == LETHAL
    layer.sources["scan"].observations.clear()
    costmap.update((1.0, 0.2, 0.0))
    assert costmap.origin == pytest.approx((-1.0, -2.0))
    assert costmap.cost_at(1.3, 0.3) == LETHAL
    assert (costmap.cells == LETHAL).sum() == 1
    costmap.update((5.0, 0.2, 0.0))
    costmap.update((1.0, 0.2, 0.0))
    assert not costmap.cells.any()


def test_clearing_keeps_or_forgets_what_is_around_the_robot():
    layer = ObstacleLayer("obstacle_layer", {"scan": ObservationSource(obstacle_range=20)})
    costmap = small([layer])
    look(layer, costmap, [[4.5, 4.5, 0.5], [9.5, 9.5, 0.5]], origin=(3, 3, 0.5))
    layer.sources["scan"].observations.clear()
    costmap.clear((4.5, 4.5, 0.0), 3.0, ["obstacle_layer"])
    costmap.update((0.0, 0.0, 0.0))
    assert np.argwhere(costmap.cells).tolist() == [[4, 4]]
    costmap.clear((4.5, 4.5, 0.0), 3.0, ["obstacle_layer"], outside=False)
    costmap.update((0.0, 0.0, 0.0))
    assert not costmap.cells.any()


def test_voxels_are_cleared_one_by_one():
    layer = VoxelLayer(
        "o", seeing(obstacle_range=9), z_voxels=4, z_resolution=0.5, footprint_clearing=False
    )
    costmap = small([layer])
    look(layer, costmap, [[2.5, 0.5, 0.2], [2.5, 0.5, 1.2]], origin=(0.5, 0.5, 0.7))
    assert costmap.cells[0, 2] == LETHAL
    # Only the lower one is seen through.
    look(layer, costmap, [[3.4, 0.5, 0.2]], origin=(0.5, 0.5, 0.2))
    assert costmap.cells[0, 2] == LETHAL
    look(layer, costmap, [[3.4, 0.5, 1.2]], origin=(0.5, 0.5, 1.2))
    assert costmap.cells[0, 2] == FREE
    assert costmap.cells[0, 3] == LETHAL


# Static maps -----------------------------------------------------------------------------


def static_map(values, **settings):
    layer = StaticLayer(**settings)
    track = settings.pop("track", False) if "track" in settings else True
    costmap = Costmap([layer], SQUARE * 0.01, track_unknown=track)
    layer.set_map(OccupancyMap(np.array(values, np.int8), 0.5, Pose(1.0, 2.0)), costmap)
    costmap.update((0.0, 0.0, 0.0))
    return costmap


def test_a_map_gives_the_costmap_its_size_and_costs():
    costmap = static_map([[0, 100, -1], [50, 99, 100]])
    assert costmap.cells.tolist() == [[FREE, LETHAL, UNKNOWN], [FREE, FREE, LETHAL]]
    assert (costmap.resolution, costmap.origin) == (0.5, (1.0, 2.0))


def test_a_map_that_is_not_trinary_costs_in_proportion():
    costmap = static_map([[0, 50, 100, 25]], trinary=False)
    assert costmap.cells.tolist() == [[0, 127, LETHAL, 63]]


def test_a_rolling_map_sees_the_static_one_through_its_frame():
    layer = StaticLayer()
    costmap = Costmap([layer], SQUARE * 0.01, width=3, height=3, resolution=0.5, rolling=True)
    grid = np.zeros((10, 10), np.int8)
    grid[2, 7] = 100
    layer.set_map(OccupancyMap(grid, 0.5), costmap)
    layer.to_map = (3.0, 1.0, math.pi / 2)
    costmap.update((0.0, 0.0, 0.0))
    # (3.75, 1.25) of the map is (0.25, -0.75) in a frame at (3, 1) that is turned left.
    assert np.argwhere(costmap.cells == LETHAL).tolist() == [[1, 3]]


# Parameters ------------------------------------------------------------------------------


FLAT = {
    "obstacle_range": 3.0,
    "raytrace_range": 3.5,
    "footprint": [[-0.105, -0.105], [-0.105, 0.105], [0.041, 0.105], [0.041, -0.105]],
    "inflation_radius": 1.0,
    "cost_scaling_factor": 3.0,
    "map_type": "costmap",
    "observation_sources": "scan",
    "scan": {"data_type": "LaserScan", "topic": "front", "marking": True, "clearing": True},
}


def test_flat_parameters_are_moved_into_layers():
    with pytest.warns(SimulationWarning, match="pre-Hydro"):
        made = costmap_of({**FLAT, "static_map": True, "global_frame": "/map"})
    static, obstacle, inflation = made.costmap.layers
    assert (type(static), type(obstacle)) == (StaticLayer, ObstacleLayer)
    assert (inflation.radius, inflation.scaling) == (1.0, 3.0)
    assert obstacle.sources["scan"].raytrace_range == 3.5
    assert [(each.topic, each.kind) for each in made.sensors] == [("front", "LaserScan")]
    assert made.costmap.frame == "map"
    assert made.costmap.inscribed == pytest.approx(0.051)


def test_a_rolling_window_has_no_static_layer_unless_it_says_so():
    with pytest.warns(SimulationWarning):
        made = costmap_of(
            {**FLAT, "rolling_window": True, "map_type": "voxel", "width": 3, "height": 3}
        )
    assert [type(layer) for layer in made.costmap.layers] == [VoxelLayer, InflationLayer]
    assert made.costmap.cells.shape == (60, 60)


def test_plugins_are_layers_in_their_order():
    made = costmap_of({
        "plugins": [
            {"name": "bumps", "type": "costmap_2d::ObstacleLayer"},
            {"name": "soft", "type": "costmap_2d::InflationLayer"},
        ],
        "bumps": {"observation_sources": "a b", "a": {"topic": "x"}, "b": {"expected_update_rate": 1}},
        "soft": {"inflation_radius": 2},
    })  # fmt: skip
    bumps, soft = made.costmap.layers
    assert list(bumps.sources) == ["a", "b"]
    assert soft.radius == 2.0


@pytest.mark.parametrize(
    ("wrong", "match"),
    [
        ({"plugins": [{"name": "a", "type": "costmap_2d::StaticLaier"}]}, "did you mean"),
        ({"plugins": ["a"]}, "name and a type"),
        ({"plugins": [], "width": "wide"}, "width"),
        ({"plugins": [], "width": 0}, "cells"),
        ({"plugins": [], "resolution": 0}, "resolution"),
        ({"plugins": [], "rolling_window": 1}, "rolling_window"),
    ],
)
def test_wrong_parameters_are_named(wrong, match):
    with pytest.raises(Error) as caught:
        costmap_of(wrong)
    assert match in f"{caught.value.message} {caught.value.hint}"


def test_costs_are_shown_as_ros_shows_them():
    costs = np.array([[0, 1, 127, 252, 253, 254, 255]], np.uint8)
    assert shown(costs).tolist() == [[0, 1, 49, 98, 99, 100, -1]]


@pytest.mark.parametrize(
    "values",
    [
        {"width": math.nan},
        {"height": math.inf},
        {"width": 1e308, "resolution": 1e-3},
        {"resolution": 1e-320},
        {"resolution": math.nan},
        {"width": 10**400},
        {"origin_x": math.nan},
    ],
)
def test_sizes_that_no_map_has_are_refused(values):
    with pytest.raises(Error):
        costmap_of(values)
