"""Words that names, docstrings and comments have no use for, as the field has terms of its own."""

from __future__ import annotations

import io
import re
import tokenize

import pytest
from test_docstrings import CHECKOUT, PACKAGE, ROS, docstrings

TERMS = {
    "anatomy": "structure",
    "anew": "again",
    "anybody": "any user, or subscribers",
    "askew": "misaligned",
    "astray": "out of range",
    "calming": "recovery",
    "heard": "received",
    "hears": "receives",
    "heeded": "supported",
    "nobody": "no user, or no subscriber",
    "somebody": "a user, or a subscriber",
    "strangers": "unknown names",
    "told": "reported",
    "tells": "reports",
    "whereabouts": "position",
    "whoever": "the user, or the publisher",
}
"""Standard terms by the words that they replace."""
ANY = re.compile("|".join(TERMS), re.IGNORECASE)
WORD = re.compile(r"[a-z]+|[A-Z]+(?![a-z])|[A-Z][a-z]*")


def found_in(source):
    """Return the lines of such words in names, docstrings and comments, with the words."""
    if not ANY.search(source):
        return []
    texts = [(line, text) for _, line, text in docstrings(source)]
    texts += [
        (token.start[0], token.string)
        for token in tokenize.generate_tokens(io.StringIO(source).readline)
        if token.type in (tokenize.NAME, tokenize.COMMENT)
    ]
    words = ((line, word.lower()) for line, text in texts for word in WORD.findall(text))
    return sorted({(line, word) for line, word in words if word in TERMS})


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ("_last_heard = 1", ["heard"]),
        ("class HeardTopic: ...", ["heard"]),
        ("x = 1  # as was told", ["told"]),
        ('def f():\n    """Return who told."""', ["told"]),
        ("raise ValueError('nothing was heard')", []),
        ("shears, tolda = 1, 2", []),
    ],
)
def test_words_are_found_in_names_docstrings_and_comments(source, words):
    assert [word for _, word in found_in(source)] == words


@pytest.mark.long
def test_names_docstrings_and_comments_use_terms_of_the_field():
    paths = [*PACKAGE.rglob("*.py"), *ROS.rglob("*.py")]
    assert len(paths) > 1500
    found = [
        f"{path.relative_to(CHECKOUT)}:{line}: {word} (rather: {TERMS[word]})"
        for path in paths
        for line, word in found_in(path.read_text(encoding="utf-8"))
    ]
    assert found == []
