"""States that are executed at the same time."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from gazelle_ros.drop_in.smach.container import Container, Edge
from gazelle_ros.drop_in.smach.exceptions import InvalidStateError, InvalidTransitionError
from gazelle_ros.drop_in.smach.log import is_shutdown, logerr, loginfo, logwarn
from gazelle_ros.drop_in.smach.state import State

_Outcomes = dict[str, str | None]
_LOOK_S = 0.1


class Concurrence(Container):
    """Container that executes its states at the same time, each on a thread of its own.

    Args:
        outcomes: Of the container.
        default_outcome: The outcome where nothing else decides.
        input_keys: Userdata that it takes from the container around it.
        output_keys: Userdata that it gives to it.
        outcome_map: From an outcome to the states and outcomes that it stands for; the one with
            most states counts.
        outcome_cb: Called at the end with the outcomes of all states; returns the container's
            outcome, or None.
        child_termination_cb: Called with the outcomes so far when a state ends; where it returns
            something true, all others are preempted.

    Raises:
        InvalidStateError: An outcome is not one of the container.
    """

    def __init__(
        self,
        outcomes: Iterable[str],
        default_outcome: str,
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
        outcome_map: Mapping[str, Mapping[str, str]] | None = None,
        outcome_cb: Callable[[_Outcomes], str | None] | None = None,
        child_termination_cb: Callable[[_Outcomes], Any] | None = None,
    ) -> None:
        super().__init__(outcomes, input_keys, output_keys)
        self._default, self._outcome_map = default_outcome, dict(outcome_map or {})
        for outcome in (default_outcome, *self._outcome_map):
            if outcome not in self._outcomes:
                raise InvalidStateError(f"the concurrence has no outcome '{outcome}'")
        self._outcome_cb, self._child_cb = outcome_cb, child_termination_cb
        self._states: dict[str, State] = {}
        self._remappings: dict[str, Mapping[str, str]] = {}
        self._child_outcomes: _Outcomes = {}
        self._failures: list[Exception] = []
        self._changed = threading.Condition()
        self._over = False

    @staticmethod
    def add(label: str, state: State, remapping: Mapping[str, str] | None = None) -> State:
        """Add a state to the concurrence that is open.

        Raises:
            InvalidStateError: None is open.
        """
        self = Concurrence._current()
        self._states[label], self._remappings[label] = state, remapping or {}
        return state

    def check_consistency(self) -> None:
        """Check the map of outcomes.

        Raises:
            InvalidTransitionError: It names what is not there.
        """
        for wanted in self._outcome_map.values():
            for label, outcome in wanted.items():
                state = self._states.get(label)
                if state is None or outcome not in state.get_registered_outcomes():
                    raise InvalidTransitionError(
                        f"the outcome map names '{label}':'{outcome}', which is not there"
                    )

    def execute(self, parent_ud: Any = None) -> Any:
        """Execute its states; returns the outcome.

        Raises:
            InvalidStateError: It has no states, or one of them failed.
        """
        if not self._states:
            raise InvalidStateError("the concurrence has no states")
        self._take_inputs(parent_ud)
        self._child_outcomes, self._failures = dict.fromkeys(self._states), []
        self._over = self._preempt_requested
        loginfo(f"Concurrence starting with userdata: \n\t{self.userdata.keys()}")
        self.call_start_cbs()
        threads = [
            threading.Thread(target=self._run, args=(label,), name=label, daemon=True)
            for label in self._states
        ]
        for thread in threads:
            thread.start()
        self._wait(threads)
        if self._failures:
            raise InvalidStateError("a state of the concurrence failed") from self._failures[0]
        outcome = self._preempted() or self._outcome()
        self.call_termination_cbs(list(self._states), outcome)
        self._give_outputs(parent_ud)
        return outcome

    def _run(self, label: str) -> None:
        """Execute one state; called on its thread."""
        self.call_transition_cbs()
        state = self._states[label]
        try:
            outcome = self._execute_child(
                label, state, self._seen_by(state, self._remappings[label])
            )
            if outcome not in state.get_registered_outcomes():
                raise InvalidTransitionError(f"state '{label}' returned the outcome '{outcome}'")  # noqa: TRY301
            loginfo(f"Concurrent state '{label}' returned outcome '{outcome}' on termination.")
            with self._changed:
                self._child_outcomes[label] = outcome
                ends = self._child_cb is not None and bool(self._child_cb(self._child_outcomes))
            self.call_transition_cbs()
        except Exception as error:  # noqa: BLE001  # raised where execute was called
            self._failures.append(error)
            ends = True
        with self._changed:
            self._over |= ends or None not in self._child_outcomes.values()
            self._changed.notify_all()

    def _wait(self, threads: list[threading.Thread]) -> None:
        """Wait for the end, preempt those that still run, and wait for them."""
        with self._changed:
            while not self._over and not is_shutdown():
                self._changed.wait(_LOOK_S)
        for label, outcome in list(self._child_outcomes.items()):
            if outcome is None:
                self._states[label].request_preempt()
        while any(thread.is_alive() for thread in threads) and not is_shutdown():
            for thread in threads:
                thread.join(_LOOK_S)

    def _preempted(self) -> str | None:
        """Return 'preempted' if it was preempted, and all states ended so."""
        if not self._preempt_requested:
            return None
        late = [label for label, state in self._states.items() if state.preempt_requested()]
        for label in late:
            logwarn(f"state '{label}' in the concurrence did not service the preempt")
            self._states[label].recall_preempt()
        if late:
            return None
        self.service_preempt()
        return "preempted"

    def _outcome(self) -> str:
        loginfo(f"Concurrent Outcomes: {self._child_outcomes}")
        outcome, most = self._default, 0
        for name, wanted in self._outcome_map.items():
            met = all(self._child_outcomes.get(label) == each for label, each in wanted.items())
            if met and len(wanted) > most:
                outcome, most = name, len(wanted)
        chosen = self._outcome_cb(dict(self._child_outcomes)) if self._outcome_cb else None
        if chosen and chosen not in self._outcomes:
            logerr(f"outcome_cb returned '{chosen}', which is no outcome: it is '{outcome}'")
            return outcome
        return chosen or outcome

    def request_preempt(self) -> None:
        """Request all its states to end early."""
        super().request_preempt()
        with self._changed:
            self._over = True
            self._changed.notify_all()

    def get_children(self) -> Mapping[str, State]:
        """Return the states in it, by their labels."""
        return self._states

    def get_active_states(self) -> list[str]:
        """Return the labels of the states that have not ended."""
        return [label for label, outcome in self._child_outcomes.items() if outcome is None]

    def get_internal_edges(self) -> list[Edge]:
        """Return the map of outcomes."""
        pairs = [(name, pair) for name, each in self._outcome_map.items() for pair in each.items()]
        return [(outcome, label, name) for name, (label, outcome) in pairs]
