"""Tables of all that comes with Gazelle, from the code.

The directive ``bundled-list KIND`` writes one: robots, worlds, tasks, controllers, or plugins that
are left out or needless.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from gazelle import assets, control
from gazelle.assets.descriptions import description
from gazelle.control import registry as controllers
from gazelle.plugins.table import TABLE
from gazelle.training import list_tasks, listed_recipe

Rows = Iterator[tuple[str, ...]]


def _robots() -> Rows:
    yield "robot", "description"
    yield from ((name, description(path)) for name, path in assets.robots().items())


def _worlds() -> Rows:
    yield "world", "description"
    yield from ((name, description(path)) for name, path in assets.worlds().items())


def _tasks() -> Rows:
    yield "id", "algorithm of its recipe", "control steps"
    for task in list_tasks():
        recipe = listed_recipe(task.id)
        yield task.id, recipe.algo, f"{recipe.steps:,}"


def _plugins_left_out() -> Rows:
    yield "file", "purpose", "what the warning says"
    yield from ((_files(row.files), row.what, row.missing) for row in TABLE if row.missing)


def _needless_plugins() -> Rows:
    yield "file", "purpose", "why there is nothing to do"
    yield from ((_files(row.files), row.what, row.done_by) for row in TABLE if row.done_by)


def _files(stems: Sequence[str]) -> str:
    return " ".join(f"lib{stem}.so" for stem in stems)


def _controllers() -> Rows:
    yield "type", "purpose"
    yield from ((name, controllers.purpose(name)) for name in control.types())


_KINDS: dict[str, Callable[[], Rows]] = {
    "controllers": _controllers,
    "needless-plugins": _needless_plugins,
    "plugins-left-out": _plugins_left_out,
    "robots": _robots,
    "tasks": _tasks,
    "worlds": _worlds,
}


class BundledList(SphinxDirective):
    """Table of one kind of what comes with Gazelle."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        head, *rows = _KINDS[self.arguments[0]]()
        table = nodes.table()
        group = nodes.tgroup(cols=len(head))
        table += group
        group += [nodes.colspec(colwidth=1) for _ in head]
        group += nodes.thead("", _row(head))
        group += nodes.tbody("", *map(_row, rows))
        return [table]


def _row(cells: tuple[str, ...]) -> nodes.row:
    """Return a row, whose first cell is names of code."""
    first, *others = (cell.replace("`", "") for cell in cells)
    names = [
        part for name in first.split() for part in (nodes.literal(name, name), nodes.Text(" "))
    ]
    made = [names, *([nodes.Text(other)] for other in others)]
    return nodes.row("", *(nodes.entry("", nodes.paragraph("", "", *each)) for each in made))


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("bundled-list", BundledList)
    return {"parallel_read_safe": True}
