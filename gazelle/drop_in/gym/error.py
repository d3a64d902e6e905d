"""Errors of gym: Gymnasium's classes, and those that it no longer has."""

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
    UnsupportedMode,
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
    "InvalidFrame",
    "MissingArgument",
    "NameNotFound",
    "NamespaceNotFound",
    "NoAsyncCallError",
    "ResetNeeded",
    "ResetNotAllowed",
    "RetriesExceededError",
    "Unregistered",
    "UnregisteredEnv",
    "UnseedableEnv",
    "UnsupportedMode",
    "VersionNotFound",
    "WrapAfterConfigureError",
]

Unregistered = UnregisteredEnv


class DoubleWrapperError(Error):
    """An environment is wrapped twice in what may be there once."""


class InvalidFrame(Error):  # noqa: N818  # gym's name
    """A picture of another shape than a video has."""


class ResetNotAllowed(Error):  # noqa: N818  # gym's name
    """An episode begins before the last one ended."""


class RetriesExceededError(Error):
    """Something failed once too often."""


class UnseedableEnv(Error):  # noqa: N818  # gym's name
    """An environment takes no seed."""


class WrapAfterConfigureError(Error):
    """An environment is wrapped after it was configured."""
