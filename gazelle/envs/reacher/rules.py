"""Parameters of frobs_rl's reaching tasks, as published."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.array_types import Floats

Corner = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class ReachRules:
    """Parameters of one task."""

    robot: str
    """Bundled robot."""
    by_speed: bool = False
    """True if actions are speeds of the joints; else changes of their angles."""
    most_speed: float = 0.2
    """Of an action that is a speed [rad/s]."""
    lower: tuple[float, ...]
    """Lower limits of the joints [rad]."""
    upper: tuple[float, ...]
    """Upper limits of the joints [rad]."""
    limit_margin: float = 1e-4
    """A joint this near to a limit is at it [rad]."""
    goal_low: Corner
    """Corner of where goals are [m]."""
    goal_high: Corner
    """The other corner [m]."""
    random_start: bool = True
    """True if joints start anywhere within their limits; else at 0."""
    tolerance: float = 0.05
    """Tolerance of the goal [m]."""
    ends: bool = True
    """True if reaching the goal ends the episode."""
    distance_weight: float = 1.0
    """Taken for each metre to the goal, each step."""
    step_reward: float = -0.01
    """Of each step that does not get there."""
    goal_reward: float = 10.0
    """Of a step that is there."""
    limit_reward: float = -5.0
    """Added where a joint is at a limit."""

    @property
    def control_period(self) -> float:
        """Time of a step [s]; frobs_rl's wait until a motion is done, or not at all."""
        return 0.1 if self.by_speed else 0.5


@dataclass(frozen=True, slots=True)
class ReachView:
    """Observed state, arrays over worlds.

    Attributes:
        angles: Of the joints [rad], shape (n, 6).
        tool: Position of the tool [m], shape (n, 3).
        goal: Goal of the tool [m], shape (n, 3).
        direction: From tool to goal, of length 1, shape (n, 3).
        distance: From tool to goal [m], shape (n,).
    """

    angles: Floats
    tool: Floats
    goal: Floats
    direction: Floats
    distance: Floats


_TURN = 6.283185307179586
IRB120 = ReachRules(
    robot="abb_irb120",
    lower=(-2.87979, -1.91986, -1.91986, -2.79253, -2.094395, -6.98132),
    upper=(2.87979, 1.91986, 1.22173, 2.79253, 2.094395, 6.98132),
    goal_low=(-0.5, -0.5, 0.0),
    goal_high=(0.5, 0.5, 1.0),
)
IRB140 = ReachRules(
    robot="abb_irb140",
    lower=(-3.14159, -1.5708, -4.01426, -3.49066, -2.0071, -6.98132),
    upper=(3.14159, 1.91986, 0.872665, 3.49066, 2.0071, 6.98132),
    goal_low=(0.3, -0.5, 0.2),
    goal_high=(1.0, 0.5, 1.0),
    random_start=False,
    tolerance=0.1,
    distance_weight=100.0,
    step_reward=-1.0,
    goal_reward=100.0,
    limit_reward=-1000.0,
)
IRB140_SPEED = ReachRules(
    robot="abb_irb140",
    by_speed=True,
    lower=(-3.14159, -1.7453, -2.44346, -3.49066, -2.0071, -6.28319),
    upper=(3.14159, 1.7453, 2.44346, 3.49066, 2.0071, 6.28319),
    limit_margin=0.09,
    goal_low=(-0.5, -0.5, 0.0),
    goal_high=(0.5, 0.5, 1.0),
    ends=False,
    step_reward=0.0,
    goal_reward=100.0,
    limit_reward=-10.0,
)
UR5 = ReachRules(
    robot="ur5",
    lower=(-_TURN, -_TURN, -_TURN / 2.0, -_TURN, -_TURN, -_TURN),
    upper=(_TURN, _TURN, _TURN / 2.0, _TURN, _TURN, _TURN),
    goal_low=(0.0, -0.5, 0.2),
    goal_high=(0.7, 0.5, 1.0),
)
