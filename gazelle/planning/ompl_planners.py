"""Plans by OMPL (ompl.kavrakilab.org), where its package is installed."""

from __future__ import annotations

import importlib
import importlib.util
import threading
import time
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.errors import MissingExtraError
from gazelle.planning.planner_names import BOUND
from gazelle.planning.state_validity import StateValidity

_SEEDING = threading.Lock()
"""OMPL's generators are seeded from one number for the whole process."""


def is_installed() -> bool:
    """Return whether the package ``ompl`` is installed."""
    return importlib.util.find_spec("ompl") is not None


def plan_with_ompl(
    start: Floats,
    goals: Floats,
    validity: StateValidity,
    planner: str,
    *,
    seed: int,
    until: float,
    edge: float = 0.0,
) -> Floats | None:
    """Return a path from a start to one of some goals.

    Args:
        start: Valid positions, shape (n,).
        goals: Valid positions, shape (k, n); endless joints in the shorter direction from the start.
        validity: Check of states and motions.
        planner: A key of ``BOUND``.
        seed: The same one gives the same path, unless the planner continues until time is up.
        until: Deadline, on ``time.monotonic``'s clock [s].
        edge: Longest edge of a tree; as the planner likes if zero.

    Returns:
        Positions on the path, shape (m, n); None if none was found.

    Raises:
        MissingExtraError: OMPL is not installed.
    """
    if not is_installed():
        raise MissingExtraError("ompl", "planning")
    base, geometric, util = (
        importlib.import_module(f"ompl.{n}") for n in ("base", "geometric", "util")
    )
    util.setLogLevel(util.LogLevel.LOG_NONE)
    space = _space(base, start, goals, validity)
    information = base.SpaceInformation(space)
    size = len(start)

    def valid(state: Any) -> bool:
        return validity(np.array([state[i] for i in range(size)]))

    information.setStateValidityChecker(valid)
    problem = base.ProblemDefinition(information)
    problem.addStartState(_state(space, start))
    goal_states = base.GoalStates(information)
    for goal in goals:
        goal_states.addState(_state(space, goal))
    problem.setGoal(goal_states)
    with _SEEDING:
        util.RNG.setSeed(seed + 1)  # zero would be a number drawn from the clock
        information.setup()
        solver = getattr(geometric, BOUND[planner])(information)
        if edge and hasattr(solver, "setRange"):
            solver.setRange(edge)
        solver.setProblemDefinition(problem)
        solver.setup()
        solver.solve(max(0.0, until - time.monotonic()))
    if not problem.hasExactSolution():
        return None
    states = problem.getSolutionPath().getStates()
    return np.array([[state[i] for i in range(size)] for state in states])


def _space(base: Any, start: Floats, goals: Floats, validity: StateValidity) -> Any:
    """Return positions between the limits.

    Of continuous joints those within half a turn of the query.
    """
    group = validity.group
    around = np.concatenate((start[None], goals))
    low = np.where(np.isfinite(group.lower), group.lower, around.min(axis=0) - np.pi)
    high = np.where(np.isfinite(group.upper), group.upper, around.max(axis=0) + np.pi)
    bounds = base.RealVectorBounds(len(start))
    for index, (lower, upper) in enumerate(zip(low.tolist(), high.tolist(), strict=True)):
        bounds.setLow(index, lower)
        bounds.setHigh(index, upper)
    space = base.RealVectorStateSpace(len(start))
    space.setBounds(bounds)
    extent = float(np.linalg.norm(high - low))
    space.setLongestValidSegmentFraction(validity.resolution / extent)
    return space


def _state(space: Any, values: Floats) -> Any:
    made = space.allocState()
    for index, value in enumerate(values.tolist()):
        made[index] = value
    return made
