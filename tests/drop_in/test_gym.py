"""The old gym: reset returns one value, step four; Gymnasium's spaces and environments are in it."""

from __future__ import annotations

import importlib
import json
import subprocess
import sys
import warnings

import gymnasium
import numpy as np
import pytest

import gazelle_ros as ros
from gazelle.drop_in import gym
from gazelle.drop_in.gym import error, spaces, wrappers
from gazelle.drop_in.gym.envs import registration
from gazelle.drop_in.gym.utils import seeding
from gazelle.drop_in.shimmy import GymV21CompatibilityV0


class Count(gym.Env):
    """Counts its steps; ends at ``end``."""

    action_space = spaces.Discrete(3)
    observation_space = spaces.Box(np.zeros(1, np.float32), np.full(1, 100.0, np.float32))

    def __init__(self, end=5):
        self.end, self.count, self.closed = end, 0, False
        self.seed()

    def reset(self):
        self.count = 0
        return [0.0]

    def step(self, action):
        self.count += 1
        return [float(self.count)], float(action), self.count >= self.end, {}

    def seed(self, seed=None):
        self.np_random, seed = seeding.np_random(seed)
        return [seed]

    def close(self):
        self.closed = True


class Ancient(gym.Env):
    """As environments were written for gym 0.9."""

    action_space = spaces.Discrete(2)
    observation_space = spaces.Discrete(2)

    def _reset(self):
        return 0

    def _step(self, action):
        return action, 1.0, True, {"old": True}

    def _seed(self, seed=None):
        return [seed]


@pytest.fixture(autouse=True)
def registered(monkeypatch):
    monkeypatch.setattr(registration.registry, "env_specs", {})
    gym.register(id="Count-v0", entry_point=Count, timestep_limit=3)
    gym.register(id="Ancient-v1", entry_point=f"{__name__}:Ancient")


def test_a_time_limit_cuts_and_says_so():
    env = gym.make("Count-v0")
    assert isinstance(env, wrappers.TimeLimit)
    assert env.spec.id == "Count-v0"
    assert env.spec.timestep_limit == 3
    assert env.reset() == [0.0]
    assert [env.step(1)[2] for _ in range(3)] == [False, False, True]
    env.reset()
    infos = [env.step(1)[3] for _ in range(3)]
    assert infos == [{}, {}, {"TimeLimit.truncated": True}]
    ended = gym.make("Count-v0", end=3)
    ended.reset()
    assert [ended.step(1)[3] for _ in range(3)][-1] == {"TimeLimit.truncated": False}


def test_a_step_before_the_first_reset_is_an_error():
    with pytest.raises(error.ResetNeeded):
        gym.make("Count-v0").step(0)


@pytest.mark.parametrize(
    ("entry", "kind"),
    [
        (Count, Count),
        ("gazelle.drop_in.gym:core.Env", gym.Env),
        ("gazelle.drop_in.gym:wrappers.time_limit.TimeLimit", None),
    ],
)
def test_entry_points_may_lead_through_modules(entry, kind):
    gym.register(id="Entry-v7", entry_point=entry)
    if kind is None:
        with pytest.raises(TypeError):
            gym.make("Entry-v7")
        return
    assert type(gym.make("Entry-v7")) is kind


def test_names_that_are_wrong_are_said():
    with pytest.raises(error.UnregisteredEnv, match="did you mean 'Count-v0'"):
        gym.make("Cuont-v0")
    with pytest.raises(error.Error, match="-v0"):
        gym.register(id="NoVersion", entry_point=Count)
    gym.register(id="Bad-v0", entry_point="nothing")
    with pytest.raises(error.Error, match="module:class"):
        gym.make("Bad-v0")


def test_registering_again_replaces():
    gym.register(id="Count-v0", entry_point=Count, max_episode_steps=2)
    assert gym.make("Count-v0").spec.max_episode_steps == 2
    assert {each.id for each in gym.envs.registry.all()} == {"Count-v0", "Ancient-v1"}


def test_underscored_methods_are_called():
    env = Ancient()
    assert env.reset() == 0
    assert env.step(1) == (1, 1.0, True, {"old": True})
    assert env.seed(4) == [4]
    with pytest.raises(NotImplementedError, match="Ancient has no render"):
        env.render()


