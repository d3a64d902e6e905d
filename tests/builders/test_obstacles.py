"""Random things: apart, clear, and decided by their seed."""

import itertools
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.builders import (
    BuildError,
    Disc,
    Rectangle,
    bush,
    footprints,
    random_obstacles,
    random_plants,
    rock,
    tree,
)
from gazelle.builders.obstacles import _SPREAD

seeds = st.integers(-(2**40), 2**40)
KINDS = ("box", "cylinder", "sphere")


def corners(zone):
    return [zone.point(u, v) for u in (0, 1) for v in (0, 1)]


def reach(model):
    """Return the extent of a model's collisions from its place on the ground."""
    return max(
        math.dist((model.pose.x, model.pose.y), corner)
        for zone in footprints(model)
        for corner in corners(zone)
    )


@settings(max_examples=40, deadline=None)
@given(seeds, st.integers(0, 12))
def test_no_two_obstacles_overlap(seed, count):
    clear = Disc(0.0, 0.0, 1.0)
    models = random_obstacles(count, seed=seed, kinds=("box",), keep_clear=[clear], gap=0.2)
    assert len(models) == count
    for a, b in itertools.combinations(models, 2):
        apart = math.dist(a.pose.position, b.pose.position)
        assert apart >= reach(a) + reach(b) + 0.2 - 1e-9
    for model in models:
        assert clear.distance(model.pose.x, model.pose.y) >= reach(model) + 0.2 - 1e-9
        assert reach(model) <= 0.4 + 1e-9


@settings(max_examples=20, deadline=None)
@given(seeds)
def test_a_seed_decides(seed):
    assert random_obstacles(5, seed=seed, kinds=KINDS) == random_obstacles(
        5, seed=seed, kinds=KINDS
    )
    assert random_obstacles(5, seed=seed) != random_obstacles(5, seed=seed + 1)


def test_kinds_and_sizes_are_those_asked_for():
    models = random_obstacles(12, kinds=KINDS, radius=(0.2, 0.2), height=(0.5, 0.5))
    kinds = {type(m.links[0].collisions[0].geometry).__name__ for m in models}
    assert kinds == {"Box", "Cylinder", "Sphere"}
    assert all(m.static for m in models)
    assert not any(m.static for m in random_obstacles(3, movable=True))


@pytest.mark.parametrize("kind", ["broadleaf", "conifer", "poplar"])
def test_a_crown_stays_within_its_circle(kind):
    model = tree(kind=kind, height=1.0)
    # Footprints put squares around round crowns.
    widest = max(
        math.hypot(zone.x, zone.y) + min(zone.length, zone.width) / 2 for zone in footprints(model)
    )
    assert 0.9 * _SPREAD[kind] <= widest <= _SPREAD[kind]


@pytest.mark.parametrize(("kind", "model"), [("bush", bush(height=1.0)), ("rock", rock(size=1.0))])
def test_a_bush_and_a_rock_stay_within_their_circles(kind, model):
    widest = max(
        math.hypot(zone.x, zone.y) + max(zone.length, zone.width) / 2 for zone in footprints(model)
    )
    assert widest <= _SPREAD[kind]


def test_plants_stand_on_the_ground_given():
    models = random_plants(6, area=Rectangle(0, 0, 40, 40), ground=lambda x, y: x + y)
    for model in models:
        assert model.pose.z == pytest.approx(model.pose.x + model.pose.y)


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"count": -1}, "must not be negative"),
        ({"kinds": ("bx",)}, "did you mean 'box'"),
        ({"kinds": ()}, "at least one kind"),
        ({"radius": (0.5, 0.1)}, "radius"),
        ({"height": (0.0, 1.0)}, "height"),
    ],
)
def test_impossible_wishes_are_refused(options, text):
    with pytest.raises(BuildError, match=text):
        random_obstacles(**{"count": 3, **options})
