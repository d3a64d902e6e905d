"""The errors Gazelle raises: one root, one subclass a package."""

from __future__ import annotations

from gazelle_ros.base.errors import (
    Error,
    FilePlace,
    FormatError,
    FormatWarning,
    GazelleWarning,
    MissingExtraError,
    ResolveError,
    RosError,
    closest_of,
    describe,
    did_you_mean,
    few,
    located,
)

__all__ = [
    "ControlError",
    "ControlWarning",
    "EngineError",
    "EngineWarning",
    "Error",
    "FilePlace",
    "FormatError",
    "FormatWarning",
    "GazelleWarning",
    "MissingExtraError",
    "PlanningError",
    "PlanningWarning",
    "PluginWarning",
    "ResolveError",
    "RosError",
    "SimulationError",
    "SimulationWarning",
    "TaskError",
    "TaskWarning",
    "UnknownNameError",
    "closest_of",
    "describe",
    "did_you_mean",
    "few",
    "located",
]


class EngineError(Error):
    """A description cannot be simulated, or its simulation diverged."""


class SimulationError(Error):
    """A request to a running simulation cannot be met."""


class UnknownNameError(SimulationError, KeyError):
    """A table of a running simulation has nothing of that name."""

    __str__ = Exception.__str__


class ControlError(Error):
    """A controller is misconfigured or misused."""


class PlanningError(Error):
    """No plan, and why."""


class TaskError(Error):
    """A learning task is misconfigured."""


class EngineWarning(GazelleWarning):
    """The engine cannot do what the description says in every detail."""


class SimulationWarning(GazelleWarning):
    """A plugin, sensor or request is ignored or done differently."""


class ControlWarning(GazelleWarning):
    """A controller, or something it was commanded, is ignored or done differently."""


class PlanningWarning(GazelleWarning):
    """A planner, or something it was given, is replaced or ignored."""


class TaskWarning(GazelleWarning):
    """A task or its training is valid, but not done as written."""


class PluginWarning(SimulationWarning):
    """A plugin failed; the simulation continues without it."""
