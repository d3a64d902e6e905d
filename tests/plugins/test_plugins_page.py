"""docs/reference/plugins.md names every plugin, its tags and their defaults, as the code has them."""

import ast
import importlib
import inspect
import re
from pathlib import Path

import pytest

from gazelle.plugins.table import TABLE

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "plugins.md"
READING = {"get", "require", "numbers"}
SIMULATED = [row for row in TABLE if row.code.startswith("gazelle.plugins.")]


def rows():
    """Yield the table rows of simulated plugins: file names, functions, tags."""
    for line in PAGE.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        files = re.findall(r"`lib([\w-]+)\.so`", cells[0])
        if files and len(cells) == 4:
            yield tuple(files), cells[1], cells[2]


def tags_read(module):
    """Yield tags that a module reads by name, and their defaults where they are plain."""
    for node in ast.walk(ast.parse(inspect.getsource(importlib.import_module(module)))):
        if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)):
            continue
        first = node.args[0] if node.args else None
        if node.func.attr in READING and isinstance(first, ast.Constant):
            yield first.value, default_of(node)


def default_of(node):
    """Return a default as the page writes it; None for one that is computed."""
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


def test_the_page_names_the_plugins_that_are_simulated_and_what_they_do():
    assert [row[:2] for row in rows()] == [(row.files, row.what) for row in SIMULATED]
    text = PAGE.read_text()
    assert all(f"lib{name}.so" in text for row in TABLE if row.code for name in row.files)


def test_the_page_lists_what_is_done_instead_of_the_others(monkeypatch):
    """By directives, which write their tables from the code."""
    pytest.importorskip("sphinx")
    monkeypatch.syspath_prepend(str(PAGE.parents[1] / "_extensions"))
    import bundled_lists

    listed = set()
    for kind in re.findall(r"(?m)^```\{bundled-list\} ([\w-]+)", PAGE.read_text()):
        rows = list(bundled_lists._KINDS[kind]())[1:]
        assert all(purpose and instead for _, purpose, instead in rows)
        listed |= {file for files, *_ in rows for file in files.split()}
    others = {f"lib{name}.so" for row in TABLE if not row.code for name in row.files}
    assert listed == others


@pytest.mark.parametrize("module", sorted({row.code.partition(":")[0] for row in SIMULATED}))
def test_the_page_has_the_tags_of_a_module_with_their_defaults(module):
    own = {row.files for row in SIMULATED if row.code.startswith(f"{module}:")}
    text = " ".join(tags for files, _, tags in rows() if files in own)
    for tag, default in tags_read(module):
        assert f"`{tag}`" in text or tag == "name", tag
        if default:
            assert f"`{tag}` ({default})" in text, (tag, default)
