"""A* of ``global_planner``: closed forms, and the properties of the original's expansion."""

import numpy as np
import pytest
from navigation.planners.test_global_planners import cluttered, costmap_of_cells, price_of

from gazelle.navigation.planners import GlobalPlanner
from gazelle.navigation.planners.potential import NOT_REACHED, PotentialField

START, GOAL = (0.525, 0.525, 0.3), (5.525, 5.525, 1.0)


def reached(field):
    return field.values < NOT_REACHED


def test_in_the_open_the_goal_has_its_manhattan_distance_and_only_what_lies_between_is_reached():
    field = PotentialField(60, 80)
    source, goal = (20, 15), (50, 40)
    assert field.search(np.full((60, 80), 50, np.float32), source, goal, 50.0, 0)
    assert field.values[40, 50] == 50.0 * (30 + 25)
    rows, columns = np.nonzero(reached(field))
    away = np.abs(columns - source[0]) + np.abs(rows - source[1])
    assert (field.values[rows, columns] >= 50.0 * away).all()
    # Only cells of the rectangle between both are expanded, and reach their neighbours.
    assert columns.min() >= 19
    assert columns.max() <= 51
    assert rows.min() >= 14
    assert rows.max() <= 41


@pytest.mark.parametrize("seed", range(6))
def test_each_potential_is_that_of_a_neighbour_and_the_price(seed):
    prices = 50.0 + cluttered(seed).astype(np.float32)
    prices[prices >= 303] = 0.0
    field = PotentialField(*prices.shape)
    field.search(prices, (10, 10), (110, 110), 50.0, 0)
    values = field.values.astype(float)
    before = np.stack([np.roll(values, shift, axis) for shift in (1, -1) for axis in (0, 1)])
    cells = reached(field)
    cells[10, 10] = False
    assert values[10, 10] == 0.0
    assert (np.abs(before + prices - values).min(axis=0)[cells] < 0.05).all()
    assert not cells[prices == 0.0].any()


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("quadratic", [True, False])
def test_it_finds_a_way_where_dijkstra_does_and_looks_at_fewer_cells(seed, quadratic):
    cells = cluttered(seed)
    counts, plans = [], []
    for dijkstra in (True, False):
        given = {"use_dijkstra": dijkstra, "use_quadratic": quadratic}
        planner = GlobalPlanner("g", costmap_of_cells(cells), given)
        planner.on_potential = lambda values: counts.append((values < NOT_REACHED).sum())
        plans.append(planner.make_plan(START, GOAL))
    exact, found = plans
    assert bool(len(exact)) == bool(len(found))
    assert counts[1] <= counts[0]
    if len(found):
        assert found[0, :2] == pytest.approx(START[:2])
        assert found[-1].tolist() == list(GOAL)
        columns, rows = np.rint(found[:, :2].T / 0.05 - 0.5).astype(int)
        assert cells[rows, columns].max() < 253
        prices = GlobalPlanner(
            "g", costmap_of_cells(cells), {"use_dijkstra": False}
        ).traversal_costs()
        assert price_of(found, prices[cells]) < 2.0 * price_of(exact, prices[cells])


def test_in_the_open_it_looks_at_a_small_part_of_the_map():
    costmap = costmap_of_cells(np.zeros((200, 200), np.uint8))
    planner = GlobalPlanner("g", costmap, {"use_dijkstra": False})
    counts = []
    planner.on_potential = lambda values: counts.append((values < NOT_REACHED).sum())
    assert len(planner.make_plan((5.0, 5.0, 0.0), (7.0, 5.0, 0.0)))
    assert counts[0] < 0.05 * 200 * 200


def test_prices_are_costs_and_neutral_cost_and_the_factor_is_unused():
    costmap = costmap_of_cells(np.zeros((20, 20), np.uint8))
    given = {"use_dijkstra": False, "neutral_cost": 60, "cost_factor": 5.0}
    prices = GlobalPlanner("g", costmap, given).traversal_costs()
    assert prices[:253].tolist() == [60.0 + cost for cost in range(253)]
    assert prices[[253, 254, 255]].tolist() == [0.0, 0.0, 315.0]
    assert (
        GlobalPlanner("g", costmap, given | {"allow_unknown": False}).traversal_costs()[255] == 0.0
    )


def test_a_goal_out_of_reach_is_reached_nearly():
    cells = np.zeros((60, 60), np.uint8)
    cells[:, 40:] = 254
    given = {"use_dijkstra": False, "default_tolerance": 0.5}
    plan = GlobalPlanner("g", costmap_of_cells(cells), given).make_plan(
        (0.5, 1.5, 0.0), (2.2, 1.5, 0.7)
    )
    assert plan[-1, 0] == pytest.approx(1.975)


@pytest.mark.parametrize("start", [(0, 0), (9, 0), (9, 19), (0, 9), (19, 9), (19, 19)])
def test_a_robot_on_the_outermost_cells_goes_inwards(start):
    field = PotentialField(20, 20)
    found = field.search(np.full((20, 20), 50.0, np.float32), start, (9, 9), 50.0)
    assert found == (start[0] % 19 > 0 or start[1] % 19 > 0)
