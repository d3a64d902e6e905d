"""smach: machines, sequences, iterators and concurrences end as executive_smach's do."""

from __future__ import annotations

import importlib
import threading

import pytest

import gazelle_ros as ros
from gazelle_ros.drop_in import smach

WAIT_S = 60.0


@pytest.fixture(autouse=True)
def logs():
    """Return what is logged, by its level."""
    said: dict[str, list[str]] = {level: [] for level in ("info", "warn", "debug", "error")}
    before = dict(smach.log._loggers)
    smach.set_loggers(*(said[level].append for level in said))
    yield said
    smach.log._loggers.update(before)


class Count(smach.State):
    """Counts ``n`` up, and ends as it is told to."""

    def __init__(self, *ends):
        super().__init__(["again", "done"], input_keys=["n"], output_keys=["n", "twice"])
        self.ends = list(ends)

    def execute(self, ud):
        ud.n = ud.n + 1
        ud["twice"] = 2 * ud["n"]
        return self.ends.pop(0)


class Wait(smach.State):
    """Waits until it is let go or asked to end."""

    def __init__(self, outcome="done"):
        super().__init__(["done", "other", "preempted"])
        self.outcome, self.begun, self.free = outcome, threading.Event(), threading.Event()

    def execute(self, ud):
        self.begun.set()
        while not self.free.wait(0.01):
            if self.preempt_requested():
                self.service_preempt()
                return "preempted"
        return self.outcome


def machine(state, transitions=None, outcomes=("done", "failed"), **options):
    made = smach.StateMachine(outcomes=outcomes)
    made.userdata.n = 0
    with made:
        smach.StateMachine.add("ONE", state, transitions, **options)
    return made


def test_outcomes_lead_from_state_to_state():
    sm = smach.StateMachine(outcomes=["end"])
    sm.userdata.n = 0
    told = []
    sm.register_start_cb(lambda ud, states: told.append(("start", states)))
    sm.register_transition_cb(lambda ud, states, tag: told.append((tag, states)), ["step"])
    sm.register_termination_cb(lambda ud, states, outcome: told.append((outcome, states)))
    with sm:
        smach.StateMachine.add("A", Count("again", "done"), {"again": "A", "done": "B"})
        smach.StateMachine.add(
            "B", Count("done"), {"again": "A", "done": "end"}, remapping={"twice": "total"}
        )
    assert sm.execute() == "end"
    assert (sm.userdata.n, sm.userdata.total, sm.userdata.twice) == (3, 6, 4)
    assert told == [
        ("start", ["A"]),
        ("step", ["A"]),
        ("step", ["B"]),
        ("end", ["B"]),
    ]
    assert ("done", "B", "end") in sm.get_internal_edges()
    assert not sm.is_running()


def test_machines_in_machines_hand_userdata_on():
    inner = smach.StateMachine(outcomes=["done"], input_keys=["n"], output_keys=["n"])
    with inner:
        smach.StateMachine.add("X", Count("again", "done"), {"again": "X"})
    outer = machine(inner, {"done": "done"}, remapping={"n": "count"})
    outer.userdata.count = 10
    assert outer.execute() == "done"
    assert outer.userdata.count == 12
    assert "n" in inner.userdata


def test_constants_are_set_before_a_state():
    sm = machine(Count("done"), {"again": "failed"}, constants={"n": 41})
    assert sm.execute() == "done"
    assert sm.userdata.n == 42


def test_outcomes_are_connected_to_the_next_state():
    sq = smach.Sequence(outcomes=["done", "again"], connector_outcome="done")
    sq.userdata.n = 0
    with sq:
        for name in "abc":
            smach.Sequence.add(name, Count("done"))
    assert sq.execute() == "done"
    assert sq.userdata.n == 3
    sm = smach.StateMachine(outcomes=["done", "again"])
    sm.userdata.n = 0
    with sm:
        smach.StateMachine.add_auto("A", Count("done"), ["done"])
        smach.StateMachine.add("B", Count("again"))
    assert sm.execute() == "again"
    assert sm.userdata.n == 2


@pytest.mark.parametrize(
    ("last", "outcome", "seen"), [(2, "stopped", [0, 1, 2]), (9, "exhausted", [0, 1, 2, 3])]
)
def test_a_state_is_executed_for_each_item(last, outcome, seen):
    @smach.cb_interface(outcomes=["on", "off"], input_keys=["i", "seen"], output_keys=["seen"])
    def look(ud):
        ud.seen = [*ud.seen, ud.i]
        return "on" if ud.i < last else "off"

    it = smach.Iterator(["stopped"], [], ["seen"], it=lambda: range(4), it_label="i")
    it.userdata.seen = []
    with it:
        smach.Iterator.set_contained_state(
            "LOOK", smach.CBState(look), loop_outcomes=["on"], final_outcome_map={"off": "stopped"}
        )
    assert it.execute() == outcome
    assert it.userdata.seen == seen


