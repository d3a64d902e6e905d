"""dynamic_reconfigure's interface: parameters that change while a node runs."""

from __future__ import annotations

from typing import Any


class DynamicReconfigureException(Exception):  # noqa: N818  # dynamic_reconfigure's names
    """Root of the errors about changing parameters."""


class DynamicReconfigureParameterException(DynamicReconfigureException):
    """There is no such parameter, or it cannot have the value."""


class DynamicReconfigureCallbackException(DynamicReconfigureException):
    """The node's callback failed."""


def find_reconfigure_services() -> list[str]:
    """Return names of the nodes with changeable parameters."""
    from gazelle_ros.compat.rosservice import rosservice_find

    found = rosservice_find("dynamic_reconfigure/Reconfigure")
    return sorted(each.removesuffix("/set_parameters") for each in found)


def get_parameter_names(descr: Any) -> list[str]:
    """Return names of the parameters in a description's defaults."""
    return [*descr.defaults]
