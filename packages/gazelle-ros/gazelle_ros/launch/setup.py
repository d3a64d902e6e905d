"""Put the parameters of a plan on the master."""

from __future__ import annotations

from gazelle_ros.base.writing import write_text
from gazelle_ros.errors import ApiError, MarshalError
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.packages import Packages
from gazelle_ros.launch.plan import Action, LaunchParameter, LaunchPlan
from gazelle_ros.launch.programs import parameter_value
from gazelle_ros.master.proxy import MasterProxy


def prepare(plan: LaunchPlan, master: MasterProxy, packages: Packages) -> None:
    """Dump, delete, clear and set parameters, in this order.

    Raises:
        LaunchError: A value cannot be had or set; parameters are only set if all could be had.
    """
    values = [(each, parameter_value(each, packages)) for each in plan.parameters.values()]
    for action in plan.actions:
        _act(action, master)
    for namespace in plan.clear:
        if master.has_param(namespace):
            master.delete_param(namespace)
    for parameter, value in values:
        _set(parameter, value, master)


def _set(parameter: LaunchParameter, value: object, master: MasterProxy) -> None:
    if value is None:
        raise _error(parameter, f"the parameter {parameter.name} has no value")
    try:
        master.set_param(parameter.name, value)
    except (ApiError, MarshalError) as error:
        raise _error(parameter, f"the parameter {parameter.name} cannot be set: {error}") from None


def _act(action: Action, master: MasterProxy) -> None:
    if action.command == "delete":
        if master.has_param(action.name):
            master.delete_param(action.name)
        return
    import yaml

    try:
        value = master.get_param(action.name)
    except ApiError:
        value = {}
    text = yaml.safe_dump(value, allow_unicode=True)
    try:
        write_text(action.file or "", text)
    except OSError as error:
        raise _error(action, f"'{action.file}' cannot be written: {error.strerror}") from None


def _error(what: LaunchParameter | Action, message: str) -> LaunchError:
    return LaunchError(message, source=what.place)
