"""The launch files of turtlebot3_navigation, unchanged, take robots to goals.

The long run prints a table::

    GAZELLE_CORPUS=... pytest -m slow -s -k fifty tests/bridges/launch/test_navigation_launch.py
"""

from __future__ import annotations

import pytest
from mapping_drives import WORLD, Mapper, drive
from travelling import navigating, table

import gazelle
from gazelle.navigation.true_map import true_map

pytestmark = pytest.mark.corpus


@pytest.mark.long
def test_a_burger_reaches_a_goal(corpus, tmp_path):
    whole = true_map(gazelle.load("turtlebot3_world"), 0.18, margin=2.0)
    with navigating(corpus, tmp_path, "burger", whole) as traveller:
        trip = traveller.go(-1.5, -0.5)
    assert (trip.reached, trip.text, trip.touches) == (True, "Goal reached.", 0)
    assert trip.off < 0.25


@pytest.mark.slow
@pytest.mark.timeout(7200)
@pytest.mark.parametrize("model", ["burger", "waffle"])
def test_fifty_goals_of_fifty_are_reached_on_a_map_of_our_own(corpus, tmp_path, model):
    mapper, trips = Mapper(0.0), []
    drive("turtlebot3_world", (-2.0, -0.5), WORLD, mapper.take)
    with navigating(corpus, tmp_path, model, mapper.slam.map()) as traveller:
        for trip in traveller.tour(50):
            trips.append(trip)
            print(table(model, [trip]).splitlines()[1], flush=True)
    print(table(model, trips))
    assert all(trip.reached and trip.off < 0.25 for trip in trips)
    assert not any(trip.touches for trip in trips)