def test_environments_of_gymnasium_have_the_old_interface():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        env = gym.make("CartPole-v0")
    env.seed(3)
    first = env.reset()
    assert first.shape == (4,)
    env.seed(3)
    assert np.array_equal(env.reset(), first)
    steps = [env.step(0)]
    while not steps[-1][2]:
        steps.append(env.step(0))
    assert all(len(step) == 4 for step in steps)
    long = gym.make("Pendulum-v1")
    long.reset()
    ends = [long.step(long.action_space.sample()) for _ in range(200)]
    assert ends[-1][2]
    assert ends[-1][3] == {"TimeLimit.truncated": True}
    assert isinstance(long.action_space, gymnasium.spaces.Box)


@pytest.mark.parametrize("seed", [0, 1, 2**40, None])
def test_equal_seeds_give_equal_numbers_with_the_old_methods(seed):
    one, used = seeding.np_random(seed)
    other, again = seeding.np_random(used)
    assert used == again
    assert seed is None or used == seed
    assert one.randint(1000) == other.randint(1000)
    assert one.rand() == other.rand()


@pytest.mark.parametrize("seed", [-1, 1.5, "three"])
def test_what_is_no_seed_is_said(seed):
    with pytest.raises(error.Error, match="a seed is"):
        seeding.np_random(seed)


def test_a_monitor_writes_what_episodes_came_to(tmp_path):
    env = wrappers.Monitor(Count(end=2), tmp_path / "out", force=True)
    for action in (1, 2):
        env.reset()
        env.step(action)
        env.step(action)
    env._flush(force=True)
    assert list((tmp_path / "out").iterdir())
    env.reset()
    env.step(1)  # an episode that is left before its end
    env.close()
    assert env.unwrapped.closed
    (stats,) = (tmp_path / "out").glob("openaigym.episode_batch.*.stats.json")
    figures = json.loads(stats.read_text())
    assert figures["episode_lengths"] == [2, 2, 1]
    assert figures["episode_rewards"] == [2.0, 4.0, 1.0]
    assert figures["episode_types"] == ["t"] * 3
    (manifest,) = (tmp_path / "out").glob("openaigym.manifest.*.json")
    assert json.loads(manifest.read_text())["stats"] == stats.name
    assert env.get_total_steps() == 5


def test_a_monitor_does_not_mix_with_anothers_files(tmp_path):
    wrappers.Monitor(Count(), tmp_path).close()
    with pytest.raises(error.Error, match="force=True"):
        wrappers.Monitor(Count(), tmp_path)
    wrappers.Monitor(Count(), tmp_path, resume=True)
    wrappers.Monitor(Count(), tmp_path, force=True)
    assert not list(tmp_path.glob("*.json"))


class Twice(gym.ObservationWrapper, gym.RewardWrapper):
    """Nothing but the methods that a user writes."""

    def observation(self, observation):
        return [2.0 * each for each in observation]


class Other(gym.ActionWrapper):
    def action(self, action):
        return 2 - action


def test_wrappers_change_one_thing_and_pass_on_the_rest():
    env = Other(Twice(Count()))
    assert env.reset() == [0.0]
    assert env.step(0) == ([2.0], 2.0, False, {})
    assert env.end == 5
    assert isinstance(env.unwrapped, Count)
    with pytest.raises(AttributeError):
        env.nothing  # noqa: B018
    env.close()
    assert env.unwrapped.closed


class Push(Count):
    """With a box of actions, and observations in parts."""

    action_space = spaces.Box(np.full(2, -4.0, np.float32), np.full(2, 8.0, np.float32))
    observation_space = spaces.Dict({"a": spaces.Discrete(2), "b": spaces.Discrete(3)})

    def reset(self):
        return {"a": 1, "b": 2}

    def step(self, action):
        return {"a": 0, "b": 0}, float(np.sum(action)), True, {}


