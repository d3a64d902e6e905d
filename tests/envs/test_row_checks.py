"""Wrong shapes of what a task of one's own returns are one error at the first step."""

import gymnasium as gym
import numpy as np
import pytest

import gazelle
from gazelle import formats
from gazelle.envs import SimulationTask, StepOutcome, TaskEnv, TaskVectorEnv
from gazelle.errors import TaskError

SLIDER = """<sdf version='1.7'><model name='b'><link name='x'><inertial><mass>1</mass></inertial></link>
<joint name='j' type='prismatic'><parent>world</parent><child>x</child><axis><xyz>1 0 0</xyz></axis>
</joint></model></sdf>"""
N = 4


class Task(SimulationTask):
    observation_space = gym.spaces.Box(-10.0, 10.0, (2,), np.float32)
    action_space = gym.spaces.Box(-1.0, 1.0, (1,), np.float32)

    def __init__(self, nworld=N, **terms):
        simulation = gazelle.Simulation(
            formats.load_string(SLIDER), nworld=nworld, time_step=0.02, threads=1
        )
        super().__init__(simulation, control_period=0.1, max_episode_steps=3)
        self.terms = {
            "reward": np.zeros(nworld),
            "terminated": np.zeros(nworld, bool),
            "info": {},
            "observation": None,
            **terms,
        }

    def observe(self, worlds):
        count = self.nworld if worlds is None else len(worlds)
        given = self.terms["observation"]
        return np.zeros((count, 2)) if given is None else given

    def act(self, actions):
        pass

    def outcome(self, observation):
        return StepOutcome(*(self.terms[name] for name in ("reward", "terminated", "info")))


REWARD = r"reward has shape {}, expected \(4,\); one number a world, such as np\.zeros\(4\)"
ENDS = r"terminated has shape {}, expected \(4,\); one bool a world, such as np\.zeros\(4, bool\)"
INFO = r"info\['e'\] has shape {}, expected \(4, \.\.\.\); a row a world; .* np\.full\(4, value\)"
OBSERVATION = r"observation has shape {}, expected \(4, 2\); a row a world"
WRONG = [
    ({"reward": np.zeros(1)}, REWARD.format(r"\(1,\)")),
    ({"reward": np.zeros((N, 1))}, REWARD.format(r"\(4, 1\)")),
    ({"reward": 1.0}, REWARD.format(r"\(\)")),
    ({"reward": np.zeros(N + 1)}, REWARD.format(r"\(5,\)")),
    ({"reward": None}, r"reward has shape \(\), expected \(4,\)"),
    ({"reward": ["a"] * N}, "reward is of <U1, expected numbers"),
    ({"reward": [[0.0], [0.0, 1.0]]}, "reward has rows of different lengths"),
    ({"reward": np.array([0.0, np.nan, 0.0, 0.0])}, "the reward of world 1 is nan"),
    ({"reward": np.array([0.0, 0.0, 0.0, np.inf])}, "the reward of world 3 is inf"),
    ({"terminated": False}, ENDS.format(r"\(\)")),
    ({"terminated": np.zeros((N, 1), bool)}, ENDS.format(r"\(4, 1\)")),
    ({"terminated": np.zeros(1, bool)}, ENDS.format(r"\(1,\)")),
    ({"terminated": np.zeros(N)}, "terminated is of float64, expected bools"),
    ({"terminated": np.zeros(N, int)}, "terminated is of int64, expected bools"),
    ({"info": {"e": np.zeros(1)}}, INFO.format(r"\(1,\)")),
    ({"info": {"e": 0.5}}, INFO.format(r"\(\)")),
    ({"info": {"e": np.zeros((2, N))}}, INFO.format(r"\(2, 4\)")),
    ({"info": {"good": np.zeros(N), "e": True}}, INFO.format(r"\(\)")),
    ({"info": {"e": ["a"] * N}}, r"info\['e'\] is of <U1, expected numbers"),
    ({"info": {"e": [None] * N}}, r"info\['e'\] is of object, expected numbers"),
]


@pytest.mark.parametrize(("terms", "text"), WRONG)
def test_a_wrong_term_is_named_at_the_first_step(terms, text):
    env = TaskVectorEnv(Task(**terms), seed=0)
    env.reset()
    with pytest.raises(TaskError, match=text):
        env.step(np.zeros((N, 1), np.float32))
    env.close()


@pytest.mark.parametrize("shape", [(N,), (N, 1), (N, 2, 1), (2,), (), (1, 2)])
def test_a_wrong_observation_is_named_at_the_reset(shape):
    env = TaskVectorEnv(Task(observation=np.zeros(shape)), seed=0)
    written = str(shape).replace("(", r"\(").replace(")", r"\)")
    with pytest.raises(TaskError, match=OBSERVATION.format(written)):
        env.reset()
    env.close()


def test_a_single_environment_says_the_same():
    env = TaskEnv(Task(1, reward=2.0))
    env.reset(seed=0)
    with pytest.raises(TaskError, match=r"reward has shape \(\), expected \(1,\)"):
        env.step(np.zeros(1, np.float32))
    env.close()


def test_lists_and_ints_of_the_right_shape_are_taken():
    terms = {"reward": [1, 2, 3, 4], "terminated": [False] * N, "info": {"e": [1, 2, 3, 4]}}
    env = TaskVectorEnv(Task(**terms), seed=0)
    env.reset()
    for _ in range(5):  # over the end of an episode
        _, reward, terminated, _, info = env.step(np.zeros((N, 1), np.float32))
    assert reward.dtype == np.float64
    assert not terminated.any()
    np.testing.assert_array_equal(info["e"], [1, 2, 3, 4])
    env.close()
