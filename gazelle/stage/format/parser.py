"""Stage's grammar: tokens to entities, with includes and macros.

include "FILE"
define NAME BASE ( ... )
TYPE ( PROPERTY VALUE ... TYPE ( ... ) ... )
PROPERTY VALUE
"""

from __future__ import annotations

import os
import re
from pathlib import Path

from gazelle.errors import FormatError, ResolveError
from gazelle.formats import blanks, xml
from gazelle.formats.reading import Reading
from gazelle.stage.format.entity import Entity, Property
from gazelle.stage.format.lexer import Script, Token, TokenKind, parse_value, tokenize
from gazelle_ros.base.path_texts import expanded

MAX_DEPTH = 64
"""Entities in each other, macros in macros."""
MAX_ENTITIES = 1_000_000
_COMMENT = re.compile("#[^\r\n]*")
SEARCH_VARIABLE = "STAGEPATH"

_VALUES = {TokenKind.NUMBER, TokenKind.STRING, TokenKind.TUPLE}


def parse(
    script: Script, reading: Reading, folder: Path | None
) -> tuple[Entity, dict[str, Entity]]:
    """Parse the whole file as one entity ``world``, with what it includes; and its macros by name.

    Args:
        script: The top-level file.
        reading: Finds what is included.
        folder: Folder of the file, where included files are searched first.

    Raises:
        FormatError: The text is no Stage file, or a limit is exceeded.
        ResolveError: An included file is not there.
    """
    world = Entity("world", "world", script, 0)
    macros: dict[str, Entity] = {}
    _Parser(world, reading, folder, macros).read(script)
    return world, macros


def script_of(name: str, data: bytes, reading: Reading) -> Script:
    """Return the text of a file; what is not UTF-8 is read as Latin-1, as old files are."""
    data = blanks.plain_bytes(data, name, _COMMENT, reading.misread)
    try:
        return Script(name, data.decode("utf-8-sig"))
    except UnicodeDecodeError:
        return Script(name, data.decode("latin-1"))


