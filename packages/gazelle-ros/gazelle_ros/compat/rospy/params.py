"""The parameter server."""

from __future__ import annotations

from typing import Any

from gazelle_ros.compat.rospy.exceptions import ROSException
from gazelle_ros.compat.rospy.guest import user
from gazelle_ros.compat.rospy.names import get_caller_id, resolve_name
from gazelle_ros.errors import (
    MarshalError,
    MasterUnreachableError,
    ParameterNotFoundError,
    RosError,
)
from gazelle_ros.master.proxy import MasterProxy


class _Unspecified:
    """No default was given."""


_unspecified: Any = _Unspecified()


def get_param(param_name: str, default: Any = _unspecified) -> Any:
    """Return the value of a parameter; a namespace is a dict.

    Raises:
        KeyError: It is not set, and no default was given.
        ConnectionRefusedError: There is no master, as with all that asks it.
    """
    return _get(param_name, default, user().parameters.get)


def get_param_cached(param_name: str, default: Any = _unspecified) -> Any:
    """Return the same as `get_param`, with a single request to the master.

    Raises:
        KeyError: It is not set, and no default was given.
    """
    owner = user()
    known = owner.parameters.get_cached if hasattr(owner, "advertise") else owner.parameters.get
    return _get(param_name, default, known)


def _get(param_name: str, default: Any, read: Any) -> Any:
    try:
        return read(resolve_name(param_name))
    except ParameterNotFoundError:
        if default is _unspecified:
            raise KeyError(param_name) from None
        return default
    except MasterUnreachableError:
        raise
    except RosError as error:
        raise ROSException(f"unable to get parameter {param_name}: {error}") from error


def get_param_names() -> list[str]:
    """Return all keys that hold a value."""
    return user().parameters.names()


def set_param(param_name: str, param_value: Any) -> None:
    """Set a parameter or, with a dict, a whole namespace.

    Raises:
        TypeError: XML-RPC cannot carry the value.
        ROSException: The name is empty, or the master refuses.
    """
    if not param_name:
        raise ROSException("parameter name is empty")
    try:
        user().parameters.set(resolve_name(param_name), param_value)
    except MarshalError as error:
        kind = OverflowError if "32" in str(error) else TypeError
        raise kind(str(error)) from None
    except MasterUnreachableError:
        raise
    except RosError as error:
        raise ROSException(f"unable to set parameter {param_name}: {error}") from error


def search_param(param_name: str) -> str | None:
    """Return the name of the nearest parameter of this name, from the node's namespace upwards."""
    proxy = MasterProxy(user().master_uri, get_caller_id())
    try:
        code, _, found = proxy.call_raw("searchParam", param_name)
    finally:
        proxy.close()
    return str(found) if code == 1 and found else None


def delete_param(param_name: str) -> None:
    """Remove a parameter or namespace.

    Raises:
        KeyError: It is not set.
    """
    try:
        user().parameters.delete(resolve_name(param_name))
    except ParameterNotFoundError:
        raise KeyError(param_name) from None


def has_param(param_name: str) -> bool:
    """Return whether a parameter is set."""
    return user().parameters.has(resolve_name(param_name))