@pytest.mark.parametrize(
    ("ends", "options", "outcome"),
    [
        (("done", "other"), {}, "good"),
        (("done", "done"), {}, "bad"),
        (("done", "other"), {"outcome_cb": lambda ended: "chosen"}, "chosen"),
        (("done", "other"), {"outcome_cb": lambda ended: None}, "good"),
    ],
)
def test_outcomes_of_a_concurrence_are_those_of_its_map(ends, options, outcome):
    both = smach.Concurrence(
        ["good", "bad", "chosen"],
        "bad",
        outcome_map={"good": {"A": "done", "B": "other"}},
        **options,
    )
    with both:
        for label, end in zip("AB", ends, strict=True):
            smach.Concurrence.add(label, Wait(end)).free.set()
    assert both.execute() == outcome


def test_one_state_may_end_the_others():
    both = smach.Concurrence(["early", "bad"], "bad", child_termination_cb=lambda ended: True)
    first, second = Wait(), Wait()
    first.free.set()
    both._outcome_cb = lambda ended: "early" if ended["B"] == "preempted" else None
    with both:
        smach.Concurrence.add("A", first)
        smach.Concurrence.add("B", second)
    assert both.execute() == "early"


@pytest.mark.parametrize("kind", ["machine", "nested", "concurrence"])
def test_what_is_executed_is_asked_to_end(kind):
    state = Wait()
    top = machine(state, {"other": "failed"}, ("done", "failed", "preempted"))
    if kind == "nested":
        top = machine(top, outcomes=("done", "failed", "preempted"))
    if kind == "concurrence":
        top = smach.Concurrence(["x"], "x")
        with top:
            smach.Concurrence.add("A", state)
    ended = []
    thread = threading.Thread(target=lambda: ended.append(top.execute()))
    thread.start()
    assert state.begun.wait(WAIT_S)
    top.request_preempt()
    thread.join(WAIT_S)
    assert ended == ["preempted"]
    assert not top.preempt_requested()
    assert not state.preempt_requested()


def test_a_state_that_follows_is_asked_where_the_last_one_was_deaf():
    class Deaf(smach.State):
        def execute(self, ud):
            sm.request_preempt()
            return "done"

    second = Wait()
    sm = smach.StateMachine(outcomes=["done", "other", "preempted"])
    with sm:
        smach.StateMachine.add("A", Deaf(["done"]), {"done": "B"})
        smach.StateMachine.add("B", second)
    assert sm.execute() == "preempted"
    assert not sm.preempt_requested()


@pytest.mark.parametrize(
    ("build", "kind", "said"),
    [
        (lambda: smach.StateMachine.add("A", Wait()), smach.InvalidStateError, "no StateMachine"),
        (
            lambda: machine(Wait(), {"nope": "done"}),
            smach.InvalidTransitionError,
            "has no outcome 'nope'",
        ),
        (lambda: smach.Concurrence(["a"], "b"), smach.InvalidStateError, "no outcome 'b'"),
        (
            lambda: machine(Count("x"), {"again": "failed"}).execute(),
            smach.InvalidTransitionError,
            "the outcome 'x'",
        ),
        (
            lambda: machine(Count(), {"again": "failed"}).execute(),
            smach.InvalidUserCodeError,
            "IndexError",
        ),
        (lambda: machine(Wait())["TWO"], KeyError, "there are .'ONE'"),
    ],
)
def test_faults_are_named(build, kind, said):
    with pytest.raises(kind, match=said):
        build()
    assert not smach.Container._opened


def test_a_machine_that_is_not_complete_is_told_and_not_executed(logs):
    sm = machine(Wait(), {"other": "nowhere"})
    assert any("leads to 'nowhere'" in line and "'preempted'" in line for line in logs["error"])
    assert sm.execute() is None


def test_userdata_that_is_not_declared_is_neither_read_nor_written(logs):
    def look(ud):
        ud.secret = 1
        return ud.other

    state = smach.CBState(look, outcomes=["done"])
    with pytest.raises(smach.InvalidUserCodeError, match="reads userdata 'other'"):
        machine(state).execute()
    assert any("writes userdata 'secret'" in line for line in logs["error"])


def test_scripts_find_it_in_all_its_modules():
    lines = (
        "import smach, smach.util, smach.state_machine",
        "from smach.container import Container",
        "from smach.sequence import Sequence",
        "from smach.user_data import UserData, Remapper",
        "from smach_msgs.msg import SmachContainerStatus, SmachContainerStructure",
    )
    with ros.install():
        for line in lines:
            exec(line)
        assert importlib.import_module("smach").StateMachine is smach.StateMachine
