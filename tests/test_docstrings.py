"""Wording of docstrings: the first word, and the length of the first sentence."""

from __future__ import annotations

import ast
import functools
import itertools
import re
from pathlib import Path

import pytest

import gazelle

PACKAGE = Path(gazelle.__file__).parent
CHECKOUT = PACKAGE.parent
ROS = CHECKOUT / "packages"
QUESTION = re.compile(r"(What|Where|Who|Whose|Whether|How|Which)\b")
ENTRY = re.compile(r"(?m)^ +\w+: (?:What|Where|Who|Whose|How|Which|When|Why|That)\b.*")
SENTENCE = re.compile(r"(?s)(.*?[.!?]\)?)(?=\s+[A-Z\"'`(0-9:*\-]|\s*$)")
MOST_WORDS = 25
KINDS = {
    ast.Module: "module",
    ast.ClassDef: "class",
    ast.FunctionDef: "function",
    ast.AsyncFunctionDef: "function",
}
VERBS = (Path(__file__).parent / "docstring_verbs.txt").read_text(encoding="utf-8").split()
"""Imperatives that begin a function's docstring: a new one is added there."""


def is_text(node):
    """Return whether a statement is a string alone."""
    value = node.value if isinstance(node, ast.Expr) else None
    return isinstance(value, ast.Constant) and isinstance(value.value, str)


def is_property(node):
    """Return whether a statement defines a property, whose docstring is a noun phrase."""
    names = [ast.unparse(each) for each in getattr(node, "decorator_list", [])]
    return any(name.split(".")[-1] in {"property", "cached_property"} for name in names)


def kind_of(node):
    """Return the kind of a statement with a docstring; None for others."""
    if getattr(node, "name", "").startswith("test_"):
        return "test"
    return "property" if is_property(node) else KINDS.get(type(node))


def docstrings_below(node):
    """Yield the kind, line and text of each docstring in a statement; expressions have none."""
    kind = kind_of(node)
    text = ast.get_docstring(node) if kind else None
    if text:
        yield kind, node.body[0].lineno, text
    for field in ("body", "orelse", "finalbody"):
        body = getattr(node, field, [])
        for before, each in itertools.pairwise(body):
            if isinstance(before, ast.Assign | ast.AnnAssign) and is_text(each):
                yield "attribute", each.lineno, each.value.value
        for each in body:
            yield from docstrings_below(each)


def docstrings(source):
    """Return the kind, line and text of each docstring of a module."""
    return [*docstrings_below(ast.parse(source))]


@functools.cache
def all_docstrings(folder):
    """Return file, kind, line and text of every docstring below a folder."""
    return [
        (path.relative_to(folder.parent).as_posix(), *each)
        for path in sorted(folder.rglob("*.py"))
        for each in docstrings(path.read_text(encoding="utf-8"))
    ]


def begins_with_verb(text):
    """Return whether the first word of a docstring is a known imperative."""
    return re.match(r"[\w-]*", text)[0] in VERBS


def first_sentence(text):
    """Return the first sentence of a docstring, or its first paragraph without a full stop."""
    paragraph = text.strip().split("\n\n")[0]
    found = SENTENCE.match(paragraph)
    return found[1] if found else paragraph


SOURCE = '''
"""How it is."""

LEAST = 1
"""What is least."""


class Thing:
    """Who does it."""

    size: int = 2
    """Length of the thing."""

    def act(self):
        """Whether it acts. This is more."""

    def rest(self):
        """Wait for the end."""

    @property
    def width(self):
        """Width of the thing."""

    @functools.cached_property
    def depth(self):
        """Depth of the thing."""


def test_things():
    """Things that act: what they do."""
'''


