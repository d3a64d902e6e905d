"""Settings of a plugin from outside."""

import pytest

from gazelle.errors import SimulationError
from gazelle.simulation import Setting, Tunable, Tuning


def test_a_setting_holds_its_default_until_another_value_comes():
    heard = []
    setting = Setting("/r/gain", 2.0, heard.append)
    assert (setting.value, heard) == (2.0, [])
    setting.send(3)
    assert (setting.value, heard) == (3.0, [3.0])
    assert isinstance(setting.value, float)


@pytest.mark.parametrize(
    ("default", "value"),
    [(1.0, "fast"), (1.0, True), (1, 2.5), (1, True), ("a", 1), (True, 1), ({}, [1])],
)
def test_a_setting_refuses_other_types(default, value):
    setting = Setting("/r/gain", default)
    with pytest.raises(SimulationError, match="/r/gain"):
        setting.send(value)
    assert setting.value == default


@pytest.fixture
def held():
    return {"speed": 1.0, "steps": 4, "on": True, "name": "a"}


@pytest.fixture
def tuning(held):
    tunables = (
        Tunable("speed", 1.0, 0.0, 2.0, "how fast"),
        Tunable("steps", 4, 1, 9, "how often"),
        Tunable("on", True, False, True, "whether"),
        Tunable("name", "a", "", "", "what"),
    )
    return Tuning("/r/drive", tunables, held.update, lambda: held)


def test_a_tuning_keeps_what_nobody_changes_and_clamps_the_rest(tuning, held):
    answer = tuning.send(speed=7.0, steps=0)
    assert answer == held == {"speed": 2.0, "steps": 1, "on": True, "name": "a"}
    assert tuning.send(on=0, name="b")["on"] is False
    assert tuning.values["name"] == "b"


def test_a_tuning_knows_its_names(tuning):
    with pytest.raises(SimulationError, match="'sped'") as caught:
        tuning.send(sped=1.0)
    assert "speed" in str(caught.value)
