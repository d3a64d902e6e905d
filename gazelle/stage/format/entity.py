"""Entities of a Stage file, with properties and child entities."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from gazelle.description import Source
from gazelle.errors import FormatError
from gazelle.stage.format.lexer import Script, Token, Value, parse_value

Kind = type[FormatError]


class Property(NamedTuple):
    """A property as written, parsed at access.

    Attributes:
        script: File it is in.
        name: Its name.
        token: Its value.
        offset: Offset of its name.
    """

    script: Script
    name: str
    token: Token
    offset: int

    @property
    def value(self) -> Value:
        """The value.

        Raises:
            FormatError: It is a tuple of something else than numbers and strings.
        """
        return parse_value(self.script, self.token)

    @property
    def source(self) -> Source:
        """Source location."""
        return self.script.source(self.offset, self.name)

    def fail(self, message: str, hint: str | None = None, kind: Kind = FormatError) -> FormatError:
        """Return the error to raise about it."""
        return kind(message, source=self.source, hint=hint)


@dataclass(slots=True, eq=False)
class Entity:
    """``TYPE ( ... )``, with what macros put into it.

    Attributes:
        type: Its type, macros followed to their base.
        word: The type as written, which may be a macro's name.
        script: File it is in.
        offset: Its offset.
        macro: The macro it is made of; None without one.
        own: The properties written in it, by name; of several the last.
        children: The entities written in it.
        total: Entities in it and below, those of macros and itself too.
        macros: The macros that it could be made of, by name.
    """

    type: str
    word: str
    script: Script
    offset: int
    macro: Entity | None = None
    own: dict[str, Property] = field(default_factory=dict)
    children: list[Entity] = field(default_factory=list)
    total: int = 1
    macros: Mapping[str, Entity] = field(default_factory=dict)

    @property
    def properties(self) -> Mapping[str, Property]:
        """Properties of its own and those of its macros that it does not override."""
        if self.macro is None:
            return self.own
        return {**self.macro.properties, **self.own}

    @property
    def parts(self) -> list[Entity]:
        """The entities of its macros and its own."""
        return self.children if self.macro is None else [*self.macro.parts, *self.children]

    @property
    def source(self) -> Source:
        """Source location."""
        return self.script.source(self.offset, self.word)

    def fail(self, message: str, hint: str | None = None, kind: Kind = FormatError) -> FormatError:
        """Return the error to raise about it."""
        return kind(message, source=self.source, hint=hint)
