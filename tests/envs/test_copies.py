"""Environments and what describes them can be pickled and copied, and go on as they would have."""

import copy
import pickle

import gymnasium as gym
import numpy as np
import pytest

from gazelle import assets, formats
from gazelle.envs import BatchedTask, TaskEnv, TaskOutcome, TaskVectorEnv

COPIES = [lambda made: pickle.loads(pickle.dumps(made)), copy.deepcopy]
STAGE, FLEET = "gazelle/TurtleBot3Stage{}-v0", "gazelle/AGVFleet-v0"


def single(task, **options):
    return gym.make(task, max_episode_steps=7, **options)


def vector(task, **options):
    return gym.make_vec(
        task, 4, vectorization_mode="vector_entry_point", max_episode_steps=7, **options
    )


def same(one, other):
    """Return whether two results of a step or a reset are the same, infos and all."""
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same(one[name], other[name]) for name in one)
    if isinstance(one, tuple) or (isinstance(one, np.ndarray) and one.dtype == object):
        return len(one) == len(other) and all(map(same, one, other))
    return bool(np.array_equal(one, other))


def future(env, actions):
    """Return the next results of an environment, over the ends of episodes."""
    made = []
    for action in actions:
        result = env.step(action)
        made.append(result)
        if isinstance(env.unwrapped, gym.Env) and (result[2] or result[3]):
            made.append(env.reset())
    return made


@pytest.mark.parametrize("copied", COPIES)
@pytest.mark.parametrize("make", [single, vector])
@pytest.mark.parametrize("task", [STAGE.format(1), "gazelle/TurtleBot3Stage4Continuous-v0", FLEET])
def test_a_copy_goes_on_with_the_same_future(task, make, copied):
    env = make(task)
    env.action_space.seed(1)
    actions = [env.action_space.sample() for _ in range(26)]
    env.reset(seed=3)
    future(env, actions[:10])
    other = copied(env)
    assert other.spec == env.spec
    assert other.observation_space == env.observation_space
    ahead, behind = future(env, actions[10:]), future(other, actions[10:])
    assert same(tuple(ahead), tuple(behind))
    assert env.unwrapped.np_random.random() == other.unwrapped.np_random.random()
    env.close()
    other.close()


@pytest.mark.parametrize("copied", COPIES)
@pytest.mark.parametrize("make", [single, vector])
@pytest.mark.parametrize("engine", ["planar", "mujoco"])
@pytest.mark.parametrize("held_out", [False, True])
def test_a_copy_goes_on_with_starts_goals_and_phases(engine, held_out, make, copied):
    split = "held-out" if held_out else "published"
    env = make(STAGE.format(4), engine=engine, respawn=False, starts=split, goals=split)
    env.action_space.seed(2)
    actions = [env.action_space.sample() for _ in range(26)]
    env.reset(seed=3)
    future(env, actions[:10])
    other = copied(env)
    assert same(tuple(future(env, actions[10:])), tuple(future(other, actions[10:])))
    env.close()
    other.close()


@pytest.mark.parametrize("copied", COPIES)
@pytest.mark.parametrize("make", [single, vector])
def test_an_environment_of_descriptions_that_was_not_reset_yet_can_be_copied(make, copied):
    options = {
        "robot": formats.load_model("turtlebot3_burger"),
        "world": formats.load("turtlebot3_world"),
        "goals": [(0.5, -0.5)],
        "lidar_samples": 360,
        "seed": 8,
    }
    env = make(STAGE.format(2), **options)
    other = copied(env)
    assert same(env.reset(), other.reset())
    env.close()
    other.close()


@pytest.mark.parametrize("copied", COPIES)
def test_worlds_that_wait_for_the_next_step_do_so_in_a_copy(copied):
    env = vector(STAGE.format(1), autoreset_mode="NextStep")
    env.reset(seed=0)
    for _ in range(7):
        *_, truncated, _ = env.step(np.full(4, 2))
    assert truncated.all()
    other = copied(env)
    assert same(env.step(np.full(4, 2)), other.step(np.full(4, 2)))
    env.close()
    other.close()


class Walk(BatchedTask):
    """A task of a user's: a random walk on a line."""

    control_period = 0.1
    observation_space = gym.spaces.Box(-np.inf, np.inf, (1,), np.float32)
    action_space = gym.spaces.Discrete(2)

    def __init__(self, nworld, *, step=1.0, limit=5):
        super().__init__(nworld, limit)
        self.size = step
        self.place = np.zeros(nworld)
        self.random = np.random.default_rng(0)

    def render(self, world):
        return np.zeros((2, 2, 3), np.uint8)

    def close(self):
        pass

    def _seed(self, seed):
        self.random = np.random.default_rng(seed)

    def _begin(self, worlds):
        self.place[worlds] = self.random.uniform(size=len(worlds))

    def _look(self, worlds):
        return self.place[worlds, None].astype(np.float32), {}

    def _act(self, actions):
        self.place += self.size * (np.asarray(actions) - 0.5) + self.random.uniform(
            size=self.nworld
        )
        seen = self.place[:, None].astype(np.float32)
        return TaskOutcome(seen, self.place.copy(), self.place > 20.0, {})

    def _state(self):
        return {"place": self.place.copy(), "random": pickle.dumps(self.random)}

    def _set_state(self, state):
        self.place[:] = state["place"]
        self.random = pickle.loads(state["random"])


@pytest.mark.parametrize("copied", COPIES)
@pytest.mark.parametrize("wrap", [TaskEnv, TaskVectorEnv])
def test_a_task_of_a_users_is_copied_too(wrap, copied):
    env = wrap(Walk(1, step=3.0, limit=4))
    env.reset(seed=2)
    actions = [1 if wrap is TaskEnv else [1]] * 9
    future(env, actions[:3])
    other = copied(env)
    assert other.task.size == 3.0
    assert same(tuple(future(env, actions)), tuple(future(other, actions)))


@pytest.mark.parametrize("copied", COPIES)
@pytest.mark.parametrize("name", ["turtlebot3_stage_4", "furnished_room", "fleet"])
def test_descriptions_are_copied(name, copied):
    world = formats.load(assets.world(name))
    assert copied(world) == world


@pytest.mark.parametrize("copied", COPIES)
def test_a_copied_description_is_read_only_as_before(copied):
    model = formats.load_model("turtlebot3_burger")
    other = copied(model)
    assert other == model
    plugin = next(plugin for plugin in other.plugins if plugin.parameters.children)
    with pytest.raises(TypeError):
        plugin.parameters.attributes["name"] = "other"
