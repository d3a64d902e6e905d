"""An input keeps what a user entered when a picture comes before it is set."""

from types import SimpleNamespace

import pytest

from gazelle.viewer.page.live_input import LiveInput


@pytest.fixture
def made():
    """Return an input, what was set by it, and a function that a user's change calls at last."""
    late, done = [], []
    actions = SimpleNamespace(on_user_change=lambda _handle, work: late.append(work))
    live = LiveInput(actions, SimpleNamespace(value=1.0), done.append)
    return live, done, late[0]


def test_a_value_that_changes_by_itself_is_shown(made):
    live, done, _ = made
    live.show(2.0)
    assert (live.shown.value, done) == (2.0, [])


def test_a_picture_between_entry_and_effect_changes_nothing(made):
    live, done, take_effect = made
    live.shown.value = 5.0
    live.show(2.0)
    assert live.shown.value == 5.0
    take_effect()
    assert done == [5.0]
    live.show(2.0)
    assert live.shown.value == 2.0


def test_a_value_that_cannot_be_set_is_shown_as_it_was(made):
    live, _, take_effect = made
    live._work = lambda _value: 1 / 0
    live.shown.value = 5.0
    with pytest.raises(ZeroDivisionError):
        take_effect()
    live.show(1.0)
    assert live.shown.value == 1.0
