"""How messages name what is in a kernel."""

from __future__ import annotations

import ast
from typing import Final

_LONGEST: Final = 60  # characters


def spelled(node: ast.AST) -> str:
    """The beginning of what a kernel says, in quotes."""
    first, *others = ast.unparse(node).splitlines() or [""]
    if others or len(first) > _LONGEST:
        first = first[:_LONGEST].rstrip() + " ..."
    return f"'{first}'"


def unknown(node: ast.AST, said: ast.AST | None = None) -> str:
    """That kernels do not know a construct, by its class in ``ast``; where it is said."""
    return f"kernels know no {type(node).__name__}: {spelled(said or node)}"
