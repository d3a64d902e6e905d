"""Everything that is wrong with a file, as a list."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from gazelle.description import Source, World
from gazelle.errors import Error
from gazelle.formats import srdf, xml
from gazelle.formats.lint import Diagnostic, lint, semantics
from gazelle.formats.loader import PathLike, find_file, read_path, read_text
from gazelle.formats.reading import Note, Reading
from gazelle.formats.resolve import Resolver
from gazelle.formats.urdf.tree import NoLinksError, read_tree

TOLERATED = "tolerated"
"""Rule of the faults that a load continues with, as Gazebo does."""
INCLUDED = "only-macros"
"""Rule of xacro files that have no link, and are there for others to include."""


@dataclass(frozen=True, slots=True)
class Problem:
    """One finding.

    Attributes:
        severity: An error stops the load or a plugin, or is a fault that the load continues with
            as Gazebo does (rule ``tolerated``); a warning is neither.
        message: Description of the problem.
        file: File it is in.
        line: Line in that file, counted from 1.
        element: Path of the element.
        hint: Fix.
        why: Reason; None where that is plain.
        rule: Short name of the rule that found it; None for findings of the reader.
    """

    severity: Literal["error", "warning"]
    message: str
    file: str | None = None
    line: int | None = None
    element: str | None = None
    hint: str | None = None
    why: str | None = None
    rule: str | None = None

    @classmethod
    def of(cls, error: Error, file: str | None = None) -> Problem:
        """Return an error as a finding; ``file`` names its file where it has none."""
        name = error.file or file
        return cls("error", error.message, name, error.line, error.element, error.hint)


def check(
    path: PathLike,
    *,
    paths: Sequence[PathLike] = (),
    xacro_args: Mapping[str, str] | None = None,
    urdf: PathLike | None = None,
) -> list[Problem]:
    """Load a file and list its problems instead of raising them, errors first.

    Args:
        path: As for ``load``; or an SRDF.
        paths: As for ``load``.
        xacro_args: As for ``load``.
        urdf: The robot that an SRDF is for, whose links and joints it must name.
    """
    return examine(path, paths=paths, xacro_args=xacro_args, urdf=urdf)[0]


def examine(
    path: PathLike,
    *,
    paths: Sequence[PathLike] = (),
    xacro_args: Mapping[str, str] | None = None,
    urdf: PathLike | None = None,
) -> tuple[list[Problem], World | None]:
    """Return the problems of a file, as ``check``, and its world, if it holds one.

    Args:
        path: As for ``load``; or an SRDF.
        paths: As for ``load``.
        xacro_args: As for ``load``.
        urdf: As for ``check``.
    """
    reading = Reading(Resolver(paths), xacro_args=dict(xacro_args or {}))

    def judge() -> tuple[list[Problem], World | None]:
        file = find_file(path, reading)
        if is_semantic(file):
            return _check_semantics(file, urdf, reading), None
        return _linted(read_path(file, reading))

    name = os.fspath(path) if isinstance(path, str | os.PathLike) else None
    return _found(reading, judge, name)


def check_string(text: str, *, name: str = "string") -> list[Problem]:
    """Load SDF, URDF, xacro or Stage text and list its problems, errors first.

    Args:
        text: The text.
        name: Stands for the file in the problems.
    """
    return examine_string(text, name=name)[0]


def examine_string(text: str, *, name: str = "string") -> tuple[list[Problem], World | None]:
    """Return the problems of a text, as ``check_string``, and its world, if it holds one.

    Args:
        text: As for ``load_string``.
        name: Stands for the file in the problems.
    """
    reading = Reading(Resolver())
    return _found(reading, lambda: _linted(read_text(text, name, reading)), name)


def _linted(world: World) -> tuple[list[Problem], World]:
    return [_problem_of(finding) for finding in lint(world)], world


def _found(
    reading: Reading, judge: Callable[[], tuple[list[Problem], World | None]], name: str | None
) -> tuple[list[Problem], World | None]:
    """Return all problems of one load, and its world, if it holds one.

    Args:
        reading: The load.
        judge: Reads; returns problems of what was read, and the world.
        name: Stands for the file of an error without one.
    """
    problems: list[Problem] = []
    judged: list[Problem] = []
    world: World | None = None
    try:
        judged, world = judge()
    except NoLinksError as error:
        problem = Problem.of(error, name)
        included = problem.file is not None and Path(problem.file).suffix == ".xacro"
        problems.append(
            replace(problem, severity="warning", rule=INCLUDED) if included else problem
        )
    except Error as error:
        problems.append(Problem.of(error, name))
    problems += [_noted(note) for note in reading.notes if note.severity == "error"]
    problems += [
        _noted(Note(f"'{miss.uri}' is not found", miss.source, miss.looked))
        for miss in reading.misses
    ]
    problems += [_noted(note) for note in reading.notes if note.severity == "warning"]
    reported = {each.rule for each in problems}  # by the reader, who sees each element
    return problems + [each for each in judged if each.rule not in reported], world


def is_semantic(file: Path) -> bool:
    """Return whether a file is an SRDF: by its name, or an ``.xml`` by its content."""
    if any(suffix.lower() == ".srdf" for suffix in file.suffixes):
        return True
    try:
        return file.suffix == ".xml" and srdf.is_srdf(xml.read_file(file))
    except Error:
        return False


def _check_semantics(file: Path, urdf: PathLike | None, reading: Reading) -> list[Problem]:
    """Read an SRDF, and check it against its URDF; errors of the URDF belong to another check."""
    with reading.inside(file):
        root = srdf.read_root(file, reading)
        srdf.read_semantics(root, reading)
    if urdf is None:
        return []
    other = Reading(reading.resolver, xacro_args=reading.xacro_args)
    robot = find_file(urdf, other)
    with other.inside(robot):
        node = srdf.read_root(robot, other)
        tree = read_tree(node, other)
    name = node.attributes.get("name", "")
    return [_problem_of(finding, "error") for finding in semantics.lint(root, name, tree)]


def _problem_of(finding: Diagnostic, severity: Literal["error", "warning"] = "warning") -> Problem:
    place = finding.source or Source()
    return Problem(
        severity,
        finding.message,
        place.file,
        place.line,
        place.element,
        finding.hint,
        finding.why,
        finding.rule,
    )


def _noted(note: Note) -> Problem:
    place = note.source or Source()
    rule = TOLERATED if note.severity == "error" else note.rule
    return Problem(
        note.severity, note.message, place.file, place.line, place.element, note.hint, rule=rule
    )
