"""What goes wrong in gym: Gymnasium's classes, and those that it no longer has."""

from __future__ import annotations

from gymnasium.error import (
    AlreadyPendingCallError,
    ClosedEnvironmentError,
    CustomSpaceError,
    DependencyNotInstalled,
    DeprecatedEnv,
    Error,
    InvalidAction,
    MissingArgument,
    NameNotFound,
    NamespaceNotFound,
    NoAsyncCallError,
    ResetNeeded,
    UnregisteredEnv,
    VersionNotFound,
)

__all__ = [
    "AlreadyPendingCallError",
    "ClosedEnvironmentError",
    "CustomSpaceError",
    "DependencyNotInstalled",
    "DeprecatedEnv",
    "DoubleWrapperError",
    "Error",
    "InvalidAction",
    "MissingArgument",
    "NameNotFound",
    "NamespaceNotFound",
    "NoAsyncCallError",
    "ResetNeeded",
    "UnregisteredEnv",
    "VersionNotFound",
]


class DoubleWrapperError(Error):
    """An environment is wrapped twice in what may be there once."""
