"""Learners that are shown what to do: who acts before the first update, and what is imitated."""

from __future__ import annotations

import copy
import dataclasses

import numpy as np
import pytest
import slider_task
import torch

from gazelle.errors import TaskError
from gazelle.training import OffPolicySettings, Recipe, load_actor, resume, train
from gazelle.training.demonstrations import find_demonstrator, with_demonstrator_found
from gazelle.training.learners import build_learner
from gazelle.training.learners.arguments import step_size
from gazelle.training.vecenv import VectorEnvAdapter

TEXT = """
import numpy as np

def towards(rows):
    \"\"\"By the difference of goal (2, 3) and what is reached (0, 1).\"\"\"
    return np.clip((rows[:, 2:4] - rows[:, :2]) / 0.2, -1.0, 1.0)

def too_few(rows):
    return np.zeros((len(rows), 1))

def endless(rows):
    return np.full((len(rows), 2), np.nan)

number = 3
"""


@pytest.fixture(scope="module")
def shown(tmp_path_factory):
    file = tmp_path_factory.mktemp("shown") / "shown_slider.py"
    file.write_text(TEXT)
    return str(file)


@pytest.fixture(scope="module")
def env():
    made = VectorEnvAdapter(slider_task.SliderVectorEnv(4))
    yield made
    made.close()


def recipe(demonstrator, algo="ddpg", **settings):
    given = {"buffer_size": 4000, "batch_size": 64, "learning_starts": 400, "action_noise": 0.2}
    return Recipe(
        algo=algo,
        num_envs=4,
        net_arch=(32, 32),
        activation="relu",
        learning_rate=1e-3,
        gamma=0.9,
        goal_differences=True,
        settings=OffPolicySettings(demonstrator=demonstrator, **given | settings),
    )


def learnt(env, given, steps):
    torch.manual_seed(0)
    env.seed(3)
    learner = build_learner(given, env, seed=1)
    learner.learn(steps, log_interval=None)
    return learner


def missed(learner, demonstrator):
    seen = learner.replay_buffer.sample_first(300, 100).observations.numpy()
    actions, _ = learner.predict(seen, deterministic=True)
    return np.sqrt(np.mean((actions - demonstrator(seen)) ** 2))


@pytest.mark.parametrize("algo", ["ddpg", "td3"])
def test_a_demonstrator_acts_before_the_first_update(env, shown, algo):
    towards = find_demonstrator(f"{shown}:towards")
    learner = learnt(env, recipe(f"{shown}:towards", algo), 400)
    memory = learner.replay_buffer
    seen = memory.observations[:100].reshape(400, -1)
    apart = memory.actions[:100].reshape(400, -1) - towards(seen)
    inside = np.abs(towards(seen)) < 0.5  # where noise is not cut
    assert np.std(apart[inside]) == pytest.approx(0.1, rel=0.2)  # half of the noise
    assert np.abs(np.mean(apart[inside])) < 0.02
    free = learnt(env, recipe(None, algo), 400).replay_buffer
    chance = free.actions[:100].reshape(400, -1) - towards(free.observations[:100].reshape(400, -1))
    assert np.std(chance) > 0.4


@pytest.mark.parametrize("algo", ["ddpg", "td3"])
def test_what_was_shown_is_imitated_where_it_is_worth_more(env, shown, algo):
    given = recipe(f"{shown}:towards", algo, imitation=3.0, action_penalty=0.5)
    learner = learnt(env, given, 480)
    features = learner.actor.features_extractor(learner.replay_buffer.sample(40).observations)
    shows = learner._shown(160)
    assert len(shows.actions) == 40
    critic, policy = learner.critic.q_networks[0], learner.actor.mu
    actions, imitated = policy(features), policy(shows.features)
    own, theirs = (
        critic(torch.cat((shows.features, acts), dim=1)) for acts in (imitated, shows.actions)
    )
    better = (theirs > own).float()
    assert 0.0 < better.mean() < 1.0
    value = critic(torch.cat((features, actions), dim=1)).mean()
    loss = 0.5 * actions.square().mean() - value
    loss += 3.0 * ((imitated - shows.actions) * better).square().mean()
    wanted = torch.autograd.grad(loss, list(policy.parameters()))
    learner._improve_actor(features, shows)
    for found, right in zip(policy.parameters(), wanted, strict=True):
        torch.testing.assert_close(found.grad, right, atol=1e-5, rtol=1e-3)


@pytest.mark.long
def test_a_policy_comes_to_do_what_was_shown(env, shown):
    name = f"{shown}:towards"
    towards = find_demonstrator(name)
    far, near = (
        missed(learnt(env, recipe(name, imitation=weight, gradient_steps=4), 1600), towards)
        for weight in (0.0, 50.0)
    )
    assert near < 0.9 * far


def test_only_what_the_critic_holds_for_better_is_imitated(env, shown):
    learner = learnt(env, recipe(f"{shown}:towards", imitation=20.0), 404)
    shows = learner._shown(64)
    before = [weight.clone() for weight in learner.actor.parameters()]
    with torch.no_grad():
        for net in learner.critic.q_networks:
            for weight in net.parameters():
                weight.zero_()  # all is worth the same, so nothing is better
    learner._improve_actor(shows.features, shows)
    for old, new in zip(before, learner.actor.parameters(), strict=True):
        torch.testing.assert_close(old, new, atol=3e-3, rtol=0)  # Adam's momentum alone
    gradient = max(weight.grad.abs().max() for weight in learner.actor.parameters())
    assert gradient == 0.0


