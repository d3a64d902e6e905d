"""Find controller managers on the graph, list their controllers, and choose among them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from gazelle_ros.compat import rosparam, rosservice
from gazelle_ros.compat.rospy.exceptions import ROSException, ServiceException
from gazelle_ros.compat.rospy.service import ServiceProxy
from gazelle_ros.messages import load_service

_PACKAGE = "controller_manager_msgs"
_LIST = "list_controllers"

cm_services = {
    name: f"{_PACKAGE}/{kind}"
    for name, kind in {
        _LIST: "ListControllers",
        "list_controller_types": "ListControllerTypes",
        "load_controller": "LoadController",
        "unload_controller": "UnloadController",
        "switch_controller": "SwitchController",
        "reload_controller_libraries": "ReloadControllerLibraries",
    }.items()
}
"""The services that make a controller manager, with their types."""


def get_controller_managers(
    namespace: str = "/", initial_guess: Sequence[str] | None = None
) -> list[str]:
    """Return the namespaces of the controller managers, sorted.

    Args:
        namespace: Look below this one.
        initial_guess: Topics found before. Of these only one service is looked at, which saves
            questions to the master.
    """
    there = _candidates(namespace)
    known = set(initial_guess or ())
    return sorted(each for each in there if each in known or is_controller_manager(each))


def is_controller_manager(namespace: str) -> bool:
    """Return whether a namespace has all services of a controller manager, of the right types."""
    space = namespace if namespace.endswith("/") else f"{namespace}/"
    return all(
        rosservice.get_service_type(space + name) == kind for name, kind in cm_services.items()
    )


def _candidates(namespace: str) -> list[str]:
    """Return namespaces that list controllers."""
    try:
        services = rosservice.get_service_list(namespace=namespace)
    except rosservice.ROSServiceIOException:
        return []
    ending = f"/{_LIST}"
    found = (name.removesuffix(ending) or "/" for name in services if name.endswith(ending))
    return list(dict.fromkeys(found))


class ControllerManagerLister:
    """Called again and again, returns the present controller managers.

    Args:
        namespace: Look below this one.
    """

    def __init__(self, namespace: str = "/") -> None:
        self._namespace = namespace
        self._known: list[str] = []

    def __call__(self) -> list[str]:
        """Return the namespaces of the controller managers, sorted."""
        self._known = get_controller_managers(self._namespace, self._known)
        return self._known


class ControllerLister:
    """Called again and again, returns a manager's controllers.

    The connection stays open; one that broke is made again.

    Args:
        namespace: Of the manager.
    """

    def __init__(self, namespace: str = "/controller_manager") -> None:
        self._service = f"{namespace}/{_LIST}"
        self._proxy = self._connect()

    def __call__(self) -> list[Any]:
        """Return the ``ControllerState`` of each controller.

        None if the manager does not answer.
        """
        for _ in range(2):
            try:
                return list(self._proxy().controller)
            except (ROSException, ServiceException):
                self._proxy = self._connect()
        return []

    def _connect(self) -> ServiceProxy:
        kind = load_service(cm_services[_LIST])
        return ServiceProxy(self._service, kind, persistent=True)


def filter_by_name(ctrl_list: Iterable[Any], ctrl_name: str, match_substring: bool = False) -> Any:  # noqa: FBT001, FBT002  # the original's interface
    """Return the controllers of a name, or with a text in their name."""
    return _having("name", ctrl_list, ctrl_name, part=match_substring)


def filter_by_type(ctrl_list: Iterable[Any], ctrl_type: str, match_substring: bool = False) -> Any:  # noqa: FBT001, FBT002
    """Return the controllers of a type, or with a text in their type."""
    return _having("type", ctrl_list, ctrl_type, part=match_substring)


def filter_by_state(
    ctrl_list: Iterable[Any],
    ctrl_state: str,
    match_substring: bool = False,  # noqa: FBT001, FBT002
) -> list[Any]:
    """Return the controllers in a state, or with a text in their state."""
    return _having("state", ctrl_list, ctrl_state, part=match_substring)


def _having(attribute: str, controllers: Iterable[Any], text: str, *, part: bool) -> list[Any]:
    fits = _matcher(text, part=part)
    return [each for each in controllers if fits(getattr(each, attribute))]


def _matcher(text: str, *, part: bool) -> Callable[[str], bool]:
    return (lambda value: text in value) if part else (lambda value: text == value)


def filter_by_hardware_interface(
    ctrl_list: Iterable[Any],
    hardware_interface: str,
    match_substring: bool = False,  # noqa: FBT001, FBT002
) -> list[Any]:
    """Return the controllers that claim something in an interface.

    With `match_substring`, a part of its name is enough.
    """
    fits = _matcher(hardware_interface, part=match_substring)
    return [
        each
        for each in ctrl_list
        if any(fits(claim.hardware_interface) for claim in each.claimed_resources)
    ]


def filter_by_resources(
    ctrl_list: Iterable[Any],
    resources: Sequence[str],
    hardware_interface: str | None = None,
    match_any: bool = False,  # noqa: FBT001, FBT002
) -> list[Any]:
    """Return the controllers that claim resources through one interface.

    Args:
        ctrl_list: Among these.
        resources: All of them, unless ``match_any``.
        hardware_interface: Only through this one; through any if None.
        match_any: One of the resources is enough.
    """
    enough = any if match_any else all

    def claimed(claim: Any) -> bool:
        matches = hardware_interface in (None, claim.hardware_interface)
        return matches and enough(each in claim.resources for each in resources)

    return [each for each in ctrl_list if any(map(claimed, each.claimed_resources))]


def get_rosparam_controller_names(namespace: str = "/") -> list[str]:
    """Return names of possible parameters of a controller: namespaces with a value ``type``."""
    space = namespace if namespace.endswith("/") else f"{namespace}/"
    below = (name.partition(space)[2].split("/") for name in rosparam.list_params(namespace))
    return sorted(words[0] for words in below if len(words) == 2 and words[1] == "type")
