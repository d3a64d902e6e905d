"""Classes of MoveIt's C++ modules: what its Python package stands on, as programs import it too."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar

from gazelle.drop_in.moveit_client.session import LOG, packed, unpacked
from gazelle.drop_in.moveit_commander.exception import MoveItCommanderException
from gazelle.errors import did_you_mean
from gazelle_ros.messages import DeserializationError, Message, load_message


class ByteInterface:
    """The methods of a class of ``moveit_commander``, with requests and responses as bytes.

    Subclasses fill the class attributes; arguments are those of the other class.

    Attributes:
        client: The other class.
        takes: Kinds of the messages that methods take, by the methods' names: one for all arguments,
            or one for each.
        names: Names of methods there, where they differ.
    """

    client: ClassVar[type[Any]]
    takes: ClassVar[Mapping[str, Sequence[str]]] = {}
    names: ClassVar[Mapping[str, str]] = {}

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        self._client = self.client(*args, **kwargs)

    def __getattr__(self, name: str) -> Callable[..., Any]:
        """Return a method.

        Raises:
            AttributeError: There is none of that name.
        """
        method = getattr(self.client, self.names.get(name, name), None)
        if name.startswith("_") or not callable(method):
            known = [each for each in (*self.names, *dir(self.client)) if not each.startswith("_")]
            owner = type(self).__name__
            hint = did_you_mean(name, known)
            raise AttributeError(f"{owner} has no method {name!r}; {hint}", name=name, obj=self)
        kinds = self.takes.get(name, ("",))

        @functools.wraps(method)
        def call(*args: Any, **kwargs: Any) -> Any:
            lasting = itertools.chain(kinds, itertools.repeat(kinds[-1]))
            given = [_read(kind, each) for kind, each in zip(lasting, args, strict=False)]
            named = {key: _read(kinds[-1], each) for key, each in kwargs.items()}
            try:
                return _written(method(self._client, *given, **named))
            except DeserializationError:  # a state without joints
                return b""
            except MoveItCommanderException as error:
                LOG.error("%s: %s", name, error)
                return False

        return call


def _read(kind: str, value: Any) -> Any:
    """Return messages of bytes, also in a list; all else as it is."""
    if isinstance(value, bytes):
        return unpacked(load_message(kind), value)
    if isinstance(value, list | tuple):
        return [_read(kind, each) for each in value]
    return value


def _written(value: Any) -> Any:
    """Return messages as bytes, also in a tuple or a mapping; all else as it is."""
    if isinstance(value, Message):
        return packed(value)
    if isinstance(value, tuple):
        return tuple(_written(each) for each in value)
    if isinstance(value, dict):
        return {name: _written(each) for name, each in value.items()}
    return value
