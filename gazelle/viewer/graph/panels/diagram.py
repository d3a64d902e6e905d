"""Diagrams of boxes and arrows as SVG, in layers from top to bottom."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape

_CHARACTER_PX, _LINE_PX = 6.6, 15.0
_GAP_X, _GAP_Y, _MARGIN = 16.0, 44.0, 6.0
_SWEEPS = 4
_PX_PER_PANEL = 430.0  # wider diagrams are shrunk to it, but not below half


@dataclass(frozen=True, slots=True)
class DiagramBox:
    """A box with lines of text.

    Attributes:
        lines: Texts, the first in bold.
        round: Whether it has round ends.
    """

    lines: tuple[str, ...]
    round: bool = False

    @property
    def size(self) -> tuple[float, float]:
        """Width and height in pixels."""
        wide = max(len(line) for line in self.lines) * _CHARACTER_PX + 2.0 * _MARGIN + 6.0
        return wide, len(self.lines) * _LINE_PX + 2.0 * _MARGIN


Arrow = tuple[str, str, str]
"""Names of both boxes, and a text beside the arrow."""


def diagram(boxes: Mapping[str, DiagramBox], arrows: Sequence[Arrow]) -> str:
    """Return a diagram as SVG.

    Args:
        boxes: By name.
        arrows: Between them; those of unknown boxes are left out.
    """
    known = [each for each in arrows if each[0] in boxes and each[1] in boxes]
    places = _place(boxes, known)
    wide = max((x + boxes[name].size[0] / 2 for name, (x, _) in places.items()), default=0.0)
    high = max((y + boxes[name].size[1] for name, (_, y) in places.items()), default=0.0)
    wide, high = wide + _MARGIN, high + _MARGIN
    shown = max(min(wide, _PX_PER_PANEL), wide / 2.0)
    parts = [_arrow(boxes, places, each) for each in known]
    parts += [_box(box, *places[name]) for name, box in boxes.items()]
    head = (
        '<defs><marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" '
        'markerHeight="7" orient="auto"><path d="M0 0L8 4L0 8z" fill="currentColor"/></marker></defs>'
    )
    return (
        f'<svg width="{shown:.0f}" viewBox="0 0 {wide:.0f} {high:.0f}" font-size="11" '
        f'font-family="sans-serif" fill="currentColor">{head}{"".join(parts)}</svg>'
    )


def layers_of(names: Sequence[str], arrows: Sequence[Arrow]) -> list[list[str]]:
    """Return names in layers, so that arrows lead downwards but for those that close a loop.

    >>> layers_of(["a", "b", "c"], [("a", "b", ""), ("b", "c", ""), ("c", "a", "")])
    [['a'], ['b'], ['c']]
    """
    below: dict[str, list[str]] = {name: [] for name in names}
    for start, end, _ in arrows:
        if start != end:
            below[start].append(end)
    order = _depth_first(names, below)
    rank = {name: number for number, name in enumerate(order)}
    depth = dict.fromkeys(names, 0)
    for name in order:
        for each in below[name]:
            if rank[each] > rank[name]:
                depth[each] = max(depth[each], depth[name] + 1)
    layers: list[list[str]] = [[] for _ in range(max(depth.values(), default=-1) + 1)]
    for name in names:
        layers[depth[name]].append(name)
    return layers


def _depth_first(names: Sequence[str], below: Mapping[str, Sequence[str]]) -> list[str]:
    """Return names so that arrows lead forwards, but for those that close a loop."""
    targets = {each for ends in below.values() for each in ends}
    finished, begun = list[str](), set[str]()
    for root in (*(name for name in names if name not in targets), *names):
        if root in begun:
            continue
        begun.add(root)
        pending = [(root, iter(below[root]))]
        while pending:
            name, rest = pending[-1]
            each = next(rest, None)
            if each is None:
                finished.append(name)
                pending.pop()
            elif each not in begun:
                begun.add(each)
                pending.append((each, iter(below[each])))
    return finished[::-1]


def _place(
    boxes: Mapping[str, DiagramBox], arrows: Sequence[Arrow]
) -> dict[str, tuple[float, float]]:
    """Return middle of the upper edge of each box: beside its neighbours, in layers."""
    layers = layers_of(list(boxes), arrows)
    near: dict[str, list[str]] = {name: [] for name in boxes}
    for start, end, _ in arrows:
        near[start].append(end)
        near[end].append(start)
    x = {name: float(number) for layer in layers for number, name in enumerate(layer)}
    for _ in range(_SWEEPS):
        for layer in layers:
            layer.sort(
                key=lambda name: (
                    sum(x[each] for each in near[name]) / len(near[name]) if near[name] else x[name]
                )
            )
            x |= _row(boxes, layer)
    widest = max((x[layer[-1]] + boxes[layer[-1]].size[0] / 2 for layer in layers), default=0.0)
    places, y = dict[str, tuple[float, float]](), _MARGIN
    for layer in layers:
        used = x[layer[-1]] + boxes[layer[-1]].size[0] / 2
        for name in layer:
            places[name] = (x[name] + (widest - used) / 2.0, y)
        y += max(boxes[name].size[1] for name in layer) + _GAP_Y
    return places


def _row(boxes: Mapping[str, DiagramBox], layer: Sequence[str]) -> dict[str, float]:
    """Return the middles of boxes beside each other."""
    found, left = dict[str, float](), _MARGIN
    for name in layer:
        wide = boxes[name].size[0]
        found[name] = left + wide / 2.0
        left += wide + _GAP_X
    return found


def _box(box: DiagramBox, x: float, y: float) -> str:
    wide, high = box.size
    corner = high / 2.0 if box.round else 3.0
    texts = "".join(
        f'<text x="{x:.1f}" y="{y + _MARGIN + 11 + number * _LINE_PX:.1f}" text-anchor="middle"'
        f"{' font-weight=' + chr(34) + '600' + chr(34) if number == 0 else ''}>{escape(line)}</text>"
        for number, line in enumerate(box.lines)
    )
    return (
        f'<rect x="{x - wide / 2:.1f}" y="{y:.1f}" width="{wide:.1f}" height="{high:.1f}" '
        f'rx="{corner:.1f}" fill="none" stroke="currentColor"/>{texts}'
    )


def _arrow(
    boxes: Mapping[str, DiagramBox], places: Mapping[str, tuple[float, float]], arrow: Arrow
) -> str:
    start, end, text = arrow
    (x1, y1), (x2, y2) = places[start], places[end]
    if y2 > y1:
        y1 += boxes[start].size[1]
    else:  # upwards, or beside: from the sides
        x1 += boxes[start].size[0] / 2.0
        x2 += boxes[end].size[0] / 2.0
        y1 += boxes[start].size[1] / 2.0
        y2 += boxes[end].size[1] / 2.0
    bend = 18.0 if y2 > y1 else 0.0
    aside = 0.0 if y2 > y1 else 30.0
    path = (
        f"M{x1:.1f} {y1:.1f}C{x1 + aside:.1f} {y1 + bend:.1f} "
        f"{x2 + aside:.1f} {y2 - bend:.1f} {x2:.1f} {y2:.1f}"
    )
    label = (
        f'<text x="{(x1 + x2) / 2 + 4:.1f}" y="{(y1 + y2) / 2:.1f}" opacity="0.75">{escape(text)}</text>'
        if text
        else ""
    )
    return (
        f'<path d="{path}" fill="none" stroke="currentColor" opacity="0.55" '
        f'marker-end="url(#tip)"/>{label}'
    )
