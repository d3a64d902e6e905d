"""Values of ROS parameters, checked against the kinds of their defaults."""

from __future__ import annotations

import contextlib
import logging
import math
from collections.abc import Collection, Mapping
from dataclasses import MISSING, Field, fields
from typing import Any, TypeVar

from gazelle_ros.base.errors import Error, RosError, did_you_mean
from gazelle_ros.base.real_numbers import real

Values = Mapping[str, Any]
Settings = TypeVar("Settings")

_LEAST = 1e-9
_LOG = logging.getLogger("gazelle.ros.parameters")


def value_of(values: Values, name: str, default: Any) -> Any:
    """Return a parameter, of the kind of its default.

    Raises:
        Error: It is of another kind.
    """
    found = values.get(name, default)
    kind = type(default)
    number = real(found)
    if kind is float and number is not None:
        return number
    if kind is int and isinstance(found, float) and found.is_integer():
        return int(found)
    if isinstance(found, kind) and not (kind is int and isinstance(found, bool)):
        return found
    raise Error(f"the parameter '{name}' must be of type {kind.__name__}, not {found!r:.60}")


def positive(name: str, value: Any, hint: str | None = None) -> float:
    """Return a number above 0, with an inverse and nanoseconds of an ordinary size.

    Args:
        name: Of the number, for the message.
        value: A number, or its text.
        hint: For the message.

    Raises:
        RosError: It is none.
    """
    number = math.nan
    with contextlib.suppress(TypeError, ValueError, OverflowError):
        number = float(value)
    if not _LEAST <= number <= 1.0 / _LEAST:
        raise RosError(f"{name} must be above 0 (1e-9 to 1e9), not {value!r:.60}", hint=hint)
    return number


def fields_of(kind: type[Any], values: Values, *, without: Collection[str] = ()) -> dict[str, Any]:
    """Return the parameters that a dataclass of settings has, each of the kind of its default.

    Args:
        kind: The dataclass.
        values: The parameters.
        without: Fields that are no such parameters.

    Raises:
        Error: One is of another kind.
    """
    return {
        each.name: value_of(values, each.name, _default_of(each))
        for each in fields(kind)
        if each.init and each.name not in without
    }


def _default_of(each: Field[Any]) -> Any:
    return each.default if each.default_factory is MISSING else each.default_factory()


def settings_from(
    where: str, values: Values, kind: type[Settings], *, others: Collection[str] = ()
) -> Settings:
    """Return a dataclass of some parameters; those that are not set have its defaults.

    Args:
        where: Namespace of the parameters.
        values: The parameters. Those that it does not know are warned of.
        kind: The dataclass; its fields are called as the parameters.
        others: Parameters that are read elsewhere.

    Raises:
        Error: A parameter is of another kind than its default.
    """
    known = [each.name for each in fields(kind)]  # type: ignore[arg-type]  # a dataclass
    warn_of_unknown(where, values, {*known, *others})
    return kind(**fields_of(kind, values))


def warn_of_unknown(where: str, values: Values, known: Collection[str]) -> None:
    """Warn of parameters that are not known; namespaces may belong to another node.

    Args:
        where: Namespace of the parameters.
        values: The parameters.
        known: Names of those known.
    """
    for name, value in values.items():
        if name not in known and not isinstance(value, dict):
            hint = did_you_mean(name, known)
            _LOG.warning("%s/%s is an unknown parameter; %s", where, name, hint)
