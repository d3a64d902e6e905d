"""Launch files and YAML with characters pasted from web pages, and advice on what is not well-formed."""

import warnings

import pytest

from gazelle_ros.base.errors import FormatWarning
from gazelle_ros.launch.document import parse_document
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.loader import load_launch
from gazelle_ros.launch.values import load_yaml, load_yaml_documents

BLANKS = ("\u00a0", "\u2009", "\u3000", "\u202f")
MESSAGE = "no-break space or another unusual blank, which was taken as a space"


def one_warning(call, *arguments):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = call(*arguments)
    assert [each.category for each in caught] == [FormatWarning]
    return result, str(caught[0].message)


@pytest.mark.parametrize("blank", BLANKS)
@pytest.mark.parametrize(
    "text",
    [
        "<launch>\n<param{}name='a' value='1'/></launch>",
        "<launch>\n<param name='a'{0}{0}value='1'/>{0}</launch>",
        "<launch>\n{}<param name='a' value='1'/>\n</launch>",
        "<launch>\n<param name='a' value='{}1'/></launch>",
    ],
)
def test_a_blank_that_nobody_types_is_a_space_with_one_warning(text, blank):
    root, said = one_warning(parse_document, text.format(blank).encode(), "x.launch")
    assert said.startswith("x.launch:2:")
    assert MESSAGE in said
    (param,) = root.all("param")
    assert param.attributes["value"].strip(" ") == "1"


def test_blanks_in_comments_are_nobodys_business():
    text = "<launch><!-- \u00a0 --><param name='a' value='1'/></launch>"
    assert parse_document(text.encode(), "x.launch").find("param") is not None


@pytest.mark.parametrize(
    ("line", "hint"),
    [
        ("<param name=\u201ca\u201d value='1'/>", "\u201c is a curly quote: write a straight one"),
        ("<param name='a' value=\u20181\u2019/>", "\u2018 is a curly quote"),
        ("<param name='a' value='1 & 2'/>", "write & as &amp;"),
        ("<param name=a value='1'/>", "write values in quotes"),
        ("<!-- a -- b -->", "-- may not stand in a comment"),
        ("<?xml version='1.0'?>", "at the very beginning"),
        ("<group><param name='a' value='1'/>", "<group> of line 2 is not closed"),
    ],
)
def test_what_is_not_well_formed_comes_with_advice(line, hint):
    with pytest.raises(LaunchError) as caught:
        parse_document(f"<launch>\n{line}\n</launch>".encode(), "x.launch")
    assert "not well-formed" in caught.value.message
    assert hint in caught.value.hint


def test_a_file_that_ends_early_and_one_in_another_encoding_come_with_advice():
    with pytest.raises(LaunchError, match="<group> of line 3 is not closed"):
        parse_document(b"<launch>\n\n<group>\n", "x.launch")
    latin = "<launch><!-- gr\u00f6\u00dfe --></launch>".encode("latin-1")
    with pytest.raises(LaunchError, match="save it as UTF-8, or name its encoding"):
        parse_document(latin, "x.launch")
    named = b"<?xml version='1.0' encoding='latin-1'?>" + latin
    assert parse_document(named, "x.launch").tag == "launch"


@pytest.mark.parametrize("read", [load_yaml, lambda text, name: load_yaml_documents(text, name)[0]])
def test_yaml_takes_such_blanks_and_names_curly_quotes(read):
    value, said = one_warning(read, "a: 1  # \u00a0\nb:\n\u00a0 c:\u00a02\n", "x.yaml")
    assert value == {"a": 1, "b": {"c": 2}}
    assert said.startswith("x.yaml:3:")
    assert MESSAGE in said
    value, said = one_warning(read, "# \u201cno\u201d\na: 1\nb: \u201cx\u201d\n", "x.yaml")
    assert value == {"a": 1, "b": "\u201cx\u201d"}
    assert said.startswith("x.yaml:3:")
    assert "curly quote" in said


def test_plain_yaml_says_nothing():
    texts = (
        "a: 1\n# \u00a0\n",
        "a: he said \u201cno\u201d to it\n",
        "# \u201cquoted\u201d\na: 'x'\n",
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for text in texts:
            load_yaml(text, "x.yaml")


def test_yaml_with_tabs_says_so():
    with pytest.raises(LaunchError) as caught:
        load_yaml("a:\n\tb: 1\n", "x.yaml")
    assert "in line 2" in caught.value.message
    assert caught.value.hint == "indent by spaces: YAML takes no tabs"


def test_warnings_name_the_file_and_line_of_what_a_launch_file_loads(tmp_path):
    (tmp_path / "x.yaml").write_text("a: 1\nb:\u00a02\n", encoding="utf-8")
    file = tmp_path / "x.launch"
    file.write_text("<launch>\n<rosparam file='$(dirname)/x.yaml'/>\n</launch>")
    plan, said = one_warning(load_launch, str(file))
    assert {each.name: each.value for each in plan.parameters.values()}["/b"] == 2
    assert said.startswith(f"{tmp_path}/x.yaml:2:")
    file.write_text("<launch>\n<rosparam>\na: 1\nb: \u201cx\u201d\n</rosparam>\n</launch>")
    _, said = one_warning(load_launch, str(file))
    assert said.startswith(f"{file}:4:")
