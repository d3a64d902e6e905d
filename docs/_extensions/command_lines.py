"""Reference of a command line, from its parsers.

The directive ``command-lines`` writes a section for each sub-command: its help, as ``--help`` prints it.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from gazelle.cli.main import GAZELLE
from gazelle_ros.cli.main import command_parser


class CommandLines(SphinxDirective):
    """Sections of all sub-commands of ``gazelle``."""

    def run(self) -> list[nodes.Node]:
        """Return a section for each sub-command."""
        return [
            self._section(
                f"{GAZELLE.name} {command.name}", _texts(command_parser(GAZELLE, command))
            )
            for command in GAZELLE.commands.values()
        ]

    def _section(self, title: str, texts: Iterator[str]) -> nodes.section:
        section = nodes.section(ids=[nodes.make_id(title)], names=[title])
        section += nodes.title(title, title)
        for text in texts:
            section += nodes.literal_block(text, text, language="text")
        self.state.document.note_explicit_target(section)
        return section


def _texts(parser: argparse.ArgumentParser) -> Iterator[str]:
    """Yield the help of a parser and of its sub-commands."""
    yield parser.format_help()
    for action in parser._actions:  # noqa: SLF001  # argparse offers no other way to its sub-commands
        if isinstance(action, argparse._SubParsersAction):  # noqa: SLF001
            for each in dict.fromkeys(action.choices.values()):
                yield from _texts(each)


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("command-lines", CommandLines)
    return {"parallel_read_safe": True}
