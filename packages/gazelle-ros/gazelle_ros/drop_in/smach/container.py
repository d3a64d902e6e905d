"""Containers: states that have states in them."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, ClassVar, Self

from gazelle_ros.drop_in.smach.exceptions import (
    InvalidConstructionError,
    InvalidStateError,
    InvalidUserCodeError,
    SmachError,
)
from gazelle_ros.drop_in.smach.log import logerr, logwarn
from gazelle_ros.drop_in.smach.state import State
from gazelle_ros.drop_in.smach.user_data import Remapper, UserData

Edge = tuple[str, str, str | None]
"""An outcome, the state that has it, and the state or outcome of the container that it leads to."""
_Callbacks = list[tuple[Callable[..., Any], Sequence[Any]]]


class Container(State):
    """State with states in it, which are added while it is open (``with container:``).

    Attributes:
        userdata: Userdata of its states.
    """

    _opened: ClassVar[list[Container]] = []
    _lock: ClassVar[Any] = threading.RLock()

    def __init__(
        self,
        outcomes: Iterable[str] = (),
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
    ) -> None:
        super().__init__(outcomes, input_keys, output_keys)
        self.userdata = UserData()
        self._start_cbs: _Callbacks = []
        self._transition_cbs: _Callbacks = []
        self._termination_cbs: _Callbacks = []

    def get_children(self) -> Mapping[str, State]:
        """Return the states in it, by their labels.

        Raises:
            NotImplementedError: The class does not say.
        """
        raise NotImplementedError

    def __getitem__(self, key: str) -> State:
        children = self.get_children()
        if key not in children:
            raise KeyError(f"there is no state '{key}'; there are {list(children)}")
        return children[key]

    def get_initial_states(self) -> list[str]:
        """Return the labels of the states that are executed first."""
        return list(self.get_children())

    def set_initial_state(self, initial_states: Sequence[str], userdata: UserData) -> None:
        """Choose the states that are executed first, where there is a choice; add userdata."""
        del initial_states
        self.userdata.update(userdata)

    def get_active_states(self) -> list[str]:
        """Return the labels of the states that are being executed.

        Raises:
            NotImplementedError: The class does not say.
        """
        raise NotImplementedError

    def get_internal_edges(self) -> list[Edge]:
        """Return what leads from a state to another, or out of the container."""
        return []

    def check_consistency(self) -> None:
        """Check that all outcomes lead somewhere.

        Raises:
            SmachError: One does not.
        """

    def register_start_cb(self, start_cb: Callable[..., Any], cb_args: Sequence[Any] = ()) -> None:
        """Call a function when it starts, with userdata and the initial states."""
        self._start_cbs.append((start_cb, cb_args))

    def register_transition_cb(
        self, transition_cb: Callable[..., Any], cb_args: Sequence[Any] = ()
    ) -> None:
        """Call a function when a state follows another, with userdata and the active states."""
        self._transition_cbs.append((transition_cb, cb_args))

    def register_termination_cb(
        self, termination_cb: Callable[..., Any], cb_args: Sequence[Any] = ()
    ) -> None:
        """Call a function at the end, with userdata, the last states and the outcome."""
        self._termination_cbs.append((termination_cb, cb_args))

    def call_start_cbs(self) -> None:
        """Call those functions."""
        self._call(self._start_cbs, self.get_initial_states())

    def call_transition_cbs(self) -> None:
        """Call those functions."""
        self._call(self._transition_cbs, self.get_active_states())

    def call_termination_cbs(self, terminal_states: Sequence[str], outcome: str) -> None:
        """Call those functions."""
        self._call(self._termination_cbs, terminal_states, outcome)

    def _call(self, callbacks: _Callbacks, *values: Any) -> None:
        for function, arguments in callbacks:
            try:
                function(self.userdata, *values, *arguments)
            except Exception as error:  # noqa: BLE001  # an observer must not stop the task
                logerr(f"a callback of the state machine failed: {error!r}")

    def _execute_child(self, label: str, state: State, ud: Any) -> Any:
        """Execute a state with userdata; returns its outcome.

        Raises:
            InvalidUserCodeError: It raised an exception.
        """
        try:
            return state.execute(ud)
        except InvalidUserCodeError:
            logerr(f"state '{label}' failed")
            raise
        except Exception as error:
            logerr(f"state '{label}' failed: {error!r}")
            raise InvalidUserCodeError(f"state '{label}' raised {error!r}") from error

    def _seen_by(self, state: State, remapping: Mapping[str, str]) -> Remapper:
        """Return what a state may see of the userdata."""
        inputs, outputs = state.get_registered_input_keys(), state.get_registered_output_keys()
        return Remapper(self.userdata, inputs, outputs, remapping)

    def _take_inputs(self, parent: Any) -> None:
        self._copy(parent, self.userdata, self._input_keys)

    def _give_outputs(self, parent: Any) -> None:
        self._copy(self.userdata, parent, self._output_keys)

    @staticmethod
    def _copy(source: Any, target: Any, keys: Iterable[str]) -> None:
        if source is None or target is None:
            return
        for key in keys:
            try:
                target[key] = source[key]
            except KeyError:
                logwarn(f"userdata '{key}' is to be handed on, and is not there")

    def open(self) -> Self:
        """Make this container the one that ``add`` adds to, until it is closed."""
        Container._lock.acquire()
        Container._opened.append(self)
        return self

    def close(self) -> None:
        """Add no more, and check it.

        Raises:
            InvalidStateError: Another one is open.
        """
        if Container._opened[-1:] != [self]:
            raise InvalidStateError("this container is not the one that is open")
        Container._opened.pop()
        Container._lock.release()

    def is_opened(self) -> bool:
        """Return True if ``add`` adds to this container."""
        return Container._opened[-1:] == [self]

    def assert_opened(self, msg: str = "") -> None:
        """Check that it is open.

        Raises:
            InvalidConstructionError: It is not.
        """
        if not self.is_opened():
            raise InvalidConstructionError(msg)

    @contextlib.contextmanager
    def opened(self, **_: Any) -> Iterator[Self]:
        """Open it for a ``with`` block."""
        with self:
            yield self

    def __enter__(self) -> Self:
        return self.open()

    def __exit__(self, kind: object, *_: object) -> None:
        self.close()
        if kind is None:
            try:
                self.check_consistency()
            except SmachError as error:
                logerr(str(error))

    @classmethod
    def _current(cls) -> Self:
        """Return the container that is open.

        Raises:
            InvalidStateError: None is, or one of another kind.
        """
        found = Container._opened[-1] if Container._opened else None
        if not isinstance(found, cls):
            raise InvalidStateError(f"no {cls.__name__} is open: write 'with container:'")
        return found
