"""PPO throughput beside Stable-Baselines3's own, all in and on an environment that costs nothing.

All in: trainings of TurtleBot3Stage4 in the planar engine as its recipe says, with several numbers
of worlds; Stable-Baselines3's PPO has the same environment, reward and settings, its own buffers
and an equal network. Of the free environment, what is left is the learner: acting, storing, updating. Shape: 64 copies, 28
observations, 5 actions, rollouts of 64 steps, minibatches of 1,024, 4 epochs,
two hidden layers of 64 with tanh, one thread.
"""

from __future__ import annotations

import argparse
import dataclasses
import tempfile
import time

import gymnasium as gym
import numpy as np
from _whole_training import HEADER, compare, warm_up
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from gazelle.training import Recipe, train
from gazelle.training.threads import limit_threads
from gazelle.training.vecenv import VectorEnvAdapter

_OBSERVATIONS, _ACTIONS = 28, 5


class FreeEnv(VectorEnv):
    """Always returns the same random observations, at no cost."""

    metadata = {"autoreset_mode": AutoresetMode.SAME_STEP}  # noqa: RUF012  # Gymnasium's own form

    def __init__(self, num_envs: int = 64) -> None:
        self.num_envs = num_envs
        self.single_observation_space = gym.spaces.Box(-1, 1, (_OBSERVATIONS,), np.float32)
        self.single_action_space = gym.spaces.Discrete(_ACTIONS)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._obs = np.random.default_rng(0).random((num_envs, _OBSERVATIONS), dtype=np.float32)
        self._rewards = np.zeros(num_envs)
        self._never = np.zeros(num_envs, dtype=np.bool_)

    def reset(self, *, seed=None, options=None):
        del seed, options
        return self._obs, {}

    def step(self, actions):
        del actions
        return self._obs, self._rewards, self._never, self._never, {}


def ours(steps: int) -> float:
    """Return steps/s of `gazelle.training.train`, curves and checkpoints included."""
    recipe = dataclasses.replace(Recipe(), steps=steps)
    with tempfile.TemporaryDirectory() as folder:
        result = train("benchmark/Free-v0", recipe=recipe, out=folder)
    return result.new_steps / result.wall_seconds


def peers(steps: int) -> float:
    """Return steps/s of Stable-Baselines3's PPO with the same settings, without curves."""
    from stable_baselines3 import PPO

    learner = PPO(
        "MlpPolicy",
        VectorEnvAdapter(FreeEnv()),
        n_steps=64,
        batch_size=1024,
        n_epochs=4,
        device="cpu",
        policy_kwargs={"net_arch": [64, 64]},
    )
    start = time.perf_counter()
    learner.learn(steps)
    return learner.num_timesteps / (time.perf_counter() - start)


def main() -> None:
    parser = argparse.ArgumentParser(prog="gazelle bench learner", description=__doc__)
    parser.add_argument("--steps", type=int, default=200_000, help="in the free environment")
    parser.add_argument("--all-in", action="store_true", help="only whole trainings of a task")
    parser.add_argument("--worlds", type=int, nargs="*", default=[64, 256, 1024])
    parser.add_argument("--all-in-steps", type=int, default=500_000)
    parser.add_argument("--repeat", type=int, default=3)
    args = parser.parse_args()
    limit_threads(1)
    if args.worlds:
        warm_up()
        print(HEADER)
    for worlds in args.worlds:
        print(compare(worlds, args.all_in_steps, args.repeat), flush=True)
    if args.all_in:
        return
    gym.register("benchmark/Free-v0", vector_entry_point=FreeEnv)
    ours(8192)  # warm up
    found = [(ours(args.steps), peers(args.steps)) for _ in range(args.repeat)]
    best_ours, best_peer = (max(column) for column in zip(*found, strict=True))
    print(f"gazelle PPO            {best_ours:10,.0f} steps/s")
    print(f"Stable-Baselines3 PPO  {best_peer:10,.0f} steps/s")
    print(f"ratio                  {best_ours / best_peer:10.2f}")


if __name__ == "__main__":
    main()
