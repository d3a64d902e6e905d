"""Texts with characters that no file holds end in an error of Gazelle's, or are read with a warning."""

from __future__ import annotations

import pytest

from gazelle import FormatError, formats
from gazelle.errors import FormatWarning

LOADERS = [formats.load_string, formats.load_model_string, formats.load_srdf_string]


@pytest.mark.parametrize("load", LOADERS)
@pytest.mark.parametrize("text", ["\ud800", "", "\x00", "<\ud800>", "a" * 10_000])
def test_texts_that_are_nothing(load, text):
    with pytest.raises(FormatError):
        load(text)


def test_half_a_pair_in_a_name_is_read_as_other_bytes_that_are_no_characters():
    with pytest.warns(FormatWarning, match="not in utf-8"):
        world = formats.load_string("<sdf version='1.6'><world name='\ud800'/></sdf>")
    assert world.name
