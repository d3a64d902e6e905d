"""What recipes were found to reach, so that nobody has to train to know.

`gazelle bench recipes` measures it again for the TurtleBot3 stages, and a slow test in
``tests/training/test_verified.py`` trains each once and holds it against these figures.
"""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.training.statistics import SuccessRate


@dataclass(frozen=True, slots=True, kw_only=True)
class Verified:
    """What the recipe of a task was found to reach, on held-out starts and goals."""

    success: dict[str, SuccessRate]
    """Goals reached of those tried, one an episode, by the engine of the evaluation."""
    seeds: int
    """How many trainings they are of, with seeds from 0."""
    seconds: float
    """Processor time of one training [s]; on two cores that nothing else uses it takes less."""


VERIFIED: dict[str, Verified] = {
    "AGVFleet": Verified(success={"planar": SuccessRate(738, 793)}, seeds=1, seconds=40),
    "CartPoleStayUp": Verified(success={"mujoco": SuccessRate(256, 256)}, seeds=2, seconds=22),
    "TurtleBot3CameraWorld": Verified(
        success={"planar": SuccessRate(480, 512), "mujoco": SuccessRate(236, 256)},
        seeds=2,
        seconds=70,
    ),
    "Husarion": Verified(success={"planar": SuccessRate(180, 200)}, seeds=1, seconds=18),
    "KobukiDynamic1": Verified(success={"planar": SuccessRate(199, 200)}, seeds=1, seconds=16),
    "KobukiDynamic2": Verified(success={"planar": SuccessRate(199, 200)}, seeds=1, seconds=15),
    "KobukiDynamic3": Verified(success={"planar": SuccessRate(200, 200)}, seeds=1, seconds=17),
    "KobukiEmpty": Verified(success={"planar": SuccessRate(200, 200)}, seeds=1, seconds=11),
    "TurtleBot2Maze": Verified(success={"planar": SuccessRate(166, 200)}, seeds=1, seconds=17),
    "TurtleBot3World": Verified(success={"planar": SuccessRate(187, 200)}, seeds=1, seconds=21),
    "FetchPush": Verified(success={"mujoco": SuccessRate(298, 300)}, seeds=3, seconds=172),
    "FetchPickAndPlace": Verified(success={"mujoco": SuccessRate(293, 300)}, seeds=3, seconds=110),
    "FetchReach": Verified(success={"mujoco": SuccessRate(300, 300)}, seeds=3, seconds=11),
    "FetchSlide": Verified(success={"mujoco": SuccessRate(296, 300)}, seeds=3, seconds=186),
    "TurtleBot3Stage1": Verified(
        success={"planar": SuccessRate(2000, 2000), "mujoco": SuccessRate(300, 300)},
        seeds=2,
        seconds=10,
    ),
    "TurtleBot3Stage2": Verified(
        success={"planar": SuccessRate(1998, 2000), "mujoco": SuccessRate(299, 300)},
        seeds=2,
        seconds=18,
    ),
    "TurtleBot3Stage3": Verified(
        success={"planar": SuccessRate(1970, 2000), "mujoco": SuccessRate(971, 1000)},
        seeds=2,
        seconds=18,
    ),
    "TurtleBot3Stage4": Verified(
        success={"planar": SuccessRate(5724, 6000), "mujoco": SuccessRate(279, 300)},
        seeds=3,
        seconds=32,
    ),
}
"""By the task's name, for the recipe that `recipe_for` gives."""
