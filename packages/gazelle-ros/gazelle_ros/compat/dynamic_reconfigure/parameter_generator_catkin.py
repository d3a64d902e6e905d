"""Describes parameters that can be changed, as ``.cfg`` files do.

http://wiki.ros.org/dynamic_reconfigure/Tutorials/HowToWriteYourFirstCfgFile is the format. What is
generated here is the description in memory that `dynamic_reconfigure.server` takes; nothing is written.
"""

from __future__ import annotations

import itertools
import math
import re
from typing import Any

from gazelle_ros.compat.dynamic_reconfigure import DynamicReconfigureParameterException

__all__ = ["ParameterGenerator", "bool_t", "double_t", "int_t", "str_t"]

str_t, bool_t, int_t, double_t = "str", "bool", "int", "double"
_PYTHON: dict[str, Any] = {str_t: str, bool_t: bool, int_t: int, double_t: float}
_C = {str_t: "std::string", bool_t: "bool", int_t: "int", double_t: "double"}
_LEAST = {str_t: "", bool_t: False, int_t: -(2**31), double_t: -math.inf}
_MOST = {str_t: "", bool_t: True, int_t: 2**31 - 1, double_t: math.inf}
_USUAL = {str_t: "", bool_t: False, int_t: 0, double_t: 0.0}
_NAME = re.compile(r"[a-zA-Z][a-zA-Z0-9_]*")


def _typed(name: str, kind: str, what: str, value: Any) -> Any:
    """Return a value of a parameter's type; ints are doubles, too."""
    python = _PYTHON.get(kind)
    if python is None:
        raise DynamicReconfigureParameterException(f"'{name}' has the unknown type {kind!r}")
    if type(value) is not python and not (python is float and type(value) is int):
        raise TypeError(f"'{name}' has type {kind}, but {what} is {value!r}")
    return python(value)


def _check_description(text: str) -> None:
    if '"' in text or "'" in text:
        raise DynamicReconfigureParameterException(
            f"quotes are not allowed in a description: {text}"
        )


class ParameterGenerator:
    """Collects the parameters of a ``.cfg`` file."""

    def __init__(self) -> None:
        self._numbers = itertools.count(0)
        self.group = Group(self._numbers, "Default", "", state=True, parent=0)
        self.constants: list[dict[str, Any]] = []

    def const(self, name: str, type: str, value: Any, descr: str) -> dict[str, Any]:  # noqa: A002  # the interface
        """Return a named value, for an `enum`.

        Raises:
            TypeError: The value is not of the type.
        """
        _check_description(descr)
        made = {
            "name": name,
            "type": type,
            "value": _typed(name, type, "value", value),
            "description": descr,
            "ctype": _C[type],
            "cconsttype": f"const {'char * const' if type == str_t else _C[type]}",
            "srcline": 0,
            "srcfile": "",
        }
        self.constants.append(made)
        return made

    @staticmethod
    def enum(constants: list[dict[str, Any]], description: str) -> str:
        """Return an edit method that offers constants.

        Raises:
            DynamicReconfigureParameterException: They are of different types.
        """
        if len({each["type"] for each in constants}) != 1:
            raise DynamicReconfigureParameterException("Inconsistent types in enum!")
        _check_description(description)
        return repr({"enum": constants, "enum_description": description})

    def add(self, *values: Any, **keywords: Any) -> None:
        """Add a parameter to the outermost group; see `Group.add`."""
        self.group.add(*values, **keywords)

    def add_group(self, name: str, type: str = "", state: bool = True) -> Group:  # noqa: A002, FBT001, FBT002  # the interface
        """Add a group to the outermost one."""
        return self.group.add_group(name, type, state)

    def generate(self, pkgname: str, nodename: str, name: str) -> int:
        """Return 0 and write nothing.

        The program that runs the ``.cfg`` file takes the description from here.

        Returns:
            0, which ``.cfg`` files give to ``exit``.
        """
        from gazelle_ros.compat.dynamic_reconfigure import generated

        del nodename
        generated.take(pkgname, name, self.group.description(), self.constants)
        return 0


class Group:
    """Parameters that are shown together; made by `ParameterGenerator.add_group`."""

    def __init__(
        self,
        numbers: itertools.count[int],
        name: str,
        kind: str,
        *,
        state: bool,
        parent: int,
        above: tuple[str, ...] = (),
    ) -> None:
        self.name, self.type, self.state, self.parent = name.replace(" ", "_"), kind, state, parent
        self.id = next(numbers)
        self._numbers = numbers
        self._path = (*above, self.name)
        self._parameters: list[dict[str, Any]] = []
        self._groups: list[Group] = []

    def add_group(self, name: str, type: str = "", state: bool = True) -> Group:  # noqa: A002, FBT001, FBT002  # the interface
        """Add a group to this one."""
        made = Group(self._numbers, name, type, state=state, parent=self.id, above=self._path)
        self._groups.append(made)
        return made

    def add(
        self,
        name: str,
        paramtype: str,
        level: int,
        description: str,
        default: Any = None,
        min: Any = None,  # noqa: A002  # the interface
        max: Any = None,  # noqa: A002  # the interface
        edit_method: str = "",
    ) -> None:
        """Add a parameter.

        Args:
            name: Its name.
            paramtype: ``int_t``, ``double_t``, ``str_t`` or ``bool_t``.
            level: Bits for the callback when it is changed.
            description: Description.
            default: Its value by default.
            min: The least value of a number.
            max: The greatest value of a number.
            edit_method: Result of `ParameterGenerator.enum`.

        Raises:
            DynamicReconfigureParameterException: The name is not legal, or limits make no sense.
            TypeError: A value is not of the type.
        """
        if paramtype in {str_t, bool_t} and (min is not None or max is not None):
            raise DynamicReconfigureParameterException(
                f"Max or min specified for {name}, which is of '{paramtype}' type"
            )
        if not _NAME.fullmatch(name):
            raise DynamicReconfigureParameterException(
                f"The name of field '{name}' does not follow the ROS naming conventions"
            )
        values = {"default": (default, _USUAL), "max": (max, _MOST), "min": (min, _LEAST)}
        made = {
            what: table.get(paramtype) if value is None else _typed(name, paramtype, what, value)
            for what, (value, table) in values.items()
        }
        made |= {
            "name": name,
            "type": paramtype,
            "level": level,
            "description": description,
            "edit_method": edit_method,
            "ctype": _C.get(paramtype) or _typed(name, paramtype, "default", default),
            "cconsttype": f"const {'char * const' if paramtype == str_t else _C[paramtype]}",
            "srcline": 0,
            "srcfile": "",
        }
        self._parameters.append(made)

    def description(self) -> dict[str, Any]:
        """Return the group as a generated module has it."""
        state = "true" if self.state else "false"
        classes = [name.upper() for name in self._path]
        return {
            "name": self.name,
            "type": self.type,
            "state": self.state,
            "cstate": state,
            "id": self.id,
            "parent": self.parent,
            "parameters": self._parameters,
            "groups": [group.description() for group in self._groups],
            "srcline": 0,
            "srcfile": "",
            "class": "::".join(classes),
            "parentclass": "::".join(classes[:-1]),
            "parentname": self._path[-2] if len(self._path) > 1 else self.name,
            "field": "::".join([*classes[:-1], self.name.lower()]),
            "upper": self.name.upper(),
            "lower": self.name.lower(),
        }
