"""Things that are closed at the end of a ``with`` block."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import gazelle
import gazelle_ros
from gazelle_ros.base.closing import Closeable


class Thing(Closeable):
    """Counts how often it is closed."""

    closed = 0

    def close(self):
        """Count."""
        self.closed += 1


def test_it_is_closed_at_the_end():
    with Thing() as thing:
        assert thing.closed == 0
    assert thing.closed == 1


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt, SystemExit])
def test_it_is_closed_after_an_error_that_goes_on(error):
    thing = Thing()
    with pytest.raises(error), thing:
        raise error
    assert thing.closed == 1


def test_what_cannot_be_closed_cannot_be_made():
    class Open(Closeable):
        pass

    with pytest.raises(TypeError):
        Open()


def test_nobody_writes_it_out_again():
    packages = [Path(each.__file__).parent for each in (gazelle, gazelle_ros)]
    found = {
        path.relative_to(package).as_posix()
        for package in packages
        for path in package.rglob("*.py")
        if "def __exit__" in (text := path.read_text(encoding="utf-8")) and "self.close()" in text
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.FunctionDef)
        and node.name == "__exit__"
        and [ast.unparse(line) for line in node.body] == ["self.close()"]
    }
    assert found == {"base/closing.py"}
