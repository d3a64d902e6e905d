"""The source of kernels."""

from __future__ import annotations

import ast
import functools
import linecache
from types import FunctionType

from gazelle.errors import EngineError


def tree_of(function: FunctionType) -> ast.FunctionDef:
    """What a kernel says.

    Raises:
        EngineError: There is no source of it.
    """
    code = function.__code__
    tree = _functions_of(code.co_filename).get((code.co_name, code.co_firstlineno))
    if tree is None:
        raise EngineError(
            f"there is no source of the kernel {code.co_name}",
            file=code.co_filename, hint="it may have changed since it was imported",
        )  # fmt: skip
    return tree


@functools.cache
def _functions_of(file: str) -> dict[tuple[str, int], ast.FunctionDef]:
    """The functions of a source file, by name and first line."""
    tree = ast.parse("".join(linecache.getlines(file)), file)
    found = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
    return {(node.name, min(_lines(node))): node for node in found}


def _lines(node: ast.FunctionDef) -> list[int]:
    return [node.lineno, *(each.lineno for each in node.decorator_list)]
