"""Python expressions that users give to choose and to show messages."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle_ros.errors import RosError


def compiled(expression: str, error: type[RosError]) -> Callable[..., Any]:
    """Return a function of the names that an expression knows, given as keywords.

    Args:
        expression: The user's own.
        error: Raised where it is not an expression, and by the function where it fails.
    """
    shown = expression if len(expression) <= 80 else f"{expression[:80]}..."
    try:
        code = compile(expression, "filter", "eval")
    except (SyntaxError, ValueError, MemoryError, RecursionError) as fault:
        raise error(f"'{shown}' is not a Python expression: {fault}") from None

    def value(**names: Any) -> Any:
        try:
            return eval(code, names)  # noqa: S307
        except Exception as fault:
            raise error(f"'{shown}' fails: {type(fault).__name__}: {fault}") from fault

    return value
