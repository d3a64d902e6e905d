"""Tree of frames with rates and ages, as rqt_tf_tree draws it."""

from __future__ import annotations

from typing import Any

from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.graph.panels.diagram import DiagramBox, diagram
from gazelle.viewer.graph.panels.markup import framed
from gazelle.viewer.graph.panels.panel import GraphPanel
from gazelle_ros.tf import FrameTree


class TfTreePanel(GraphPanel):
    """Frames, who publishes them, how often, and how old the latest transform is.

    Args:
        context: Of the page.
    """

    title = "tf tree"
    period = 2.0

    def __init__(self, context: GraphContext) -> None:
        super().__init__(context)
        self._drawn = ""

    def build(self) -> None:
        """Add the image of the tree to the page."""
        self._text: Any = self.context.gui.add_markdown("")
        self._picture: Any = self.context.gui.add_html("")

    def refresh(self) -> None:
        """Draw the tree if it changed."""
        tree = self.context.tree
        now = self.context.stamp().to_nsec()
        picture = framed(tree_picture(tree, now))
        if picture == self._drawn:
            return
        self._drawn = self._picture.content = picture
        roots = roots_of(tree)
        self._text.content = (
            f"⚠ {len(roots)} trees that no transform connects: {', '.join(roots)}"
            if len(roots) > 1
            else f"{len(tree.names())} frames"
        )


def roots_of(tree: FrameTree) -> list[str]:
    """Return the frames without a parent."""
    children = {name for name, _, cache in tree.known() if cache.latest()}
    return [name for name in tree.names() if name not in children]


def tree_picture(tree: FrameTree, now: int) -> str:
    """Return the tree as SVG.

    Args:
        tree: Of frames.
        now: The present time [ns].
    """
    boxes = {name: DiagramBox((name,)) for name in tree.names()}
    arrows = []
    for name, authority, cache in tree.known():
        latest = cache.latest()
        if latest is None:
            continue
        stamp, parent = latest
        count, oldest, newest = cache.span()
        lines = [name, authority]
        if stamp == 0:
            lines.append("static")
        else:
            length = (newest - oldest) * 1e-9
            rate = (count - 1) / length if length > 0.0 else 0.0
            lines.append(f"{rate:.0f} Hz, {max(now - stamp, 0) * 1e-9:.1f} s old")
        boxes[name] = DiagramBox(tuple(filter(None, lines)))
        arrows.append((parent, name, ""))
    return diagram(boxes, arrows)
