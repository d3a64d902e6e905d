"""The figures of Gymnasium-Robotics' Fetch tasks, version 4."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.errors import TaskError, did_you_mean

CONTROL_PERIOD = 0.04  # [s]
LARGEST_STEP = 0.05  # that an action adds to where the gripper is wanted [m]
NEAR = 0.05  # from the goal, where it is reached [m]
CLEAR = 0.1  # between gripper and object at the start, seen from above [m]
IN_THE_AIR = 0.45  # of goals above the table, at most [m]

SHARE = 0.66
"""Of the way to where it is wanted that the gripper goes in a step: measured, see `FetchEnv`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FetchFigures:
    """Parameters of one of the tasks; lengths in metres, positions in the world frame.

    Attributes:
        world: The bundled world.
        base: Position of the robot (x, y).
        gripper: Start of the gripper (x, y, z).
        has_object: Whether there is something to move, at which goals are meant.
        fingers_move: Whether the fourth entry of actions moves the fingers.
        in_the_air: Whether half of the goals are above the table.
        object_range: Largest initial distance of the object from the gripper along x and y.
        goal_range: Largest distance of goals from the gripper's start, along each axis.
        goal_ahead: By how much goals are further along x.
        object_height: Of the object's centre, at rest on the table.
    """

    world: str
    base: tuple[float, float] = (0.6919, 0.7441)
    gripper: tuple[float, float, float]
    has_object: bool = True
    fingers_move: bool = False
    in_the_air: bool = False
    object_range: float = 0.15
    goal_range: float = 0.15
    goal_ahead: float = 0.0
    object_height: float = 0.425


_RAISED = (1.3419, 0.7491, 0.5347)
FIGURES = {
    "Reach": FetchFigures(world="fetch_table", gripper=_RAISED, has_object=False),
    "Push": FetchFigures(world="fetch_cube", gripper=(1.3455, 0.7491, 0.4136)),
    "Slide": FetchFigures(
        world="fetch_puck",
        base=(0.3369, 0.7441),
        gripper=(0.9927, 0.7491, 0.4127),
        object_range=0.1,
        goal_range=0.3,
        goal_ahead=0.4,
        object_height=0.42,
    ),
    "PickAndPlace": FetchFigures(
        world="fetch_cube", gripper=_RAISED, fingers_move=True, in_the_air=True
    ),
}
"""By the name of the task."""


def figures_of(task: str) -> FetchFigures:
    """Return the figures of a task.

    Raises:
        TaskError: There is no such task.
    """
    if task not in FIGURES:
        raise TaskError(f"there is no task '{task}' of Fetch", hint=did_you_mean(task, FIGURES))
    return FIGURES[task]
