"""A state that is executed once for each of some items."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from gazelle_ros.drop_in.smach.container import Container, Edge
from gazelle_ros.drop_in.smach.log import is_shutdown, loginfo
from gazelle_ros.drop_in.smach.state import State

_Items = Iterable[Any] | Callable[[], Iterable[Any]]


class Iterator(Container):
    """Container that executes its one state for each of some items.

    Args:
        outcomes: Of the container.
        input_keys: Userdata that it takes from the container around it.
        output_keys: Userdata that it gives to it.
        it: The items, or a function that returns them.
        it_label: Userdata that an item is put into.
        exhausted_outcome: The outcome when no item is left.
    """

    def __init__(
        self,
        outcomes: Iterable[str],
        input_keys: Iterable[str],
        output_keys: Iterable[str],
        it: _Items = (),
        it_label: str = "it_data",
        exhausted_outcome: str = "exhausted",
    ) -> None:
        super().__init__([*outcomes, exhausted_outcome], input_keys, output_keys)
        self._items, self._items_label = it, it_label
        self._exhausted = exhausted_outcome
        self._label, self._state = "", State()
        self._loop: set[str] = set()
        self._final: Mapping[str, str] = {}
        self._is_running = False

    @staticmethod
    def set_iteritems(it: _Items, it_label: str = "it_data") -> None:
        """Set the items of the iterator that is open, and their userdata."""
        self = Iterator._current()
        self._items, self._items_label = it, it_label

    @staticmethod
    def set_contained_state(
        label: str,
        state: State,
        loop_outcomes: Sequence[str] = (),
        break_outcomes: Sequence[str] = (),
        final_outcome_map: Mapping[str, str] | None = None,
    ) -> None:
        """Set the state of the iterator that is open.

        Args:
            label: Its name.
            state: The state.
            loop_outcomes: Outcomes after which the next item follows; all others end it.
            break_outcomes: Outcomes that end it; then the next item follows after all others.
            final_outcome_map: From the last outcome to that of the container.
        """
        self = Iterator._current()
        self._label, self._state = label, state
        known = set(state.get_registered_outcomes())
        self._loop = known - set(break_outcomes) if break_outcomes else set(loop_outcomes)
        self._final = final_outcome_map or {}

    def execute(self, parent_ud: Any = None) -> Any:
        """Execute the state for each item; returns the outcome.

        Raises:
            InvalidUserCodeError: The state raised an exception.
        """
        self._take_inputs(parent_ud)
        self._is_running = True
        self.call_start_cbs()
        outcome = self._exhausted
        for item in self._items() if callable(self._items) else self._items:
            if is_shutdown():
                break
            loginfo(f"Iterating {item} of {self._items}")
            self.userdata[self._items_label] = item
            last = self._execute_child(self._label, self._state, self.userdata)
            if self._preempt_requested or last not in self._loop:
                self.service_preempt()
                outcome = last
                break
            self.call_transition_cbs()
        outcome = self._final.get(outcome, outcome)
        self._give_outputs(parent_ud)
        self._is_running = False
        self.call_termination_cbs([self._label], outcome)
        return outcome

    def request_preempt(self) -> None:
        """Request it, and its state if that is executed, to end early."""
        super().request_preempt()
        if self._is_running:
            self._state.request_preempt()

    def get_children(self) -> Mapping[str, State]:
        """Return its state by its label."""
        return {self._label: self._state}

    def get_active_states(self) -> list[str]:
        """Return the label of its state while that is executed."""
        return [self._label] if self._is_running else []

    def get_internal_edges(self) -> list[Edge]:
        """Return what leads to the next item, or out of the container."""
        return [
            (
                outcome,
                self._label,
                self._label if outcome in self._loop else self._final.get(outcome),
            )
            for outcome in self._state.get_registered_outcomes()
        ]
