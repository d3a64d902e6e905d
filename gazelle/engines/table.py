"""Rows of links, joints or models, looked up once by their names."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, Generic, TypeVar, cast, overload

Row_co = TypeVar("Row_co", covariant=True)
Rows_co = TypeVar("Rows_co", covariant=True)
Layout = TypeVar("Layout")
Places = TypeVar("Places")

_MOST = 4096  # rows that are kept


class Table(Generic[Row_co, Rows_co]):
    """Links, joints or models of an engine, by their scoped names.

    ``table["burger::base"]`` is one row with arrays of shape (n, ...); a tuple of names gives
    several rows with arrays of shape (n, rows, ...). Rows stay good when models come and go.

    Args:
        names: Returns the names of all rows.
        one: Makes one row from its name.
        many: Makes several rows from their names.
    """

    def __init__(
        self,
        names: Callable[[], Iterable[str]],
        one: Callable[[str], Row_co],
        many: Callable[[tuple[str, ...]], Rows_co],
    ) -> None:
        self._names, self._one, self._many = names, one, many
        self._known: dict[str | tuple[str, ...], Any] = {}
        self._listed: tuple[Iterable[str], frozenset[str]] = ((), frozenset())

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all rows."""
        return tuple(self._names())

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names of all rows."""
        return iter(self._names())

    def __contains__(self, name: object) -> bool:
        """Return whether there is a row of a name."""
        names = self._names()
        if names is not self._listed[0]:  # an engine that is unchanged gives the same tuple
            self._listed = names, frozenset(names)
        return name in self._listed[1]

    @overload
    def __getitem__(self, names: str) -> Row_co: ...

    @overload
    def __getitem__(self, names: tuple[str, ...]) -> Rows_co: ...

    def __getitem__(self, names: str | tuple[str, ...]) -> Row_co | Rows_co:
        """Return one row, or several; a name that is not there is an error when it is used."""
        known = self._known.get(names)
        if known is None:
            if len(self._known) >= _MOST:
                self._known.clear()
            known = self._one(names) if isinstance(names, str) else self._many(names)
            self._known[names] = known
        found: Row_co | Rows_co = known
        return found


class Lookup(Generic[Layout, Places]):
    """Places of rows in an engine's arrays, looked up once for each layout.

    Args:
        find: Looks them up in a layout.
    """

    def __init__(self, find: Callable[[Layout], Places]) -> None:
        self._find = find
        self._layout: Layout | None = None
        self._places: Places | None = None

    def within(self, layout: Layout) -> Places:
        """Return the places in a layout; another object is another layout."""
        if layout is not self._layout:
            self._places = self._find(layout)
            self._layout = layout
        return cast("Places", self._places)
