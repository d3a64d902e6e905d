"""Plans are the cheapest ways, compared with exact Dijkstra over eight neighbours."""

import heapq
import math
import re

import numpy as np
import pytest

from gazelle.errors import Error
from gazelle.navigation.costmap import Costmap, footprint_of
from gazelle.navigation.planners import GlobalPlanner, NavfnPlanner, register_global
from gazelle.navigation.planners.carrot import CarrotPlanner
from gazelle.navigation.planners.plugins import GlobalPlannerPlugin, global_planner, local_planner
from gazelle.navigation.planners.potential import PotentialField

ROUND = footprint_of("[]", radius=0.1, padding=0.0)


def costmap_of_cells(cells, resolution=0.05):
    costmap = Costmap([], ROUND, width=1, height=1, resolution=resolution)
    costmap.resize(*cells.shape, resolution, (0.0, 0.0))
    costmap.cells[:] = cells
    return costmap


def cluttered(seed, side=120, count=18):
    """Return random walls with costs that fall off around them."""
    rng = np.random.default_rng(seed)
    walls = np.zeros((side, side), bool)
    for _ in range(count):
        x, y = rng.integers(4, side - 10, 2)
        walls[y : y + rng.integers(2, 6), x : x + rng.integers(2, side // 4)] = True
    walls[5:15, 5:15] = walls[side - 15 : side - 5, side - 15 : side - 5] = False
    rows, columns = np.indices(walls.shape)
    places = np.argwhere(walls)
    away = np.min([np.hypot(rows - r, columns - c) for r, c in places], axis=0) * 0.05
    costs = np.where(away <= 0.1, 253, np.where(away > 0.8, 0, 252 * np.exp(-3 * (away - 0.1))))
    costs[walls] = 254
    return costs.astype(np.uint8)


def dijkstra(prices, start, goal):
    """Return the least price of a way over eight neighbours, half of each cell's."""
    best = {start: 0.0}
    queue = [(0.0, start)]
    while queue:
        spent, (x, y) = heapq.heappop(queue)
        if (x, y) == goal:
            return spent
        if spent > best[x, y]:
            continue
        for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)):
            other = x + dx, y + dy
            price = prices[other[1], other[0]]
            inside = 0 < other[0] < prices.shape[1] - 1 and 0 < other[1] < prices.shape[0] - 1
            if not inside or price <= 0:
                continue
            total = spent + math.hypot(dx, dy) * (price + prices[y, x]) / 2
            if total < best.get(other, math.inf):
                best[other] = total
                heapq.heappush(queue, (total, other))
    return math.inf


def price_of(plan, prices, resolution=0.05):
    """Return the cost of a path: cells' costs times lengths in them."""
    points = plan[:, :2] / resolution - 0.5
    steps = np.diff(points, axis=0)
    total = 0.0
    for point, step in zip(points, steps, strict=False):
        for share in np.arange(0.05, 1.0, 0.1):
            x, y = np.rint(point + share * step).astype(int)
            total += 0.1 * float(np.hypot(*step)) * float(prices[y, x])
    return total


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("kind", [NavfnPlanner, GlobalPlanner])
def test_a_plan_costs_at_most_one_percent_more_than_the_cheapest(seed, kind):
    cells = cluttered(seed)
    costmap = costmap_of_cells(cells)
    planner = kind("p", costmap, {})
    prices = planner.traversal_costs()[cells]
    exact = dijkstra(prices, (10, 10), (110, 110))
    plan = planner.make_plan((0.525, 0.525, 0.3), (5.525, 5.525, 1.0))
    if math.isinf(exact):
        assert len(plan) == 0
        return
    assert plan[0, :2] == pytest.approx([0.525, 0.525])
    assert plan[-1].tolist() == [5.525, 5.525, 1.0]
    assert price_of(plan, prices) <= 1.01 * exact
    cost = [costmap.cost_at(x, y) for x, y, _ in plan]
    assert max(cost) < 253


def test_the_way_in_the_open_is_straight():
    costmap = costmap_of_cells(np.zeros((200, 200), np.uint8))
    plan = NavfnPlanner("p", costmap, {}).make_plan((1.0, 1.0, 0.0), (9.0, 5.0, 0.0))
    length = np.hypot(*np.diff(plan[:, :2], axis=0).T).sum()
    assert length == pytest.approx(math.hypot(8.0, 4.0), rel=0.01)


def test_potentials_in_the_open_are_distances():
    field = PotentialField(101, 101)
    field.spread(np.full((101, 101), 50, np.float32), (50, 50), None, 50.0)
    rows, columns = np.indices((101, 101))
    away = np.hypot(rows - 50, columns - 50)
    inner = slice(2, -2), slice(2, -2)
    error = field.values[inner] / 50.0 - away[inner]
    assert np.abs(error).max() < 2.0
    assert (error >= -1e-3).all()


