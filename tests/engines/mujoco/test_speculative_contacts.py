"""Contacts are sought on the way of a step unless that takes far longer than the step."""

import warnings
from dataclasses import replace

import mujoco
import pytest

from gazelle.engines import make_engine
from gazelle.engines.laws import with_profile
from gazelle.engines.mujoco.compiler import free_bodies
from gazelle.errors import EngineWarning
from gazelle.formats import load_string

AHEAD = int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)


def city(blocks, balls, radius=0.01):
    """Return a world of static boxes in one model, and of free balls above them."""
    box = "<collision name='b{0}'><pose>{0} 0 0 0 0 0</pose><geometry><box><size>.5 .5 .5</size></box></geometry></collision>"
    ball = (
        "<model name='ball{0}'><pose>{0} 0 5 0 0 0</pose><link name='l'><collision name='c'><geometry>"
        "<sphere><radius>{1}</radius></sphere></geometry></collision></link></model>"
    )
    still = "".join(map(box.format, range(blocks)))
    return load_string(
        f"<sdf version='1.7'><world name='w'><model name='city'><static>true</static>"
        f"<link name='l'>{still}</link></model>{''.join(ball.format(i, radius) for i in range(balls))}</world></sdf>"
    )


def uses_speculative_contacts(world):
    return bool(make_engine("mujoco", world).running.compiled.model.opt.enableflags & AHEAD)


@pytest.fixture(autouse=True)
def few_pairs(monkeypatch):
    monkeypatch.setattr(free_bodies, "_MOST_PAIRS", 20)


def test_small_balls_are_looked_for_on_their_way_where_there_are_few_pairs():
    assert uses_speculative_contacts(city(10, 2))


def test_they_are_not_where_there_are_too_many_pairs_and_that_is_said():
    with pytest.warns(EngineWarning, match="has 7 static and 3 moving shapes"):
        assert not uses_speculative_contacts(city(7, 3))


def test_they_are_wherever_the_world_asks_for_it():
    world = city(7, 3)
    world = with_profile(world, replace(world.profile, speculative_contacts=True))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert uses_speculative_contacts(world)


def test_nothing_is_said_of_what_is_too_thick_to_pass():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert not uses_speculative_contacts(city(7, 3, radius=0.1))
