"""Command lines with a wrong word, for every command, sub-command, option and positional argument."""

from __future__ import annotations

import argparse
import itertools
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from gazelle.cli.commands import COMMANDS
from gazelle_ros.cli.parsing import Parser

NUMBERS = ["nan", "inf", "-inf", "-1", "0", "1e308", "1e400", "9" * 30, "1.5", "", "no such", "½"]
WORDS = [
    *("", " ", "no such", "-1", "nan", "/proc", ".", "../..", "no/such/file", "/dev/null/a"),
    *("a" * 300, "a" * 10_000, "\udcff", "é\u2028", "a:b", "a=b", "a=nan", "::", "{", "[1, 2"),
    *("folder", "null", "unreadable", "locked/a", "a=1e400", "1e400", "9" * 30, "1,nan", "-1x-1"),
]
"""Without "/": root may write there."""
LEFT_OUT = {"bench"}
"""Commands of a source checkout."""
GOOD: dict[str, dict[str, list[str]]] = {
    "run": {"file": ["empty"]},
    "check": {"files": ["empty"]},
    "convert": {"source": ["turtlebot3_burger"], "target": ["made.sdf"]},
    "map": {"source": ["turtlebot3_world"], "target": ["made"]},
    "view": {"file": ["empty"]},
    "picture": {"source": ["empty"], "out": ["made.png"]},
    "film": {"source": ["empty"], "out": ["made.gif"]},
    "plot": {"sources": ["table.csv"], "out": ["made.png"]},
    "train": {"task": ["TurtleBot3Stage1"]},
    "eval": {"run": ["robot.npz"]},
    "new": {"kind": ["task"], "name": ["mine"]},
    "study": {"function": ["quick.py:run"]},
    "export": {"run": ["robot.npz"]},
    "deploy": {"policy": ["robot.npz"], "names": []},
    "launch": {"what": ["a.launch"]},
    "exec": {"script": ["quick.py"]},
    "completion": {"shell": ["bash"]},
    "tasks": {"task": ["TurtleBot3Stage1"]},
    "param-load": {"file": ["a.yaml"]},
    "param-dump": {"file": ["made.yaml"]},
    "bag-filter": {"source": ["a.bag"], "target": ["made.bag"], "expression": ["True"]},
    "bag-fix": {"source": ["a.bag"], "target": ["made.bag"]},
    "bag-to-mcap": {"source": ["a.bag"], "target": ["made.mcap"]},
}
BY_NAME = {
    "topic": ["/rosout"],
    "topics": ["/rosout"],
    "type": ["std_msgs/String"],
    "service": ["/rosout/get_loggers"],
    "node": ["/rosout"],
    "nodes": ["/rosout"],
    "name": ["/a"],
    "value": ["1"],
    "bag": ["a.bag"],
    "bags": ["a.bag"],
    "package": ["std_msgs"],
}
BASE = {
    "demo": "--steps 64 --num-envs 2 --episodes 1 --out runs",
    "train": "--steps 64 --num-envs 2 --out runs --option engine=planar",
    "eval": "--task TurtleBot3Stage1 --episodes 1 --num-envs 1 --engine planar",
    "film": "--for 0.1 --size 32x32 --fps 10",
    "picture": "--size 32x32",
    "run": "--for 0.1",
    "study": "--out study.csv",
    "topic-pub": "--once",
    "node-ping": "-c 1",
    "master": "--port 0",
    "bridge": "--port 0",
}
"""Options that keep work small."""


class Line(NamedTuple):
    """A command line.

    Attributes:
        command: With its sub-command, joined by "-".
        wrong: Description of the wrong word.
        words: After ``gazelle``.
    """

    command: str
    wrong: str
    words: list[str]