def test_there_is_no_plan_through_walls_or_off_the_map():
    cells = np.zeros((50, 50), np.uint8)
    cells[:, 25] = 254
    planner = NavfnPlanner("p", costmap_of_cells(cells), {})
    assert planner.make_plan((0.5, 1.0, 0.0), (2.0, 1.0, 0.0)).shape == (0, 3)
    assert planner.make_plan((0.5, 1.0, 0.0), (9.0, 1.0, 0.0)).shape == (0, 3)
    assert planner.make_plan((-0.5, 1.0, 0.0), (1.0, 1.0, 0.0)).shape == (0, 3)


def test_a_goal_in_a_wall_may_be_reached_nearly():
    cells = np.zeros((60, 60), np.uint8)
    cells[:, 40:] = 254
    planner = NavfnPlanner("p", costmap_of_cells(cells), {"default_tolerance": 0.5})
    plan = planner.make_plan((0.5, 1.5, 0.0), (2.2, 1.5, 0.7))
    assert plan[-1, 0] == pytest.approx(1.975)
    assert plan[-1, 2] == 0.7
    assert len(planner.make_plan((0.5, 1.5, 0.0), (2.2, 1.5, 0.7), tolerance=0.0)) == 0


def test_unknown_ground_counts_as_dear_or_not_at_all():
    cells = np.zeros((60, 60), np.uint8)
    cells[:, 30:33] = 255
    costmap = costmap_of_cells(cells)
    ends = (0.5, 1.5, 0.0), (2.5, 1.5, 0.0)
    assert len(NavfnPlanner("p", costmap, {}).make_plan(*ends))
    assert not len(NavfnPlanner("p", costmap, {"allow_unknown": False}).make_plan(*ends))


def test_a_robot_in_an_obstacle_gets_out():
    cells = np.zeros((60, 60), np.uint8)
    cells[10, 10] = 254
    plan = NavfnPlanner("p", costmap_of_cells(cells), {}).make_plan((0.52, 0.52, 0), (2.5, 2.5, 0))
    assert len(plan) > 10


@pytest.mark.parametrize(
    ("mode", "middle"),
    [(0, 0.0), (1, 0.0), (2, 1.5), (3, 1.5), (4, math.pi), (5, -math.pi / 2), (6, math.pi / 2)],
)
def test_headings_follow_the_mode(mode, middle):
    planner = GlobalPlanner(
        "g", costmap_of_cells(np.zeros((60, 60), np.uint8)), {"orientation_mode": mode}
    )
    plan = planner.make_plan((0.5, 1.525, 1.0), (2.5, 1.525, 2.0))
    assert abs(math.remainder(plan[len(plan) // 2, 2] - middle, 2 * math.pi)) < 0.1
    assert plan[-1, 2] == 2.0


def test_headings_are_interpolated_along_the_last_straight_line_only():
    cells = np.zeros((60, 60), np.uint8)
    cells[:40, 28:32] = 254
    planner = GlobalPlanner("g", costmap_of_cells(cells), {"orientation_mode": 3})
    plan = planner.make_plan((0.5, 0.5, 0.0), (2.5, 0.5, 1.0))
    ahead = np.arctan2(*(plan[2:, :2] - plan[:-2, :2]).T[::-1])
    apart = np.abs(np.remainder(plan[1:-1, 2] - ahead + np.pi, 2 * np.pi) - np.pi)
    bend = int(plan[:, 1].argmax())
    assert apart[1 : bend - 2].max() < 1e-9
    rest = plan[-8:, 2]
    assert np.diff(rest) == pytest.approx(np.full(7, rest[1] - rest[0]))
    assert plan[-1, 2] == 1.0


def test_a_plan_begins_at_the_robot_or_as_navfn_in_its_cell():
    costmap = costmap_of_cells(np.zeros((60, 60), np.uint8))
    ends = (0.51, 0.54, 0.0), (2.51, 1.52, 0.3)
    plan = GlobalPlanner("g", costmap, {}).make_plan(*ends)
    assert plan[0, :2].tolist() == [0.51, 0.54]
    assert plan[-1].tolist() == [2.51, 1.52, 0.3]
    old = {"old_navfn_behavior": True, "cost_factor": 0.8, "orientation_mode": 0}
    plan = GlobalPlanner("g", costmap, old).make_plan(*ends)
    assert np.array_equal(plan, NavfnPlanner("n", costmap, {}).make_plan(*ends))


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"publish_scale": 0}, "'publish_scale' must be 1 to 100, not 0"),
        ({"cost_factor": math.nan}, "'cost_factor' must be a number from 0.01 to 5.0, not nan"),
        ({"neutral_cost": "dear"}, "the parameter 'neutral_cost' must be of type int, not 'dear'"),
    ],
)
def test_wrong_parameters_are_refused(values, text):
    with pytest.raises(Error, match=re.escape(text)):
        GlobalPlanner("g", costmap_of_cells(np.zeros((60, 60), np.uint8)), values)


