"""State machines: one state at a time, and its outcome decides the next."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping
from collections.abc import Sequence as Several
from typing import Any

from gazelle_ros.drop_in.smach.container import Container, Edge
from gazelle_ros.drop_in.smach.exceptions import (
    InvalidStateError,
    InvalidTransitionError,
    SmachError,
)
from gazelle_ros.drop_in.smach.log import is_shutdown, logerr, loginfo, logwarn
from gazelle_ros.drop_in.smach.state import State
from gazelle_ros.drop_in.smach.user_data import UserData


class StateMachine(Container):
    """States of which one is executed at a time, the first that was added first.

    Args:
        outcomes: Of the machine.
        input_keys: Userdata that it takes from the container around it.
        output_keys: Userdata that it gives to it.
    """

    def __init__(
        self,
        outcomes: Iterable[str],
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
    ) -> None:
        super().__init__(outcomes, input_keys, output_keys)
        self._states: dict[str, State] = {}
        self._transitions: dict[str, dict[str, str | None]] = {}
        self._remappings: dict[str, Mapping[str, str]] = {}
        self._constants: dict[str, Mapping[str, Any]] = {}
        self._initial: str | None = None
        self._label: str | None = None
        self._preempted: State | None = None  # to end early, and may not have done so yet
        self._auto: tuple[str, Several[str]] | None = None
        self._is_running = False
        self._changing = threading.RLock()

    @staticmethod
    def add(
        label: str,
        state: State,
        transitions: dict[str, str | None] | None = None,
        remapping: Mapping[str, str] | None = None,
        constants: Mapping[str, Any] | None = None,
    ) -> State:
        """Add a state to the machine that is open.

        Args:
            label: Its name in the machine.
            state: The state.
            transitions: From an outcome to the next state or to an outcome of the machine; an
                outcome that is not there is the machine's.
            remapping: From its userdata to the machine's.
            constants: Userdata of the machine that is set before it is executed.

        Raises:
            InvalidStateError: No machine is open, or it has such a label.
            InvalidTransitionError: The state has no such outcome.
        """
        self = StateMachine._current()
        if label in self._states:
            raise InvalidStateError(f"the state machine has a state '{label}' already")
        self.check_state_spec(label, state, transitions or {})
        self._states[label] = state
        self._transitions[label] = {
            **dict.fromkeys(state.get_registered_outcomes()),
            **(transitions or {}),
        }
        self._remappings[label] = remapping or {}
        self._constants[label] = constants or {}
        self._initial = self._initial or label
        if self._auto is not None:
            last, outcomes = self._auto
            self._transitions[last].update(dict.fromkeys(outcomes, label))
            self._auto = None
        return state

    @staticmethod
    def add_auto(
        label: str,
        state: State,
        connector_outcomes: Several[str],
        transitions: dict[str, str | None] | None = None,
        remapping: Mapping[str, str] | None = None,
        constants: Mapping[str, Any] | None = None,
    ) -> State:
        """Add a state of which some outcomes lead to the state that is added next; see `add`."""
        self = StateMachine._current()
        StateMachine.add(label, state, transitions, remapping, constants)
        self.check_state_spec(label, state, dict.fromkeys(connector_outcomes))
        self._auto = label, connector_outcomes
        return state

    def check_state_spec(
        self, label: str, state: State, transitions: Mapping[str, str | None]
    ) -> None:
        """Check that a state has the outcomes of which transitions are given.

        Raises:
            InvalidTransitionError: It has not.
        """
        known = state.get_registered_outcomes()
        for outcome in transitions:
            if outcome not in known:
                raise InvalidTransitionError(
                    f"state '{label}' has no outcome '{outcome}'; it has {sorted(known)}"
                )

    def check_consistency(self) -> None:
        """Check that all outcomes lead somewhere.

        Raises:
            InvalidTransitionError: One does not.
        """
        faults = [] if self._initial in self._states else ["it has no initial state"]
        outcomes = self.get_registered_outcomes()
        for label, transitions in self._transitions.items():
            for outcome, target in transitions.items():
                if target and target not in self._states and target not in outcomes:
                    faults.append(f"'{label}':'{outcome}' leads to '{target}', which is not there")
                if not target and outcome not in outcomes:
                    faults.append(f"'{label}':'{outcome}' leads nowhere, and is no outcome of it")
        if faults:
            raise InvalidTransitionError(f"the state machine is not complete: {'; '.join(faults)}")

    def execute(self, parent_ud: Any = None) -> Any:
        """Execute its states until an outcome of the machine is reached, and return that.

        None if the machine is not complete, or the program ends.

        Raises:
            InvalidTransitionError: A state returned an outcome that it does not have.
            InvalidUserCodeError: A state raised an exception.
        """
        try:
            self.check_consistency()
        except SmachError as error:
            logerr(str(error))
            return None
        with self._changing:
            self._label, self._preempted = self._initial, None
        self._take_inputs(parent_ud)
        self._is_running = True
        loginfo(
            f"State machine starting in initial state '{self._label}' with userdata: \n\t"
            f"{self.userdata.keys()}"
        )
        self.call_start_cbs()
        outcome = None
        try:
            while outcome is None and self._label is not None and not is_shutdown():
                outcome = self._step(self._label)
            self._give_outputs(parent_ud)
        finally:
            self._is_running = False
        return outcome

    def _step(self, label: str) -> str | None:
        """Execute one state and continue to the next; returns the machine's outcome at its end."""
        state = self._states[label]
        with self._changing:
            self._pass_on_preempt(state)
        for key, value in self._constants[label].items():
            self.userdata[key] = value
        outcome = self._execute_child(label, state, self._seen_by(state, self._remappings[label]))
        if outcome not in state.get_registered_outcomes():
            raise InvalidTransitionError(
                f"state '{label}' returned the outcome '{outcome}'; it has "
                f"{sorted(state.get_registered_outcomes())}"
            )
        target = self._transitions[label].get(outcome) or outcome
        if target in self._states:
            with self._changing:
                self._label = target
            loginfo(f"State machine transitioning '{label}':'{outcome}'-->'{target}'")
            self.call_transition_cbs()
            return None
        with self._changing:
            self._label = None
            if self._preempted is not None and not self._preempted.preempt_requested():
                self.service_preempt()
        loginfo(f"State machine terminating '{label}':'{outcome}':'{target}'")
        self.call_termination_cbs([label], target)
        return target

    def request_preempt(self) -> None:
        """Request it, and the active state, to end early."""
        with self._changing:
            super().request_preempt()
            if self._label is not None:
                self._pass_on_preempt(self._states[self._label])

    def _pass_on_preempt(self, state: State) -> None:
        """Request a state to end early if the machine is requested, unless one has ended since."""
        if not self._preempt_requested:
            return
        if self._preempted is not None and not self._preempted.preempt_requested():
            self.service_preempt()
            self._preempted = None
        elif self._preempted is not state:
            if self._preempted is not None:
                self._preempted.recall_preempt()
            self._preempted = state
            state.request_preempt()

    def get_children(self) -> Mapping[str, State]:
        """Return the states in it, by their labels."""
        return self._states

    def set_initial_state(
        self, initial_states: Several[str], userdata: UserData | None = None
    ) -> None:
        """Choose the state that is executed first, and add userdata."""
        if len(initial_states) > 1:
            logwarn("a state machine has one initial state: the first one is taken")
        if initial_states:
            self._initial = initial_states[0]
        if userdata is not None:
            self.userdata.update(userdata)

    def get_active_states(self) -> list[str]:
        """Return the label of the state that is executed."""
        return [str(self._label)]

    def get_initial_states(self) -> list[str]:
        """Return the label of the state that is executed first."""
        return [str(self._initial)]

    def get_internal_edges(self) -> list[Edge]:
        """Return all transitions as (outcome, state, next state or outcome of the machine)."""
        edges = (
            (label, pair) for label, each in self._transitions.items() for pair in each.items()
        )
        return [(outcome, label, target) for label, (outcome, target) in edges]

    def is_running(self) -> bool:
        """Return True between the start of ``execute`` and its end."""
        return self._is_running


class Sequence(StateMachine):
    """State machine whose states follow each other in the order in which they are added.

    Args:
        outcomes: Of the machine.
        connector_outcome: The outcome of a state that leads to the next one.
        input_keys: See `StateMachine`.
        output_keys: See `StateMachine`.
    """

    def __init__(
        self,
        outcomes: Iterable[str],
        connector_outcome: str,
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
    ) -> None:
        super().__init__(outcomes, input_keys, output_keys)
        self._connector = connector_outcome

    @staticmethod
    def add(
        label: str,
        state: State,
        transitions: dict[str, str | None] | None = None,
        remapping: Mapping[str, str] | None = None,
        constants: Mapping[str, Any] | None = None,
    ) -> State:
        """Add a state to the sequence that is open; see `StateMachine.add`."""
        self = Sequence._current()
        last = next(reversed(self._states), None)
        StateMachine.add(label, state, transitions, remapping, constants)
        if last is not None and self._transitions[last].get(self._connector) is None:
            self.check_state_spec(last, self._states[last], {self._connector: label})
            self._transitions[last][self._connector] = label
        return state
