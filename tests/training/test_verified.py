"""What `gazelle tasks` says that recipes reach."""

from __future__ import annotations

import pytest

from gazelle.training import RECIPES, VERIFIED, evaluate, train


def test_figures_are_of_recipes_that_there_are():
    assert set(VERIFIED) <= set(RECIPES)
    for name, found in VERIFIED.items():
        engine = RECIPES[name].training_options["engine"]
        assert engine in found.success
        assert found.seeds >= 1
        assert found.seconds > 0.0


@pytest.mark.slow
@pytest.mark.parametrize("task", VERIFIED)
def test_a_training_reaches_what_is_said_in_each_engine(task, tmp_path):
    """With a seed of its own: the interval of held-out goals, and 2 % for the seed."""
    run = train(task, seed=7, out=tmp_path).run
    for engine, said in VERIFIED[task].success.items():
        own = engine == run.config.options["engine"]
        found = evaluate(run.folder, episodes=1000 if own else 200, engine=engine)
        assert found.distinct == found.episodes
        assert found.success is not None
        assert found.success.interval[1] + 0.02 > said.value
