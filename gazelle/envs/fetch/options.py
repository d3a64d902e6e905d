"""Options of the Fetch tasks."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.envs.options import DynamicsSettings, TaskOptions, check_name

REWARDS = ("sparse", "dense")
CONTROLS = ("gripper", "joint", "original")


class FetchOptions(TaskOptions, total=False):
    """Further options of the Fetch tasks; see `FetchSettings`."""

    reward_type: str
    control: str


@dataclass(frozen=True, slots=True, kw_only=True)
class FetchSettings(DynamicsSettings):
    """Options of a Fetch task, checked.

    Attributes:
        reward_type: ``sparse`` (0 at the goal, else -1) or ``dense`` (minus the distance).
        control: ``gripper`` (it flies by itself), ``joint`` (the joints of the arm move it) or
            ``original`` (a soft weld draws the arm, as in Gymnasium-Robotics).

    Raises:
        TaskError: There is no such reward or control.
    """

    reward_type: str = "sparse"
    control: str = "gripper"

    def __post_init__(self) -> None:
        # A zero-argument super() does not work in a dataclass with slots.
        DynamicsSettings.__post_init__(self)
        check_name("reward_type", str(self.reward_type), REWARDS)
        check_name("control", str(self.control), CONTROLS)