def test_actions_are_clipped_and_rescaled():
    assert wrappers.ClipAction(Push()).step(np.array([99.0, -99.0]))[1] == 4.0
    scaled = wrappers.RescaleAction(Push(), -1.0, 1.0)
    assert scaled.step(np.array([-1.0, 1.0]))[1] == pytest.approx(4.0)
    assert scaled.step(np.array([0.0, 0.0]))[1] == pytest.approx(4.0)
    assert scaled.action_space.high.tolist() == [1.0, 1.0]
    with pytest.raises(error.Error, match="Box"):
        wrappers.RescaleAction(Count(), -1.0, 1.0)


def test_observations_are_flattened_and_episodes_summed():
    env = wrappers.RecordEpisodeStatistics(wrappers.FlattenObservation(Push()))
    assert env.reset().tolist() == [0, 1, 0, 0, 1]
    assert env.observation_space.shape == (5,)
    info = env.step(np.ones(2))[3]
    assert (info["episode"]["r"], info["episode"]["l"]) == (2.0, 1)
    assert wrappers.TransformReward(Count(), lambda reward: -reward).step(2)[1] == -2.0
    assert wrappers.TransformObservation(Count(), sum).reset() == 0.0


def test_goal_environments_want_their_three_parts():
    class Goal(gym.GoalEnv):
        observation_space = spaces.Dict({"observation": spaces.Discrete(2)})

    with pytest.raises(error.Error, match="achieved_goal"):
        Goal().reset()


def test_stable_baselines_takes_old_environments():
    env = GymV21CompatibilityV0(env=gym.make("Count-v0"))
    observation, info = env.reset(seed=3)
    assert (observation, info) == ([0.0], {})
    results = [env.step(1) for _ in range(3)]
    assert [each[2:4] for each in results] == [(False, False), (False, False), (False, True)]
    finished = GymV21CompatibilityV0("Count-v0", {"end": 1})
    finished.reset()
    assert finished.step(0)[2:4] == (True, False)


def test_scripts_import_it_by_name_and_nothing_stays():
    with ros.install():
        module = importlib.import_module("gym")
        assert module is gym
        assert importlib.import_module("gym.envs.registration").registry is registration.registry
        assert importlib.import_module("gym.wrappers").Monitor is wrappers.Monitor
        assert importlib.import_module("gym.utils.seeding").np_random is seeding.np_random
        with pytest.raises(ModuleNotFoundError):
            importlib.import_module("gym.nothing")
    assert not any(name == "gym" or name.startswith("gym.") for name in sys.modules)


