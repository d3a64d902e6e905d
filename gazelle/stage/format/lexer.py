"""Stage's world files as tokens.

Words, numbers, strings, tuples in brackets, and the parentheses of bodies; a ``#`` starts a
comment. Numbers may have an exponent, which Stage itself does not read.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from dataclasses import dataclass, field
from enum import IntEnum
from sys import intern
from typing import NamedTuple

from gazelle.description import Source
from gazelle.errors import FormatError
from gazelle_ros.base.characters import curly_hint

Value = float | str | tuple[float | str, ...]

# quantifiers that never give back, so that no file can make the search slow
_NUMBER = r"[+-]?(?:\d++(?:\.\d*+)?+|\.\d++)(?:[eE][+-]?\d++)?(?![\w.+-])"
_STRING = r'"[^"\r\n]*"'
_TOKEN = re.compile(
    rf"""
    [ \t\r\n\f\v]++ | \#[^\r\n]*+
  | ( [A-Za-z][\w.\-]*+(?:\[[ \t]*+\d++[ \t]*+\][\w.\-]*+)* )
  | ( {_NUMBER} )
  | ( {_STRING} )
  | ( \[[^\]\r\n\#]*\] )
  | ( \( )
  | ( \) )
  | ( . )
    """,
    re.VERBOSE | re.ASCII,
)
_ITEM = re.compile(rf"\s+|({_NUMBER})|({_STRING})|(.)", re.ASCII)
_BREAK = re.compile(r"\r\n|\r|\n")


class TokenKind(IntEnum):
    """Kind of a token; the numbers are those of the groups of the pattern."""

    WORD = 1
    NUMBER = 2
    STRING = 3
    TUPLE = 4
    OPEN = 5
    CLOSE = 6
    END = 7


class Token(NamedTuple):
    """A token, with where it begins in its file."""

    kind: int
    text: str
    offset: int


@dataclass(slots=True)
class Script:
    """The text of a file, which knows its lines.

    Attributes:
        name: File, for errors.
        text: All of it.
    """

    name: str
    text: str
    _starts: list[int] = field(default_factory=list)

    def line(self, offset: int) -> int:
        """Return the line of an offset, counted from 1."""
        if not self._starts:
            self._starts = [0, *(found.end() for found in _BREAK.finditer(self.text))]
        return bisect_right(self._starts, offset)

    def source(self, offset: int, element: str | None = None) -> Source:
        """Return the place of an offset."""
        return Source(self.name, self.line(offset), element)

    def fail(self, message: str, offset: int, hint: str | None = None) -> FormatError:
        """Return the error to raise about a place."""
        return FormatError(message, source=self.source(offset), hint=hint)


def tokenize(script: Script) -> list[Token]:
    """Return all tokens of a file, and one of kind ``END`` behind them.

    Raises:
        FormatError: There is a character that no token begins with.
    """
    found: list[Token] = []
    for match in _TOKEN.finditer(script.text):
        kind = match.lastindex
        if kind == TokenKind.WORD:
            # they come again and again, and are looked up in dictionaries
            found.append(Token(kind, intern(match[kind]), match.start()))
        elif kind == TokenKind.END:
            raise _unexpected(script, Token(kind, match[kind], match.start()))
        elif kind:
            found.append(Token(kind, match[kind], match.start()))
    return [*found, Token(TokenKind.END, "", len(script.text))]


def _unexpected(script: Script, token: Token) -> FormatError:
    rest = _BREAK.split(script.text[token.offset : token.offset + 80], maxsplit=1)[0]
    if token.text == '"':
        return script.fail("a string must end with '\"' on its line", token.offset)
    if token.text == "[":
        return script.fail(
            "a tuple must end with ']' on the line that it begins on",
            token.offset,
            hint="comments are not allowed in it",
        )
    if token.text in "+-.0123456789":
        return script.fail(f"'{rest.split()[0]}' is not a number", token.offset)
    return script.fail(
        f"'{token.text}' has no meaning in a Stage file",
        token.offset,
        hint=curly_hint(token.text),
    )


def parse_value(script: Script, token: Token) -> Value:
    """Parse the value of a number, string or tuple.

    Raises:
        FormatError: A tuple holds something else than numbers and strings.
    """
    if token.kind == TokenKind.NUMBER:
        return float(token.text)
    if token.kind == TokenKind.STRING:
        return token.text[1:-1]
    items: list[float | str] = []
    for match in _ITEM.finditer(token.text[1:-1]):
        if match.lastindex == 1:
            items.append(float(match[1]))
        elif match.lastindex == 2:
            items.append(match[2][1:-1])
        elif match.lastindex == 3:
            raise script.fail(
                f"a tuple may hold numbers and strings, found '{token.text}'",
                token.offset,
                hint=curly_hint(token.text),
            )
    return tuple(items)
