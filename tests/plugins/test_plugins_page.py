"""docs/plugins.md names every plugin, its tags and their defaults, as the code has them."""

import ast
import importlib
import inspect
import re
from importlib.metadata import entry_points
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "plugins.md"
READING = {"get", "require", "numbers"}


def rows():
    """The rows of all tables: file names, and the text of the tags."""
    for line in PAGE.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        files = re.findall(r"`lib([\w-]+)\.so`", cells[0])
        if files and len(cells) == 4:
            yield set(files), cells[2]


def bundled():
    """File names and classes that come with Gazelle's plugins."""
    points = entry_points(group="gazelle.plugins")
    return {p.name: p.value for p in points if p.value.startswith("gazelle.plugins.")}


def tags_read(module):
    """Tags that a module reads by name, and their defaults where they are plain."""
    for node in ast.walk(ast.parse(inspect.getsource(importlib.import_module(module)))):
        if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)):
            continue
        first = node.args[0] if node.args else None
        if node.func.attr in READING and isinstance(first, ast.Constant):
            yield first.value, default_of(node)


def default_of(node):
    """As the page writes it; None for one that is computed."""
    if node.func.attr == "require":
        return None
    try:
        value = ast.literal_eval(node.args[1])
    except (ValueError, IndexError):
        return None
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return " ".join(f"{each:g}" for each in value)
    return value if isinstance(value, str) else f"{value:.10g}"


def test_the_page_names_the_plugins_that_there_are():
    named = [name for files, _ in rows() for name in files]
    assert sorted(named) == sorted(bundled())


@pytest.mark.parametrize(
    "module", sorted({value.partition(":")[0] for value in bundled().values()})
)
def test_the_page_has_the_tags_of_a_module_with_their_defaults(module):
    own = {name for name, value in bundled().items() if value.startswith(f"{module}:")}
    text = " ".join(tags for files, tags in rows() if files & own)
    for tag, default in tags_read(module):
        assert f"`{tag}`" in text or tag == "name", tag
        if default:
            assert f"`{tag}` ({default})" in text, (tag, default)
