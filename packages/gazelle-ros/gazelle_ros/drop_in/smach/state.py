"""States: what is done, and the outcomes and data that are declared for it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any


class State:
    """One state; subclasses define ``execute``.

    Args:
        outcomes: Outcomes of ``execute``.
        input_keys: Userdata that it reads.
        output_keys: Userdata that it writes.
        io_keys: Userdata that it reads and writes.
    """

    def __init__(
        self,
        outcomes: Iterable[str] = (),
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
        io_keys: Iterable[str] = (),
    ) -> None:
        self._outcomes = set(outcomes)
        self._input_keys = {*input_keys, *io_keys}
        self._output_keys = {*output_keys, *io_keys}
        self._preempt_requested = False

    def execute(self, ud: Any) -> Any:
        """Execute the state; returns the outcome.

        Raises:
            NotImplementedError: The class does not say how.
        """
        raise NotImplementedError(f"{type(self).__name__} has no execute")

    def register_outcomes(self, new_outcomes: Iterable[str]) -> None:
        """Declare more outcomes."""
        self._outcomes |= set(new_outcomes)

    def get_registered_outcomes(self) -> tuple[str, ...]:
        """Return the outcomes."""
        return tuple(self._outcomes)

    def register_io_keys(self, keys: Iterable[str]) -> None:
        """Declare userdata that is read and written."""
        names = set(keys)
        self._input_keys |= names
        self._output_keys |= names

    def register_input_keys(self, keys: Iterable[str]) -> None:
        """Declare userdata that is read."""
        self._input_keys |= set(keys)

    def get_registered_input_keys(self) -> tuple[str, ...]:
        """Return the names of userdata that is read."""
        return tuple(self._input_keys)

    def register_output_keys(self, keys: Iterable[str]) -> None:
        """Declare userdata that is written."""
        self._output_keys |= set(keys)

    def get_registered_output_keys(self) -> tuple[str, ...]:
        """Return the names of userdata that is written."""
        return tuple(self._output_keys)

    def request_preempt(self) -> None:
        """Request it to end early."""
        self._preempt_requested = True

    def service_preempt(self) -> None:
        """Clear the request after ending early."""
        self._preempt_requested = False

    def recall_preempt(self) -> None:
        """Withdraw the request."""
        self._preempt_requested = False

    def preempt_requested(self) -> bool:
        """Return True if a preemption is requested."""
        return self._preempt_requested


class CBInterface:
    """Function with the outcomes and userdata that it adds to a state.

    Args:
        cb: The function.
        outcomes: Outcomes.
        input_keys: Userdata that it reads.
        output_keys: Userdata that it writes.
        io_keys: Userdata that it reads and writes.
    """

    def __init__(
        self,
        cb: Callable[..., Any],
        outcomes: Iterable[str] | None = None,
        input_keys: Iterable[str] | None = None,
        output_keys: Iterable[str] | None = None,
        io_keys: Iterable[str] | None = None,
    ) -> None:
        shared = set(io_keys or ())
        self._cb, self._outcomes = cb, tuple(outcomes or ())
        self._input_keys = shared | set(input_keys or ())
        self._output_keys = shared | set(output_keys or ())

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """Call the function."""
        return self._cb(*args, **kwargs)

    def get_registered_outcomes(self) -> tuple[str, ...]:
        """Return the outcomes."""
        return self._outcomes

    def get_registered_input_keys(self) -> tuple[str, ...]:
        """Return the names of userdata that is read."""
        return tuple(self._input_keys)

    def get_registered_output_keys(self) -> tuple[str, ...]:
        """Return the names of userdata that is written."""
        return tuple(self._output_keys)


class cb_interface:  # noqa: N801  # smach's name
    """Decorator that makes a `CBInterface` of a function; arguments are those."""

    def __init__(
        self, outcomes: Any = None, input_keys: Any = None, output_keys: Any = None
    ) -> None:
        self._declared = outcomes, input_keys, output_keys

    def __call__(self, cb: Callable[..., Any]) -> CBInterface:
        """Declare the outcomes and userdata keys of a function."""
        return CBInterface(cb, *self._declared)


def has_smach_interface(obj: object) -> bool:
    """Return True if something declares outcomes and userdata, as states do."""
    kinds = ("input_keys", "output_keys", "outcomes")
    return all(hasattr(obj, f"get_registered_{kind}") for kind in kinds)


class CBState(State):
    """State of a function.

    Args:
        cb: Called with the userdata; returns the outcome. What it declares is added.
        cb_args: For the function, after the userdata.
        cb_kwargs: For the function.
        outcomes: See `State`.
        input_keys: See `State`.
        output_keys: See `State`.
        io_keys: See `State`.
    """

    def __init__(
        self,
        cb: Any,
        cb_args: Sequence[Any] = (),
        cb_kwargs: Mapping[str, Any] | None = None,
        outcomes: Iterable[str] = (),
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
        io_keys: Iterable[str] = (),
    ) -> None:
        super().__init__(outcomes, input_keys, output_keys, io_keys)
        self._cb, self._cb_args, self._cb_kwargs = cb, cb_args, dict(cb_kwargs or {})
        add_interface(self, cb)

    def execute(self, ud: Any) -> Any:
        """Call the function."""
        return self._cb(ud, *self._cb_args, **self._cb_kwargs)


def add_interface(state: State, cb: Any) -> bool:
    """Add what a function declares to a state; returns whether it declares anything."""
    if not has_smach_interface(cb):
        return False
    state.register_input_keys(cb.get_registered_input_keys())
    state.register_output_keys(cb.get_registered_output_keys())
    state.register_outcomes(cb.get_registered_outcomes())
    return True
