"""Recipe: all parameters of a training, and their form as JSON."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from gazelle.argument_checks import checked
from gazelle.errors import TaskError, did_you_mean
from gazelle.training.bearing import Bearing, bearing_of
from gazelle.training.goal_reward import GoalReward
from gazelle.training.number_checks import check_numbers
from gazelle.training.supported_values import check_supported

Activation = Literal["tanh", "relu"]
ACTIVATIONS = ("tanh", "relu")

ALGORITHM_NAMES = ("ppo", "dqn", "sac", "td3", "ddpg")
"""The names of the algorithms; `gazelle.training.ALGORITHMS` says how they are built."""

NEED_CONTINUOUS_ACTIONS = frozenset({"sac", "td3", "ddpg", "tqc"})
"""Those that cannot choose among numbered actions."""

LIBRARY_ALGORITHMS = {
    "a2c": ("stable_baselines3", "A2C"),
    "qrdqn": ("sb3_contrib", "QRDQN"),
    "recurrent_ppo": ("sb3_contrib", "RecurrentPPO"),
    "tqc": ("sb3_contrib", "TQC"),
    "trpo": ("sb3_contrib", "TRPO"),
}
"""More of them, of which the libraries' own settings are used: package and class."""


@checked(TaskError)
@dataclass(frozen=True, kw_only=True)
class PPOSettings:
    """Settings specific to PPO (Schulman et al. 2017, arXiv 1707.06347)."""

    n_steps: int = 64
    """Control steps of each copy between two updates."""
    batch_size: int = 1024
    """Transitions in a minibatch."""
    n_epochs: int = 4
    """Passes over the collected transitions in an update."""
    gae_lambda: float = 0.95
    """Trade of bias for variance (Schulman et al. 2015, arXiv 1506.02438)."""
    clip_range: float = 0.2
    """Largest change of the new policy's probability ratio from 1."""
    ent_coef: float = 0.005
    """Weight of the entropy bonus."""
    vf_coef: float = 0.5
    """Weight of the value loss."""
    max_grad_norm: float = 0.5
    """Gradients longer than this are shortened to it."""
    initial_std: float = 1.0
    """Standard deviation of continuous actions at first, in their units: what is learnt of is soon lost
    in the noise where it is many times what actions should be."""
    scale_rewards: bool = False
    """True if rewards are divided by the standard deviation of the discounted returns seen so far, and
    cut at 10 times that, so that their units do not matter."""
    bfloat16: bool = False
    """True if updates multiply in bfloat16 where the processor can, which is faster."""
    overlap: bool = False
    """True if updates run beside the next rollout, on another processor."""


@checked(TaskError)
@dataclass(frozen=True, kw_only=True)
class OffPolicySettings:
    """Settings shared by DQN, DDPG, TD3 and SAC."""

    buffer_size: int = 300_000
    """Transitions remembered."""
    batch_size: int = 256
    """Transitions in a minibatch."""
    learning_starts: int = 5_000
    """Transitions before the first update, random or shown."""
    train_freq: int = 1
    """Control steps of all copies between two updates."""
    gradient_steps: int = 1
    """Minibatches in an update."""
    n_steps: int = 1
    """Control steps whose rewards are added up before the value of what follows."""
    tau: float = 0.005
    """Share of the new weights that goes into the target network at each update."""
    action_noise: float = 0.1
    """Standard deviation of DDPG's and TD3's exploration noise, actions scaled to [-1, 1]."""
    random_actions: float = 0.0
    """Share of DDPG's and TD3's actions that are drawn evenly."""
    action_penalty: float = 0.0
    """Price of an action's mean square (DDPG, TD3), so that small ones are not given up for good."""
    bound_values: bool = False
    """True if targets stay within what the rewards seen so far can add up to (DDPG, TD3)."""
    policy_delay: int | None = None
    """Minibatches for each update of the policy (DDPG, TD3, SAC); by default 1, for TD3 2."""
    initial_entropy_weight: float = 1.0
    """Weight of the entropy at first (SAC), in units of the reward: it is learnt, but where rewards are
    small, one that is large makes all actions alike for long."""
    demonstrator: str | None = None
    """``module:function`` that acts before the first update (DDPG, TD3), in place of chance: it takes
    observations in rows and gives actions; see `gazelle.training.demonstrations`."""
    imitation: float = 0.0
    """Price of the mean square by which the policy misses actions that were shown (DDPG, TD3), where
    they are worth more than its own."""
    bfloat16: bool = False
    """True if hidden layers multiply in bfloat16 (DDPG, TD3, SAC), where the processor can far
    faster.
    """
    exploration_fraction: float = 0.2
    """Share of the training in which DQN's random actions become rare."""
    exploration_final: float = 0.05
    """Share of random actions that stays (DQN)."""
    target_update_interval: int = 2_000
    """Transitions between two copies to DQN's target network (with tau 1)."""
    double_q: bool = False
    """True if the network that learns chooses the action that the target network values (DQN), so
    that what is valued too high is not chosen for it."""


