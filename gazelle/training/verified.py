"""What recipes were found to reach, so that nobody has to train to know.

Every task of Gazelle's stands in `VERIFIED`, or in `UNVERIFIED` with one line that says why not; what
other algorithms than the recipe's were found to reach stands in `VERIFIED_WITH`.
`gazelle tasks` shows both, `gazelle bench recipes --tasks TASK` measures a figure again, and a slow
test in ``tests/training/test_verified.py`` trains each once and holds it against these figures.
"""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.training.statistics import SuccessRate


@dataclass(frozen=True, slots=True, kw_only=True)
class WallTime:
    """How long a training took on a clock, and beside what else."""

    seconds: float
    """From the call of `gazelle.training.train` to its result [s]."""
    processors: int
    """How many it could run on."""
    others: float
    """How many of them other programs kept busy meanwhile, on average."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Verified:
    """What the recipe of a task was found to reach, on held-out starts and goals."""

    success: dict[str, SuccessRate]
    """Goals reached of those tried, one an episode, by the engine of the evaluation."""
    seeds: int
    """How many trainings they are of, with seeds from 0."""
    seconds: float
    """Processor time of one training [s]. It never waits for anything, so this is also the most
    that it takes in wall time where nothing else uses the processor."""
    wall: WallTime | None = None
    """Wall time of one training; None where it was not measured."""


VERIFIED: dict[str, Verified] = {
    "ABBIRB120Reach": Verified(success={"mujoco": SuccessRate(293, 300)}, seeds=1, seconds=77),
    "ABBIRB140Reach": Verified(
        success={"mujoco": SuccessRate(1000, 1000, effective=839)}, seeds=1, seconds=70
    ),
    "ABBIRB140VelocityReach": Verified(
        success={"mujoco": SuccessRate(140, 300)}, seeds=1, seconds=42
    ),
    "UR5Reach": Verified(success={"mujoco": SuccessRate(996, 1000)}, seeds=1, seconds=79),
    "AGVFleet": Verified(
        success={"planar": SuccessRate(5273, 5667, effective=1599)}, seeds=3, seconds=95
    ),
    "CartPoleStayUp": Verified(success={"mujoco": SuccessRate(256, 256)}, seeds=2, seconds=22),
    "TurtleBot3CameraWorld": Verified(
        success={"planar": SuccessRate(480, 512), "mujoco": SuccessRate(236, 256)},
        seeds=2,
        seconds=70,
    ),
    "Husarion": Verified(success={"planar": SuccessRate(195, 200)}, seeds=1, seconds=18),
    "KobukiDynamic1": Verified(success={"planar": SuccessRate(199, 200)}, seeds=1, seconds=16),
    "KobukiDynamic2": Verified(success={"planar": SuccessRate(199, 200)}, seeds=1, seconds=15),
    "KobukiDynamic3": Verified(success={"planar": SuccessRate(200, 200)}, seeds=1, seconds=17),
    "KobukiMaze": Verified(
        success={"planar": SuccessRate(400, 400)},
        seeds=2,
        seconds=22,
        wall=WallTime(seconds=54, processors=2, others=1.6),
    ),
    "KobukiEmpty": Verified(success={"planar": SuccessRate(200, 200)}, seeds=1, seconds=11),
    "MovingCubeOneDiskWalk": Verified(
        success={"mujoco": SuccessRate(174, 300)}, seeds=1, seconds=39
    ),
    "ParrotDroneGoto": Verified(success={"mujoco": SuccessRate(571, 600)}, seeds=2, seconds=82),
    "WamvBuoys": Verified(success={"mujoco": SuccessRate(291, 300)}, seeds=1, seconds=110),
    "SummitXLRoom": Verified(success={"planar": SuccessRate(977, 1000)}, seeds=1, seconds=32),
    "TurtleBot2Maze": Verified(success={"planar": SuccessRate(503, 600)}, seeds=2, seconds=17),
    "TurtleBot2Wall": Verified(success={"planar": SuccessRate(968, 1000)}, seeds=1, seconds=55),
    "TurtleBot3World": Verified(success={"planar": SuccessRate(187, 200)}, seeds=1, seconds=21),
    "FetchPush": Verified(success={"mujoco": SuccessRate(298, 300)}, seeds=3, seconds=172),
    "FetchPickAndPlace": Verified(success={"mujoco": SuccessRate(293, 300)}, seeds=3, seconds=110),
    "FetchReach": Verified(success={"mujoco": SuccessRate(300, 300)}, seeds=3, seconds=11),
    "FetchReachDense": Verified(success={"mujoco": SuccessRate(100, 100)}, seeds=1, seconds=16),
    "FetchSlide": Verified(success={"mujoco": SuccessRate(296, 300)}, seeds=3, seconds=186),
    "TurtleBot3Stage1": Verified(
        success={"planar": SuccessRate(3000, 3000), "mujoco": SuccessRate(3000, 3000)},
        seeds=3,
        seconds=7,
        wall=WallTime(seconds=6, processors=2, others=0.0),
    ),
    "TurtleBot3Stage2": Verified(
        success={"planar": SuccessRate(2999, 3000), "mujoco": SuccessRate(3000, 3000)},
        seeds=3,
        seconds=11,
        wall=WallTime(seconds=10, processors=2, others=0.0),
    ),
    "TurtleBot3Stage3": Verified(
        success={"planar": SuccessRate(2957, 3000), "mujoco": SuccessRate(2948, 3000)},
        seeds=3,
        seconds=11,
        wall=WallTime(seconds=11, processors=2, others=0.0),
    ),
    "TurtleBot3Stage4": Verified(
        success={"planar": SuccessRate(2897, 3000), "mujoco": SuccessRate(2875, 3000)},
        seeds=3,
        seconds=61,
        wall=WallTime(seconds=58, processors=2, others=0.0),
    ),
    "TurtleBot3Stage1Continuous": Verified(
        success={"planar": SuccessRate(1000, 1000)}, seeds=1, seconds=11
    ),
    "TurtleBot3Stage2Continuous": Verified(
        success={"planar": SuccessRate(998, 1000)}, seeds=1, seconds=21
    ),
    "TurtleBot3Stage3Continuous": Verified(
        success={"planar": SuccessRate(987, 1000)}, seeds=1, seconds=21
    ),
    "TurtleBot3Stage4Continuous": Verified(
        success={"planar": SuccessRate(951, 1000)}, seeds=1, seconds=41
    ),
}
"""By the task's name, for the recipe that `recipe_for` gives: of ``gazelle train TASK``."""