def test_docstrings_of_all_kinds_are_found():
    found = [(kind, text) for kind, _, text in docstrings(SOURCE)]
    assert sorted(found) == [
        ("attribute", "Length of the thing."),
        ("attribute", "What is least."),
        ("class", "Who does it."),
        ("function", "Wait for the end."),
        ("function", "Whether it acts. This is more."),
        ("module", "How it is."),
        ("property", "Depth of the thing."),
        ("property", "Width of the thing."),
        ("test", "Things that act: what they do."),
    ]
    assert sum(bool(QUESTION.match(text)) for _, text in found) == 4


@pytest.mark.parametrize(
    ("text", "first"),
    [
        ("Return it. And more.", "Return it."),
        ("Return it\nover lines.\n\nMore.", "Return it\nover lines."),
        ("Return 0.5 or less, e.g. none at all.", "Return 0.5 or less, e.g. none at all."),
        ("A name without a stop\n\nMore.", "A name without a stop"),
    ],
)
def test_the_first_sentence_is_found(text, first):
    assert first_sentence(text) == first


@pytest.mark.parametrize(
    ("text", "fits"),
    [
        ("Return the pose of a link.", True),
        ("Wait.", True),
        ("Flood-fill from a bin.", True),
        ("The pose of a link.", False),
        ("A map from a file.", False),
        ("Of two poses, the distance.", False),
        ("It happened.", False),
        ("Joints of a robot.", False),
        ("Two poses.", False),
        ("``size``.", False),
        ("Let it go.", False),
        ("Forget it.", False),
    ],
)
def test_imperatives_are_told_from_other_words(text, fits):
    assert begins_with_verb(text) == fits


def test_the_list_of_imperatives_is_sorted():
    assert sorted(set(VERBS)) == VERBS


@pytest.mark.long
@pytest.mark.parametrize(
    ("folder", "least"),
    [
        ("gazelle", 6_000),
        ("packages", 2_000),
        ("tests", 800),
        ("benchmarks", 200),
        ("tools", 150),
        ("examples", 10),
    ],
)
def test_docstrings_of_functions_begin_with_a_verb(folder, least):
    functions = [each for each in all_docstrings(CHECKOUT / folder) if each[1] == "function"]
    assert len(functions) > least
    assert [each for each in functions if not begins_with_verb(each[3])] == []


@pytest.mark.long
def test_docstrings_of_the_package_begin_with_no_question_word():
    assert [
        each for each in [*all_docstrings(PACKAGE), *all_docstrings(ROS)] if QUESTION.match(each[3])
    ] == []


@pytest.mark.parametrize(
    ("entry", "found"),
    [
        ("    worlds: Which worlds.", True),
        ("    start: Where it begins [m].", True),
        ("    ClientError: That takes too long.", True),
        ("    worlds: Worlds; all if None.", False),
        ("    pose: Pose, which may be None.", False),
        ("    closed: Whether the mesh has an inside.", False),
    ],
)
def test_entries_that_begin_with_a_question_word_are_found(entry, found):
    assert bool(ENTRY.search(f"Do it.\n\nArgs:\n{entry}")) == found


@pytest.mark.long
def test_entries_of_docstrings_begin_with_no_question_word():
    found = [
        (path, line, entry)
        for path, _, line, text in [*all_docstrings(PACKAGE), *all_docstrings(ROS)]
        for entry in ENTRY.findall(text)
    ]
    assert found == []


@pytest.mark.long
@pytest.mark.parametrize("folder", ["tests", "benchmarks", "tools", "examples"])
def test_docstrings_of_other_modules_begin_with_no_question_word(folder):
    found = all_docstrings(CHECKOUT / folder)
    assert found
    assert [each for each in found if each[1] == "module" and QUESTION.match(each[3])] == []


@pytest.mark.long
def test_first_sentences_are_short():
    found = [*all_docstrings(PACKAGE), *all_docstrings(ROS)]
    assert len(found) > 10_000
    texts = [each for each in found if each[1] != "attribute"]
    assert [each for each in texts if len(first_sentence(each[3]).split()) > MOST_WORDS] == []
