"""Panel with the properties of the selected part."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from html import escape
from typing import Any

from gazelle.errors import Error
from gazelle.viewer.page.context import PageContext
from gazelle.viewer.page.live_input import LiveInput
from gazelle.viewer.page.part_properties import PartProperty, Value, properties_of

_PERIOD = 0.2  # wall time between two readings [s]
_CLOSE = 1e-5
_HINT = "Click a row above, or a thing in the scene: once for a model, twice for a link."
_TABLE = '<table id="gazelle-facts" style="margin:0 0.8em;font-size:0.85em">{rows}</table>'
_FACT = '<tr><td style="opacity:0.6;padding-right:1em">{label}</td><td>{value}</td></tr>'


class _Field:
    """An input for a property.

    Args:
        context: Of the page.
        shown: The input.
        changed: Called after a user changed the property.

    Attributes:
        input: Follows the property.
        what: Property that it shows.
    """

    def __init__(self, context: PageContext, shown: Any, changed: Callable[[], None]) -> None:
        self.what: PartProperty | None = None
        self._after = changed
        self.input = LiveInput(context, shown, self._write)

    def show(self, value: Value) -> None:
        """Show a value that changed by itself."""
        before = float(self.input.shown.value)
        if not math.isclose(before, float(value), rel_tol=_CLOSE, abs_tol=_CLOSE):
            self.input.show(self._rounded(value))

    def begin(self, what: PartProperty, value: Value) -> None:
        """Show another property."""
        self.what, shown = what, self.input.shown
        shown.label, shown.visible = what.label, True
        if isinstance(value, float):
            shown.precision = digits = min(_decimals(value), what.decimals)
            shown.step = min(what.step, 10.0 ** (2 - digits))
        self.input.send(self._rounded(value))

    def _rounded(self, value: Value) -> Value:
        """Return a number with as many digits as the field shows, and zero without a sign."""
        if not isinstance(value, float):
            return value
        shown: float = round(float(f"{value:.6g}"), self.input.shown.precision)
        return shown + 0.0

    def _write(self, value: Value) -> None:
        try:
            if self.what is not None and self.what.write is not None:
                self.what.write(value)
        finally:
            self._after()


class PropertyPanel:
    """Shows properties as inputs and as text, and sets what a user changes.

    Inputs are used again for other parts, since a page reports an error where an input is removed
    at the moment that its value changes.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context = context
        self._folder = context.gui.add_folder("Properties")
        with self._folder:
            self._hint = context.gui.add_markdown(_HINT)
            self._facts: Any = context.gui.add_html("")
        self._numbers: list[_Field] = []
        self._boxes: list[_Field] = []
        self._fixed: list[PartProperty] = []
        self._set: list[tuple[PartProperty, _Field]] = []
        self._next = 0.0
        context.listeners.append(self.renew)

    def read(self) -> tuple[list[Value], list[Value]] | None:
        """Return the values of texts and of inputs; None before the next ones are due."""
        now = time.monotonic()
        if now < self._next:
            return None
        self._next = now + _PERIOD
        try:
            return [each.read() for each in self._fixed], [each.read() for each, _ in self._set]
        except Error:  # deleted by another thread just now
            return None

    def show(self, state: tuple[list[Value], list[Value]] | None) -> None:
        """Show the values that changed."""
        if state is None:
            return
        rows = [
            _FACT.format(label=escape(each.label), value=escape(str(value)))
            for each, value in zip(self._fixed, state[0], strict=True)
        ]
        table = _TABLE.format(rows="".join(rows)) if rows else ""
        if self._facts.content != table:
            self._facts.content = table
        for (_, each), value in zip(self._set, state[1], strict=True):
            each.show(value)

    def renew(self) -> None:
        """Use the inputs for the part that is selected now."""
        part = self._context.part
        found = list(properties_of(self._context, part))
        self._fixed = [each for each in found if each.write is None]
        self._set, self._next = [], 0.0
        self._hint.visible = not part.kind
        values = [(each, each.read()) for each in found if each.write is not None]
        flags = [(each, value) for each, value in values if isinstance(value, bool)]
        numbers = [(each, value) for each, value in values if not isinstance(value, bool)]
        with self._context.page.atomic():  # no label beside the value of another part
            self._fill(self._numbers, numbers, self._number)
            self._fill(self._boxes, flags, self._box)

    def _fill(
        self, pool: list[_Field], values: list[tuple[PartProperty, Any]], make: Callable[[], Any]
    ) -> None:
        """Show values in the inputs of a pool, which grows, and hide the others."""
        while len(pool) < len(values):
            with self._folder:
                pool.append(_Field(self._context, make(), self._read_soon))
        for each, (what, value) in zip(pool, values, strict=False):
            each.begin(what, value)
            self._set.append((what, each))
        for each in pool[len(values) :]:
            each.what, each.input.shown.visible = None, False

    def _number(self) -> Any:
        locked = self._context.read_only
        return self._context.gui.add_number("", 0.0, step=0.001, disabled=locked)

    def _box(self) -> Any:
        return self._context.gui.add_checkbox("", False, disabled=self._context.read_only)

    def _read_soon(self) -> None:
        """Show with the next picture what the simulation made of a change."""
        self._next = 0.0


def _decimals(value: float) -> int:
    """Return as many decimals as show four digits of a number, at least three."""
    return 3 if value == 0.0 else min(12, max(3, 3 - math.floor(math.log10(abs(value)))))
