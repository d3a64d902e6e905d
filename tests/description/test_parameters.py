"""Plugin parameters are read by type, and errors name the place."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle import FormatError
from gazelle.formats import xml

TEXT = """<plugin name='p' filename='f.so'>
  <rate>20</rate>
  <on>true</on>
  <name>left</name>
  <empty/>
  <inner><deep>1.5</deep></inner>
  <rgb>1 0 0.5</rgb>
  <joint>a</joint>
  <joint>b</joint>
  <bad>fast</bad>
</plugin>"""


@pytest.fixture
def parameters():
    return xml.parse(TEXT, name="p.sdf")


def test_the_default_decides_the_type(parameters):
    assert parameters.get("rate", 1.0) == 20.0
    assert parameters.get("rate", 1) == 20
    assert parameters.get("on", False) is True
    assert parameters.get("name", "") == "left"


def test_absent_and_empty_children_give_the_default(parameters):
    assert parameters.get("none", 3.0) == 3.0
    assert parameters.get("empty", "x") == "x"
    assert parameters.numbers("none", (1.0, 2.0)) == (1.0, 2.0)


def test_slashes_lead_down(parameters):
    assert parameters.get("inner/deep", 0.0) == 1.5
    assert "inner/deep" in parameters
    assert "inner/none" not in parameters


def test_repeated_children_are_kept_in_order(parameters):
    assert [child.text for child in parameters.find_all("joint")] == ["a", "b"]


@pytest.mark.parametrize("default", [1.0, 1, True])
def test_a_wrong_type_names_file_line_and_element(parameters, default):
    with pytest.raises(FormatError) as caught:
        parameters.get("bad", default)
    assert (caught.value.file, caught.value.line) == ("p.sdf", 10)
    assert caught.value.element == "plugin[@name='p']/bad"


def test_required_children_must_be_there(parameters):
    with pytest.raises(FormatError, match="<wheel> is required") as caught:
        parameters.require("wheel", float)
    assert caught.value.line == 1


def test_a_wrong_count_of_numbers_is_an_error(parameters):
    assert parameters.numbers("rgb", (0.0, 0.0, 0.0)) == (1.0, 0.0, 0.5)
    with pytest.raises(FormatError, match="expected 2 numbers"):
        parameters.numbers("rgb", (0.0, 0.0))


@given(st.floats(allow_nan=False))
def test_numbers_survive_the_way_through_text(number):
    node = xml.parse(f"<a><b>{number!r}</b></a>", name="a")
    assert node.get("b", 0.0) == number
