"""A small vector environment: a point in a corridor that must find its goal."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

PERIOD = 0.2
MODES = [AutoresetMode.SAME_STEP, AutoresetMode.NEXT_STEP, AutoresetMode.DISABLED]


class Corridor(VectorEnv):
    """Position and goal lie in [-1, 1]; leaving that range is a collision.

    Observation: position, goal, steps done as a share of the limit. Action: the
    move, one of three or a number in [-1, 1], a tenth of it in metres.
    """

    control_period = PERIOD

    def __init__(
        self,
        num_envs: int = 1,
        mode: str = "SameStep",
        continuous: bool = False,
        limit: int = 30,
        tell: bool = True,
        bound: float = 1.2,
        scale: float = 1.0,
    ):
        self.num_envs = num_envs
        self.mode = AutoresetMode(mode)
        self.metadata = {"autoreset_mode": self.mode}
        self.limit = limit
        self.tell = tell
        self.scale = scale
        self.single_observation_space = gym.spaces.Box(-bound, bound, (3,), np.float32)
        self.single_action_space = (
            gym.spaces.Box(-1, 1, (1,), np.float32) if continuous else gym.spaces.Discrete(3)
        )
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.continuous = continuous
        self.position = np.zeros(num_envs)
        self.goal = np.zeros(num_envs)
        self.steps = np.zeros(num_envs, dtype=np.int64)
        self.resetting = np.zeros(num_envs, dtype=bool)
        self.rng = np.random.default_rng(0)

    def reset(self, *, seed=None, options=None):
        if seed is not None:
            self.rng = np.random.default_rng(seed)
        mask = (options or {}).get("reset_mask", np.ones(self.num_envs, dtype=bool))
        self._restart(mask)
        return self._observe(), {}

    def step(self, actions):
        actions = np.asarray(actions)
        move = actions[:, 0] if self.continuous else actions - 1.0
        active = ~self.resetting
        before = np.abs(self.goal - self.position)
        self.position = np.where(active, self.position + 0.1 * move, self.position)
        self.steps += active
        distance = np.abs(self.goal - self.position)
        success = active & (distance < 0.06)
        collision = active & ~success & (np.abs(self.position) > 1.0)
        terminated = success | collision
        truncated = active & ~terminated & (self.steps >= self.limit)
        reward = np.where(active, before - distance + 1.0 * success - 1.0 * collision, 0.0)
        reward *= self.scale
        info = {}
        if self.tell:
            info = {"is_success": success, "is_collision": collision, "is_timeout": truncated}
        done = terminated | truncated
        self._restart(self.resetting)
        if self.mode is AutoresetMode.SAME_STEP and done.any():
            info = {"final_obs": self._observe(), "final_info": info}
            self._restart(done)
        self.resetting = done if self.mode is AutoresetMode.NEXT_STEP else self.resetting
        return self._observe(), reward, terminated, truncated, info

    def get_state(self):
        return {
            "arrays": (self.position.copy(), self.goal.copy(), self.steps.copy()),
            "resetting": self.resetting.copy(),
            "rng": self.rng.bit_generator.state,
            "blob": b"corridor",
        }

    def set_state(self, state):
        self.position, self.goal, self.steps = (np.array(part) for part in state["arrays"])
        self.resetting = np.array(state["resetting"])
        self.rng.bit_generator.state = state["rng"]

    def _restart(self, mask):
        count = int(mask.sum())
        self.position[mask] = self.rng.uniform(-0.9, 0.9, count)
        self.goal[mask] = self.rng.uniform(-0.9, 0.9, count)
        self.steps[mask] = 0
        self.resetting = self.resetting & ~mask

    def _observe(self):
        columns = (self.position, self.goal, self.steps / self.limit)
        return np.column_stack(columns).astype(np.float32)


class Forgetful(Corridor):
    """A corridor that cannot save its state."""

    get_state = None
    set_state = None


def register():
    if "test/Corridor-v0" not in gym.registry:
        gym.register("test/Corridor-v0", vector_entry_point=Corridor)
        gym.register("test/Forgetful-v0", vector_entry_point=Forgetful)
