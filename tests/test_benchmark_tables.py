"""Tables of benchmarks in the docs: what they are of, and how they are refreshed."""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

import pytest

from gazelle.cli.bench import benchmarks

ROOT = Path(__file__).parents[1]
SOURCE = re.compile(
    r"20\d\d-\d\d-\d\d[^\n,]*(?:, on a quiet processor\))?, commit [0-9a-f]{12}, Python 3\."
)


@pytest.fixture
def update(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "tools"))
    import update_benchmarks

    yield update_benchmarks
    for name in ("update_benchmarks", "_checkout"):
        sys.modules.pop(name, None)


def test_each_table_names_its_day_and_commit(update):
    found = []
    for page in update.PAGES:
        for table in update.BLOCK.finditer((ROOT / "docs" / page).read_text()):
            assert SOURCE.search(table["text"]), f"{page}, {table['name']}"
            found.append(table["name"])
    assert {"env", "physics", "workers", "contacts"} <= set(found)


def test_each_table_has_a_benchmark_that_prints_it(update):
    for table in update.tables():
        assert table.name == "contacts" or table.name in benchmarks(), table


def test_each_block_of_figures_stands_behind_its_command(update):
    """A block that looks like a benchmark's and has no mark is never measured again."""
    text = (ROOT / "docs" / "explanation" / "benchmarks.md").read_text()
    heads = re.findall(r"(?m)^```text\n20\d\d-", text)
    assert len(heads) == sum(table.page.name == "benchmarks.md" for table in update.tables())


@pytest.mark.parametrize("name", ["env", "learner", "contacts"])
def test_a_refresh_replaces_that_table_alone(update, name, monkeypatch, tmp_path):
    calls = []
    monkeypatch.setattr(update, "printed", lambda *words: calls.append(words) or "| new |\n|---|")
    monkeypatch.setattr(update, "commit", lambda: "f" * 12)
    (table,) = [each for each in update.tables() if each.name == name]
    page = tmp_path / table.page.name
    shutil.copy(table.page, page)
    before = {each["name"]: each["text"] for each in update.BLOCK.finditer(page.read_text())}
    update.Table(page, name, table.arguments).refresh()
    after = {each["name"]: each["text"] for each in update.BLOCK.finditer(page.read_text())}
    assert "| new |" in after[name]
    assert SOURCE.search(after[name])
    assert "f" * 12 in after[name]
    assert {key: text for key, text in after.items() if key != name} == {
        key: text for key, text in before.items() if key != name
    }
    words = table.arguments.split()
    assert list(calls[0])[len(calls[0]) - len(words) :] == words
