"""Text of launch files as values."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.values import automatic, convert, load_yaml, load_yaml_documents, truth


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1", 1),
        ("-7", -7),
        ("1.5", 1.5),
        ("1.", 1.0),
        ("1e3", "1e3"),
        ("1_000", "1_000"),
        ("true", True),
        ("False", False),
        ("yes", "yes"),
        ("", ""),
        ("192.168.1.1", "192.168.1.1"),
        ("nan", "nan"),
        ("inf.", "inf."),
        ("0x10", "0x10"),
    ],
)
def test_text_becomes_what_it_looks_like(text, value):
    found = automatic(text)
    assert found == value
    assert type(found) is type(value)


@pytest.mark.long
@given(st.text())
def test_any_text_is_some_value(text):
    assert isinstance(automatic(text), (bool, int, float, str))


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("1", "str", "1"),
        ("1", "double", 1.0),
        ("1", "bool", True),
        ("FALSE", "boolean", False),
        ("[1, {a: b}]", "yaml", [1, {"a": "b"}]),
        ("12", "int", 12),
    ],
)
def test_types_are_respected(text, kind, value):
    found = convert(text, kind)
    assert found == value
    assert type(found) is type(value)


@pytest.mark.parametrize(
    ("text", "kind"),
    [("x", "int"), ("1.5", "int"), ("x", "double"), ("2", "bool"), ("[", "yaml"), ("1", "long")],
)
def test_a_wrong_value_or_type_is_refused(text, kind):
    with pytest.raises(LaunchError):
        convert(text, kind)


def test_truth_is_strict():
    assert truth(" True ")
    assert not truth("0")
    with pytest.raises(LaunchError, match="neither true"):
        truth("yes")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("!degrees 180", math.pi),
        ("!radians 2.5", 2.5),
        ("!radians pi/2", math.pi / 2),
        ("!degrees 45.0*2", math.pi / 2),
        ("deg(90)", math.pi / 2),
        ("rad(2*pi)", 2 * math.pi),
        ("rad(1.5)", 1.5),
    ],
)
def test_angles_come_out_in_radians(text, value):
    assert load_yaml(f"a: {text}") == {"a": pytest.approx(value)}


@pytest.mark.parametrize("text", ["a: deg(x)", "a: !radians __import__('os')", "a: rad(9**9**9)"])
def test_angles_are_no_programs(text):
    with pytest.raises(LaunchError):
        load_yaml(text)


def test_plain_words_that_look_like_angles_stay_words():
    assert load_yaml("[degree, rad, deg 5]") == ["degree", "rad", "deg 5"]


def test_yaml_errors_name_the_line():
    with pytest.raises(LaunchError, match="line 2"):
        load_yaml("a: 1\nb: ]\nc: 2")


def test_many_documents_are_read():
    assert load_yaml_documents("a: 1\n---\nb: !degrees 180") == [{"a": 1}, {"b": math.pi}]


def test_unsafe_yaml_is_refused():
    with pytest.raises(LaunchError):
        load_yaml("!!python/object/apply:os.system [ls]")
