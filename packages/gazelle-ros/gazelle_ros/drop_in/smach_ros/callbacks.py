"""Functions of users that make a goal or request of userdata, and take results apart."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from gazelle_ros.drop_in.smach import InvalidStateError, Remapper, State
from gazelle_ros.drop_in.smach.state import add_interface
from gazelle_ros.messages import Message


@dataclass
class UserCallback:
    """A function with what it is called with, beside the values of the state.

    Attributes:
        function: The function; None for none.
        args: For it, behind the values.
        kwargs: For it.
    """

    function: Any
    args: Sequence[Any] = ()
    kwargs: Mapping[str, Any] = field(default_factory=dict)

    def add_to(self, state: State, inputs: Iterable[str], outputs: Iterable[str]) -> None:
        """Add the outcomes and userdata of the function to a state.

        Args:
            state: The state.
            inputs: Userdata that it reads, where it declares nothing.
            outputs: Userdata that it writes, where it declares nothing.

        Raises:
            InvalidStateError: It is no function.
        """
        if self.function is not None and not callable(self.function):
            raise InvalidStateError(f"{self.function!r} is no function")
        self._inputs, self._outputs = tuple(inputs), tuple(outputs)
        if add_interface(state, self.function):
            self._inputs = self.function.get_registered_input_keys()
            self._outputs = self.function.get_registered_output_keys()

    def __call__(self, ud: Any, *values: Any) -> Any:
        """Call the function with its view of the userdata; None without a function."""
        if self.function is None:
            return None
        view = Remapper(ud, self._inputs, self._outputs)
        return self.function(view, *values, *self.args, **self.kwargs)


def filled(message: Message, ud: Any, key: str | None, slots: Iterable[str]) -> Any:
    """Return a message with what userdata has for it.

    Args:
        message: To fill.
        ud: The userdata.
        key: The whole message, which takes the place of ``message``.
        slots: Fields of the message, which are userdata of the same names.

    Raises:
        KeyError: There is no such userdata.
    """
    if key is not None:
        message = ud[key]
    for slot in slots:
        setattr(message, slot, ud[slot])
    return message


def taken_apart(message: Message, ud: Any, key: str | None, slots: Iterable[str]) -> None:
    """Store a message and its fields in userdata; see `filled`."""
    if key is not None:
        ud[key] = message
    if message is not None:
        for slot in slots:
            ud[slot] = getattr(message, slot)
