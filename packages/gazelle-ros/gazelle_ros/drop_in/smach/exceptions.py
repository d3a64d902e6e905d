"""Errors of state machines."""

from __future__ import annotations


class SmachError(Exception):
    """Fault in a state machine."""


class InvalidTransitionError(SmachError):
    """Outcome that leads nowhere."""


class InvalidStateError(SmachError):
    """State that a container cannot take."""


class InvalidConstructionError(SmachError):
    """Container that is built in the wrong order."""


class InvalidUserCodeError(SmachError):
    """Exception in a state's own code."""