VERIFIED_WITH: dict[tuple[str, str], Verified] = {
    ("TurtleBot3Stage1", "dqn"): Verified(
        success={"planar": SuccessRate(499, 500)}, seeds=1, seconds=86
    ),
    ("TurtleBot3Stage1Continuous", "td3"): Verified(
        success={"planar": SuccessRate(998, 1000)}, seeds=1, seconds=72
    ),
    ("TurtleBot3Stage1Continuous", "ddpg"): Verified(
        success={"planar": SuccessRate(1000, 1000)}, seeds=1, seconds=89
    ),
    ("TurtleBot3Stage1Continuous", "sac"): Verified(
        success={"planar": SuccessRate(1000, 1000)}, seeds=1, seconds=155
    ),
    ("TurtleBot3Stage4", "dqn"): Verified(
        success={"planar": SuccessRate(842, 1000)}, seeds=1, seconds=136
    ),
    ("TurtleBot3Stage4Continuous", "td3"): Verified(
        success={"planar": SuccessRate(900, 1000)}, seeds=1, seconds=108
    ),
    ("TurtleBot3Stage4Continuous", "ddpg"): Verified(
        success={"planar": SuccessRate(1819, 2000), "mujoco": SuccessRate(266, 300)},
        seeds=1,
        seconds=104,
    ),
    ("TurtleBot3Stage4Continuous", "sac"): Verified(
        success={"planar": SuccessRate(1837, 2000), "mujoco": SuccessRate(276, 300)},
        seeds=1,
        seconds=134,
    ),
}
"""By the task's name and an algorithm: for ``gazelle train TASK --algo NAME``."""

_DENSE = "{task}'s recipe, which was not tried with a reward at every step"
UNVERIFIED: dict[str, str] = {
    "FetchPickAndPlaceDense": _DENSE.format(task="FetchPickAndPlace"),
    "FetchPushDense": _DENSE.format(task="FetchPush"),
    "FetchSlideDense": _DENSE.format(task="FetchSlide"),
    "HopperStayUp": "cannot be done: sideways only the light base acts; 1.35 s in a search, 50 wanted",
}
"""Why a task has no figure, by its name: one line each."""