def test_costs_out_of_their_limits_become_the_nearest_ones():
    costmap = costmap_of_cells(np.zeros((60, 60), np.uint8))
    given = {"neutral_cost": 0, "cost_factor": 9.0, "lethal_cost": 300, "orientation_mode": 7}
    settings = GlobalPlanner("g", costmap, given).settings
    assert (settings.neutral_cost, settings.cost_factor, settings.lethal_cost) == (1, 5.0, 255)
    assert settings.orientation_mode == 6
    closed = GlobalPlanner("g", costmap, {"lethal_cost": -1})
    assert len(closed.make_plan((0.5, 0.5, 0.0), (2.5, 2.5, 0.0))) == 0


@pytest.mark.parametrize(
    ("kind", "wrong", "right"),
    [
        (GlobalPlanner, "use_djikstra", "use_dijkstra"),
        (CarrotPlanner, "step_sise", "step_size"),
    ],
)
def test_unknown_parameters_are_warned_of(kind, wrong, right, caplog):
    kind("mine", costmap_of_cells(np.zeros((60, 60), np.uint8)), {wrong: 1})
    assert f"mine/{wrong} is an unknown parameter; did you mean '{right}'?" in caplog.text


def test_a_grid_path_goes_from_cell_to_cell():
    planner = GlobalPlanner(
        "g", costmap_of_cells(np.zeros((60, 60), np.uint8)), {"use_grid_path": True}
    )
    plan = planner.make_plan((0.525, 0.525, 0.0), (2.525, 1.525, 0.0))
    assert np.allclose((plan[:, :2] / 0.05 - 0.5) % 1.0 % 0.999999, 0.0, atol=1e-5)


def test_a_carrot_stops_before_the_wall():
    cells = np.zeros((60, 60), np.uint8)
    cells[:, 40:] = 254
    plan = CarrotPlanner("c", costmap_of_cells(cells), {}).make_plan(
        (0.5, 1.5, 0.0), (2.5, 1.5, 0.0)
    )
    assert 1.8 < plan[-1, 0] < 1.95


def test_planners_are_found_by_type():
    class Mine(GlobalPlannerPlugin):
        def make_plan(self, start, goal, tolerance=None):
            return np.array([start, goal])

    register_global("my/Planner", Mine)
    assert global_planner("my/Planner") is Mine
    assert global_planner("navfn/NavfnROS") is NavfnPlanner
    assert global_planner("NavfnROS") is NavfnPlanner
    assert global_planner("gazelle.navigation.planners.carrot:CarrotPlanner") is CarrotPlanner
    assert local_planner("dwa_local_planner/DWAPlannerROS").__name__ == "DwaPlanner"
    with pytest.raises(Error) as caught:
        global_planner("navfn/NavfnRSO")
    assert "did you mean 'navfn/NavfnROS'?" in caught.value.hint
    with pytest.raises(Error, match="cannot be imported"):
        local_planner("no_such_module:Planner")


@pytest.mark.parametrize("start", [(0, 0), (9, 0), (9, 19), (0, 9), (19, 9), (19, 19)])
def test_a_robot_on_the_outermost_cells_goes_inwards(start):
    field = PotentialField(20, 20)
    prices = np.full((20, 20), 50.0, np.float32)
    reached = field.spread(prices, start, (9, 9), 50.0)
    assert reached == (start[0] % 19 > 0 or start[1] % 19 > 0)
    way = field.way_down((9, 9), start)
    assert len(way) == 0 if not reached else tuple(way[-1]) == start


@pytest.mark.parametrize("shape", [(3,), (2, 2), (0,), (2, 3, 1)])
def test_a_plan_of_another_shape_is_refused(shape):
    planner = local_planner("dwa_local_planner/DWAPlannerROS")(
        "dwa", costmap_of_cells(np.zeros((20, 20), np.uint8)), {}, 0.1
    )
    for plan in (np.zeros(shape), np.full((2, 3), math.nan)):
        with pytest.raises(Error, match="a plan must be finite poses"):
            planner.set_plan(plan)
    assert planner.set_plan(np.zeros((2, 3)))
    assert not planner.set_plan(np.zeros((0, 3)))
