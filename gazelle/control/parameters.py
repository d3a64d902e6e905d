"""Parameters of a controller: a plain nested mapping, read with clear errors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from gazelle.argument_checks import checked
from gazelle.errors import ControlError, did_you_mean
from gazelle_ros.base.real_numbers import real


class UnknownParameterError(ControlError, KeyError):
    """A controller has no parameter of that path."""

    __str__ = Exception.__str__


class ControllerParameters(Mapping[str, Any]):
    """Parameters of a controller from YAML, or a part of them; paths are separated by ``/``.

    Args:
        values: Nested mappings of plain values.
        place: Place of the parameters, for messages.
    """

    def __init__(self, values: Mapping[str, Any], place: str) -> None:
        self._values, self.place = values, place

    def __getitem__(self, path: str) -> Any:
        """Return a value.

        Raises:
            UnknownParameterError: There is none.
        """
        found: Any = self._values
        for name in path.strip("/").split("/"):
            if not isinstance(found, Mapping) or name not in found:
                raise UnknownParameterError(f"there is no parameter '{self.place}/{path}'")
            found = found[name]
        return found

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def part(self, path: str) -> ControllerParameters:
        """Return the parameters below a name; empty if there are none.

        Raises:
            ControlError: It is a value.
        """
        found = self.get(path, {})
        if not isinstance(found, Mapping):
            raise self.wrong(path, "a namespace", found)
        return ControllerParameters(found, f"{self.place}/{path}")

    @checked(ControlError)
    def number(self, path: str, default: float | None = None) -> float:
        """Return an int or a float.

        Raises:
            ControlError: It is something else, or missing without a default.
        """
        found = self._find(path, default)
        number = real(found)
        if number is None:
            raise self.wrong(path, "a number", found)
        return number

    def flag(self, path: str, *, default: bool | None = None) -> bool:
        """Return a bool.

        Raises:
            ControlError: As ``number``.
        """
        found = self._find(path, default)
        if not isinstance(found, bool):
            raise self.wrong(path, "true or false", found)
        return found

    def text(self, path: str, default: str | None = None) -> str:
        """Return a str.

        Raises:
            ControlError: As ``number``.
        """
        found = self._find(path, default)
        if not isinstance(found, str):
            raise self.wrong(path, "a string", found)
        return found

    def names(self, path: str, default: str | tuple[str, ...] | None = None) -> tuple[str, ...]:
        """Return one name or a list of names, at least one.

        Raises:
            ControlError: As ``number``, or the list is empty.
        """
        found = self._find(path, default)
        listed = [found] if isinstance(found, str) else found
        if not isinstance(listed, list | tuple) or not all(isinstance(n, str) for n in listed):
            raise self.wrong(path, "a string or a list of strings", found)
        if not listed:
            raise ControlError(f"the list in the parameter '{self.place}/{path}' is empty")
        return tuple(listed)

    def wrong(self, path: str, expected: str, value: object) -> ControlError:
        """Return the error for a value of a wrong type."""
        return ControlError(
            f"the parameter '{self.place}/{path}' must be {expected}, not {value!r}"
        )

    def _find(self, path: str, default: Any) -> Any:
        found = self.get(path, default)
        if found is None:
            raise ControlError(
                f"there is no parameter '{self.place}/{path}'",
                hint=did_you_mean(path, [str(name) for name in self._values]),
            )
        return found
