"""Check of the search: words that it must find, ``search_must_find`` of conf.py."""

from __future__ import annotations

from pathlib import Path

from sphinx.application import Sphinx
from sphinx.errors import ExtensionError


def _check(app: Sphinx, exception: Exception | None) -> None:
    """Raise an error for words that are not in the index of the site."""
    indexer = getattr(app.builder, "indexer", None)
    if exception is not None or indexer is None:
        return
    index = Path(app.outdir, "searchindex.js").read_text(encoding="utf-8")
    missing = [
        word
        for word in app.config.search_must_find
        if f'"{indexer.lang.stem(word.lower())}":' not in index
    ]
    if missing:
        raise ExtensionError(f"the search does not find: {', '.join(missing)}")


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the check."""
    app.add_config_value("search_must_find", [], "html")
    app.connect("build-finished", _check)
    return {"parallel_read_safe": True}