def command_lines(names: list[str]) -> Iterator[Line]:
    """Yield lines of some commands, of all without a name."""
    for name, command in COMMANDS.items():
        if name in LEFT_OUT or (names and name not in names):
            continue
        parser = Parser(prog=name)
        command.load().configure(parser)
        yield Line(name, "no words", [name])
        yield Line(name, "a name near a command", [_misspelled(name)])
        for path, leaf in _leaves([name], parser):
            if len(path) > 1:
                near = [*path[:-1], _misspelled(path[-1])]
                yield Line("-".join(path), "a name near a sub-command", near)
            for wrong, words in _lines_of("-".join(path), path, leaf):
                yield Line("-".join(path), wrong, words)


def _leaves(
    path: list[str], parser: argparse.ArgumentParser
) -> Iterator[tuple[list[str], argparse.ArgumentParser]]:
    """Yield commands and sub-commands with their parsers."""
    inner = [each for each in parser._actions if isinstance(each, argparse._SubParsersAction)]
    if not inner:
        yield path, parser
    for action in inner:
        for name, each in action.choices.items():
            yield from _leaves([*path, name], each)


def _lines_of(
    name: str, path: list[str], parser: argparse.ArgumentParser
) -> Iterator[tuple[str, list[str]]]:
    good = _positionals(name, parser)
    base, rest = [*path, *BASE.get(name, "").split()], _flat(good)
    yield "an unknown option", [*base, "--no-such", *rest]
    yield "too many words", [*base, *rest, *["more"] * 5]
    yield "each word twice", [*base, *rest, *rest]
    actions = [each for each in parser._actions if not isinstance(each, argparse._HelpAction)]
    for action in actions:
        if action.option_strings:
            for wrong, words in _of_option(action):
                yield wrong, [*base, *words, *rest]
            yield (
                f"{action.option_strings[-1]} at the end",
                [*base, *rest, action.option_strings[-1]],
            )
            continue
        near = [_misspelled(each) for each in good[action.dest][:1]]
        for value in [*_values(action), *near]:
            dashes = ["--"] if value.startswith("-") else []
            wrong = f"{action.metavar or action.dest}={value!r:.40}"
            yield wrong, [*base, *dashes, *_flat({**good, action.dest: [value]})]
    letters = [each[1] for a in actions for each in a.option_strings if len(each) == 2]
    for pair in itertools.pairwise(letters):
        yield f"joined -{pair[0]}{pair[1]}", [*base, f"-{pair[0]}{pair[1]}", *rest]


def _of_option(action: argparse.Action) -> Iterator[tuple[str, list[str]]]:
    option = action.option_strings[-1]
    misspelled = [_misspelled(option)]
    if action.nargs == 0:
        yield f"{option} twice", [option, option]
        yield f"{option}=1", [f"{option}=1"]
    else:
        misspelled.append("1")
        for value in _values(action):
            yield f"{option} {value!r:.40}", [option, value]
        for value in ("", "nan", "folder", "\udcff"):
            joined = f"{option}={value}" if option.startswith("--") else f"{option}{value}"
            yield f"{joined!r:.40}", [joined]
        yield f"{option} 1, twice", [option, "1", option, "1"]
    yield misspelled[0], misspelled


def _values(action: argparse.Action) -> list[str]:
    return WORDS if action.type in (None, Path) else NUMBERS


def _misspelled(word: str) -> str:
    """Return a word with its last two letters exchanged."""
    return word[:-2] + word[:-3:-1]


def _flat(words: dict[str, list[str]]) -> list[str]:
    return [word for each in words.values() for word in each]


def _positionals(name: str, parser: argparse.ArgumentParser) -> dict[str, list[str]]:
    """Return a good word or some for each positional argument."""
    good: dict[str, Any] = {}
    for action in parser._actions:
        if action.option_strings or action.nargs == 0:
            continue
        optional = action.nargs in ("?", "*", argparse.REMAINDER)
        fallback = [] if optional else BY_NAME.get(action.dest, ["a"])
        good[action.dest] = GOOD.get(name, {}).get(action.dest, fallback)
    return good
