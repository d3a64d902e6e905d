"""Graph of nodes and topics, as rqt_graph draws it."""

from __future__ import annotations

from typing import Any

from gazelle.viewer.graph.panels.diagram import DiagramBox, diagram
from gazelle.viewer.graph.panels.markup import framed
from gazelle.viewer.graph.panels.panel import GraphPanel

_NODES, _BOTH, _ACTIVE = "nodes only", "nodes and topics", "nodes and topics in use"
_QUIET = frozenset(["/rosout", "/rosout_agg", "/clock", "/statistics", "/tf", "/tf_static"])


class NodeGraphPanel(GraphPanel):
    """Nodes as round boxes, topics as boxes, an arrow for each publisher and subscriber."""

    title = "Node graph"
    period = 2.0

    def build(self) -> None:
        """Add the choices and the picture."""
        gui = self.context.gui
        self._show: Any = gui.add_dropdown("Show", (_ACTIVE, _NODES, _BOTH))
        self._part: Any = gui.add_text("Filter", "", hint="Part of a topic's name")
        self._quiet: Any = gui.add_checkbox(
            "Hide tf, rosout, clock", initial_value=True, hint="And this page"
        )
        self._picture: Any = gui.add_html("")
        self._drawn: Any = None
        self.inputs = {"show": self._show, "filter": self._part, "quiet": self._quiet}

    def refresh(self) -> None:
        """Draw the graph if it changed."""
        published, subscribed, _ = self.context.node.master.system_state()
        hidden = {self.context.node.name} if self._quiet.value else set()
        links = {
            topic: (
                sorted(set(published.get(topic, ())) - hidden),
                sorted(set(subscribed.get(topic, ())) - hidden),
            )
            for topic in sorted({*published, *subscribed})
            if self._part.value in topic and not (self._quiet.value and topic in _QUIET)
        }
        state = (self._show.value, links)
        if state != self._drawn:
            self._drawn = state
            self._picture.content = framed(graph_picture(links, self._show.value))


def graph_picture(links: dict[str, tuple[list[str], list[str]]], show: str) -> str:
    """Return the graph as SVG.

    Args:
        links: Publishers and subscribers by topic.
        show: Whether topics are boxes, or names beside arrows.
    """
    nodes = sorted({node for ends in links.values() for side in ends for node in side})
    boxes = {f"node {name}": DiagramBox((name,), round=True) for name in nodes}
    arrows = []
    for topic, (publishers, subscribers) in links.items():
        if show == _NODES:
            arrows += [
                (f"node {start}", f"node {end}", topic)
                for start in publishers
                for end in subscribers
            ]
            continue
        if show == _ACTIVE and not (publishers and subscribers):
            continue
        boxes[f"topic {topic}"] = DiagramBox((topic,))
        arrows += [(f"node {start}", f"topic {topic}", "") for start in publishers]
        arrows += [(f"topic {topic}", f"node {end}", "") for end in subscribers]
    return diagram(boxes, arrows)
