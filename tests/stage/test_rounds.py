"""The controller that drives robots in a round."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from gazelle import assets, formats
from gazelle.simulation import Simulation
from gazelle.stage import stage_of, with_wander
from gazelle.stage.rounds import short_tour

PLACES = st.lists(
    st.tuples(st.integers(-9, 9), st.integers(-9, 9)), min_size=1, max_size=20, unique=True
)


def length(points, order):
    return np.hypot(*(points[order] - points[np.roll(order, -1)]).T).sum()


@given(PLACES)
def test_a_tour_visits_every_place_once_and_no_reversed_part_makes_it_shorter(places):
    points = np.array(places, float)
    order = short_tour(points)
    assert sorted(order) == list(range(len(points)))
    for first in range(1, len(order)):
        for last in range(first + 1, len(order) + 1):
            other = np.concatenate([order[:first], order[first:last][::-1], order[last:]])
            assert length(points, other) > length(points, order) - 1e-6


def test_the_bundled_fleet_drives_from_place_to_place_and_nothing_bumps():
    world = with_wander(formats.load(assets.world("fleet")), "rounds")
    with Simulation(world, "planar") as sim:
        fleet = stage_of(sim)
        (rounds,) = fleet.controllers
        stalls = []
        sim.subscribe(lambda: stalls.append(fleet.stalled.any()))
        sim.run(20.0)
        after = rounds.state()
        assert after["visits"].min() >= 2
        saved, goals = sim.snapshot(), rounds.goals
        sim.run(20.0)
        assert rounds.state()["visits"].sum() > 1.8 * after["visits"].sum()
        assert not any(stalls)
        sim.restore(saved)
        assert (rounds.goals == goals).all()
        sim.reset()
        assert not rounds.state()["visits"].any()