class _Parser:
    """Reads one file, and by others like it what that includes."""

    def __init__(
        self,
        world: Entity,
        reading: Reading,
        folder: Path | None,
        macros: dict[str, Entity],
    ) -> None:
        self._world = world
        self._reading = reading
        self._folder = folder
        self._macros = macros

    def read(self, script: Script) -> None:
        self._script = script
        self._tokens = tokenize(script)
        self._at = 0
        while (token := self._next()).kind != TokenKind.END:
            if token.kind != TokenKind.WORD:
                raise self._fail(f"expected a word, found '{token.text}'", token)
            if token.text == "include":
                self._include(token)
            elif token.text == "define":
                self._define()
            else:
                self._item(self._world, token, depth=1)

    def _next(self) -> Token:
        """Return the next token; at the end of the file its end, repeatedly."""
        token = self._tokens[self._at]
        self._at = min(self._at + 1, len(self._tokens) - 1)
        return token

    def _fail(self, message: str, token: Token, hint: str | None = None) -> FormatError:
        text = "the file ends too early: " + message if token.kind == TokenKind.END else message
        return self._script.fail(text, token.offset, hint)

    def _item(self, parent: Entity, word: Token, depth: int) -> None:
        """Parse ``PROPERTY VALUE`` or ``TYPE ( ... )``."""
        token = self._next()
        if token.kind in _VALUES:
            parent.own[word.text] = Property(self._script, word.text, token, word.offset)
        elif token.kind == TokenKind.OPEN:
            entity = self._entity(word.text, word)
            self._body(entity, depth)
            parent.children.append(entity)
            parent.total += entity.total
            self._check_count(parent, word)
        else:
            found = "the end" if token.kind == TokenKind.END else f"'{token.text}'"
            raise self._fail(f"expected a value or '(' after '{word.text}', found {found}", token)

    def _entity(self, name: str, word: Token) -> Entity:
        macro = self._macros.get(name)
        if macro is None:
            return Entity(name, name, self._script, word.offset, macros=self._macros)
        return Entity(macro.type, name, self._script, word.offset, macro, total=macro.total)

    def _check_count(self, entity: Entity, token: Token) -> None:
        if entity.total > MAX_ENTITIES:
            raise self._fail(f"more than {MAX_ENTITIES} entities", token)

    def _body(self, entity: Entity, depth: int) -> None:
        """Parse the content of parentheses, and the closing one."""
        if depth > MAX_DEPTH:
            raise entity.fail(f"entities are nested more than {MAX_DEPTH} deep")
        while (token := self._next()).kind != TokenKind.CLOSE:
            if token.kind == TokenKind.END:
                raise entity.fail("the ')' that ends this is missing")
            if token.kind != TokenKind.WORD:
                raise self._fail(f"expected a word or ')', found '{token.text}'", token)
            if (
                token.text in {"include", "define"}
                and self._tokens[self._at].kind != TokenKind.OPEN
            ):
                raise self._fail(f"'{token.text}' is only allowed outside of '( )'", token)
            self._item(entity, token, depth + 1)

    def _define(self) -> None:
        """Parse ``define NAME BASE ( ... )``; a second of a name is read, and not used."""
        name, base, opening = self._next(), self._next(), self._next()
        for token, expected, kind in (
            (name, "a name", TokenKind.WORD),
            (base, "a type", TokenKind.WORD),
            (opening, "'('", TokenKind.OPEN),
        ):
            if token.kind != kind:
                found = token.text or "the end"
                message = f"expected {expected} in 'define NAME TYPE ( ... )', found '{found}'"
                raise self._fail(message, token)
        entity = self._entity(base.text, name)
        entity.word = name.text
        self._check_chain(entity)
        self._body(entity, depth=1)
        first = self._macros.setdefault(name.text, entity)
        if first is not entity:
            place = first.source
            self._reading.remark(
                f"'{name.text}' is defined a second time; as in Stage the first one is used",
                entity.source,
                f"the first is at {place.file}:{place.line}",
            )

    def _check_chain(self, entity: Entity) -> None:
        length, macro = 0, entity.macro
        while macro is not None:
            length, macro = length + 1, macro.macro
        if length > MAX_DEPTH:
            raise entity.fail(f"macros are nested more than {MAX_DEPTH} deep")

    def _include(self, word: Token) -> None:
        token = self._next()
        if token.kind != TokenKind.STRING:
            raise self._fail("expected a file in quotes after 'include'", token)
        uri = str(parse_value(self._script, token))
        path = find_beside(uri, self._script, self._reading, self._folder)
        if path is None or not path.is_file():
            raise ResolveError(
                f"there is no file '{uri}' to include",
                source=self._script.source(word.offset, "include"),
                hint=looked(uri, self._reading, self._folder),
            )
        with self._reading.inside(path):
            script = script_of(str(path), xml.read_bytes(path), self._reading)
            _Parser(self._world, self._reading, self._folder, self._macros).read(script)


def find_beside(uri: str, script: Script, reading: Reading, folder: Path | None) -> Path | None:
    """Return a file that a Stage file names.

    It is looked for from the top-level file's folder, then from that of the file that names
    it, then by its last name in the folders of ``STAGEPATH``.
    """
    find = reading.resolver.find
    found = find(uri, folder) or find(uri, Path(script.name).parent if folder else None)
    if found is not None:
        return found
    for entry in os.environ.get(SEARCH_VARIABLE, "").split(os.pathsep):
        candidate = expanded(entry) / Path(uri).name
        if entry and candidate.is_file() and reading.resolver.readable(candidate):
            return candidate
    return None


def looked(uri: str, reading: Reading, folder: Path | None) -> str:
    """Return a close name, or where ``find_beside`` searches, for a message."""
    close = reading.resolver.near_miss(uri, folder)
    if close is not None:
        return close
    state = "" if os.environ.get(SEARCH_VARIABLE) else f"; {SEARCH_VARIABLE} is not set"
    return reading.resolver.looked_in(uri) + state
