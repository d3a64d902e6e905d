"""rosservice's interface: services of the graph."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle_ros.compat import commands
from gazelle_ros.compat.rospy.exceptions import ServiceException
from gazelle_ros.compat.rospy.guest import user
from gazelle_ros.compat.rospy.service import ServiceProxy
from gazelle_ros.compat.tool_errors import raising
from gazelle_ros.errors import MasterUnreachableError, RosError
from gazelle_ros.messages import load_service
from gazelle_ros.messages.yaml import fill_message_args
from gazelle_ros.msgs import std_msgs
from gazelle_ros.time import Time
from gazelle_ros.tools import services
from gazelle_ros.tools.graph import GraphInspector


class ROSServiceException(Exception):  # noqa: N818  # rosservice's names
    """Root of the errors about services."""


class ROSServiceIOException(ROSServiceException):
    """The master or the service does not answer."""


def _graph() -> GraphInspector:
    return GraphInspector("rosservice")


@raising(ROSServiceIOException, ROSServiceIOException)
def get_service_list(
    node: str | None = None,
    namespace: str | None = None,
    include_nodes: bool = False,  # noqa: FBT001, FBT002  # rosservice's interface
) -> Any:
    """Return names of the services, of a node or in a namespace; with their nodes on request.

    Raises:
        ROSServiceIOException: The master does not answer.
    """
    found = services.list_services(_graph(), namespace)
    if node is not None:
        found = [each for each in found if node in each[1]]
    if include_nodes:
        return [list(each) for each in found]
    return [name for name, _ in found]


@raising(ROSServiceIOException)
def get_service_type(service_name: str) -> str | None:
    """Return the type of a service; None if there is none."""
    try:
        return services.service_type(_graph(), service_name)
    except MasterUnreachableError:
        raise
    except RosError:
        return None


@raising(ROSServiceIOException, ROSServiceException)
def get_service_class_by_name(service_name: str) -> Any:
    """Return the class of a service's type.

    Raises:
        ROSServiceException: There is no such service, or its type is not known.
    """
    return load_service(services.service_type(_graph(), service_name))


@raising(ROSServiceIOException)
def get_service_node(service_name: str) -> str | None:
    """Return the node that provides a service; None without one."""
    try:
        return services.service_node(_graph(), service_name)
    except MasterUnreachableError:
        raise
    except RosError:
        return None


@raising(ROSServiceIOException)
def get_service_uri(service_name: str) -> str | None:
    """Return the address of a service; None if there is none."""
    return _graph().service_uri(_graph().resolve(service_name))


@raising(ROSServiceIOException, ROSServiceException)
def get_service_args(service_name: str) -> str:
    """Return names of the request's fields.

    Raises:
        ROSServiceException: There is no such service.
    """
    return services.service_arguments(_graph(), service_name).strip()


def has_service_args(service_name: str, service_class: Any = None) -> bool:
    """Return whether a service's request has fields.

    Raises:
        ROSServiceException: There is no such service.
    """
    kind = service_class or get_service_class_by_name(service_name)
    return bool(kind._request_class.__slots__)


@raising(ROSServiceIOException, ROSServiceIOException)
def get_service_headers(service_name: str, service_uri: str) -> dict[str, str]:
    """Return the header of a service's answer to a probe.

    Raises:
        ROSServiceException: It does not answer.
    """
    del service_uri
    return services.probe(_graph(), service_name)


@raising(ROSServiceIOException)
def rosservice_find(service_type: str) -> list[str]:
    """Return services of a type."""
    return services.services_of_type(_graph(), service_type)


def call_service(
    service_name: str, service_args: list[Any], service_class: Any = None
) -> tuple[Any, Any]:
    """Call a service with values as users write them.

    Returns:
        The request and the response.

    Raises:
        ROSServiceException: The values do not fit, or the call failed.
    """
    kind = service_class or get_service_class_by_name(service_name)
    request = kind._request_class()
    clock = getattr(user(), "clock", None)
    now = Time(nsecs=clock.now() if clock is not None else 0)
    keys = {"now": now, "auto": std_msgs.msg.Header(stamp=now)}
    try:
        fill_message_args(request, service_args, keys=keys)
        return request, ServiceProxy(service_name, kind)(request)
    except (RosError, ServiceException, ValueError) as error:
        raise ROSServiceException(str(error)) from None


def rosservicemain(argv: Sequence[str] | None = None) -> None:
    """Run rosservice's command line; see `gazelle_ros.compat.commands.run`.

    Args:
        argv: The command line, by default this process's.

    Raises:
        SystemExit: It failed.
    """
    commands.run("service", argv)