def test_the_first_steps_are_remembered_until_they_are_overwritten(env):
    given = recipe(None, buffer_size=200, learning_starts=10_000)
    memory = learnt(env, given, 160).replay_buffer  # 40 rows of 50
    first = memory.observations[:10].reshape(40, -1)
    for row in memory.sample_first(50, 10).observations.numpy():
        assert (np.abs(first - row).max(axis=1) == 0.0).any()
    memory.valid[:10] = False
    assert memory.sample_first(50, 10) is None
    memory = learnt(env, given, 220).replay_buffer  # five rows more than there are
    left = memory.observations[5:10].reshape(20, -1)
    for row in memory.sample_first(50, 10).observations.numpy():
        assert (np.abs(left - row).max(axis=1) == 0.0).any()
    for steps in (240, 400, 420):  # 420: the rows of the first steps are overwritten again
        assert learnt(env, given, steps).replay_buffer.sample_first(50, 10) is None


def test_more_first_steps_than_are_remembered_are_those_that_are_left(env):
    given = recipe(None, buffer_size=200, learning_starts=10_000)
    memory = learnt(env, given, 220).replay_buffer  # 55 rows, of which 50 are left
    rows = np.unique(
        [
            np.flatnonzero((memory.observations == row).all(axis=2).any(axis=1))
            for row in memory.sample_first(500, 53).observations.numpy()
        ]
    )
    assert set(rows) == {0, 1, 2, *range(5, 50)}
    again, state = copy.copy(memory), memory.get_state()
    again.steps = 0
    again.set_state(state)
    assert again.steps == 55


@pytest.mark.long
def test_a_run_knows_its_demonstrator_wherever_it_goes_on(shown, tmp_path, monkeypatch):
    given = dataclasses.replace(recipe(f"{shown}:towards", imitation=5.0), steps=480)
    options = {"recipe": given, "imports": ["slider_task"], "out": tmp_path}
    run = train("test/Slider-v0", **options).run
    assert run.config.recipe.settings.demonstrator == "shown_slider:towards"
    monkeypatch.chdir(tmp_path)
    assert resume(run.folder, steps=520).steps == 520
    found, homes = with_demonstrator_found(
        recipe("gazelle.envs.fetch.demonstrators:pick_and_place")
    )
    assert homes == ()
    assert found.settings.demonstrator == "gazelle.envs.fetch.demonstrators:pick_and_place"


@pytest.mark.slow
def test_any_number_of_workers_is_shown_the_same(shown, tmp_path):
    """Also if a run is broken off and goes on with another number of them."""

    def weights(name, workers, *, imitation=5.0, stops=(640,)):
        learner = dataclasses.replace(
            recipe(f"{shown}:towards", imitation=imitation, learning_starts=320),
            num_envs=16,
            learning_rate_decay=False,
        )
        given = {"imports": [slider_task.__file__], "seed": 4, "out": tmp_path / name}
        run = train("test/Slider-v0", recipe=learner, workers=workers, steps=stops[0], **given).run
        for stop in stops[1:]:
            run = resume(run.folder, steps=stop, workers=3 - workers).run
        return load_actor(run.policy_file()).weights

    one = weights("one", 1)
    for other in (weights("two", 2), weights("broken", 2, stops=(480, 640))):
        for left, right in zip(one, other, strict=True):
            np.testing.assert_array_equal(left, right)
    assert not np.array_equal(one[0], weights("plain", 2, imitation=0.0)[0])


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("nothing", "expected module:function"),
        ("{}:toward", "did you mean 'towards'"),
        ("{}:number", "has no function 'number'"),
        ("no_such_module_at_all:towards", "no_such_module_at_all"),
    ],
)
def test_a_demonstrator_that_is_not_there_is_named(env, shown, name, text):
    with pytest.raises(TaskError, match=text):
        build_learner(recipe(name.format(shown)), env, seed=0)


@pytest.mark.parametrize("name", ["too_few", "endless"])
def test_a_demonstrator_that_gives_something_else_is_told(env, shown, name):
    with pytest.raises(TaskError, match=r"the demonstrator returned .* \(4, 2\)"):
        learnt(env, recipe(f"{shown}:{name}"), 8)


def test_thestep_size_is_held_before_it_falls():
    held = Recipe(learning_rate=2e-3, learning_rate_hold=0.6)
    sizes = [step_size(held)(left) for left in (1.0, 0.7, 0.4, 0.2, 0.0)]
    assert sizes == pytest.approx([2e-3, 2e-3, 2e-3, 1e-3, 0.0])
    assert step_size(Recipe(learning_rate=2e-3))(0.5) == pytest.approx(1e-3)
    assert step_size(Recipe(learning_rate=2e-3))(-0.01) == 0.0
    assert step_size(Recipe(learning_rate=2e-3, learning_rate_decay=False)) == 2e-3
    with pytest.raises(TaskError, match="learning_rate_hold"):
        Recipe(learning_rate_hold=1.0)
