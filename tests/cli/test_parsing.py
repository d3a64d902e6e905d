from __future__ import annotations

import argparse

import pytest

from gazelle.argument_types import positive_float, positive_int
from gazelle.cli.parsing import key_value


@pytest.mark.parametrize(("text", "number"), [("1", 1), ("2_000", 2000), ("1e6", 1_000_000)])
def test_whole_numbers_can_be_written_in_several_ways(text, number):
    assert positive_int(text) == number


@pytest.mark.parametrize("text", ["0", "-3", "1.5", "many", "", "1e999", "nan"])
def test_what_is_no_whole_number_above_0_is_refused(text):
    with pytest.raises(argparse.ArgumentTypeError, match="above 0"):
        positive_int(text)


@pytest.mark.parametrize("text", ["0", "-1", "inf", "nan", "fast"])
def test_what_is_no_number_above_0_is_refused(text):
    with pytest.raises(argparse.ArgumentTypeError, match="above 0"):
        positive_float(text)


@pytest.mark.parametrize(
    ("text", "pair"),
    [
        ("a=1", ("a", 1)),
        ("a=0.5", ("a", 0.5)),
        ("a=true", ("a", True)),
        ("a=[[1, 2]]", ("a", [[1, 2]])),
        ("a=word", ("a", "word")),
        ("a=b=c", ("a", "b=c")),
    ],
)
def test_options_are_read_as_json_or_text(text, pair):
    assert key_value(text) == pair


@pytest.mark.parametrize("text", ["a", "=1", "two words=1"])
def test_options_need_a_name(text):
    with pytest.raises(argparse.ArgumentTypeError, match="KEY=VALUE"):
        key_value(text)
