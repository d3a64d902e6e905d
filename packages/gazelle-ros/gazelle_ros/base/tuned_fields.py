"""Values that dynamic_reconfigure changes, with their limits, and dataclasses of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any


def tunable(default: Any, least: Any = "", most: Any = "", description: str = "") -> Any:
    """Return a field of a dataclass that dynamic_reconfigure may change.

    Args:
        default: Its type is that of all values: bool, int, str or float.
        least: Smallest value, of a number.
        most: Largest value, of a number.
        description: For people; the field's name in words if there is none.
    """
    if isinstance(default, bool):
        least, most = False, True
    return field(default=default, metadata={"tuned": (least, most, description)})


@dataclass(frozen=True, slots=True)
class Tunable:
    """A number, flag or text that can be changed while its owner runs.

    Attributes:
        name: Its name.
        default: Its type is that of all values: bool, int, str or float.
        least: Smallest value.
        most: Largest value.
        description: For people.
    """

    name: str
    default: Any
    least: Any
    most: Any
    description: str

    def clamp(self, value: Any) -> Any:
        """Return the nearest allowed value."""
        kind = type(self.default)
        return kind(value if kind in (bool, str) else min(max(value, self.least), self.most))


def tuned_fields(settings: Any) -> Mapping[str, Tunable]:
    """Return the fields of a dataclass that are `tunable`, by name."""
    found = {}
    for each in fields(settings):
        if "tuned" in each.metadata:
            least, most, description = each.metadata["tuned"]
            text = description or each.name.replace("_", " ")
            found[each.name] = Tunable(each.name, each.default, least, most, text)
    return found
