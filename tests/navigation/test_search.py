"""Ways are the cheapest there are."""

from __future__ import annotations

import heapq
import math
from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from gazelle.navigation.search import find_path

PRICES = st.lists(
    st.lists(st.sampled_from([1.0, 1.0, 1.0, 3.0, math.inf]), min_size=7, max_size=7),
    min_size=6,
    max_size=6,
)


def price_of(way, prices):
    pairs = pairwise(way)
    return sum(math.dist(a, b) * prices[b] for a, b in pairs)


def least_price(prices, start, goal):
    """Compute the plainest Dijkstra."""
    best, queue = {}, [(0.0, start)]
    while queue:
        spent, cell = heapq.heappop(queue)
        if cell in best:
            continue
        best[cell] = spent
        for dx in (-1, 0, 1):
            for dy in (-1, 0, 1):
                other = (cell[0] + dx, cell[1] + dy)
                inside = all(0 <= i < n for i, n in zip(other, prices.shape, strict=True))
                if inside and other not in best and prices[other] < math.inf:
                    heapq.heappush(queue, (spent + math.hypot(dx, dy) * prices[other], other))
    return best.get(goal)


@given(PRICES, st.tuples(st.integers(0, 5), st.integers(0, 6)))
def test_no_way_is_cheaper(rows, goal):
    prices = np.array(rows)
    way = find_path(prices, (0, 0), goal)
    least = least_price(prices, (0, 0), goal) if math.isfinite(prices[goal]) else None
    if least is None:
        assert way is None
        return
    assert way[0] == (0, 0)
    assert way[-1] == goal
    assert all(max(abs(a[0] - b[0]), abs(a[1] - b[1])) == 1 for a, b in pairwise(way))
    assert math.isclose(price_of(way, prices), least)


def test_a_closed_wall_has_no_way_through():
    prices = np.ones((5, 5))
    prices[2] = math.inf
    assert find_path(prices, (0, 0), (4, 4)) is None
