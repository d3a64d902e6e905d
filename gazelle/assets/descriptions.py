"""Short descriptions of bundled files, taken from the comments at their heads."""

from __future__ import annotations

import itertools
import re
from pathlib import Path

_XML_COMMENT = re.compile(r"\s*(?:<\?xml[^>]*\?>)?\s*<!--(.*?)-->", re.DOTALL)
_SENTENCE_END = re.compile(r"(?<=\.)\s")


def description(path: Path) -> str:
    """Return the first sentence of the comment that a world or robot file begins with.

    Args:
        path: File in XML, or Stage's world file.

    Returns:
        The sentence on one line; empty where the file begins with something else.
    """
    text = path.read_text(encoding="utf-8")
    found = _XML_COMMENT.match(text)
    if found:
        comment = found[1]
    else:
        lines = itertools.takewhile(lambda line: line.startswith("# "), text.splitlines())
        comment = " ".join(line[2:] for line in lines)
    return _SENTENCE_END.split(" ".join(comment.split()), maxsplit=1)[0]
