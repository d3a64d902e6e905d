"""The robot that controllers control, as the parameter server describes it."""

from __future__ import annotations

import warnings

from gazelle.description import Model
from gazelle.errors import ControlWarning, Error
from gazelle_ros import Node

_PARAMETER = "robot_description"


def find_model(node: Node, space: str) -> Model | None:
    """Return the robot of the parameter ``robot_description``: a namespace's, else the root's.

    Args:
        node: The client.
        space: Without a slash at its end.

    Returns:
        The robot; None where there is no description, or none that can be read: that warns.
    """
    for name in dict.fromkeys((f"{space}/{_PARAMETER}", f"/{_PARAMETER}")):
        text = node.get_param(name, None)
        if isinstance(text, str) and text.strip():
            return _read(text, name)
    return None


def _read(text: str, name: str) -> Model | None:
    from gazelle.formats import load_model_string  # a robot of one's own may do without

    try:
        return load_model_string(text, name=name)
    except Error as error:
        warnings.warn(ControlWarning(f"the parameter {name} is not a robot: {error}"), stacklevel=3)
        return None