@dataclass(frozen=True, kw_only=True)
class LibrarySettings:
    """For the algorithms of `LIBRARY_ALGORITHMS`: what their class takes."""

    options: Mapping[str, Any] = field(default_factory=dict)
    """Arguments of the class, such as ``{"n_steps": 128}``."""


Settings = PPOSettings | OffPolicySettings | LibrarySettings


@dataclass(frozen=True, kw_only=True)
class Recipe:
    """Recipe for training one task with one algorithm."""

    algo: str = "ppo"
    """One of the names in `gazelle.training.ALGORITHMS`."""
    steps: int = 500_000
    """Control steps in total, all copies together."""
    success_to_finish: float | None = None
    """Share of successes in the latest 200 episodes at which a training goes over to its end, see
    `steps_after_success`; None: it does all its ``steps``."""
    num_envs: int = 64
    """Copies of the world that run at once."""
    net_arch: tuple[int, ...] = (64, 64)
    """Sizes of the hidden layers."""
    activation: Activation = "tanh"
    """Activation after each hidden layer."""
    learning_rate: float = 3e-4
    """Step size of Adam at the start."""
    learning_rate_decay: bool = True
    """True if the step size falls in a straight line to 0 at the end."""
    learning_rate_hold: float = 0.0
    """Share of the training before it begins to fall."""
    gamma: float = 0.98
    """Discount of one control step."""
    reward_scale: float = 1.0
    """Rewards are multiplied by this before they reach the learner (reports show them as they are)."""
    goal_reward: GoalReward | None = None
    """Reward for the learner in place of the task's rewards (reports show those)."""
    scale_observations: bool = True
    """True if observations are scaled before the first layer: by bounds that fit, else as observed."""
    features: bool = False
    """True if the network also gets sines and cosines of angles and logarithms of ranges."""
    angles: tuple[int, ...] = ()
    """Indices of observation entries that are angles, beside those with bounds -pi and pi
    (`features`): those of joints, with any limits.
    """
    bearing: Bearing | None = None
    """Indices of a base's pose and its goal, if the network also gets distance and direction: for
    tasks with a fixed goal, which is not observed.
    """
    hindsight: float = 0.8
    """Share of what is learnt from that gets a goal which was reached later: of tasks with goals,
    by algorithms with a replay memory."""
    cut_observations: float | None = None
    """Entries that are normalised by what was observed are cut a given number of standard deviations from their
    mean, so that what flies off once in a while does not make all else look small; None: not cut."""
    hindsight_redraw: float = 0.0
    """Share of those steps that is drawn again, up to twice, where that goal was reached before the
    step already: such steps teach standing still, and are most of all while nothing is learnt yet."""
    goal_differences: bool = False
    """True if the network also gets the difference of achieved and desired goal, entry by entry."""
    training_options: Mapping[str, Any] = field(default_factory=dict)
    """Options of the environment that a training sets, unless the user does."""
    evaluation_options: Mapping[str, Any] = field(default_factory=dict)
    """Options of the environment that evaluations set differently from the training, beside
    those of the task itself."""
    settings: Settings = PPOSettings()
    """Settings that only this algorithm has."""

    def __post_init__(self) -> None:
        """Check that the numbers can work, and that the algorithm takes notice of them.

        Raises:
            TaskError: One of them cannot, or it does not.
        """
        known = (*ALGORITHM_NAMES, *LIBRARY_ALGORITHMS)
        if self.algo not in known:
            hint = did_you_mean(self.algo, known)
            raise TaskError(f"there is no algorithm '{self.algo}'", hint=hint)
        check_numbers(self)
        check_numbers(self.settings)
        for name in ("learning_rate", "reward_scale", "cut_observations", "success_to_finish"):
            value = getattr(self, name)
            if value is not None and not value > 0:
                raise TaskError(f"{name} must be above 0, not {value}")
        if self.activation not in ACTIVATIONS:
            hint = did_you_mean(str(self.activation), ACTIVATIONS)
            raise TaskError(f"there is no activation '{self.activation}'", hint=hint)
        if not 0 <= self.learning_rate_hold < 1:
            raise TaskError(f"learning_rate_hold must be below 1, not {self.learning_rate_hold}")
        for name in ("gamma", "hindsight", "hindsight_redraw", "success_to_finish"):
            value = getattr(self, name)
            if value is not None and not 0 <= value <= 1:
                raise TaskError(f"{name} must be between 0 and 1, not {value}")
        check_supported(self.algo, self)
        _check_settings(self.algo, self.settings)

    def evaluated(self, options: Mapping[str, Any]) -> dict[str, Any]:
        """Return options of the environment for evaluations: what a user chose for the training stays.

        Args:
            options: Those of the training.
        """
        of_recipe = {
            name: value
            for name, value in self.evaluation_options.items()
            if options.get(name) == self.training_options.get(name)
        }
        return {**options, **of_recipe}

    def with_steps(self, steps: int) -> Recipe:
        """Return the recipe with a number of control steps, all of which are done."""
        return dataclasses.replace(self, steps=steps, success_to_finish=None)

    def steps_after_success(self, done: int) -> int:
        """Return the control steps of a training that had its success after a given number of them.

        It does as many again, at least three tenths of ``steps`` in all, while the step size falls to 0.
        """
        return min(max(2 * done, 3 * self.steps // 10), self.steps)

    @property
    def rollout_steps(self) -> int | None:
        """Control steps of each copy between two updates; None if the library decides."""
        if isinstance(self.settings, PPOSettings):
            return self.settings.n_steps
        if isinstance(self.settings, OffPolicySettings):
            return self.settings.train_freq
        given = self.settings.options.get("n_steps")
        return given if isinstance(given, int) else None

    @property
    def rounded_steps(self) -> int:
        """Control steps that a training does: ``steps``, rounded up to whole rollouts of all copies."""
        rollout = self.num_envs * (self.rollout_steps or 1)
        return -(-self.steps // rollout) * rollout


def _check_settings(algo: str, settings: Settings) -> None:
    """Check that settings are those of an algorithm, and that it takes notice of them."""
    settings_class = _settings_of(algo)
    if not isinstance(settings, settings_class):
        raise TaskError(f"a recipe for {algo} needs {settings_class.__name__}")
    if not isinstance(settings, OffPolicySettings):
        return
    check_supported(algo, settings)
    if settings.imitation and settings.demonstrator is None:
        hint = "name a demonstrator, or set imitation to 0"
        raise TaskError("imitation needs a demonstrator", hint=hint)


def _settings_of(algo: str) -> type[Settings]:
    """Return the class of an algorithm's settings."""
    if algo in LIBRARY_ALGORITHMS:
        return LibrarySettings
    return PPOSettings if algo == "ppo" else OffPolicySettings


def recipe_to_dict(recipe: Recipe) -> dict[str, Any]:
    """Return a recipe as plain values for JSON."""
    return dataclasses.asdict(recipe)


def recipe_from_dict(values: dict[str, Any]) -> Recipe:
    """Return the recipe that `recipe_to_dict` wrote.

    Raises:
        TaskError: A key is not part of a recipe, or its algorithm does not support a value.
    """
    rest = _checked(Recipe, values)
    kind = _settings_of(rest.get("algo", "ppo"))
    settings = kind(**_checked(kind, rest.pop("settings", {})))
    for name in {"net_arch", "angles"} & set(rest):
        rest[name] = tuple(rest[name])
    if rest.get("bearing") is not None:
        rest["bearing"] = bearing_of(rest["bearing"])
    if rest.get("goal_reward") is not None:
        rest["goal_reward"] = GoalReward(**_checked(GoalReward, rest["goal_reward"]))
    return Recipe(**rest, settings=settings)


def _checked(kind: type[Any], values: Any) -> dict[str, Any]:
    if not isinstance(values, dict):
        raise TaskError(f"a {kind.__name__} must be names with values, not {values!r:.60}")
    known = {field.name for field in dataclasses.fields(kind)}
    for key in values:
        if key not in known:
            hint = did_you_mean(key, known)
            raise TaskError(f"'{key}' is not part of {kind.__name__}", hint=hint)
    return dict(values)