def test_a_gym_of_the_users_own_comes_first(tmp_path, monkeypatch):
    (tmp_path / "gym").mkdir()
    (tmp_path / "gym" / "__init__.py").write_text("own = True\n")
    (tmp_path / "gym" / "spaces.py").write_text("here = True\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    with ros.install():
        assert importlib.import_module("gym").own
        assert importlib.import_module("gym.spaces").here
        with pytest.raises(ModuleNotFoundError):
            importlib.import_module("gym.wrappers")
    for name in ("gym", "gym.spaces"):
        del sys.modules[name]


def test_what_our_modules_share_is_not_offered():
    with ros.install(), pytest.raises(ModuleNotFoundError):
        importlib.import_module("shared")


def test_without_exec_there_is_no_gym():
    code = (
        "import gazelle, importlib.util, sys; sys.exit(importlib.util.find_spec('gym') is not None)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize(
    "line",
    [
        "from gym import Env, GoalEnv, VERSION, vector, version",
        "from gym.core import Env, Space, Wrapper",
        "from gym.envs.classic_control import AcrobotEnv, CartPoleEnv, PendulumEnv",
        "from gym.envs.classic_control.cartpole import CartPoleEnv",
        "from gym.envs import classic_control, toy_text",
        "from gym.envs.registration import EnvSpec, env_id_re, load, make, register, registry, spec",
        "from gym.envs.toy_text.frozen_lake import FrozenLakeEnv",
        "from gym.error import DoubleWrapperError, InvalidFrame, Unregistered, UnsupportedMode",
        "from gym.logger import DEBUG, MIN_LEVEL, debug, setLevel, set_level",
        "from gym.spaces import box, np_random, utils",
        "from gym.spaces.box import Box",
        "from gym.spaces.dict_space import Dict",
        "from gym.spaces.tuple_space import Tuple",
        "from gym.spaces.utils import flatdim, flatten, flatten_space, unflatten",
        "from gym.utils import EzPickle, colorize, ezpickle, json_utils",
        "from gym.utils.colorize import colorize",
        "from gym.utils.ezpickle import EzPickle",
        "from gym.utils.json_utils import json_encode_np",
        "from gym.utils.seeding import RNG, RandomNumberGenerator, create_seed, hash_seed",
        "from gym.vector import AsyncVectorEnv, SyncVectorEnv, VectorEnvWrapper, utils",
        "from gym.vector.sync_vector_env import SyncVectorEnv",
        "from gym.vector.utils.spaces import batch_space",
        "from gym.version import VERSION",
        "from gym.wrappers import FlattenDictWrapper, LazyFrames, frame_stack, monitoring",
        "from gym.wrappers.clip_action import ClipAction",
        "from gym.wrappers.frame_stack import FrameStack, LazyFrames",
        "from gym.wrappers.monitor import Monitor",
        "from gym.wrappers.monitoring import Monitor",
        "from gym.wrappers.normalize import NormalizeObservation, RunningMeanStd",
        "from gym.wrappers.record_episode_statistics import RecordEpisodeStatistics",
        "from gym.wrappers.time_limit import TimeLimit",
        "import gym.wrappers.filter_observation, gym.spaces.multi_discrete",
    ],
)
def test_names_are_found_in_their_old_modules(line):
    names: dict[str, object] = {}
    with ros.install():
        exec(line, names)
    first = line.partition("import")[2].split(",")[0].split(".")[0].strip()
    assert names[first] is not None
    assert not any(name == "gym" or name.startswith("gym.") for name in sys.modules)


def test_one_thing_is_one_thing_wherever_it_is_imported_from():
    with ros.install():
        for place in ("gym.spaces.box", "gym.spaces"):
            assert importlib.import_module(place).Box is gymnasium.spaces.Box
        for place in ("gym.wrappers.frame_stack", "gym.wrappers"):
            assert importlib.import_module(place).FrameStack is wrappers.FrameStack


@pytest.mark.parametrize("name", ["AcrobotEnv", "CartPoleEnv", "PendulumEnv", "FrozenLakeEnv"])
def test_classes_of_gyms_own_environments_have_the_old_interface(name):
    env = getattr(importlib.import_module("gazelle.drop_in.gym.envs.own"), name)()
    assert type(env).__name__ == name
    assert env.reset() in env.observation_space
    assert len(env.step(env.action_space.sample())) == 4


def test_inner_environments_of_gymnasium_have_the_old_interface():
    """Scripts take off the time limit, and seed what is within it."""
    env = gym.make("CartPole-v0")
    assert env._max_episode_steps == 200
    for each in (env, env.env, env.unwrapped):
        each.seed(3)
        assert each.reset() == pytest.approx(gym.make("CartPole-v0").unwrapped.env.reset(seed=3)[0])
        assert len(each.step(0)) == 4
    assert gym.spec("CartPole-v0").timestep_limit == 200
    assert gym.spec("CartPole-v0").make().spec.id == "CartPole-v0"


def test_observations_are_brought_to_mean_0_and_variance_1():
    env = wrappers.NormalizeObservation(Count(end=1000))
    env.reset()
    seen = np.array([env.step(0)[0] for _ in range(500)])
    # The 501 numbers from 0 to 500 have the mean 250 and the variance (501² - 1) / 12.
    assert seen[-1] == pytest.approx((500 - 250) / np.sqrt((501**2 - 1) / 12), rel=1e-3)


def test_rewards_are_divided_by_the_spread_of_returns():
    env = wrappers.NormalizeReward(Count(end=10**6), gamma=0.0)
    env.reset()
    rewards = [env.step(place % 3)[1] for place in range(3000)]
    assert np.std(rewards[-300:]) == pytest.approx(1.0, rel=0.01)


def test_entries_of_observations_become_a_row():
    env = wrappers.FlattenDictWrapper(Pair(), ["b", "a"])
    assert env.observation_space.shape == (2,)
    assert env.reset().tolist() == [2, 1]


def test_the_old_shared_source_of_random_numbers():
    prng = importlib.import_module("gazelle.drop_in.gym.spaces.prng")
    prng.seed(1)
    first = prng.np_random.rand()
    prng.seed(1)
    assert prng.np_random.rand() == first


def test_seeds_of_neighbours_are_unlike():
    assert seeding.hash_seed(1) == seeding.hash_seed(1) != seeding.hash_seed(2)
    assert 0 <= seeding.hash_seed(3, max_bytes=2) < 2**16


def test_frames_are_stacked_the_oldest_first():
    env = wrappers.FrameStack(Count(), 3)
    assert env.observation_space.shape == (3, 1)
    assert env.reset().tolist() == [[0.0]] * 3
    env.step(0)
    assert env.step(0)[0].tolist() == [[0.0], [1.0], [2.0]]


class Pair(Count):
    """Observations are dictionaries."""

    observation_space = spaces.Dict({"a": spaces.Discrete(9), "b": spaces.Discrete(9)})

    def reset(self):
        return {"a": 1, "b": 2}

    def step(self, action):
        return {"a": 3, "b": 4}, 0.0, False, {}


def test_observations_are_chosen_by_name():
    env = wrappers.FilterObservation(Pair(), ["b"])
    assert env.reset() == {"b": 2}
    assert env.step(0)[0] == {"b": 4}
    assert list(env.observation_space.spaces) == ["b"]
    with pytest.raises(error.Error, match="there is no observation 'c'"):
        wrappers.FilterObservation(Pair(), ["c"])


def test_observations_tell_the_time():
    env = wrappers.TimeAwareObservation(Count())
    assert env.reset().tolist() == [0.0, 0.0]
    assert env.step(0)[0].tolist() == [1.0, 1.0]


def test_steps_before_a_reset_are_refused():
    with pytest.raises(error.ResetNeeded):
        wrappers.OrderEnforcing(Count()).step(0)


def test_several_environments_as_one():
    registration.register("Counted-v3", entry_point=Count, kwargs={"end": 2})
    env = gym.vector.make("Counted-v3", num_envs=2)
    assert env.reset().tolist() == [[0.0], [0.0]]
    env.step([0, 1])
    seen, rewards, ends, infos = env.step([2, 1])
    assert (rewards.tolist(), ends.tolist()) == ([2.0, 1.0], [True, True])
    assert seen.tolist() == [[0.0], [0.0]]
    assert infos[0]["terminal_observation"] == [2.0]
    assert env.action_space.sample().shape == (2,)
    env.seed(3)
    env.close()
    assert all(each.unwrapped.closed for each in env.envs)


def test_what_gymnasium_registered_has_the_old_fields():
    found = gym.make("CartPole-v1").spec
    assert (found.timestep_limit, found.max_episode_steps, found.tags) == (500, 500, {})


class Wrong(Count):
    """Does not keep the rules in one place."""

    def step(self, action):
        return self.answer


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ((1, 2, 3), "four values"),
        (([0.0], "x", False, {}), "reward is a number"),
        (([0.0], 1.0, 0, {}), "done is a bool"),
        (([0.0], 1.0, False, None), "info is a dictionary"),
        (([500.0], 1.0, False, {}), "observation of step"),
    ],
)
def test_an_environment_is_checked(answer, said):
    checker = importlib.import_module("gazelle.drop_in.gym.utils.env_checker")
    env = Wrong()
    env.observation_space = spaces.Box(0.0, 100.0, (1,))
    env.reset = lambda: np.zeros(1, np.float32)
    first = answer[0]
    if isinstance(first, list):
        answer = (np.array(first, np.float32), *answer[1:])
    env.answer = answer
    with pytest.raises(error.Error, match=said):
        checker.check_env(env)


def test_what_is_open_is_closed_at_the_end():
    closer = importlib.import_module("gazelle.drop_in.gym.utils.closer").Closer(False)
    first, second = Count(), Count()
    closer.register(first)
    closer.unregister(closer.register(second))
    closer.close()
    assert (first.closed, second.closed) == (True, False)
