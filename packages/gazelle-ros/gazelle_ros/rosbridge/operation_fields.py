"""The fields of what a client says."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from gazelle_ros.base.errors import RosError

_MISSING: Any = object()
_NAMES = {str: "string", int: "int", bool: "bool"}


class OperationFields:
    """The fields of a client's message, judged when they are read.

    Args:
        message: The JSON object.
    """

    def __init__(self, message: Mapping[str, Any]) -> None:
        self._message = message

    def get(self, name: str, default: Any = None) -> Any:
        """Return a field of any type, or the default if it is missing or null."""
        value = self._message.get(name)
        return default if value is None else value

    def any(self, name: str) -> Any:
        """Return a field that must be present.

        Raises:
            RosError: It is not.
        """
        if self._message.get(name) is None:
            raise RosError(f"Expected a {name} field but none was found")
        return self._message[name]

    def text(self, name: str, default: str = _MISSING) -> str:
        """Return a string."""
        found: str = self._typed(name, str, default)
        return found

    def integer(self, name: str, default: int = _MISSING) -> int:
        """Return an int."""
        found: int = self._typed(name, int, default)
        return found

    def flag(self, name: str, default: bool = _MISSING) -> bool:  # noqa: FBT001  # as its siblings
        """Return a bool."""
        found: bool = self._typed(name, bool, default)
        return found

    def number(self, name: str, default: float = _MISSING) -> float:
        """Return a number, finite and not below zero."""
        value = self.any(name) if default is _MISSING else self.get(name, default)
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise self._type_error(name, "number", value)
        if not 0 <= value < math.inf:
            raise self._type_error(name, "number not below zero", value)
        return float(value)

    def _typed(self, name: str, kind: type, default: Any) -> Any:
        value = self.any(name) if default is _MISSING else self.get(name, default)
        if type(value) is not kind:
            raise self._type_error(name, _NAMES[kind], value)
        return value

    @staticmethod
    def _type_error(name: str, expected: str, value: Any) -> RosError:
        return RosError(
            f"Expected field {name} to be a {expected}, but got a {type(value).__name__}: "
            f"{str(value)[:60]}"
        )
