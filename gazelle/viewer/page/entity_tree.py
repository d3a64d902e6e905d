"""Tree of models, links, joints, sensors and lights on the page."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from html import escape
from typing import Any, NamedTuple

from gazelle.description import Link, Model, World
from gazelle.viewer.page.context import PageContext, ScenePart
from gazelle.viewer.page.server import PageServer

_MOST = 1000  # rows

_BOX = """
<div id="gazelle-tree" role="tree" style="max-height:38vh;overflow:auto;margin:0 0.8em;font-size:0.85em"
 onscroll="window.gazelleTree=this.scrollTop"
 onclick="const r=event.target.closest('[data-name]');
  if(r)fetch('select?kind='+r.dataset.kind+'&name='+encodeURIComponent(r.dataset.name)).catch(()=>0)"
 onkeydown="if(event.key=='Enter')event.target.click()">{rows}</div>
<img alt="" style="display:none" src="data:," onerror="const t=document.getElementById('gazelle-tree');
 t.scrollTop=window.gazelleTree||0;
 const s=t.querySelector('[aria-selected=true]');if(s)s.scrollIntoView({{block:'nearest'}})">
"""
_ROW = (
    '<div role="treeitem" tabindex="0" aria-selected="{chosen}" data-kind="{kind}" data-name="{name}"'
    ' title="{name}" style="padding:0.1em 0.3em 0.1em {indent}em;cursor:pointer;white-space:nowrap;'
    'overflow:hidden;text-overflow:ellipsis;border-radius:3px;background:{background}">{label}'
    '<span style="opacity:0.5">&ensp;{kind}</span></div>'
)
_CHOSEN = "var(--mantine-primary-color-light)"


class TreeRow(NamedTuple):
    """A line of the tree.

    Attributes:
        depth: Number of parents.
        part: Selected by a click on it.
    """

    depth: int
    part: ScenePart


def rows_of(world: World, model: str, part: ScenePart) -> Iterator[TreeRow]:
    """Yield the world, its lights and models, and the parts of the selected model."""
    yield TreeRow(0, ScenePart("world", world.name))
    for light in world.lights:
        yield TreeRow(1, ScenePart("light", light.name))
    for each in world.models:
        yield TreeRow(1, ScenePart("model", each.name))
        if each.name == model:
            yield from _rows_of_model(each, part)


def _rows_of_model(model: Model, part: ScenePart) -> Iterator[TreeRow]:
    for placed in model.walk():
        scope, inner = placed.scope, placed.model
        for link in inner.links:
            yield from _rows_of_link(f"{scope}::{link.name}", link, part)
        for joint in inner.joints:
            name = f"{scope}::{joint.name}"
            yield TreeRow(2, ScenePart("joint", name))
            for sensor in joint.sensors:
                yield TreeRow(3, ScenePart("sensor", f"{name}::{sensor.name}"))


def _rows_of_link(name: str, link: Link, part: ScenePart) -> Iterator[TreeRow]:
    """Yield a link and its sensors; its collisions too if it or one of its parts is selected."""
    yield TreeRow(2, ScenePart("link", name))
    for sensor in link.sensors:
        yield TreeRow(3, ScenePart("sensor", f"{name}::{sensor.name}"))
    if part.name == name or part.name.startswith(f"{name}::"):
        for collision in link.collisions:
            yield TreeRow(3, ScenePart("collision", f"{name}::{collision.name}"))


class EntityTree:
    """Shows the tree, and selects what is clicked in it.

    Args:
        context: Of the page.
        server: Gets the clicks.
    """

    def __init__(self, context: PageContext, server: PageServer) -> None:
        self._context = context
        self._shown: Any = context.gui.add_html("")
        self._content = ""
        server.handlers["select"] = self._select
        context.listeners.append(self.renew)
        self.renew()

    def read(self) -> None:
        """Do nothing: the tree changes with models and the selection only."""

    def show(self, _state: None) -> None:
        """Show the tree if it changed."""
        if self._shown.content != self._content:
            self._shown.content = self._content

    def renew(self) -> None:
        """Make the rows again, after models or the selection changed."""
        context = self._context
        rows = list(rows_of(context.simulation.world, context.selected, context.part))
        lines = [_line(row, context.part) for row in rows[:_MOST]]
        if len(rows) > _MOST:
            lines.append(f"<div>and {len(rows) - _MOST} more</div>")
        self._content = _BOX.format(rows="".join(lines))

    def _select(self, query: Mapping[str, str]) -> None:
        """Select a part; on the server's thread."""
        part, context = ScenePart(query.get("kind", ""), query.get("name", "")), self._context
        inside = part.kind not in ("world", "light")
        context.select(part.name.split("::")[0] if inside else "", context.world, part)


def _line(row: TreeRow, chosen: ScenePart) -> str:
    is_chosen = row.part == chosen
    return _ROW.format(
        chosen=str(is_chosen).lower(),
        kind=escape(row.part.kind, quote=True),
        name=escape(row.part.name, quote=True),
        label=escape(row.part.name.rpartition("::")[2]),
        indent=0.3 + row.depth,
        background=_CHOSEN if is_chosen else "none",
    )
