"""Data that states share: a container's, and what one state may see of it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping
from typing import Any

from gazelle_ros.drop_in.smach.exceptions import InvalidUserCodeError
from gazelle_ros.drop_in.smach.log import logerr


class ItemsAsAttributes(ABC):
    """Items that are attributes, too; names with an underscore are attributes alone."""

    @abstractmethod
    def __getitem__(self, key: str) -> Any:
        """Return an item."""

    @abstractmethod
    def __setitem__(self, key: str, item: Any) -> None:
        """Set an item."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return self[name]

    def __setattr__(self, name: str, value: Any) -> None:
        if name.startswith("_"):
            object.__setattr__(self, name, value)
        else:
            self[name] = value


class UserData(ItemsAsAttributes):
    """Values by name, as attributes or as items."""

    def __init__(self) -> None:
        self._data: dict[str, Any] = {}

    def update(self, other_userdata: UserData) -> None:
        """Copy all values of another one."""
        self._data.update(other_userdata._data)

    def keys(self) -> list[str]:
        """Return the names."""
        return list(self._data)

    def __contains__(self, key: str) -> bool:
        return key in self._data

    def __getitem__(self, key: str) -> Any:
        if key not in self._data:
            raise KeyError(f"there is no userdata '{key}'; there are {self.keys()}")
        return self._data[key]

    def __setitem__(self, key: str, item: Any) -> None:
        self._data[key] = item


class Remapper(ItemsAsAttributes):
    """View of a container's data with a state's names, of the keys that the state has declared.

    Args:
        ud: The container's.
        input_keys: Keys that may be read.
        output_keys: Keys that may be written.
        remapping: From a name of the state to one of the container.
    """

    def __init__(
        self,
        ud: Any,
        input_keys: Collection[str] = (),
        output_keys: Collection[str] = (),
        remapping: Mapping[str, str] | None = None,
    ) -> None:
        self._ud, self._input, self._output = ud, input_keys, output_keys
        self._map = dict(remapping or {})

    def update(self, other_userdata: UserData) -> None:
        """Copy all values of another one to the container's data."""
        self._ud.update(other_userdata)

    def keys(self) -> list[str]:
        """Return the names that can be read now."""
        return [key for key in self._input if key in self]

    def __contains__(self, key: str) -> bool:
        return key in self._input and self._map.get(key, key) in self._ud

    def __getitem__(self, key: str) -> Any:
        if key not in self._input:
            raise InvalidUserCodeError(
                f"the state reads userdata '{key}', which is none of its input_keys "
                f"{sorted(self._input)}"
            )
        return self._ud[self._map.get(key, key)]

    def __setitem__(self, key: str, item: Any) -> None:
        if key in self._output:
            self._ud[self._map.get(key, key)] = item
        else:
            logerr(
                f"the state writes userdata '{key}', which is none of its output_keys "
                f"{sorted(self._output)}: it is left out"
            )
