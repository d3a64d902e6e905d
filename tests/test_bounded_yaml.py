"""YAML made to do harm is one error, soon, whoever reads it."""

import pytest
import yaml

from gazelle import formats
from gazelle.errors import FormatError
from gazelle_ros import load_message
from gazelle_ros.base import bounded_yaml
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.values import load_yaml, load_yaml_documents
from gazelle_ros.messages import MessageException
from gazelle_ros.messages.yaml import from_yaml

BOMB = "a: &a [x, x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"{name}: &{name} [{', '.join([f'*{before}'] * 10)}]\n"
    for before, name in zip("abcdefghi", "bcdefghij", strict=True)
)
HARMFUL = {
    "aliases": (BOMB, "more than the limit of 1,000,000"),
    "keys": (BOMB.replace("[", "{p: [").replace("]", "]}"), "more than the limit of 1,000,000"),
    "itself": ("a: &x {b: *x}", "contains itself"),
    "list": ("&a [*a]", "contains itself"),
    "longer ring": ("a: &a {b: &b [1, {c: *a}]}", "contains itself"),
    "flow": ("[" * 200_000 + "]" * 200_000, "nested more than 100 levels"),
    "open": ("[" * 30_000, "nested more than 100 levels"),
    "dashes": ("- " * 5_000 + "x", "nested more than 100 levels"),
    "mappings": ("{a: " * 5_000 + "}" * 5_000, "nested more than 100 levels"),
}
READERS = {
    "safe_load": (bounded_yaml.safe_load, yaml.YAMLError),
    "safe_load_all": (lambda text: list(bounded_yaml.safe_load_all(text)), yaml.YAMLError),
    "launch": (load_yaml, LaunchError),
    "documents": (load_yaml_documents, LaunchError),
    "message": (lambda text: from_yaml(load_message("std_msgs/String"), text), MessageException),
}


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("name", HARMFUL)
def test_what_has_no_end_is_refused(name, reader):
    text, complaint = HARMFUL[name]
    read, error = READERS[reader]
    with pytest.raises(error, match=complaint):
        read(text)


@pytest.mark.parametrize("name", HARMFUL)
def test_xacro_reads_no_such_file(tmp_path, name):
    (tmp_path / "bomb.yaml").write_text(HARMFUL[name][0])
    file = tmp_path / "robot.xacro"
    file.write_text(
        "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>"
        "<xacro:property name='p' value=\"${xacro.load_yaml('bomb.yaml')}\"/>"
        "<link name='${len(str(p))}'/></robot>"
    )
    with pytest.raises(FormatError, match=HARMFUL[name][1]):
        formats.load(file)


@pytest.mark.parametrize("read", [bounded_yaml.safe_load, load_yaml])
def test_aliases_that_make_little_are_taken(read):
    assert read("[&a {b: [1, 2]}, *a, {<<: *a, c: 3}]") == [
        {"b": [1, 2]},
        {"b": [1, 2]},
        {"b": [1, 2], "c": 3},
    ]
    assert read("") is None
    assert len(read("\n".join(f"k{i}: [1, 2, 3]" for i in range(300)))) == 300


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("text", ["data: \udcff", "data: \0"])
def test_bytes_that_are_no_text_are_refused(text, reader):
    read, error = READERS[reader]
    with pytest.raises(error, match=r"not UTF-8, or a null"):
        read(text)


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize(
    "value",
    ["!!int ''", "!!float a", "!!timestamp 1", "2001-99-99", "!!bool x", "9" * 5000, "!!int 0x"],
    ids=lambda value: value[:12],
)
def test_values_that_their_tag_does_not_allow(value, reader):
    read, error = READERS[reader]
    with pytest.raises(error, match=r"is not a value of the kind|not valid YAML|not YAML"):
        read(f"data: {value}")
